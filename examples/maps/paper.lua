-- Keys print letters in ink; the wheel lets them run, bend tilts the paper, the pedal dries it, and keys below the lowest c lead a brush.
--
--   lutetia keys --wet --map examples/maps/paper.lua
--   lutetia keys song.mid --wet --map examples/maps/paper.lua --video f.mp4

local lowest = param("lowest", 48)  -- notes below are the brush's
local damp = get("humidity")
local x, goal, down = 0.5, 0.5, 0

function message(m)
  if m.kind == "control" and m.control == 1 then set("gravity", 0.9 * m.value)
  elseif m.kind == "control" and m.control == 64 then set("humidity", m.value >= 0.5 and 0.02 or damp)
  elseif m.kind == "bend" then set("tilt", 0.9 * m.value)
  elseif m.kind == "note-on" and m.note < lowest then
    goal, down = (m.note % 12 + 0.5) / 12, m.value
    set("brush_y", 0.15)
  elseif m.kind == "note-off" and m.note < lowest then down = 0
  end
end

-- The brush goes to where its key is, in some pictures.
function frame()
  x = x + 0.2 * (goal - x)
  set("brush_x", x)
  set("brush_ink", 0.5 * down)
  set("brush_water", down)
end
