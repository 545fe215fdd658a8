--- The captions of a film as a text that ffmpeg reads, for the subtitles of videos.
--
--   captions    |--a--|   |---b---|            seconds of the film
--                           |---c---|
--   frames            |      shown      |
--   text                  |b|-b c-|c|          from the first frame that is shown
--
-- Formats of videos show one text at a time, so where captions overlap their texts are joined.
--
-- Nothing in a text is markup: WebVTT has entities for this. SubRip has nothing, and ffmpeg reads
-- HTML, {\codes} and \n in it: an invisible character makes them plain text.
local captions = require "celspan.captions"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"

local subtitles = {}

local WORD_JOINER = "\u{2060}" -- no width, no break

local function fail(text, ...) error("film: captions: " .. text:format(...), 0) end

local function read(name, path, tried)
  local text, message = files.read(path, files.MOST_CAPTIONS)
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

-- What is different in the two formats.
local FORMS = {
  srt = {
    head = "", point = ",",
    plain = function(text)
      return (text:gsub("[<{&]%f[%a/\\#]", "%0" .. WORD_JOINER)
        :gsub("\\%f[%a]", "%0" .. WORD_JOINER):gsub("%-%->", "--" .. WORD_JOINER .. ">"))
    end,
  },
  webvtt = {
    head = "WEBVTT\n\n", point = ".",
    plain = function(text)
      return (text:gsub("[&<>]", { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;" }))
    end,
  },
}

local function time(milli, point)
  return ("%02d:%02d:%02d%s%03d"):format(milli // 3600000, milli // 60000 % 60, milli // 1000 % 60,
    point, milli % 1000)
end

--- The text without empty lines, which end a caption.
local function lines(text)
  return (text:gsub("%c", function(c) return c == "\n" and c or " " end)
    :gsub("\n%s*\n", "\n"):gsub("^%s+", ""):gsub("%s+$", ""))
end

--- The captions between two times, from which seconds are counted, in milliseconds.
local function shown(list, first, seconds)
  local cut = {}
  for i, one in ipairs(list) do
    local from, to = math.max(0, one.from - first), math.min(seconds, one.to - first)
    from, to = math.floor(from * 1000 + 0.5), math.floor(to * 1000 + 0.5)
    local text = lines(one.text)
    if from < to and text ~= "" then
      cut[#cut + 1] = { from = from, to = to, text = text, i = i }
    end
  end
  table.sort(cut, function(a, b) return a.from < b.from or a.from == b.from and a.i < b.i end)
  return cut
end

--- The same captions without overlaps: each change of what is shown begins a text.
local function apart(list)
  local times, active, place, parts = {}, {}, 1, {}
  for i, one in ipairs(list) do times[2 * i - 1], times[2 * i] = one.from, one.to end
  table.sort(times)
  for k = 1, #times - 1 do
    local from, texts, kept = times[k], {}, {}
    while list[place] and list[place].from <= from do
      table.insert(active, list[place])
      place = place + 1
    end
    for _, one in ipairs(active) do
      if one.to > from then kept[#kept + 1], texts[#texts + 1] = one, one.text end
    end
    active = kept
    if texts[1] and from < times[k + 1] then
      parts[#parts + 1] = { from = from, to = times[k + 1], text = table.concat(texts, "\n") }
    end
  end
  return parts
end

--- All captions of a film.
---@param film celspan.film
---@return celspan.captions.caption[]
function subtitles.list(film)
  local list, path, tried = native.captions(film)
  if path then list = read(list, path, tried) end
  for i, one in ipairs(list or {}) do check(one, i) end
  return list or {}
end

--- The captions that are shown in the given seconds from `first` on; "" for none.
---@param film celspan.film
---@param form "srt"|"webvtt"
---@param first number
---@param seconds number
---@return string text
function subtitles.text(film, form, first, seconds)
  local blocks, rules = {}, FORMS[form]
  for i, one in ipairs(apart(shown(subtitles.list(film), first, seconds))) do
    blocks[i] = ("%d\n%s --> %s\n%s\n"):format(i, time(one.from, rules.point),
      time(one.to, rules.point), rules.plain(one.text))
  end
  return blocks[1] and rules.head .. table.concat(blocks, "\n") or ""
end

return fields.seal("subtitles", subtitles)
