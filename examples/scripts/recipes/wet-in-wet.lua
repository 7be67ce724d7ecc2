-- wet-in-wet.lua - colours dropped into clean water, which carries them into each other.
local scale, steps = param("scale", 1), param("steps", 700)
local function px(n) return math.floor(n * scale) end
local rose, yellow, blue = "quinacridone rose", "hansa yellow", "french ultramarine"

local p = paper{width = px(560), height = px(380), stock = "cold press", pigments = {rose, yellow, blue}}
p:put(ellipse(px(280), px(190), px(235), px(150)), {water = 0.7})
local drops = {{150, 160, 34, rose}, {250, 240, 30, yellow}, {310, 120, 32, yellow}, {410, 230, 34, rose}, {320, 200, 24, blue},
  {195, 235, 22, blue}, {235, 140, 26, rose}, {385, 150, 26, yellow}}
for _, d in ipairs(drops) do
  p:put(ellipse(px(d[1]), px(d[2]), px(d[3])), {water = 2, [d[4]] = 1.2})
end
p:step(steps)
p:dry()
p:frame("recipe-wet-in-wet.png")
