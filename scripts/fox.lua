-- A painted fox that trots through an autumn wood: a puppet of the layers of an OpenRaster file.
local celspan = require "celspan"
local layers = require "celspan.layers"
local puppet = require "celspan.puppet"
local wood = require "fox.wood"

local bones = { { "body", from = "rump", to = "withers" },
  { "head", from = "withers", to = "nose" },
  { "tail", from = "rump", to = "bend", parent = "body" }, { "brush", from = "bend", to = "tip" } }
local feet = {}
for side, phase in pairs { [" near"] = 0, [" far"] = 0.5 } do
  local function add(name, from, to, parent)
    bones[#bones + 1] = { name .. side, from = from .. side, to = to .. side, parent = parent }
  end
  add("ear", "ear root", "ear tip", "head")
  add("thigh", "hip", "knee", "body") add("shank", "knee", "hock") add("foot", "hock", "toe")
  add("upper", "shoulder", "elbow", "body") add("fore", "elbow", "wrist")
  add("paw", "wrist", "nail")
  feet["hock" .. side] = { bone = "foot" .. side, phase = phase + 0.12 }
  feet["wrist" .. side] = { bone = "paw" .. side, phase = phase + 0.5 }
end
local fox = puppet { art = assert(layers.read "paintings/fox.ora"), bones = bones }
for joint, foot in pairs(feet) do
  local x, y = fox:joint({}, joint)
  foot.steps = puppet.steps { stride = 210, period = 0.72, share = 0.52, x = x, ground = y }
end

return celspan.film { size = { 960, 540 }, frames = 96, frame = function(f)
  local way = 210 * f.time / 0.72
  local function wave(delay) return math.sin(4 * math.pi * (f.time / 0.72 - delay)) end
  local pose = { at = { way, 12 + 4 * wave(0.375) }, body = 1.2 * wave(0.1),
    head = 2 - 2 * wave(0.2), ["ear near"] = 3 * wave(0.3), tail = 8 + 5 * wave(0.25),
    brush = 9 * wave(0.4), reach = {} }
  for joint, foot in pairs(feet) do
    local x, y, air = foot.steps:foot(f.time, foot.phase)
    pose.reach[joint], pose[foot.bone] = { x, y }, { absolute = 42 * math.sin(math.pi * air) }
  end
  return wood(f.time, way, fox:pose(pose):translate(130, 98))
end }
