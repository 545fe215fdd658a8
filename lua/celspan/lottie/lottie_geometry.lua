--- The outlines of a shape layer, before they are painted: moved, copied, joined, drawn.
--
-- A geometry is { get = function(t) -> list of outlines, moves = boolean, size = vertices }. Areas
-- that are combined or grown have no outlines of their own, and instead of `get`
--
--   draw   (t, style) -> their object; nil: nothing
--
-- A style is { texture =, rule = } of a fill, or { texture =, line = fields of celspan.stroke }.
-- A list of geometries has its `size`, too: the sum of theirs.
local affine = require "celspan.affine"
local celspan = require "celspan"
local forms = require "celspan.lottie_forms"
local paint = require "celspan.lottie_paint"

local geometry = {}

--- Outlines of a function of the frame.
function geometry.make(moves, size, get)
  return { get = paint.memo(moves, get), moves = moves, size = size }
end

--- A list of one geometry, or of none.
function geometry.list(one) return { one, size = one and one.size or 0 } end

function geometry.add(list, one)
  list[#list + 1], list.size = one, list.size + one.size
end

--- The form of an item; nil for other items.
function geometry.form(scope, item)
  local get, moves = forms.read(scope, item)
  if not get then return nil end
  local size = 1 -- at least, so that many empty ones are not free
  for _, outline in ipairs(get(scope.root.first)) do size = size + #outline // 6 end
  return geometry.make(moves, size, get)
end

-- ---------------------------------------------------------------- lists

--- A list of what a function makes of each geometry.
function geometry.each(list, change)
  local changed = geometry.list()
  for _, one in ipairs(list) do geometry.add(changed, change(one)) end
  return changed
end

function geometry.any_moves(list)
  for _, one in ipairs(list) do
    if one.moves then return true end
  end
  return false
end

--- All objects of a list.
function geometry.draw_all(list, t, style)
  local objects = {}
  for _, one in ipairs(list) do objects[#objects + 1] = geometry.draw(one, t, style) end
  return objects
end

local function any_drawn(list)
  for _, one in ipairs(list) do
    if one.draw then return true end
  end
  return false
end

--- Several geometries as one.
function geometry.join(list)
  if #list == 1 then return list[1] end
  local moves = geometry.any_moves(list)
  if any_drawn(list) then
    return { moves = moves, size = list.size, draw = function(t, style)
      return celspan.union(geometry.draw_all(list, t, style))
    end }
  end
  return geometry.make(moves, list.size, function(t)
    local lists = {}
    for _, one in ipairs(list) do
      for _, outline in ipairs(one.get(t)) do lists[#lists + 1] = outline end
    end
    return lists
  end)
end

-- ---------------------------------------------------------------- places

--- A style that a map of this scale gives the widths that are wanted.
local function unscaled(style, scale)
  local line = {}
  for name, value in pairs(style.line) do line[name] = value end
  line.width = line.width / scale
  if line.dash then
    line.dash, line.dash_offset = {}, line.dash_offset / scale
    for i, length in ipairs(style.line.dash) do line.dash[i] = length / scale end
  end
  return { texture = style.texture, line = line }
end

--- The object of a drawn geometry under a map. The style is that of the units outside. Where the
--- map is not even, the width of lines is right in the mean.
local function draw_moved(one, t, style, map)
  local scale = math.sqrt(math.abs(map[1] * map[5] - map[2] * map[4]))
  if scale < 1e-6 then return nil end
  local object = one.draw(t, style.line and unscaled(style, scale) or style)
  return object and object:transform(affine.matrix(map)):paint(style.texture)
end

--- Copies of geometries, under each map of a list. maps: a function of the frame. most: how many
--- maps there may be.
function geometry.copy(list, maps, moves, most)
  return geometry.each(list, function(one)
    local any = one.moves or moves
    if one.draw then
      return { moves = any, size = one.size * most, draw = function(t, style)
        local objects = {}
        for _, map in ipairs(maps(t)) do
          objects[#objects + 1] = draw_moved(one, t, style, map)
        end
        return celspan.union(objects)
      end }
    end
    return geometry.make(any, one.size * most, function(t)
      local lists = {}
      for _, map in ipairs(maps(t)) do
        for _, outline in ipairs(one.get(t)) do
          lists[#lists + 1] = affine.move(map, outline)
        end
      end
      return lists
    end)
  end)
end

--- Geometries moved by a map.
function geometry.move(list, map, moves)
  return geometry.copy(list, function(t) return { map(t) } end, moves, 1)
end

-- ---------------------------------------------------------------- use

--- The object of a geometry in a style; nil: a line of nothing.
function geometry.draw(one, t, style)
  if one.draw then return one.draw(t, style) end
  local outlines, line = one.get(t), style.line
  if not line then
    return celspan.path { contours = outlines, texture = style.texture, rule = style.rule }
  end
  if not outlines[1] then return nil end
  line.contours, line.texture = outlines, style.texture
  return celspan.stroke(line)
end

return require "celspan.fields".seal("lottie_geometry", geometry)
