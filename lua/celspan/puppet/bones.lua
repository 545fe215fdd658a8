--- The bones of puppets: read from a script, and placed in a pose. celspan.puppet uses it.
--
-- A bone in a pose has a frame, the rigid map of everything that follows it, and a scaling, of its
-- own artwork before that. Children of a stretched bone move with its end and keep their shape.
local affine = require "celspan.affine"
local native = require "celspan.native"
local fields = require "celspan.fields"
local reach = require "celspan.reach"

local bones = {}

local rad, deg = math.rad, math.deg

function bones.refuse(text, ...) native.refuse("puppet: " .. text:format(...)) end
local refuse = bones.refuse

--- The end of a message about a wrong name: the nearest of the names, or all of them.
function bones.help(name, names)
  table.sort(names)
  return #names > 0 and fields.choice(name, names) or "; there are none"
end
local help = bones.help

function bones.names_of(map)
  local names = {}
  for name in pairs(map) do names[#names + 1] = name end
  return names
end
local names_of = bones.names_of

-- ---------------------------------------------------------------- joints and bones

--- Adds the joints that a script gives to those that are known.
function bones.read_joints(given, joints)
  for name, point in next, given or {} do
    if type(name) ~= "string" then
      refuse("joints are given by name: joints = { knee = { 120, 340 } }, got %s", fields.key(name))
    end
    fields.numbers("puppet", ("joint '%s': its value %%d"):format(name), point, 2, "{x, y}", 6)
    joints[name] = { point[1], point[2] }
  end
  return joints
end

local known_bone = { "name", from = "string", to = "string", parent = "string", parts = "table",
                     limits = "table", apart = "boolean" }
--- Fields of poses, which cannot be names of bones.
bones.reserved = { at = true, reach = true, over = true, under = true, front = true, back = true }

local function check_joint(rig, bone, field)
  local name = bone[field]
  if not name then refuse("bone '%s': field '%s' must be a joint's name", bone[1], field) end
  if not rig.joints[name] then
    refuse("bone '%s': there is no joint '%s'%s", bone[1], name, help(name, names_of(rig.joints)))
  end
  return rig.joints[name]
end

local function read_limits(name, limits)
  if limits == nil then return -math.huge, math.huge end
  fields.numbers("puppet", ("bone '%s': its limit %%d"):format(name), limits, 2,
    "{least, most} in degrees", 7)
  if limits[1] > limits[2] then
    refuse("bone '%s': the first limit, %.14g degrees, is more than the second, %.14g", name,
      limits[1], limits[2])
  end
  return limits[1], limits[2]
end

--- The names of the parts that move with a bone.
local function read_parts(rig, name, parts)
  if parts == nil then return rig.by_name[name] and { name } or {} end
  for i = 1, rawlen(parts) do
    if type(parts[i]) ~= "string" or not rig.by_name[parts[i]] then
      refuse("bone '%s': the artwork has no part '%s'%s", name, fields.key(parts[i]),
        help(parts[i], names_of(rig.by_name)))
    end
  end
  return parts
end

local function read_bone(rig, i, given)
  fields.check(("puppet: bone %d"):format(i), given, known_bone, 6)
  local name = given[1]
  fields.expect(type(name) == "string" and name ~= "", name,
    "puppet: bone %d must begin with its name", i)
  if rig.bones[name] then refuse("two bones have the name '%s'", name) end
  if bones.reserved[name] then
    refuse("'%s' cannot be a bone's name: poses have a field of it", name)
  end
  local from, to = check_joint(rig, given, "from"), check_joint(rig, given, "to")
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local length = math.sqrt(dx * dx + dy * dy)
  if length == 0 then refuse("bone '%s' has no length: its joints are at one point", name) end
  local low, high = read_limits(name, given.limits)
  local bone = { name = name, from = given.from, to = given.to, parent = given.parent,
    x = from[1], y = from[2], end_x = to[1], end_y = to[2], ux = dx / length, uy = dy / length,
    length = length, low = low, high = high,
    apart = given.apart, parts = read_parts(rig, name, given.parts),
    is_bare = given.parts == nil and not rig.by_name[name] }
  rig.bones[name], rig.list[i] = bone, bone
end

--- The bone that ends at the joint where this one begins, or nil.
local function bone_before(rig, bone)
  local found
  for _, other in ipairs(rig.list) do
    if other.to == bone.from and found then
      refuse("bone '%s' begins where two bones end, '%s' and '%s': name its parent", bone.name,
        found.name, other.name)
    end
    if other.to == bone.from then found = other end
  end
  return found
end

--- Finds the parents of bones: the named one, or else the previous bone.
local function join_bones(rig)
  for _, bone in ipairs(rig.list) do
    if bone.parent and not rig.bones[bone.parent] then
      refuse("bone '%s': there is no bone '%s'%s", bone.name, bone.parent,
        help(bone.parent, names_of(rig.bones)))
    end
    bone.parent = bone.parent and rig.bones[bone.parent] or bone_before(rig, bone)
  end
end

--- Refuses bones whose part may be a misspelled name, and bones that move nothing.
local function check_parts(rig)
  local is_parent, names = {}, {}
  for _, bone in ipairs(rig.list) do is_parent[bone.parent or false] = true end
  for name in pairs(rig.by_name) do
    if not rig.bones[name] then names[#names + 1] = name end
  end
  for _, bone in ipairs(rig.list) do
    local hint = bone.is_bare and native.nearest(bone.name, names)
    if hint then
      refuse("bone '%s': the artwork has no part of this name; did you mean '%s'? Else give it "
        .. "parts = {}", bone.name, hint)
    end
    if bone.is_bare and not is_parent[bone] then
      refuse("bone '%s' moves nothing: the artwork has no part of this name, and no bone begins "
        .. "at its end. parts = {} says that this is meant%s", bone.name, help(bone.name, names))
    end
  end
end

--- Orders the bones so that parents come first.
local function order_bones(rig)
  local ordered, state = {}, {}
  local function visit(bone)
    if state[bone] == "open" then
      refuse("bone '%s' is its own parent, or that of one of its parents", bone.name)
    end
    if state[bone] then return end
    state[bone] = "open"
    if bone.parent then visit(bone.parent) end
    state[bone] = "done"
    ordered[#ordered + 1] = bone
  end
  for _, bone in ipairs(rig.list) do visit(bone) end
  rig.list = ordered
end

--- Reads the joints and the bones of a rig: rig.joints contains the joints that are drawn; those of
--- the script are added; rig.bones are the bones by name, rig.list has parents first.
function bones.read(rig, joints, given)
  bones.read_joints(joints, rig.joints)
  for i = 1, rawlen(given or {}) do read_bone(rig, i, given[i]) end
  if #rig.list == 0 then refuse "needs at least one bone { name, from = joint, to = joint }" end
  join_bones(rig)
  check_parts(rig)
  order_bones(rig)
end

-- ---------------------------------------------------------------- what a pose asks of bones

local known_turn = { rotate = "number", absolute = "number", scale = "number", stretch = "number" }

--- The values of a bone in a pose: degrees, or a table.
function bones.read_turn(name, value)
  if fields.is_finite(value) then return { rotate = value } end
  if type(value) == "number" then value = { rotate = value } end
  fields.check(("puppet: bone '%s'"):format(name), value, known_turn, 6)
  for _, field in ipairs { "rotate", "absolute", "scale", "stretch" } do
    fields.expect(value[field] == nil or fields.is_finite(value[field]), value[field],
      "puppet: bone '%s': field '%s' must be a finite number", name, field)
  end
  for _, field in ipairs { "scale", "stretch" } do
    fields.expect((value[field] or 1) > 0, value[field],
      "puppet: bone '%s': field '%s' must be more than 0", name, field)
  end
  return value
end

local known_reach = { "x, y", bones = "number", pole = "table", stretch = "boolean",
                      loose = "boolean" }

--- A target of a pose.
function bones.read_reach(rig, joint, given)
  if not rig.joints[joint] then
    refuse("reach: there is no joint '%s'%s", fields.key(joint), help(joint, names_of(rig.joints)))
  end
  fields.check(("puppet: reach '%s'"):format(joint), given, known_reach, 6)
  fields.numbers("puppet", ("reach '%s': its value %%d"):format(joint), given, 2, "{x, y}", 6)
  if given.pole then
    fields.numbers("puppet", ("reach '%s': value %%d of its pole"):format(joint), given.pole, 2,
      "{x, y}", 6)
  end
  return given
end

--- The bones that move a joint to its place: at most `count` of them; the last one ends at the
--- joint.
function bones.chain_of(rig, joint, count)
  local chain = {}
  for _, bone in ipairs(rig.list) do
    if bone.to == joint and chain[1] then
      refuse("reach: two bones end at the joint '%s', '%s' and '%s': give each a joint of its own",
        joint, chain[1].name, bone.name)
    end
    if bone.to == joint then chain[1] = bone end
  end
  if not chain[1] then refuse("reach: no bone ends at the joint '%s'", joint) end
  fields.whole(("puppet: reach '%s': field 'bones'"):format(joint), count, 1)
  while #chain < count and chain[1].parent do table.insert(chain, 1, chain[1].parent) end
  return chain
end

-- ---------------------------------------------------------------- bones in a pose

--- The frame in which a bone is turned: the frame of its parent, moved to the joint if the parent
--- is stretched.
function bones.base_of(bone, frames)
  local parent = bone.parent and frames[bone.parent]
  if not parent then return affine.translation(0, 0), 0 end
  local x, y = affine.apply(parent.scaling, bone.x, bone.y)
  return affine.compose(parent.frame, affine.translation(x - bone.x, y - bone.y)), parent.angle
end

local TURN = 720 -- degrees: wider limits have no effect

local function limit(bone, degrees) return math.max(bone.low, math.min(bone.high, degrees)) end

--- How a bone is scaled in its own frame.
local function scaling_of(bone, turn)
  local along = (turn.scale or 1) * (turn.stretch or 1)
  return affine.stretch(along, 1 / (turn.stretch or 1), bone.ux, bone.uy, bone.x, bone.y)
end

--- The angle of a bone from its parent, in degrees.
local function angle_of(bone, turn, parent_angle)
  local degrees = turn.rotate or 0
  if turn.absolute then degrees = turn.absolute - parent_angle end
  return limit(bone, degrees)
end

local function place_bone(bone, turn, frames, degrees)
  local base, parent_angle = bones.base_of(bone, frames)
  local angle = degrees or angle_of(bone, turn, parent_angle)
  frames[bone] = { frame = affine.compose(base, affine.turn(angle, bone.x, bone.y)),
                   scaling = scaling_of(bone, turn), angle = parent_angle + angle, own = angle }
end

--- The bones of a chain as vectors from joint to joint, in the frame of the first bone with the
--- angle 0.
local function vectors_of(chain, turns)
  local vectors = {}
  for k, bone in ipairs(chain.bones) do
    local following = chain.bones[k + 1]
    local x, y = affine.apply(scaling_of(bone, turns[bone] or {}),
      following and following.x or bone.end_x, following and following.y or bone.end_y)
    vectors[k] = { x - bone.x, y - bone.y, rad(math.max(bone.low, -TURN)),
                   rad(math.min(bone.high, TURN)),
                   rad(angle_of(bone, turns[bone] or {}, 0)) }
  end
  return vectors
end

--- The factor by which the bones must be lengthened to reach the target; 1 if they are long enough.
local function lengthening(vectors, x, y)
  local length = 0
  for _, vector in ipairs(vectors) do length = length + math.sqrt(vector[1] ^ 2 + vector[2] ^ 2) end
  return math.max(1, math.sqrt(x * x + y * y) / length)
end

local function lengthened(turn, by)
  return { rotate = turn.rotate, absolute = turn.absolute, scale = turn.scale,
           stretch = (turn.stretch or 1) * by }
end

--- Turns the bones of a chain so that its end is nearest to the target.
local function place_chain(chain, turns, frames, at)
  local first = chain.bones[1]
  local back = affine.inverse((bones.base_of(first, frames)))
  local function seen(point)
    local x, y = affine.apply(back, point[1] - at[1], point[2] - at[2])
    return { x - first.x, y - first.y }
  end
  local target, vectors = seen(chain.target), vectors_of(chain, turns)
  if chain.target.stretch then
    local by = lengthening(vectors, target[1], target[2])
    for _, bone in ipairs(chain.bones) do turns[bone] = lengthened(turns[bone] or {}, by) end
    vectors = vectors_of(chain, turns)
  end
  local angles = reach.solve { bones = vectors, target = target,
                               pole = chain.target.pole and seen(chain.target.pole) }
  for k, bone in ipairs(chain.bones) do
    place_bone(bone, turns[bone] or {}, frames, limit(bone, deg(angles[k])))
  end
end

--- The bones that must be placed before a bone can be, and the bone itself, the nearest first.
local function line_to(bone, chains, frames)
  local line = {}
  while bone and not rawget(frames, bone) do
    line[#line + 1] = bone
    bone = chains[bone] and chains[bone].bones[1].parent or not chains[bone] and bone.parent
  end
  return line
end

--- The place of each bone in a pose. frame: the rigid map of everything that follows it; scaling:
--- of its own artwork, applied first; angle: in the drawing; own: relative to its parent. A bone is
--- placed when it is first read, after the bones that carry it. chains: by each of their bones.
function bones.place(turns, chains, at)
  return setmetatable({}, { __index = function(frames, bone)
    local line = line_to(bone, chains, frames)
    for i = #line, 1, -1 do
      local chain = chains[line[i]]
      if chain then
        place_chain(chain, turns, frames, at)
      else
        place_bone(line[i], turns[line[i]] or {}, frames)
      end
    end
    return rawget(frames, bone)
  end })
end

--- The map of a bone's artwork.
function bones.map_of(frame) return affine.compose(frame.frame, frame.scaling) end

--- A joint moves with the bone that ends at it; if there is none, with a bone that begins at it.
function bones.joint_in(rig, frames, name)
  local x, y = rig.joints[name][1], rig.joints[name][2]
  local beginning
  for _, bone in ipairs(rig.list) do
    if bone.to == name then return affine.apply(bones.map_of(frames[bone]), x, y) end
    if bone.from == name then beginning = beginning or bone end
  end
  if not beginning then return x, y end
  return affine.apply(frames[beginning].frame, x, y)
end

return fields.seal("bones", bones)
