-- cup.lua - a sentence is cut into letters that fall into a cup, push each other apart, and come to rest.
--
--     lutetia run examples/scripts/cup.lua [scale=1] [steps=80] [words="..."]
local scale = param("scale", 1)
local steps = param("steps", 80)
local words = param("words", "the words are poured into the cup and lie there")
local w, h = math.floor(420 * scale), math.floor(560 * scale)
local unit = 90 * scale

local s = spring.word{text = words, x = 0.4, y = 9, width = 3.4, side = 5000, diagonal = 5000,
  damping_ratio = 0.4, left_on = true, left = 0.3, right_on = true, right = 3.9,
  restitution = 0.15, drag = 0.25, font = "EBGaramond12-Regular", box = "ink"}
for i = 1, s:springs() do                         -- only what makes letters holds
  local a, b = s:ends(i)
  if (a - 1) // 4 ~= (b - 1) // 4 then s:cut(i) end
end
s:collide(true)
s:step(240 * 8)

local p = paper{width = w, height = h, stock = "rough", seed = 12,
  pigments = {"burnt umber", "phthalo green"}}
local x, y = 20 * scale, h - 40 * scale           -- where the world begins
local function at(cx, cy) return x + unit * cx, y - unit * cy end
local x0, y0 = at(0.3, 3.6)
local x1, y1 = at(0.3, 0)
local x2 = at(3.9, 0)
p:put(line({{x0, y0}, {x1, y1}, {x2, y1}, {x2, y0}}, 5 * scale), {water = 0.2, ["phthalo green"] = 0.8})
p:put(s:mask{scale = unit, x = x, y = y}, {water = 0.45, ["burnt umber"] = 0.7})
p:step(steps)
p:dry()
p:frame("cup.png")
