-- A film of small frames, some of them repeated, to be ended anywhere: for tests/kills/kills.sh.
local celspan = require "celspan"

return celspan.film { size = { 160, 120 }, frames = 60, frame = function(f)
  local at = f.number - f.number % 7 // 6 -- the last of seven repeats the one before
  local dots = {}
  for i = 1, 40 do
    dots[i] = celspan.circle { radius = 3 + i % 9,
      centre = { 80 + 70 * math.sin(i * 2.4 + at / 9), 60 + 50 * math.cos(i * 1.7 - at / 7) },
      texture = celspan.rgb(i / 40, at / 60, 0.5, 0.8) }
  end
  return celspan.rostrum { back = "#123", celspan.cel(dots) }
end }
