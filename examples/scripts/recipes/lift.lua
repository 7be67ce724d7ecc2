-- lift.lua - light taken back: a cloth in the wet wash, a damp sponge on the dry one.
local scale, steps = param("scale", 1), param("steps", 500)
local function px(n) return math.floor(n * scale) end
local blue, green, ochre = "cerulean blue", "viridian", "yellow ochre"

local p = paper{width = px(560), height = px(380), stock = "cold press", pigments = {blue, green, ochre}}
p:wash({water = 0.5, [blue] = 0.7}, {from = {0, px(20)}, to = {0, px(360)}, into = {water = 0.5, [green] = 0.6, [ochre] = 0.5},
  mask = rect(px(24), px(20), px(512), px(340))})
p:step(steps // 6)
for _, c in ipairs{{170, 120, 62, 26}, {225, 104, 52, 30}, {275, 126, 60, 22}, {410, 90, 52, 18}, {450, 100, 40, 14}} do
  p:blot(ellipse(px(c[1]), px(c[2]), px(c[3]), px(c[4])):soften(px(9)) * 0.9, 0.9, 0.8)
end
p:step(steps - steps // 6)
p:dry()
for i = 0, 3 do
  p:lift(line({{px(60 + 30 * i), px(250 + 26 * i), px(3)}, {px(270), px(240 + 26 * i), px(9)}, {px(500 - 30 * i), px(252 + 26 * i), px(3)}})
    :soften(px(3)), 1)
end
p:frame("recipe-lift.png")
