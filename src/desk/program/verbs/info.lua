--- celspan info SCRIPT|FILE: facts about a film, a picture, a movie, artwork, a span file or a
--- plane, one "name value" a line. The content of the file decides which of these it is.
local program, request = ...
local json = require "celspan.json"

local DIFFERENT_MOST = 1 << 19 -- different scenes that are counted, in some 40 MB
local NAMES_MOST = 1000

local path = request[1]
local facts = program.part("facts.lua", program, request)

-- ---------------------------------------------------------------- films

--- Adds the names of a frame's values: one entry for each kind of value that has a name, in the
--- order of the scene.
local function add_names(script, names, frame)
  script:names(function(kind, name, source, line)
    local key = kind .. " " .. name
    local entry = names[key]
    if not entry and #names == NAMES_MOST then
      names.has_more = true
      return
    end
    if not entry then
      entry = { kind = kind, name = name, frames = 0, file = source, line = source and line }
      names[key], names[#names + 1] = entry, entry
    end
    if names.last[key] ~= frame then
      entry.frames, names.last[key] = entry.frames + 1, frame
    end
  end)
end

--- Counts the frames that are not equal to one before.
local function count_scene(script, total)
  local scene = script:scene()
  if scene and total.scenes[scene] then return end
  if scene and total.kept == DIFFERENT_MOST then
    total.is_least = true
    return
  end
  total.different = total.different + 1
  if scene then total.scenes[scene], total.kept = true, total.kept + 1 end
end

local function count_film(script)
  local total = { scenes = {}, kept = 0, different = 0, names = { last = {} }, most = { 0, 0, 0 } }
  for number = script.first, script.first + script.frames - 1 do
    script:build(number)
    add_names(script, total.names, number)
    count_scene(script, total)
    for i, count in ipairs { script:counts() } do total.most[i] = math.max(total.most[i], count) end
  end
  return total
end

--- For a film: the facts that it gives.
local function put_film(script)
  if script.title then facts:add("title", script.title) end
  facts:add("frames", script.frames)
  facts:add("first", script.first)
  facts:add("last", script.first + script.frames - 1)
  facts:add("fps", script.fps)
  facts:add("seconds", script.frames / script.fps)
  facts:add("size", script.size)
  facts:lists("marks", "named")
  for _, mark in ipairs(script.marks) do
    facts:item("marks", mark, "mark %d %s", mark.frame, mark.name)
  end
end

--- For a film: the contents of its frames.
local function put_count(total)
  for i, name in ipairs { "cels", "primitives", "pictures" } do facts:add(name, total.most[i]) end
  facts:add(total.is_least and "different_at_least" or "different", total.different)
  for _, entry in ipairs(total.names) do
    facts:item("named", entry, "named %s %d %s%s", entry.kind, entry.frames, entry.name,
      entry.file and (" (%s:%d)"):format(entry.file, entry.line) or "")
  end
  if total.names.has_more then
    facts:set("named_more", true)
    facts:line "named more"
  end
end

--- For a Lottie animation: what it has beside its frames.
local function put_animation()
  local art = program.input(require "celspan.lottie".read(path))
  facts:add("format", "lottie")
  facts:lists("themes", "states", "skipped")
  for _, name in ipairs(art.themes) do facts:item("themes", name, "theme %s", name) end
  for _, name in ipairs(art.states) do facts:item("states", name, "state machine %s", name) end
  for _, line in ipairs(art.skipped) do facts:item("skipped", line, "skipped %s", line) end
end

local function describe_film(kind)
  local script = program.script()
  local schema = script:ask("celspan.parameters", "schema", script.title or path:match "[^/]*$")
  if request.parameters and request.json then
    io.write(schema)
    return
  end
  if not request.json then io.write((script:ask("celspan.parameters", "lines", ""))) end
  if request.parameters then return end
  facts:set("parameters", json.decode(schema).properties)
  local total = count_film(script)
  put_film(script)
  if kind == "lottie" then put_animation() end
  put_count(total)
  facts:finish()
end

-- ---------------------------------------------------------------- pictures, spans, planes

--- What the numbers of a picture mean, and whether the file says so or files of its kind.
local function put_meaning(picture)
  facts:add("colour", picture.colour)
  facts:add("colour_from", picture.named and "file" or "format")
  if picture.space then facts:add("space", picture.space) end
  if picture.profile then
    facts:add("profile", picture.profile)
    facts:add("primaries_taken", "bt709")
  end
  if picture.primaries then facts:add("primaries", picture.primaries) end
  local numbers = picture.chromaticities
  if not numbers then return end
  facts:set("chromaticities", numbers)
  facts:line(("chromaticities" .. (" %.7g"):rep(#numbers)):format(table.unpack(numbers)))
end

local function put_picture()
  local picture = program.picture(path)
  local depth, subimages = "", 0
  for _, part in ipairs(picture.parts) do
    if part.subimage == 0 then depth = part.depth end
    if part.subimage then subimages = subimages + 1 end
  end
  facts:add("format", picture.format)
  facts:add("size", { picture.width, picture.height })
  facts:add("channels", picture.channels)
  facts:add("alpha", picture.alpha or "none")
  facts:add("depth", depth)
  put_meaning(picture)
  facts:add("bytes", picture.bytes)
  facts:add("subimages", subimages)
  facts:lists "parts"
  for _, part in ipairs(picture.parts) do
    local name = part.name == "" and "" or " " .. part.name
    if part.subimage then
      facts:item("parts", part, "subimage %d size %dx%d channels %d depth %s%s", part.subimage,
        part.width, part.height, part.channels, part.depth, name == "" and "" or " layer" .. name)
    else
      facts:item("parts", part, "layer%s channels %d", name, part.channels)
    end
  end
end

local function put_spans()
  local spans = program.spans(path)
  facts:add("format", "span")
  facts:add("size", { spans.width, spans.height })
  for _, name in ipairs { "depth", "bytes", "rows_same", "rows_moved", "rows_literal", "runs",
                          "raw_spans", "gradients" } do
    facts:add(name, spans[name])
  end
end

local function put_plane()
  local plane = program.plane(path)
  facts:add("format", "plane")
  facts:add("size", { plane.width, plane.height })
  facts:add("alpha", plane.opaque and "none" or "premultiplied")
  facts:add("bytes", plane.bytes)
  if plane.fps > 0 then
    facts:add("frames", plane.frames)
    facts:add("fps", plane.fps)
    facts:add("seconds", plane.frames / plane.fps)
  end
  for _, name in ipairs { "bands", "borders", "curves", "colours", "gradients", "pictures" } do
    facts:add(name, plane[name])
  end
  if plane.planes > 0 then
    facts:add("windows", plane.windows)
    facts:add("planes", plane.planes)
  end
end

-- ---------------------------------------------------------------- artwork

local function put_place(one)
  return (" size %.9gx%.9g at %.9g,%.9g"):format(one.size[1], one.size[2], one.at[1], one.at[2])
end

local function put_painting(found)
  if found.canvas then facts:add("canvas", found.canvas) end
  facts:add("layers", found.layers)
  facts:add("groups", found.groups)
  facts:lists("entries", "skipped")
  for _, one in ipairs(found.entries) do
    facts:item("entries", one, "%s%s blend %s opacity %.9g visible %s name %s", one.kind,
      one.size and put_place(one) or "", one.blend, one.opacity, one.visible and "yes" or "no",
      one.name)
  end
  for _, note in ipairs(found.skipped) do
    facts:item("skipped", note, "skipped %s: %s", note.layer, note.what)
  end
end

local function describe_painting(format)
  local found = program.input(program.part "inform.lua".painting(path))
  facts:add("format", format)
  put_painting(found)
end

--- The elements of a drawing with their numbers, one on each line, and their sheet.
local function show_parts(output)
  local art = program.input(require "celspan.svg".read(path))
  program.refuse_target(output)
  facts:lists "elements"
  for _, element in ipairs(art:elements()) do
    local one, words = { name = element.name, line = element.line, tag = element.tag }, {}
    for _, field in ipairs { "id", "class", "fill" } do
      one[field] = element[field]
      if element[field] then words[#words + 1] = (" %s %s"):format(field, element[field]) end
    end
    facts:item("elements", one, "element %s line %d %s%s", one.name, one.line, one.tag,
      table.concat(words))
  end
  program.part("parts.lua", program, art, output)
end

local function put_drawing()
  local found = program.input(program.part "inform.lua".drawing(path))
  facts:add("format", "svg")
  facts:add("size", found.size)
  if found.seconds then facts:add("seconds", found.seconds) end
  facts:add("parts", found.parts)
  facts:lists("entries", "skipped")
  for _, one in ipairs(found.entries) do
    facts:item("entries", one, "part%s name %s", put_place(one), one.name)
  end
  for _, note in ipairs(found.skipped) do
    facts:item("skipped", note, "skipped line %d: %s", note.line, note.what)
  end
  if request.parts_picture then show_parts(request.parts_picture) end
end

--- A Photoshop document is a picture, whose subimages `layer` can name, and also a painting, which
--- has more contents.
local function put_psd()
  put_picture()
  local found, message = program.part "inform.lua".painting(path)
  if found then return put_painting(found) end
  facts:set("layers_unread", message)
  facts:line("layers unread: %s", message)
end

-- ---------------------------------------------------------------- movies

--- What the file says of its colours, and what celspan takes them for: the primaries are not
--- converted.
local function put_colours(movie)
  local function said(name)
    local word = movie[name]
    return word ~= "" and word ~= "unspecified" and word or "unknown"
  end
  facts:add("colour", movie.high and "none" or "srgb")
  for _, name in ipairs { "primaries", "transfer", "matrix", "range" } do
    facts:add(name, said(name))
  end
  facts:add("primaries_taken", "bt709")
  facts:add("matrix_taken", movie.matrix_taken)
  facts:add("range_taken", movie.range_taken)
end

local function put_movie()
  local movie = program.input(require "celspan.footage".describe(path))
  facts:add("format", movie.container)
  facts:add("codec", movie.codec)
  facts:add("size", movie.size)
  facts:add("fps", movie.fps)
  facts:add("frames", movie.count)
  facts:add("seconds", movie.finish)
  facts:add("alpha", movie.alpha and "straight" or "none")
  facts:add("depth", movie.bits)
  facts:add("pixels", movie.pixels)
  put_colours(movie)
  facts:add("sound", movie.sound and "yes" or "no")
  facts:add("bytes", movie.bytes)
end

local put = {
  picture = put_picture,
  movie = put_movie,
  span = put_spans,
  plane = put_plane,
  archive = function() describe_painting "painting" end,
  folder = function() describe_painting "folder" end,
  svg = put_drawing,
  psd = put_psd,
}

local kind = program.kind(path)
if kind == "picture" and program.is_movie(path) then kind = "movie" end
local is_film = kind == "script" or kind == "lottie" or kind == "files"
if not is_film and request.parameters then
  program.usage("--parameters is for scripts: %s is not a script", path)
end
if request.parts_picture and kind ~= "svg" then
  program.usage("--parts-picture is for SVG drawings: %s is not one", path)
end
if is_film then return describe_film(kind) end
program.refuse_rights()
put[kind]()
facts:finish()
