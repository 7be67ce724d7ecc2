-- techniques.lua - eight squares: a graded wash, splatter, salt, blotting, lifting, masking fluid, a brush that is loaded on both
-- sides, and varnish.
--
--     lutetia run examples/scripts/techniques.lua [scale=0.5] [steps=180]
local scale = param("scale", 1)
local steps = param("steps", 180)
local side, gap = 165 * scale, 14 * scale
local w, h = math.floor(4 * side + 5 * gap), math.floor(2 * (side + gap) + gap + 52 * scale)
local p = paper{width = w, height = h, stock = "cold press", seed = 8, grain = math.max(1, 6 * scale),
  pigments = {"french ultramarine", "quinacridone rose", "hooker's green"}}
p:air{humidity = 0.0012, settling = 0.1, absorption = 0.03, edge_width = math.max(1, 6 * scale)}
local names = {"wash", "splatter", "salt", "blot", "lift", "resist", "dip", "varnish"}
local blue, rose, green = "french ultramarine", "quinacridone rose", "hooker's green"
local function cell(i) return gap + (i - 1) % 4 * (side + gap), gap + (i - 1) // 4 * (side + gap + 22 * scale) end
local function square(i) local x, y = cell(i) return rect(x, y, side, side) end
local function middle(i) local x, y = cell(i) return x + side / 2, y + side / 2 end

-- 6: the fluid comes first
local mx, my = middle(6)
local star = {}
for i = 0, 9 do
  local r, a = (i % 2 == 0 and 62 or 26) * scale, math.pi * (i / 5 - 0.5)
  star[#star + 1] = {mx + r * math.cos(a), my + r * math.sin(a)}
end
p:resist(polygon(star))
local x, y = cell(1)
p:wash({water = 0.6, [blue] = 0.9}, {from = {x, y}, to = {x, y + side}, into = {water = 0.6, [rose] = 0.35}, mask = square(1)})
for _, i in ipairs{3, 4, 6} do p:put(square(i), {water = 0.6, [blue] = 0.35, [green] = 0.6}) end
p:put(square(5), {water = 0.6, [blue] = 0.5})
p:put(square(8), {water = 0.6, [blue] = 0.5, [rose] = 0.5})
mx, my = middle(2)
p:splatter({x = mx, y = my, radius = 46 * scale, drops = 90, size = {math.max(0.1, 0.6 * scale), math.max(1, 9 * scale)}, seed = 4}, {water = 0.7, [rose] = 0.9})
p:splatter({x = mx - 50 * scale, y = my + 50 * scale, radius = 26 * scale, drops = 40, size = {math.max(0.1, 0.5 * scale), math.max(1, 3 * scale)}, angle = -45, thrown = 1.2, seed = 5}, {water = 0.5, [blue] = 1.2})
p:step(steps // 4)
mx, my = middle(3)
p:salt{x = mx, y = my, radius = side, grains = 170, size = {math.max(0.2, 0.6 * scale), math.max(0.5, 1.5 * scale)}, strength = 0.6, reach = math.max(1.5, 7 * scale),
  mask = rect(mx - side * 0.42, my - side * 0.42, side * 0.84, side * 0.84), seed = 9}
mx, my = middle(4)
for i = 1, 5 do p:blot(ellipse(mx + (i - 3) * 24 * scale, my + (i % 2 * 2 - 1) * 22 * scale, 21 * scale, 13 * scale):soften(5 * scale), 0.85, 0.5) end
-- 7: green on the left of the brush, rose on its right
local b = p:brush{kind = "flat", width = 52 * scale, follows = true, reach = 1500 * scale}
b:dip({water = 1, [green] = 0.9}, {side = {-1, -0.1}})
b:dip({water = 1, [rose] = 0.9}, {side = {0.1, 1}})
b:dip({water = 1}, {side = {-0.1, 0.1}})
x, y = cell(7)
p:stroke{brush = b, path = "M28 150C10 20 90 10 84 82S140 150 138 20", x = x, y = y, scale = scale, pressure = {0.7, 0.9, 0.9, 0.6}, speed = 400 * scale}
p:step(steps)
p:dry()
mx, my = middle(5)
p:lift(line({{mx - 60 * scale, my + 40 * scale, 12 * scale}, {mx, my - 44 * scale, 20 * scale}, {mx + 60 * scale, my + 30 * scale, 12 * scale}}):soften(3 * scale), 0.95)
p:unresist(polygon(star))
mx, my = middle(8)
p:varnish(ellipse(mx, my, 56 * scale):soften(2 * scale) - ellipse(mx, my, 24 * scale):soften(2 * scale))
for i, name in ipairs(names) do
  local cx, cy = cell(i)
  p:put(text(name, {size = 19 * scale, x = cx + 2 * scale, y = cy + side + 18 * scale}), {[blue] = 1.2, [rose] = 0.4, [green] = 0.5})
end
p:frame("techniques.png")
