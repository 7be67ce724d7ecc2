-- Effects of flowing water: a picture of each, or of one: what=backrun.
-- All but the ink are on one kind of paper, and all in the same air: only water, pigment, gravity and time differ.

local scale, what, most = param("scale", 1), param("what", "all"), param("steps", 2000)
local side = math.floor(256 * scale)
local blue, rose, umber = "french ultramarine", "quinacridone rose", "burnt umber"
local middle = side / 2

local function sheet(stock)
  return paper{width = side, height = side, seed = 7, stock = stock or "cold press",
               pigments = {blue, rose, umber}}
end

local everywhere = rect(0, 0, side, side)
local effects = {}

-- Clean water in a damp wash pushes the pigment before it, into lobes with a dark edge.
function effects.backrun(p)
  p:put(everywhere, {water = 0.3, [blue] = 0.5, [rose] = 0.1})
  p:step(math.min(most, 300))
  p:put(ellipse(middle, middle, 22 * scale), {water = 4})
  p:step(math.min(most, 700))
end

-- A drop of colour in clean water spreads with the water.
function effects.drop(p)
  p:put(everywhere, {water = 0.6})
  p:put(ellipse(middle - 30 * scale, middle, 20 * scale), {water = 2, [rose] = 1.6})
  p:put(ellipse(middle + 40 * scale, middle + 10 * scale, 16 * scale), {water = 2, [blue] = 1.6})
  p:step(math.min(most, 500))
end

-- Wet letters that touch.
function effects.letters(p)
  local size = 150 * scale
  p:put(text("a", {size = size, x = 44 * scale, y = 180 * scale}), {water = 0.9, [blue] = 0.8})
  p:put(text("e", {size = size, x = 97 * scale, y = 180 * scale}), {water = 0.9, [rose] = 0.9})
  p:put(text("o", {size = size, x = 143 * scale, y = 180 * scale}), {water = 0.9, [umber] = 0.5})
  p:step(math.min(most, 500))
end

-- A wet band on a board that leans.
function effects.drips(p)
  p:air{gravity = {0, 0.2}}
  p:put(rect(20 * scale, 20 * scale, 216 * scale, 50 * scale), {water = 1.5, [blue] = 0.7, [umber] = 0.2})
  p:step(math.min(most, 1100))
end

-- A puddle that dries from its edge.
function effects.edge(p)
  p:put(ellipse(middle, middle, 95 * scale, 80 * scale), {water = 0.6, [rose] = 0.5, [blue] = 0.2})
  p:step(math.min(most, 1500))
end

-- Ink on paper without sizing.
function effects.ink(p)
  p:air{humidity = 0.0001}
  p:put(text("R", {size = 150 * scale, x = middle - 50 * scale, y = middle + 50 * scale}), {water = 1.2, [blue] = 0.8, [umber] = 1})
  p:step(math.min(most, 1500))
end

for _, name in ipairs{"backrun", "drop", "letters", "drips", "edge", "ink"} do
  if what == "all" or what == name then
    local p = sheet(name == "ink" and "blotting" or nil)
    effects[name](p)
    p:frame("water-" .. name .. ".png", {bits = 8})
    p:close()
  end
end
