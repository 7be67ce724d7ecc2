-- A chord of letters: three stacked lines swing against each other, slower and slower.
-- stage: spring "do\nmi\nsol" --preset curtain --set side=3000 --set diagonal=3000 --set link=2500 --set hang=25 --set brace=crossed --set carry=0 --set show_masses=off --set show_springs=off --seconds 10

local ratio = {1, 5 / 4, 3 / 2} -- a major third and a fifth

function frame(time)
  local swing = 0
  for _, r in ipairs(ratio) do swing = swing + math.sin(3 * r * time) end
  set("wind_x", 1.5 * swing * math.exp(-0.1 * time))
  set("drag", 0.3)
end
