--- The colours of Lottie's fills and strokes: plain ones and gradients, as functions of the frame
--- that return a texture.
local celspan = require "celspan"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local paint = {}

local MIDDLES = 6 -- stops between two of different alpha, where colours are not premultiplied
local MOST_STOPS = 500

local function held(x) return x < 0 and 0 or x > 1 and 1 or x end

--- A paint of sRGB codes 0..1.
function paint.coded(r, g, b, alpha)
  return celspan.rgb(("#%02x%02x%02x"):format(math.floor(held(r) * 255 + 0.5),
    math.floor(held(g) * 255 + 0.5), math.floor(held(b) * 255 + 0.5)), held(alpha))
end

--- Keeps the last value of a function of the frame; one that does not move is called once.
function paint.memo(moves, make)
  local last, value
  return function(t)
    if last == nil or (moves and t ~= last) then last, value = t, make(t) end
    return value
  end
end

--- A texture, and whether it moves.
local function plain(scope, item, what)
  local colour, moves_colour = property.colour(scope, item.c, what .. " colour")
  local opacity, moves_opacity = property.number(scope, item.o, what .. " opacity", 100)
  local moves = moves_colour or moves_opacity
  return paint.memo(moves, function(t)
    local c, alpha = colour(t), held(opacity(t) / 100)
    return alpha > 0 and paint.coded(c[1], c[2], c[3], alpha) or nil
  end), moves
end

-- ---------------------------------------------------------------- gradients

--- Stops { at, ... } of a list of numbers, in order.
local function stops_of(list, first, count, size)
  local stops = {}
  for n = 0, count - 1 do
    local stop, k = { place = n }, first + n * size
    if list[k + size - 1] == nil then break end
    for i = 1, size do stop[i] = held(list[k + i - 1]) end
    stops[#stops + 1] = stop
  end
  table.sort(stops, function(a, b) return a[1] < b[1] or a[1] == b[1] and a.place < b.place end)
  return stops
end

--- The values of stops at a place.
local function between(stops, at, size)
  local before, after = stops[1], stops[#stops]
  for _, stop in ipairs(stops) do
    if stop[1] <= at then before = stop else after = stop break end
  end
  local gap = after[1] - before[1]
  local u = gap > 0 and held((at - before[1]) / gap) or 0
  local mixed = {}
  for i = 2, size do mixed[i] = before[i] + u * (after[i] - before[i]) end
  return mixed
end

--- All places where the colour or the alpha has a stop, and some between them where the alpha
--- changes.
local function places_of(colours, alphas)
  local places, all = {}, {}
  for _, list in ipairs { colours, alphas } do
    for _, stop in ipairs(list) do places[#places + 1] = stop[1] end
  end
  table.sort(places)
  for i, at in ipairs(places) do
    all[#all + 1] = at
    local after = places[i + 1]
    for k = 1, #alphas > 0 and after and after > at and MIDDLES or 0 do
      all[#all + 1] = at + (after - at) * k / (MIDDLES + 1)
    end
  end
  return all
end

--- Adds stops { at, paint } to the fields of a gradient. numbers: `count` times at, r, g, b; then
--- at, alpha.
local function add_stops(numbers, count, opacity, fields)
  local colours = stops_of(numbers, 1, count, 4)
  local rest = #numbers - 4 * count
  local alphas = rest >= 2 and stops_of(numbers, 4 * count + 1, rest // 2, 2) or {}
  if #colours == 0 then return false end
  if #alphas == 0 then
    for i, stop in ipairs(colours) do
      fields[i] = { stop[1], paint.coded(stop[2], stop[3], stop[4], opacity) }
    end
    return true
  end
  for i, at in ipairs(places_of(colours, alphas)) do
    local c, a = between(colours, at, 4), between(alphas, at, 2)
    fields[i] = { at, paint.coded(c[2], c[3], c[4], a[2] * opacity) }
  end
  return true
end

--- The focus of a radial gradient: on the line to its end, turned by an angle.
local function focus_of(from, to, share, degrees)
  share = math.max(-0.99, math.min(0.99, share))
  local angle = math.atan(to[2] - from[2], to[1] - from[1]) + math.rad(degrees)
  local reach = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2) * share
  return { from[1] + reach * math.cos(angle), from[2] + reach * math.sin(angle) }
end

local function shape_of(is_radial, from, to, share, degrees)
  if not is_radial then
    return celspan.linear, { from = { from[1], from[2] }, to = { to[1], to[2] } }
  end
  local radius = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2)
  return celspan.radial, { centre = { from[1], from[2] }, radius = radius,
                           focus = share ~= 0 and focus_of(from, to, share, degrees) or nil }
end

local function gradient(scope, item, what)
  local colours = scope.root.gradient(values.table(item.g) or {})
  local count = math.min(MOST_STOPS, math.max(0, math.floor(values.number(colours.p, 0))))
  local moves = false
  local function read(how, ...)
    local get, is_moving = how(scope, ...)
    moves = moves or is_moving
    return get
  end
  local numbers = read(property.numbers, colours.k, what .. " colours")
  local from = read(property.list, item.s, what .. " start", { 0, 0 })
  local to = read(property.list, item.e, what .. " end", { 0, 0 })
  local opacity = read(property.number, item.o, what .. " opacity", 100)
  local share = read(property.number, item.h, what .. " highlight", 0)
  local degrees = read(property.number, item.a, what .. " highlight's angle", 0)
  return paint.memo(moves, function(t)
    local make, fields = shape_of(item.t == 2, from(t), to(t), share(t) / 100, degrees(t))
    local alpha = held(opacity(t) / 100)
    if alpha == 0 or not add_stops(numbers(t), count, alpha, fields) then return nil end
    return make(fields)
  end), moves
end

--- The texture of a fill or a stroke: fl, st, gf or gs.
---@return fun(t: number): any texture nil: nothing is painted
---@return boolean moves
function paint.texture(scope, item, what)
  local is_gradient = item.ty == "gf" or item.ty == "gs"
  return (is_gradient and gradient or plain)(scope, item, what)
end

return require "celspan.fields".seal("lottie_paint", paint)
