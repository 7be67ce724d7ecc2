-- A word falls, bounces, comes to rest, and is thrown up again.
-- stage: spring Lutetia --preset jelly --set side=1200 --set diagonal=900 --set link=900 --set friction=0 --turn 12 --at 0.1,1.4 --set restitution=0.85 --set show_masses=off --set show_springs=off --set collide=on --view -0.7,-0.25,4.1,3 --seconds 8
-- loop: --settle 22 --seconds 4

local every = param("every", 4)     -- seconds from one throw to the next
local up = param("up", 0.08)        -- seconds that gravity is turned round for

function frame(time)
  local since = (time + 1e-6) % every
  set("gravity", time >= every - 1e-6 and since < up and -60 or 9.81)
  set("drag", since > 0.5 * every and 3 or 0.02)
end
