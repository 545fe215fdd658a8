--- The writer of a folder NAME.ograf: a film as a graphic for broadcast, as OGraf 1 of EBU has it.
---
---   parameters: none --> film.plane, and the decoder of the player --\
---               some --> the script, its files, and celspan-web ------+--> graphic.mjs
---   marks, size, parameters -------------------------------------------+--> NAME.ograf.json
---
--- Marks are steps: ograf/graphic.js says what that means. The manifest comes last.
local program, request = ...

local json = require "celspan.json"

local SCHEMA = "https://ograf.ebu.io/v1/specification/json-schemas/graphics/schema.json"
local ENGINE = { "engine.mjs", "celspan.wasm", "more.json", "LICENSES" }
local BESIDE = { "celspan-web", "../share/celspan/web", "../out/web" } -- the program
local PICTURES = " png jpg jpeg webp gif tif tiff exr hdr bmp tga dpx psd kra ora mp4 mov webm "

local output = request.output
local folder = output:gsub("/+$", "")
local own = folder:match("([^/]+)%.[^./]*$") or "graphic"
program.refuse_target(output)
if request.frames then
  program.usage("%s: a graphic has all frames of the film: leave --frames out", output)
end
local script = program.script()
local schema = json.decode(script:ask("celspan.parameters", "schema", script.title or own))

--- The folder of celspan-web: as --engine says, or beside the program.
local function engine_folder()
  local place, home = request.engine, (program.resolve "/proc/self/exe" or ""):match "^.*/" or ""
  for i = 1, place and 0 or #BESIDE do
    if not place and program.entries(home .. BESIDE[i]) then place = home .. BESIDE[i] end
  end
  if place and program.sha256(place .. "/celspan.wasm") then return place end
  program.usage("%s: a graphic whose film has parameters contains celspan for web pages, which %s: "
    .. "give its folder with --engine DIR; ./run web makes one, and so does npm install "
    .. "celspan-web", output, place and "is not in " .. place or "was not found beside the program")
end

--- The path of a file without links in its folder, by which a script names the file.
local function absolute(path)
  local place, name = path:match "^(.*/)([^/]*)$"
  return (program.resolve(place or ".") or "") .. "/" .. (name or path)
end

--- Copies the files that the script asks for, in all frames, once all are found right. Returns
--- their places by their names, in which the script is at the top.
local function copy_files(base)
  local places = {}
  for number = script.first, script.first + script.frames - 1 do script:build(number) end
  for asked in script:files():gmatch "%+(%Z+)%z" do
    local path = absolute(asked)
    local name, ending = path:sub(#base + 1), path:lower():match "%.(%w+)$" or "/"
    if program.sha256(path) then
      if PICTURES:find(" " .. ending .. " ", 1, true) then
        program.usage("%s: celspan for web pages cannot read pictures: use a drawing (SVG)", asked)
      elseif not program.is_within(base, path) then
        program.usage("%s: a graphic contains files of the script's folder: copy it there", asked)
      end
      places[name] = "files" .. name
    end
  end
  for name, place in pairs(places) do
    program.save(folder .. "/" .. place, program.bytes(base .. name))
  end
  return places
end

local steps = {}
for i, mark in ipairs(script.marks) do steps[i] = mark.frame end
local film = { width = script.size[1], height = script.size[2], first = script.first,
  count = script.frames, fps = script.fps, steps = { list = steps } }

--- Each returns the part of graphic.mjs that draws.
local function save_plane()
  local path, numbers = folder .. "/film.plane", script:numbers()
  local target = script:target(path, #numbers)
  target.path, target.numbers = path, numbers
  function target.finished(_, failure) return failure ~= 0 and failure or nil end
  local code = program.flush(script:shoot(target))
  local decoder = program.text("decoder.js"):gsub("@MODULE@", program.text "plane.module")
  return decoder .. program.text "planes.js", code
end

local function save_engine()
  local place, path = engine_folder(), request[1]
  if program.kind(path) ~= "script" or path == "-" then
    program.usage("%s: a graphic with parameters is made of the file of a script", output)
  end
  local base, name = absolute(path):match "^(.*)/([^/]*)$"
  film.files = copy_files(base)
  film.files["/" .. name], film.script = "files/" .. name, name
  program.save(folder .. "/files/" .. name, program.bytes(path))
  for _, part in ipairs(ENGINE) do
    program.save(folder .. "/" .. part, program.bytes(place .. "/" .. part))
  end
  return program.text "engines.js", 0
end

-- The parameters as controllers show them: with the words of GDD (Graphics Data Definition).
for name, one in pairs(schema.properties) do
  one.title = name:gsub("_", " ")
  if one.format == "color" and one.default:find "^#%x%x%x%x%x%x$" then
    one.gddType, one.default = "color-rrggbb", one.default:lower()
  end
end

local has_engine = request.engine or next(schema.properties) ~= nil
if not has_engine and program.text "plane.module" == "none" then
  program.fail("input", "this celspan was built without clang and lld, which make the decoder of "
    .. "planes: give --engine DIR, or build it again with them")
end
if script.has_sound then program.note("%s: the sound of the film is left out", output) end
local artist, code = (has_engine and save_engine or save_plane)()
if code ~= 0 then return code end
local texts = { VERSION = program.version, ARTIST = artist, FILM = program.json(film) }
program.save(folder .. "/graphic.mjs", (program.text("graphic.js"):gsub("@(%u+)@", texts)))
program.save(("%s/%s.ograf.json"):format(folder, own), program.json {
  ["$schema"] = SCHEMA, id = own, name = script.title or own, main = "graphic.mjs",
  schema = { type = "object", properties = schema.properties }, stepCount = #script.marks,
  supportsRealTime = true, supportsNonRealTime = true,
} .. "\n")
