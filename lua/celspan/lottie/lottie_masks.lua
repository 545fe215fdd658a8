--- Masks and mattes of a layer: where it is present.
local celspan = require "celspan"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local masks = {}

local FAR = 1e5 -- units: beyond every layer
local MOST_STEPS = 20 -- of masks of different modes: each nests the others one level deeper
local MOST_DIFFERENCES = 6 -- each doubles what is drawn

local function everywhere() return celspan.rect { -FAR, -FAR, 2 * FAR, 2 * FAR,
  texture = "#fff" } end

--- The area of a mask, grown or shrunk by a distance.
local function area(list, grow)
  local shape = celspan.path { contours = { list }, texture = "#fff" }
  if grow == 0 then return shape end
  local edge = celspan.stroke { contours = { list }, width = 2 * math.abs(grow), join = "round",
                                texture = "#fff" }
  return grow > 0 and shape | edge or shape - edge
end

--- One mask as a function of the frame: an object that says by its alpha how much is there; nil:
--- nothing.
local function compile_one(scope, item)
  local read, moves = property.reader(scope)
  local outline = read(property.outline, item.pt, "the mask's path", item.cl == true)
  local opacity = read(property.number, item.o, "the mask's opacity", 100)
  local grow = read(property.number, item.x, "the mask's expansion", 0)
  local feather = read(property.list, item.f, "the mask's feather", { 0, 0 })
  local inverts = values.flag(item.inv)
  local get = paint.memo(moves(), function(t)
    local list, soft, share = outline(t), feather(t), opacity(t) / 100
    local shape = #list > 0 and area(list, grow(t)) or nil
    local radius = math.max(0, (soft[1] + soft[2]) / 2)
    if shape and radius > 0 then shape = shape:blur(radius) end
    if inverts then
      shape = shape and celspan.matte(everywhere(), shape, { invert = true }) or everywhere()
    end
    return shape and (share < 1 and shape:fade(math.max(0, share)) or shape)
  end)
  return get, moves()
end

local function without(a, b) return celspan.matte(a, b, { invert = true }) end

--- The area before a mask, or several of one mode, and theirs as one, by the mode.
local combine = {
  a = function(before, one) return celspan.group { before, one } end,
  s = without,
  i = function(before, one) return celspan.matte(before, one) end,
  f = function(before, one) return celspan.group { without(before, one), without(one, before) } end,
}
local same = { d = "i", l = "a" } -- of areas, the lesser and the greater

--- The first mask: what is subtracted is subtracted from everything.
local function begin(mode, shape)
  if mode == "s" then return shape and without(everywhere(), shape) or everywhere() end
  return shape
end

local function join(mode, before, shape)
  if not shape then
    if mode == "i" then return nil end
    return before
  end
  if not before then
    if mode == "s" or mode == "i" then return nil end
    return shape
  end
  return combine[mode](before, shape)
end

--- The masks of a layer in steps: those that are added, or subtracted, one after the other are one.
local function steps_of(scope, given)
  local steps, moves, differences = {}, false, 0
  for _, one in ipairs(values.items(given)) do
    local own = scope.within((".masksProperties[%d]"):format(one[1] - 1), one[2].nm)
    local mode = same[one[2].mode] or combine[one[2].mode] and one[2].mode or "a"
    local last = steps[#steps]
    if one[2].mode ~= "n" and not values.flag(one[2].hd) then
      local is_new = not last or last.mode ~= mode or mode == "i" or mode == "f"
      if mode == "f" then differences = differences + 1 end
      if is_new and #steps == MOST_STEPS or differences > MOST_DIFFERENCES then
        own.note("its layer has too many masks of several modes; this one and those after it are "
          .. "left out")
        break
      end
      if is_new then
        last = { mode = mode }
        steps[#steps + 1] = last
      end
      local get, is_moving = compile_one(own, one[2])
      last[#last + 1], moves = get, moves or is_moving
    end
  end
  return steps, moves
end

--- The shape of a step at a frame; nil: nothing.
local function shape_of(step, t)
  local shapes = {}
  for _, get in ipairs(step) do shapes[#shapes + 1] = get(t) end
  return #shapes > 1 and celspan.group(shapes) or shapes[1]
end

--- Puts an object behind the masks of its layer.
---@return (fun(t: number, object: any): any)? mask nil: there are no masks
---@return boolean moves
function masks.compile(scope, given)
  local steps, moves = steps_of(scope, given)
  if #steps == 0 then return nil, false end
  local shape = paint.memo(moves, function(t)
    local made = begin(steps[1].mode, shape_of(steps[1], t))
    for i = 2, #steps do made = join(steps[i].mode, made, shape_of(steps[i], t)) end
    return made
  end)
  local cover = paint.keep(celspan.matte)
  return function(t, object)
    local by = shape(t)
    return by and cover(object, by)
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
