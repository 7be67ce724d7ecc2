-- A cry: it is drawn in, swells and trembles, and shrinks to nothing.
-- stage: spring Aaagh --preset jelly --at 0,1.2 --set gravity=0 --set floor_on=off --set damping=4 --set side=2400 --set diagonal=2000 --set link=2400 --set show_masses=off --set show_springs=off --theme dark --view -2,-1.2,6,4 --seconds 6

local function eased(from, to, part)
  part = math.min(1, math.max(0, part))
  return from + (to - from) * part * part * (3 - 2 * part)
end

function frame(time)
  if time < 1.2 then set("rest", eased(1, 0.75, time / 1.2))
  elseif time < 2 then set("rest", eased(0.75, 1.8, (time - 1.2) / 0.5))
  else set("rest", eased(1.8, 0.05, (time - 2) / 3.5)) end
  local loud = time > 1.2 and math.exp(-0.9 * (time - 1.2)) or 0
  set("wind_x", 14 * loud * math.sin(61 * time))
  set("wind_y", 14 * loud * math.sin(47 * time))
  set("drag", 0.3 + 2 * loud)
  set("skins", math.floor(6 * loud))
end
