-- wash.lua - a sky: one brushed wash that grows lighter downwards, laid on damp paper.
local scale, steps = param("scale", 1), param("steps", 900)
local function px(n) return math.floor(n * scale) end
local blue, umber = "french ultramarine", "burnt umber"

local p = paper{width = px(560), height = px(380), stock = "cold press", pigments = {blue, umber}}
p:wash{water = 0.2}
p:wash({water = 0.5, [blue] = 0.6}, {from = {0, px(20)}, to = {0, px(300)}, into = {water = 0.5, [blue] = 0.04, [umber] = 0.1},
  mask = rect(px(24), px(20), px(512), px(340))})
p:step(steps)
p:dry()
p:frame("recipe-wash.png")
