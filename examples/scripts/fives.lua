-- fives.lua - a poster of fives, for a fifth birthday: figures in three inks run in water that was poured down the sheet, and
-- varnish lies where the paper was wettest. In the spirit of figure 18 of David Small's thesis, which this does not copy.
--
--     lutetia run examples/scripts/fives.lua [scale=0.5] [steps=260]
local scale = param("scale", 1)
local steps = param("steps", 260)
local w, h = math.floor(560 * scale), math.floor(760 * scale)

local p = paper{
  width = w, height = h, stock = "hot press", seed = 5, grain = math.max(1, 3 * scale), color = "#f4efe2",
  pigments = {"cyan", "magenta", "yellow"},
}
p:air{humidity = 0.0002, seep = {0, 0.12}, gravity = {0, 0.04}, edge = 8, edge_width = math.max(1, 6 * scale), absorption = 0.05, carry = 0.5, pinning = 0.6}

local function five(size, x, y, angle, ink)
  p:put(text("5", {size = size * scale, x = x * scale, y = y * scale, align = "center", font = "DejaVuSerif"}):rotate(angle, x * scale, (y - size * 0.36) * scale), ink)
end

-- water poured on the sheet: there the figures will run
local poured = rect(0, 0, 1, 1) - rect(0, 0, 1, 1)
for i = 1, 7 do
  local x, wide = w * (0.08 + 0.14 * (i - 1)) + (math.random() - 0.5) * 40 * scale, (8 + 26 * math.random()) * scale
  local from, to = h * (0.05 + 0.35 * math.random()), h * (0.62 + 0.33 * math.random())
  poured = poured + line({{x, from, wide}, {x + 6 * scale, (from + to) / 2, wide * 1.6}, {x, to, wide * 0.7}})
end
p:put(poured:soften(5 * scale), {water = 1.2})
p:step(steps // 4)

-- one large five, its four small sisters, and the years
five(700, 280, 600, 0, {water = 0.12, yellow = 0.95, magenta = 0.25})
five(250, 118, 250, -14, {water = 0.3, cyan = 1.0, magenta = 0.12})
five(250, 445, 330, 12, {water = 0.3, magenta = 1.0, cyan = 0.1})
five(180, 120, 690, 9, {water = 0.3, magenta = 0.9, yellow = 0.7})
five(150, 452, 700, -8, {water = 0.3, cyan = 0.9, yellow = 0.5})
for pour = 1, 3 do  -- more water, in the same places, pulls them down
  p:step(steps // 3)
  p:put(poured:soften(3 * scale), {water = 0.5})
end
p:step(steps // 4)

-- varnish where the sheet is wettest; then the sheet dries under it
local wet = p:mask("infused water", 0.36, 0.46):soften(math.max(1, 1.5 * scale))
p:put(text("one two three four five", {size = 30 * scale, x = w / 2, y = h - 26 * scale, align = "center", tracking = 0.12}),
  {cyan = 0.9, magenta = 0.9, yellow = 0.8})
p:dry()
p:varnish(wet)
p:frame("fives.png")
