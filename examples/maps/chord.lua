-- A chord tightens a word, the pedal lets it hang, the wheel turns gravity.
--
--   lutetia spring chord --preset heavy --map examples/maps/chord.lua
--   lutetia spring chord --preset heavy --map examples/maps/chord.lua --song chord.mid --video chord.mp4

local loose, tight = param("loose", 120), param("tight", 4000) -- kg/s2, of the springs
local held, count, stiffness = {}, 0, loose

local function note(key, down)
  if down ~= (held[key] or false) then count = count + (down and 1 or -1) end
  held[key] = down
end

function message(m)
  if m.kind == "note-on" then note(m.note, true)
  elseif m.kind == "note-off" then note(m.note, false)
  elseif m.kind == "bend" then set("gravity", 9.81 * (1 - m.value))
  elseif m.kind == "control" and m.control == 64 then set("gravity", m.value >= 0.5 and 0 or 9.81)
  end
end

-- Each key that is held makes the word twice as stiff, over a few pictures.
function frame()
  local wanted = math.min(tight, loose * 2 ^ count)
  stiffness = stiffness + 0.3 * (wanted - stiffness)
  set("side", stiffness)
  set("diagonal", 0.75 * stiffness)
  set("link", stiffness)
end
