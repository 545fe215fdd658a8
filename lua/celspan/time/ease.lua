--- Easing curves: pure functions from 0..1 to 0..1.
--
--   ease "inOutQuad" (u)      tween.lua's names
--   ease "quadinout" (u)      flux's names
--   ease "in-out-quad" (u)    hump.timer's names
--   ease "easeInOutQuad" (u)  Penner's names
--   ease "ease-in-out" (u)    CSS's names: ease, ease-in, ease-out, ease-in-out, step-start,
--                             step-end, steps(4), cubic-bezier(.4, 0, .2, 1)
--   ease "linear", ease "hold", ease "spring", ease "steps:4", ease "bezier:.4,0,.2,1",
--   ease(function)
--
-- in, out, inOut and outIn go with Quad, Cubic, Quart, Quint, Sine, Expo, Circ, Back, Bounce and
-- Elastic. `in` begins slowly, `out` ends slowly, `inOut` does both.
--
-- A curve starts at 0 for u <= 0 and ends at 1 for u >= 1; back, elastic and spring overshoot
-- between.
local native = require "celspan.native"
local fields = require "celspan.fields"

local pi, sin, sqrt = math.pi, math.sin, math.sqrt

--- The "in" curve of each family; the other directions are made from it.
local families = {
  quad = function(u) return u * u end,
  cubic = function(u) return u * u * u end,
  quart = function(u) return u * u * u * u end,
  quint = function(u) return u * u * u * u * u end,
  sine = function(u) return 1 - math.cos(u * pi / 2) end,
  expo = function(u) return u == 0 and 0 or 2 ^ (10 * (u - 1)) end,
  circ = function(u) return 1 - sqrt(1 - u * u) end,
  back = function(u) return u * u * (2.70158 * u - 1.70158) end,
  elastic = function(u)
    if u == 0 or u == 1 then return u end
    return -(2 ^ (10 * (u - 1))) * sin((u - 1.075) * 2 * pi / 0.3)
  end,
}

--- Penner's bounce, defined by its "out" curve: four parabolas.
local function bounce_out(u)
  if u < 1 / 2.75 then return 7.5625 * u * u end
  if u < 2 / 2.75 then u = u - 1.5 / 2.75; return 7.5625 * u * u + 0.75 end
  if u < 2.5 / 2.75 then u = u - 2.25 / 2.75; return 7.5625 * u * u + 0.9375 end
  u = u - 2.625 / 2.75
  return 7.5625 * u * u + 0.984375
end
families.bounce = function(u) return 1 - bounce_out(1 - u) end

local directions = {}

directions["in"] = function(f) return f end

function directions.out(f)
  return function(u) return 1 - f(1 - u) end
end

function directions.inout(f)
  return function(u)
    if u < 0.5 then return f(2 * u) / 2 end
    return 1 - f(2 - 2 * u) / 2
  end
end

function directions.outin(f)
  return function(u)
    if u < 0.5 then return (1 - f(1 - 2 * u)) / 2 end
    return (1 + f(2 * u - 1)) / 2
  end
end

--- The curve, but 0 before 0 and 1 after 1.
local function held(f)
  return function(u)
    if u <= 0 then return 0 end
    if u >= 1 then return 1 end
    return f(u)
  end
end

local DAMPING, SWINGS = 6, 2

--- A weight on a spring that is released: it starts at rest and swings around 1. The remaining
--- swing at the end is subtracted from the curve evenly.
local function spring(u)
  local angle = 2 * pi * SWINGS
  local swing = math.cos(angle * u) + DAMPING / angle * sin(angle * u)
  return 1 - math.exp(-DAMPING * u) * swing + u * math.exp(-DAMPING)
end

local curves = { linear = held(function(u) return u end), hold = held(function() return 0 end),
                 stepstart = held(function() return 1 end), spring = held(spring) }
curves.stepend = curves.hold
local names = { "linear", "hold", "stepstart", "stepend", "spring" }

for _, family in ipairs { "quad", "cubic", "quart", "quint", "sine", "expo", "circ", "back",
                          "bounce", "elastic" } do
  for _, direction in ipairs { "in", "out", "inout", "outin" } do
    local curve = held(directions[direction](families[family]))
    curves[direction .. family] = curve
    curves[family .. direction] = curve
    names[#names + 1] = direction .. family
    names[#names + 1] = family .. direction
  end
  -- in hump.timer the name of a family means its "in" curve
  curves[family] = curves["in" .. family]
  names[#names + 1] = family
end

-- Penner's names, which begin with "ease"
local penner = {}
for i, name in ipairs(names) do penner[i] = "ease" .. name end

--- "steps:4": four equal steps; the last value is reached at the end.
local function steps(text)
  local count = tonumber(text)
  if not count or count < 1 or count ~= math.floor(count) then
    native.refuse(("ease: steps takes a whole number of at least 1, got %q"):format(text))
  end
  return held(function(u) return math.floor(u * count) / count end)
end

--- One coordinate of a Bezier curve from 0 to 1 with inner control values a and b.
local function bezier_at(a, b, t)
  local s = 1 - t
  return 3 * s * s * t * a + 3 * s * t * t * b + t * t * t
end

local DEPTH, NEAR = 52, 44 -- halvings of 0..1 by bisection, and those that Newton's method saves

--- The place that is u by Newton's method; of no use where the curve is nearly upright.
local function guess(x1, x2, u)
  local c, b = 3 * x1, 3 * (x2 - 2 * x1)
  local a, t = 1 - c - b, u
  for _ = 1, 5 do
    t = t - (((a * t + b) * t + c) * t - u) / ((3 * a * t + 2 * b) * t + c)
  end
  return t
end

--- A curve through 0, 0 and 1, 1 with these inner control points. Finds y at the place where x is
--- u, by bisection, which begins next to the guess if it is right.
local function bezier_curve(x1, y1, x2, y2)
  return held(function(u)
    local low, high, halvings = 0, 1, DEPTH
    local place = guess(x1, x2, u) * 2 ^ NEAR
    if place > 0 and place < 2 ^ NEAR then
      local from = math.floor(place) / 2 ^ NEAR
      local to = from + 2 ^ -NEAR
      if bezier_at(x1, x2, from) < u and bezier_at(x1, x2, to) >= u then
        low, high, halvings = from, to, DEPTH - NEAR
      end
    end
    for _ = 1, halvings do
      local middle = (low + high) / 2
      if bezier_at(x1, x2, middle) < u then low = middle else high = middle end
    end
    return bezier_at(y1, y2, (low + high) / 2)
  end)
end

-- CSS Easing Functions Level 1, section 2.2
for name, points in pairs { ease = { 0.25, 0.1, 0.25, 1 }, easein = { 0.42, 0, 1, 1 },
                            easeout = { 0, 0, 0.58, 1 }, easeinout = { 0.42, 0, 0.58, 1 } } do
  curves[name] = bezier_curve(table.unpack(points))
end
table.move({ "ease", "easein", "easeout", "easeinout" }, 1, 4, #names + 1, names)

--- "bezier:x1,y1,x2,y2" as in CSS.
local function bezier(text)
  local n = {}
  for word in (text .. ","):gmatch "%s*([^,]*)," do n[#n + 1] = tonumber(word) or 0 / 0 end
  local x1, y1, x2, y2 = table.unpack(n)
  local good = #n == 4 and x1 >= 0 and x1 <= 1 and x2 >= 0 and x2 <= 1 and y1 == y1 and y2 == y2
  if not good then
    native.refuse(("ease: bezier takes x1,y1,x2,y2 with x1 and x2 in 0..1, got %q"):format(text))
  end
  return bezier_curve(x1, y1, x2, y2)
end

local function find(_, name)
  if type(name) == "function" then return name end
  fields.takes("ease:", "string", "a curve's name or a function", name)
  local kind, text = name:match "^([%a-]+)[:(](.-)%)?$"
  if kind == "steps" then return steps(text) end
  if kind == "bezier" or kind == "cubic-bezier" then return bezier(text) end
  local plain = name:lower():gsub("[-_ ]", "")
  local curve = curves[plain] or curves[plain:match "^ease(.*)$"]
  if curve then return curve end
  local hint = directions[plain] and plain .. "sine" or native.nearest(plain, names)
    or native.nearest(plain, penner)
  native.refuse(("ease: there is no curve %q%s"):format(name,
    hint and ("; did you mean %q?"):format(hint)
      or "; celspan help lua ease describes the names"))
end

---@class celspan.ease
---@field names string[]
---@overload fun(curve: string|fun(u: number): number): fun(u: number): number
local ease = fields.publish("ease", setmetatable({
  --- Every name in its plain form: "inquad", "quadin", ...
  names = names,
}, {
  __call = native.entry(find),
}))

local metatable = getmetatable(ease)
local otherwise = metatable.__index

--- `ease.outBounce` is no field: a curve is asked for by name.
function metatable.__index(_, name)
  if type(name) ~= "string" or native.nearest(name, { "names" }) then
    return otherwise(ease, name)
  end
  find(nil, name) -- refuses what is no curve
  native.refuse(("celspan.ease has no '%s': write ease %q"):format(name, name))
end

return ease
