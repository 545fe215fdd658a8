--- The exposures of an OCA document: which drawing each layer shows at each frame.
--
-- A drawing lasts for its duration, and then the layer is empty until the next one begins; a layer
-- that is not animated shows its first drawing throughout. Drawings have the same names as in
-- layers.read, and layers are named by their paths, "group/layer".
local columns = require "celspan.columns"
local fields = require "celspan.fields"
local json = require "celspan.json"

local sheet_oca = {}

local words = { table = "list" }

--- A value of an object of the document, or its default. what: the object, for messages.
function sheet_oca.value(object, what, name, default)
  local value = object[name]
  if value == nil or value == json.null then return default end
  if type(value) ~= type(default) then
    columns.fail("%s: %s must be a %s, got %s", what, name,
      words[type(default)] or type(default), fields.kind(value))
  end
  return value
end

function sheet_oca.number(object, what, name, default, least, most)
  local number = sheet_oca.value(object, what, name, default)
  if not (number >= least and number <= most) then
    columns.fail("%s: %s is %s; it must be a number from %.10g to %.10g", what, name,
      fields.shown(number), least, most)
  end
  return number
end

local get, number_of = sheet_oca.value, sheet_oca.number

--- A number of frames; some programs write it as a float.
local function frame_of(object, what, name, default, least)
  local number = number_of(object, what, name, default, least, columns.most_frames)
  return math.tointeger(math.floor(number + 0.5))
end

--- The name of a drawing, or false for an empty one.
function sheet_oca.drawing(frame, what)
  local name, file = get(frame, what, "name", ""), get(frame, what, "fileName", "")
  if file == "" or name == "_blank" then return false end
  if name ~= "" then return name end
  return file:gsub("\\", "/"):match "[^/]*$":gsub("%.%w+$", "")
end

--- Reads the frames of a layer into a column. start: the first frame of the document.
function sheet_oca.expose(column, layer, what, start)
  local list = {}
  for i, frame in ipairs(get(layer, what, "frames", {})) do
    local here = ("%s: frame %d"):format(what, i)
    if type(frame) ~= "table" then
      columns.fail("%s must be an object, got %s", here, fields.kind(frame))
    end
    list[i] = { frame = frame_of(frame, here, "frameNumber", 0, -columns.most_frames) - start + 1,
                length = frame_of(frame, here, "duration", 1, 0),
                name = sheet_oca.drawing(frame, here) }
  end
  columns.sort(list)
  if not get(layer, what, "animated", true) then
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

local function read_layers(state, list, folder, where)
  for i, layer in ipairs(list) do
    local what = ("%slayer %d"):format(where, i)
    if type(layer) ~= "table" then
      columns.fail("%s must be an object, got %s", what, fields.kind(layer))
    end
    local path = folder .. get(layer, what, "name", "")
    if get(layer, what, "type", "paintlayer") == "grouplayer" then
      read_layers(state, get(layer, what, "childLayers", {}), path .. "/", what .. ": ")
    else
      if #state.layers == columns.most_layers then
        columns.fail("%s: there are more than %d layers, which is the limit", what,
          columns.most_layers)
      end
      local column = columns.new(path)
      column.look = { opacity = number_of(layer, what, "opacity", 1, 0, 1),
        blend = get(layer, what, "blendingMode", "normal"),
        visible = get(layer, what, "visible", true) and not get(layer, what, "reference", false) }
      state.layers[#state.layers + 1] = column
      sheet_oca.expose(column, layer, what, state.start)
    end
  end
end

--- The frames a second of a document, its first frame and its last one.
function sheet_oca.clip(document)
  local what = "the document"
  return { fps = number_of(document, what, "frameRate", 24, 1e-3, 1000),
           from = frame_of(document, what, "startTime", 0, -columns.most_frames),
           to = frame_of(document, what, "endTime", 240, -columns.most_frames) - 1 }
end

--- Raises { message = }.
function sheet_oca.decode(text)
  local document, problem = json.decode(text)
  if document == nil then columns.fail("%s", problem) end
  if type(document) ~= "table" or type(document.layers) ~= "table" then
    columns.fail("it is not an OCA document: it has no list of layers")
  end
  local what, clip = "the document", sheet_oca.clip(document)
  local state = { layers = {}, start = clip.from }
  read_layers(state, document.layers, "", "")
  return { name = get(document, what, "name", ""), layers = state.layers, notes = {},
           fps = clip.fps,
           width = number_of(document, what, "width", 1920, 1, columns.most_pixels),
           height = number_of(document, what, "height", 1080, 1, columns.most_pixels),
           frames = columns.length(math.max(1, clip.to - clip.from + 1), state.layers, {}) }
end

--- The document among the files of an OCA folder; nil: there is none.
function sheet_oca.document(names)
  table.sort(names)
  for _, pattern in ipairs { "%.oca$", "%.json$" } do
    for _, name in ipairs(names) do
      if name:match(pattern) and not name:match "_meta%.json$" then return name end
    end
  end
end

return fields.seal("sheet_oca", sheet_oca)
