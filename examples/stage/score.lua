-- A score: a row of numbers is played, each beat tightens the word for a moment, and it sounds.
-- stage: spring rhythm --preset pendulum --set tack=ends --at 0,2.6 --set drag=1.6 --set show_masses=off --set show_springs=on --set floor_on=off --view -0.8,0.5,5.4,4.9 --seconds 10
-- loop: --settle 24 --seconds 4.8

local score = {9, 0, 5, 0, 7, 5, 0, 3} -- how hard, 0 to 9; one after the other
local beat = param("beat", 0.3)        -- seconds

function frame(now)
  local time = now + 1e-6
  local strength = score[1 + math.floor(time / beat) % #score] / 9
  local since = time % beat / beat
  local hit = strength * math.exp(-4 * since)
  set("stiffness", 0.6 + 5 * hit)
  set("gravity", 9.81 - 75 * hit)
end
