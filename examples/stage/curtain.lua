-- Lines hang from each other like a curtain, and a wind goes through them.
-- stage: spring "the wind goes\nthrough these\nletters again" --preset curtain --set carry=0 --set show_masses=off --set show_springs=off --view -3,-0.5,9.5,5.8 --seconds 10
-- loop: --settle 28 --seconds 14

local hard = param("hard", 10) -- units a second
local turn = 2 * math.pi / 14 -- all of it comes again after fourteen seconds

function frame(time)
  local gust = math.sin(2 * turn * time) * math.sin(turn * time + 1)
  set("wind_x", hard * gust)
  set("wind_y", 0.3 * hard * math.sin(4 * turn * time))
  set("drag", 0.12)
end
