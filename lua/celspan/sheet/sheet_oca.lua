--- The exposures of an OCA document: which drawing each layer shows at each frame.
--
-- A drawing lasts for its duration, and then the layer is empty until the next one begins; a layer
-- that is not animated shows its first drawing throughout. Drawings have the same names as in
-- layers.read, and layers are named by their paths, "group/layer".
local columns = require "celspan.columns"
local fields = require "celspan.fields"
local values = require "celspan.values"

local sheet_oca = {}

local get = values.get

--- A number of frames; some programs write it as a float.
local function frame_of(object, where, name, default, least)
  local number = values.number(object, where, name, least or -columns.most_frames,
    columns.most_frames, default)
  return math.tointeger(math.floor(number + 0.5))
end

--- The name of a drawing, or false for an empty one.
function sheet_oca.drawing(frame, where)
  local name = get(frame, where, "name", "string", "")
  local file = get(frame, where, "fileName", "string", "")
  if file == "" or name == "_blank" then return false end
  if name ~= "" then return name end
  return file:gsub("\\", "/"):match "[^/]*$":gsub("%.%w+$", "")
end

--- Each frame of a layer, and where it is.
function sheet_oca.frames(layer, where)
  return values.each(layer, where, "frames", {}, "frame %d: ")
end

--- Each layer of a group or of the document, and where it is.
function sheet_oca.layers(group, where, name)
  return values.each(group, where, name, {}, "layer %d: ")
end

--- Whether a layer is a group, is shown, and its opacity.
function sheet_oca.look(layer, where)
  return get(layer, where, "type", "string", "paintlayer") == "grouplayer",
    get(layer, where, "visible", "boolean", true)
      and not get(layer, where, "reference", "boolean", false),
    values.number(layer, where, "opacity", 0, 1, 1)
end

--- Reads the frames of a layer into a column. start: the first frame of the document.
function sheet_oca.expose(column, layer, where, start)
  local list = {}
  for frame, here in sheet_oca.frames(layer, where) do
    list[#list + 1] = { frame = frame_of(frame, here, "frameNumber", 0) - start + 1,
      length = frame_of(frame, here, "duration", 1, 0), name = sheet_oca.drawing(frame, here) }
  end
  columns.sort(list)
  if not get(layer, where, "animated", "boolean", true) then
    if list[1] then columns.add(column, 1, list[1].name) end
    return
  end
  for i, entry in ipairs(list) do
    local stop, following = entry.frame + entry.length, list[i + 1]
    if stop > 1 and entry.length > 0 then
      columns.add(column, math.max(1, entry.frame), entry.name)
      if not following or following.frame > stop then columns.add(column, stop, false) end
    end
  end
end

local function read_layers(state, group, name, folder, where)
  for layer, here in sheet_oca.layers(group, where, name) do
    local path = folder .. get(layer, here, "name", "string", "")
    local is_group, is_visible, opacity = sheet_oca.look(layer, here)
    if is_group then
      read_layers(state, layer, "childLayers", path .. "/", here)
    else
      if #state.layers == columns.most_layers then
        values.fail("%sthere are more than %d layers, which is the limit", here,
          columns.most_layers)
      end
      local column = columns.new(path)
      column.look = { opacity = opacity, visible = is_visible,
                      blend = get(layer, here, "blendingMode", "string", "normal") }
      state.layers[#state.layers + 1] = column
      sheet_oca.expose(column, layer, here, state.from)
    end
  end
end

--- An OCA document, and the size, the frames a second, and the first and the last frame of it.
function sheet_oca.document(text)
  local document, where = values.decode(text, "the document"), "the document: "
  local function number(...) return values.number(document, where, ...) end
  return document, { width = number("width", 1, columns.most_pixels, 1920),
    height = number("height", 1, columns.most_pixels, 1080),
    fps = number("frameRate", 1e-3, 1000, 24), from = frame_of(document, where, "startTime", 0),
    to = frame_of(document, where, "endTime", 240) - 1 }
end

--- Raises { message = }.
function sheet_oca.decode(text)
  local document, made = sheet_oca.document(text)
  if type(document.layers) ~= "table" then
    values.fail "it is not an OCA document: it has no list of layers"
  end
  made.name, made.layers, made.notes = get(document, "the document: ", "name", "string", ""), {}, {}
  read_layers(made, document, "layers", "", "")
  made.frames = columns.length(math.max(1, made.to - made.from + 1), made.layers, {})
  return made
end

--- The document among the files of an OCA folder; nil: there is none.
function sheet_oca.file(names)
  table.sort(names)
  for _, pattern in ipairs { "%.oca$", "%.json$" } do
    for _, name in ipairs(names) do
      if name:match(pattern) and not name:match "_meta%.json$" then return name end
    end
  end
end

return fields.seal("sheet_oca", sheet_oca)
