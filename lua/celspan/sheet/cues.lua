--- Readers of lip-sync files: text in, timed cues out. lips.lua converts the cues to frames.
--
-- Each reader returns { cues = { {start, stop, shape}, ... } } in seconds (Rhubarb), or
-- { marks = { {frame, shape}, ... }, count = frames or nil, fps = number or nil } in frames from 1
-- (Moho, Papagayo), where a mark holds until the next one; or nil and a message.
local json = require "celspan.json"

local cues = {}

--- Rhubarb TSV: "seconds<TAB>shape"; the last line ends the recording.
local function read_tsv(text)
  local list = {}
  for line in text:gmatch "[^\r\n]+" do
    local start, shape = line:match "^%s*(%d+%.?%d*)%s+(%S+)%s*$"
    if not start then return nil, ("line %d is not \"seconds<TAB>shape\""):format(#list + 1) end
    list[#list + 1] = { tonumber(start), nil, shape }
    if #list > 1 then list[#list - 1][2] = list[#list][1] end
  end
  if #list < 2 then return nil, "there are no cues" end
  list[#list] = nil
  return { cues = list }
end

local function read_rhubarb_json(tree)
  local list = {}
  for i, cue in ipairs(tree.mouthCues) do
    if type(cue) ~= "table" or type(cue.start) ~= "number" or type(cue["end"]) ~= "number"
      or type(cue.value) ~= "string" then
      return nil, ("cue %d lacks start, end or value"):format(i)
    end
    list[i] = { cue.start, cue["end"], cue.value }
  end
  if #list == 0 then return nil, "there are no cues" end
  return { cues = list }
end

--- Papagayo-NG's .pgo 2: voices, phrases, words, phonemes.
local function read_pgo2(tree)
  local marks = {}
  local function walk(node, depth)
    for _, list in ipairs { "phrases", "words", "phonemes" } do
      for _, child in ipairs(type(node[list]) == "table" and node[list] or {}) do
        if type(child) == "table" and depth < 8 then
          if list == "phonemes" and type(child.frame) == "number" then
            marks[#marks + 1] = { math.floor(child.frame) + 1, tostring(child.text) }
          end
          walk(child, depth + 1)
          if list == "phrases" and type(child.end_frame) == "number" then
            marks[#marks + 1] = { math.floor(child.end_frame) + 2, "rest" } -- the mouth closes
          end
        end
      end
    end
  end
  local voice = tree.voices[1]
  if type(voice) ~= "table" then return nil, "there is no voice" end
  walk(voice, 0)
  if #marks == 0 then return nil, "there are no phonemes" end
  local duration = type(tree.sound_duration) == "number" and math.floor(tree.sound_duration) or nil
  return { marks = marks, count = duration, fps = tonumber(tree.fps) }
end

local function read_json(text)
  local tree, message = json.decode(text)
  if not tree then return nil, message end
  if type(tree) == "table" and type(tree.mouthCues) == "table" then
    return read_rhubarb_json(tree)
  end
  if type(tree) == "table" and type(tree.voices) == "table" then return read_pgo2(tree) end
  return nil, "it is neither Rhubarb's JSON (mouthCues) nor Papagayo's (voices)"
end

--- Rhubarb XML: only its mouthCue elements are read.
local function read_xml(text)
  local list = {}
  for attributes, shape in text:gmatch "<mouthCue%s([^>]*)>%s*(%w+)%s*</mouthCue>" do
    local start = tonumber(attributes:match 'start%s*=%s*"([^"]*)"')
    local stop = tonumber(attributes:match 'end%s*=%s*"([^"]*)"')
    if not start or not stop then
      return nil, ("mouthCue %d lacks start or end"):format(#list + 1)
    end
    list[#list + 1] = { start, stop, shape }
  end
  if #list == 0 then return nil, "there are no mouthCue elements" end
  return { cues = list }
end

--- Moho switch data: lines of the form "frame word" count; the last one closes the mouth.
local function read_dat(text)
  local marks = {}
  for line in text:gmatch "[^\r\n]+" do
    local frame, shape = line:match "^%s*(%d+)%s+(%S+)%s*$"
    if frame then marks[#marks + 1] = { tonumber(frame), shape } end
  end
  if #marks == 0 then return nil, "there are no lines \"frame shape\"" end
  return { marks = marks }
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
  local fps, count = tonumber(next_line()), tonumber(next_line())
  local voices = tonumber(next_line())
  if not fps or not count or not voices or voices < 1 then
    return nil, "its head lacks fps, duration or voices"
  end
  next_line() -- the voice's name
  next_line() -- its text
  local marks = {}
  for _ = 1, next_count() do
    at = at + 3 -- text, start, end
    local stop = tonumber(lines[at])
    for _ = 1, next_count() do
      local phonemes = tonumber(next_line():match "%d+$")
      if not phonemes then return nil, ("line %d is not a word"):format(at) end
      for _ = 1, phonemes do
        local frame, shape = next_line():match "^(%d+)%s+(%S+)$"
        if not frame then return nil, ("line %d is not \"frame phoneme\""):format(at) end
        marks[#marks + 1] = { tonumber(frame) + 1, shape } -- Papagayo counts from 0
      end
    end
    if stop then marks[#marks + 1] = { stop + 2, "rest" } end -- the mouth closes after the phrase
  end
  if #marks == 0 then return nil, "there are no phonemes" end
  return { marks = marks, count = count, fps = fps }
end

--- Returns `found`, unless its frame rate is invalid.
local function with_rate(found, message)
  local fps = found and found.fps
  if fps and not (fps > 0 and fps <= 1000) then
    return nil, ("its frame rate is %.14g: it must be above 0 and at most 1000"):format(fps)
  end
  return found, message
end

--- The format is detected from the text itself, so a wrong file extension does not matter.
---@param text string
---@return table? found
---@return string? message
function cues.read(text)
  local start = text:gsub("^\239\187\191", "")
  if start:find "^%s*{" then return with_rate(read_json(start)) end
  if start:find "^%s*<" then return read_xml(start) end
  if start:find "^lipsync version 1" then return with_rate(read_pgo1(start)) end
  if start:find "^MohoSwitch1" then return read_dat(start) end
  if start:find "^%s*%d+%.%d+%s" then return read_tsv(start) end
  if start:find "^%s*%d+%s+%S+" then return read_dat(start) end
  return nil, "it is not Rhubarb's TSV, JSON, XML or dat, Moho's dat, or Papagayo's pgo 1 or 2"
end

return cues
