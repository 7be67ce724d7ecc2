-- A word swings from its first letter; each time it stands still it is another word.
-- stage: spring tick --preset pendulum --set drag=0.08 --set show_masses=off --set show_springs=off --view -4.2,-0.2,4.6,6.4 --at 0,5 --seconds 12
-- loop: --settle 85 --seconds 12

local words = {"tick", "tock", "ticket", "tocsin", "ticking"}
local every, at = param("every", 2.4), 1

function frame(time)
  time = time + 1e-6
  local now = 1 + math.floor(time / every)
  if now ~= at then
    at = now
    text(words[1 + (at - 1) % #words])
  end
end
