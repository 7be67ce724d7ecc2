-- sumi.lua - ink on paper without sizing: three stalks, their leaves, and a mist behind them.
local scale, steps = param("scale", 1), param("steps", 700)
local function px(n) return math.floor(n * scale) end
local ink = {name = "ink", white = {0.13, 0.12, 0.12}, black = {0.012, 0.011, 0.011}, weight = {0.5, 0.5}, density = 0.01, staining = 20}

local p = paper{width = px(380), height = px(560), stock = "xuan", pigments = {ink}}
p:put(ellipse(px(210), px(400), px(150), px(46)):soften(px(30)), {water = 0.5, ink = 0.05})
local b = p:brush{kind = "round", width = px(26), reach = 3000 * scale}
for i, stalk in ipairs{{120, 540, 150, 40, 0.9}, {210, 550, 205, 20, 0.5}, {280, 545, 300, 180, 0.25}} do
  for joint = 0, 4 do
    local a, e = joint / 5 + 0.012, (joint + 1) / 5 - 0.012
    local x1, y1 = stalk[1] + (stalk[3] - stalk[1]) * a, stalk[2] + (stalk[4] - stalk[2]) * a
    local x2, y2 = stalk[1] + (stalk[3] - stalk[1]) * e, stalk[2] + (stalk[4] - stalk[2]) * e
    b:dip{water = 0.8, ink = stalk[5]}
    p:stroke{brush = b, points = {{px(x1), px(y1)}, {px((x1 + x2) / 2 + 1), px((y1 + y2) / 2)}, {px(x2), px(y2)}},
      pressure = {0.55, 0.35, 0.55}, speed = 260 * scale}
  end
end
local leaf = p:brush{kind = "round", width = px(22), reach = 800 * scale}
for i, l in ipairs{{146, 130, 70, 190}, {146, 130, 235, 176}, {140, 128, 100, 230}, {207, 100, 320, 130}, {207, 100, 290, 190},
  {290, 250, 360, 300}, {290, 250, 240, 330}, {130, 340, 60, 400}} do
  leaf:dip{water = 0.7, ink = i % 3 == 0 and 0.5 or 1.1}
  p:stroke{brush = leaf, points = {{px(l[1]), px(l[2])}, {px((l[1] + l[3]) / 2), px((l[2] + l[4]) / 2 - 10)}, {px(l[3]), px(l[4])}},
    pressure = {0.1, 0.8, 0.05}, speed = 420 * scale}
end
p:step(steps)
p:dry()
p:frame("recipe-sumi.png")
