-- A new light on a frame that was taken apart, compared with rendering the frame in that light.
--
--   LUA_CPATH=build/?.so lua5.4 tests/bench/relight.lua [FILM.lua [FRAME]]
--
-- Two frames of 1920 x 1080: 40 cels of pictures with alpha, each half as wide and high as the
-- frame, with a soft edge and 8 bits per channel, scattered over it; and a frame of a film
-- (scripts/demo.lua by default) whose lights that are textures are made flat. Measured for each:
-- rendering to floats, taking the frame apart once, and the frame with a new light for one cel in
-- the middle, and for all of them. Times are processor time of all threads, the least of several
-- runs, after the pictures have been read into the cache.
-- time of all threads, the least of several runs, after what is kept of pictures has been read.
local celspan = require "celspan"
local relight = require "celspan.relight"

local WIDTH, HEIGHT = 1920, 1080
local SIZE = { WIDTH, HEIGHT }

local function least(runs, work)
  local best = math.huge
  for _ = 1, runs do
    collectgarbage()
    local began = os.clock()
    work()
    best = math.min(best, os.clock() - began)
  end
  return best
end

--- A picture in memory: a blot of a colour that varies, with a soft edge.
local function blot(seed, w, h)
  local random = celspan.random(seed)
  local r, g, b = random "r", random "g", random "b"
  local object = celspan.union {
    celspan.ellipse { centre = { w / 2, h / 2 }, radii = { w / 2, h / 2 },
      texture = celspan.radial {
      centre = { w / 2, h / 2 }, radius = w / 2, { 0, celspan.rgb(r, g, b) },
      { 0.55, celspan.rgb(g, b, r, 0.9) }, { 1, celspan.rgb(b, r, g, 0) } } },
    celspan.ellipse { centre = { w * 0.4, h * 0.4 }, radii = { w / 9, h / 9 },
      texture = celspan.rgb(b, g, r, 0.8) } }
  local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { object } },
    { size = { w, h } }))
  return { pixels = image:bytes { depth = 8 }, size = { w, h }, format = "rgba8" }
end

local function picture_cels()
  local random, cels = celspan.random "cels", {}
  local w, h = WIDTH // 2, HEIGHT // 2
  for i = 1, 40 do
    local picture = blot("blot" .. i, w, h)
    picture.x = math.floor((random("x" .. i) * 1.2 - 0.1) * (WIDTH - w))
    picture.y = math.floor((random("y" .. i) * 1.2 - 0.1) * (HEIGHT - h))
    cels[i] = celspan.cel { celspan.image(picture), front = { 1, 0.9, 0.8 } }
  end
  return celspan.rostrum(cels):with { back = "#203040" }
end

--- The rostrum with only flat lights.
local function flattened(rostrum)
  local function is_flat(light)
    return light == nil or type(light) ~= "userdata" and not light.texture
  end
  local cels, changed = {}, 0
  for i = 1, #rostrum do
    local cel = rostrum[i]
    if not is_flat(cel.front) then cel, changed = cel:with { front = { 1, 1, 1 } }, changed + 1 end
    if not is_flat(cel.back) then cel, changed = cel:with { back = { 0, 0, 0, 0 } }, changed + 1 end
    cels[i] = cel
  end
  local flat = rostrum:with(cels)
  if not is_flat(flat.front) then flat, changed = flat:with { front = { 1, 1, 1 } }, changed + 1 end
  if not is_flat(flat.back) then
    flat, changed = flat:with { back = { 0, 0, 0, 0 } }, changed + 1
  end
  return flat, changed
end

local function row(name, seconds, rendering)
  print(("  %-34s %9.2f ms %8.1f times"):format(name, seconds * 1000, rendering / seconds))
end

local function measure(title, rostrum, film)
  local options = { size = SIZE, film = film, workers = 1 }
  assert(celspan.pixels(rostrum, options))
  local rendering = least(5, function() assert(celspan.pixels(rostrum, options)) end)
  local stack
  local taking = least(1, function() stack = assert(relight.stack(rostrum, options)) end)
  local middle = #rostrum // 2 + 1
  local one = { [middle] = { front = { 0.4, 0.5, 1.2 } } }
  local all = {}
  for i = 1, #rostrum do all[i] = { front = { 0.4 + i / 100, 0.5, 1.2 } } end
  print(("%s: %d cels, %d x %d, %.0f MB"):format(title, #rostrum, WIDTH, HEIGHT, stack.bytes / 1e6))
  print(("  %-34s %9.2f ms"):format("rendering", rendering * 1000))
  print(("  %-34s %9.2f ms"):format("taking it apart, once", taking * 1000))
  row("a new light for one cel", least(9, function() assert(stack:light(one)) end), rendering)
  row("new lights for all cels", least(9, function() assert(stack:light(all)) end), rendering)
end

measure("picture cels with alpha", picture_cels())

local path, number = arg[1] or "scripts/demo.lua", tonumber(arg[2])
package.path = (path:match "^.*/" or "./") .. "?.lua;" .. package.path
setmetatable(_G, { __index = celspan.names {} }) -- as in scripts that the program runs
local film = assert(loadfile(path))()
local size = film.size
local rostrum = film:at(number or film.first + film.frames // 2)
if type(rostrum) == "table" then rostrum = rostrum[1][1] end -- of several exposures the first
local flat, changed = flattened(rostrum)
measure(("%s%s"):format(path, changed > 0 and (", %d lights made flat"):format(changed) or ""),
  flat, size)
