--- OCA, Open Cel Animation: a folder of pictures and a JSON document with their layers, rearmost
--- first.
--
--   oca.read(folder, document)
--     -> { width =, height =, layers = {...}, skipped = {...} } | nil, message
--
-- A layer: name, x, y, opacity, visible, blend, and picture (the fields of an image) or children. A
-- layer with several drawings becomes a group of them, of which the first is visible; none is if
-- the first frame is empty.
local celspan = require "celspan"
local columns = require "celspan.columns"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local json = require "celspan.json"
local sheet_oca = require "celspan.sheet_oca"
local values = require "celspan.values"

local oca = {}

--- The most layers and drawings in a document.
oca.most_layers = 65536

local fail, get, number_of = values.fail, values.get, values.number

-- ---------------------------------------------------------------- values

--- The corner and size of something with a given centre.
local function place_of(object, where, width, height)
  local w = number_of(object, where, "width", 1, columns.most_pixels, width)
  local h = number_of(object, where, "height", 1, columns.most_pixels, height)
  local centre = get(object, where, "position", "table", {})
  local x = number_of(centre, where .. "position: ", 1, -1e9, 1e9, width / 2)
  local y = number_of(centre, where .. "position: ", 2, -1e9, 1e9, height / 2)
  return x - w / 2, y - h / 2, w, h
end

--- The file of a drawing, which must be in the folder.
local function file_of(state, where, name)
  local path = name:gsub("\\", "/")
  local is_outside = path:find "^/" or path:find "^%a:"
    or ("/" .. path .. "/"):find("/../", 1, true)
  if is_outside or path:find "%z" then
    fail("%sfileName is %q; it must lie in the folder", where, name)
  end
  local found = native.within(state.folder, path)
  return found or fail("%sfileName is %q, which is not in the folder", where, name)
end

-- Krita's words for modes that celspan lacks, with "_" as "-"; the words in Krita's files are in
-- src/kit/readers/layered/document.c.
local blends = { passthrough = "pass-through", add = "linear-dodge", plus = "add",
  dodge = "color-dodge", burn = "color-burn", diff = "difference", luminize = "luminosity",
  soft_light = "soft-light-photoshop", soft_light_svg = "soft-light" }

local function blend_of(layer, where)
  local word = get(layer, where, "blendingMode", "string", "normal"):lower()
  return blends[word] or (word:gsub("[_ ]", "-"))
end

local function count_layer(state, where)
  state.count = state.count + 1
  if state.count > oca.most_layers then
    fail("%sthere are more than %d layers and drawings, which is the limit", where,
      oca.most_layers)
  end
end

-- ---------------------------------------------------------------- layers

--- Whether the version of the document is before 1.1.1, which is the first to say that the
--- opacities of a layer and of its frames are multiplied.
local function has_one_opacity(version)
  local major, minor, patch = version:match "^(%d+)%.?(%d*)%.?(%d*)"
  local number = (tonumber(major) or 9) * 1e6 + (tonumber(minor) or 0) * 1e3
    + (tonumber(patch) or 0)
  return number < 1001001
end

--- Multiplies the opacities of a layer and of its drawings. Some programs write the opacity of a
--- layer again into its frames: if these are equal and below 1, they are counted once. In documents
--- of earlier versions the opacity of a layer is always counted once.
local function share_opacity(state, layer, drawings)
  local differs = false
  for _, drawing in ipairs(drawings) do
    differs = differs or drawing.opacity ~= layer.opacity and drawing.opacity ~= 1
  end
  if state.has_one_opacity and differs then
    layer.opacity = 1
    return
  end
  for _, drawing in ipairs(drawings) do
    if drawing.opacity == layer.opacity then drawing.opacity = 1 end
  end
end

--- The drawings of a layer that are not empty, in order, and whether its first frame is empty.
local function read_drawings(state, layer, path, where)
  local list, is_late = {}, false
  for frame, here in sheet_oca.frames(layer, where) do
    count_layer(state, here)
    local name = sheet_oca.drawing(frame, here)
    if name then
      local x, y, w, h = place_of(frame, here, state.width, state.height)
      list[#list + 1] = { name = name, x = x, y = y, blend = "normal",
        visible = #list == 0 and not is_late,
        opacity = number_of(frame, here, "opacity", 0, 1, 1),
        picture = { file = file_of(state, here, frame.fileName), x = x, y = y, w = w, h = h } }
    elseif #list == 0 then
      is_late = true
    end
  end
  if #list > 1 or is_late and #list > 0 then
    state.skipped[#state.skipped + 1] = { layer = path,
      what = ("%d drawings: %s is visible"):format(#list,
        is_late and "the first frame is empty, and none" or "the first") }
  end
  return list, is_late
end

local read_layers

local function read_layer(state, layer, folder, where)
  count_layer(state, where)
  local name = get(layer, where, "name", "string", "")
  local path = folder .. name
  local is_group, is_visible, opacity = sheet_oca.look(layer, where)
  local out = { name = name, x = 0, y = 0, blend = blend_of(layer, where), opacity = opacity,
                visible = is_visible }
  if get(layer, where, "inheritAlpha", "boolean", false) then
    state.skipped[#state.skipped + 1] = { layer = path,
      what = "alpha is inherited from the layers below: it is shown whole" }
  end
  if is_group then
    if get(layer, where, "passThrough", "boolean", false) then out.blend = "pass-through" end
    out.children = read_layers(state, layer, "childLayers", path .. "/", where)
    return out
  end
  local drawings, is_late = read_drawings(state, layer, path, where)
  share_opacity(state, out, drawings)
  if #drawings > 1 or is_late and #drawings > 0 then
    out.children, out.exposures = drawings, columns.new(path)
    sheet_oca.expose(out.exposures, layer, where, state.clip.from)
  elseif #drawings == 1 then
    out.x, out.y, out.picture = drawings[1].x, drawings[1].y, drawings[1].picture
    out.opacity = out.opacity * drawings[1].opacity
  end
  return out
end

function read_layers(state, group, name, folder, where)
  local out = {}
  for layer, here in sheet_oca.layers(group, where, name) do
    out[#out + 1] = read_layer(state, layer, folder, here)
  end
  return out
end

--- The background of the document as a layer, if it has one.
local function background(document, width, height)
  local colour = get(document, "the document: ", "backgroundColor", "table", {})
  local codes = {}
  for i = 1, 4 do
    local share = number_of(colour, "backgroundColor: ", i, 0, 1e9, 0)
    codes[i] = math.min(255, math.floor(255 * share + 0.5))
  end
  if codes[4] == 0 then return nil end
  return { name = "background", x = 0, y = 0, opacity = 1, visible = true, blend = "normal",
    object = celspan.rect { 0, 0, width, height,
      texture = ("#%02x%02x%02x%02x"):format(codes[1], codes[2], codes[3], codes[4]) } }
end

local function read_document(folder, text)
  local document, clip = sheet_oca.document(text)
  local width, height = clip.width, clip.height
  local state = { folder = folder, count = 0, skipped = {}, width = width, height = height,
    clip = clip, has_one_opacity = has_one_opacity(get(document, "the document: ", "ocaVersion",
      "string", "")) }
  local read = read_layers(state, document, "layers", "", "")
  local ground = background(document, width, height)
  if ground then table.insert(read, 1, ground) end
  return { width = width, height = height, layers = read, skipped = state.skipped, clip = clip }
end

---@param folder string
---@param document string The name of the JSON document in it
---@return table? read
---@return string? message
function oca.read(folder, document)
  if type(folder) ~= "string" or type(document) ~= "string" then
    native.refuse(("oca: read takes a folder and the name of a document in it, got %s and %s")
      :format(fields.kind(folder), fields.kind(document)))
  end
  local path = folder .. "/" .. document
  local text, message = files.read(path, json.most_bytes)
  if not text then return nil, message end
  return fields.caught_in(path, read_document, folder, text)
end

return fields.publish("oca", oca)
