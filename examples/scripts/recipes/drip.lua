-- drip.lua - a word so wet that it runs down a board that leans.
local scale, steps = param("scale", 1), param("steps", 1100)
local function px(n) return math.floor(n * scale) end
local green, blue = "phthalo green", "french ultramarine"

local p = paper{width = px(560), height = px(380), stock = "hot press", pigments = {green, blue}}
p:tilt(20)
p:type("runs", {size = px(210), x = px(280), y = px(170), align = "center"}, {water = 2.4, [green] = 0.35, [blue] = 0.5})
p:step(steps)
p:dry()
p:frame("recipe-drip.png")
