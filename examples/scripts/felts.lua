-- felts.lua - a wash by a wide brush on each stock: felt-rough.png and so on.
--
--     lutetia run examples/scripts/felts.lua [scale=1] [steps=200]
local scale, steps = param("scale", 1), param("steps", 200)
local function px(n) return math.floor(n * scale) end
local blue = "french ultramarine"
local side, over = px(168), px(240)

for _, stock in ipairs{"cold press", "hot press", "rough", "laid", "xuan", "blotting", "glass"} do
  local p = paper{width = over, height = side, stock = stock, seed = 7, pigments = {blue}}
  local b = p:brush{kind = "flat", width = px(84), reach = 2400 * scale, thickness = 5 * scale, bristles = 512}
  for i = 0, 2 do
    b:dip{water = 1, [blue] = 0.5}
    p:stroke{brush = b, points = {{px(-40), px(22 + 62 * i)}, {px(90), px(14 + 66 * i)}, {px(210), px(26 + 60 * i)}, {px(340), px(18 + 62 * i)}},
      pressure = 0.8, speed = 1200 * scale}
  end
  p:step(steps)
  p:dry()
  p:frame("felt-" .. stock:gsub(" ", "-") .. ".png")
  p:close()
end
