--- The outlines of a shape layer, before they are painted: forms, and what changes them.
--
-- A geometry is { get = function(t) -> list of outlines, moves = boolean }, and where it is more
-- than these outlines
--
--   combine   (t, texture, rule) -> the object of a fill of combined areas
--   operate   (t, object) -> the object, changed by one of celspan's path operators
--   parts     geometries that are drawn one by one, as one of them has one of these
local affine = require "celspan.affine"
local celspan = require "celspan"
local contours = require "celspan.lottie_contour"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local trim = require "celspan.lottie_trim"

local geometry = {}

local function make(moves, get) return { get = paint.memo(moves, get), moves = moves } end

--- A reader of properties that also says whether any of them moves.
local function reader(scope)
  local state = { moves = false }
  return function(how, ...)
    local get, moves = how(scope, ...)
    state.moves = state.moves or moves
    return get
  end, state
end

local function directed(list, item)
  return { item.d == 3 and contours.reverse(list) or list }
end

-- ---------------------------------------------------------------- forms

local forms = {}

function forms.sh(scope, item)
  local outline, moves = property.outline(scope, item.ks, "the path", item.closed == true)
  return make(moves, function(t)
    local list = outline(t)
    return #list > 0 and directed(list, item) or {}
  end)
end

function forms.rc(scope, item)
  local read, state = reader(scope)
  local position = read(property.point, item.p, "the position")
  local size = read(property.list, item.s, "the size", { 0, 0 })
  local radius = read(property.number, item.r, "the roundness", 0)
  return make(state.moves, function(t)
    local p, s = position(t), size(t)
    return directed(contours.rectangle(p[1], p[2], s[1], s[2], radius(t)), item)
  end)
end

function forms.el(scope, item)
  local read, state = reader(scope)
  local position = read(property.point, item.p, "the position")
  local size = read(property.list, item.s, "the size", { 0, 0 })
  return make(state.moves, function(t)
    local p, s = position(t), size(t)
    return directed(contours.ellipse(p[1], p[2], s[1] / 2, s[2] / 2), item)
  end)
end

function forms.sr(scope, item)
  local read, state = reader(scope)
  local position = read(property.point, item.p, "the position")
  local points = read(property.number, item.pt, "the points", 5)
  local turn = read(property.number, item.r, "the rotation", 0)
  local outer = read(property.number, item["or"], "the outer radius", 0)
  local outer_round = read(property.number, item.os, "the outer roundness", 0)
  local inner = read(property.number, item.ir, "the inner radius", 0)
  local inner_round = read(property.number, item.is, "the inner roundness", 0)
  return make(state.moves, function(t)
    local p = position(t)
    return directed(contours.star(p[1], p[2], points(t), turn(t),
      { outer(t), outer_round(t) / 100 },
      item.sy ~= 2 and { inner(t), inner_round(t) / 100 } or nil), item)
  end)
end

-- ---------------------------------------------------------------- changes

--- All outlines of a list of geometries.
local function all(list, t)
  local lists = {}
  for _, one in ipairs(list) do
    for _, outline in ipairs(one.get(t)) do lists[#lists + 1] = outline end
  end
  return lists
end

local function any_moves(list)
  for _, one in ipairs(list) do
    if one.moves then return true end
  end
  return false
end

--- Several geometries as one; combined ones stay as they are.
function geometry.join(list)
  if #list == 1 then return list[1] end
  for _, one in ipairs(list) do
    if one.combine or one.operate or one.parts then
      return { get = make(any_moves(list), function(t) return all(list, t) end).get,
               moves = any_moves(list), parts = list }
    end
  end
  return make(any_moves(list), function(t) return all(list, t) end)
end

--- Each geometry changed by a function of its outlines and the frame.
local function each(list, moves, change)
  local changed = {}
  for i, one in ipairs(list) do
    changed[i] = make(one.moves or moves, function(t) return change(one.get(t), t) end)
  end
  return changed
end

local function each_outline(list, moves, change)
  return each(list, moves, function(lists, t)
    local changed = {}
    for i, outline in ipairs(lists) do changed[i] = change(outline, t) end
    return changed
  end)
end

local changes = {}

--- m: 1 cuts each geometry alone, 2 cuts all of them as one way.
function changes.tm(scope, item)
  local read, state = reader(scope)
  local from = read(property.number, item.s, "the start", 0)
  local to = read(property.number, item.e, "the end", 100)
  local offset = read(property.number, item.o, "the offset", 0)
  local function cut(lists, t)
    return trim.cut(lists, from(t) / 100, to(t) / 100, offset(t) / 360)
  end
  return function(list)
    return each(item.m == 2 and #list > 1 and { geometry.join(list) } or list, state.moves, cut)
  end
end

function changes.rd(scope, item)
  local radius, moves = property.number(scope, item.r, "the radius", 0)
  return function(list)
    return each_outline(list, moves, function(outline, t) return contours.round(outline,
      radius(t)) end)
  end
end

function changes.pb(scope, item)
  local share, moves = property.number(scope, item.a, "the amount", 0)
  return function(list)
    return each_outline(list, moves,
      function(outline, t) return contours.pucker(outline, share(t) / 100) end)
  end
end

--- A path operator of celspan on the objects of each geometry, after those it has already.
local function operator(list, moves, operate)
  local changed = {}
  for i, one in ipairs(list) do
    local before = one.operate
    changed[i] = { get = one.get, moves = one.moves or moves, combine = one.combine,
                   parts = one.parts, operate = function(t, object)
      return operate(before and before(t, object) or object, t)
    end }
  end
  return changed
end

function changes.zz(scope, item)
  local read, state = reader(scope)
  local size = read(property.number, item.s, "the size", 0)
  local ridges, kind = read(property.number, item.r, "the ridges", 0),
    read(property.number, item.pt, "the points", 1)
  return function(list)
    return operator(list, state.moves, function(object, t)
      return celspan.zigzag(object, { size = size(t), smooth = kind(t) == 2,
                                      ridges = math.max(0, math.min(1000, math.floor(ridges(t)))) })
    end)
  end
end

function changes.tw(scope, item)
  local read, state = reader(scope)
  local degrees, centre = read(property.number, item.a, "the angle", 0),
    read(property.list, item.c, "the centre", { 0, 0 })
  return function(list)
    return operator(list, state.moves, function(object, t)
      local c = centre(t)
      return celspan.twist(object, degrees(t), { centre = { c[1], c[2] } })
    end)
  end
end

local joins = { "miter", "round", "bevel" }

function changes.op(scope, item)
  local read, state = reader(scope)
  local distance = read(property.number, item.a, "the amount", 0)
  local limit = read(property.number, item.ml, "the miter limit", 4)
  return function(list)
    return operator(list, state.moves, function(object, t)
      return celspan.offset(object, distance(t), { join = joins[item.lj] or "miter",
                                                   limit = math.max(1, limit(t)) })
    end)
  end
end

--- The path of one geometry with a texture, as booleans take it.
local function path_of(lists, texture, rule)
  return celspan.path { d = contours.data(lists), texture = texture, rule = rule }
end

local combiners = { [2] = celspan.union, [3] = celspan.difference, [4] = celspan.intersection,
                    [5] = celspan.xor }

--- mm: 1 is one outline of all, 2 to 5 are booleans of the areas.
function changes.mm(_, item)
  local combine = combiners[item.mm]
  return function(list)
    if not combine or #list < 2 then return { geometry.join(list) } end
    local merged = make(any_moves(list), function(t) return all(list, t) end)
    merged.combine = function(t, texture, rule)
      local objects = {}
      for _, one in ipairs(list) do objects[#objects + 1] = geometry.fill(one, t, texture, rule) end
      return combine(objects)
    end
    return { merged }
  end
end

-- ---------------------------------------------------------------- use

--- The form of an item; nil for other items.
function geometry.form(scope, item)
  return forms[item.ty] and forms[item.ty](scope, item)
end

--- The change that an item makes to the geometries above it; nil for other items.
---@return (fun(list: table[]): table[])?
function geometry.change(scope, item)
  return changes[item.ty] and changes[item.ty](scope, item)
end

--- Geometries moved by a map. Combined ones are moved part by part.
function geometry.move(list, map, moves)
  local moved = each_outline(list, moves, function(outline, t)
    return contours.transform(outline, map(t))
  end)
  for i, one in ipairs(list) do
    local combine = one.combine
    moved[i].operate = one.operate
    if combine then
      moved[i].combine = function(t, texture, rule)
        return combine(t, texture, rule):transform(affine.matrix(map(t)))
      end
    end
  end
  return moved
end

--- The object of a geometry and its parts. draw: of one without parts.
local function drawn(one, t, draw)
  local object
  if one.parts then
    local objects = {}
    for _, part in ipairs(one.parts) do objects[#objects + 1] = drawn(part, t, draw) end
    object = celspan.union(objects)
  else
    object = draw(one)
  end
  return object and one.operate and one.operate(t, object) or object
end

--- The filled object of a geometry.
function geometry.fill(one, t, texture, rule)
  return drawn(one, t, function(part)
    if part.combine then return part.combine(t, texture, rule) end
    return path_of(part.get(t), texture, rule)
  end)
end

--- The lines of a geometry; nil: it has none. fields: those of celspan.stroke, without `d`.
function geometry.stroke(one, t, fields)
  return drawn(one, t, function(part)
    fields.d = contours.data(part.get(t))
    return fields.d ~= "" and celspan.stroke(fields) or nil
  end)
end

return require "celspan.fields".seal("lottie_geometry", geometry)
