-- The spark: it leaves the lantern, flies over the valley in an arc, and bursts in the sky.
local shapes = require "demo.shapes"

local spark = {}

local rise = ease "outQuad"

--- Where it is after a share of its way, from a point to another.
local function on_arc(from, to, share)
  local u = rise(math.max(0, math.min(1, share)))
  local over = { (from[1] + 2 * to[1]) / 3, to[2] - 330 } -- the middle of the arc bends to it
  local a, b, c = (1 - u) * (1 - u), 2 * u * (1 - u), u * u
  return a * from[1] + b * over[1] + c * to[1], a * from[2] + b * over[2] + c * to[2]
end

local function flight(from, to, share)
  local tail = {}
  for i = 0, 7 do
    local x, y = on_arc(from, to, share - 0.035 * (7 - i))
    tail[i + 1] = { x, y, 1 + 2 * i }
  end
  local x, y = on_arc(from, to, share)
  return { stroke { points = tail, cap = "round", fill = "#ffd27a" },
    circle { x, y, 12, fill = "#fff6dc" } },
    { shapes.glow(x, y, 190, 1, 0.6, 0.25, 0.16) }
end

local function burst(at, age)
  local fade, sparks = math.max(0, 1 - age / 1.3), {}
  local random = celspan.random "burst"
  for i = 1, 34 do
    local turn, speed = 2.39996 * i, 220 + 460 * random(i)
    local function place(t)
      local way = speed * (1 - math.exp(-2.6 * t)) / 2.6
      return { at[1] + way * math.cos(turn), at[2] + way * math.sin(turn) + 70 * t * t }
    end
    sparks[i] = stroke { points = { place(math.max(0, age - 0.14)), place(age) },
      width = 1 + 6 * fade, cap = "round", fill = i % 3 == 0 and "#ffb35c" or "#fff0c4" }
      :fade(fade)
  end
  sparks[#sparks + 1] = circle { centre = at, radius = 40 + 760 * rise(math.min(1, age)) }
    :stroke { width = 2 + 5 * fade, fill = rgb(1, 0.8, 0.5, 0.24 * fade * fade) }
  return sparks, { shapes.glow(at[1], at[2], 500, 1, 0.72, 0.4, 0.2 * fade ^ 3) }
end

--- How bright the burst is after a time since it: the whole valley is lit by it.
function spark.flash(age)
  return age < 0 and 0 or math.exp(-5 * age)
end

--- Cels with the spark and its glow: thrown from a point at one time, and bursting at another point
--- at another time.
function spark.draw(time, from, at, thrown, bursts)
  if time < thrown or time > bursts + 1.3 then return nil end
  local art, glow
  if time < bursts then
    art, glow = flight(from, at, (time - thrown) / (bursts - thrown))
  else
    art, glow = burst(at, time - bursts)
  end
  return cel { table.unpack(art) }:with { front = { 1.3, 1.3, 1.3 } },
    cel { table.unpack(glow) }:with { front = { 7, 7, 7 } }
end

return spark
