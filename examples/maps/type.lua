-- The modulation wheel sets the weight of letters where the font varies, else their size; bend sets their slant; low keys let them stay.
--
--   lutetia keys --map examples/maps/type.lua --font "A variable font"

local bold = pcall(get, "weight")

function message(m)
  if m.kind == "control" and m.control == 1 then
    if bold then along("weight", m.value) else set("size", 0.5 + m.value) end
  elseif m.kind == "bend" then
    set("slant", 0.5 * m.value)
  elseif m.kind == "note-on" then
    set("release", m.note < 60 and 1.2 or 0.2)
  end
end
