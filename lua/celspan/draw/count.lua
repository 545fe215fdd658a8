--- Numbers as they are written in a language, and frames as a clock: celspan.count, timecode.
--
--   celspan.count(48250)                                      --> 48,250
--   celspan.count(1234567.891, { language = "hi", decimals = 1 })   --> 12,34,567.9
--   celspan.timecode(3600, 24)                                --> 00:02:30:00
--
-- Separators and sizes of groups are those of Unicode's locale data (CLDR).
local native = require "celspan.native"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"

local count = {}

local THIN, WIDE = "\u{202f}", "\u{a0}" -- spaces at which no line breaks
local MOST_DECIMALS = 15

--- { separator of groups, separator of decimals, digits of each group after the first, least number
--- of digits before the first separator }
local comma, point, space = { ",", "." }, { ".", "," }, { WIDE, "," }
local known = {
  en = comma, ja = comma, ko = comma, zh = comma, th = comma, he = comma, ar = comma, ga = comma,
  hi = { ",", ".", 2 }, bn = { ",", ".", 2 }, ta = { ",", ".", 2 }, ["en-IN"] = { ",", ".", 2 },
  de = point, it = point, nl = point, da = point, el = point, id = point, tr = point,
  ro = point, hr = point, sl = point, sr = point, vi = point, is = point, ca = point,
  es = { ".", ",", 3, 2 }, pt = point, ["pt-PT"] = { WIDE, ",", 3, 2 }, ["es-MX"] = comma,
  fr = { THIN, "," }, ["de-CH"] = { "’", "." }, ["de-AT"] = { WIDE, "," },
  sv = space, nb = space, fi = space, cs = space, sk = space, hu = space, ru = space, uk = space,
  et = { WIDE, ",", 3, 2 }, pl = { WIDE, ",", 3, 2 }, bg = { WIDE, ",", 3, 2 }, lt = space,
  lv = { WIDE, ",", 3, 2 },
}

local function refuse(text, ...) native.refuse("count: " .. text:format(...)) end

--- The style of a language. "pt-BR" has the style of "pt", unless it has its own.
local function style_of(language)
  local style = known[language] or known[language:match "^%a+" or ""]
  if style then return style end
  refuse("there is no language %q; there are %s", language,
    table.concat(ordered.names(known), ", "))
end

--- The digits with separators: one before the last three digits, and one before each group in front
--- of them.
local function grouped(digits, style)
  local size, least = style[3] or 3, style[4] or 1
  if #digits < 3 + least then return digits end
  local groups, rest = { digits:sub(-3) }, digits:sub(1, -4)
  while rest ~= "" do
    table.insert(groups, 1, rest:sub(-size))
    rest = rest:sub(1, -size - 1)
  end
  return table.concat(groups, style[1])
end

--- A number as it is written in a language: "48,250", "48.250", "48 250".
---@param value number
---@param options? { language?: string, decimals?: integer, group?: boolean } Default "en", 0, true
---@return string
function count.written(value, options)
  options = options or {}
  fields.check("count", options, { language = "string", decimals = "number", group = "boolean" })
  local decimals = options.decimals or 0
  fields.must(fields.is_finite(value), "count: the first argument", "a finite number", value)
  decimals = fields.whole("count: decimals", decimals, 0, MOST_DECIMALS)
  local style = style_of(options.language or "en")
  local text = ("%%.%df"):format(decimals):format(math.abs(value))
  local whole, rest = text:match "^(%d+)%.?(%d*)$"
  local sign = value < 0 and text:find "[1-9]" and "\u{2212}" or ""
  if options.group ~= false then whole = grouped(whole, style) end
  return sign .. whole .. (rest ~= "" and style[2] .. rest or "")
end

--- The number that a frame has where the clock leaves out the first numbers of every minute except
--- each tenth, so that it is right at 29.97 or 59.94 frames a second.
local function dropped(index, rate)
  local skipped = rate // 15
  local minute, ten = 60 * rate - skipped, 600 * rate - 9 * skipped
  local rest = index % ten
  return index + 9 * skipped * (index // ten) + skipped * (math.max(0, rest - skipped) // minute)
end

--- The number of a frame as hours, minutes, seconds and frames: "01:00:04:12".
---@param index integer From 0
---@param fps number
---@param options? { drop?: boolean } Of 29.97 and 59.94 frames a second: right by the clock
---@return string
function count.timecode(index, fps, options)
  options = options or {}
  fields.check("timecode", options, { drop = "boolean" })
  fields.expect(fields.is_finite(index) and index % 1 == 0 and index >= 0 and index <= 2 ^ 53,
    index, "timecode: the first argument, a frame, must be a whole number from 0 on")
  local rate = fields.is_finite(fps) and math.floor(fps + 0.5) or 0
  fields.expect(rate >= 1 and rate <= 1000, fps,
    "timecode: the second argument must be frames per second, 1 to 1000")
  fields.expect(not options.drop or rate == 30 or rate == 60, fps,
    "timecode: drop is for 29.97 and 59.94 frames a second")
  local number = options.drop and dropped(index // 1, rate) or index // 1
  local seconds = number // rate
  return ("%02d:%02d:%02d%s%02d"):format(seconds // 3600, seconds // 60 % 60, seconds % 60,
    options.drop and ";" or ":", number % rate)
end

return fields.seal("count", count)
