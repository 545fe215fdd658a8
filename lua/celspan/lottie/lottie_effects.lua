--- Effects of layers that celspan has: tint, fill, levels, blur and drop shadow; and of the layer
--- styles the drop shadow. Others are noted.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local effects = {}

local BLUR = 0.6 -- the radius of a Gaussian, which is two sigmas, for After Effects' amount of 1
local LUMA = { native.luma() }
local FAR = 1e5 -- units: beyond every layer

--- Reads the parameters of an effect by their places, from 0.
local function reader(scope, item)
  local list, read, moves = values.table(item.ef) or {}, property.reader(scope)
  local function value(place)
    local one = values.table(list[place + 1])
    return one and one.v
  end
  local function number(place, default)
    return read(property.number, value(place), "the effect", default)
  end
  local function colour(place) return read(property.colour, value(place), "the effect") end
  return number, colour, moves
end

--- An object whose colours have been through a grade, in sRGB codes.
local function graded(object, grade)
  return celspan.group { object, space = "srgb", grade = grade }
end

local function held(x) return x < 0 and 0 or x > 1 and 1 or x end

local readers = {}

--- Tint: from black to white, two other colours, by luminance.
readers[20] = function(scope, item)
  local number, colour, moves = reader(scope, item)
  local black, white, amount = colour(0), colour(1), number(2, 100)
  return function(t, object)
    local b, w, k, matrix = black(t), white(t), held(amount(t) / 100), {}
    for row = 1, 3 do
      local d = k * (w[row] - b[row])
      matrix[row] = { d * LUMA[1], d * LUMA[2], d * LUMA[3], k * b[row] }
      matrix[row][row] = matrix[row][row] + 1 - k
    end
    return graded(object, { matrix = matrix })
  end, moves
end

--- Fill: the shape in one colour.
readers[21] = function(scope, item)
  local number, colour, moves = reader(scope, item)
  local fill, opacity = colour(2), number(6, 1)
  return function(t, object)
    local c, share = fill(t), held(opacity(t))
    local plain = celspan.matte(celspan.rect { -FAR, -FAR, 2 * FAR, 2 * FAR,
                                               texture = paint.coded(c[1], c[2], c[3], 1) }, object)
    if share == 1 then return plain end
    return celspan.group { object, plain:fade(share) }
  end, moves
end

--- Drop shadow. Angles are clockwise from up.
local function shadow(colour, opacity, degrees, distance, softness, only)
  return function(t, object)
    local c, angle, far = colour(t), math.rad(degrees(t)), distance(t)
    return object:shadow { offset = { math.sin(angle) * far, -math.cos(angle) * far },
                           blur = math.max(0, softness(t) * BLUR), only = only(t) > 0.5,
                           colour = paint.coded(c[1], c[2], c[3], 1), opacity = held(opacity(t)) }
  end
end

readers[25] = function(scope, item)
  local number, colour, moves = reader(scope, item)
  local opacity = number(1, 255)
  return shadow(colour(0), function(t) return opacity(t) / 255 end, number(2, 0), number(3, 0),
    number(4, 0), number(5, 0)), moves
end

--- Gaussian blur. Skia takes a sigma of 0.3 of the amount, and so does this.
readers[29] = function(scope, item)
  local number, _, moves = reader(scope, item)
  local amount, along = number(0, 0), number(1, 1)
  if along(0) ~= 1 then scope.note "a blur along one axis is shown along both" end
  return function(t, object)
    local radius = amount(t) * BLUR
    return radius > 0 and object:blur(radius) or object
  end, moves
end

--- The curve of levels; 17 places are enough for a smooth power.
local function levels_curve(low, high, gamma, out_low, out_high)
  local curve, span = {}, math.max(1e-4, high - low)
  for i = 0, 16 do
    local u = i / 16
    curve[i + 1] = { low + span * u, out_low + (out_high - out_low) * u ^ (1 / math.max(0.01,
      gamma)) }
  end
  return curve
end

readers[24] = function(scope, item)
  local number, _, moves = reader(scope, item)
  if item.mn ~= "ADBE Easy Levels2" then
    scope.note "levels by channel are left out"
    return nil
  end
  local low, high, gamma = number(2, 0), number(3, 1), number(4, 1)
  local out_low, out_high = number(5, 0), number(6, 1)
  return function(t, object)
    return graded(object, { curve = levels_curve(low(t), high(t), gamma(t), out_low(t),
      out_high(t)) })
  end, moves
end

-- ---------------------------------------------------------------- lists

local is_control = { [0] = true, [1] = true, [2] = true, [3] = true, [4] = true, [5] = true,
                     [6] = true, [7] = true, [10] = true, [11] = true }

local function add(list, change, moves)
  if not change then return false end
  list[#list + 1] = change
  return moves()
end

local function add_effects(scope, item, list)
  local moves = false
  for _, one in ipairs(values.items(item.ef)) do
    local effect = one[2]
    local own = scope.within((".ef[%d]"):format(one[1] - 1), effect.nm)
    if effect.en == 0 then own = nil end
    if own and readers[effect.ty] then
      moves = add(list, readers[effect.ty](own, effect)) or moves
    elseif own and not is_control[effect.ty] then
      own.note(("the effect %s is left out"):format(values.name(effect.mn, fields.key(effect.ty))))
    end
  end
  return moves
end

--- Layer styles. The light of a shadow comes from an angle, anticlockwise from the right.
local function add_styles(scope, item, list)
  local moves = false
  for _, one in ipairs(values.items(item.sy)) do
    local style = one[2]
    local own = scope.within((".sy[%d]"):format(one[1] - 1), style.nm)
    if style.ty == 1 then
      local read, is_moving = property.reader(own)
      local function number(name, default)
        return read(property.number, style[name], "the shadow", default)
      end
      local opacity, angle = number("o", 75), number("a", 120)
      moves = add(list, shadow(property.colour(own, style.c, "the shadow"),
        function(t) return opacity(t) / 100 end, function(t) return -90 - angle(t) end,
        number("d", 5), number("s", 5), function() return 0 end), is_moving) or moves
    else
      own.note(("the layer style %s is left out"):format(fields.key(style.ty)))
    end
  end
  return moves
end

--- Changes an object by the effects of its layer, the first one first.
---@return (fun(t: number, object: any): any)? change nil: there are none
---@return boolean moves
function effects.compile(scope, item)
  local list = {}
  local moves = add_effects(scope, item, list)
  moves = add_styles(scope, item, list) or moves
  if #list == 0 then return nil, false end
  return function(t, object)
    for _, change in ipairs(list) do object = change(t, object) end
    return object
  end, moves
end

return fields.seal("lottie_effects", effects)
