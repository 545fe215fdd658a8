-- A painted film: nine paintings under a dolly, their planes out of focus but one; the fox of
-- scripts/fox.lua, which is a rig of painted parts; and a face whose lips follow a recorded line.
-- Argument: the folder of the paintings, 1.png (the farthest) to 9.png.
local celspan = require "celspan"
local face = require "demo.face"
local layers = require "celspan.layers"
local lips = require "celspan.lips"
local multiplane = require "celspan.multiplane"
local puppet = require "celspan.puppet"

local folder = ...
local W, H = 1280, 720

local planes = {}
for i = 1, 9 do
  local image = celspan.image { file = ("%s/%d.png"):format(folder, i) }
  local _, _, width = image:bounds()
  planes[i] = celspan.cel { image:scale(1.2 * W / width):translate(-0.1 * W, -0.1 * H) }
end

local bones = { { "body", from = "rump", to = "withers" },
  { "head", from = "withers", to = "nose" },
  { "tail", from = "rump", to = "bend", parent = "body" }, { "brush", from = "bend", to = "tip" } }
for _, side in ipairs { " near", " far" } do
  local function add(name, from, to, parent)
    bones[#bones + 1] = { name .. side, from = from .. side, to = to .. side, parent = parent }
  end
  add("ear", "ear root", "ear tip", "head")
  add("thigh", "hip", "knee", "body") add("shank", "knee", "hock") add("foot", "hock", "toe")
  add("upper", "shoulder", "elbow", "body") add("fore", "elbow", "wrist")
  add("paw", "wrist", "nail")
end
local fox = puppet { art = assert(layers.read "../../../scripts/paintings/fox.ora"),
                     bones = bones }
local line = assert(lips.read("../../../scripts/demo/line.tsv", { fps = 24 }))

return celspan.film { size = { W, H }, fps = 24, frames = 72, frame = function(f)
  local function wave(delay) return math.sin(4 * math.pi * (f.time / 0.72 - delay)) end
  local pose = { at = { 8 * f.index, 4 * wave(0.3) }, head = 2 - 3 * wave(0.2),
                 tail = 8 + 5 * wave(0.25), brush = 9 * wave(0.4) }
  for side, delay in pairs { [" near"] = 0, [" far"] = 0.25 } do
    pose["thigh" .. side], pose["shank" .. side] = 14 * wave(delay), 9 * wave(delay + 0.2)
    pose["upper" .. side], pose["fore" .. side] = -14 * wave(delay), -9 * wave(delay + 0.2)
  end
  local figure = fox:pose(pose)
  local speaker = face.draw(f.time, line:at(f.number + 24)):scale(0.9):translate(1080, 440)
  local scene = { film = { W, H }, focal = 900, fit = true, aperture = 20, focus = 1200,
                  camera = { x = 60 * f.progress, y = 0, z = 150 * f.progress },
                  { celspan.cel { figure:translate(160, 250), speaker }, z = 300 } }
  for i, plane in ipairs(planes) do scene[#scene + 1] = { plane, z = 280 * (9 - i) } end
  return multiplane(scene)
end }
