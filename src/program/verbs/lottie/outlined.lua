--- Shapes of Lottie from what a frame's structure holds (core.scenery): outlines with their fills.
local affine = require "celspan.affine"

local text, is_coded, keys = ...

local still = text.still

local NEAR = 1 / 100 -- units of the film: how far a place may be off
local OWN_DIGITS = 7 -- of places in units of a gradient
local SMOOTH = 1 / 512 -- how far a gradient's colour may be from that between two stops
local DEEPEST = 6 -- halvings of the way between two stops

local shapes = {}

-- ---------------------------------------------------------------- colours

--- sRGB's code of light, limited to what it can say. Codes stay below 1.
local function code(light)
  if light <= 0 then return 0 end
  if light >= 1 then return 1 end
  return light <= 0.0031308 and 12.92 * light or 1.055 * light ^ (1 / 2.4) - 0.055
end

--- What a film mixes of a pigment in this light: codes, or light.
local function mixed(pigment, front)
  return is_coded and code(pigment) * front or pigment * front
end

--- The code of what a film mixes.
local function shown(value)
  return is_coded and math.min(value, 1) or code(value)
end

--- The colour in a fill, as codes.
local function colour_of(stop, front)
  if not front then return { table.unpack(stop, 2, 4) } end
  local codes = {}
  for c = 1, 3 do codes[c] = shown(mixed(stop[c + 1], front[c])) end
  return codes
end

--- A stop as { at, r, g, b, alpha } of what the film mixes, premultiplied.
local function premultiply(stop, front)
  local made = { stop[1], 0, 0, 0, stop[5] }
  for c = 1, 3 do made[c + 1] = mixed(stop[c + 1], front[c]) * stop[5] end
  return made
end

local function between(a, b)
  local middle = {}
  for k = 1, 5 do middle[k] = (a[k] + b[k]) / 2 end
  return middle
end

--- A premultiplied stop as straight codes; where it is clear, those of `near`.
local function straight(stop, near)
  local alpha = stop[5]
  if alpha <= 0 then
    if not near or near[5] <= 0 then return { stop[1], 0, 0, 0, 0 } end
    local there = straight(near)
    return { stop[1], there[2], there[3], there[4], 0 }
  end
  local made = { stop[1], 0, 0, 0, alpha }
  for c = 2, 4 do made[c] = shown(stop[c] / alpha) end
  return made
end

--- Adds stops from `a` to `b`, as many as players need, which mix straight codes.
local function add_between(list, a, b, depth)
  local middle = between(a, b)
  local first, last, real = straight(a, b), straight(b, a), straight(middle)
  for c = 2, 4 do
    if depth > 0 and real[5] > 0 and math.abs((first[c] + last[c]) / 2 - real[c]) > SMOOTH then
      add_between(list, a, middle, depth - 1)
      return add_between(list, middle, b, depth - 1)
    end
  end
  list[#list + 1] = first
  list[#list + 1] = last
end

--- Whether a list ends with this stop.
local function ends_with(list, stop)
  local last = list[#list]
  for k = 1, 5 do
    if not last or math.abs(last[k] - stop[k]) > 1e-9 then return false end
  end
  return true
end

local function stops_of(fill, front)
  if fill.coded then return fill.stops end
  local made, list = {}, {}
  for i, stop in ipairs(fill.stops) do made[i] = premultiply(stop, front) end
  for i = 2, #made do add_between(list, made[i - 1], made[i], DEEPEST) end
  if not list[1] then list[1] = straight(made[1]) end
  local kept = {}
  for _, stop in ipairs(list) do
    if not ends_with(kept, stop) then kept[#kept + 1] = stop end
  end
  return kept
end

-- ---------------------------------------------------------------- fills

--- The stops of a gradient as Lottie lists them: all colours, and then all alphas if one is clear.
local function ramp(stops)
  local numbers, is_clear = {}, false
  for _, stop in ipairs(stops) do
    is_clear = is_clear or stop[5] < 1
    table.move(stop, 1, 4, #numbers + 1, numbers)
  end
  for _, stop in ipairs(is_clear and stops or {}) do
    numbers[#numbers + 1], numbers[#numbers + 2] = stop[1], stop[5]
  end
  return { p = #stops, k = still(numbers, 5) }
end

local function gradient(fill, front, rule, digits)
  local x, y, u, v = table.unpack(fill.points)
  local item = { ty = "gf", r = rule, s = still({ x, y }, digits), g = ramp(stops_of(fill, front)) }
  if fill.kind == "linear" then
    item.t, item.e = 1, still({ u, v }, digits)
    return item
  end
  local length = math.sqrt((u - x) ^ 2 + (v - y) ^ 2)
  item.t, item.e = 2, still({ x + fill.radius, y }, digits)
  if length > 1e-9 * fill.radius then
    item.h = still(100 * length / fill.radius)
    item.a = still(math.deg(math.atan(v - y, u - x)))
  end
  return item
end

--- digits: of the places of a gradient.
local function paint_of(data, front, fade, digits)
  local rule, fill = data.rule == "evenodd" and 2 or 1, data.fill
  if fill.kind ~= "flat" then
    local item = gradient(fill, front, rule, digits)
    item.o = still(100 * fade)
    return item
  end
  local stop = fill.stops[1]
  local colour = colour_of(stop, not fill.coded and front)
  return { ty = "fl", c = still({ colour[1], colour[2], colour[3], 1 }, 5), r = rule,
           o = still(100 * stop[5] * fade) }
end

-- ---------------------------------------------------------------- outlines

--- A contour's points, moved by a map.
local function points_of(contour, map)
  local points = {}
  local a, b, c, d, e, f = table.unpack(map)
  for i = 1, #contour, 2 do
    local x, y = contour[i], contour[i + 1]
    points[i], points[i + 1] = a * x + b * y + c, d * x + e * y + f
  end
  return points
end

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
  local points, last = points_of(contour, map), #contour
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
local function placed_at(map)
  local transform = keys.placed(map)
  transform.ty = "tr"
  return transform
end

local CENTRE = placed_at(IDENTITY)

--- A fill in the units around a shape; a map that is not round bends none that is here.
local function moved(fill, map)
  if fill.kind == "flat" then return fill end
  local x, y, u, v = table.unpack(fill.points)
  local a, b, c, d, e, f = table.unpack(map)
  local function at(px, py) return a * px + b * py + c, d * px + e * py + f end
  local ax, ay = at(x, y)
  local bx, by = at(u, v)
  if fill.kind == "linear" then
    local cx, cy = at(x - (v - y), y + (u - x))
    local sx, sy = cx - ax, cy - ay
    local along = ((bx - ax) * sx + (by - ay) * sy) / math.max(sx * sx + sy * sy, 1e-300)
    bx, by = bx - along * sx, by - along * sy
  end
  return { kind = fill.kind, coded = fill.coded, stops = fill.stops, points = { ax, ay, bx, by },
           radius = (fill.radius or 0) * math.sqrt(a * a + d * d) }
end

local function is_round(map)
  local a, b, _, d, e = table.unpack(map)
  local size = a * a + d * d
  return math.abs(b * b + e * e - size) <= 1e-6 * size and math.abs(a * b + d * e) <= 1e-6 * size
end

--- Why the data, moved by a map, cannot be shapes; nil: they can.
function shapes.refusal(data, map)
  if data.why then return data.why end
  if data.kind == "outline" then
    local is_bent = data.fill.kind == "radial" and not keys.is_upright(map)
    return is_bent and "a radial gradient with skewed axes" or nil
  end
  for _, placed in ipairs(data) do
    local why = placed.why or shapes.refusal(placed.data, affine.compose(map, placed.matrix))
    if why then return why end
  end
end

--- Calls visit(data, map, fade) for all outlines, the rearmost first.
local function each(data, map, fade, visit)
  if data.kind == "outline" then return visit(data, map, fade) end
  for _, placed in ipairs(data) do
    each(placed.data, affine.compose(map, placed.matrix), fade * placed.fade, visit)
  end
end

--- How many outlines data have.
function shapes.count(data)
  if not data.count then
    local count = 0
    each(data, IDENTITY, 1, function() count = count + 1 end)
    data.count = count
  end
  return data.count
end

--- Whether a group inside the data is faded as a whole.
function shapes.has_faded_group(data)
  if data.kind == "outline" then return false end
  for _, placed in ipairs(data) do
    local inner = placed.data
    if placed.fade < 1 and shapes.count(inner) > 1 or shapes.has_faded_group(inner) then
      return true
    end
  end
  return false
end

--- Whether anything in the data lets through what lies behind it.
function shapes.is_clear(data)
  if data.clear == nil then
    data.clear = false
    each(data, IDENTITY, 1, function(outline, _, fade)
      for _, stop in ipairs(outline.fill.stops) do
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
          local x = map[1] * contour[i] + map[2] * contour[i + 1] + map[3]
          local y = map[4] * contour[i] + map[5] * contour[i + 1] + map[6]
          left, top = math.min(left, x), math.min(top, y)
          right, bottom = math.max(right, x), math.max(bottom, y)
        end
      end
    end)
    data.box = left <= right and { left, top, right, bottom } or false
  end
  return data.box or nil
end

--- The digits of places that are shown at a scale.
local function digits_at(scale) return text.digits(NEAR / math.max(scale, 1e-12)) end

--- The map of an outline's points and the transform of the group around them: a gradient that is
--- not round has a transform of its own. scale: of the layer. Returns the digits of places, too.
local function layout_of(outline, map, scale)
  local own = outline.fill.map
  if own then
    return affine.compose(affine.inverse(own), map), placed_at(own), OWN_DIGITS
  elseif outline.fill.kind == "radial" and not is_round(map) then
    local size = keys.scale { map }
    return keys.zoom(size), placed_at(affine.compose(map, keys.zoom(1 / size))),
      digits_at(scale)
  end
  return map, CENTRE, digits_at(scale)
end

--- An outline as a group; nil: it is empty.
local function group_of(outline, map, fade, front, scale)
  local group = {}
  local inner, place, digits = layout_of(outline, map, scale)
  for _, contour in ipairs(outline.contours) do
    if #contour > 2 then group[#group + 1] = contour_of(contour, inner, digits) end
  end
  if not group[1] then return nil end
  local fill = outline.fill.map and outline.fill or moved(outline.fill, inner)
  group[#group + 1] = paint_of({ rule = outline.rule, fill = fill }, front, fade, digits)
  group[#group + 1] = place
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

local COARSE = 1 / 10 -- the scale whose digits areas have, as there are many of them
local UNDER = 3.2 -- units: the width of strokes below areas, wider than what players leave clear

local strokes = { fl = "st", gf = "gs" }

--- The items of a layer that shows parcels (core.parcels).
function shapes.parcels(parcels)
  local all = { kind = "group" }
  for i, parcel in ipairs(parcels) do all[i] = { data = parcel, matrix = IDENTITY, fade = 1 } end
  local list = shapes.items(all, IDENTITY, nil, COARSE)
  for i = #parcels.lines, 1, -1 do
    local line, group = parcels.lines[i], {}
    for k, contour in ipairs(line.contours) do
      group[k] = contour_of(contour, IDENTITY, digits_at(COARSE), true)
    end
    local stroke = paint_of(line, nil, 1, digits_at(1))
    stroke.ty, stroke.r = strokes[stroke.ty], nil
    stroke.w, stroke.lc, stroke.lj = still(UNDER), 2, 2
    group[#group + 1] = stroke
    group[#group + 1] = CENTRE
    if not line.fill.map then list[#list + 1] = { ty = "gr", it = group } end
  end
  return list
end

return shapes
