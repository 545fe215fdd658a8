--- The frames of a Lottie animation into memory, by celspan: each is made and drawn by one worker.
---
---   lua5.4 tests/bench/lottie_frames.lua FILE WIDTH HEIGHT FRAMES
---
--- It goes through the frames twice and prints the mean time of one frame the second time.
--- LUA_CPATH names the build.
local celspan = require "celspan"
local lottie = require "celspan.lottie"

local file, width, height, frames = ...
width, height, frames = tonumber(width), tonumber(height), tonumber(frames)
local film = lottie.load(file):film()

local function draw()
  for i = 0, frames - 1 do
    local number = film.first + film.frames * i // frames
    local image = assert(celspan.pixels(film, { frame = number, size = { width, height },
      workers = 1 }))
    image:bytes()
  end
end

draw()
local start = os.clock()
draw()
local each = (os.clock() - start) / frames
print(("wall %.9f best_wall %.9f processor %.9f best_processor %.9f runs 1"):format(each, each,
  each, each))
