--- People and animals: bones found by the names of the parts, and poses that walk, run, wait and
--- wave. celspan.puppet has them as `person`, `animal`, `walk` and so on.
--
--   parts    "upper arm near", "arm_l", "left arm", "Forearm.R"    a side is near or far
--   joints   those that are drawn, "joint knee near"; where one is not, it lies at the round end
--            of its part: half the part's width before its edge
--   poses    in place: the feet move back under the body as fast as `walked` moves it on
local bones = require "celspan.bones"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"
local steps = require "celspan.steps"

local people = {}

local refuse = bones.refuse

-- ---------------------------------------------------------------- names

local sides = { near = "near", left = "near", l = "near", far = "far", right = "far", r = "far" }

--- A name in its plain form, with its side at the end: "arm near" of "arm_l" and "LeftArm".
local function plain(name)
  local words, side = {}, nil
  for word in name:gsub("(%l)(%u)", "%1 %2"):lower():gmatch "%a+" do
    if sides[word] then side = sides[word] else words[#words + 1] = word end
  end
  words[#words + 1] = side
  return table.concat(words, " ")
end

--- The names of a table by their plain form; of two that have the same, the first in order.
local function by_plain(map)
  local found = {}
  for _, name in ipairs(ordered.names(map)) do found[plain(name)] = found[plain(name)] or name end
  return found
end

-- Each row: the bone, its two joints, the words for its part; on: the bone that it hangs on, where
-- that is not the row before; limits: of a figure that faces right.
local rows = {
  person = {
    { "body", "hip", "neck", "body|torso|trunk|chest|coat" },
    { "head", "neck", "crown", "head", on = "body" },
    { "upper arm", "shoulder", "elbow", "upper arm|upperarm|upper|arm", on = "body", sided = true },
    { "lower arm", "elbow", "wrist|hand", "lower arm|forearm|fore arm|fore|lowerarm",
      limits = { -150, 0 }, sided = true },
    { "hand", "wrist|hand", "fingers", "hand", sided = true },
    { "thigh", "hip", "knee", "thigh|upper leg|upperleg|leg", on = "body", sided = true },
    { "shin", "knee", "ankle", "shin|lower leg|lowerleg|calf", limits = { 0, 150 }, sided = true },
    { "foot", "ankle", "toe|toes", "foot|shoe|boot", sided = true },
  },
  animal = {
    { "body", "rump", "withers", "body|trunk" },
    { "head", "withers|neck", "nose", "head", on = "body" },
    { "tail", "rump", "bend|tail end", "tail", on = "body" },
    { "brush", "bend", "tip", "brush|tail end|tuft" },
    { "ear", "ear root", "ear tip", "ear", on = "head", sided = true },
    { "thigh", "hip", "knee", "thigh|hind upper", on = "body", sided = true },
    { "shank", "knee", "hock", "shank|shin|hind lower", sided = true },
    { "foot", "hock", "toe", "foot|hind paw|hind foot", sided = true },
    { "upper", "shoulder", "elbow", "upper|upper arm|front upper", on = "body", sided = true },
    { "fore", "elbow", "wrist", "fore|forearm|lower arm|front lower", sided = true },
    { "paw", "wrist", "nail", "paw|hand|front paw|front foot", sided = true },
  },
}

--- The bones that carry a foot, the joint that reaches, and the share of the period by which the
--- foot is ahead.
local legs = {
  person = { { "thigh", "shin", "foot", "ankle", walk = 0, run = 0 } },
  animal = { { "thigh", "shank", "foot", "hock", walk = 0, trot = 0.12, gallop = 0 },
             { "upper", "fore", "paw", "wrist", walk = 0.25, trot = 0.5, gallop = 0.5 } },
}

-- ---------------------------------------------------------------- bones

--- The middles of the two round ends of a part, the upper or left one first.
local function ends_of(object)
  local x, y, w, h = object:bounds()
  if w > h then return { x + h / 2, y + h / 2 }, { x + w - h / 2, y + h / 2 } end
  return { x + w / 2, y + w / 2 }, { x + w / 2, y + h - w / 2 }
end

--- The name of a joint: of the side, or drawn for both sides; nil if there is none.
local function joint_named(plan, words, side)
  for word in words:gmatch "[^|]+" do
    local whole = side and word .. " " .. side or word
    local found = plan.known[whole] or plan.own[whole] or plan.known[word]
    if found then return found end
  end
end

--- Finds or makes the two joints of a bone.
local function joints_of(plan, row, side, part)
  local first, last = ends_of(part.object)
  if row[1] == "body" or row[1] == "head" then first, last = last, first end
  local from, to = joint_named(plan, row[2], side), joint_named(plan, row[3], side)
  local function far(place)
    return (place[1] - plan.places[from][1]) ^ 2 + (place[2] - plan.places[from][2]) ^ 2
  end
  if from and far(first) > far(last) then last = first end -- drawn the other way round
  local function make(words, place)
    local name = words:match "^[^|]+" .. (side and " " .. side or "")
    plan.own[name], plan.places[name], plan.made[name] = name, place, place
    return name
  end
  return from or make(row[2], first), to or make(row[3], last)
end

--- Adds the bone of a row, if the artwork has its part.
local function add_bone(plan, row, side, before)
  local name = side and row[1] .. " " .. side or row[1]
  for word in row[4]:gmatch "[^|]+" do
    local part = plan.parts[side and word .. " " .. side or word]
    if part and not plan.taken[part] and plan.by_name[part].object:bounds() then
      local from, to = joints_of(plan, row, side, plan.by_name[part])
      local bone = { name, from = from, to = to, parts = { part }, parent = before,
                     limits = row.limits }
      plan.taken[part], plan.has[name], plan.bones[#plan.bones + 1] = true, bone, bone
      return
    end
  end
end

--- The bone on which that of a row hangs: the nearest before it that exists.
local function bone_before(plan, list, i, side)
  for k = i, 1, -1 do
    if list[k].on then return plan.has[list[k].on] and list[k].on or "body" end
    local name = k > 1 and list[k - 1][1] .. (side and " " .. side or "")
    if plan.has[name] then return name end
  end
end

--- 1, or -1 for a figure whose foot points to the left. Turns the limits of that one.
local function face(plan)
  local foot = plan.has["foot near"] or plan.has["foot far"]
  if not foot or plan.places[foot.to][1] >= plan.places[foot.from][1] then return 1 end
  for _, bone in ipairs(plan.bones) do
    local limits = bone.limits
    bone.limits = limits and { -limits[2], -limits[1] }
  end
  return -1
end

--- The settings of a puppet for artwork with the usual names. kind: "person" or "animal"; by_name,
--- drawn: the parts and the joints of the artwork.
function people.settings(kind, given, by_name, drawn)
  local plan = { parts = by_plain(by_name), by_name = by_name, known = by_plain(drawn), own = {},
                 places = {}, made = {}, taken = {}, has = {}, bones = {} }
  for name, place in pairs(drawn) do plan.places[name] = place end
  for name, place in pairs(bones.read_joints(given.joints, {})) do
    plan.known[plain(name)], plan.places[name], plan.made[name] = name, place, place
  end
  for i, row in ipairs(rows[kind]) do
    for _, side in ipairs(row.sided and { "near", "far" } or { false }) do
      add_bone(plan, row, side, bone_before(plan, rows[kind], i, side))
    end
    if i == 1 and not plan.has.body then
      refuse("the artwork has no part 'body': %s needs one, named %s", kind,
        row[4]:gsub("|", " or "))
    end
  end
  local facing = face(plan)
  for i = 1, rawlen(given.bones or {}) do plan.bones[#plan.bones + 1] = given.bones[i] end
  return { art = given.art, joints = plan.made, bones = plan.bones, switches = given.switches },
    { kind = kind, facing = facing, has = plan.has }
end

-- ---------------------------------------------------------------- gaits

--- stride: the way while each foot makes one step, and lift, bounce: shares of the leg; pace: steps
--- a second; share: of the time that a foot is on the ground; lean, swing, bend: degrees.
local gaits = {
  walk = { stride = 1.4, pace = 2, share = 0.58, lift = 0.17, bounce = 0.045, lean = 4, swing = 26,
           bend = 18 },
  run = { stride = 2.6, pace = 3, share = 0.32, lift = 0.4, bounce = 0.06, lean = 10, swing = 48,
          bend = 80 },
  trot = { stride = 1.7, pace = 2.8, share = 0.52, lift = 0.2, bounce = 0.035, lean = 1 },
  gallop = { stride = 3, pace = 4, share = 0.4, lift = 0.3, bounce = 0.08, lean = 4 },
}

local known = { stride = "number", pace = "number", bounce = "number", gait = "string" }

local function refuse_time(name, time)
  fields.expect(fields.is_finite(time), time, "puppet: %s takes a time, a finite number", name)
end

--- The legs of a rig: their bones, the joint that reaches and where it is at rest, and how long the
--- two bones are that reach.
local function legs_of(rig)
  local figure, list = rig.__figure, {}
  if figure.legs then return figure.legs end
  for _, leg in ipairs(legs[figure.kind]) do
    for _, side in ipairs { " near", " far" } do
      local upper, lower = rig.bones[leg[1] .. side], rig.bones[leg[2] .. side]
      if upper and lower then
        list[#list + 1] = { joint = lower.to, x = lower.end_x, y = lower.end_y, of = leg,
          foot = rig.bones[leg[3] .. side] and leg[3] .. side, is_far = side == " far",
          length = upper.length + lower.length, height = lower.end_y - upper.y }
      end
    end
  end
  if #list == 0 then refuse("the %s has no legs: parts such as 'thigh near' and 'shin near'",
    figure.kind) end
  figure.legs = list
  return list
end

--- The gait that options ask for, in units and seconds.
local function gait_of(rig, name, options)
  if type(rig) ~= "table" or not rawget(rig, "__figure") then
    refuse("%s takes what puppet.person or puppet.animal returns, got %s", name, fields.kind(rig))
  end
  options = options or {}
  fields.check("puppet: " .. name, options, known)
  local gait = gaits[options.gait or name]
  if options.gait and not gait then
    refuse("there is no gait '%s'%s", options.gait,
      fields.choice(options.gait, ordered.names(gaits)))
  end
  gait = gait or gaits.walk
  local leg = legs_of(rig)[1].length
  local pace = options.pace or gait.pace
  fields.must(pace > 0, "puppet: " .. name .. ": field 'pace'", "more than 0", pace)
  return gait, { stride = (options.stride or gait.stride * leg) * rig.__figure.facing,
    period = 2 / pace, share = gait.share, lift = gait.lift * leg },
    options.bounce or gait.bounce * leg
end

--- How far the body has gone: what moves the poses of walk, run, trot and gallop on.
function people.walked(rig, time, options)
  local _, step = gait_of(rig, options and options.gait or "walk", options)
  refuse_time("walked", time)
  return step.stride * time / step.period
end

--- How low the body is: so that the legs reach their first and last place on the ground, and up
--- and down twice a period. It is lowest while both feet are on the ground, or, if that never is,
--- in the middle of the time of a foot there.
local function lowered(list, step, bounce, cycle)
  local low = step.share < 0.5 and step.share / 2 or (step.share - 0.5) / 2
  local sink = 0
  for _, leg in ipairs(list) do
    local reach = leg.length ^ 2 - (step.stride * step.share / 2) ^ 2
    sink = math.max(sink, leg.height - math.sqrt(math.max(0, reach)))
  end
  return sink + bounce * (math.cos(4 * math.pi * (cycle - low))
    + math.max(0, -math.cos(4 * math.pi * low)))
end

local function wave(cycle) return math.sin(2 * math.pi * cycle) end

--- Adds arms that swing against the legs, ears and a tail, where the figure has them.
local function add_limbs(pose, rig, gait, cycle)
  local facing, has = rig.__figure.facing, rig.__figure.has
  local function set(name, degrees) if has[name] then pose[name] = facing * degrees end end
  set("body", gait.lean + (rig.__figure.kind == "animal" and 1.2 * wave(2 * cycle) or 0))
  set("head", wave(cycle) - 0.75 * gait.lean)
  for side, ahead in pairs { near = 0.25, far = 0.75 } do
    local swing = wave(cycle + ahead)
    set("upper arm " .. side, (gait.swing or 0) * swing)
    set("lower arm " .. side, (gait.bend or 0) * (0.5 * swing - 1))
    set("ear " .. side, 3 * wave(2 * cycle + 0.3))
  end
  set("tail", 8 + 5 * wave(2 * cycle - 0.5))
  set("brush", 9 * wave(2 * cycle - 0.8))
end

--- The pose of a gait at a time, in place.
function people.pose(rig, name, time, options)
  local gait, step, bounce = gait_of(rig, name, options)
  refuse_time(name, time)
  local list, cycle = legs_of(rig), time / step.period
  local pose = { reach = {}, at = { 0, lowered(list, step, bounce, cycle) } }
  add_limbs(pose, rig, gait, cycle)
  for _, leg in ipairs(list) do
    local phase = (leg.of[name] or leg.of.walk) + (leg.is_far and (name == "gallop" and 0.12 or 0.5)
      or 0)
    local walk = steps { stride = step.stride, period = step.period, share = step.share,
      lift = step.lift, ground = leg.y, x = leg.x }
    local x, y, air = walk:foot(time, phase)
    pose.reach[leg.joint] = { x - walk:body(time), y, loose = air > 0 or nil }
    if leg.foot then
      pose[leg.foot] = { absolute = rig.__figure.facing * 34 * (rig.__figure.kind == "animal"
        and math.sin(math.pi * air) or wave(air)) }
    end
  end
  return pose
end

--- A pose that breathes, with the feet where they are drawn.
function people.idle(rig, time)
  local _, _, bounce = gait_of(rig, "idle")
  refuse_time("idle", time)
  local breath = (1 - math.cos(2 * math.pi * time / 3.5)) / 2
  local pose = { at = { 0, bounce * (1 - breath) / 4 }, reach = {} }
  add_limbs(pose, rig, { lean = breath, swing = 3, bend = 4 }, 0.2 * time)
  pose.body = { rotate = pose.body, stretch = 1 + 0.015 * breath }
  for _, leg in ipairs(legs_of(rig)) do
    pose.reach[leg.joint] = { leg.x, leg.y }
    if leg.foot then pose[leg.foot] = { absolute = 0 } end
  end
  return pose
end

--- A raised arm that waves; the rest of the figure is at rest. options: { side = "near" }.
function people.wave(rig, time, options)
  gait_of(rig, "wave")
  refuse_time("wave", time)
  fields.check("puppet: wave", options or {}, { side = "string" })
  local side = sides[options and options.side or "near"]
  if not side or not rig.__figure.has["upper arm " .. side] then
    refuse("wave: the figure has no arm on the side %q; the sides are near and far",
      options and options.side or "near")
  end
  local facing = rig.__figure.facing
  return { ["upper arm " .. side] = -125 * facing,
           ["lower arm " .. side] = facing * (22 * wave(2 * time) - 12), head = -4 * facing }
end

--- A pose with the head turned, in degrees, clockwise.
function people.turn_head(rig, degrees)
  gait_of(rig, "turn_head")
  fields.expect(fields.is_finite(degrees), degrees, "puppet: turn_head takes degrees, a number")
  return { head = degrees }
end

return fields.seal("people", people)
