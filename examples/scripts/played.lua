-- played.lua - a song paints: notes move two brushes, velocity sets their pressure, bend tilts the paper, and the wheel sets the
-- air's humidity.
--
--     lutetia run examples/scripts/played.lua [scale=1] [steps=500] [song=played.mid]
--
-- examples/scripts/played.mid is a tune of our own; `lutetia midi record` makes a file of what is played.
local scale = param("scale", 1)
local steps = param("steps", 500)
local tune = song(param("song", "played.mid"))
local w, h = math.floor(900 * scale), math.floor(420 * scale)

local p = paper{width = w, height = h, stock = "cold press", seed = 12,
  pigments = {"french ultramarine", "quinacridone rose", "hansa yellow"}}
p:wash{water = 0.15}
local brushes = {                                  -- a channel has a brush of its own
  p:brush{kind = "round", width = math.max(3, 30 * scale)},
  p:brush{kind = "mop", width = math.max(3, 46 * scale)},
}

-- A note's place: time runs to the right, higher notes are higher.
local low, high = 127, 0
for _, m in ipairs(tune) do
  if m.note then low, high = math.min(low, m.note), math.max(high, m.note) end
end
local function place(time, note)
  return w * (0.06 + 0.86 * time / tune.seconds), h * (0.85 - 0.65 * (note - low) / math.max(1, high - low))
end

local down = {}                                    -- when a key was struck, and how
local painted = 0
for _, m in ipairs(tune) do
  local due = math.floor(steps * m.time / tune.seconds)
  if due > painted then p:step(due - painted) painted = due end
  if m.kind == "bend" then
    p:air{gravity = {0.15 * m.value, 0.1 + 0.2 * math.max(0, m.value)}}
  elseif m.kind == "control" and m.control == 1 then
    p:air{humidity = 0.9 * m.value}
  elseif m.kind == "note-on" then
    down[m.channel * 128 + m.note] = {time = m.time, value = m.value}
  elseif m.kind == "poly-pressure" then
    local d = down[m.channel * 128 + m.note]
    if d then d.pressed = m.value end
  elseif m.kind == "note-off" then
    local d = down[m.channel * 128 + m.note]
    local brush = brushes[(m.channel - 1) % #brushes + 1]
    if d then
      local x0, y0 = place(d.time, m.note)
      local x1, y1 = place(m.time, m.note)
      local warm = (m.note - low) / math.max(1, high - low)
      brush:rinse(0.6)
      brush:dip{water = 0.9, ["french ultramarine"] = 1.6 * (1 - warm) * d.value,
        ["quinacridone rose"] = 1.6 * warm * d.value, ["hansa yellow"] = m.channel == 2 and 1.2 or 0.1}
      p:stroke{brush = brush, points = {{x0, y0}, {(x0 + x1) / 2, y0 - 10 * scale * d.value}, {x1, y1}},
        pressure = {0.3 * d.value, 0.2 + 0.7 * (d.pressed or d.value), 0.15}, pace = 0}
      down[m.channel * 128 + m.note] = nil
    end
  end
end
p:step(math.max(2, steps // 4))
p:dry()
p:frame("played.png")
