-- kinds.lua - the six kinds of brushes, each dipped once and used until it is dry. The second wave of each is quick and light.
--
--     lutetia run examples/scripts/kinds.lua [scale=0.5] [steps=120]
local scale = param("scale", 1)
local steps = param("steps", 120)
local w, h = math.floor(720 * scale), math.floor(470 * scale)
local p = paper{width = w, height = h, stock = "cold press", seed = 3, grain = math.max(1, 6 * scale),
  pigments = {"french ultramarine", "quinacridone rose", "burnt umber"}}
p:air{humidity = 0.001, settling = 0.2}
for i, kind in ipairs{"round", "flat", "mop", "rigger", "fan", "bristle"} do
  local b = p:brush{kind = kind, width = (kind == "rigger" and 8 or 26) * scale, follows = kind ~= "round" and kind ~= "mop", number = i}
  b:dip{water = 1, ["french ultramarine"] = 1.1, ["quinacridone rose"] = 0.15 * i, ["burnt umber"] = 0.5 - 0.08 * i}
  local y = (20 + 66 * (i - 1)) * scale
  p:stroke{brush = b, path = "M90 28C150 -12 190 76 250 30S350 -4 400 30", y = y, scale = scale, pressure = {0.15, 0.8, 0.5, 0.9, 0.3, 0.02}, speed = 420 * scale}
  p:stroke{brush = b, path = "M450 30C520 0 560 60 680 26", y = y, scale = scale, pressure = {0.6, 0.45, 0.5, 0.2}, speed = 1500 * scale}
  p:put(text(kind, {size = 19 * scale, x = 20 * scale, y = y + 34 * scale}), {["burnt umber"] = 1.2, ["french ultramarine"] = 0.8})
end
p:step(steps)
p:dry()
p:frame("kinds.png")
