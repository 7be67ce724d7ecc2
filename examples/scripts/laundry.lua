-- laundry.lua - wet words hang side by side on a clothes-line, in gusts of wind.
--
--     lutetia run examples/scripts/laundry.lua [scale=1] [steps=60]
local scale = param("scale", 1)
local steps = param("steps", 60)
local w, h = math.floor(960 * scale), math.floor(520 * scale)
local unit = 68 * scale

local s = spring.network()
local words = {"shirt\nshirt\nshirt", "towel\ntowel\ntowel\ntowel", "sock\nsock", "apron\napron\napron"}
for i, text in ipairs(words) do
  s:word{text = text, preset = "curtain", x = 3.1 * (i - 1), y = 5, floor_on = false, tack = "top"}
end
for i = 1, 480 do                                 -- two seconds of gusts
  s:set("wind_x", 7 + 5 * math.sin(i / 37) + 3 * math.sin(i / 11))
  s:set("wind_y", 2 * math.sin(i / 23))
  s:step()
end

local p = paper{width = w, height = h, stock = "cold press", seed = 3,
  pigments = {"cerulean blue", "burnt umber"}}
p:wash({water = 0.3, ["cerulean blue"] = 0.12}, {into = {water = 0.1}, from = {0, 0}, to = {0, h}})
p:step(steps)
p:dry()
p:put(line({{0, 60 * scale}, {w, 50 * scale}}, 2 * scale), {water = 0.1, ["burnt umber"] = 0.5})
p:put(s:mask{scale = unit, x = 30 * scale, y = 60 * scale + 5.75 * unit}, {water = 0.25, ["burnt umber"] = 0.7})
p:step(steps)
p:dry()
p:frame("laundry.png")
