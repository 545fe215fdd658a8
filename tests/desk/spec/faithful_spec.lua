-- Films in every format beside the same frames as PNG, read back by other programs: ffmpeg, and
-- libwebp's decoder of animations in Python. CELSPAN_VERBOSE=1 prints the differences.

local movies = require "tests.support.movies"
local present = require "tests.support.present"
local rendering = require "tests.support.rendering"
local workbench = require "tests.support.workbench"

local PYTHON = "/usr/bin/python3"
local is_verbose = os.getenv "CELSPAN_VERBOSE" ~= nil
local has_webp = present.program(PYTHON) and os.execute(PYTHON
  .. " -c 'from PIL import features; exit(not features.check(\"webp_anim\"))' 2>/dev/null")

local W, H, FRAMES, FAR = 120, 72, 56, 24

--- A pan over a town with a glowing moon, a dissolve to a sea at dusk, a slow one to dawn, a fade.
local FILM = [[
local celspan = require "celspan"
local function cel(...) return celspan.cel { ... } end
local function down(top, bottom)
  return celspan.rect { 0, 0, 160, 96, texture = celspan.linear { from = { 0, 0 }, to = { 0, 96 },
    { 0, top }, { 1, bottom } } }
end
local function disc(x, y, radius, colour)
  return celspan.circle { centre = { x, y }, radius = radius, texture = celspan.rgb(colour) }
end
local function town(u)
  local houses = {}
  for i = 0, 7 do
    local high = 20 + i * 37 % 22
    houses[i + 1] = celspan.rect { i * 30 - 60 * u, 96 - high, 22, high,
      texture = celspan.rgb "#20263a" }
  end
  return celspan.rostrum { cel(down("#1c2a50", "#50607c")), celspan.cel(houses),
    cel(disc(40, 26, 9, "#fff4d0")):glow { radius = 9, colour = "#c8a468" } }
end
local function sea(top, bottom, x)
  return celspan.rostrum { cel(down(top, bottom)),
    cel(disc(x, 48, 14, "#f6d8b0")):glow { radius = 8, colour = "#d89060" },
    cel(celspan.rect { 0, 66, 160, 30, texture = celspan.rgb "#46546c" }) }
end
local dusk, dawn = sea("#b47a5a", "#d8a884", 110), sea("#7c94b4", "#e4d4bc", 50)
return celspan.film { size = { 160, 96 }, fps = 24, frames = 56, frame = function(f)
  local i = f.index
  if i < 10 then return town(i / 10) end
  if i < 18 then return { { town(1), (18 - i) / 8 }, { dusk, (i - 10) / 8 } } end
  if i < 48 then return { { dusk, (48 - i) / 30 }, { dawn, (i - 18) / 30 } } end
  return { { dawn, (55 - i) / 7 }, { celspan.rostrum { cel(down("#000", "#000")) }, (i - 48) / 7 } }
end }
]]

--- Writes the frames of an animated WebP, each as often as it is shown, as RGBA.
local WEBP = [[
import sys
from PIL import Image
film = Image.open(sys.argv[1])
with open("pixels.raw", "wb") as out:
    for i in range(film.n_frames):
        film.seek(i)
        film.load()
        out.write(film.convert("RGBA").tobytes() * round(film.info["duration"] * 24 / 1000))
]]

--- The options of each film, and at most how far codes are off in the mean, and how many per cent
--- of the pixels are far off, in the worst frame.
local DELIVERIES = {
  { "film.mp4", 2, 1 }, { "film.mov", 2, 0.5 }, { "film.webm", 2, 1 },
  { "film.mkv", 2, 0.5 }, { "film.webp", 2, 1 }, { "film.avif", 2, 0.5 },
  { "film.apng", 0, 0 }, { "film.mkv --codec ffv1", 0, 0 },
}
if is_verbose then table.insert(DELIVERIES, { "film.gif", 255, 100 }) end -- it has no bounds

describe("every frame of a film in", function()
  local bench, plain

  setup(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
    bench:write("webp.py", WEBP)
    if not movies.are_made then return end
    rendering.done(bench, "--size 120x72 -o plain.##.png")
    plain = movies.pixels(bench, "plain.%02d.png", "rgba", "-f image2")
  end)
  teardown(function() bench:remove() end)

  local function pixels(name)
    if not name:find "webp$" then
      return movies.pixels(bench, name, "rgba", "", "-vf scale=flags=accurate_rnd+full_chroma_int")
    end
    movies.run(bench, PYTHON .. " webp.py " .. name)
    return bench:read "pixels.raw"
  end

  --- The mean difference of a frame's codes, and per cent of its pixels that are far off.
  local function frame_off(found, frame)
    local sum, far = 0, 0
    for at = frame * W * H * 4 + 1, (frame + 1) * W * H * 4, 4 do
      local r, g, b = plain:byte(at, at + 2)
      local x, y, z = found:byte(at, at + 2)
      r, g, b = r > x and r - x or x - r, g > y and g - y or y - g, b > z and b - z or z - b
      sum = sum + r + g + b
      if r > FAR or g > FAR or b > FAR then far = far + 1 end
    end
    return sum / (3 * W * H), 100 * far / (W * H)
  end

  for _, delivery in ipairs(DELIVERIES) do
    local options, most_mean, most_far = table.unpack(delivery)
    local name = options:match "^%S+"
    it(options .. " is that of the PNG", function()
      if not movies.are_made then return pending "there is no ffmpeg" end
      if name == "film.webp" and not has_webp then return pending "no program decodes WebP" end
      if name == "film.avif" and not present.avif() then return pending "built without libavif" end
      rendering.done(bench, "--size 120x72 --no-dither -o %s", options)
      local found, mean, far = pixels(name), 0, 0
      assert.equal(#plain, #found)
      for frame = 0, FRAMES - 1 do
        local sum, share = frame_off(found, frame)
        mean, far = math.max(mean, sum), math.max(far, share)
      end
      if is_verbose then
        print(("%-24s mean %.2f, more than %d codes off: %.2f %%, %d bytes"):format(options, mean,
          FAR, far, #bench:read(name)))
      end
      assert.is_true(mean <= most_mean and far <= most_far, mean .. " " .. far)
    end)
  end
end)
