--- Captions with their times, from SubRip (.srt) and WebVTT (.vtt) files.
--
--   local captions = assert(captions.read "line.vtt")
--   local text = captions:at(f.time)          -- nil between captions
--
-- Both formats are blocks between empty lines: an optional name or number, the times, the text.
local fields = require "celspan.fields"
local files = require "celspan.files"
local ordered = require "celspan.ordered"
local values = require "celspan.values"

local captions = {}

---@class celspan.captions.caption
---@field from number Seconds; the caption is shown from here ...
---@field to number ... until just before this
---@field text string Without tags
---@field markup string As it is written

---@class celspan.captions: celspan.captions.caption[] In the order of `from`
local Captions = fields.class("celspan.captions", "a list of captions")

local MOST_HOURS = 1000000

local function fail(line, format, ...)
  values.fail("line %d: %s", line, format:format(...))
end

-- ---------------------------------------------------------------- text

local entities = { amp = "&", lt = "<", gt = ">", nbsp = "\u{A0}", lrm = "\u{200E}",
                   rlm = "\u{200F}", quot = '"', apos = "'" }

local function read_entity(name)
  local digits, base = name:match "^#(%d+)$", 10
  if not digits then digits, base = name:match "^#[xX](%x+)$", 16 end
  local code = digits and #digits < 9 and tonumber(digits, base)
  if not code then return entities[name] end
  if code == 0 or code > 0x10FFFF or code >= 0xD800 and code < 0xE000 then code = 0xFFFD end
  return utf8.char(code)
end

--- A text without tags (<b>, <v Ann>, <00:01.000>, and SubRip's {\an8}) and with entities replaced
--- by characters.
local function plain(markup)
  local text = markup:gsub("<[^>]*>", ""):gsub("{\\[^}]*}", "")
  return (text:gsub("&([#%w]+);", read_entity))
end

-- ---------------------------------------------------------------- times

--- "01:02:03,500", "02:03.500"; hours may have more digits.
local function read_time(text)
  local rest, seconds, milli = text:match "^([%d:]*:)(%d%d)[.,](%d%d%d)$"
  if not rest then return nil end
  local hours, minutes = rest:match "^(%d+):(%d%d):$"
  minutes = minutes or rest:match "^(%d%d):$"
  if not minutes or tonumber(minutes) > 59 or tonumber(seconds) > 59 then return nil end
  return (tonumber(hours or 0) * 60 + minutes) * 60 + seconds + milli / 1000
end

--- The words on both sides of an arrow.
local function split_times(line) return line:match "^%s*(%S+)%s*%-%->%s*(%S+)" end

--- Whether a line is meant to be the times of a caption, correct or not. In SubRip another arrow is
--- text; in WebVTT text cannot contain an arrow.
local function is_times(line, is_vtt)
  local function is_time(text) return text and text:find "^[%d:.,]+$" and text:find ":" end
  if is_vtt then return line:find("-->", 1, true) end
  local first, last = split_times(line)
  return is_time(first) and is_time(last)
end

--- Reads the line with the arrow; settings after the second time are ignored.
local function read_times(line, number)
  local first, last = split_times(line)
  local from, to = read_time(first or ""), read_time(last or "")
  if not from or not to then
    fail(number, "'%s' must be two times with an arrow, 00:00:01.000 --> 00:00:02.500",
      line:sub(1, 60))
  end
  if to > 3600 * MOST_HOURS then
    fail(number, "the caption ends after %s; at most %d hours are read", last:sub(1, 60),
      MOST_HOURS)
  end
  if to <= from then
    fail(number, "the caption ends (%s) before it begins (%s), or at the same time", last, first)
  end
  return from, to
end

-- ---------------------------------------------------------------- files

--- The blocks of a text: { line =, lines... }. The times of a caption begin a block even if the
--- empty line before them is missing.
local function read_blocks(text, is_vtt)
  local blocks, block, number = {}, nil, 0
  for line in (text .. "\n"):gmatch "([^\n]*)\n" do
    number = number + 1
    local has_arrow = line:find("-->", 1, true) ~= nil
    local is_next = block and block.has_arrow and is_times(line, is_vtt)
    if is_next or line:find "^%s*$" then block = nil end
    if not line:find "^%s*$" then
      if not block then
        block = { line = number, has_arrow = false }
        blocks[#blocks + 1] = block
      end
      block[#block + 1] = line
      block.has_arrow = block.has_arrow or has_arrow
    end
  end
  return blocks
end

--- Adds the caption of a block. Notes, styles and regions of WebVTT contain no arrow.
local function read_block(block, is_vtt, list)
  local first = block[1]
  if not block.has_arrow then
    if is_vtt then return end
    fail(block.line, "'%s' begins a block without times", first:sub(1, 60))
  end
  local at = first:find("-->", 1, true) and 1 or 2
  local times = block[at]
  if not times:find("-->", 1, true) then
    fail(block.line + 1, "the times of a caption are on its first or second line")
  end
  local from, to = read_times(times, block.line + at - 1)
  local markup = table.concat(block, "\n", at + 1)
  list[#list + 1] = { from = from, to = to, text = plain(markup), markup = markup }
end

local function decode(text)
  if not utf8.len(text) then values.fail "the text is not UTF-8" end
  text = text:gsub("^\239\187\191", ""):gsub("\r\n?", "\n"):gsub("\0", "\u{FFFD}")
  local is_vtt, list = text:find "^WEBVTT%f[%s\0]" ~= nil, {}
  for i, block in ipairs(read_blocks(text, is_vtt)) do
    if not (is_vtt and i == 1 and not block.has_arrow) then read_block(block, is_vtt, list) end
  end
  return setmetatable(ordered.sort(list, "from"), Captions)
end

--- The text that is shown at a time; if there are several captions, one on each line; nil if there
--- is none.
---@param seconds number
---@return string? text
function Captions:at(seconds)
  fields.check_at("captions", Captions, self, seconds, "seconds")
  local texts = {}
  for i = 1, ordered.last(self, seconds, "from") do
    if self[i].to > seconds then texts[#texts + 1] = self[i].text end
  end
  return texts[1] and table.concat(texts, "\n")
end

--- Reads captions from a text.
---@param text string
---@return celspan.captions? captions
---@return string? message
function captions.decode(text)
  fields.takes("captions: decode", "string", "a string", text)
  return fields.caught(decode, text)
end

--- Reads captions from a file.
---@param path string Relative to the caller's file, else to the script
---@return celspan.captions? captions
---@return string? message
function captions.read(path)
  fields.takes("captions: read", "string", "a file name", path)
  local text, message = files.read_found(path, files.MOST_CAPTIONS)
  if not text then return nil, message end
  return fields.caught_in(path, decode, text)
end

return fields.publish("captions", captions, Captions)
