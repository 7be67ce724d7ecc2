-- A chord of letters: three stacked lines swing against each other, as the parts of a chord beat.
-- stage: spring "do\nmi\nsol" --preset curtain --set side=3000 --set diagonal=3000 --set link=2500 --set hang=25 --set brace=crossed --set carry=0 --set show_masses=off --set show_springs=off --seconds 8
-- loop: --settle 24 --seconds 8

local turn = 2 * math.pi / 8 -- all of it comes again after eight seconds
local parts = {4, 5, 6}      -- a major third and a fifth

function frame(time)
  local swing = 0
  for _, n in ipairs(parts) do swing = swing + math.sin(n * turn * time) end
  set("wind_x", 1.5 * swing)
  set("drag", 0.3)
end
