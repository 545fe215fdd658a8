--- What a film adds to its sheet on paper: its marks, its captions as dialogue, and its camera.
local program, script, numbers = ...

local places = {} -- of the frames on the sheet, by number
local count = numbers and #numbers or script.frames
for i = 1, count do places[numbers and numbers[i] or script.first + i - 1] = i end

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

local function seconds_of(h, m, s, parts) return h * 3600 + m * 60 + s + parts / 1000 end

--- Adds captions of SRT. A caption begins and ends at the frame that is nearest.
local function add_dialogue()
  local time = "(%d+):(%d+):(%d+),(%d+)"
  for a, b, c, d, e, f, g, h, text in
    (script:captions() .. "\n\n"):gmatch(time .. " %-%-> " .. time .. "[^\n]*\n(.-)\n\n") do
    local first = script.first + math.floor(seconds_of(a, b, c, d) * script.fps + 0.5)
    local last = script.first + math.floor(seconds_of(e, f, g, h) * script.fps + 0.5) - 1
    if places[first] and places[last] and places[first] <= places[last] then
      add("dialogue", places[first], places[last], (text:gsub("<[^>]*>", "")))
    end
  end
end

--- What the camera does between two frames: "PAN + ZOOM"; "": nothing.
local function move_of(before, after)
  local words = {}
  local function compare(word, ...)
    for _, name in ipairs { ... } do
      if before[name] ~= after[name] then
        words[#words + 1] = word
        return
      end
    end
  end
  compare("PAN", "x", "y")
  compare("ZOOM", "width")
  compare("TURN", "turn")
  return table.concat(words, " + ")
end

--- Adds a note for each run of frames with the same move.
local function add_camera()
  local run, before
  for place = 1, count do
    local number = numbers and numbers[place] or script.first + place - 1
    local now = program.camera(script, number) or {}
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
