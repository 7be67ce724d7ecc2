-- bloom.lua - cauliflowers: clean water let fall into a wash that has begun to dry.
local scale, steps = param("scale", 1), param("steps", 900)
local function px(n) return math.floor(n * scale) end
local blue, rose = "french ultramarine", "quinacridone rose"

local p = paper{width = px(560), height = px(380), stock = "cold press", pigments = {blue, rose}}
p:put(rect(px(24), px(20), px(512), px(340)), {water = 0.32, [blue] = 0.18, [rose] = 0.22})
p:step(steps // 3)
for _, d in ipairs{{170, 150, 30}, {380, 235, 38}, {400, 100, 16}, {250, 290, 14}} do
  p:put(ellipse(px(d[1]), px(d[2]), px(d[3])), {water = 3.5})
end
p:step(steps - steps // 3)
p:dry()
p:frame("recipe-bloom.png")
