--- The sheet of a puppet: its bones, joints and limits drawn over it. celspan.puppet uses it.
local celspan = require "celspan"
local affine = require "celspan.affine"
local bones = require "celspan.bones"

local BONE, JOINT_MARK, FAN = "#1769aa", "#ffffff", "#e8590c" -- colours of a sheet

--- A bone as a kite, whose broad end is at the bone's first joint.
local function kite(frame, bone, size)
  local along, across = math.min(bone.length / 5, 3 * size), math.min(bone.length / 8, 2 * size)
  local points = { { bone.x, bone.y },
    { bone.x + bone.ux * along - bone.uy * across, bone.y + bone.uy * along + bone.ux * across },
    { bone.end_x, bone.end_y },
    { bone.x + bone.ux * along + bone.uy * across, bone.y + bone.uy * along - bone.ux * across } }
  for i, point in ipairs(points) do points[i] = { affine.apply(frame, point[1], point[2]) } end
  points.texture = BONE
  return celspan.polygon(points):fade(0.6)
end

--- The range of the end of a bone, as an arc with two radii.
local function fan(base, bone, size)
  if bone.low == -math.huge then return nil end
  local radius = math.min(bone.length / 2, 12 * size)
  local centre = { affine.apply(base, bone.x, bone.y) }
  local points = { centre }
  for i = 0, 24 do
    local map = affine.compose(base,
      affine.turn(bone.low + (bone.high - bone.low) * i / 24, bone.x, bone.y))
    points[#points + 1] = { affine.apply(map, bone.x + bone.ux * radius,
                                         bone.y + bone.uy * radius) }
  end
  points[#points + 1] = centre
  return celspan.stroke { points = points, width = size / 3, cap = "round", join = "round",
                          texture = FAN }
end

local function mark(x, y, size)
  return celspan.union { celspan.circle { centre = { x, y }, radius = size, texture = BONE },
                         celspan.circle { centre = { x, y }, radius = size / 2,
                                          texture = JOINT_MARK } }
end

--- The marks of all bones and joints, as a list of objects.
return function(rig, frames, options)
  local objects, size = {}, options.size or 5
  for _, bone in ipairs(rig.list) do
    objects[#objects + 1] = fan(bones.base_of(bone, frames), bone, size)
    objects[#objects + 1] = kite(bones.map_of(frames[bone]), bone, size)
  end
  local names = bones.names_of(rig.joints)
  table.sort(names)
  for _, name in ipairs(names) do
    local x, y = bones.joint_in(rig, frames, name)
    objects[#objects + 1] = mark(x, y, size)
    objects[#objects + 1] = options.font and celspan.text { name, font = options.font,
      size = 3 * size, at = { x + 1.5 * size, y + size }, texture = "#000" } or nil
  end
  return objects
end
