-- page.lua - a page of type printed around a puddle on paper that is still wet: beside the puddle the ink runs.
--
--     lutetia run examples/scripts/page.lua [scale=1] [steps=40]
local scale = param("scale", 1)
local steps = param("steps", 40)
local w, h = math.floor(640 * scale), math.floor(560 * scale)

local words = [[
# The puddle

In the yard of the printing house the rain had left a *puddle* that no broom could move. The apprentices laid their sheets
around it to dry, and each morning one of them had drunk of it: its letters stood in their lines as they had been set,
but toward the water they grew soft at first, then wide, and at last they were no letters any more.

The master held such a sheet against the window for a long time. "Nothing is wrong with it," he said. "It has only begun
to read itself aloud." He had it framed, and hung it over the case with the italics, where it kept on drying for years.

Visitors took the round white place for the moon. Only the apprentices knew better; for them it remained what it had been,
a hole in the weather through which the paper had looked out.]]

local cx, cy, r = 0.64 * w, 0.33 * h, 0.15 * w
local round = {}
for i = 1, 24 do
  local a = 2 * math.pi * i / 24
  round[i] = {cx + r * math.cos(a), cy + r * math.sin(a)}
end
local type_on_it, pages = page(words, {width = w, height = h, size = 21 * scale, margin = 48 * scale, hyphenate = true,
                                       language = "en", protrude = 1, around = round})
print(("%d page%s"):format(pages, pages == 1 and "" or "s"))

local p = paper{width = w, height = h, stock = "cold press", seed = 21,
  pigments = {"french ultramarine", "burnt umber", "cerulean blue"}}
p:put(ellipse(cx, cy, 1.3 * r), {water = 1.5, ["cerulean blue"] = 0.06})
p:step(math.floor(steps / 8))
p:put(type_on_it, {water = 0.12, ["french ultramarine"] = 0.5, ["burnt umber"] = 0.6})
p:step(steps)
p:dry()
p:frame("page.png")
