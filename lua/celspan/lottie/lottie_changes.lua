--- What changes the outlines of a shape layer: trim paths, round corners, pucker and bloat, zig
--- zag, twist, offset paths and merge paths, as functions from geometries (lottie_geometry.lua) to
--- geometries.
--
-- What has outlines is changed outline by outline; what is drawn instead, by celspan's path
-- operator of the same kind, on each of its parts.
local celspan = require "celspan"
local contours = require "celspan.lottie_contour"
local native = require "celspan.native"
local geometry = require "celspan.lottie_geometry"
local property = require "celspan.lottie_property"

local changes = {}

local MOST_RIDGES = 1000
local THIN = 2 ^ -20 -- units: the width of a line that has none

local kinds = {}

--- An operator of celspan on the object of a geometry.
local function operate(one, moves, operator)
  return { moves = one.moves or moves, size = one.size, draw = function(t, style)
    local object = geometry.draw(one, t, style)
    return object and operator(object, t)
  end }
end

--- Each geometry changed: `change` takes its outlines, `operator` its object.
local function each(list, moves, change, operator)
  return geometry.each(list, function(one)
    if one.draw then return operate(one, moves, operator) end
    return geometry.make(one.moves or moves, one.size, function(t) return change(one.get(t), t) end)
  end)
end

--- An operator of celspan as a change of outlines.
local function through(operator)
  return function(lists, t)
    if not lists[1] then return {} end
    return native.anatomy(operator(celspan.stroke { contours = lists, width = THIN }, t)).contours
  end
end

-- ---------------------------------------------------------------- trim

--- Notes a trim of all outlines one after another whose styles lie in groups of their own.
local function note_groups(scope)
  local fewest
  return function(list)
    fewest = math.min(fewest or #list, #list)
    if #list > fewest then
      scope.note "it trims the paths of each group as one way, not those of all groups together"
    end
  end
end

--- m: 1 cuts each geometry alone, 2 cuts all of them as one way.
function kinds.tm(scope, item)
  local read, moves = property.reader(scope)
  local from = read(property.number, item.s, "the start", 0)
  local to = read(property.number, item.e, "the end", 100)
  local offset = read(property.number, item.o, "the offset", 0)
  local note = item.m == 2 and note_groups(scope)
  local function trim(object, t)
    return celspan.trim(object, from(t) / 100, to(t) / 100,
      { offset = offset(t) / 360, together = true })
  end
  return function(list)
    if note then
      note(list)
      list = geometry.list(geometry.join(list))
    end
    return each(list, moves(), through(trim), trim)
  end
end

-- ---------------------------------------------------------------- corners and sides

function kinds.rd(scope, item)
  local radius, moves = property.number(scope, item.r, "the radius", 0)
  local function round(lists, t)
    local rounded = {}
    for i, outline in ipairs(lists) do rounded[i] = contours.round(outline, radius(t)) end
    return rounded
  end
  return function(list)
    return each(list, moves, round,
      function(object, t) return celspan.round_corners(object, math.max(0, radius(t))) end)
  end
end

function kinds.pb(scope, item)
  local share, moves = property.number(scope, item.a, "the amount", 0)
  local function pucker(object, t)
    return celspan.pucker(object, math.max(-1, math.min(1, share(t) / 100)))
  end
  return function(list) return each(list, moves, through(pucker), pucker) end
end

function kinds.zz(scope, item)
  local read, moves = property.reader(scope)
  local size = read(property.number, item.s, "the size", 0)
  local ridges, kind = read(property.number, item.r, "the ridges", 0),
    read(property.number, item.pt, "the points", 1)
  local function zigzag(object, t)
    local count = math.max(0, math.min(MOST_RIDGES, math.floor(ridges(t))))
    return celspan.zigzag(object, { size = size(t), smooth = kind(t) == 2, ridges = count })
  end
  return function(list) return each(list, moves(), through(zigzag), zigzag) end
end

function kinds.tw(scope, item)
  local read, moves = property.reader(scope)
  local degrees, centre = read(property.number, item.a, "the angle", 0),
    read(property.list, item.c, "the centre", { 0, 0 })
  local function twist(object, t)
    local c = centre(t)
    return celspan.twist(object, degrees(t), { centre = { c[1], c[2] } })
  end
  return function(list) return each(list, moves(), through(twist), twist) end
end

-- ---------------------------------------------------------------- areas

local joins = { "miter", "round", "bevel" }

function kinds.op(scope, item)
  local read, moves = property.reader(scope)
  local distance = read(property.number, item.a, "the amount", 0)
  local limit = read(property.number, item.ml, "the miter limit", 4)
  local function grow(object, t)
    return celspan.offset(object, distance(t), { join = joins[item.lj] or "miter",
                                                 limit = math.max(1, limit(t)) })
  end
  return function(list)
    return geometry.each(list, function(one) return operate(one, moves(), grow) end)
  end
end

local combiners = { [2] = celspan.union, [3] = celspan.difference, [4] = celspan.intersection,
                    [5] = celspan.xor }

--- The area of a geometry, grown by a distance, or shrunk by one below 0.
local function grown(one, t, distance, style)
  if one.grow then return one.grow(t, distance, style) end
  return celspan.offset(geometry.draw(one, t, { texture = style.texture }), distance,
    { join = style.line.join, limit = style.line.miter })
end

--- Combined areas, grown like `grown`: areas that are taken off are grown the other way. An
--- exclusive or has the borders of all of its areas.
local function grow_combined(list, combine, t, distance, style)
  if combine == celspan.xor then
    local line = { width = 2 * math.abs(distance), join = style.line.join,
                   miter = style.line.miter }
    local border = celspan.union(geometry.draw_all(list, t,
      { texture = style.texture, line = line }))
    local area = combine(geometry.draw_all(list, t, { texture = style.texture }))
    return distance > 0 and area | border or area - border
  end
  local objects = {}
  for i, one in ipairs(list) do
    local is_taken_off = combine == celspan.difference and i > 1
    objects[i] = grown(one, t, is_taken_off and -distance or distance, style)
  end
  return combine(objects)
end

--- The line around areas that are combined: the areas, grown by half its width, without the areas,
--- shrunk by half its width.
local function border_of(list, combine, t, style)
  if combine == celspan.xor or style.line.dash then
    return celspan.union(geometry.draw_all(list, t, style))
  end
  local half = style.line.width / 2
  return grow_combined(list, combine, t, half, style)
    - grow_combined(list, combine, t, -half, style)
end

--- mm: 1 is one outline of all, 2 to 5 are booleans of the areas.
function kinds.mm(_, item)
  local combine = combiners[item.mm]
  return function(list)
    local merged = geometry.join(list)
    if combine and #list > 1 then
      merged = { moves = merged.moves, size = merged.size,
        grow = function(t, distance, style)
          return grow_combined(list, combine, t, distance, style)
        end,
        draw = function(t, style)
          if style.line then return border_of(list, combine, t, style) end
          return combine(geometry.draw_all(list, t, style))
        end }
    end
    return geometry.list(merged)
  end
end

--- The change that an item makes to the geometries above it; nil for other items.
---@return (fun(list: table[]): table[])?
function changes.read(scope, item)
  return kinds[item.ty] and kinds[item.ty](scope, item)
end

return require "celspan.fields".seal("lottie_changes", changes)
