--- Puppets: artwork with bones, and poses of it.
--
--   local rig = puppet{ art = art, bones = { { "thigh", from = "hip", to = "knee" },
--                                            { "shin", from = "knee", to = "ankle" } } }
--   rig:pose{ thigh = 20, reach = { ankle = { 300, 410 } } }     -- an object
--
--   hip o                 A bone turns about its first joint, and everything below it turns with
--        \  thigh         it: its parent is the bone that ends where it begins. The angles of a
--         \               pose are added to those of the drawing.
--    knee  o
--         /  shin         The artwork that moves with a bone are its parts: by default the part
--        /                that has the bone's name.
--  ankle o
--
-- A pose is a table, and never changed: poses are mixed, mirrored and kept in files as tables.
local celspan = require "celspan"
local affine = require "celspan.affine"
local bones = require "celspan.bones"
local native = require "celspan.native"
local fields = require "celspan.fields"
local people = require "celspan.people"
local poses = require "celspan.poses"
local puppet_sheet = require "celspan.puppet_sheet"
local sets = require "celspan.sets"
local steps = require "celspan.steps"
local tail = require "celspan.tail"

local refuse, help, names_of, map_of = bones.refuse, bones.help, bones.names_of, bones.map_of

-- ---------------------------------------------------------------- artwork

local function nothing() return celspan.union {} end

local function is_of(class, art)
  local metatable = type(art) == "table" and getmetatable(art)
  return metatable and metatable.__name == class
end

--- The parts of a drawing, and their children such as "mouth/C", by name: { key =, object =, inside
--- = }. key: its name in art:with; inside: the elements that contain it, the outermost first.
local function drawn_parts(art)
  local open, by_name, entries, elements = {}, {}, {}, art:elements()
  for _, element in ipairs(elements) do
    local entry = { key = element.name, object = element.object,
                    inside = table.move(open, 1, element.depth, 1, {}) }
    open[element.depth + 1], entries[element] = entry, entry
    for _, name in ipairs { element.id or false, element.label or false } do
      local object = name and rawget(art.parts, name)
      if object and not by_name[name] then by_name[name], entry.object = entry, object end
    end
  end
  for _, child in ipairs(sets.children(elements, art.parts)) do
    by_name[child.name] = by_name[child.name] or entries[child.element]
  end
  return by_name
end

--- The parts of a painting by name: the names of layers are their paths, and also their own names,
--- if no other layer has the same.
local function painted_parts(art)
  local by_name, by_own, shared = {}, {}, {}
  local function add(list, path, inside)
    for _, layer in ipairs(list) do
      local key = path .. layer.name
      local part = { key = key, object = layer.object, inside = inside }
      by_name[key] = by_name[key] or part
      shared[layer.name] = by_own[layer.name] ~= nil
      by_own[layer.name] = by_own[layer.name] or part
      if layer.children then
        local outer = table.move(inside, 1, #inside, 1, {})
        outer[#outer + 1] = part
        add(layer.children, key .. "/", outer)
      end
    end
  end
  add(art, "", {})
  for name, part in pairs(by_own) do
    if not shared[name] then by_name[name] = by_name[name] or part end
  end
  return by_name
end

local JOINT = "^joint[ %-_:]+(.+)$"

--- The joints that are drawn: the centres of the parts named "joint NAME".
local function drawn_joints(by_name)
  local joints, guides = {}, {}
  for name, part in pairs(by_name) do
    local joint = name:match(JOINT)
    if joint then
      local x, y, w, h = part.object:bounds()
      if not x then refuse("part '%s' is empty: a joint is a shape, such as a circle", name) end
      joints[joint] = { x + w / 2, y + h / 2 }
      guides[#guides + 1] = name
    end
  end
  return joints, guides
end

--- For each part that a bone moves, finds the nearest part around it that is also moved by a bone.
local function join_parts(rig)
  local owner = {}
  for _, bone in ipairs(rig.list) do
    for _, name in ipairs(bone.parts) do
      local element = rig.by_name[name]
      if owner[element] then
        refuse("part '%s' moves with two bones, '%s' and '%s'", name, owner[element].bone.name,
          bone.name)
      end
      owner[element] = { name = name, key = element.key, bone = bone, element = element }
    end
  end
  for element, part in pairs(owner) do
    for i = #element.inside, 1, -1 do
      part.around = part.around or owner[element.inside[i]]
    end
    rig.parts[part.name] = part
  end
end

-- ---------------------------------------------------------------- the rig

---@class celspan.puppet.rig
---@field joints table<string, number[]> The joints of the drawing, by name
---@field mix fun(p: table, q: table, u: number): table The pose between two others, u from 0 to 1
---@field layer fun(p: table, q: table, share?: number): table A pose with the angles of another added
---@field mirror fun(p: table): table Left and right exchanged
local Rig = { __name = "celspan.puppet" }
local methods = {}
Rig.__index = fields.reads("a puppet", methods)

local known = { art = "any", joints = "table", bones = "table", switches = "table" }

--- The members of a switch in order; the first one is shown if a pose names none.
local function read_switches(rig, given)
  for set, members in next, given or {} do
    local names = members
    if type(set) == "number" then set, names = members, nil end
    local found, sorted = sets.members(rig.by_name, fields.key(set))
    if bones.reserved[set] or rig.bones[set] then
      refuse("a switch cannot have the name '%s': it is a %s", fields.key(set),
        bones.reserved[set] and "field of poses" or "bone")
    end
    if #sorted == 0 then
      refuse("switch '%s': the artwork has no parts '%s A', '%s B' and so on%s", fields.key(set),
        fields.key(set), fields.key(set), sets.hint(rig.by_name, fields.key(set)))
    end
    for _, name in ipairs(names or {}) do
      if not found[name] then
        refuse("switch '%s': there is no part '%s %s'%s", set, set, fields.key(name),
          help(name, sorted))
      end
    end
    rig.switches[set] = (names or sorted)[1]
  end
end

local function is_artwork(value)
  return is_of("celspan.svg", value) or is_of("celspan.layers.tree", value)
end

--- The parts of an artwork by name.
local function parts_of(art)
  if not is_artwork(art) then
    refuse("field 'art' must be what svg.read or layers.read returns, with its parts, got %s",
      fields.kind(art))
  end
  return (is_of("celspan.svg", art) and drawn_parts or painted_parts)(art)
end

local function new(_, given)
  fields.check("puppet", given, known)
  local rig = { art = given.art, bones = {}, list = {}, parts = {}, switches = {}, solids = {},
                kept = setmetatable({}, { __mode = "k" }) }
  rig.by_name = parts_of(given.art)
  rig.joints, rig.guides = drawn_joints(rig.by_name)
  bones.read(rig, given.joints, given.bones)
  join_parts(rig)
  read_switches(rig, given.switches)
  rig.mix, rig.layer = poses.mix, poses.layer
  rig.mirror = poses.mirror(rig.list[1].x)
  return setmetatable(rig, Rig)
end

--- A rig of artwork whose parts have the usual names.
local function figure(kind, given)
  if is_artwork(given) then refuse("write puppet.%s { art = ... }, a table", kind) end
  fields.check("puppet: " .. kind, given, known)
  local by_name = parts_of(given.art)
  local settings, about = people.settings(kind, given, by_name, (drawn_joints(by_name)))
  local rig = new(nil, settings)
  rig.__figure = about
  return rig
end

-- ---------------------------------------------------------------- poses

--- The values of each bone in a pose; and the chains, by their bones.
local function read_pose(rig, pose)
  if type(pose) ~= "table" then refuse("pose takes a table, got %s", fields.kind(pose)) end
  local turns, chains, choices = {}, {}, {}
  for set, choice in pairs(rig.switches) do choices[set] = choice end
  for name, value in next, pose do
    if rig.bones[name] then
      turns[rig.bones[name]] = bones.read_turn(name, value)
    elseif rig.switches[name] then
      choices[name] = value
    elseif not bones.reserved[name] then
      local names = names_of(rig.bones)
      for other in pairs(rig.switches) do names[#names + 1] = other end
      for other in pairs(bones.reserved) do names[#names + 1] = other end
      refuse("the pose has '%s', which is no bone, switch or field%s", fields.key(name),
        help(name, names))
    end
  end
  local targets = {}
  for joint in next, pose.reach or {} do targets[#targets + 1] = joint end
  table.sort(targets, function(a, b) return tostring(a) < tostring(b) end)
  for _, joint in ipairs(targets) do
    local target = bones.read_reach(rig, joint, pose.reach[joint])
    local chain = { bones = bones.chain_of(rig, joint, target.bones or 2), target = target,
                    joint = joint }
    for _, bone in ipairs(chain.bones) do
      if chains[bone] then
        refuse("bone '%s' is in two chains that reach: '%s' and '%s'", bone.name,
          chains[bone].joint, joint)
      end
      chains[bone] = chain
    end
  end
  return turns, chains, choices
end

--- The place of a pose: { x, y }; by default 0, 0.
local function place_of(pose)
  if pose.at == nil then return { 0, 0 } end
  fields.numbers("puppet", "at[%d]", pose.at, 2, "{x, y}")
  return pose.at
end

-- ---------------------------------------------------------------- pictures

--- The map of a part inside the part around it, which has been moved already.
local function inner_map(part, frames)
  local map = map_of(frames[part.bone])
  if not part.around then return map end
  return affine.compose(affine.inverse(map_of(frames[part.around.bone])), map)
end

--- The part whose order a pose changes, by its own name or the name of its bone.
local function ordered_part(rig, name)
  local part = rig.parts[name]
  if part then return part end
  local bone = rig.bones[name]
  if bone and #bone.parts == 1 then return rig.parts[bone.parts[1]] end
  refuse("the order of the pose names '%s', which is no part that moves, and no bone with one "
    .. "part%s", fields.key(name), help(name, names_of(rig.parts)))
end

--- The parts that are drawn in another order: lists by the part that they are over or under, and
--- lists of the parts in front of and behind everything.
local function read_order(rig, pose)
  local order = { over = {}, under = {}, front = {}, back = {}, moved = {} }
  local function move(list, name)
    local part = ordered_part(rig, name)
    if order.moved[part] then refuse("part '%s' is ordered twice", part.name) end
    order.moved[part] = true
    list[#list + 1] = part
  end
  for _, side in ipairs { "over", "under" } do
    local names = names_of(pose[side] or {})
    table.sort(names)
    for _, name in ipairs(names) do
      local other = ordered_part(rig, pose[side][name])
      order[side][other] = order[side][other] or {}
      move(order[side][other], name)
    end
  end
  for _, side in ipairs { "front", "back" } do
    for _, name in ipairs(pose[side] or {}) do move(order[side], name) end
  end
  return next(order.moved) and order
end

--- The objects for a list of parts, as they were drawn for the pose, in the coordinates of
--- `around`.
local function add_moved(objects, parts, drawn, around, frames)
  for _, part in ipairs(parts or {}) do
    local object = drawn[part]
    if object and around then
      object = object:transform(affine.matrix(affine.inverse(map_of(frames[around.bone]))))
    end
    objects[#objects + 1] = object
  end
end

--- The functions for art:with, by part. put(part, moved, outer): returns the replacement of a part.
--- moved: the part in the pose; outer: the matrix of the part around it, or nil. frames: nil for
--- the original drawing.
local function changes_of(rig, frames, choices, put)
  local changes = {}
  for _, part in pairs(rig.parts) do
    local matrix = frames and affine.matrix(inner_map(part, frames))
    local outer = frames and part.around and affine.matrix(map_of(frames[part.around.bone]))
    changes[part.key] = function(object)
      return put(part, matrix and object:transform(matrix) or object, outer)
    end
  end
  for _, name in ipairs(rig.guides) do changes[rig.by_name[name].key] = nothing end
  for _, name in ipairs(sets.hidden("puppet: pose", "the artwork", rig.by_name, choices)) do
    changes[rig.by_name[name].key] = nothing
  end
  return changes
end

--- Draws the parts, and lists them as they appear in the whole drawing. keep(moved): what remains
--- in the place of a part.
local function draw_parts(rig, frames, choices, keep)
  local drawn = {}
  local art = rig.art:with(changes_of(rig, frames, choices, function(part, moved, outer)
    drawn[part] = outer and moved:transform(outer) or moved
    return keep(moved)
  end))
  return art.object, drawn
end

local function same(object) return object end

local function draw(rig, pose, frames, choices)
  local order = read_order(rig, pose)
  local object, drawn = draw_parts(rig, frames, choices, same)
  if not order then return object end
  local objects = {}
  add_moved(objects, order.back, drawn)
  objects[#objects + 1] = rig.art:with(changes_of(rig, frames, choices, function(part, moved)
    local together = {}
    add_moved(together, order.under[part], drawn, part.around, frames)
    if not order.moved[part] then together[#together + 1] = moved end
    add_moved(together, order.over[part], drawn, part.around, frames)
    return celspan.union(together)
  end)).object
  add_moved(objects, order.front, drawn)
  return celspan.union(objects)
end

--- Where the bones are in a pose, its place and its choices. They are kept with the pose, because
--- most scripts ask for joints of the pose that they draw, and as long as it does not change.
local function place(rig, pose)
  local kept = rig.kept[pose or false]
  if not kept or getmetatable(pose) or not poses.equal(kept.pose, pose) then
    local turns, chains, choices = read_pose(rig, pose)
    kept = { pose = poses.copy(pose), choices = choices, at = poses.copy(place_of(pose)) }
    kept.frames = bones.place(turns, chains, kept.at)
    rig.kept[pose] = kept
  end
  return kept.frames, kept.at, kept.choices
end

-- ---------------------------------------------------------------- limbs that come apart

--- The original parts, each without the parts inside it. They are kept, because they are the same
--- in all poses with the same choices.
local function solids_of(rig, choices)
  local hidden = sets.hidden("puppet: pose", "the artwork", rig.by_name, choices)
  table.sort(hidden)
  local key = table.concat(hidden, "\n")
  if not rig.solids[key] then
    local _, drawn = draw_parts(rig, nil, choices, nothing)
    rig.solids[key] = drawn
  end
  return rig.solids[key]
end

--- Whether the artwork of a bone covers a point of the pose.
local function covers(solids, bone, frames, x, y)
  x, y = affine.apply(affine.inverse(map_of(frames[bone])), x, y)
  for part, object in pairs(solids) do
    if part.bone == bone and object:contains(x, y) then return true end
  end
  return false
end

--- The bones with artwork whose parents also have artwork.
local function is_jointed(bone)
  return bone.parent and not bone.apart and #bone.parts > 0 and #bone.parent.parts > 0
end

local function gaps_in(rig, frames, at, choices)
  local gaps = {}
  local solids = solids_of(rig, choices)
  for _, bone in ipairs(rig.list) do
    if is_jointed(bone) then
      local x, y = affine.apply(frames[bone].frame, bone.x, bone.y)
      if not (covers(solids, bone, frames, x, y)
        and covers(solids, bone.parent, frames, x, y)) then
        gaps[#gaps + 1] = { bone = bone.name, parent = bone.parent.name, joint = bone.from,
                            x = x + at[1], y = y + at[2] }
      end
    end
  end
  return gaps
end

--- The bones whose artwork is separated from that of their parents in a pose: they do not both
--- cover the joint between them.
---@param pose? table At rest by default
---@return { bone: string, parent: string, joint: string, x: number, y: number }[]
function methods:gaps(pose)
  fields.self("puppet", Rig, self, "gaps")
  return gaps_in(self, place(self, pose or {}))
end

local MISSED = 0.5 -- units: a joint that is nearer than this has reached its target

--- Joints that do not reach their targets, in their order.
local function missed_in(rig, pose, frames, at)
  local missed = {}
  for joint, target in pairs(pose.reach or {}) do
    local x, y = bones.joint_in(rig, frames, joint)
    x, y = x + at[1] - target[1], y + at[2] - target[2]
    if not target.loose and x * x + y * y > MISSED * MISSED then missed[#missed + 1] = joint end
  end
  table.sort(missed)
  return missed
end

--- Reports warnings for `celspan check`.
local function warn(rig, pose, frames, at, choices)
  for _, joint in ipairs(missed_in(rig, pose, frames, at)) do
    native.warn(("puppet: the joint '%s' does not reach its target: its bones are too short for it,"
      .. " or have limits; move the whole with `at`, or give the target loose = true")
      :format(joint))
  end
  for _, gap in ipairs(gaps_in(rig, frames, at, choices)) do
    native.warn(("puppet: '%s' and '%s' come apart at the joint '%s': let the drawings of both"
      .. " cover it, or give the bone apart = true"):format(gap.bone, gap.parent, gap.joint))
  end
end

-- ---------------------------------------------------------------- poses as objects

--- The artwork in a pose.
---@param pose table Degrees by bone, `at`, `reach`, switches, `over`, `under`, `front`, `back`
---@return celspan.object
function methods:pose(pose)
  fields.self("puppet", Rig, self, "pose")
  local frames, at, choices = place(self, pose)
  if native.warns() then warn(self, pose, frames, at, choices) end
  local object = draw(self, pose, frames, choices)
  if at[1] == 0 and at[2] == 0 then return object end
  return object:translate(at[1], at[2])
end

--- Where a joint is in a pose.
---@param pose table
---@param name string
---@return number x, number y
function methods:joint(pose, name)
  fields.self("puppet", Rig, self, "joint")
  if not self.joints[name] then
    refuse("there is no joint '%s'%s", fields.key(name), help(name, names_of(self.joints)))
  end
  local frames, at = place(self, pose)
  local x, y = bones.joint_in(self, frames, name)
  return x + at[1], y + at[2]
end

--- How far the figure has gone in a gait: what moves its poses on, so that the feet stay.
---@param time number Seconds
---@param options? celspan.puppet.options
---@return number
function methods:walked(time, options)
  fields.self("puppet", Rig, self, "walked")
  return people.walked(self, time, options)
end

--- A tail, a scarf or a plait that hangs on a joint and follows it.
---@param settings { joint: string, pose: (fun(time: number): table), length: number, links?: integer, angle?: number|(fun(time: number): number), stiffness?: number, damping?: number, wind?: number[]|(fun(time: number): number, number) } pose: the pose at a time, also before 0; links: how many (6); angle: degrees of the way in which it hangs, clockwise from the right (90: down); stiffness: swings per second of the first link (2); damping: 0.05 to 1 (0.3); wind: {x, y}, where 1 is as strong as its weight
---@return celspan.puppet.tail
function methods:tail(settings)
  fields.self("puppet", Rig, self, "tail")
  return tail(self, settings)
end

-- ---------------------------------------------------------------- the sheet

--- The puppet with its bones, joints and limits drawn over it, for inspection.
---@param pose? table At rest by default
---@param options? { size?: number, font?: string } size: of a joint, in units of the artwork (5); font: a file, to write the names
---@return celspan.object
function methods:sheet(pose, options)
  fields.self("puppet", Rig, self, "sheet")
  options = options or {}
  fields.check("puppet: sheet", options, { size = "number", font = "string" })
  pose = pose or {}
  local frames, at, choices = place(self, pose)
  local marks = puppet_sheet(self, frames, options)
  table.insert(marks, 1, draw(self, pose, frames, choices):fade(0.4))
  return celspan.union(marks):translate(at[1], at[2])
end

---@class celspan.puppet.options
---@field stride? number The way while each foot makes one step, in units; default: by the legs
---@field pace? number Steps a second, more than 0; default 2 of walk, 3 of run
---@field bounce? number How far the body goes up and down, in units; default: by the legs
---@field gait? "walk"|"run"|"trot"|"gallop" For rig:walked; default "walk"

---@class celspan.puppet
---@overload fun(settings: table): celspan.puppet.rig
local puppet = {}

--- Feet that walk: each one stays at its place on the ground while the body moves over it.
---@param settings { stride: number, period: number, lift?: number, ground: number, x?: number, share?: number } stride: what the body moves in a period, in which each foot makes one step, negative to the left; lift: of a foot (stride / 8); ground: y of the joint on the ground; x: of the joint in the drawing (0); share: of the period that a foot is on the ground (0.6)
---@return celspan.puppet.steps
function puppet.steps(settings) return steps(settings) end

--- A rig of a drawing whose parts have the usual names: head, body, upper arm, lower arm, hand,
--- thigh, shin, foot, each limb near or far. puppet.person { art = svg.load "hero.svg" }
---@param settings { art: celspan.svg|celspan.layers.tree, joints?: table<string, number[]>, bones?: table[], switches?: table }
---@return celspan.puppet.rig
function puppet.person(settings) return figure("person", settings) end

--- A rig of an animal with four legs, of the usual names: body, head, tail, ear, thigh, shank,
--- foot, upper, fore, paw. puppet.animal { art = layers.load "fox.ora" }
---@param settings { art: celspan.svg|celspan.layers.tree, joints?: table<string, number[]>, bones?: table[], switches?: table }
---@return celspan.puppet.rig
function puppet.animal(settings) return figure("animal", settings) end

--- A walk in place: rig:pose(puppet.walk(rig, time)):translate(rig:walked(time), 0).
---@param rig celspan.puppet.rig What puppet.person or puppet.animal returns
---@param time number Seconds, of any size
---@param options? celspan.puppet.options
---@return table pose
function puppet.walk(rig, time, options) return people.pose(rig, "walk", time, options) end

--- A run in place, which rig:walked(time, { gait = "run" }) moves on.
---@param rig celspan.puppet.rig What puppet.person or puppet.animal returns
---@param time number Seconds, of any size
---@param options? celspan.puppet.options
---@return table pose
function puppet.run(rig, time, options) return people.pose(rig, "run", time, options) end

--- A trot in place, of an animal, which rig:walked(time, { gait = "trot" }) moves on.
---@param rig celspan.puppet.rig What puppet.person or puppet.animal returns
---@param time number Seconds, of any size
---@param options? celspan.puppet.options
---@return table pose
function puppet.trot(rig, time, options) return people.pose(rig, "trot", time, options) end

--- A gallop in place, of an animal, which rig:walked(time, { gait = "gallop" }) moves on.
---@param rig celspan.puppet.rig What puppet.person or puppet.animal returns
---@param time number Seconds, of any size
---@param options? celspan.puppet.options
---@return table pose
function puppet.gallop(rig, time, options) return people.pose(rig, "gallop", time, options) end

--- A pose that breathes in its place, the feet on the ground: for rig:pose.
---@param rig celspan.puppet.rig What puppet.person or puppet.animal returns
---@param time number Seconds, of any size
---@return table pose
function puppet.idle(rig, time) return people.idle(rig, time) end

--- A raised arm that waves: rig.layer(puppet.idle(rig, time), puppet.wave(rig, time)).
---@param rig celspan.puppet.rig What puppet.person returns
---@param time number Seconds, of any size
---@param options? { side?: string } side: "near" (default) or "far"
---@return table pose
function puppet.wave(rig, time, options) return people.wave(rig, time, options) end

--- The head turned.
---@param rig celspan.puppet.rig
---@param degrees number Clockwise
---@return table pose
function puppet.turn_head(rig, degrees) return people.turn_head(rig, degrees) end

return fields.publish("puppet", setmetatable(puppet, { __call = native.entry(new) }), methods)
