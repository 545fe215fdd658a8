--- Readers of lip-sync files: text in, the starts of mouth shapes out.
--
-- Each reader returns { cues = { { at =, shape = }, ... }, stop = }: in seconds with is_timed
-- (Rhubarb); else in frames from 1 (Moho, Papagayo), with fps and stop if the file has them. A
-- shape holds until the next one. Raises { message = }.
local values = require "celspan.values"

local cues = {}

local function add(found, at, shape)
  found.cues[#found.cues + 1] = { at = at, shape = shape }
end

--- Rhubarb TSV: "seconds<TAB>shape"; the last line ends the recording.
local function read_tsv(text)
  local found = { cues = {}, is_timed = true }
  for line in text:gmatch "[^\r\n]+" do
    local start, shape = line:match "^%s*(%d+%.?%d*)%s+(%S+)%s*$"
    if not start then values.fail('line %d is not "seconds<TAB>shape"', #found.cues + 1) end
    add(found, tonumber(start), shape)
  end
  found.stop = table.remove(found.cues).at
  return found
end

local function read_rhubarb_json(tree)
  local found = { cues = {}, is_timed = true, stop = 0 }
  for cue, where in values.each(tree, "", "mouthCues") do
    add(found, values.get(cue, where, "start", "number"), values.get(cue, where, "value", "string"))
    found.stop = math.max(found.stop, values.get(cue, where, "end", "number"))
  end
  return found
end

--- Papagayo-NG's .pgo 2: voices, phrases, words, phonemes.
local function read_pgo2(tree)
  local found = { cues = {}, fps = tonumber(tree.fps) }
  if type(tree.sound_duration) == "number" then found.stop = math.floor(tree.sound_duration) end
  local function walk(node, depth)
    for _, list in ipairs { "phrases", "words", "phonemes" } do
      for _, child in ipairs(values.table(node[list])) do
        if type(child) == "table" and depth < 8 then
          if list == "phonemes" and type(child.frame) == "number" then
            add(found, math.floor(child.frame) + 1, tostring(child.text))
          end
          walk(child, depth + 1)
          if list == "phrases" and type(child.end_frame) == "number" then
            add(found, math.floor(child.end_frame) + 2, "rest") -- the mouth closes
          end
        end
      end
    end
  end
  walk(values.table(tree.voices[1]), 0)
  return found
end

local function read_json(text)
  local tree = values.decode(text, "the file")
  if type(tree.mouthCues) == "table" then return read_rhubarb_json(tree) end
  if type(tree.voices) == "table" then return read_pgo2(tree) end
  values.fail "it is neither Rhubarb's JSON (mouthCues) nor Papagayo's (voices)"
end

--- Rhubarb XML: only its mouthCue elements are read.
local function read_xml(text)
  local found = { cues = {}, is_timed = true, stop = 0 }
  for attributes, shape in text:gmatch "<mouthCue%s([^>]*)>%s*(%w+)%s*</mouthCue>" do
    local start = tonumber(attributes:match 'start%s*=%s*"([^"]*)"')
    local stop = tonumber(attributes:match 'end%s*=%s*"([^"]*)"')
    if not start or not stop then
      values.fail("mouthCue %d lacks start or end", #found.cues + 1)
    end
    add(found, start, shape)
    found.stop = math.max(found.stop, stop)
  end
  return found
end

--- Moho switch data: lines of the form "frame word" count; the last one closes the mouth.
local function read_dat(text)
  local found = { cues = {} }
  for line in text:gmatch "[^\r\n]+" do
    local frame, shape = line:match "^%s*(%d+)%s+(%S+)%s*$"
    if frame then add(found, tonumber(frame), shape) end
  end
  return found
end

--- The first voice of Papagayo's .pgo 1: lists of lines after their count; tabs have no meaning.
local function read_pgo1(text)
  local lines, at = {}, 1
  for line in (text .. "\n"):gmatch "([^\r\n]*)\r?\n" do
    lines[#lines + 1] = line:match "^%s*(.-)%s*$"
  end
  local function next_line()
    at = at + 1
    return lines[at] or ""
  end
  --- The length of the next list, limited to the rest of the file.
  local function next_count() return math.min(tonumber(next_line()) or 0, #lines - at) end
  next_line() -- the sound's name
  local found = { cues = {}, fps = tonumber(next_line()), stop = tonumber(next_line()) }
  local voices = tonumber(next_line())
  if not (found.fps and found.stop and voices and voices >= 1) then
    values.fail "its head lacks fps, duration or voices"
  end
  at = at + 2 -- the voice's name and text
  for _ = 1, next_count() do
    at = at + 3 -- text, start, end
    local stop = tonumber(lines[at])
    for _ = 1, next_count() do
      local phonemes = tonumber(next_line():match "%d+$")
        or values.fail("line %d is not a word", at)
      for _ = 1, phonemes do
        local frame, shape = next_line():match "^(%d+)%s+(%S+)$"
        if not frame then values.fail('line %d is not "frame phoneme"', at) end
        add(found, tonumber(frame) + 1, shape) -- Papagayo counts from 0
      end
    end
    if stop then add(found, stop + 2, "rest") end -- the mouth closes after the phrase
  end
  return found
end

local formats = { -- what their texts begin with, and readers
  { "^%s*{", read_json }, { "^%s*<", read_xml }, { "^lipsync version 1", read_pgo1 },
  { "^MohoSwitch1", read_dat }, { "^%s*%d+%.%d+%s", read_tsv }, { "^%s*%d+%s+%S+", read_dat },
}

--- The format is detected from the text itself, so a wrong file extension does not matter.
---@param text string
---@return table found
function cues.read(text)
  local start = text:gsub("^\239\187\191", "")
  for _, format in ipairs(formats) do
    if start:find(format[1]) then
      local found = format[2](start)
      if not found.cues[1] then values.fail "there are no cues" end
      if found.fps and not (found.fps > 0 and found.fps <= 1000) then
        values.fail("its frame rate is %.14g: it must be above 0 and at most 1000", found.fps)
      end
      return found
    end
  end
  values.fail "it is not Rhubarb's TSV, JSON, XML or dat, Moho's dat, or Papagayo's pgo 1 or 2"
end

return cues
