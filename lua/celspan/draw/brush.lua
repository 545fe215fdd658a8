--- Lines of a brush: celspan.brush{ d = , width = , profile = , texture = }.
--
--      y                        The line is drawn straight first: x goes from 0 to 1 along it, y
--      |   .----------.         from -1/2 to 1/2 across its greatest width. There lie its texture
--      +--<------------>--- x   and its outline, by the profile. Then it is scaled to the length
--          `----------'         and the width, and bent along the path.
local native = require "celspan.native"
local celspan = require "celspan"
local curves = require "celspan.curves"
local fields = require "celspan.fields"
local warp = require "celspan.warp"

local brush = {}

local SAMPLES = 48
local CHISEL = 0.15 -- the thickness of the nib, as a share of the width

local function refuse(text, ...) native.refuse("brush: " .. text:format(...)) end

--- The width at a place of the drawn part, as a share. line: { curve, width, from, length }, in
--- units; length: of the drawn part.
local profiles = {}

function profiles.even() return 1 end

function profiles.round(t, line)
  local near = math.min(t, 1 - t) * line.length / (line.width / 2)
  return near >= 1 and 1 or math.sqrt(math.max(0, near * (2 - near)))
end

function profiles.ink(t) return math.max(0, math.sin(math.pi * t)) ^ 0.7 end

function profiles.chisel(t, line)
  local _, _, dx, dy = line.curve:at(line.from + t * line.length)
  local angle = math.rad(line.nib)
  return CHISEL + (1 - CHISEL) * math.abs(dx * math.sin(angle) + dy * math.cos(angle))
end

local known = { d = "any", width = "number", profile = "any", nib = "number", texture = "any",
                from = "number", to = "number", within = "number", pieces = "number" }

local function check_share(name, value)
  fields.must(value >= 0 and value <= 1, ("brush: field '%s'"):format(name), "from 0 to 1", value)
end

--- The profile as a function of the share.
local function profile_of(given, line)
  if type(given) == "function" then
    return function(t)
      local share = given(t)
      if not fields.is_finite(share) or share < 0 then
        refuse("the profile must return a number of 0 or more, got %s at %.4g",
          fields.shown(share), t)
      end
      return share
    end
  end
  local found = profiles[given]
  if found then return function(t) return found(t, line) end end
  local names = { "chisel", "even", "ink", "round" }
  local hint = type(given) == "string" and native.nearest(given, names)
  refuse("field 'profile' must be a function or \"chisel\", \"even\", \"ink\" or \"round\", got "
    .. "%s%s", type(given) == "string" and ("%q"):format(given) or fields.kind(given),
    hint and ("; did you mean %q?"):format(hint) or "")
end

--- Places along the line, closer together at its ends, and half of the width there, as a share.
local function samples_of(profile, from, to)
  local xs, halves = {}, {}
  for i = 0, SAMPLES do
    local t = (1 - math.cos(math.pi * i / SAMPLES)) / 2
    xs[i], halves[i] = from + (to - from) * t, profile(t) / 2
  end
  return xs, halves
end

--- Adds a side as curves, from its first sample to its last, or in reverse.
local function add_side(contour, xs, ys, first, last, step)
  local function slope(i)
    local a, b = math.max(0, i - 1), math.min(SAMPLES, i + 1)
    return (ys[b] - ys[a]) / (xs[b] - xs[a])
  end
  for i = first, last - step, step do
    local j, third = i + step, (xs[i + step] - xs[i]) / 3
    table.move({ xs[i] + third, ys[i] + slope(i) * third, xs[j] - third, ys[j] - slope(j) * third,
                 xs[j], ys[j] }, 1, 6, #contour + 1, contour)
  end
end

--- The outline of the straight line, symmetrical about the x axis.
local function outline_of(profile, from, to)
  local xs, above = samples_of(profile, from, to)
  local below = {}
  for i = 0, SAMPLES do below[i] = -above[i] end
  local contour, tip = { xs[0], below[0] }, xs[SAMPLES]
  add_side(contour, xs, below, 0, SAMPLES, 1)
  table.move({ tip, below[SAMPLES], tip, above[SAMPLES], tip, above[SAMPLES] }, 1, 6, #contour + 1,
    contour)
  add_side(contour, xs, above, SAMPLES, 0, -1)
  return contour
end

--- A line with a texture along it and a width that changes: x of the texture goes from 0 to 1 along
--- the line, y from -0.5 to 0.5 across it.
---@param options { d: string|celspan.path, width?: number, profile?: "round"|"even"|"ink"|"chisel"|fun(t: number): number, nib?: number, fill?: celspan.surface, from?: number, to?: number, within?: number, pieces?: integer }
---@return celspan.object
function brush.line(options)
  options = fields.check("brush", options, known)
  local width, from, to = options.width or 1, options.from or 0, options.to or 1
  if options.d == nil then refuse "needs the field 'd', the path of the line" end
  fields.must(width > 0 and width < math.huge, "brush: field 'width'", "above 0", width)
  check_share("from", from)
  check_share("to", to)
  local curve = curves.read("brush", options.d, "d")
  if not (from < to and curve.length > 0) then return celspan.union {} end
  local line = { curve = curve, width = width, nib = options.nib or 45,
                 from = from * curve.length, length = (to - from) * curve.length }
  local profile = profile_of(options.profile or "round", line)
  local straight = celspan.path { contours = { outline_of(profile, from, to) },
                                  texture = options.texture }
  return warp.apply(straight:scale(curve.length, width), { along = options.d, start = from,
    within = options.within, pieces = options.pieces })
end

return fields.seal("brush", brush)
