--- What a film adds to its sheet on paper: its marks, its captions as dialogue, and its camera.
local program, script, numbers = ...
local captions = require "celspan.captions"

local places = {} -- of the frames on the sheet, by number
local count = numbers and #numbers or script.frames
local function number_at(place) return numbers and numbers[place] or script.first + place - 1 end
for place = 1, count do places[number_at(place)] = place end

local notes = {}
local function add(kind, from, to, text)
  notes[#notes + 1] = { kind = kind, from = from, to = to, text = text }
end

local function add_marks()
  for _, mark in ipairs(script.marks) do
    local place = places[mark.frame]
    if place then add("mark", place, place, mark.name) end
  end
end

--- Adds the captions. A caption begins and ends at the frame that is nearest.
local function add_dialogue()
  for _, caption in ipairs(program.check(captions.decode(script:captions()))) do
    local from = places[script.first + math.floor(caption.from * script.fps + 0.5)]
    local to = places[script.first + math.floor(caption.to * script.fps + 0.5) - 1]
    if from and to and from <= to then add("dialogue", from, to, caption.text) end
  end
end

local MOVES = { { "PAN", "x", "y" }, { "ZOOM", "width", "width" }, { "TURN", "turn", "turn" } }

--- What the camera does between two frames: "PAN + ZOOM"; "": nothing.
local function move_of(before, after)
  local words = {}
  for _, move in ipairs(MOVES) do
    local is_moved = before[move[2]] ~= after[move[2]] or before[move[3]] ~= after[move[3]]
    if is_moved then words[#words + 1] = move[1] end
  end
  return table.concat(words, " + ")
end

--- Adds a note for each run of frames with the same move.
local function add_camera()
  local run, before
  for place = 1, count do
    local now = program.camera(script, number_at(place)) or {}
    local move = before and move_of(before, now) or ""
    if run and run.text == move then
      run.to = place
    elseif move ~= "" then
      add("camera", run and place or place - 1, place, move)
      run = notes[#notes]
    else
      run = nil
    end
    before = now
  end
end

add_marks()
add_dialogue()
add_camera()
return notes
