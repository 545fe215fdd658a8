--- celspan sound SCRIPT -o mix.wav: the mixed sound of a film, or of a run of its frames.
---
---   --stems -o mix.{name}.wav   mix.voice.wav, mix.music.wav, mix.rest.wav: they add up to the mix
local program, request = ...

local PLACE = "{name}" -- stands for the name of a stem

local output, depth = request.output, request.depth or "16"
if not output then program.usage "-o is missing: the file to write, such as mix.wav" end
if not program.has_ending(output, ".wav") then
  program.usage("%s: a sound is written as WAV: give a name such as mix.wav", output)
end
if depth ~= "16" and depth ~= "float" then
  program.usage("%s: a sound takes --depth 16 or float", output)
end
if request.keep_going then
  program.usage "--keep-going is about the rows of a table: give --table, or leave it out"
end
if request.stems and not output:find(PLACE, 1, true) then
  program.usage("%s: --stems writes several files: put %s into the name, as in mix.%s.wav", output,
    PLACE, PLACE)
end
if request.stems and request.resume then
  program.usage "--stems and --resume exclude each other: give one of them"
end
local script = program.script()
if not script.has_sound then program.usage("%s: the film has no sound", request[1]) end
local numbers = script:numbers()

--- Writes a file of the whole sound, or of a stem. gain: of --loudness, if it is known. Returns the
--- gain, the bytes of the file and their hash.
local function write(path, stem, gain)
  program.sweep(path)
  local peak, found, bytes, contents = script:write_sound { path = path, numbers = numbers,
    stem = stem, gain = gain, depth = depth }
  if peak > 1 then
    program.note("%s: the mix is up to %.1f dB louder than full scale%s: lower the gain of its "
      .. "sounds", path, 20 * math.log(peak, 10), depth == "float" and "" or ", and cut there")
  end
  return found, bytes, contents
end

--- The name of the file of a stem.
local function path_of(stem)
  if stem == "" or stem:find "/" or stem == ".." then
    program.usage("--stems: the sound '%s' needs a name without / for its file", stem)
  end
  local before, after = output:match "^(.-){name}(.*)$"
  local path = before .. stem .. after
  if #path > program.path_most then
    program.usage("%s: the name of the stem '%s' would be too long", output, stem)
  end
  return path
end

local function write_stems()
  local stems, paths, gain = script:stems(), {}, nil
  for _, stem in ipairs(stems) do paths[stem] = path_of(stem) end
  for _, stem in ipairs(stems) do
    if paths[stem] then gain = write(paths[stem], stem, gain) end
    paths[stem] = nil
  end
end

--- Writes the sound, unless an earlier run with --resume has written the same. Returns how.
local function resume()
  local record = program.part("record.lua", program, request, script, script:key(false))
  record.begin_whole(numbers)
  if record.keeps_whole() then return "kept" end
  local _, bytes, contents = write(output)
  local good, message = record.add_whole(bytes, contents)
  if not good then program.fail("output", "%s", message) end
  return "made"
end

program.count_frames(1, false, "sound")
local how = "made"
if request.resume then
  how = resume()
elseif request.stems then
  write_stems()
else
  write(output)
end
program.made_frame(1, output, how)
