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

local oca = {}

--- The most layers and drawings in a document.
oca.most_layers = 65536

local function fail(...) error({ message = string.format(...) }, 0) end

-- ---------------------------------------------------------------- values

local value_of, number_of = sheet_oca.value, sheet_oca.number

--- The corner and size of something with a given centre.
local function place_of(object, what, width, height)
  local w = number_of(object, what, "width", width, 1, 1048576)
  local h = number_of(object, what, "height", height, 1, 1048576)
  local centre = value_of(object, what, "position", {})
  local x = number_of(centre, what .. ": position", 1, width / 2, -1e9, 1e9)
  local y = number_of(centre, what .. ": position", 2, height / 2, -1e9, 1e9)
  return x - w / 2, y - h / 2, w, h
end

--- The file of a drawing, which must be in the folder.
local function file_of(state, what, name)
  local path = name:gsub("\\", "/")
  local is_outside = path:find "^/" or path:find "^%a:"
    or ("/" .. path .. "/"):find("/../", 1, true)
  if is_outside or path:find "%z" then
    fail("%s: fileName is %q; it must lie in the folder", what, name)
  end
  local found = native.within(state.folder, path)
  if not found then
    fail("%s: fileName is %q, which is not in the folder", what, name)
  end
  return found
end

-- Krita's words for modes that celspan lacks, with "_" as "-"; the words in Krita's files are in
-- src/kit/readers/layered/document.c.
local blends = { passthrough = "pass-through", add = "linear-dodge", plus = "add",
  dodge = "color-dodge", burn = "color-burn", diff = "difference", luminize = "luminosity",
  soft_light = "soft-light-photoshop", soft_light_svg = "soft-light" }

local function blend_of(layer, what)
  local word = value_of(layer, what, "blendingMode", "normal"):lower()
  return blends[word] or (word:gsub("[_ ]", "-"))
end

local function count_layer(state, what)
  state.count = state.count + 1
  if state.count > oca.most_layers then
    fail("%s: there are more than %d layers and drawings, which is the limit", what,
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
local function read_drawings(state, layer, path, what)
  local list, is_late = {}, false
  for i, frame in ipairs(value_of(layer, what, "frames", {})) do
    local here = ("%s: frame %d"):format(what, i)
    if type(frame) ~= "table" then
      fail("%s must be an object, got %s", here, fields.kind(frame))
    end
    count_layer(state, here)
    local name, file = sheet_oca.drawing(frame, here), value_of(frame, here, "fileName", "")
    if name then
      local x, y, w, h = place_of(frame, here, state.width, state.height)
      list[#list + 1] = { name = name, x = x, y = y, blend = "normal",
        visible = #list == 0 and not is_late,
        opacity = number_of(frame, here, "opacity", 1, 0, 1),
        picture = { file = file_of(state, here, file), x = x, y = y, w = w, h = h } }
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

local function read_layer(state, layer, folder, what)
  if type(layer) ~= "table" then fail("%s must be an object, got %s", what, fields.kind(layer)) end
  count_layer(state, what)
  local name = value_of(layer, what, "name", "")
  local path = folder .. name
  local out = { name = name, x = 0, y = 0, blend = blend_of(layer, what),
    opacity = number_of(layer, what, "opacity", 1, 0, 1),
    visible = value_of(layer, what, "visible", true)
      and not value_of(layer, what, "reference", false) }
  if value_of(layer, what, "inheritAlpha", false) then
    state.skipped[#state.skipped + 1] = { layer = path,
      what = "alpha is inherited from the layers below: it is shown whole" }
  end
  if value_of(layer, what, "type", "paintlayer") == "grouplayer" then
    if value_of(layer, what, "passThrough", false) then out.blend = "pass-through" end
    out.children = read_layers(state, value_of(layer, what, "childLayers", {}), path .. "/",
      what .. ": ")
    return out
  end
  local drawings, is_late = read_drawings(state, layer, path, what)
  share_opacity(state, out, drawings)
  if #drawings > 1 or is_late and #drawings > 0 then
    out.children, out.exposures = drawings, columns.new(path)
    sheet_oca.expose(out.exposures, layer, what, state.from)
  elseif #drawings == 1 then
    out.x, out.y, out.picture = drawings[1].x, drawings[1].y, drawings[1].picture
    out.opacity = out.opacity * drawings[1].opacity
  end
  return out
end

function read_layers(state, list, folder, what)
  local out = {}
  for i, layer in ipairs(list) do
    out[i] = read_layer(state, layer, folder, ("%slayer %d"):format(what, i))
  end
  return out
end

--- The background of the document as a layer, if it has one.
local function background(document, width, height)
  local colour = value_of(document, "the document", "backgroundColor", {})
  local codes = {}
  for i = 1, 4 do
    codes[i] = math.floor(255 * number_of(colour, "backgroundColor", i, 0, 0, 1e9) + 0.5)
    codes[i] = math.min(255, codes[i])
  end
  if codes[4] == 0 then return nil end
  return { name = "background", x = 0, y = 0, opacity = 1, visible = true, blend = "normal",
    object = celspan.rect { 0, 0, width, height,
      texture = ("#%02x%02x%02x%02x"):format(codes[1], codes[2], codes[3], codes[4]) } }
end

local function read_document(folder, text)
  local document, problem = json.decode(text)
  if document == nil then fail("%s", problem) end
  if type(document) ~= "table" then fail("the document must be an object") end
  local state = { folder = folder, count = 0, skipped = {},
    width = number_of(document, "the document", "width", 1920, 1, 1048576),
    height = number_of(document, "the document", "height", 1080, 1, 1048576) }
  local clip = sheet_oca.clip(document)
  state.from = clip.from
  state.has_one_opacity = has_one_opacity(value_of(document, "the document", "ocaVersion", ""))
  local list = value_of(document, "the document", "layers", {})
  local read = read_layers(state, list, "", "")
  local ground = background(document, state.width, state.height)
  if ground then table.insert(read, 1, ground) end
  return { width = state.width, height = state.height, layers = read, skipped = state.skipped,
           clip = clip }
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
  local read, fault = fields.caught(read_document, folder, text)
  if not read then return nil, ("%s: %s"):format(path, fault) end
  return read
end

return fields.publish("oca", oca)
