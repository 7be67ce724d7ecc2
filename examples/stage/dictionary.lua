-- A dictionary: entries grow letter by letter out of the letters that they share.
-- stage: spring s --preset stiff --at 0,1.4 --set side=900 --set link=900 --set damping=4 --set show_masses=off --set show_springs=off --view -0.4,-0.3,6.2,3 --seconds 12

local entries = {"spring", "springe", "springer", "springy", "sprinkle", "sprint", "sprite"}
local letter, pause = param("letter", 0.16), param("pause", 0.8)

local entry, length, due = 1, 1, 0.5

function frame(time)
  if time < due then return end
  local word = entries[1 + (entry - 1) % #entries]
  if length < #word then
    length, due = length + 1, time + letter
    text(word:sub(1, length))
  else
    entry, due = entry + 1, time + pause
    local next = entries[1 + (entry - 1) % #entries]
    length = 0
    while word:sub(1, length + 1) == next:sub(1, length + 1) and length < #next do length = length + 1 end
    length = math.max(1, length - 1)
  end
end
