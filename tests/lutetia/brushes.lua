-- brushes.lua - brushes and techniques in scripts: their effects, and one line for each error. Run by `lutetia run`.
local p = paper{width = 48, height = 32, pigments = {"quinacridone rose", "phthalo green"}, model = {"infused"}, seed = 3}
local b = p:brush{width = 6, bristles = 24, reach = 60}
local checks = 0

local function same(what, found, wanted)
  checks = checks + 1
  if found ~= wanted then error(("%s is %s, not %s"):format(what, tostring(found), tostring(wanted)), 2) end
end
local function held(what) return p:total(what) + b:holds(what) + (what == "water" and p:total("dried") or 0) end

-- strokes with every form of path lose nothing
b:dip{water = 1, ["quinacridone rose"] = 0.5}
b:dip({water = 0.5, ["phthalo green"] = 1}, {part = 0.5, side = {-1, 0}})
local water, rose, green = held("water"), held("quinacridone rose"), held("phthalo green")
local before = p:total("quinacridone rose")
p:stroke{brush = b, points = {{4, 5}, {20, 9}, {40, 5}}, pace = 0}
p:stroke{brush = b, points = {{4, 12, 0.9, 0}, {40, 15, 0.4, 0.3}}, pace = 10}
p:stroke{brush = b, path = "M4 20C14 10 24 30 40 20M5 25h30", pressure = {0.2, 1, 0.3}, pace = 0}
p:stroke{brush = b, svg = "brushes.svg", x = 10, y = 2, scale = 0.5, rotate = 90, pace = 0}
p:stroke{brush = b, file = "brushes.csv", pace = 0}
p:stroke{brush = b, way = function(t) return 5 + 30 * t, 28, 0.5 + 0.4 * t end, seconds = 1, pace = 3}
p:stroke{brush = b, points = {{10, 10}}, pressure = function(u) return 1 - u end, pace = 0}
same("water", held("water"), water)
same("rose", held("quinacridone rose"), rose)
same("green", held("phthalo green"), green)
assert(p:total("quinacridone rose") > before and b:holds("water") < 1e9)
same("steps", p.steps, 6)
b:wipe()
same("what a cloth leaves", b:holds("phthalo green"), 0)
b:rinse(0.5)
same("clean water", b:holds("quinacridone rose"), 0)

-- paths as lists
local lines = path("M1 2L3 4M0 0h5")
same("lines", #lines, 2)
same("a corner", lines[1][2][2], 4)
same("paths of a file", #svg("brushes.svg"), 2)

-- techniques
p:wash({water = 0.1}, {mask = rect(0, 0, 10, 10)})
p:wash({water = 0.1, ["phthalo green"] = 0}, {from = {0, 0}, to = {0, 32}, into = {water = 0.1, ["phthalo green"] = 1}})
p:splatter({x = 20, y = 16, radius = 8, drops = 20, size = {0.5, 1.5}, seed = 2}, {water = 0.2, ["quinacridone rose"] = 1})
p:salt{grains = 5, size = {0.5, 1}, mask = ellipse(20, 16, 10)}
p:lift(rect(0, 0, 5, 5), 0.5)
p:varnish(rect(10, 10, 12, 12), 0.8)
same("varnish", math.floor(p:at("varnish", 15, 15) * 100 + 0.5), 80)
local shown = p:picture()
same("a picture's width", shown:size(), 48)
local rows = picture(4, 2, function(x, y) return 1 - 0.2 * x, 0.6, 0.5 + 0.3 * y end)
before = p:total("quinacridone rose")
p:separate(rows, {x = 4, y = 4, width = 20, height = 10, pigments = {"quinacridone rose"}, water = 0.1})
assert(p:total("quinacridone rose") > before)

-- errors
local function wrong(said, f, ...)
  checks = checks + 1
  local ok, text = pcall(f, ...)
  if ok or not tostring(text):find(said, 1, true) then error(("wanted '%s', got %s"):format(said, tostring(text)), 2) end
end
local other = paper{width = 16, height = 16, pigments = {"cyan"}, model = {"infused"}}
wrong("brush has no 'widht'", p.brush, p, {widht = 3})
wrong("brush width must be 1..1000 (got -3)", p.brush, p, {width = -3})
wrong("brush kind must be one of round, flat", p.brush, p, {kind = "broom"})
wrong("brush bristles must be 1..512 (got 2.5)", p.brush, p, {bristles = 2.5})
wrong("the thesis's paper takes no brush", function() paper{width = 8, height = 8, model = "thesis"}:brush{} end)
wrong("this paper has no pigment 'soot'", b.dip, b, {soot = 1})
wrong("it takes water, ", b.dip, b, {watr = 1})
wrong("the amount of water in a brush must be 0..1 (got 2)", b.dip, b, {water = 2})
wrong("dip part must be 0..1 (got 7)", b.dip, b, {}, {part = 7})
wrong("stroke brush must be a brush of this paper (got a nil)", p.stroke, p, {points = {{1, 1}}})
wrong("of another", other.stroke, other, {brush = b, points = {{1, 1}}})
wrong("one of points, path, svg, file, way (got 0)", p.stroke, p, {brush = b})
wrong("one of points, path, svg, file, way (got 2)", p.stroke, p, {brush = b, points = {{1, 1}}, path = "M0 0"})
wrong("path, character 6: a number is wanted", p.stroke, p, {brush = b, path = "M0 0Lx"})
wrong("stroke point 2 must be {x, y", p.stroke, p, {brush = b, points = {{1, 1}, 5}})
wrong("stroke point 1 must have 2..6 numbers (got 1)", p.stroke, p, {brush = b, points = {{1}}})
wrong("all points of a stroke have seconds, or none (got 1 of 2)", p.stroke, p, {brush = b, points = {{1, 1, 1, 0}, {2, 2}}})
wrong("times must ascend", p.stroke, p, {brush = b, points = {{1, 1, 1, 1}, {2, 2, 1, 1}}})
wrong("stroke pressure must be 0..1 (got 3)", p.stroke, p, {brush = b, points = {{1, 1}, {2, 2}}, pressure = 3})
wrong("a stroke's x must be", p.stroke, p, {brush = b, way = function() return "here", 1 end})
wrong("no-such.svg", p.stroke, p, {brush = b, svg = "no-such.svg"})
wrong("must be in the folder given", p.stroke, p, {brush = b, file = "../brushes.csv"})
wrong("brushes.lua:1: syntax error", svg, "brushes.lua")
wrong("brushes.svg:1: ", p.stroke, p, {brush = b, file = "brushes.svg"})
wrong("at most 100000 steps", p.stroke, p, {brush = b, points = {{1, 1, 1, 0}, {2, 2, 1, 99999}}, pace = 9999})
wrong("salt grains must be 1..100000 (got 0)", p.salt, p, {grains = 0})
wrong("salt size must be {least, most}", p.salt, p, {size = {2, 1}})
wrong("splatter drops must be", p.splatter, p, {drops = -1}, {})
wrong("a graded wash needs from, to and into", p.wash, p, {water = 1}, {from = {0, 0}})
wrong("lift's part must be 0..1 (got 2)", p.lift, p, rect(0, 0, 1, 1), 2)
wrong("varnish's amount must be 0..1 (got -1)", p.varnish, p, rect(0, 0, 1, 1), -1)
wrong("separate most must be 0.01..4 (got 0)", p.separate, p, rows, {most = 0})
wrong("this paper has no pigment 'cyan'", p.separate, p, rows, {pigments = {"cyan"}})
wrong("picture's width must be 1..16384 (got 0)", picture, 0, 1, print)
wrong("no-such.png", picture, "no-such.png")
for i = 2, 8 do p:brush{width = 2, bristles = 1} end
wrong("a paper has up to 8 brushes", p.brush, p, {})
p:brush{number = 1, width = 4, bristles = 5}
p:close()
wrong("this paper is closed", b.dip, b, {water = 1})
print(checks .. " checks")
