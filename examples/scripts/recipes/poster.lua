-- poster.lua - type over washes: masking fluid keeps a word white, another is painted when the wash is dry.
local scale, steps = param("scale", 1), param("steps", 700)
local function px(n) return math.floor(n * scale) end
local rose, orange, blue = "quinacridone rose", "brilliant orange", "french ultramarine"

local p = paper{width = px(400), height = px(560), stock = "cold press", pigments = {rose, orange, blue}}
local word = text("wet", {size = px(190), x = px(200), y = px(330), align = "center"})
p:resist(word)
p:wash({water = 0.6, [rose] = 0.8}, {from = {0, px(60)}, to = {0, px(470)}, into = {water = 0.6, [orange] = 0.5, [rose] = 0.1},
  mask = rect(px(28), px(28), px(344), px(450))})
p:splatter({x = px(200), y = px(250), radius = px(190), drops = 50, size = {math.max(0.3, 1.2 * scale), math.max(1, 9 * scale)}, seed = 4},
  {water = 1.2, [blue] = 0.6})
p:step(steps)
p:seal()
p:unresist(word)
p:type("paint, type, time", {size = px(38), x = px(200), y = px(528), align = "center"}, {water = 0.5, [blue] = 1.6, [rose] = 0.3})
p:step(steps // 4)
p:dry()
p:frame("recipe-poster.png")
