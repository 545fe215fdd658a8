-- A clip under a title, which fades in: for the benchmark. Arguments: "title" for the title alone.
local celspan = require "celspan"
local what = ...
local w, h = 1920, 1080
local title = celspan.cel { celspan.text { "A DAY OUTSIDE", font = "block.ttf", size = 160,
  at = { w / 2, h * .8 }, align = "centre", texture = "#ffffff" } }

if what == "title" then
  return celspan.film { size = { w, h }, frame = function() return celspan.rostrum { title } end }
end

local clip = celspan.footage { file = "clip.mp4" }
return celspan.film { size = { w, h }, fps = 24, frames = clip.frames, frame = function(f)
  local shown = celspan.rect { 0, 0, w, h, texture = clip:frame(f.index + 1) }
  return celspan.rostrum { back = "#000000",
    celspan.cel { shown:fade(math.min(1, f.index / 24)) }, title }
end }
