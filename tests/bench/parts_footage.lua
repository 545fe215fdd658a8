--- A clip of 1080p under a title, with a fade: celspan beside ffmpeg's own overlay, to raw frames
--- and to a video of the same encoder.
local Command = require("tests.bench.runner").command
local present = require "tests.support.present"

local parts = {}

local LEAST = 0.8 -- of ffmpeg's speed

--- The clip has noise, so that decoding it takes as long as that of a filmed one.
local CLIP = "-f lavfi -i testsrc2=s=1920x1080:r=24:d=%d,noise=alls=10:allf=t -c:v libx264 "
  .. "-preset veryfast -pix_fmt yuv420p -colorspace bt709 -g 48"

local function shell(...)
  local command = table.concat({ ... }, " ")
  assert(os.execute(command), command)
end

local function make(runner, folder, seconds)
  shell("mkdir -p", Command(folder))
  shell("cp tests/bench/scripts/footage.lua scripts/type/block.ttf", Command(folder))
  shell("ffmpeg -v error -y", CLIP:format(seconds), Command(folder .. "/clip.mp4"))
  shell(Command(runner.celspan, "render", folder .. "/footage.lua", "--progress", "none", "-o",
    folder .. "/title.png", "--", "title"))
end

--- The two commands for an output. Raw frames go where nobody reads them.
local function entries(runner, folder, frames, output)
  local is_raw = output == "raw"
  local film, other = folder .. "/celspan.mp4", folder .. "/ffmpeg.mp4"
  local launch = Command(runner:program "launch", "all") .. " "
  local chain = "[0:v]fade=in:0:24[faded];[faded][1:v]overlay=shortest=1"
  local celspan = Command(runner.celspan, "render", folder .. "/footage.lua", "--workers", 2,
    "--progress", "none", "-o", is_raw and "-" or film)
  local ffmpeg = Command("ffmpeg", "-y", "-v", "error", "-i", folder .. "/clip.mp4", "-loop", 1,
    "-framerate", 24, "-i", folder .. "/title.png", "-filter_complex", chain, "-frames:v", frames)
  ffmpeg = ffmpeg .. (is_raw and " -f rawvideo -pix_fmt rgba pipe:1"
    or " -c:v libx264 -preset medium -crf 18 -pix_fmt yuv420p " .. Command(other))
  local function entry(renderer, command)
    return { command = launch .. Command("sh", "-c", command .. " >/dev/null"), part = "footage",
             scene = frames .. " frames", side = 1920, output = output, renderer = renderer,
             workers = 2 }
  end
  return { entry("celspan", celspan), entry("ffmpeg", ffmpeg) }
end

--- The ratio of the speeds of the two last rows, of their best times.
local function ratio(runner)
  local celspan, ffmpeg = runner.rows[#runner.rows - 1], runner.rows[#runner.rows]
  if ffmpeg and ffmpeg.renderer == "ffmpeg" and celspan then
    print(("   %s: celspan has %.2f of ffmpeg's speed (at least %.1f)"):format(ffmpeg.output,
      ffmpeg.best_wall / celspan.best_wall, LEAST))
  end
end

function parts.footage(runner, _, is_quick)
  if not present.program "ffmpeg" then
    return runner:note "ffmpeg is not installed: the clip under a title is left out"
  end
  local folder, seconds = runner.root .. "/" .. runner.folder .. "/footage", is_quick and 2 or 10
  make(runner, folder, seconds)
  for _, output in ipairs { "raw", "mp4" } do
    runner:measure(3, entries(runner, folder, 24 * seconds, output))
    ratio(runner)
  end
  shell("rm -r", Command(folder))
end

return parts
