-- Following a region through frames: processor time per frame.
--
--   LUA_CPATH=build/?.so lua5.4 tests/bench/track.lua [FRAMES]
--
-- A card of spots moves and turns over a background of spots, and is followed through pictures of
-- two sizes.
local celspan = require "celspan"
local track = require "celspan.track"
local frames = tonumber(arg[1] or 8)

local function spots(seed, count, width, height)
  local random, parts = celspan.random(seed),
    { celspan.rect { 0, 0, width, height, texture = "#777777" } }
  for i = 1, count do
    parts[#parts + 1] = celspan.circle {
      centre = { width * random("x" .. i), height * random("y" .. i) },
      radius = (2 + 6 * random("r" .. i)) * width / 240,
      texture = celspan.rgb(random("a" .. i), random("b" .. i), random("c" .. i)) }
  end
  return celspan.clip(celspan.union(parts), celspan.rect { 0, 0, width, height })
end

local function follow(width, height)
  local folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
  local scale = width / 240
  local ground, card = spots("ground", 160, width, height),
    spots("card", 70, 90 * scale, 70 * scale)
  local function pose(object, n)
    return object:translate(-45 * scale, -35 * scale):rotate(2 * n)
      :translate((100 + 2.5 * n) * scale, (70 - 1.5 * n) * scale)
  end
  for n = 1, frames do
    local rostrum = celspan.rostrum { celspan.cel { ground }, celspan.cel { pose(card, n) } }
    assert(celspan.render(rostrum, ("%s/card.%04d.png"):format(folder, n),
      { size = { width, height } }))
  end
  local begun = os.clock()
  local region = pose(celspan.rect { 4 * scale, 4 * scale, 82 * scale, 62 * scale }, 1)
  local found = assert(track.follow(folder .. "/card.####.png", { from = 1, at = region }))
  local seconds = (os.clock() - begun) / (frames - 1)
  os.execute("rm -r " .. folder)
  print(("%4d x %-4d %7.3f s a frame, %d of %d frames found"):format(width, height, seconds,
    frames - #(found.lost or {}), frames))
end

follow(640, 360)
follow(1920, 1080)
