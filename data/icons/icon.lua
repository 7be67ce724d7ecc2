-- icon.lua - the icon: an L in ink that has run a little, on handmade paper.
--
--     for side in 48 128 256; do lutetia run icon.lua side=$side -o .; done
local side = param("side", 256)
local scale = side / 256
local p = paper{width = side, height = side, stock = "cold press", seed = 1990,
                pigments = {"french ultramarine", "quinacridone rose"},
                deckle = {margin = math.max(2, 10 * scale), waves = 2 * scale, thin = math.max(1, 8 * scale), fringe = 4 * scale}}
p:air{gravity = {0, 0.15}}
p:put(text("L", {font = "EBGaramond12-Italic", size = 270 * scale, x = 60 * scale, y = 208 * scale}),
      {water = 0.8, ["french ultramarine"] = 1.3})
p:step(math.floor(60 * scale) + 8)
p:put(ellipse(186 * scale, 96 * scale, 22 * scale), {water = 0.9, ["quinacridone rose"] = 1.2})
p:step(math.floor(120 * scale) + 10)
p:dry()
p:frame(string.format("%d.png", side), {ground = "none"})
