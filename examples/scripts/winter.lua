-- winter.lua - a night in winter: a graded sky with salt in it, a moon in masking fluid, hills in glazes, firs with a bristle
-- brush, grasses and splatter.
--
--     lutetia run examples/scripts/winter.lua [scale=0.5] [steps=140]
local scale = param("scale", 1)
local steps = param("steps", 140)
local w, h = math.floor(800 * scale), math.floor(540 * scale)

local p = paper{
  width = w, height = h, stock = "cold press", seed = 12, grain = math.max(1, 6 * scale),
  pigments = {"french ultramarine", "phthalo green", "quinacridone rose", "burnt umber"},
}
local function breath(n, rough)
  local points, y = {}, 0
  for i = 0, n do
    y = rough * y + (math.random() - 0.5)
    points[#points + 1] = {i / n, y}
  end
  return points
end

-- moon
local moon = ellipse(w * 0.72, h * 0.23, 30 * scale)
p:resist(moon)

-- sky: dark above, rosy at the horizon, salt while it is wet
p:air{humidity = 0.0012, settling = 0.12, edge = 4, edge_width = 10, absorption = 0.03, pinning = 0.6}
p:wash({water = 0.75, ["french ultramarine"] = 1.6, ["phthalo green"] = 0.28},
  {from = {0, 0}, to = {0, h * 0.62}, into = {water = 0.6, ["french ultramarine"] = 0.1, ["quinacridone rose"] = 0.16},
   mask = rect(-20, -20, w + 40, h * 0.66 + 20)})
p:blot(ellipse(w * 0.72, h * 0.23, 70 * scale):soften(34 * scale), 0.55)  -- the moon's light
p:salt{x = w / 2, y = h * 0.2, grains = 420, radius = w * 0.55, size = {math.max(0.1, 0.3 * scale), math.max(0.3, scale)}, strength = 0.7, reach = math.max(1.5, 4.5 * scale),
  mask = rect(0, 0, w, h * 0.5)}
p:step(steps)
p:dry() p:seal()

-- the snow's edge is never level
local line_of_snow = {{-30, h + 30}}
for _, point in ipairs(breath(18, 0.75)) do
  line_of_snow[#line_of_snow + 1] = {-30 + point[1] * (w + 60), h * 0.715 + point[2] * 16 * scale + 12 * scale * math.cos(point[1] * 7)}
end
line_of_snow[#line_of_snow + 1] = {w + 30, h + 30}
local snow = polygon(line_of_snow):soften(3 * scale)

-- hills, each darker and nearer
p:air{humidity = 0.003, settling = 0.25, edge = 14, edge_width = 6}
for layer = 1, 3 do
  local edge, base = {{-10, h * 0.8}}, h * (0.50 + 0.055 * layer)
  for _, point in ipairs(breath(26 + 10 * layer, 0.8)) do
    edge[#edge + 1] = {point[1] * w, base + point[2] * 44 * scale / layer - 30 * scale * math.sin(point[1] * 5 + layer)}
  end
  edge[#edge + 1] = {w + 10, h * 0.8}
  local hills = polygon(edge) - snow
  p:put(hills, {water = 0.45, ["french ultramarine"] = 0.2 + 0.22 * layer, ["quinacridone rose"] = 0.12, ["burnt umber"] = 0.06 * layer})
  p:step(steps // 5)
  p:dry() p:seal()
end

-- snow is the paper; its shadows are wet in wet
for i = 1, 7 do
  local x, y = w * math.random(), h * (0.80 + 0.16 * math.random())
  p:put(ellipse(x, y, (80 + 120 * math.random()) * scale, (5 + 8 * math.random()) * scale):soften(12 * scale),
    {water = 0.4, ["french ultramarine"] = 0.3, ["quinacridone rose"] = 0.08})
end
p:step(steps // 5)

-- firs: short strokes to both sides of a stem, wider below
local b = p:brush{kind = "bristle", width = 9 * scale, depth = math.max(1, 4 * scale), reach = 700 * scale, load = 0.8, follows = true}
local stem = p:brush{kind = "rigger", width = math.max(1, 4 * scale), reach = 900 * scale}
local function fir(x, foot, height)
  stem:dip{water = 1, ["burnt umber"] = 1.8, ["french ultramarine"] = 1.4}
  p:stroke{brush = stem, points = {{x, foot}, {x + scale, foot - height * 0.5}, {x, foot - height}}, pressure = {0.9, 0.4, 0.1}, pace = 0, speed = 600 * scale}
  local tiers = math.floor(height / (7 * scale))
  for tier = 0, tiers do
    local part = tier / tiers
    local y, reach = foot - height * (0.94 - 0.84 * part), height * (0.04 + 0.21 * part) * (0.8 + 0.4 * math.random())
    if tier % 3 == 0 then
      b:dip({water = 0.9, ["phthalo green"] = 1.6, ["french ultramarine"] = 1.4, ["burnt umber"] = 1.6}, {part = 0.8})
    end
    for side = -1, 1, 2 do
      p:stroke{brush = b, points = {{x, y - 3 * scale}, {x + side * reach * 0.6, y + reach * 0.16}, {x + side * reach, y + reach * 0.45}},
        pressure = {0.7, 0.5, 0.1}, pace = 0, speed = 500 * scale}
    end
  end
end
fir(w * 0.12, h * 0.90, 250 * scale)
fir(w * 0.21, h * 0.86, 170 * scale)
fir(w * 0.05, h * 0.85, 140 * scale)
fir(w * 0.90, h * 0.83, 120 * scale)
fir(w * 0.95, h * 0.86, 165 * scale)
p:step(steps // 3)

-- grasses in the snow, and what fell off the brush
for i = 1, 22 do
  local x, y = w * (0.3 + 0.5 * math.random()), h * (0.86 + 0.11 * math.random())
  if i % 4 == 1 then stem:dip{water = 0.7, ["burnt umber"] = 0.9} end
  p:stroke{brush = stem, points = {{x, y}, {x + (math.random() - 0.4) * 14 * scale, y - (14 + 22 * math.random()) * scale}}, pressure = {0.5, 0.02}, pace = 0, speed = 400 * scale}
end
p:splatter({x = w * 0.5, y = h * 0.9, radius = 150 * scale, drops = 50, size = {math.max(0.1, 0.5 * scale), math.max(0.3, 1.9 * scale)}, angle = -12, thrown = 0.4}, {water = 0.4, ["burnt umber"] = 0.9})
p:step(steps // 4)
p:dry()
p:unresist(moon)
p:frame("winter.png")
