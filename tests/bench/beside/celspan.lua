-- The film by celspan. The argument is the path of the drawing.
local celspan = require "celspan"
local svg = require "celspan.svg"

local colours = { "#e4572e", "#f3a712", "#2e86ab" }
local owl = assert(svg.read(...))
local sky = celspan.rect { 0, 0, 1280, 720, texture = celspan.linear {
  from = { 0, 0 }, to = { 0, 720 }, { 0, "#16202e" }, { 1, "#7a5c74" } } }
local title = celspan.text { "Six seconds", size = 96, at = { 640, 160 }, align = "centre",
  font = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf", texture = "#f6ead2" }

local discs = {}
for i = 0, 29 do
  local radius = 30 + 3 * i
  discs[i] = celspan.circle { centre = { 0, 0 }, radius = radius, texture = celspan.radial {
    centre = { 0, 0 }, radius = radius, { 0, "#fff4d6" }, { 1, colours[i % 3 + 1] } } }
end

return celspan.film { size = { 1280, 720 }, fps = 25, frames = 150, frame = function(f)
  local u, art = f.index / 149, { sky }
  for i = 0, 29 do
    art[#art + 1] = discs[i]:translate((1 - u) * (173 * i % 1280) + u * (311 * i % 1280),
      (1 - u) * (97 * i % 720) + u * ((59 * i + 300) % 720))
  end
  art[#art + 1], art[#art + 2] = owl.object:translate(880, 330), title
  return celspan.rostrum { celspan.cel(art) }
end }
