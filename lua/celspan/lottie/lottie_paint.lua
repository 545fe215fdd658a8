--- The colours of Lottie's fills and strokes: plain ones and gradients, as functions of the frame
--- that return a texture.
local celspan = require "celspan"
local property = require "celspan.lottie_property"
local values = require "celspan.lottie_values"

local paint = {}

local MIDDLES = 6 -- stops between two of different colour and alpha, which are not premultiplied
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

--- A function of up to six values that keeps its last result: while they are the same, so is the
--- object that is made of them, and what celspan knows of it is found again.
function paint.keep(make)
  local a, b, c, d, e, f, value
  return function(u, v, w, x, y, z)
    if value == nil or u ~= a or v ~= b or w ~= c or x ~= d or y ~= e or z ~= f then
      a, b, c, d, e, f = u, v, w, x, y, z
      value = make(u, v, w, x, y, z)
    end
    return value
  end
end

--- The same for a function of a list, which is compared item by item.
function paint.keep_list(make)
  local last, value
  return function(list)
    local is_same = last and #last == #list
    for i = 1, is_same and #list or 0 do
      if last[i] ~= list[i] then
        is_same = false
        break
      end
    end
    if not is_same then last, value = list, make(list) end
    return value
  end
end

--- A texture, and whether it moves.
local function plain(scope, item, what)
  local colour, moves_colour = property.colour(scope, item.c, what .. " colour")
  local opacity, moves_opacity = property.number(scope, item.o, what .. " opacity", 100)
  local moves = moves_colour or moves_opacity
  local made = paint.keep(function(c, alpha) return paint.coded(c[1], c[2], c[3], alpha) end)
  return paint.memo(moves, function(t)
    local alpha = held(opacity(t) / 100)
    return alpha > 0 and made(colour(t), alpha) or nil
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

--- The values just before a place, and from it on. cursor: of places that only grow.
local function sides(stops, cursor, at)
  while stops[cursor.n + 1] and stops[cursor.n + 1][1] < at do cursor.n = cursor.n + 1 end
  local function mixed(one, other)
    if not one or not other then return one or other end
    local u, values_of = (at - one[1]) / (other[1] - one[1]), {}
    for i = 2, #one do values_of[i] = one[i] + u * (other[i] - one[i]) end
    return values_of
  end
  local first, n = stops[cursor.n], cursor.n + 1
  if not stops[n] or stops[n][1] > at then
    local here = mixed(first, stops[n])
    return here, here
  end
  local before = stops[n]
  while stops[n + 1] and stops[n + 1][1] == at do n = n + 1 end
  return before, stops[n]
end

local function differ(a, b)
  for i = 2, #a do
    if a[i] ~= b[i] then return true end
  end
  return false
end

--- All places where the colour or the alpha has a stop, each once.
local function places_of(colours, alphas)
  local places, all = {}, {}
  for _, list in ipairs { colours, alphas } do
    for _, stop in ipairs(list) do places[#places + 1] = stop[1] end
  end
  table.sort(places)
  for _, at in ipairs(places) do
    if all[#all] ~= at then all[#all + 1] = at end
  end
  return all
end

--- Stops { at, colour, alpha } of colours and alphas that have stops of their own. Colours are
--- mixed as they are and celspan mixes them times alpha, so there are some more where both change.
--- Where one of them jumps there are two.
local function join_stops(colours, alphas)
  local list, of_colours, of_alphas = {}, { n = 0 }, { n = 0 }
  local function add(at, c, a) list[#list + 1] = { at, c, a } end
  for _, at in ipairs(places_of(colours, alphas)) do
    local c, c_after = sides(colours, of_colours, at)
    local a, a_after = sides(alphas, of_alphas, at)
    local last = list[#list]
    if last and differ(last[2], c) and differ(last[3], a) then
      for k = 1, MIDDLES do
        local u, colour = k / (MIDDLES + 1), {}
        for i = 2, 4 do colour[i] = last[2][i] + u * (c[i] - last[2][i]) end
        add(last[1] + u * (at - last[1]), colour, { 0, last[3][2] + u * (a[2] - last[3][2]) })
      end
    end
    add(at, c, a)
    if differ(c, c_after) or differ(a, a_after) then add(at, c_after, a_after) end
  end
  return list
end

--- Adds stops { at, paint } to the fields of a gradient. numbers: `count` times at, r, g, b; then
--- at, alpha.
local function add_stops(numbers, count, opacity, fields)
  local colours = stops_of(numbers, 1, count, 4)
  local rest = math.min(MOST_STOPS, math.max(0, (#numbers - 4 * count) // 2))
  local alphas = stops_of(numbers, 4 * count + 1, rest, 2)
  if #colours == 0 then return false end
  if #alphas == 0 then alphas = { { 0, 1 } } end
  for i, stop in ipairs(join_stops(colours, alphas)) do
    local c = stop[2]
    fields[i] = { stop[1], paint.coded(c[2], c[3], c[4], stop[3][2] * opacity) }
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
  local read, moves = property.reader(scope)
  local numbers = read(property.numbers, colours.k, what .. " colours")
  local from = read(property.list, item.s, what .. " start", { 0, 0 })
  local to = read(property.list, item.e, what .. " end", { 0, 0 })
  local opacity = read(property.number, item.o, what .. " opacity", 100)
  local share = read(property.number, item.h, what .. " highlight", 0)
  local degrees = read(property.number, item.a, what .. " highlight's angle", 0)
  local made = paint.keep(function(stops, alpha, a, b, highlight, angle)
    local make, fields = shape_of(item.t == 2, a, b, highlight, angle)
    return add_stops(stops, count, alpha, fields) and make(fields) or nil
  end)
  return paint.memo(moves(), function(t)
    local alpha = held(opacity(t) / 100)
    return alpha > 0 and made(numbers(t), alpha, from(t), to(t), share(t) / 100, degrees(t)) or nil
  end), moves()
end

--- The texture of a fill or a stroke: fl, st, gf or gs.
---@return fun(t: number): any texture nil: nothing is painted
---@return boolean moves
function paint.texture(scope, item, what)
  local is_gradient = item.ty == "gf" or item.ty == "gs"
  return (is_gradient and gradient or plain)(scope, item, what)
end

return require "celspan.fields".seal("lottie_paint", paint)
