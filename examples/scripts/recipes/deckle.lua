-- deckle.lua - a sea in the evening, painted over the edges of a sheet of handmade paper.
local scale, steps = param("scale", 1), param("steps", 900)
local function px(n) return math.floor(n * scale) end
local blue, rose, orange, green = "french ultramarine", "quinacridone rose", "indian yellow", "phthalo green"

local p = paper{width = px(560), height = px(400), stock = "cold press", pigments = {blue, rose, orange, green},
  deckle = {margin = 24 * scale, waves = 2.5 * scale, thin = 14 * scale, fringe = 5 * scale}}
p:wash{water = 0.15}
p:wash({water = 0.5, [blue] = 0.35, [rose] = 0.06}, {from = {0, px(30)}, to = {0, px(215)}, into = {water = 0.5, [orange] = 0.3, [rose] = 0.06},
  mask = rect(0, 0, px(560), px(224))})
p:step(steps // 9)
p:blot(ellipse(px(372), px(172), px(20)):soften(px(4)), 0.95, 0.9)
p:step(steps // 3)
p:seal()
p:wash({water = 0.6, [blue] = 0.3, [green] = 0.12, [rose] = 0.06}, {from = {0, px(220)}, to = {0, px(370)}, into = {water = 0.6, [blue] = 1, [green] = 0.4},
  mask = rect(0, px(223), px(560), px(177))})
p:step(steps // 9)
for i = 0, 7 do
  local y, half = 230 + i * 9 + i * i, 14 + i * 5 + (i * 7) % 5 * 6
  p:blot(ellipse(px(372 + (i * 5) % 3 * 8 - 8), px(y), px(half), px(1.5 + 0.3 * i)):soften(px(1)), 0.8, 0.8)
end
p:step(steps // 2)
p:dry()
p:frame("recipe-deckle.png")
