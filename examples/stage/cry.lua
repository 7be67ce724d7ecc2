-- A cry: it is drawn in, swells and trembles, and shrinks to nothing.
-- stage: spring Aaagh --preset jelly --at 0,1.2 --set gravity=0 --set floor_on=off --set damping=4 --set side=2400 --set diagonal=2000 --set link=2400 --set show_masses=off --set show_springs=off --theme dark --view -2,-1.2,6,4 --seconds 6
-- loop: --settle 24 --seconds 12

local every = param("every", 6) -- seconds

local function eased(from, to, part)
  part = math.min(1, math.max(0, part))
  return from + (to - from) * part * part * (3 - 2 * part)
end

function frame(now)
  local time = (now + 1e-6) % every
  if time < 1.2 then set("rest", eased(now < every and 1 or 0.05, 0.75, time / 1.2))
  elseif time < 2 then set("rest", eased(0.75, 1.8, (time - 1.2) / 0.5))
  else set("rest", eased(1.8, 0.05, (time - 2) / 3.5)) end
  local loud = time > 1.2 and math.exp(-0.9 * (time - 1.2)) or 0
  -- an odd number of waves in two cries: where one is blown the next comes back from
  set("wind_x", 14 * loud * math.sin(117 * math.pi * now / every))
  set("wind_y", 14 * loud * math.sin(89 * math.pi * now / every))
  set("drag", 0.3 + 2 * loud)
  set("skins", math.floor(6 * loud))
end
