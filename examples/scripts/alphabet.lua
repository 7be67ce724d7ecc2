-- alphabet.lua - an alphabet with a flat brush held at 40 degrees: each letter a few SVG paths, each row from one dip.
--
--     lutetia run examples/scripts/alphabet.lua [scale=0.5] [steps=120]
local scale = param("scale", 1)
local steps = param("steps", 120)
local w, h = math.floor(780 * scale), math.floor(620 * scale)

-- The letters' skeletons: 100 high, y downwards, and how wide.
local letters = {
  A = {76, "M4 100L38 0L74 100", "M18 66L58 66"},
  B = {70, "M10 0L10 100", "M10 2C70 -8 70 48 14 48C84 44 84 104 10 98"},
  C = {76, "M74 18C54 -8 6 -4 6 50C6 104 54 108 76 82"},
  D = {82, "M10 0L10 100", "M10 2C94 -6 94 106 10 98"},
  E = {66, "M62 2L10 2L10 98L64 98", "M10 48L52 48"},
  F = {62, "M62 2L10 2L10 100", "M10 48L50 48"},
  G = {82, "M74 18C54 -8 6 -4 6 50C6 106 58 108 74 84L74 56L48 56"},
  H = {78, "M8 0L8 100", "M70 0L70 100", "M8 50L70 50"},
  I = {26, "M12 0L12 100"},
  J = {52, "M44 0L44 76C44 108 8 106 4 82"},
  K = {72, "M10 0L10 100", "M66 0L14 54", "M24 46L70 100"},
  L = {62, "M10 0L10 98L60 98"},
  M = {94, "M6 100L14 0L46 74L78 0L88 100"},
  N = {80, "M8 100L8 2L72 98L72 0"},
  O = {86, "M42 0C-8 0 -8 100 42 100C92 100 92 0 40 0"},
  P = {66, "M10 0L10 100", "M10 2C84 -6 84 62 12 54"},
  Q = {88, "M42 0C-8 0 -8 100 42 100C92 100 92 0 40 0", "M50 74C62 84 70 100 90 104"},
  R = {74, "M10 0L10 100", "M10 2C84 -6 84 62 12 54", "M36 56L74 100"},
  S = {70, "M62 14C44 -8 6 0 10 26C14 54 66 44 66 74C66 106 16 106 4 84"},
  T = {76, "M2 2L74 2", "M38 2L38 100"},
  U = {78, "M8 0L8 66C8 108 70 108 70 66L70 0"},
  V = {76, "M4 0L38 98L72 0"},
  W = {102, "M2 0L26 98L50 20L74 98L98 0"},
  X = {74, "M6 0L70 100", "M70 0L6 100"},
  Y = {76, "M4 0L38 50L72 0", "M38 50L38 100"},
  Z = {76, "M8 2L70 2L6 98L74 98"},
}
local rows = {"ABCDEF", "GHIJKLM", "NOPQRST", "UVWXYZ"}

local p = paper{
  width = w, height = h, stock = "cold press", seed = 26, grain = math.max(1, 6 * scale),
  pigments = {"french ultramarine", "quinacridone rose", "brilliant orange"},
}
p:air{humidity = 0.0008, settling = 0.2, absorption = 0.03, pinning = 1.4, edge = 12, edge_width = math.max(1, 6 * scale)}
local b = p:brush{kind = "flat", width = 17 * scale, depth = math.max(1, 2.6 * scale), angle = -40, reach = 2200 * scale, load = 0.6, splay = 0.05, thickness = 1.2, bend = 0, seed = 7}

local size = 1.05 * scale
for r, row in ipairs(rows) do
  local total, gap = 0, 26 * scale
  for c in row:gmatch(".") do total = total + letters[c][1] * size + gap end
  local x, y = (w - total + gap) / 2, (34 + 142 * (r - 1)) * scale
  local warm = (r - 1) / 3
  for c in row:gmatch(".") do
    local letter = letters[c]
    b:dip({water = 1, ["french ultramarine"] = 1.7 * (1 - warm) + 0.1, ["quinacridone rose"] = 0.3 + 0.9 * math.sin(math.pi * (0.15 + 0.7 * warm)),
      ["brilliant orange"] = 1.1 * warm ^ 2}, {part = 0.55})
    for i = 2, #letter do
      p:stroke{brush = b, path = letter[i], x = x, y = y, scale = size, speed = 620 * scale, pace = 24,
        pressure = {0.75, 0.95, 0.85, 0.95, 0.8}}
    end
    x = x + letter[1] * size + gap
  end
end
p:step(steps)
p:dry()
p:frame("alphabet.png")
