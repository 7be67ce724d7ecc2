-- papers.lua - a poster of one word in every paper: the same ink, water and time on five stocks.
--
--     lutetia run examples/scripts/papers.lua [scale=0.5] [steps=500] [word=Lutetia]
-- Each strip is a paper of its own. It is dried and sealed, and its colours are copied into the poster's layers.
local scale = param("scale", 1)
local steps = param("steps", 500)
local word = param("word", "Lutetia")
local stocks = {"glass", "hot press", "cold press", "rough", "blotting"}
local w, h = math.floor(700 * scale), math.floor(190 * scale)

local colors = {}
for i, stock in ipairs(stocks) do
  local p = paper{
    width = w, height = h, stock = stock, seed = 30 + i, grain = math.max(1, (stock == "rough" and 9 or 5) * scale),
    pigments = {"burnt umber", "french ultramarine", "quinacridone rose"},
  }
  p:air{humidity = 0.0006, absorption = 0.05, settling = 0.15, gravity = {0, stock == "glass" and 0.1 or 0}}
  -- a damp band across, and the word half in it
  p:put(rect(w * 0.36, 24 * scale, w * 0.30, h - 48 * scale):soften(14 * scale), {water = 0.55})
  p:put(text(word, {size = 150 * scale, x = w / 2, y = h * 0.72, align = "center"}),
    {water = 0.7, ["burnt umber"] = 0.35, ["french ultramarine"] = 0.55, ["quinacridone rose"] = 0.2})
  p:step(steps)
  p:dry()
  p:put(text(stock, {size = math.max(4, 15 * scale), x = 14 * scale, y = h - 14 * scale}), {["burnt umber"] = 0.8})
  p:seal()
  for _, layer in ipairs{"red", "green", "blue"} do
    local strip = p:mask(layer):move(0, (i - 1) * h)
    colors[layer] = colors[layer] and colors[layer] + strip or strip
  end
  p:close()
end

local poster = paper{width = w, height = #stocks * h, model = {"infused"}}
for layer, strips in pairs(colors) do poster:layer(layer, strips) end
poster:frame("papers.png")
