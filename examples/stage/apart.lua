-- A word that is held at its ends shrinks until its letters let go of each other; then it is whole again.
-- stage: spring together --preset stiff --at 0,2.4 --set tack=ends --set gravity=2 --set drag=0.5 --set link=600 --set link_breaking=0.2 --set damping=3 --set show_masses=off --set show_springs=off --view -0.8,-0.4,5.6,4 --seconds 10
-- loop: --settle 5.5 --seconds 5

local every = param("every", 5) -- seconds
local turn = 0

function frame(time)
  local t = time % every
  if math.floor(time / every) ~= turn then
    turn = math.floor(time / every)
    text("o")        -- a word that begins otherwise, and the old one again: new springs
    text("together")
  end
  set("rest", math.max(0.45, 1.05 - 0.2 * t))
end
