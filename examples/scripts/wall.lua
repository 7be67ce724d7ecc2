-- wall.lua - four compositions: wall-hills.png, wall-ampersands.png, wall-circle.png, wall-runs.png, or one of them: what=circle.
--
--     lutetia run examples/scripts/wall.lua [scale=1] [steps=900] [what=all]
local scale, most, what = param("scale", 1), param("steps", 900), param("what", "all")
local function px(n) return math.floor(n * scale) end
local blue, rose, umber, green, yellow = "french ultramarine", "quinacridone rose", "burnt umber", "phthalo green", "hansa yellow"
local function steps(p, n) p:step(math.min(n, most)) end
local works = {}

-- Five ranges of hills, each a glaze that fades into the mist below it, over the edges of a handmade sheet.
function works.hills()
  local p = paper{width = px(560), height = px(380), stock = "cold press", seed = 3, pigments = {blue, umber, green, yellow, rose},
    deckle = {margin = 22 * scale, waves = 2.5 * scale, thin = 14 * scale, fringe = 5 * scale}}
  p:wash({water = 0.45, [blue] = 0.3}, {from = {0, px(10)}, to = {0, px(210)}, into = {water = 0.45, [rose] = 0.16, [yellow] = 0.25}})
  steps(p, 350)
  p:seal()
  for range = 1, 5 do
    local top, corners = 90 + range * 46, {}
    local a, b, c = math.random() * 6, math.random() * 6, math.random() * 6
    for x = -20, 580, 6 do
      local y = top + 26 * math.sin(x / 97 + a) + 11 * math.sin(x / 41 + b) + 4 * math.sin(x / 13 + c) + 3 * (math.random() - 0.5)
      corners[#corners + 1] = {px(x), px(y)}
    end
    corners[#corners + 1] = {px(580), px(400)}
    corners[#corners + 1] = {px(-20), px(400)}
    local strength = 0.1 + 0.11 * range
    p:wash({water = 0.5, [blue] = strength * 1.2, [umber] = strength * 0.5, [green] = 0.03 * range},
      {from = {0, px(top - 20)}, to = {0, px(top + 120)}, into = {water = 0.6, [blue] = 0.03, [rose] = 0.02}, mask = polygon(corners)})
    steps(p, 260)
    p:seal()
  end
  return p
end

-- Twelve ampersands, each in two colours that meet where they are wet.
function works.ampersands()
  local p = paper{width = px(420), height = px(520), stock = "hot press", seed = 5, pigments = {blue, rose, umber, green, yellow}}
  local inks = {blue, rose, yellow, green, umber}
  for i = 0, 11 do
    local x, y = px(76 + i % 3 * 134), px(128 + i // 3 * 122)
    local sign = text("&", {size = px(132), x = x, y = y, align = "center"})
    local cut = px(76 + i % 3 * 134) + px((i * 5) % 3 * 14 - 14)
    p:put(sign * rect(0, 0, cut, px(520)), {water = 1.1, [inks[i % 5 + 1]] = 0.9})
    p:put(sign * rect(cut, 0, px(420) - cut, px(520)), {water = 1.1, [inks[(i * 2 + 2) % 5 + 1]] = 0.9})
  end
  steps(p, 600)
  return p
end

-- A circle by one stroke of ink on unsized paper, and a seal.
function works.circle()
  local ink = {name = "ink", white = {0.13, 0.12, 0.12}, black = {0.012, 0.011, 0.011}, weight = {0.5, 0.5}, density = 0.01, staining = 20}
  local p = paper{width = px(420), height = px(520), stock = "xuan", seed = 11, pigments = {ink, "cadmium red"}}
  local b = p:brush{kind = "bristle", width = px(54), follows = true, reach = 1100 * scale}
  b:dip{water = 0.9, ink = 1.2}
  local points = {}
  for i = 0, 24 do
    local a = math.rad(112 + i * 14)
    points[#points + 1] = {px(208 + (136 + i * 0.5) * math.cos(a)), px(226 + (140 - i * 0.4) * math.sin(a))}
  end
  p:stroke{brush = b, points = points, pressure = {0.95, 0.8, 0.75, 0.6, 0.35}, speed = 560 * scale}
  steps(p, 700)
  p:seal()
  local seal = rect(px(334), px(436), px(44), px(44))
  p:put(seal - text("L", {size = px(44), x = px(356), y = px(473), align = "center"}), {water = 0.25, ["cadmium red"] = 1.3})
  steps(p, 60)
  return p
end

-- A word too wet for a board that leans, first to the left, then to the right.
function works.runs()
  local p = paper{width = px(420), height = px(500), stock = "hot press", seed = 8, pigments = {blue, rose, green}}
  p:air{gravity = {-0.05, 0.2}}
  p:type("Paris", {size = px(176), x = px(210), y = px(190), align = "center"}, {water = 3, [blue] = 0.7, [rose] = 0.5})
  steps(p, 450)
  p:put(rect(px(40), px(60), px(330), px(60)) * text("Paris", {size = px(176), x = px(210), y = px(190), align = "center"}), {water = 1.5, [green] = 0.5})
  p:air{gravity = {0.05, 0.2}}
  steps(p, 900)
  return p
end

for _, name in ipairs{"hills", "ampersands", "circle", "runs"} do
  if what == "all" or what == name then
    local p = works[name]()
    p:dry()
    p:frame("wall-" .. name .. ".png")
    p:close()
  end
end
