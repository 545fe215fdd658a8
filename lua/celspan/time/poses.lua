--- Poses as values: mixed, layered and mirrored. A pose is a table as celspan.puppet takes it.
local fields = require "celspan.fields"

local poses = {}

--- Fields of a bone whose value at rest is not 0.
local rest = { scale = 1, stretch = 1 }

local function check(what, pose)
  fields.expect_kind(type(pose) == "table", pose, "puppet: %s takes poses, which are tables", what)
end

local function check_share(what, u)
  fields.expect(fields.is_finite(u), u, "puppet: %s takes a share, a finite number", what)
end

-- ---------------------------------------------------------------- copies

local DEEPEST = 4 -- tables in tables of a pose: reach, a joint, its pole

--- A pose that does not change with the tables of another.
function poses.copy(pose, depth)
  depth = depth or DEEPEST
  if type(pose) ~= "table" or depth == 0 then return pose end
  local copy = {}
  for key, value in next, pose do copy[key] = poses.copy(value, depth - 1) end
  return copy
end

--- Whether two poses have the same values.
function poses.equal(p, q, depth)
  depth = depth or DEEPEST
  if rawequal(p, q) then return true end
  if type(p) ~= "table" or type(q) ~= "table" or depth == 0 then return false end
  for key, value in next, p do
    if not poses.equal(value, rawget(q, key), depth - 1) then return false end
  end
  for key in next, q do
    if rawget(p, key) == nil then return false end
  end
  return true
end

-- ---------------------------------------------------------------- mixes

--- The keys of two tables.
local function both(p, q)
  local keys = {}
  for key in next, p do keys[key] = true end
  for key in next, q do keys[key] = true end
  return keys
end

--- One of two values that cannot be mixed: the second from the middle on.
local function choose(a, b, u)
  if u < 0.5 then return a end
  return b
end

local mix_values

--- Tables are mixed key by key. A key that one of them lacks has the value of `rest`, or 0 for a
--- bone; with `is_held` (places, points), the value of the other table.
local function mix_tables(a, b, u, is_held)
  local mixed = {}
  for key in next, both(a, b) do
    local x, y = a[key], b[key]
    local least = rest[key] or type(x or y) == "number" and key ~= "absolute" and 0 or nil
    if x == nil then x = is_held and y or least end
    if y == nil then y = is_held and x or least end
    mixed[key] = mix_values(x, y, u, is_held)
  end
  return mixed
end

function mix_values(a, b, u, is_held)
  local first, second = type(a), type(b)
  if first == "number" and second == "table" then a, first = { rotate = a }, "table" end
  if first == "table" and second == "number" then b, second = { rotate = b }, "table" end
  if first == "table" and (second == "table" or b == nil) and not is_held then
    return mix_tables(a, b or {}, u)
  end
  if second == "table" and a == nil and not is_held then return mix_tables({}, b, u) end
  if first ~= second then return choose(a, b, u) end
  if first == "number" then return a + (b - a) * u end
  if first == "table" then return mix_tables(a, b, u, is_held) end
  return choose(a, b, u)
end

local held = { at = false, reach = true, over = true, under = true, front = true, back = true }

--- The pose between two others. Angles, scales and points are mixed; a bone that one pose does not
--- have is at rest there; switches and orders change in the middle.
---@param p table
---@param q table
---@param u number 0: p, 1: q; more and less continue beyond them
---@return table pose
function poses.mix(p, q, u)
  check("mix", p)
  check("mix", q)
  check_share("mix", u)
  local mixed = {}
  for key in next, both(p, q) do
    local a, b = p[key], q[key]
    if key == "over" or key == "under" or key == "front" or key == "back" then
      mixed[key] = choose(a, b, u)
    elseif held[key] then
      mixed[key] = mix_tables(a or {}, b or {}, u, true)
    else
      if a == nil and type(b) == "number" then a = 0 end
      if b == nil and type(a) == "number" then b = 0 end
      mixed[key] = mix_values(a, b, u)
    end
  end
  return mixed
end

--- Adds a share of another value: angles are added, scales multiplied, all other values replaced.
local function add(a, b, share, key)
  if type(b) == "number" and type(a) == "table" and not rest[key] then b = { rotate = b } end
  if type(b) == "table" and type(a) == "number" then a = { rotate = a } end
  if type(b) == "number" then
    if rest[key] then return (a or 1) * b ^ share end
    return (a or 0) + b * share
  end
  if type(b) ~= "table" then return choose(a, b, share) end
  local sum = {}
  for name, value in next, a or {} do sum[name] = value end
  for name, value in next, b do sum[name] = add(sum[name], value, share, name) end
  return sum
end

--- A pose with a share of another one added: the angles and the place are added, scales are
--- multiplied. From a share of one half on, the switches, orders and targets of the other pose
--- replace those of this one.
---@param p table
---@param q table
---@param share? number 1 by default
---@return table pose
function poses.layer(p, q, share)
  share = share or 1
  check("layer", p)
  check("layer", q)
  check_share("layer", share)
  local sum = {}
  for key, value in next, p do sum[key] = value end
  for key, value in next, q do
    if held[key] then
      sum[key] = choose(sum[key], value, share)
    else
      sum[key] = add(sum[key], value, share, key)
    end
  end
  return sum
end

-- ---------------------------------------------------------------- mirrors

local opposite = { left = "right", right = "left", near = "far", far = "near", l = "r", r = "l" }

--- A word in the letter case of another word: Left, LEFT, left.
local function cased(word, like)
  if like == like:upper() then return word:upper() end
  if like:sub(1, 1) == like:sub(1, 1):upper() then
    return word:sub(1, 1):upper() .. word:sub(2)
  end
  return word
end

--- The name of the other side: "arm left" of "arm right", "L hand" of "R hand".
local function other_name(name)
  if type(name) ~= "string" then return name end
  return (name:gsub("%a+", function(word)
    local other = opposite[word:lower()]
    return other and cased(other, word)
  end))
end

--- Changes the sign of angles.
local function mirror_turn(value)
  if type(value) == "number" then return -value end
  if type(value) ~= "table" then return value end
  local turned = {}
  for name, number in next, value do
    turned[name] = (name == "rotate" or name == "absolute") and -number or number
  end
  return turned
end

local function mirror_names(list)
  local names = {}
  for key, value in next, list do names[other_name(key)] = other_name(value) end
  return names
end

--- A target and its pole, mirrored at the vertical line through x.
local function mirror_target(target, x)
  local other = {}
  for key, value in next, target do other[key] = value end
  other[1] = 2 * x - target[1]
  if target.pole then other.pole = { 2 * x - target.pole[1], target.pole[2] } end
  return other
end

--- Returns the function that mirrors poses about the vertical through x.
---@param x number
---@return fun(pose: table): table
function poses.mirror(x)
  return function(pose)
    check("mirror", pose)
    local other = {}
    for key, value in next, pose do
      if key == "at" then
        other.at = { -value[1], value[2] }
      elseif key == "reach" then
        other.reach = {}
        for joint, target in next, value do
          other.reach[other_name(joint)] = mirror_target(target, x)
        end
      elseif held[key] then
        other[key] = mirror_names(value)
      else
        other[other_name(key)] = mirror_turn(value)
      end
    end
    return other
  end
end

return fields.seal("poses", poses)
