-- Where the letters have been stays to be seen, as they are thrown about.
-- stage: spring wake --preset jelly --set side=6000 --set diagonal=5000 --set link=4000 --theme dark --turn 8 --at 0,2 --set restitution=0.8 --set skins=12 --set skin_every=0.06 --set collide=on --set show_masses=off --set show_springs=off --view -1.8,-0.3,5.3,3.9 --set left_on=on --set left=-1.5 --set right_on=on --set right=5 --seconds 8
-- loop: --settle 23.9 --seconds 4

function frame(time)
  time = time + 1e-6
  local kick = time % 2 < 0.1 and time > 0.5
  local way = math.floor(time / 2) % 2 == 0 and 1 or -1
  set("gravity", kick and -50 or 9.81)
  set("wind_x", way * (kick and 60 or 6))
  set("drag", kick and 0.5 or 0.8)
end
