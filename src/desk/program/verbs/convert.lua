--- celspan convert IN OUT: converts a picture to another format, a drawing or a layered painting to
--- a picture, and numbered pictures or a movie to a video or other pictures.
---
---   frames.####.png --celspan render--> film.mp4      the pictures are a film (artwork.lua)
---   film.lua --celspan sound--> .film.mp4.sound.wav --^
---            --its captions--> .film.mp4.captions.srt -^
---
--- If a run is killed, these files remain; the next run replaces and removes them.
local program, request = ...

local ONLY_VIDEO = { "quality", "codec", "max_size", "crf", "loop", "loudness", "fps", "sound",
                     "background", "progress" }
local NAME_MOST = 255 -- bytes of a file's name
local RIGHTS = { ["--trust"] = true, ["--limit"] = true }
local HAS_OUTLINES = { archive = true, svg = true, plane = true } -- kinds of inputs
local OWN = { ["--fps"] = true, ["--sound"] = true, ["--frame"] = true }

--- Runs this program, whose messages are shown. Returns its exit code.
local function run(words)
  local process, message = program.start(words, io.stderr)
  if not process then program.fail("output", "celspan cannot be started: %s", message) end
  local _, code = program.wait()
  return code or 1
end

--- Frames per second, as a number in digits.
local function rate()
  local above, below = request.fps:match "^(.*)/(.*)$"
  return ("%.17g"):format((above or request.fps) / (below or 1))
end

--- The name of a file beside the output.
local function beside(output, ending)
  local folder, base = output:match "^(.-)([^/]*)$"
  return folder .. "." .. base:sub(1, NAME_MOST - 1 - #ending) .. ending
end

--- Writes the sound of a script to a file beside the output. Returns its name, or nil and the exit
--- code.
local function mix(script, output)
  local name = beside(output, ".sound.wav")
  local words = { "sound", script, "-o", name, "--progress", "none" }
  for _, option in ipairs(request.given) do
    if RIGHTS[option.name] then
      table.move({ option.name, option.value }, 1, 2, #words + 1, words)
    end
  end
  local code = run(words)
  if code == 0 and not program.is_stopped() then return name end
  os.remove(name)
  return nil, code
end

--- Adds the settings that give the pictures the title, the marks, the poster and the captions of a
--- script, whose first frame is the first picture. Returns the name of a file that was written for
--- them, or nil.
local function carry(path, output, settings)
  local script = program.script(path, true)
  local marks, text, name = {}, script:captions(), beside(output, ".captions.srt")
  local function add(key, value) settings[#settings + 1] = { key, value } end
  for i, mark in ipairs(script.marks) do marks[i] = { mark.name, mark.frame - script.first + 1 } end
  if script.title then add("title", script.title) end
  if #marks > 0 then add("marks", require "celspan.json".encode(marks)) end
  if script.has_poster then add("poster", tostring(script.poster - script.first + 1)) end
  if text == "" then return nil end
  local file, message = io.open(name, "w")
  if not file or not file:write(text) or not file:close() then
    program.fail("output", "%s", message or name .. ": cannot be written")
  end
  add("captions", program.resolve(name))
  return name
end

--- Makes the output of a film of pictures; returns the exit code.
local function render(input, output)
  local words, settings = { "render", input, "-o", output }, {}
  local function add(...) table.move({ ... }, 1, select("#", ...), #words + 1, words) end
  local sound, made, written, code = request.sound
  if request.frame then add("--frames", request.frame) end
  if request.fps then settings[1] = { "fps", rate() } end
  if sound and program.kind(sound) == "script" then
    made, code = mix(sound, output)
    if not made then return code end
    written = carry(sound, output, settings)
    sound = made
  end
  if sound then
    sound = program.resolve(sound)
    settings[#settings + 1] = { "sound", sound }
    if not request.trust then add("--allow", sound:match "^(.*/)") end
  end
  code = run(program.pass_on(words, request, OWN, settings))
  for _, name in pairs { made, written } do os.remove(name) end
  return code
end

local kind = program.kind(request[1])
local is_files = kind == "files"
if program.output(request[2]) == "drawings" and not HAS_OUTLINES[kind] then
  program.usage("%s: a drawing is made of a script or a drawing or a plane, not of a picture",
    request[2])
end
if is_files or kind == "picture" and program.is_movie(request[1]) then
  if request.fps and not is_files then
    program.usage("--fps is the rate of numbered pictures, and %s has its own", request[1])
  end
  if request[1] == request[2] then
    program.usage("the output would replace the pictures while they are read: give another name")
  end
  return render(request[1], request[2])
end
if program.has_number(request[1]) then
  local file, message = io.open(request[1])
  if not file then program.fail("input", "%s", message) end
  file:close()
end
for _, name in ipairs(ONLY_VIDEO) do
  if request[name] then
    program.usage("--%s is for numbered pictures or a movie", (name:gsub("_", "-")))
  end
end
if program.output(request[2]) == "videos" then
  program.usage("%s: a video is made of numbered pictures or a movie, or by 'celspan render'",
    request[2])
end
if program.has_number(request[2]) then
  program.usage("%s: one picture is written, so its name has no place for a number", request[2])
end
program.refuse_target(request[2])
if kind == "plane" then program.refuse_self(request[1], request[2]) end
if program.output(request[2]) == "planes" and not program.is_film(request[1]) then
  program.usage("%s: a plane is made of a script or a drawing, not of a picture", request[2])
end
program.shown(request[1]):write(request[2])
