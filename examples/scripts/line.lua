-- line.lua - a line of pigment, and water that travels from left to right: five moments, one above the other, by the thesis's
-- rule (its figure 17). Each strip gets the water that has come until its moment.
--
--     lutetia run examples/scripts/line.lua [scale=0.5] [steps=400]
local scale = param("scale", 1)
local steps = param("steps", 400)
local w, strip = math.floor(760 * scale), math.floor(150 * scale)
local moments = 5

local p = paper{width = w, height = moments * strip, model = "thesis", pigments = {"cyan", "magenta", "yellow"}, seed = 17}
p:air{humidity = 0.0006, gravity = {2, 1}}
for m = 0, moments - 1 do
  p:put(rect(20 * scale, (m + 0.5) * strip - 5 * scale, w - 40 * scale, 10 * scale), {cyan = 0.9, magenta = 0.75, yellow = 0.15})
end
for step = 0, steps - 1 do
  if step % 8 == 0 then
    local front = w * step / steps
    local poured = mask(1, 1, function() return 0 end)
    for m = 0, moments - 1 do
      if step < steps * m / (moments - 1) then
        poured = poured + rect(front - 40 * scale, m * strip + 14 * scale, 40 * scale, strip - 28 * scale)
      end
    end
    p:put(poured, {water = 1})
  end
  p:step()
end
p:frame("line.png")
p:frame("line-water.png", {show = "water"})
