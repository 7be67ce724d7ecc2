-- sphere.lua - a sphere in glazes: transparent layers, each dried and sealed before the next lies on it (Kubelka-Munk).
--
--     lutetia run examples/scripts/sphere.lua [scale=0.5] [steps=120]
local scale = param("scale", 1)
local steps = param("steps", 120)
local w, h = math.floor(560 * scale), math.floor(560 * scale)
local cx, cy, r = w * 0.5, h * 0.46, 167 * scale

local p = paper{
  width = w, height = h, stock = "cold press", seed = 21, grain = math.max(2, 6 * scale),
  pigments = {"hansa yellow", "brilliant orange", "quinacridone rose", "french ultramarine", "cerulean blue", "burnt umber"},
}
p:air{humidity = 0.003, edge = 10, edge_width = 6, settling = 0.3, absorption = 0.04}
local ball = ellipse(cx, cy, r)

local function glaze(shape, inks, water)
  inks.water = water or 0.7
  p:put(shape, inks)
  p:step(steps)
  p:seal()
end

-- ground and shadow, then the ball from light to dark; each glaze leaves the lightest part of the one before uncovered
glaze(rect(0, cy + 0.45 * r, w, h):soften(10 * scale) - ball, {["cerulean blue"] = 0.22, ["burnt umber"] = 0.05})
glaze((ellipse(cx + 0.55 * r, cy + 1.02 * r, 1.15 * r, 0.20 * r):soften(8 * scale)) - ball,
  {["french ultramarine"] = 0.55, ["burnt umber"] = 0.35})
glaze(ball - ellipse(cx - 0.38 * r, cy - 0.42 * r, 0.13 * r):soften(8 * scale), {["hansa yellow"] = 0.75})
glaze(ball - ellipse(cx - 0.33 * r, cy - 0.36 * r, 0.50 * r):soften(40 * scale), {["brilliant orange"] = 0.55})
glaze(ball - ellipse(cx - 0.28 * r, cy - 0.30 * r, 0.82 * r):soften(40 * scale), {["quinacridone rose"] = 0.75})
glaze(ball - ellipse(cx - 0.22 * r, cy - 0.24 * r, 1.04 * r):soften(40 * scale), {["french ultramarine"] = 0.9, ["quinacridone rose"] = 0.3})
p:frame("sphere.png")
