-- deckles.lua - handmade sheets of four stocks, two pixels a fiber: deckle-rough.png, deckle-laid.png, deckle-xuan.png, deckle-blotting.png.
--
--     lutetia run examples/scripts/deckles.lua [scale=1] [steps=300]
local scale, steps = param("scale", 1), param("steps", 300)
local function px(n) return math.floor(n * scale) end
local inks = {rough = "french ultramarine", laid = "burnt umber", xuan = "indian red", blotting = "hooker's green"}

for i, stock in ipairs{"rough", "laid", "xuan", "blotting"} do
  local ink = inks[stock]
  local p = paper{width = px(192), height = px(144), stock = stock, seed = 6 + i, pigments = {ink},
    deckle = {margin = 20 * scale, waves = 2.5 * scale, thin = 14 * scale, fringe = 5 * scale}}
  p:wash({water = 0.5, [ink] = 0.5}, {from = {0, px(100)}, to = {0, px(144)}, into = {water = 0.5, [ink] = 0.8},
    mask = rect(0, px(104), px(192), px(40))})
  p:type(stock, {size = px(36), x = px(96), y = px(80), align = "center"})
  p:step(steps)
  p:dry()
  p:frame("deckle-" .. stock .. ".png", {scale = 2})
  p:close()
end
