-- axes.lua - paper that cannot exist: cyan moves only along x, magenta only along y, yellow not at all.
--
--     lutetia run examples/scripts/axes.lua [scale=0.5] [steps=700]
local scale = param("scale", 1)
local steps = param("steps", 700)
local w, h = math.floor(820 * scale), math.floor(640 * scale)

local p = paper{
  width = w, height = h, stock = "hot press", model = {"infused"}, rule = "subtract", torus = true,
  absorbency = 0.25, absorbency_variation = 0.5, capacity = 1, seed = 12,
  pigments = {
    {name = "along x", like = "cyan", weight = {1, 0}},
    {name = "along y", like = "magenta", weight = {0, 1}},
    {name = "still", like = "yellow", weight = 0},
  },
}
p:air{humidity = 0.0004, carry = 0.1}
p:wash{water = 0.95}
local letters = text("x  y", {size = 430 * scale, x = w / 2, y = 420 * scale, align = "center", font = "DejaVuSerif"})
p:put(letters, {["along x"] = 0.9, ["along y"] = 0.85})
p:put(ellipse(w / 2, 330 * scale, 70 * scale), {still = 0.75})
p:put(ellipse(w / 2, 330 * scale, 70 * scale) - ellipse(w / 2, 330 * scale, 62 * scale), {["along x"] = 0.8, ["along y"] = 0.5})
p:step(steps)
p:frame("axes.png")
