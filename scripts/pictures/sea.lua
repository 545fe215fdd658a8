-- The pictures that scripts/sea.lua bends: a flag and a tentacle, both straight.
--
--   celspan render scripts/pictures/sea.lua -o scripts/pictures/sea.##.png
--
-- Frame 1 is the flag, 480 by 320 pixels; frame 2 the tentacle, from left to right, 640 by 160.

--- Threads of cloth, lighter and darker.
local function weave(w, h)
  local random, threads = celspan.random "weave", {}
  for i = 1, 260 do
    local y, shade = h * random("y" .. i), random("shade" .. i) < 0.5 and "#fff" or "#000"
    threads[i] = rect { w * random("x" .. i) - 60, y, 60 + 120 * random("w" .. i), 1.2,
      fill = shade }:fade(0.05 + 0.06 * random("alpha" .. i))
  end
  return union(threads)
end

local function flag()
  local parts = { rect { 0, 0, 480, 320, fill = "#b3262e" } }
  for i = 0, 2 do
    parts[#parts + 1] = rect { 0, 46 + 92 * i, 480, 44, fill = "#f3e6cf" }
  end
  parts[#parts + 1] = circle { 200, 160, 96, fill = "#1f3550" }
  for i = 0, 7 do -- a compass rose
    local long = i % 2 == 0 and 84 or 50
    parts[#parts + 1] = polygon { { 200, 160 - long }, { 212, 148 }, { 200, 160 },
      fill = "#f3e6cf" }:rotate(45 * i, 200, 160)
    parts[#parts + 1] = polygon { { 200, 160 - long }, { 188, 148 }, { 200, 160 },
      fill = "#e0a93e" }:rotate(45 * i, 200, 160)
  end
  parts[#parts + 1] = weave(480, 320)
  return cel(parts)
end

--- Half the width of the tentacle at x.
local function half(x) return 64 * (1 - x / 640) ^ 0.8 + 3 * (x < 640 and 1 or 0) end

local function tentacle()
  local upper, lower = {}, {}
  for i = 0, 64 do
    local x = 10 * i
    upper[#upper + 1] = { x, 80 - half(x) }
    table.insert(lower, 1, { x, 80 + half(x) })
  end
  local outline = table.move(lower, 1, #lower, #upper + 1, upper)
  outline.texture = linear { from = { 0, 20 }, to = { 0, 140 }, { 0, "#7d3b6e" },
    { 0.55, "#a4507f" }, { 0.8, "#e9a58f" }, { 1, "#d98c7c" } }
  local body = polygon(outline)
  local random, marks = celspan.random "spots", { body }
  for i = 1, 90 do
    local x = 620 * random("x" .. i) ^ 1.3
    local y = 80 - half(x) + 1.1 * half(x) * random("y" .. i)
    marks[#marks + 1] = ellipse { x, y, 3 + 7 * random("r" .. i), 4,
      fill = "#582450" }:fade(0.35)
  end
  for i = 0, 15 do -- suckers, smaller towards the tip
    local x = 30 + 600 * (1 - (1 - i / 16) ^ 1.15)
    local r = 0.26 * half(x)
    marks[#marks + 1] = circle { x, 80 + 0.62 * half(x), r,
      fill = colour.lighten("#e9a58f", 0.12) }
    marks[#marks + 1] = circle { x, 80 + 0.62 * half(x), r * 0.5,
      fill = "#a85a63" }
  end
  return cel { clip(union(marks), body) }
end

return film { size = { 640, 320 }, frames = 2, frame = function(f)
  return f.number == 1 and flag() or tentacle()
end }
