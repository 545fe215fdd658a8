-- A drawing that waves: an owl from an SVG file, whose parts turn about their joints.
local celspan = require "celspan"
local svg = require "celspan.svg"
local keys = require "celspan.keys"

local owl = assert(svg.read "drawings/owl.svg")

local wing = keys { { 0, 0 }, { 0.5, 135, "outBack" }, { 0.7, 105, "inOutSine" }, { 0.9, 140, "inOutSine" },
                    { 1.1, 105, "inOutSine" }, { 1.3, 140, "inOutSine" }, { 1.9, 0, "inOutQuad" } }
local tilt = keys { { 0.2, 0 }, { 0.6, -7, "inOutSine" }, { 1.4, -7 }, { 1.8, 0, "inOutSine" } }
local glance = keys { { 0.1, 0 }, { 0.3, -7, "outQuad" }, { 1.5, -7 }, { 1.7, 0, "inOutQuad" } }

local night = celspan.cel {
  celspan.rect { 0, 0, 640, 400, texture = celspan.linear { from = { 0, 0 }, to = { 0, 400 }, { 0, "#16203f" },
    { 1, "#4a5d8f" } } },
  celspan.circle { centre = { 520, 90 }, radius = 46, texture = "#f6ecc9" },
  celspan.path { d = "M0 356 C180 340 420 372 640 350 V386 C430 396 200 372 0 388 Z", texture = "#3a2a22" } }

return celspan.film { size = { 640, 400 }, frames = 48, frame = function(f)
  local look = function(pupil) return pupil:translate(glance:at(f.time), 0) end
  local art = owl:with {
    ["left wing"] = function(arm) return arm:rotate(wing:at(f.time), 90, 172) end,
    head = function(head) return head:rotate(tilt:at(f.time), 160, 170) end,
    ["left-pupil"] = look, ["right-pupil"] = look }
  return celspan.rostrum { night, celspan.cel { art.object:translate(150, 12) } }
end }
