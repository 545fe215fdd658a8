--- Colour profiles (ICC) that have only a name, and files of pictures with them.
local stored = require "tests.support.stored"

local profile = {}

--- A profile of a display with one tag, its description. version: 2 or 4.
function profile.of(value, version)
  local body = string.pack(">I4c4I4I4", 1, "desc", 144, #value) .. value
  local padded = body .. ("\0"):rep(-#body % 4)
  return string.pack(">I4c4I4c4c4c4", 128 + #padded, "", version << 24, "mntr", "RGB ", "XYZ ")
    .. ("\0"):rep(12) .. "acsp" .. ("\0"):rep(28)
    .. string.pack(">I4I4I4", 0xF6D6, 0x10000, 0xD32D) .. ("\0"):rep(48) .. padded
end

--- The description in version 2: ASCII.
function profile.plain(name)
  return string.pack(">c4I4I4", "desc", 0, #name + 1) .. name .. ("\0"):rep(79)
end

--- The description in version 4, in English: UTF-16.
function profile.wide(name)
  local units = {}
  for _, code in utf8.codes(name) do
    units[#units + 1] = code < 0x10000 and string.pack(">I2", code)
      or string.pack(">I2I2", 0xD800 + (code - 0x10000 >> 10), 0xDC00 + (code & 0x3FF))
  end
  local text = table.concat(units)
  return string.pack(">c4I4I4I4c4I4I4", "mluc", 0, 1, 12, "enUS", #text, 28) .. text
end

--- A PNG with the profile behind its header.
function profile.png(file, bytes)
  return file:sub(1, 33) .. stored.chunk("iCCP", "name\0\0" .. stored.zlib(bytes)) .. file:sub(34)
end

--- A JPEG with the profile in a marker.
function profile.jpeg(file, bytes)
  return file:sub(1, 2) .. "\xFF\xE2" .. string.pack(">I2", #bytes + 16) .. "ICC_PROFILE\0\1\1"
    .. bytes .. file:sub(3)
end

return profile
