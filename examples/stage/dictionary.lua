-- A dictionary: entries grow letter by letter out of the letters that they share.
-- stage: spring s --preset stiff --at 0,1.4 --set side=900 --set link=900 --set damping=4 --set show_masses=off --set show_springs=off --view -0.4,-0.3,6.2,3 --seconds 12
-- loop: --settle 16.7 --seconds 7.8

local entries = {"spring", "springe", "springer", "springy", "sprinkle", "sprint", "sprite"}
local letter, pause = param("letter", 0.2), param("pause", 0.8) -- seconds
local seen, whole, now = {}, 0, "s" -- what is seen from when on, and until when

local before = entries[#entries]
for _, entry in ipairs(entries) do
  local length = 1
  while length < #entry and entry:sub(1, length + 1) == before:sub(1, length + 1) do length = length + 1 end
  for n = length, #entry do
    seen[#seen + 1] = {from = whole, word = entry:sub(1, n)}
    whole = whole + (n < #entry and letter or pause)
  end
  before = entry
end

function frame(time)
  local part, word = (time - letter) % whole + 1e-6, "s"
  for _, one in ipairs(seen) do
    if time > letter and part >= one.from then word = one.word end
  end
  if word ~= now then
    now = word
    text(word)
  end
end
