-- sixteen.lua - sixteen effects, each once: sixteen-wash.png and so on, or one of them: what=bloom.
--
--     lutetia run examples/scripts/sixteen.lua [scale=1] [steps=1500] [what=all]
local scale, most, what = param("scale", 1), param("steps", 1500), param("what", "all")
local function px(n) return math.floor(n * scale) end
local blue, rose, umber, green, yellow = "french ultramarine", "quinacridone rose", "burnt umber", "phthalo green", "hansa yellow"
local side = px(192)
local square = rect(px(14), px(14), px(164), px(164))
local middle = side // 2
local function disc(x, y, r) return ellipse(px(x), px(y), r * scale) end
local function steps(p, n) p:step(math.min(n, most)) end

local effects = {
  {"wash", "cold press", function(p)
    p:put(square, {water = 0.5, [blue] = 0.6}) steps(p, 500)
  end},
  {"graded", "hot press", function(p)
    p:wash({water = 0.5, [blue] = 0.9}, {from = {0, px(20)}, to = {0, px(172)}, into = {water = 0.5, [rose] = 0.35}, mask = square})
    steps(p, 500)
  end},
  {"streaks", "cold press", function(p)
    local b = p:brush{kind = "flat", width = px(52), follows = true, reach = 1400 * scale}
    for i = 0, 2 do
      b:dip({water = 1, [blue] = 0.9}, {side = {-1, 0}})
      b:dip({water = 1, [rose] = 0.8}, {side = {0, 1}})
      p:stroke{brush = b, points = {{px(18), px(42 + 52 * i)}, {px(96), px(34 + 56 * i)}, {px(174), px(44 + 52 * i)}}, pressure = 0.8,
        speed = 300 * scale}
    end
    steps(p, 200)
  end},
  {"edge", "hot press", function(p)
    p:put(disc(96, 96, 74), {water = 0.7, [rose] = 0.4, [blue] = 0.1}) steps(p, 1500)
  end},
  {"granulation", "rough", function(p)
    p:put(square, {water = 0.7, [blue] = 0.6, [umber] = 0.35}) steps(p, 900)
  end},
  {"bloom", "cold press", function(p)
    p:put(square, {water = 0.32, [blue] = 0.45, [green] = 0.25}) steps(p, 300)
    p:put(disc(76, 78, 22), {water = 4}) p:put(disc(136, 132, 13), {water = 4}) steps(p, 600)
  end},
  {"wet-in-wet", "cold press", function(p)
    p:put(square, {water = 0.6})
    p:put(disc(64, 80, 20), {water = 2, [rose] = 1.3}) p:put(disc(122, 70, 16), {water = 2, [yellow] = 1.2})
    p:put(disc(112, 126, 18), {water = 2, [blue] = 1.1}) steps(p, 500)
  end},
  {"feathering", "blotting", function(p)
    p:air{humidity = 0.0001}
    p:put(text("R", {size = px(120), x = middle, y = px(136), align = "center"}), {water = 1.3, [blue] = 0.8, [umber] = 1}) steps(p, 1500)
  end},
  {"drips", "hot press", function(p)
    p:air{gravity = {0.03, 0.4}}
    p:put(rect(px(18), px(16), px(156), px(40)), {water = 1.6, [green] = 0.4, [blue] = 0.3}) steps(p, 900)
  end},
  {"dry-brush", "rough", function(p)
    local b = p:brush{kind = "flat", width = px(46), follows = true, load = 0.2, reach = 500 * scale}
    for i = 0, 2 do
      b:dip{water = 0.4, [umber] = 1, [blue] = 0.4 * i}
      p:stroke{brush = b, points = {{px(16), px(44 + 50 * i)}, {px(96), px(36 + 54 * i)}, {px(178), px(48 + 50 * i)}},
        pressure = {0.7, 0.45, 0.2}, speed = 700 * scale}
    end
    steps(p, 150)
  end},
  {"glaze", "hot press", function(p)
    for i, s in ipairs{{yellow, 0.9}, {rose, 0.35}, {blue, 0.5}} do
      p:put(rect(px(14 + 30 * i), px(-22 + 36 * i), px(100), px(100)), {water = 0.5, [s[1]] = s[2]})
      steps(p, 250) p:seal()
    end
  end},
  {"letters", "cold press", function(p)
    p:put(text("a", {size = px(140), x = px(24), y = px(132)}), {water = 1.4, [blue] = 0.8})
    p:put(text("e", {size = px(140), x = px(66), y = px(132)}), {water = 1.4, [rose] = 0.9})
    p:put(text("o", {size = px(140), x = px(108), y = px(132)}), {water = 1.4, [umber] = 0.5}) steps(p, 500)
  end},
  {"salt", "cold press", function(p)
    p:put(square, {water = 0.6, [blue] = 0.7, [green] = 0.25}) steps(p, 60)
    p:salt{x = middle, y = middle, radius = px(90), grains = 60, size = {0.6, 1.5}, strength = 0.8, reach = math.max(1, 8 * scale), mask = square, seed = 9}
    steps(p, 300)
  end},
  {"lift", "cold press", function(p)
    p:put(square, {water = 0.5, [blue] = 0.5}) steps(p, 80)
    p:blot(ellipse(px(80), px(70), px(40), px(20)):soften(px(6)) * 0.9, 0.9, 0.8) steps(p, 250) p:dry()
    p:lift(line({{px(30), px(140), px(4)}, {px(96), px(128), px(16)}, {px(164), px(142), px(4)}}):soften(px(3)), 0.95)
  end},
  {"resist", "cold press", function(p)
    local word = text("&", {size = px(170), x = middle, y = px(146), align = "center"})
    p:resist(word)
    p:wash({water = 0.6, [rose] = 0.8}, {from = {0, 0}, to = {side, side}, into = {water = 0.6, [yellow] = 0.8}, mask = square})
    steps(p, 400) p:unresist(word)
  end},
  {"splatter", "laid", function(p)
    p:splatter({x = middle, y = middle, radius = px(66), drops = 110, size = {math.max(0.1, 0.6 * scale), math.max(1, 10 * scale)}, seed = 4},
      {water = 0.8, [rose] = 0.7, [blue] = 0.3})
    p:splatter({x = px(60), y = px(130), radius = px(30), drops = 50, size = {math.max(0.1, 0.5 * scale), math.max(1, 4 * scale)}, angle = -45,
      thrown = 1.2, seed = 5}, {water = 0.6, [blue] = 1})
    steps(p, 400)
  end}}

for _, e in ipairs(effects) do
  local name, stock, paint = table.unpack(e)
  if what == "all" or what == name then
    local p = paper{width = side, height = side, stock = stock, seed = 16, pigments = {blue, rose, umber, green, yellow}}
    paint(p)
    p:dry()
    p:frame("sixteen-" .. name .. ".png")
    p:close()
  end
end
