-- A word breathes: all its springs grow longer, and shorter.
-- stage: spring breath --preset jelly --at 0,1 --set gravity=0 --set floor_on=off --set show_masses=off --set show_springs=off --set damping=6 --set drag=1 --view -0.8,-0.3,4.4,2.6 --seconds 8
-- loop: --settle 4.5 --seconds 4

local inward, outward = param("inward", 1.6), param("outward", 2.4) -- seconds
local deep = param("deep", 0.35)

function frame(time)
  local t = time % (inward + outward)
  local part = t < inward and t / inward or 1 - (t - inward) / outward
  set("rest", 1 + deep * (0.5 - 0.5 * math.cos(math.pi * part)))
end
