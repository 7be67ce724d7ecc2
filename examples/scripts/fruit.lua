-- fruit.lua - a picture separated into pigments: oranges and a plum, lit by a window. Each colour becomes amounts of six pigments,
-- which are printed on wet paper and bleed a little.
--
--     lutetia run examples/scripts/fruit.lua [scale=0.5] [steps=90]
local scale = param("scale", 1)
local steps = param("steps", 90)
local w, h = math.floor(640 * scale), math.floor(480 * scale)

-- The picture: balls on a table, with one light, its sky, and shadows.
local balls = {
  {x = 0.36, y = 0.58, r = 0.235, color = {0.95, 0.50, 0.08}, pores = 0.11},
  {x = 0.66, y = 0.62, r = 0.195, color = {0.98, 0.62, 0.10}, pores = 0.09},
  {x = 0.545, y = 0.735, r = 0.125, color = {0.36, 0.14, 0.38}},
}
local light = {-0.55, -0.68, 0.48}
local ratio = w / h
local function clamp(v) return v < 0 and 0 or v > 1 and 1 or v end
-- Pores of a peel: one at a random place in each square of its skin. Any sum of waves would be visible as waves.
local pores = {}
for i = 0, 64 * 64 - 1 do pores[i] = {math.random(), math.random(), 0.25 + 0.3 * math.random()} end
local function pitted(u, v, n)
  local a, b = math.atan(u, n) * 19, math.asin(clamp(0.5 + v / 2) * 2 - 1) * 19
  local i, j, depth = math.floor(a), math.floor(b), 0
  for y = j - 1, j + 1 do
    for x = i - 1, i + 1 do
      local pore = pores[(y % 64) * 64 + x % 64]
      local dx, dy = x + pore[1] - a, y + pore[2] - b
      depth = math.max(depth, 1 - (dx * dx + dy * dy) / (pore[3] * pore[3]))
    end
  end
  return depth
end
local function shade(px, py)
  local x, y = px / w, py / h
  local best, bz
  for _, ball in ipairs(balls) do
    local u, v = (x - ball.x) * ratio / (ball.r * ratio), (y - ball.y) / (ball.r * ratio)
    local z = 1 - u * u - v * v
    if z > 0 and (not bz or ball.y + 0.3 * ball.r * math.sqrt(z) > bz) then
      best, bz = {ball, u, v, math.sqrt(z)}, ball.y + 0.3 * ball.r * math.sqrt(z)
    end
  end
  if best then
    local ball, u, v, n = best[1], best[2], best[3], best[4]
    local lit = u * light[1] + v * light[2] + n * light[3]
    local direct = lit > 0 and lit or 0
    local shine = math.max(0, 2 * lit * n - light[3]) ^ 26
    local bounce = math.max(0, v) * 0.20
    local peel = ball.pores and 1.03 - ball.pores * pitted(u, v, n) or 1
    local out = {}
    for c = 1, 3 do
      out[c] = clamp((ball.color[c] * (0.20 + 0.92 * direct) + bounce * ({0.55, 0.40, 0.30})[c]) * peel + 0.75 * shine)
    end
    return out[1], out[2], out[3]
  end
  local r, g, b
  if y > 0.66 then  -- the table, in a warm light that fades away from the window
    local fade = 1 - 0.35 * x - 0.3 * (y - 0.66)
    r, g, b = 0.90 * fade, 0.80 * fade, 0.66 * fade
  else
    local fade = 0.62 + 0.33 * math.exp(-3 * (x * x + (y - 0.2) ^ 2))
    r, g, b = 0.72 * fade, 0.80 * fade, 0.88 * fade
  end
  for _, ball in ipairs(balls) do  -- shadows fall to the right
    local u, v = (x - ball.x - 0.75 * ball.r) / (1.25 * ball.r), (y - ball.y - ball.r * ratio * 0.94) / (0.30 * ball.r * ratio)
    local depth = 0.62 * math.exp(-1.4 * (u * u + v * v) ^ 1.5)
    if y > 0.66 then r, g, b = r * (1 - depth), g * (1 - 0.95 * depth), b * (1 - 0.8 * depth) end
  end
  return r, g, b
end

local p = paper{
  width = w + math.floor(60 * scale), height = h + math.floor(60 * scale), stock = "cold press", seed = 8, grain = math.max(1, 6 * scale),
  pigments = {"hansa yellow", "cadmium red", "quinacridone rose", "french ultramarine", "cerulean blue", "burnt umber"},
}
p:air{humidity = 0.0015, settling = 0.25, edge = 10, edge_width = math.max(1, 6 * scale), absorption = 0.04}
local m = 30 * scale
local ragged = {}
for i = 0, 159 do  -- the edge of a painted field
  local t, n = i / 40, (math.random() - 0.5) * 10 * scale
  local side, u = math.floor(t), t % 1
  ragged[#ragged + 1] = side == 0 and {m + u * w, m + n} or side == 1 and {m + w + n, m + u * h} or side == 2 and {m + w - u * w, m + h + n} or {m + n, m + h - u * h}
end
p:separate(picture(w, h, shade), {x = math.floor(m), y = math.floor(m), water = 0.45, thrift = 0.25, mask = polygon(ragged)})
p:step(steps)
p:dry()
p:frame("fruit.png")
