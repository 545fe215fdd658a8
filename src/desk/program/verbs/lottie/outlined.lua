--- Shapes of Lottie from a frame's structure (native.scenery): outlines with their fills.
local affine = require "celspan.affine"

local text, keys, paint_of = ...

local still = text.still

local NEAR = 1 / 100 -- units of the film: how far a place may be off

local shapes = {}

-- ---------------------------------------------------------------- outlines

--- Gives the cubics that are straight lines in even steps handles without length, as lines have.
local function straighten(points)
  for at = 1, #points - 6, 6 do
    local off, length = 0, 0
    for k = at, at + 1 do
      local first, second, third, last = points[k], points[k + 2], points[k + 4], points[k + 6]
      off = math.max(off, math.abs(3 * second - 2 * first - last),
        math.abs(3 * third - first - 2 * last))
      length = math.max(length, math.abs(last - first))
    end
    if off <= 1e-6 * length then
      table.move(points, at, at + 1, at + 2)
      table.move(points, at + 6, at + 7, at + 4)
    end
  end
end

--- A contour, a list of x, y and six numbers for each cubic, as a shape, which is closed unless
--- is_open.
local function contour_of(contour, map, digits, is_open)
  local points, last = affine.move(map, contour), #contour
  straighten(points)
  local is_back = not is_open and last > 2 and contour[1] == contour[last - 1]
    and contour[2] == contour[last]
  local function way(at, x, y)
    return text.list(at and { points[at] - x, points[at + 1] - y } or { 0, 0 }, digits)
  end
  local vertices, ins, outs = {}, {}, {}
  for k = 1, (last - 2) // 6 + (is_back and 0 or 1) do
    local at = 6 * k - 5
    local x, y = points[at], points[at + 1]
    vertices[k] = text.list({ x, y }, digits)
    outs[k] = way(points[at + 2] and at + 2, x, y)
    ins[k] = way(k > 1 and at - 2 or is_back and last - 3, x, y)
  end
  return { ty = "sh", ks = still { c = not is_open, v = vertices, i = ins, o = outs } }
end

local IDENTITY = affine.translation(0, 0)

--- The transform of a group.
local function placed_at(map, digits)
  local transform = keys.placed(map, digits)
  transform.ty = "tr"
  return transform
end

local CENTRE = placed_at(IDENTITY)

--- A fill in the units around a shape; a map that is not round bends none that is here.
local function moved(fill, map)
  if fill.kind == "flat" then return fill end
  local x, y, u, v = table.unpack(fill.points)
  local ax, ay = affine.apply(map, x, y)
  local bx, by = affine.apply(map, u, v)
  if fill.kind == "linear" then
    local cx, cy = affine.apply(map, x - (v - y), y + (u - x))
    local sx, sy = cx - ax, cy - ay
    local along = ((bx - ax) * sx + (by - ay) * sy) / math.max(sx * sx + sy * sy, 1e-300)
    bx, by = bx - along * sx, by - along * sy
  end
  return { kind = fill.kind, coded = fill.coded, stops = fill.stops, points = { ax, ay, bx, by },
           radius = (fill.radius or 0) * math.sqrt(map[1] * map[1] + map[4] * map[4]) }
end

local function is_round(map)
  local a, b, _, d, e = table.unpack(map)
  local size = a * a + d * d
  return math.abs(b * b + e * e - size) <= 1e-6 * size and math.abs(a * b + d * e) <= 1e-6 * size
end

--- Why the data, moved by a map, cannot be shapes; nil: they can.
function shapes.refusal(data, map)
  if data.why then return data.why end
  if data.kind == "image" then
    return not keys.can_lean { map } and "a picture with skewed axes" or nil
  elseif data.kind == "outline" then
    local is_bent = data.fill.kind == "radial" and not keys.is_upright(map)
    return is_bent and "a radial gradient with skewed axes" or nil
  end
  for _, placed in ipairs(data) do
    local why = placed.why or shapes.refusal(placed.data, affine.compose(map, placed.matrix))
    if why then return why end
  end
end

--- Calls visit(data, map, fade) for all outlines and images, the rearmost first.
local function each(data, map, fade, visit)
  if data.kind ~= "group" then return visit(data, map, fade) end
  for _, placed in ipairs(data) do
    each(placed.data, affine.compose(map, placed.matrix), fade * placed.fade, visit)
  end
end

--- How many outlines and images data have.
function shapes.count(data)
  if not data.count then
    local count = 0
    each(data, IDENTITY, 1, function() count = count + 1 end)
    data.count = count
  end
  return data.count
end

--- Whether the data need more than a layer of shapes: a group inside that is faded as a whole, or
--- an image.
function shapes.need_layers(data)
  if data.kind ~= "group" then return data.kind == "image" end
  for _, placed in ipairs(data) do
    local inner = placed.data
    if placed.fade < 1 and shapes.count(inner) > 1 or shapes.need_layers(inner) then
      return true
    end
  end
  return false
end

--- Whether there is an image among the data.
function shapes.has_image(data)
  local has = false
  each(data, IDENTITY, 1, function(one) has = has or one.kind == "image" end)
  return has
end

--- Whether anything in the data lets through what lies behind it. shines(image): whether it does.
function shapes.is_clear(data, shines)
  if data.clear == nil then
    data.clear = false
    each(data, IDENTITY, 1, function(outline, _, fade)
      if outline.kind == "image" then data.clear = data.clear or fade < 1 or shines(outline) end
      for _, stop in ipairs(outline.fill and outline.fill.stops or {}) do
        if stop[5] * fade < 1 then data.clear = true end
      end
    end)
  end
  return data.clear
end

--- The box { left, top, right, bottom } of the points of the data; nil: they are empty.
function shapes.box(data)
  if data.box == nil then
    local left, top, right, bottom = math.huge, math.huge, -math.huge, -math.huge
    each(data, IDENTITY, 1, function(outline, map)
      for _, contour in ipairs(outline.contours) do
        for i = 1, #contour, 2 do
          local x, y = affine.apply(map, contour[i], contour[i + 1])
          left, top = math.min(left, x), math.min(top, y)
          right, bottom = math.max(right, x), math.max(bottom, y)
        end
      end
    end)
    data.box = left <= right and { left, top, right, bottom } or false
  end
  return data.box or nil
end

--- Whether nothing of the data can be seen, because they have no area.
function shapes.is_flat(data)
  local box = shapes.box(data)
  return not box or box[1] == box[3] or box[2] == box[4]
end

--- The digits of places that are shown at a scale.
local function digits_at(scale) return text.digits(NEAR / math.max(scale, 1e-12)) end

--- How an outline is written that is moved by a map: the map of its points, the transform of the
--- group around them, its fill in their units, and the digits of places. A gradient that is not
--- round has a transform of its own. scale: of the layer.
local function layout_of(outline, map, scale)
  local fill, digits = outline.fill, digits_at(scale)
  if not fill.map and (fill.kind ~= "radial" or is_round(map)) then
    return { map = map, place = CENTRE, fill = moved(fill, map), digits = digits }
  end
  local units = fill.map or map
  local size = keys.scale { units }
  local zoom, place = keys.zoom(size), affine.compose(units, keys.zoom(1 / size))
  local inner = fill.map and affine.compose(affine.inverse(units), map) or IDENTITY
  return { map = affine.compose(zoom, inner), place = placed_at(place, digits),
           fill = moved(fill, zoom), digits = digits }
end

--- An outline as a group; nil: it is empty.
local function group_of(outline, map, fade, front, scale)
  local group, layout = {}, layout_of(outline, map, scale)
  for _, contour in ipairs(outline.contours) do
    if #contour > 2 then group[#group + 1] = contour_of(contour, layout.map, layout.digits) end
  end
  if not group[1] then return nil end
  group[#group + 1] = paint_of({ rule = outline.rule, fill = layout.fill }, front, fade,
    layout.digits)
  group[#group + 1] = layout.place
  return { ty = "gr", it = group }
end

--- A list from its last item on: players draw the first one on top.
function shapes.reversed(list)
  local result = {}
  for i = #list, 1, -1 do result[#result + 1] = list[i] end
  return result
end

--- The items of a layer that shows the data, moved by a map. scale: of the layer.
function shapes.items(data, map, front, scale)
  local list = {}
  each(data, map, 1, function(outline, whole, fade)
    list[#list + 1] = group_of(outline, whole, fade, front, scale)
  end)
  return shapes.reversed(list)
end

-- ---------------------------------------------------------------- areas

local COARSE = 1 / 10 -- the scale whose digits areas have, as there are many of them
local UNDER = 3.2 -- units: the width of strokes below areas, wider than what players leave clear

local strokes = { fl = "st", gf = "gs" }

--- The ends of a contour along an axis, 1 or 2.
local function extent(contour, axis)
  local low, high = math.huge, -math.huge
  for i = axis, #contour, 2 do low, high = math.min(low, contour[i]), math.max(high, contour[i]) end
  return low, high
end

--- Cuts a list of contours where no contour is along an axis.
local function cut(contours, axis)
  local ends, parts, reach = {}, {}, -math.huge
  for i, contour in ipairs(contours) do ends[i] = { i, extent(contour, axis) } end
  table.sort(ends, function(a, b) return a[2] < b[2] or a[2] == b[2] and a[1] < b[1] end)
  for _, one in ipairs(ends) do
    if one[2] > reach then parts[#parts + 1] = {} end
    table.insert(parts[#parts], contours[one[1]])
    reach = math.max(reach, one[3])
  end
  return parts
end

--- Adds parts of contours whose boxes are apart, so that each part can be filled alone. is_whole:
--- the other axis did not cut them.
local function separate(list, contours, axis, is_whole)
  local parts = cut(contours, axis)
  for _, part in ipairs(parts) do
    if part[2] and not (is_whole and #parts == 1) then
      separate(list, part, 3 - axis, #parts == 1)
    else
      list[#list + 1] = part
    end
  end
end

local function encoded(contours, layout, is_open)
  local texts = {}
  for i, contour in ipairs(contours) do
    texts[i] = text.encode(contour_of(contour, layout.map, layout.digits, is_open))
  end
  return texts
end

local function painted(paint, layout)
  return text.encode(paint) .. "," .. text.encode(layout.place)
end

--- An area as a text of its fill, and texts of the parts of its outline.
local function area_of(parcel)
  local layout, parts, pieces = layout_of(parcel, IDENTITY, COARSE), {}, {}
  separate(parts, parcel.contours, 1, false)
  for i, part in ipairs(parts) do pieces[i] = table.concat(encoded(part, layout), ",") end
  local paint = paint_of({ rule = parcel.rule, fill = layout.fill }, nil, 1, layout.digits)
  return { pieces = pieces, paint = painted(paint, layout) }
end

--- A line below areas in the same form, thinner along an axis if the gradient is not round.
local function line_of(line)
  local layout = layout_of(line, IDENTITY, COARSE)
  local stroke = paint_of({ fill = layout.fill }, nil, 1, layout.digits)
  stroke.ty, stroke.r = strokes[stroke.ty], nil
  stroke.w, stroke.lc, stroke.lj = still(UNDER), 2, 2
  return { pieces = encoded(line.contours, layout, true), paint = painted(stroke, layout) }
end

--- The areas of parcels (native.parcels), and the lines below them.
function shapes.parcels(parcels)
  local areas, lines = {}, {}
  for i, parcel in ipairs(parcels) do areas[i] = area_of(parcel) end
  for i, line in ipairs(parcels.lines) do lines[i] = line_of(line) end
  return areas, lines
end

return shapes
