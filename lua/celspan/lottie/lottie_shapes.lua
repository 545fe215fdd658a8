--- The contents of a shape layer: functions of the frame that return an object.
--
--   it = { form, form, change, style, group, ..., transform }     the first is in front
--
-- A style paints the forms above it in its group, also those of groups above it. A change acts on
-- the forms above it, for all styles: those above it, too.
local celspan = require "celspan"
local changes = require "celspan.lottie_changes"
local geometry = require "celspan.lottie_geometry"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local transform = require "celspan.lottie_transform"
local values = require "celspan.lottie_values"

local shapes = {}

local MOST_COPIES = 10000 -- of a repeater
local MOST_DASHES = 64
local MOST_VERTICES = 2000000 -- that all styles of a file paint, each change of them counted again
local caps = { "butt", "round", "square" }
local joins = { "miter", "round", "bevel" }

-- ---------------------------------------------------------------- styles

local function fill(scope, item, one)
  local texture, moves = paint.texture(scope, item, "the fill's")
  local rule = item.r == 2 and "evenodd" or "nonzero"
  return paint.memo(moves or one.moves, function(t)
    local painted = texture(t)
    return painted and geometry.draw(one, t, { texture = painted, rule = rule })
  end), moves or one.moves
end

--- The dashes of a stroke as a function of the frame, and its offset.
local function dashes(scope, item)
  local read, moves = property.reader(scope)
  local lengths, offset = {}, nil
  for n, one in ipairs(values.items(item.d)) do
    local get = read(property.number, one[2].v, "a dash", 0)
    if one[2].n == "o" then
      offset = get
    elseif n <= MOST_DASHES then
      lengths[#lengths + 1] = get
    end
  end
  return function(t)
    local list, sum = {}, 0
    for i, get in ipairs(lengths) do
      list[i] = math.max(0, get(t))
      sum = sum + list[i]
    end
    if sum <= 1e-3 then return nil end
    return list, offset and offset(t) or 0
  end, moves()
end

local function stroke(scope, item, one)
  local texture, moves_texture = paint.texture(scope, item, "the stroke's")
  local width, moves_width = property.number(scope, item.w, "the stroke's width", 0)
  local dash, moves_dash = dashes(scope, item)
  local moves = moves_texture or moves_width or moves_dash or one.moves
  local miter = math.max(1, math.min(1000, values.number(item.ml, 4)))
  local cap, join = caps[item.lc] or "butt", joins[item.lj] or "miter"
  return paint.memo(moves, function(t)
    local painted, wide = texture(t), width(t)
    if not painted or wide <= 0 then return nil end
    local list, offset = dash(t)
    local line = { width = wide, cap = cap, join = join, miter = miter, dash = list,
                   dash_offset = list and offset or nil }
    return geometry.draw(one, t, { texture = painted, line = line })
  end), moves
end

local styles = { fl = fill, gf = fill, st = stroke, gs = stroke }

-- ---------------------------------------------------------------- drawing

--- A list of draws { get =, moves = }, the first in front, as one.
local function draw_all(draws)
  local moves = false
  for _, one in ipairs(draws) do moves = moves or one.moves end
  local join = paint.keep_list(celspan.union)
  return { moves = moves, get = paint.memo(moves, function(t)
    local objects = {}
    for i = #draws, 1, -1 do
      local object = draws[i].get(t)
      if object then objects[#objects + 1] = object end
    end
    if #objects < 2 then return objects[1] end
    return join(objects)
  end) }
end

--- A draw under a map and an opacity (per cent).
local function place(draw, map, opacity, moves)
  moves = moves or draw.moves
  local placed = paint.keep(function(object, at, share)
    object = transform.apply(object, at)
    return share < 100 and celspan.group { object, opacity = share / 100 } or object
  end)
  return { moves = moves, get = paint.memo(moves, function(t)
    local object, share = draw.get(t), math.min(100, opacity(t))
    return object and share > 0 and placed(object, map(t), share) or nil
  end) }
end

--- The maps and the opacities of the copies of a repeater, the last in front, as functions of the
--- frame. Transform number k is the power k of its own.
local function copies(scope, item)
  local tr = values.table(item.tr) or {}
  local read, moves = property.reader(scope)
  local count, offset = read(property.number, item.c, "the copies", 0),
    read(property.number, item.o, "the offset", 0)
  local position, anchor = read(property.point, tr.p, "the position"),
    read(property.list, tr.a, "the anchor", { 0, 0 })
  local scale, degrees = read(property.list, tr.s, "the scale", { 100, 100 }),
    read(property.number, tr.r, "the rotation", 0)
  local from, to = read(property.number, tr.so, "the start opacity", 100),
    read(property.number, tr.eo, "the end opacity", 100)
  local function power(base, k)
    local size = math.abs(base / 100) ^ k
    return 100 * (base < 0 and math.floor(k) % 2 == 1 and -size or size)
  end
  local function map_of(t, k)
    local p, s, a = position(t), scale(t), anchor(t)
    return transform.map({ a[1] + k * p[1], a[2] + k * p[2] }, a,
      { power(s[1], k), power(s[2], k) }, k * degrees(t), 0, 0)
  end
  local function number(t) return math.max(0, math.floor(math.min(MOST_COPIES, count(t)))) end
  local made = { moves = moves(), most = math.max(1, number(scope.root.first)) }
  made.maps = paint.memo(made.moves, function(t)
    local n, maps, shares = number(t), {}, {}
    for i = 1, n do
      local k = item.m == 2 and i - 1 or n - i
      local u = n > 1 and k / n or 0
      maps[i] = map_of(t, k + offset(t))
      shares[i] = math.max(0, math.min(100, from(t) + u * (to(t) - from(t)))) / 100
    end
    return { maps = maps, shares = shares }
  end)
  return made
end

--- The copies of a draw.
local function repeat_draw(draw, made)
  local moves = made.moves or draw.moves
  return { moves = moves, get = paint.memo(moves, function(t)
    local object, list, objects = draw.get(t), made.maps(t), {}
    for i, share in ipairs(object and list.shares or {}) do
      if share > 0 then
        local copy = transform.apply(object, list.maps[i])
        objects[#objects + 1] = share < 1 and celspan.group { copy, opacity = share } or copy
      end
    end
    return #objects > 0 and celspan.union(objects) or nil
  end) }
end

-- ---------------------------------------------------------------- groups

--- The items of a list with what they are, the last first; changes are also put on the stack.
local function sort_items(scope, list, pending)
  local sorted, tr = {}, nil
  local items = values.items(list)
  for n = #items, 1, -1 do
    local place_in, item = items[n][1], items[n][2]
    local own = scope.within(("[%d]"):format(place_in - 1), item.nm)
    local one = { item = item, scope = own }
    if item.ty == "tr" and not values.flag(item.hd) then
      tr = one
    elseif not values.flag(item.hd) then
      one.change = changes.read(own, item)
      if one.change then pending[#pending + 1] = one.change end
      sorted[#sorted + 1] = one
    end
  end
  return sorted, tr
end

local compile

--- Layers have modes; those of styles in them are not drawn.
local function note_mode(one)
  local mode = values.number(one.item.bm, 0)
  if mode ~= 0 then one.scope.note(("its mode %g is shown as normal"):format(mode)) end
end

--- Whether this many more vertices can be painted; notes it if not.
local function can_afford(scope, vertices)
  local root = scope.root
  root.vertices = (root.vertices or 0) + vertices
  if root.vertices <= MOST_VERTICES then return true end
  scope.note(("it is left out, because the file has more than %d vertices to paint"):format(
    MOST_VERTICES))
  return false
end

--- Adds a nested group: its picture, and its outlines for the styles that come after it.
local function add_group(one, pending, list, draws)
  local nested = compile(one.scope.within ".it", one.item.it, pending)
  draws[#draws + 1] = nested.draw
  for _, geo in ipairs(nested.geometries) do geometry.add(list, geo) end
end

local function add_style(one, pending, list, draws)
  local changed = list
  note_mode(one)
  if #list == 0 or not can_afford(one.scope, list.size * (1 + #pending)) then return end
  for i = #pending, 1, -1 do changed = pending[i](changed) end
  local get, moves = styles[one.item.ty](one.scope, one.item, geometry.join(changed))
  draws[#draws + 1] = { get = get, moves = moves }
end

--- The outlines with a repeater's copies of them, for the styles that come after it.
local function repeat_outlines(one, made, list)
  if not can_afford(one.scope, list.size * made.most) then return list end
  return geometry.copy(list, function(t) return made.maps(t).maps end, made.moves, made.most)
end

--- The transform of a group, on its picture and on its outlines.
local function finish(tr, list, draws)
  local draw = draw_all(draws)
  if not tr then return { draw = draw, geometries = list } end
  local map, moves_map = transform.read(tr.scope, tr.item)
  local opacity, moves_opacity = property.number(tr.scope, tr.item.o, "the opacity", 100)
  if not moves_map and transform.is_identity(map(0)) then
    return { draw = place(draw, map, opacity, moves_opacity), geometries = list }
  end
  return { draw = place(draw, map, opacity, moves_map or moves_opacity),
           geometries = geometry.move(list, map, moves_map) }
end

--- What the items make: a draw, and the outlines of the group. pending: the changes below the
--- place that is read, the outermost first.
function compile(scope, given, pending)
  local base = #pending
  local sorted, tr = sort_items(scope, given, pending)
  local list, draws = geometry.list(), {}
  for n = #sorted, 1, -1 do
    local one = sorted[n]
    local ty, item = one.item.ty, one.item
    local form = geometry.form(one.scope, item)
    if form then
      geometry.add(list, form)
    elseif one.change then
      pending[#pending] = nil
      if #list > 0 and can_afford(one.scope, list.size) then list = one.change(list) end
    elseif ty == "gr" then
      add_group(one, pending, list, draws)
    elseif styles[ty] then
      add_style(one, pending, list, draws)
    elseif ty == "rp" then
      local made = copies(one.scope, item)
      draws, list = { repeat_draw(draw_all(draws), made) }, repeat_outlines(one, made, list)
    elseif type(ty) == "string" and ty ~= "no" then
      one.scope.note(("'%s' is not known and is left out"):format(ty))
    end
  end
  assert(#pending == base)
  return finish(tr, list, draws)
end

--- The contents of a shape layer.
---@return fun(t: number): any object nil: nothing
---@return boolean moves
function shapes.compile(scope, list)
  local made = compile(scope.within ".shapes", list, {})
  return made.draw.get, made.draw.moves
end

return require "celspan.fields".seal("lottie_shapes", shapes)
