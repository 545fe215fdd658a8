--- The pictures of an animation: in the file itself, in its archive, or in files beside it.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local source = require "celspan.lottie_source"
local values = require "celspan.lottie_values"

local pictures = {}

local frame = '<svg xmlns="http://www.w3.org/2000/svg" width="%.9g" height="%.9g">'
  .. '<image width="%.9g" height="%.9g" preserveAspectRatio="none" href="%s"/></svg>'

-- Bytes of all sounds inside the file: those of members, and addresses as they are written.
local MOST_SOUND = 128 * 1024 * 1024
local TOO_MUCH = "the sounds inside the file are larger than 128 MiB, counted again for each layer"

--- The object of an embedded picture: the SVG reader decodes it.
local function embedded(href, w, h)
  if href:find '["<&]' then return nil, "its data are damaged" end
  local drawing, message = native.parse_svg(frame:format(w, h, w, h, href), "the picture")
  if not drawing then return nil, message end
  local note = drawing:skipped()[1]
  if note then return nil, note.what end
  return drawing:object()
end

--- The path of a file that an asset names, below the folder of the animation.
local function file_of(found, asset)
  local folder = values.text(asset.u, "")
  local name = (folder:find "^/" and folder:sub(2) or folder) .. asset.p
  local path = native.within(found.folder, name)
  if path then return path end
  return nil, ("there is no file '%s'"):format(values.name(name, ""))
end

--- A picture in a file.
local function beside(found, asset, w, h)
  local path, message = file_of(found, asset)
  if not path then return nil, message end
  local good, object = pcall(celspan.image, { file = path, x = 0, y = 0, w = w, h = h })
  if good then return object end
  return nil, tostring(object)
end

local function open(found, asset)
  local w, h = math.max(1, values.number(asset.w, 1)), math.max(1, values.number(asset.h, 1))
  if type(asset.p) ~= "string" or asset.p == "" then return nil, "the picture has no name" end
  if native.is_data(asset.p) then return embedded(asset.p, w, h) end
  if not found.archive then return beside(found, asset, w, h) end
  local address, message = source.address(found, "picture", asset.p)
  if not address then return nil, message end
  return embedded(address, w, h)
end

--- A function that returns the object of an asset, or nil and why it is not shown.
---@param found table As source.open returns it
---@param assets table<any, table>
---@return fun(id: any): any, string?
function pictures.reader(found, assets)
  local known = {}
  return function(id)
    local asset = assets[id]
    if not asset then return nil, ("the picture '%s' is not in the file"):format(fields.key(id)) end
    if known[asset] == nil then known[asset] = { open(found, asset.item) } end
    local object, message = known[asset][1], known[asset][2]
    return object, message and ("the picture '%s' is missing: %s"):format(fields.key(id), message)
  end
end

--- The bytes of the sound of an asset inside the file.
local function bytes_of(found, asset)
  if native.is_data(asset.p) then return #asset.p end
  if found.archive then return source.bytes(found, "sound", asset.p) end
  return 0
end

--- The path of the sound of an asset, or an address that contains it.
local function sound_of(found, asset, most)
  if native.is_data(asset.p) then return asset.p end
  if found.archive then return source.address(found, "sound", asset.p, most) end
  return file_of(found, asset)
end

--- As pictures.sounds returns it, for assets whose bytes are counted by `take`.
local function try_sound(found, asset, known, take)
  local bytes, problem = bytes_of(found, asset)
  if not bytes then return nil, problem end
  if not take(bytes) then return nil, TOO_MUCH end
  known[asset] = known[asset] or { sound_of(found, asset, bytes) }
  return known[asset][1], known[asset][2]
end

--- A function that returns the path of the sound of an asset, or an address that contains it; or
--- nil and why it is not heard.
function pictures.sounds(found, assets)
  local known = {}
  local left = MOST_SOUND -- each layer's own: each is decoded alone
  local function take(bytes)
    if bytes > left then return false end
    left = left - bytes
    return true
  end
  return function(id)
    local asset = assets[id] and assets[id].item
    if not asset or type(asset.p) ~= "string" then return nil, "its sound is not in the file" end
    local path, message = try_sound(found, asset, known, take)
    return path, message and "its sound is missing: " .. message
  end
end

return fields.seal("lottie_pictures", pictures)
