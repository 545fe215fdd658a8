--- celspan info SCRIPT|FILE: a film, a picture, artwork, a span file or a plane in figures, one
--- "name value" a line. The content of the file decides which of them it is.
local program, request = ...

local DIFFERENT_MOST = 1 << 19 -- different scenes that are counted, in some 40 MB
local NAMES_MOST = 1000

local path = request[1]

local function put(format, ...) io.write(format:format(...), "\n") end

-- ---------------------------------------------------------------- films

--- Adds the names of a frame's values: one entry for each kind of value that has a name, in the
--- order of the scene.
local function add_names(film, names, frame)
  film:names(function(kind, name, source, line)
    local key = kind .. " " .. name
    local entry = names[key]
    if not entry and #names == NAMES_MOST then
      names.has_more = true
      return
    end
    if not entry then
      entry = { kind = kind, name = name, frames = 0,
                place = source and (" (%s:%d)"):format(source, line) or "" }
      names[key], names[#names + 1] = entry, entry
    end
    if entry.last ~= frame then entry.frames, entry.last = entry.frames + 1, frame end
  end)
end

--- Counts the frames that are not equal to one before.
local function count_scene(film, total)
  local scene = film:scene()
  if scene and total.scenes[scene] then return end
  if scene and total.kept == DIFFERENT_MOST then
    total.is_least = true
    return
  end
  total.different = total.different + 1
  if scene then total.scenes[scene], total.kept = true, total.kept + 1 end
end

local function count_film(film)
  local total = { scenes = {}, kept = 0, different = 0, names = {}, most = { 0, 0, 0 } }
  for number = film.first, film.first + film.frames - 1 do
    film:build(number)
    add_names(film, total.names, number)
    count_scene(film, total)
    for i, count in ipairs { film:counts() } do total.most[i] = math.max(total.most[i], count) end
  end
  return total
end

local function describe_film()
  local film = program.film()
  if request.json then
    io.write((film:ask("celspan.parameters", "schema", film.title or path:match "[^/]*$")))
    return
  end
  io.write((film:ask("celspan.parameters", "lines", "")))
  if request.parameters then return end
  local total = count_film(film)
  if film.title then put("title %s", film.title) end
  put("frames %d\nfirst %d\nlast %d", film.frames, film.first, film.first + film.frames - 1)
  put("fps %.9g\nseconds %.9g", film.fps, film.frames / film.fps)
  put("size %dx%d", table.unpack(film.size))
  for _, mark in ipairs(film.marks) do put("mark %d %s", mark.frame, mark.name) end
  put("cels %d\nprimitives %d\npictures %d", table.unpack(total.most))
  put("different%s %d", total.is_least and "_at_least" or "", total.different)
  for _, entry in ipairs(total.names) do
    put("named %s %d %s%s", entry.kind, entry.frames, entry.name, entry.place)
  end
  if total.names.has_more then put "named more" end
end

-- ---------------------------------------------------------------- files

--- Names come from the file: what could end a line is shown as a space.
local function plain(text) return (text:gsub("[%c\127]", " ")) end

local function describe_picture()
  local picture = program.picture(path)
  local depth, subimages, lines = "", 0, {}
  for i, part in ipairs(picture.parts) do
    local name = part.name == "" and "" or " " .. plain(part.name)
    if part.subimage == 0 then depth = part.depth end
    if part.subimage then
      subimages = subimages + 1
      lines[i] = ("subimage %d size %dx%d channels %d depth %s%s\n"):format(part.subimage,
        part.width, part.height, part.channels, part.depth, name == "" and "" or " layer" .. name)
    else
      lines[i] = ("layer%s channels %d\n"):format(name, part.channels)
    end
  end
  put("format %s\nsize %dx%d\nchannels %d\nalpha %s\ndepth %s\ncolour %s\nbytes %d\nsubimages %d",
    picture.format, picture.width, picture.height, picture.channels, picture.alpha or "none", depth,
    picture.colour, picture.bytes, subimages)
  io.write(table.concat(lines))
end

local function describe_spans()
  local spans = program.spans(path)
  put("format span\nsize %dx%d\ndepth %s\nbytes %d", spans.width, spans.height, spans.depth,
    spans.bytes)
  local counts = { "rows_same", "rows_moved", "rows_literal", "runs", "raw_spans", "gradients" }
  for _, name in ipairs(counts) do put("%s %d", name, spans[name]) end
end

local function describe_plane()
  local plane = program.plane(path)
  put("format plane\nsize %.9gx%.9g\nalpha %s\nbytes %d", plane.width, plane.height,
    plane.opaque and "none" or "premultiplied", plane.bytes)
  if plane.fps > 0 then
    put("frames %d\nfps %.9g\nseconds %.9g", plane.frames, plane.fps, plane.frames / plane.fps)
  end
  for _, name in ipairs { "bands", "borders", "curves", "colours", "gradients", "pictures" } do
    put("%s %d", name, plane[name])
  end
end

local function describe_painting(format)
  local text = program.input(program.part "inform.lua".painting(path))
  io.write("format ", format, "\n", text)
end

--- The elements of a drawing with their numbers, one a line, and their sheet.
local function show_parts(output)
  local art = program.input(require "celspan.svg".read(path))
  program.refuse_target(output)
  for _, element in ipairs(art:elements()) do
    local words = {}
    for _, field in ipairs { "id", "class", "fill" } do
      if element[field] then words[#words + 1] = (" %s %s"):format(field, plain(element[field])) end
    end
    put("element %s line %d %s%s", element.name, element.line, plain(element.tag),
      table.concat(words))
  end
  program.part("parts.lua", program, art, output)
end

local function describe_drawing()
  io.write((program.input(program.part "inform.lua".drawing(path))))
  if request.parts_picture then show_parts(request.parts_picture) end
end

local describe = {
  script = describe_film,
  picture = describe_picture,
  span = describe_spans,
  plane = describe_plane,
  archive = function() describe_painting "painting" end,
  folder = function() describe_painting "folder" end,
  svg = describe_drawing,
  --- A Photoshop document is a picture with subimages for `layer`, and a painting with more in it.
  psd = function()
    describe_picture()
    local text, message = program.part "inform.lua".painting(path)
    io.write((program.input(text, message, ("layers unread: %s\n"):format(message))))
  end,
}

local kind = program.kind(path)
if request.json and not request.parameters then program.usage("--json goes with --parameters") end
if kind ~= "script" and request.parameters then
  program.usage("--parameters is for scripts: %s is not a script", path)
end
if request.parts_picture and kind ~= "svg" then
  program.usage("--parts-picture is for SVG drawings: %s is not one", path)
end
if kind ~= "script" then program.refuse_rights() end
describe[kind]()
