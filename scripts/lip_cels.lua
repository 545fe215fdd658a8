-- Lip sync: nine mouth cels, Rhubarb's A to H and X, chosen frame by frame from a timing file.
-- The strip below shows the set; the mouth in use is lit.
local face = require "demo.face"
local mouths = require "demo.mouths"

-- "Evening comes in layers."
local track = assert(lips.read("demo/line.tsv", { fps = 24 }))
local names = { "A", "B", "C", "D", "E", "F", "G", "H", "X" }

local ground = rect { 0, 0, 1920, 1080, fill = radial {
  centre = { 960, 420 }, radius = 1200, { 0, "#f3d7a2" }, { 0.5, "#dd9f6c" }, { 1, "#8d4b4e" } } }
local shelf = rect { 0, 850, 1920, 230, fill = "#2c2136" }
local scarf = nurbs { fill = "#d8473b", points = {
  { 720, 700 }, { 960, 640 }, { 1200, 700 }, { 1420, 860 }, { 960, 1000 }, { 500, 860 } } }

return film { frames = 48, frame = function(f)
  local shape = track:at(f.number + 24)
  local head = face.draw(f.time + 1, shape)
    :rotate(2 * math.sin(f.time * 3)):scale(2):translate(960, 560)
  local dim, lit = {}, {}
  for i, name in ipairs(names) do
    local x = 960 + (i - 5) * 196
    local list = name == shape and lit or dim
    list[#list + 1] = rect { x - 84, 882, 168, 166, radius = 26, fill = "#f3c39b" }
    list[#list + 1] = mouths[name]:scale(1.9):translate(x, 942)
  end
  return {
    cel { ground, scarf, head, shelf },
    cel { union(dim), front = { 0.36, 0.30, 0.42 } },
    cel { union(lit), front = { 1.1, 1.05, 0.95 } },
  }
end }
