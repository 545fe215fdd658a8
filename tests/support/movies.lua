--- Movies for tests: how ffmpeg makes and reads them, and a film that shows one.
local assert = require "luassert"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local movies = {}

--- The size of the movies of `test`, and the bytes of a frame of theirs in `render`.
movies.W, movies.H, movies.FRAME = 64, 36, 64 * 36 * 4

--- For arguments of `make`: moving pictures of which none is like its neighbours; and a video of
--- several parts, whose pictures are stored in another order than they are shown.
function movies.test(rate, seconds)
  return ("-f lavfi -i testsrc2=s=64x36:r=%s:d=%s,noise=alls=40:allf=t "):format(rate, seconds)
end
function movies.x264(pixels)
  return ("-c:v libx264 -pix_fmt %s -g 12 -bf 2 -threads 1 "):format(pixels or "yuv420p")
end

--- Whether there is an ffmpeg, without which a test is pending.
movies.are_made = present.program("ffmpeg", "ffprobe")

--- A film of all pictures of a clip: by their numbers, "back" from the last one, or "at" its own
--- times. It prints what the clip says of itself.
movies.FILM = [[
local celspan = require "celspan"
local name, way, fps, colour = ...
local clip = celspan.footage { file = name, colour = colour }
local w, h = clip.size[1], clip.size[2]
local count = way == "at" and math.floor(clip.seconds * fps) or clip.frames
print(("%d %d %.4f %d %.3f %s"):format(w, h, clip.fps, clip.frames, clip.seconds, clip.sound))
return celspan.film { size = { w, h }, fps = tonumber(fps) or 24, frames = count,
  frame = function(f)
    local n = way == "back" and clip.frames - f.index or f.index + 1
    local shown = way == "at" and clip:at(f.time) or clip:frame(n)
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, w, h, texture = shown } } }
  end }
]]

--- A workbench with the film.
function movies.bench()
  local bench = workbench.new()
  bench:write("film.lua", movies.FILM)
  return bench
end

--- Runs a command in the folder of a workbench, which must succeed. Returns its output.
function movies.run(bench, command)
  local code, out, err = bench:inside(command)
  assert(code == 0, command .. ": " .. err)
  return out
end

--- Makes a movie. made: arguments of ffmpeg.
function movies.make(bench, name, made)
  movies.run(bench, ("ffmpeg -v error -y %s '%s'"):format(made, name))
end

--- The pixels of all pictures. reading, writing: arguments of ffmpeg before and behind the name.
function movies.pixels(bench, name, layout, reading, writing)
  local command = "ffmpeg -v error -y %s -i '%s' -map 0:V:0 %s -f rawvideo -pix_fmt %s pixels.raw"
  movies.run(bench, command:format(reading or "", name, writing or "", layout))
  return bench:read "pixels.raw"
end

--- What ffprobe says of the first moving picture: some fields of its stream.
function movies.stream(bench, name)
  local found = {}
  local out = movies.run(bench, "ffprobe -v error -select_streams v -count_frames -show_entries "
    .. "stream=codec_name,profile,pix_fmt,nb_read_frames -of default=nw=1 " .. name)
  for key, value in out:gmatch "([%w_]+)=([^\n]*)" do found[key] = value end
  return found
end

--- Renders FILM, which is film.lua; returns the codes of all frames, RGBA of 8 bits, and what the
--- script printed. way, fps, colour: as in FILM.
function movies.render(bench, name, way, fps, colour)
  local code, _, err = bench:celspan_inside("render film.lua -o f.%%04d.png -- '%s' %s %s %s", name,
    way, fps or 24, colour or "")
  assert(code == 0, err)
  local codes = movies.pixels(bench, "f.%04d.png", "rgba", "-f image2")
  os.execute(("rm -f '%s'/f.*.png"):format(bench.folder))
  return codes, err
end

--- Renders FILM, which fails with an exit code and a message.
function movies.fails(bench, code, arguments, pattern)
  local found, _, err = bench:celspan_inside("render film.lua -o f.%%04d.png %s", arguments)
  assert.equal(code, found, err)
  assert.matches(pattern, err)
end

return movies
