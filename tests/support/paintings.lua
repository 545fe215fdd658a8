--- Writes layered paintings for tests: OpenRaster, Krita and Photoshop files, as strings. One file,
-- because the three formats share their layers and their checksums.
--
--   paintings.openraster { w = 64, h = 48, layers = { {...}, ... } }     rearmost first in all
--   paintings.krita { ... }     paintings.psd { ... }
--
-- A layer: name, x, y, w, h, pixel = function(x, y) -> r, g, b, a (codes; x, y from its corner),
-- and opacity (0..1), visible, blend (the format's own word), layers (a group), attributes (more of
-- XML). profile: the bytes of a colour profile, of a layer (OpenRaster, Krita) or of the painting
-- (Krita, Photoshop). members: further files of a Krita layer, by the endings of their names; FILE
-- in them and in attributes is the name of its own. inside: more XML of a Krita layer or image.
-- name: what a Krita image is called; its layers lie in "forest". alpha: the bytes of a Photoshop
-- layer's alpha, instead of its own. How it is packed: deflate (zip members), lzf (Krita),
-- packing = "raw", "packbits", "zip" or "predicted" (Photoshop); depth = 8 or 16; grey.
local stored = require "tests.support.stored"

local paintings = {}

-- ---------------------------------------------------------------- archives

--- members: { name =, data =, deflate =, extra =, and false values for a damaged archive: size,
--- packed, method, flags }. comment: after the table. is_wide: offsets and sizes are 64-bit
--- numbers, in extra fields and before the end of the table.
function paintings.zip(members, comment, is_wide)
  local out, entries, at = {}, {}, 0
  for _, member in ipairs(members) do
    local data = member.deflate and stored.deflate(member.data) or member.data
    local method = member.method or (member.deflate and 8 or 0)
    local facts = string.pack("<I2I2I2I2I4I4I4I2", member.flags or 0, method, 0, 0,
      member.sum or stored.crc32(member.data), member.packed or #data,
      member.size or #member.data, #member.name)
    local header = "PK\3\4" .. string.pack("<I2", 20) .. facts .. string.pack("<I2", 0)
      .. member.name
    local extra = member.extra or ""
    if is_wide then
      facts = facts:sub(1, 12) .. ("\255"):rep(8) .. facts:sub(21)
      extra = extra .. string.pack("<I2I2I8I8I8", 1, 24, #member.data, #data, at)
    end
    entries[#entries + 1] = "PK\1\2" .. string.pack("<I2I2", 20, 20) .. facts
      .. string.pack("<I2I2I2I2I4I4", #extra, 0, 0, 0, 0, is_wide and 0xFFFFFFFF or member.at or at)
      .. member.name .. extra
    out[#out + 1] = header .. data
    at = at + #header + #data
  end
  local table_text = table.concat(entries)
  local wide_end = is_wide and "PK\6\6" .. string.pack("<I8I2I2I4I4I8I8I8I8", 44, 45, 45, 0, 0,
    #members, #members,
    #table_text, at) .. "PK\6\7" .. string.pack("<I4I8I4", 0, at + #table_text, 1) or ""
  return table.concat(out) .. table_text .. wide_end .. "PK\5\6"
    .. string.pack("<I2I2I2I2I4I4I2", 0, 0, is_wide and 65535 or #members, is_wide and 65535
      or #members,
      is_wide and 0xFFFFFFFF or #table_text, is_wide and 0xFFFFFFFF or at, #(comment or ""))
    .. (comment or "")
end

-- ---------------------------------------------------------------- colour profiles

--- The primaries of sRGB, relative to the white of D50.
local srgb_places = { { 0.4361, 0.2225, 0.0139 }, { 0.3851, 0.7169, 0.0971 },
  { 0.1431, 0.0606, 0.7141 } }

--- A table of the codes of sRGB.
local function srgb_table()
  local values = {}
  for i = 0, 1023 do
    local code = i / 1023
    local light = code <= 0.04045 and code / 12.92 or ((code + 0.055) / 1.055) ^ 2.4
    values[i + 1] = string.pack(">I2", math.floor(65535 * light + 0.5))
  end
  return "curv\0\0\0\0" .. string.pack(">I4", 1024) .. table.concat(values)
end

--- The tag of a table of colours (lut16Type): curves that square the codes, then a cube of 2 x 2 x
--- 2 points, in XYZ.
local function lut_of(place_of)
  local parts = { "mft2\0\0\0\0\3\3\2\0" }
  for i = 0, 8 do parts[#parts + 1] = string.pack(">i4", i % 4 == 0 and 65536 or 0) end
  parts[#parts + 1] = string.pack(">I2I2", 256, 2)
  for i = 0, 767 do
    parts[#parts + 1] = string.pack(">I2", math.floor(65535 * (i % 256 / 255) ^ 2 + 0.5))
  end
  for i = 0, 7 do
    for _, number in ipairs { place_of(i // 4, i // 2 % 2, i % 2) } do
      parts[#parts + 1] = string.pack(">I2", math.floor(32768 * number + 0.5))
    end
  end
  return table.concat(parts) .. ("\0\0\255\255"):rep(3)
end

--- The bytes of a profile. given: name; curve: "srgb", "formula" (sRGB as a formula), a power, or
--- the bytes of a tag; grey; places: of red, green and blue; wide: the name is in UTF-16; lut: a
--- function from the corners of a cube of squared codes to places, which replaces places and curve.
function paintings.profile(given)
  local function fixed(number) return string.pack(">i4", math.floor(number * 65536 + 0.5)) end
  local curve = given.curve or "srgb"
  if curve == "srgb" then
    curve = srgb_table()
  elseif curve == "formula" then
    curve = "para\0\0\0\0\0\3\0\0" .. fixed(2.4) .. fixed(1 / 1.055) .. fixed(0.055 / 1.055)
      .. fixed(1 / 12.92) .. fixed(0.04045)
  elseif type(curve) == "number" then
    curve = "curv\0\0\0\0" .. string.pack(">I4I2", 1, math.floor(curve * 256 + 0.5)) .. "\0\0"
  end
  local name = given.name or "a profile"
  local tags = { { "desc", given.wide
    and "mluc\0\0\0\0" .. string.pack(">I4I4", 1, 12) .. "enUS" .. string.pack(">I4I4", 2 * #name,
      28)
      .. name:gsub(".", "\0%0")
    or "desc\0\0\0\0" .. string.pack(">I4", #name + 1) .. name .. ("\0"):rep(80) } }
  if given.lut then
    tags[2] = { "A2B0", lut_of(given.lut) }
  elseif given.grey then
    tags[2] = { "kTRC", curve }
  else
    for c, letter in ipairs { "r", "g", "b" } do
      local place = (given.places or srgb_places)[c]
      tags[#tags + 1] = { letter .. "XYZ", "XYZ \0\0\0\0" .. fixed(place[1]) .. fixed(place[2])
        .. fixed(place[3]) }
      tags[#tags + 1] = { letter .. "TRC", curve }
    end
  end
  local entries, data, at = {}, {}, 128 + 4 + 12 * #tags
  for i, one in ipairs(tags) do
    entries[i] = one[1] .. string.pack(">I4I4", at, #one[2])
    data[i] = one[2]
    at = at + #one[2]
  end
  local head = string.pack(">I4", at) .. ("\0"):rep(12) .. (given.grey and "GRAY" or "RGB ")
    .. "XYZ "
  return head .. ("\0"):rep(36 - #head) .. "acsp" .. ("\0"):rep(88) .. string.pack(">I4", #tags)
    .. table.concat(entries) .. table.concat(data)
end

-- ---------------------------------------------------------------- PNG

--- An RGBA PNG of a layer, or a PNG of the given colour type with the given rows.
function paintings.png(layer)
  local depth = layer.depth or 8
  local format = depth == 16 and ">I2I2I2I2" or "BBBB"
  local rows = {}
  for y = 0, layer.h - 1 do
    local row = {}
    for x = 0, layer.w - 1 do row[#row + 1] = string.pack(format, layer.pixel(x, y)) end
    rows[#rows + 1] = "\0" .. table.concat(row)
  end
  local profile = layer.profile
    and stored.chunk("iCCP", "embedded\0\0" .. stored.zlib(layer.profile))
  return paintings.png_of(layer.w, layer.h, depth, 6, table.concat(rows), layer.chunks or profile)
end

--- rows: filtered, each with the byte of its filter. more: chunks before the data.
function paintings.png_of(w, h, depth, colour, rows, more, interlaced)
  return "\x89PNG\r\n\x1a\n"
    .. stored.chunk("IHDR", string.pack(">I4I4BBBBB", w, h, depth, colour, 0, 0, interlaced or 0))
    .. (more or "") .. stored.chunk("IDAT", stored.zlib(rows)) .. stored.chunk("IEND", "")
end

-- ---------------------------------------------------------------- XML

local function escaped(text)
  return (tostring(text):gsub("[&<>\"]", { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;",
    ['"'] = "&quot;" }))
end

local function attributes(list)
  local out = {}
  for i = 1, #list, 2 do
    if list[i + 1] ~= nil then out[#out + 1] = (' %s="%s"'):format(list[i],
      escaped(list[i + 1])) end
  end
  return table.concat(out)
end

--- Foremost first: the order of both formats.
local function from_top(list)
  local out = {}
  for i = #list, 1, -1 do out[#out + 1] = list[i] end
  return out
end

-- ---------------------------------------------------------------- OpenRaster

local function openraster_layers(list, members)
  local out = {}
  for _, layer in ipairs(from_top(list)) do
    local common = attributes { "name", layer.name, "opacity", layer.opacity, "visibility",
      layer.visible == false and "hidden" or nil, "composite-op", layer.blend,
      "isolation", layer.isolation } .. (layer.attributes or "")
    if layer.layers then
      out[#out + 1] = "<stack" .. common .. ">" .. openraster_layers(layer.layers, members)
        .. "</stack>"
    else
      local name = ("data/layer%d.png"):format(#members)
      members[#members + 1] = { name = name, data = layer.png or paintings.png(layer),
        deflate = layer.deflate }
      out[#out + 1] = "<layer" .. attributes { "x", layer.x, "y", layer.y, "src",
        layer.src or name } .. common .. "/>"
    end
  end
  return table.concat(out, "\n")
end

function paintings.openraster(painting)
  local members = { { name = "mimetype", data = "image/openraster" } }
  local stack = ('<?xml version="1.0" encoding="UTF-8"?>\n<image w="%d" h="%d">\n<stack>\n%s\n'
    .. "</stack>\n</image>\n"):format(painting.w, painting.h,
      openraster_layers(painting.layers, members))
  members[#members + 1] = { name = "stack.xml", data = stack, deflate = true }
  return paintings.zip(members)
end

-- ---------------------------------------------------------------- Krita

--- How many bytes from `at` on equal the bytes that are `back` bytes before them.
local function match_length(text, at, back)
  local count = 0
  while count < 264 and at + count <= #text and at > back
      and text:byte(at + count) == text:byte(at + count - back) do count = count + 1 end
  return count
end

--- LZF: copies from a few distances; all other bytes are literals.
function paintings.lzf(text)
  local out, at, literals = {}, 1, {}
  local function flush()
    if #literals > 0 then out[#out + 1] = string.char(#literals - 1) .. table.concat(literals) end
    literals = {}
  end
  while at <= #text do
    local best, distance = 0, 0
    for _, back in ipairs { 1, 3, 64, 300 } do
      local count = match_length(text, at, back)
      if count > best then best, distance = count, back end
    end
    if best >= 3 then
      flush()
      local high, low = (distance - 1) >> 8, (distance - 1) & 255
      out[#out + 1] = best < 9 and string.char((best - 2) << 5 | high, low)
        or string.char(7 << 5 | high, best - 9, low)
      at = at + best
    else
      literals[#literals + 1] = text:sub(at, at)
      if #literals == 32 then flush() end
      at = at + 1
    end
  end
  flush()
  return table.concat(out)
end

local function krita_pixel(layer, x, y)
  local r, g, b, a = layer.pixel(x, y)
  local one = layer.depth == 16 and "I2" or "B"
  if layer.grey then return string.pack("<" .. one .. one, r, a) end
  return string.pack("<" .. one:rep(4), b, g, r, a)
end

local function krita_tile(layer, column, row)
  local pixels = {}
  local clear = ("\0"):rep((layer.grey and 2 or 4) * (layer.depth == 16 and 2 or 1))
  for y = 64 * row, 64 * row + 63 do
    for x = 64 * column, 64 * column + 63 do
      pixels[#pixels + 1] = x < layer.w and y < layer.h and krita_pixel(layer, x, y) or clear
    end
  end
  if layer.lzf == false then return "\0" .. table.concat(pixels) end
  local planes = {}
  for byte = 1, #clear do
    local plane = {}
    for i, pixel in ipairs(pixels) do plane[i] = pixel:sub(byte, byte) end
    planes[byte] = table.concat(plane)
  end
  local packed = paintings.lzf(table.concat(planes))
  return #packed < #clear * 4096 and "\1" .. packed or "\0" .. table.concat(pixels)
end

--- Tiles from the layer's corner on. tile_x, tile_y: the place of this corner in the layer's own
--- units.
function paintings.krita_tiles(layer)
  local tiles = {}
  for row = 0, (layer.h + 63) // 64 - 1 do
    for column = 0, (layer.w + 63) // 64 - 1 do
      local data = krita_tile(layer, column, row)
      tiles[#tiles + 1] = ("%d,%d,LZF,%d\n"):format(64 * column + (layer.tile_x or 0),
        64 * row + (layer.tile_y or 0), #data) .. data
    end
  end
  return ("VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE %d\nDATA %d\n"):format(
    (layer.grey and 2 or 4) * (layer.depth == 16 and 2 or 1), #tiles) .. table.concat(tiles)
end

local function krita_layers(list, members)
  local out = {}
  for _, layer in ipairs(from_top(list)) do
    local file = ("layer%d"):format(#members + 1)
    local space = (layer.grey and "GRAYA" or "RGBA") .. (layer.depth == 16
      and (layer.grey and "U16" or "16") or "")
    local common = attributes { "name", layer.name, "filename", file, "visible",
      layer.visible == false and 0 or 1, "opacity", math.floor(255 * (layer.opacity or 1) + 0.5),
      "compositeop", layer.blend or "normal", "colorspacename", layer.space or space, "x",
      (layer.x or 0) - (layer.tile_x or 0), "y", (layer.y or 0) - (layer.tile_y or 0), "nodetype",
      layer.kind or (layer.layers and "grouplayer" or "paintlayer") }
      .. (layer.attributes or ""):gsub("FILE", file)
    if layer.layers then
      out[#out + 1] = "<layer" .. common .. "><layers>" .. krita_layers(layer.layers, members)
        .. "</layers></layer>"
    else
      members[#members + 1] = { name = "forest/layers/" .. file, deflate = layer.deflate,
        data = layer.tiles or (layer.pixel and paintings.krita_tiles(layer) or "") }
      if layer.profile then
        members[#members + 1] = { name = "forest/layers/" .. file .. ".icc", data = layer.profile }
      end
      for ending, data in pairs(layer.members or {}) do
        members[#members + 1] = { name = "forest/layers/" .. file .. ending,
          data = data:gsub("FILE", file) }
      end
      if layer.beyond then
        members[#members + 1] = { name = "forest/layers/" .. file .. ".defaultpixel",
          data = layer.beyond }
      end
      out[#out + 1] = "<layer" .. common .. ">" .. (layer.inside or "") .. "</layer>"
    end
  end
  return table.concat(out, "\n")
end

function paintings.krita(painting)
  local members = { { name = "mimetype", data = "application/x-krita" } }
  local list = krita_layers(painting.layers, members)
  if painting.profile then
    members[#members + 1] = { name = "forest/annotations/icc", data = painting.profile }
  end
  members[#members + 1] = { name = "maindoc.xml", deflate = true,
    data =
      '<?xml version="1.0" encoding="UTF-8"?>\n<!DOCTYPE DOC PUBLIC "-//KDE//DTD krita 2.0//EN"'
      .. ' "http://www.calligra.org/DTD/krita-2.0.dtd">\n<DOC '
      .. 'xmlns="http://www.calligra.org/DTD/krita"'
      .. (' syntaxVersion="2">\n<IMAGE name="%s" width="%d" height="%d" colorspacename="RGBA"%s>\n'
        ):format(painting.name or "forest", painting.w, painting.h, painting.attributes or "")
          .. "<layers>\n" .. list .. "\n</layers>\n" .. (painting.inside or "")
          .. "</IMAGE>\n</DOC>\n" }
  return paintings.zip(members)
end

-- ---------------------------------------------------------------- Photoshop

local function packbits(row)
  local out, at = {}, 1
  while at <= #row do
    local run = 1
    while run < 128 and row:byte(at + run) == row:byte(at) do run = run + 1 end
    if run >= 2 then
      out[#out + 1] = string.char(257 - run) .. row:sub(at, at)
      at = at + run
    else
      local stop = at
      while stop < #row and stop - at < 127 and row:byte(stop + 1) ~= row:byte(stop + 2) do
        stop = stop + 1
      end
      out[#out + 1] = string.char(stop - at) .. row:sub(at, stop)
      at = stop + 1
    end
  end
  return table.concat(out)
end

local function predicted(row, depth)
  local size, out, last = depth // 8, {}, 0
  local format = ">I" .. size
  for at = 1, #row, size do
    local value = string.unpack(format, row, at)
    out[#out + 1] = string.pack(format, (value - last) & ((1 << depth) - 1))
    last = value
  end
  return table.concat(out)
end

--- A channel: rows of numbers in the form of the file.
local function psd_channel(layer, w, h, painting, value_at)
  local depth = painting.depth or 8
  local format, rows = depth == 16 and ">I2" or "B", {}
  for y = 0, h - 1 do
    local row = {}
    for x = 0, w - 1 do row[#row + 1] = string.pack(format, value_at(x, y)) end
    rows[#rows + 1] = table.concat(row)
  end
  local packing = layer.packing or "raw"
  if packing == "raw" then return "\0\0" .. table.concat(rows) end
  if packing == "zip" then return "\0\2" .. stored.zlib(table.concat(rows)) end
  if packing == "predicted" then
    for y, row in ipairs(rows) do rows[y] = predicted(row, depth) end
    return "\0\3" .. stored.zlib(table.concat(rows))
  end
  local sizes = {}
  for y, row in ipairs(rows) do
    rows[y] = packbits(row)
    sizes[y] = string.pack(painting.large and ">I4" or ">I2", #rows[y])
  end
  return "\0\1" .. table.concat(sizes) .. table.concat(rows)
end

local function tag(key, data)
  if #data % 2 == 1 then data = data .. "\0" end
  return "8BIM" .. key .. string.pack(">I4", #data) .. data
end

local function utf16(text)
  local out, count = {}, 0
  for _, code in utf8.codes(text) do
    if code >= 0x10000 then
      out[#out + 1] = string.pack(">I2", 0xD800 + (code - 0x10000 >> 10))
      code = 0xDC00 + (code & 0x3FF)
      count = count + 1
    end
    out[#out + 1] = string.pack(">I2", code)
    count = count + 1
  end
  return string.pack(">I4", count) .. table.concat(out)
end

local function psd_mask(mask)
  if not mask then return string.pack(">I4", 0) end
  local more = mask.more or "\0\0"
  return string.pack(">I4i4i4i4i4BB", 18 + #more, mask.y, mask.x, mask.y + mask.h, mask.x + mask.w,
    mask.beyond or 0, mask.flags or mask.off and 2 or 0) .. more
end

--- Appends the record of a layer to `records` and its channels to `data`.
local function psd_layer(layer, painting, records, data)
  local channels, ids = {}, {}
  local function add(id, channel)
    ids[#ids + 1] = string.pack(painting.large and ">i2I8" or ">i2I4", id, #channel)
    channels[#channels + 1] = channel
  end
  local w, h = layer.w or 0, layer.h or 0
  if layer.pixel or painting.are_groups_full then
    add(-1, layer.alpha or psd_channel(layer, w, h, painting, function(x, y)
      return (select(4, layer.pixel(x, y)))
    end))
    for c = 1, painting.grey and 1 or 3 do
      add(c - 1, psd_channel(layer, w, h, painting, function(x, y)
        return (select(c, layer.pixel(x, y)))
      end))
    end
  end
  local mask = layer.mask
  if mask then add(-2, psd_channel(layer, mask.w, mask.h, painting, mask.value)) end
  local name = layer.name:sub(1, 255)
  local short = string.char(#name) .. name
  short = short .. ("\0"):rep(-#short % 4)
  local extra = psd_mask(mask) .. string.pack(">s4", layer.ranges or "") .. short .. tag("luni",
    utf16(layer.name))
    .. (layer.divider and tag("lsct", string.pack(">I4", layer.divider) .. "8BIM"
      .. (layer.blend or "pass")) or "") .. (layer.tags or "")
  records[#records + 1] = string.pack(">i4i4i4i4I2", layer.y or 0, layer.x or 0, (layer.y or 0) + h,
    (layer.x or 0) + w, #ids) .. table.concat(ids) .. "8BIM"
    .. (layer.divider and "norm" or layer.blend or "norm")
    .. string.pack("BBBB", math.floor(255 * (layer.opacity or 1) + 0.5), layer.clipped and 1 or 0,
      layer.visible == false and 2 or 0, 0) .. string.pack(">I4", #extra) .. extra
  data[#data + 1] = table.concat(channels)
end

local function psd_list(list, painting, records, data)
  for _, layer in ipairs(list) do
    if layer.layers then
      psd_layer({ name = "</Layer group>", divider = 3 }, painting, records, data)
      psd_list(layer.layers, painting, records, data)
      psd_layer({ name = layer.name, divider = 1, blend = layer.blend, opacity = layer.opacity,
        visible = layer.visible, mask = layer.mask }, painting, records, data)
    else
      psd_layer(layer, painting, records, data)
    end
  end
end

paintings.tag = tag

--- resources: other bytes that replace the usual ones.
local function psd_resources(painting)
  local profile = painting.profile
  if not profile then return painting.resources or "" end
  return "8BIM" .. string.pack(">I2", 1005) .. "\3abc" .. string.pack(">I4", 3) .. "xyz\0"
    .. "8BIM" .. string.pack(">I2", 1039) .. "\0\0" .. string.pack(">I4", #profile) .. profile
    .. ("\0"):rep(#profile % 2)
end

--- mode: 3 RGB; merged: what follows the layers; large: a PSB, whose sizes have more bytes;
--- are_groups_full: groups have channels, too, without pixels, as Photoshop writes them. For a
--- layer: tags: blocks after its record; ranges: the bytes of its blending ranges. For a mask:
--- flags, and more: bytes after them.
function paintings.psd(painting)
  local records, data = {}, {}
  psd_list(painting.layers or {}, painting, records, data)
  local info = string.pack(">i2", -#records) .. table.concat(records) .. table.concat(data)
  info = info .. ("\0"):rep(#info % 2)
  local is_deep, size = painting.depth == 16, painting.large and ">I8" or ">I4"
  local section = is_deep and string.pack(size .. "I4", 0, 0) .. "8BIMLr16" .. string.pack(size,
    #info) .. info
    or string.pack(size, #info) .. info .. string.pack(">I4", 0)
  if #records == 0 then section = "" end
  local channels = painting.channels or (painting.grey and 1 or 3)
  return "8BPS" .. string.pack(">I2I4I2I2I4I4I2I2", painting.version or painting.large and 2 or 1,
    0, 0, channels, painting.h, painting.w,
      painting.depth or 8, painting.mode or (painting.grey and 1 or 3))
    .. string.pack(">I4", 0) .. string.pack(">s4", psd_resources(painting))
    .. string.pack(size, #section) .. section
    .. (painting.merged or "\0\0" .. ("\0"):rep(channels * painting.w * painting.h
      * ((painting.depth or 8) // 8)))
end

return paintings
