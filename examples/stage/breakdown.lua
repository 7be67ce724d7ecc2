-- A word stands, trembles, and breaks down.
-- stage: spring breakdown --preset breakdown --set gravity=0 --set show_masses=off --set show_springs=off --view -1,-0.4,7.2,3.4 --seconds 9

local quiet, shaken = 2, 4          -- seconds: until it trembles, until it falls

function frame(time)
  if time < quiet then return end
  if time < shaken then
    local much = (time - quiet) / (shaken - quiet)
    set("wind_x", 26 * much * math.sin(40 * time))
    set("drag", 2 * much)
  else
    set("wind_x", 0)
    set("drag", 0.02)
    set("gravity", 9.81)
  end
end
