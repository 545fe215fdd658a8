--- The writer of film.json and film.lottie: a film as a Lottie animation, for players in pages and
--- applications.
---
---   frames --native.scenery--> structures --tracks--> what moves, and what changes --> layers
---      \--what players cannot say--> pictures
local program, request = ...

local native = require "celspan.native"
local json = require "celspan.json"

local FRAMES_MOST = 100000
local LAYERS_SMOOTH = 1000
local text = program.part("compact.lua")
local keys = program.part("keyed.lua", text)
local tracks = program.part("tracked.lua")
local bake = program.part("baked.lua", program)

program.refuse_target(request.output)
local script = program.script()
local numbers = script:numbers()
if #numbers > FRAMES_MOST then
  program.fail("limit", "%s: %d frames; a Lottie file of at most %d is written: choose some with "
    .. "--frames", request.output, #numbers, FRAMES_MOST)
end
local shapes = program.part("outlined.lua", text, keys,
  program.part("painted.lua", text, script.space == "srgb"))
local layers = program.part("layered.lua", program, text, keys, shapes, tracks)(
  { size = script.size, count = #numbers }, request.output)

-- ---------------------------------------------------------------- frames

--- Fronts that are alike as one table, so that a table is known again.
local fronts = {}
local function front_of(front)
  local name = ("%.9g %.9g %.9g"):format(table.unpack(front))
  fronts[name] = fronts[name] or front
  return fronts[name]
end

local shared, frames, before = {}, {}, nil
local pictures = bake.new { script = script, layers = layers, shapes = shapes, keys = keys,
  pool = program.part("pooled.lua", layers), path = request.output, numbers = numbers }
for i, number in ipairs(numbers) do
  local exposures = script:at(number)
  local scene = script:scene()
  if not (before and scene and scene == before) then
    local structure = #exposures == 1 and exposures[1][2] == 1
      and native.scenery(exposures[1][1], script.size[1], script.size[2], script.space, shared)
      or { why = "a sum of exposures" }
    for _, cel in ipairs(structure) do cel.front = front_of(cel.front) end
    frames[i] = pictures:divide(structure, exposures, i)
  else
    frames[i] = pictures:again(i)
  end
  before = scene
end

-- ---------------------------------------------------------------- layers

--- The ground of the film, as an item that fills the frame.
local function ground_of(back)
  local w, h = table.unpack(script.size)
  local data = { kind = "outline", rule = "nonzero",
    contours = { { 0, 0, 0, 0, w, 0, w, 0, w, 0, w, h, w, h, w, h, 0, h, 0, h, 0, h, 0, 0, 0, 0 } },
    fill = { kind = "flat", stops = { { 0, 1, 1, 1, 1 } } } }
  return { name = "ground", line = 0, matrix = { 1, 0, 0, 0, 1, 0 }, fade = 1,
           front = front_of(back), data = data }
end

local grounds, lists = {}, {}
for i, frame in ipairs(frames) do
  local list = {}
  if frame.back then
    local front = front_of(frame.back)
    grounds[front] = grounds[front] or ground_of(front)
    list[1] = tracks.item(grounds[front], nil, 1)
  end
  for _, cel in ipairs(frame) do list[#list + 1] = tracks.item(cel, nil, 1) end
  lists[i] = list
end
pictures:add_layers()
for _, track in ipairs(tracks.align(lists, #numbers)) do layers:add(layers.main, track) end

-- ---------------------------------------------------------------- the file

--- The marks of the frames that are written.
local function markers()
  local places, list = {}, {}
  for i, number in ipairs(numbers) do places[number] = i - 1 end
  for _, mark in ipairs(script.marks) do
    local place = places[mark.frame]
    if place then list[#list + 1] = { place, mark.name } end
  end
  return list
end

pictures:report()
if layers:count() > LAYERS_SMOOTH then
  program.note("%s: %d layers, more than many players draw smoothly: put objects that stay in "
    .. "place into one group, which is one layer", request.output, layers:count())
end
if script.has_sound then program.note("%s: the sound of the film is left out", request.output) end
local document = text.encode(layers:document(script, markers()))
if #document > json.most_bytes then
  program.note("%s: more than %d MiB, which celspan.lottie does not read again", request.output,
    json.most_bytes >> 20)
end
if not pictures.is_archive then return program.save(request.output, document) end
local manifest = text.encode { version = "2", generator = "celspan " .. program.version,
  animations = { { id = "film" } } }
program.save_archive(request.output, { { "manifest.json", manifest },
  { "a/film.json", document }, table.unpack(pictures.members) })
