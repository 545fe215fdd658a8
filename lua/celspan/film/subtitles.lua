--- The captions of a film as SubRip text, for the subtitles of videos.
--
--   captions    |--a--|   |---b---|            seconds of the film
--   frames            |      shown      |
--   text                  |---b---|            from the first frame that is shown
local captions = require "celspan.captions"
local core = require "celspan.core"
local fields = require "celspan.fields"
local files = require "celspan.files"

local subtitles = {}

local MOST_BYTES = 16 * 1024 * 1024 -- of a file
local LEAST = 0.001 -- seconds that a caption is shown, which is the unit of the format

local function fail(text, ...) error("film: captions: " .. text:format(...), 0) end

local function read(name, path, tried)
  local text, message = files.read(path, MOST_BYTES)
  if not text then fail("%s%s", message, tried and "; also looked for at " .. tried or "") end
  local list, problem = captions.decode(text)
  return list or fail("%s: %s", name, problem)
end

--- Raises an error unless a value is a caption.
local function check(one, i)
  if type(one) ~= "table" or not fields.is_finite(one.from) or not fields.is_finite(one.to)
    or type(one.text) ~= "string" or not utf8.len(one.text) then
    fail("caption %d must be { from = seconds, to = seconds, text = a UTF-8 string }", i)
  end
  if one.to <= one.from then fail("caption %d ends before it begins, or at the same time", i) end
end

local function time(seconds)
  local milli = math.floor(seconds * 1000 + 0.5)
  return ("%02d:%02d:%02d,%03d"):format(milli // 3600000, milli // 60000 % 60, milli // 1000 % 60,
    milli % 1000)
end

--- The text without empty lines, which end a caption.
local function lines(text)
  return (text:gsub("%c", function(c) return c == "\n" and c or " " end)
    :gsub("\n%s*\n", "\n"):gsub("^%s+", ""):gsub("%s+$", ""))
end

--- The captions that are shown in the given seconds from `first` on; "" for none.
---@param film celspan.film
---@param first number
---@param seconds number
---@return string text
function subtitles.srt(film, first, seconds)
  local list, path, tried = core.captions(film)
  if path then list = read(list, path, tried) end
  local blocks = {}
  for i, one in ipairs(list) do
    check(one, i)
    local from, to = math.max(0, one.from - first), math.min(seconds, one.to - first)
    local text = lines(one.text)
    if to - from >= LEAST and text ~= "" then
      blocks[#blocks + 1] = ("%d\n%s --> %s\n%s\n"):format(#blocks + 1, time(from), time(to), text)
    end
  end
  return table.concat(blocks, "\n")
end

return fields.seal("subtitles", subtitles)
