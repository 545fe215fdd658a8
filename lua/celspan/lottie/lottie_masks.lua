--- Masks and mattes of a layer: where it is present.
local celspan = require "celspan"
local contours = require "celspan.lottie_contour"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local masks = {}

local FAR = 1e5 -- units: beyond every layer

local function everywhere() return celspan.rect { -FAR, -FAR, 2 * FAR, 2 * FAR,
  texture = "#fff" } end

--- The area of a mask, grown or shrunk by a distance.
local function area(list, grow)
  local d = contours.data({ list })
  local shape = celspan.path { d = d, texture = "#fff" }
  if grow == 0 then return shape end
  local edge = celspan.stroke { d = d, width = 2 * math.abs(grow), join = "round", closed = true,
                                texture = "#fff" }
  return grow > 0 and shape | edge or shape - edge
end

--- One mask as a function of the frame: an object that says by its alpha how much is there; nil:
--- nothing.
local function compile_one(scope, item)
  local moves = false
  local function read(how, ...)
    local get, is_moving = how(scope, ...)
    moves = moves or is_moving
    return get
  end
  local outline = read(property.outline, item.pt, "the mask's path", item.cl == true)
  local opacity = read(property.number, item.o, "the mask's opacity", 100)
  local grow = read(property.number, item.x, "the mask's expansion", 0)
  local feather = read(property.list, item.f, "the mask's feather", { 0, 0 })
  local inverts = values.flag(item.inv)
  local get = paint.memo(moves, function(t)
    local list, soft, share = outline(t), feather(t), opacity(t) / 100
    local shape = #list > 0 and area(list, grow(t)) or nil
    local radius = math.max(0, (soft[1] + soft[2]) / 2)
    if shape and radius > 0 then shape = shape:blur(radius) end
    if inverts then
      shape = shape and celspan.matte(everywhere(), shape, { invert = true }) or everywhere()
    end
    return shape and (share < 1 and shape:fade(math.max(0, share)) or shape)
  end)
  return { get = get, moves = moves, mode = item.mode or "a" }
end

local function without(a, b) return celspan.matte(a, b, { invert = true }) end

--- Two masks as one, by the mode of the second.
local combine = {
  a = function(before, one) return celspan.group { before, one } end,
  s = without,
  i = function(before, one) return celspan.matte(before, one) end,
  f = function(before, one) return celspan.group { without(before, one), without(one, before) } end,
}
combine.d, combine.l = combine.i, combine.a -- of areas, the lesser and the greater

--- The first mask: what is subtracted is subtracted from everything.
local function begin(one, shape)
  if one.mode == "s" then return shape and without(everywhere(), shape) or everywhere() end
  return shape
end

local function join(one, before, shape)
  if not shape then
    if one.mode == "i" or one.mode == "d" then return nil end
    return before
  end
  if not before then
    if one.mode == "s" or one.mode == "i" or one.mode == "d" then return nil end
    return shape
  end
  return (combine[one.mode] or combine.a)(before, shape)
end

--- Puts an object behind the masks of its layer.
---@return (fun(t: number, object: any): any)? mask nil: there are no masks
---@return boolean moves
function masks.compile(scope, given)
  local list, moves = {}, false
  for _, one in ipairs(values.items(given)) do
    local own = scope.within((".masksProperties[%d]"):format(one[1] - 1), one[2].nm)
    if one[2].mode ~= "n" and not values.flag(one[2].hd) then
      local mask = compile_one(own, one[2])
      list[#list + 1], moves = mask, moves or mask.moves
    end
  end
  if #list == 0 then return nil, false end
  local shape = paint.memo(moves, function(t)
    local made = begin(list[1], list[1].get(t))
    for i = 2, #list do made = join(list[i], made, list[i].get(t)) end
    return made
  end)
  return function(t, object)
    local by = shape(t)
    return by and celspan.matte(object, by)
  end, moves
end

local from = { "alpha", "alpha", "luma", "luma" }

--- An object behind a matte. by: nil if nothing of the matte is there.
function masks.matte(object, by, mode)
  local inverts = mode == 2 or mode == 4
  if not by then return inverts and object or nil end
  return celspan.matte(object, by, { from = from[mode], invert = inverts })
end

return require "celspan.fields".seal("lottie_masks", masks)
