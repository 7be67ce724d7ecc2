-- glazes.lua - glaze swatches: six bands of pigment, dried and sealed, and the same six across them.
--
--     lutetia run examples/scripts/glazes.lua [scale=0.5] [steps=80]
local scale = param("scale", 1)
local steps = param("steps", 80)
local side = math.floor(640 * scale)
local inks = {
  {"hansa yellow", 0.55}, {"brilliant orange", 0.5}, {"quinacridone rose", 0.55},
  {"french ultramarine", 0.7}, {"cerulean blue", 0.55}, {"hooker's green", 0.4},
}
local names = {}
for i, ink in ipairs(inks) do names[i] = ink[1] end

local p = paper{width = side, height = side, stock = "cold press", seed = 66, grain = math.max(1, 6 * scale), pigments = names}
p:air{humidity = 0.0025, settling = 0.3, absorption = 0.03, edge = 14, edge_width = math.max(1, 7 * scale)}
local wide = 62 * scale
local b = p:brush{kind = "flat", width = 70 * scale, depth = 10 * scale, follows = true, bristles = 360, thickness = 3 * scale, reach = 4000 * scale, load = 0.75}

local function bands(across)
  for i, ink in ipairs(inks) do
    local at = side * (i - 0.5) / 6 + (6 - 1.7 * i) * scale
    b:rinse()
    b:dip{water = 1, [ink[1]] = ink[2]}
    local from, to = 26 * scale, side - 26 * scale
    local ends = across and {{at, from}, {at + 3 * scale, side * 0.5}, {at - 2 * scale, to}} or {{from, at}, {side * 0.5, at - 3 * scale}, {to, at + 2 * scale}}
    p:stroke{brush = b, points = ends, speed = 900 * scale, pace = 10, pressure = {0.75, 0.85, 0.8, 0.85, 0.7}}
  end
  p:step(steps)
  p:dry()
  p:seal()
end
bands(false)
bands(true)
p:frame("glazes.png")
