-- glaze.lua - clear layers over each other, each dry before the next: what is below shines through.
local scale, steps = param("scale", 1), param("steps", 400)
local function px(n) return math.floor(n * scale) end
local yellow, rose, blue = "hansa yellow", "quinacridone rose", "cerulean blue"

local p = paper{width = px(560), height = px(380), stock = "hot press", pigments = {yellow, rose, blue}}
local shapes = {{yellow, ellipse(px(215), px(150), px(120)), 0.9}, {rose, ellipse(px(345), px(150), px(120)), 0.35},
  {blue, ellipse(px(280), px(245), px(112)), 0.6}}
for _, s in ipairs(shapes) do
  p:put(s[2], {water = 0.55, [s[1]] = s[3]})
  p:step(steps)
  p:seal()
end
p:frame("recipe-glaze.png")
