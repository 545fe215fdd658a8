--- Fills of Lottie: colours and gradients of what a frame's structure holds (native.scenery).
local text, is_coded = ...
local native = require "celspan.native"

local still = text.still

local SMOOTH = 1 / 512 -- how far a gradient's colour may be from that between two stops
local DEEPEST = 6 -- halvings of the way between two stops

-- ---------------------------------------------------------------- colours

--- sRGB's code of light, limited to what it can say. Codes stay below 1.
local function code(light)
  if light <= 0 then return 0 end
  if light >= 1 then return 1 end
  return native.code(light)
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

--- A premultiplied stop as straight codes; where it is clear, the codes of `near`.
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

return paint_of
