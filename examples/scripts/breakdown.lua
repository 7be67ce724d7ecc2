-- breakdown.lua - a word hangs by links that are too weak for it. Where a link snaps, a drop of red falls on the paper.
--
--     lutetia run examples/scripts/breakdown.lua [scale=1] [steps=30] [word=breakdown]
local scale = param("scale", 1)
local steps = param("steps", 30)
local word = param("word", "breakdown")
local w, h = math.floor(900 * scale), math.floor(560 * scale)
local unit = 120 * scale                          -- fibers to an em

local s = spring.word{text = word, preset = "breakdown", x = 0, y = 3.2, left_on = true, left = -0.9,
  right_on = true, right = 6.4}
local p = paper{width = w, height = h, stock = "hot press", seed = 7,
  pigments = {"french ultramarine", "quinacridone rose"}}
local at = {scale = unit, x = 0.95 * unit, y = h - 0.4 * unit}

s:collide(true)
s:on(function(e)
  if e.kind == "snap" then
    p:put(ellipse(at.x + unit * e.x, at.y - unit * e.y, 6 * scale):soften(2 * scale),
      {water = 0.8, ["quinacridone rose"] = 0.9})
  end
end)

-- Prints the word with little ink at each moment, and with much ink where it lies in the end.
for i = 1, 9 do
  p:put(s:mask(at), {water = 0.02 + 0.01 * i, ["french ultramarine"] = 0.02 + 0.006 * i})
  s:step(48)
end
s:step(720)
p:put(s:mask(at), {water = 0.3, ["french ultramarine"] = 0.8})
p:step(steps)
p:dry()
p:frame("breakdown.png")
