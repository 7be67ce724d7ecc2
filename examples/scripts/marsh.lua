-- marsh.lua - Lutetia, a town in a marsh: a wet sky, a far shore, reeds in masking fluid, and the name on wet ground.
--
--     lutetia run examples/scripts/marsh.lua [scale=0.5] [steps=260]
local scale = param("scale", 1)
local steps = param("steps", 260)
local w, h = math.floor(840 * scale), math.floor(560 * scale)
local shore = h * 0.52

local p = paper{
  width = w, height = h, stock = "cold press", seed = 52, grain = math.max(1, 6 * scale),
  pigments = {"cerulean blue", "french ultramarine", "burnt umber", "hansa yellow"},
}
local function breath(n)  -- a soft random curve from left to right
  local points, y = {}, 0
  for i = 0, n do
    y = 0.6 * y + (math.random() - 0.5)
    points[#points + 1] = {i / n, y}
  end
  return points
end

-- reeds are kept dry and white until the end
local reeds = rect(0, 0, 1, 1) - rect(0, 0, 1, 1)
for i = 1, 34 do
  local x, foot = w * (0.03 + 0.28 * math.random() ^ 1.4), h * (0.86 + 0.12 * math.random())
  local height, lean = h * (0.16 + 0.25 * math.random()), (math.random() - 0.35) * 46 * scale
  reeds = reeds + line({{x, foot, 2.6 * scale}, {x + lean * 0.3, foot - height * 0.6, 2 * scale}, {x + lean, foot - height, 0.7 * scale}})
end
p:resist(reeds)

-- sky: wet in wet, darker above
p:air{humidity = 0.0012, settling = 0.2, edge = 6, edge_width = 10, absorption = 0.03, gravity = {0, 0.03}}
p:put(rect(-50, -60 * scale, w + 100, shore + 40 * scale):soften(18 * scale), {water = 0.55, ["hansa yellow"] = 0.05})
p:put(rect(-50, -80 * scale, w + 100, h * 0.30 + 80 * scale):soften(60 * scale), {["cerulean blue"] = 0.5})
for cloud = 1, 7 do
  local x, y = w * math.random(), h * (0.05 + 0.22 * math.random())
  p:put(ellipse(x, y, (60 + 90 * math.random()) * scale, (10 + 16 * math.random()) * scale):soften(14 * scale),
    {water = 0.5, ["french ultramarine"] = 0.3, ["burnt umber"] = 0.08})
end
p:step(steps)
for cloud = 1, 5 do  -- clouds lifted out with a dry cloth
  local x, y = w * (0.1 + 0.8 * math.random()), h * (0.10 + 0.22 * math.random())
  p:blot(ellipse(x, y, (50 + 70 * math.random()) * scale, (8 + 10 * math.random()) * scale):soften(12 * scale), 0.8, 0.65)
end
p:dry() p:seal()

-- the far shore and its town, the first glaze pale, the second over half of it
for layer = 1, 2 do
  local edge = {{-10, shore}}
  for _, point in ipairs(breath(40)) do
    local town = math.exp(-((point[1] - 0.62) * 7) ^ 2)
    edge[#edge + 1] = {point[1] * w, shore - (12 + 10 * point[2] + 26 * town * (0.6 + math.abs(point[2]))) * scale * (layer == 1 and 1 or 0.55)}
  end
  edge[#edge + 1] = {w + 10, shore}
  p:put(polygon(edge), {water = 0.5, ["french ultramarine"] = 0.3 * layer, ["burnt umber"] = 0.16 * layer})
  p:step(steps // 2)
  p:dry() p:seal()
end

-- water, with the shore in it, and the name that runs into it
p:put(rect(-50, shore + 2 * scale, w + 100, h), {water = 0.6, ["cerulean blue"] = 0.16, ["hansa yellow"] = 0.05})
p:put(rect(-50, h * 0.8, w + 100, h):soften(50 * scale), {["burnt umber"] = 0.3, ["french ultramarine"] = 0.3})
for i = 1, 12 do
  local x, y = w * (0.40 + 0.5 * math.random()), shore + (6 + 46 * math.random()) * scale
  p:put(ellipse(x, y, (20 + 60 * math.random()) * scale, 2.4 * scale), {["french ultramarine"] = 0.4, ["burnt umber"] = 0.15})
end
p:step(steps // 3)
p:put(text("Lutetia", {size = 128 * scale, x = w * 0.64, y = h * 0.86, align = "center"}),
  {water = 0.35, ["french ultramarine"] = 0.9, ["burnt umber"] = 0.5})
p:step(steps)
p:dry()

-- the masking fluid comes off, and the reeds are tinted
p:unresist(reeds)
p:seal()
p:put(reeds, {["hansa yellow"] = 0.5, ["burnt umber"] = 0.25})
p:frame("marsh.png")
