--- Reads the header of an OpenEXR file of scan lines, and its values if it is not compressed, by
--- the description of the format alone (OpenEXR File Layout, openexr.com).
local exr = {}

local SIZES = { [0] = 4, [1] = 2, [2] = 4 }
local FORMATS = { [0] = "<I4", [2] = "<f" }

local function read_half(bytes, at)
  local bits = ("<I2"):unpack(bytes, at)
  local sign, exponent, part = bits >> 15, bits >> 10 & 31, bits & 1023
  local size = exponent == 0 and part * 2.0 ^ -24 or (1024 + part) * 2.0 ^ (exponent - 25)
  return sign == 1 and -size or size
end

local function read_channels(bytes)
  local list, at = {}, 1
  while bytes:byte(at) ~= 0 do
    local name, kind
    name, at = ("z"):unpack(bytes, at)
    kind = ("<I4"):unpack(bytes, at)
    list[#list + 1] = { name = name, kind = kind }
    at = at + 16
  end
  return list
end

--- Returns { width =, height =, attributes = { name = bytes }, channels = { { name =, kind = } },
--- bits(name, x, y), value(name, x, y) }; pixels count from 0. bytes: of the whole file.
function exr.decode(bytes)
  assert(("<I4"):unpack(bytes) == 20000630, "no OpenEXR file")
  local at, attributes = 9, {}
  while bytes:byte(at) ~= 0 do
    local name, size, _
    name, _, size, at = ("<zzI4"):unpack(bytes, at)
    attributes[name] = bytes:sub(at, at + size - 1)
    at = at + size
  end
  local left, top, right, bottom = ("<i4i4i4i4"):unpack(attributes.dataWindow)
  local file = { width = right - left + 1, height = bottom - top + 1, attributes = attributes,
                 channels = read_channels(attributes.channels) }
  local places, offset = {}, 0
  for _, channel in ipairs(file.channels) do
    places[channel.name] = { offset = offset, kind = channel.kind }
    offset = offset + file.width * SIZES[channel.kind]
  end
  local function find(name, x, y)
    assert(attributes.compression == "\0", "the file is compressed")
    local row = ("<I8"):unpack(bytes, at + 1 + 8 * y)
    local place = places[name]
    return row + 1 + 8 + place.offset + x * SIZES[place.kind], place.kind
  end
  function file.bits(name, x, y)
    return (("<I4"):unpack(bytes, (find(name, x, y))))
  end
  function file.value(name, x, y)
    local where, kind = find(name, x, y)
    if kind == 1 then return read_half(bytes, where) end
    return (FORMATS[kind]:unpack(bytes, where))
  end
  return file
end

return exr
