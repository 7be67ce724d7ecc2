-- bamboo.lua - ink and a round brush: stalks stroke by stroke with one side of the brush wet, twigs and leaves along the paths of
-- bamboo.svg.
--
--     lutetia run examples/scripts/bamboo.lua [scale=0.5] [steps=150]
local scale = param("scale", 1)
local steps = param("steps", 150)
local w, h = math.floor(520 * scale), math.floor(640 * scale)

local p = paper{
  width = w, height = h, stock = "hot press", seed = 31, color = "#f3ecd9", color_variation = 0.35,
  absorbency = 0.16, fibers = {10, 10}, grain = math.max(1, 3 * scale),
  pigments = {{name = "ink", like = "french ultramarine", K = {2.6, 2.5, 2.3}, S = {0.02, 0.02, 0.03}, granulation = 0.2, staining = 8, weight = 0.15},
    "cadmium red", "burnt umber"},
}
p:air{humidity = 0.002, settling = 0.3, edge = 8, edge_width = math.max(1, 5 * scale), absorption = 0.05, pinning = 1.5}

-- a stalk: joint after joint upwards, a pause at each end; the left side of the brush has more ink
local function stalk(x, lean, width, ink, joints, top)
  local b = p:brush{kind = "flat", width = width * scale, depth = math.max(1, 5 * scale), reach = 1500 * scale, follows = true, number = 1, load = 0.45, uneven = 0.5}
  local y = h + 10 * scale
  for joint = 1, joints do
    local length = (joint == joints and 0.8 or 1) * (h + 10 * scale - top * scale) / joints
    b:dip{water = 1, ink = ink * 0.12}
    b:dip({water = 0.8, ink = ink}, {side = {-1, -0.35}})
    b:dip({water = 0.9, ink = ink * 0.6, ["burnt umber"] = ink * 0.1}, {side = {0.75, 1}})
    local x1, x2 = x + lean * (h - y) / h, x + lean * (h - y + length) / h
    p:stroke{brush = b, points = {{x1 + 1 * scale, y, 0.95, 0}, {x1, y - 3 * scale, 0.9, 0.12}, {(x1 + x2) / 2, y - length / 2, 0.7, 0.45},
      {x2, y - length + 13 * scale, 0.85, 0.75}, {x2 + 1 * scale, y - length + 10 * scale, 0.95, 0.95}}, pace = 20}
    y = y - length
  end
end
stalk(w * 0.47, 40 * scale, 24, 0.45, 5, 20)
stalk(w * 0.35, -30 * scale, 15, 0.2, 6, 110)

-- twigs and leaves
local lines = svg("bamboo.svg")
local twig = p:brush{kind = "rigger", width = math.max(1.5, 6 * scale), reach = 800 * scale}
local leaf = p:brush{kind = "round", width = 19 * scale, load = 0.4, reach = 420 * scale, point = 0.85, uneven = 0.35}
for i, way in ipairs(lines) do
  if i <= 5 then
    twig:dip{water = 1, ink = 1.0}
    p:stroke{brush = twig, points = way, scale = scale, pressure = {0.6, 0.3, 0.45, 0.2}, pace = 10, speed = 300 * scale}
  else
    local near = 0.55 + 0.45 * math.random()
    leaf:dip({water = 0.7, ink = 1.5 * near ^ 2}, {part = 0.7})
    p:stroke{brush = leaf, points = way, scale = scale, pressure = {0.12, 0.75, 0.85, 0.5, 0.12, 0.0}, pace = 16, speed = 330 * scale}
  end
end
p:step(steps)
p:dry()

-- the seal
p:seal()
local seal = rect(w * 0.80, h * 0.86, 44 * scale, 44 * scale) - text("L", {size = 46 * scale, x = w * 0.80 + 22 * scale, y = h * 0.86 + 38 * scale, align = "center"})
p:put(seal, {water = 0.1, ["cadmium red"] = 2.5, ["burnt umber"] = 0.35})
p:step(12)
p:dry()
p:frame("bamboo.png")
