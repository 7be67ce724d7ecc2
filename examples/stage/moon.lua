-- Gravity goes once round the word, which falls on the floor, the wall and the ceiling.
-- stage: spring moon --preset jelly --set side=2400 --set diagonal=2000 --set link=1200 --at 0.6,1.8 --set restitution=0.55 --set left_on=on --set left=-1 --set right_on=on --set right=4.4 --set ceiling_on=on --set ceiling=4 --set collide=on --set show_masses=off --set show_springs=off --view -1.2,-0.2,4.6,4.2 --seconds 12
-- loop: --settle 60 --seconds 12

local turn = param("turn", 12) -- seconds for all of it

function frame(time)
  -- gravity pulls down or up; what pulls sideways is a strong wind in thick air
  local now = (time + 1e-6) % turn
  local angle = 2 * math.pi * now / turn
  local thick = math.max(0, now - 9.5) / (turn - 9.5) * 1
  set("gravity", 9.81 * math.cos(angle))
  set("wind_x", 12 * math.sin(angle) - thick)
  set("drag", 0.25 * math.abs(math.sin(angle)) + 0.02 + thick)
end
