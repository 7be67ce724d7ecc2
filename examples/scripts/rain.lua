-- rain.lua - type that rains: a word in ink on upright paper that absorbs little. Heavy drops run down.
--
--     lutetia run examples/scripts/rain.lua [scale=0.5] [steps=2400] [word=rain]
local scale = param("scale", 1)
local steps = param("steps", 2400)
local word = param("word", "rain")
local w, h = math.floor(560 * scale), math.floor(600 * scale)

local p = paper{
  width = w, height = h, stock = "hot press", seed = 4,
  absorbency = 0.02, capacity = {0.04, 0.10}, roughness = 0.22, grain = math.max(1, 10 * scale),
  pigments = {"french ultramarine", "phthalo green", "quinacridone rose"},
}
p:air{
  gravity = {0, 0.6}, pinning = 1.0, film = 0.12, relief = 0.1, spread = 0.3,
  humidity = 0.0001, edge = 4, edge_width = 3, settling = 0.05, absorption = 0.03,
}

-- Puts the word, then drops in it, which are high enough to flow into the dry paper below.
local type = text(word, {size = 270 * scale, x = w / 2, y = 240 * scale, align = "center"})
p:put(type, {water = 0.35, ["french ultramarine"] = 0.75, ["phthalo green"] = 0.3})
for i = 1, 26 do
  local x, y = w * (0.08 + 0.84 * math.random()), (130 + 105 * math.random()) * scale
  local r = (5 + 12 * math.random() ^ 2) * scale
  p:put(type * ellipse(x, y, r):soften(r / 3),
    {water = 2.5, ["french ultramarine"] = 0.5, ["quinacridone rose"] = 0.7 * math.random()})
end
p:step(steps)
p:dry()
p:frame("rain.png")
