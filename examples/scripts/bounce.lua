-- bounce.lua - letters print themselves on wet paper: each clank presses the word into the sheet, a louder one with more water.
--
--     lutetia run examples/scripts/bounce.lua [scale=1] [steps=12] [word=bounce]
local scale = param("scale", 1)
local steps = param("steps", 12)
local word = param("word", "bounce")
local w, h = math.floor(960 * scale), math.floor(420 * scale)
local unit = 130 * scale

local s = spring.word{text = word, x = 0, y = 1.6, side = 800, diagonal = 700, link = 700,
  damping_ratio = 0.05, restitution = 0.8, friction = 0.02}
for i = 1, s:masses() do                          -- thrown to the right, turning
  s:set_mass(i, "vx", 1.7)
  local _, y = s:place(i)
  s:set_mass(i, "vy", 0.8 * (i / s:masses()) + y - 2)
end
local p = paper{width = w, height = h, stock = "cold press", seed = 9,
  pigments = {"indian red", "french ultramarine"}}
p:wash{water = 0.35}

local loud, shown, pressed = 0, -1, 0
s:on(function(e) if e.kind == "clank" then loud = math.max(loud, e.velocity) end end)
for i = 1, 600 do
  s:step()
  if loud > 40 and s:time() - shown > 0.12 then
    shown, pressed = s:time(), pressed + 1
    p:put(s:mask{scale = unit, x = 20 * scale, y = h - 30 * scale},
      {water = 0.1 + loud / 300, [pressed % 2 == 0 and "indian red" or "french ultramarine"] = 0.1 + loud / 400})
    p:step(steps)
  end
  if i % 12 == 0 then loud = 0 end
end
p:put(s:mask{scale = unit, x = 20 * scale, y = h - 30 * scale}, {water = 0.1, ["indian red"] = 0.9})
p:step(steps)
p:dry()
p:frame("bounce.png")
