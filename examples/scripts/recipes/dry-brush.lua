-- dry-brush.lua - a brush with little water, quick and light, touches only the hills of rough paper.
local scale, steps = param("scale", 1), param("steps", 200)
local function px(n) return math.floor(n * scale) end
local umber, blue = "burnt umber", "french ultramarine"

local p = paper{width = px(560), height = px(380), stock = "rough", pigments = {umber, blue}}
local b = p:brush{kind = "flat", width = px(62), load = 0.2, reach = 900 * scale}
for i, way in ipairs{"M40 90C180 40 330 60 520 100", "M40 190C200 150 360 170 520 205", "M50 300C210 250 350 270 515 305"} do
  b:dip{water = 0.5 - 0.1 * i, [umber] = 1.4, [blue] = 0.25 * i}
  p:stroke{brush = b, path = way, scale = scale, pressure = {0.75, 0.45, 0.25}, speed = (500 + 400 * i) * scale}
end
p:step(steps)
p:dry()
p:frame("recipe-dry-brush.png")
