--- Lottie animations for tests: documents written as tables, and dotLottie archives.
local celspan = require "celspan"
local lottie = require "celspan.lottie"
local stored = require "tests.support.stored"

local lotties = {}

--- JSON of a table: a list if it has [1] or is empty; an object otherwise. Texts that begin with
--- "=" are written as they are, without it.
function lotties.json(value)
  if type(value) == "string" and value:sub(1, 1) == "=" then return value:sub(2) end
  if type(value) == "string" then
    return '"' .. value:gsub('[%c"\\]', function(c) return ("\\u%04x"):format(c:byte()) end) .. '"'
  end
  if type(value) == "number" then return ("%.14g"):format(value) end
  if type(value) ~= "table" then return tostring(value) end
  local parts = {}
  if value[1] ~= nil or next(value) == nil then
    for i, item in ipairs(value) do parts[i] = lotties.json(item) end
    return "[" .. table.concat(parts, ",") .. "]"
  end
  local names = {}
  for name in pairs(value) do names[#names + 1] = name end
  table.sort(names)
  for i, name in ipairs(names) do
    parts[i] = lotties.json(name) .. ":" .. lotties.json(value[name])
  end
  return "{" .. table.concat(parts, ",") .. "}"
end

--- A value without keys, and a list of keys { t, value, h = }.
function lotties.still(value) return { a = 0, k = value } end

function lotties.keys(list)
  local keys = {}
  for i, one in ipairs(list) do
    local value = one[2]
    keys[i] = { t = one[1], s = type(value) == "table" and value or { value },
      h = one.h and 1 or 0 }
  end
  return { a = 1, k = keys }
end

--- A shape layer; fields are added.
function lotties.layer(shapes, fields)
  local layer = { ty = 4, ip = 0, op = 100, st = 0, ks = {}, shapes = shapes, nm = "art" }
  for name, value in pairs(fields or {}) do layer[name] = value end
  return layer
end

--- A rectangle about 0, 0 and a fill.
function lotties.box(w, h, colour)
  return { ty = "rc", p = { k = { 0, 0 } }, s = { k = { w, h } }, r = { k = 0 } },
    { ty = "fl", c = { k = colour or { 1, 0, 0, 1 } }, o = { k = 100 } }
end

--- A document 100 by 100 with 100 frames at 25 a second.
function lotties.document(layers, fields)
  local document = { v = "5.7.0", fr = 25, ip = 0, op = 100, w = 100, h = 100, layers = layers }
  for name, value in pairs(fields or {}) do document[name] = value end
  return document
end

--- A reader for documents of layers and fields, which are written to a workbench.
---@return fun(layers: table[], fields?: table, options?: table): any art, string? message
---@return fun(what: string|table, ending?: string): string path
function lotties.reader(bench)
  local count = 0
  local function write(what, ending)
    count = count + 1
    local text = type(what) == "table" and lotties.json(what) or what
    return bench:write(("%d.%s"):format(count, ending or "json"), text)
  end
  return function(layers, fields, options)
    return lottie.read(write(lotties.document(layers, fields)), options)
  end, write
end

--- The code of a point of an animation at a frame: "ff0000 255".
function lotties.code(art, frame, x, y)
  local r, g, b, a = celspan.probe(celspan.rostrum { celspan.cel { art:at(frame) } }, x, y,
    { film = { 100, 100 } })
  local function code(c)
    c = a > 0 and c / a or 0
    c = c <= 0.0031308 and 12.92 * c or 1.055 * c ^ (1 / 2.4) - 0.055
    return math.floor(255 * math.min(1, math.max(0, c)) + 0.5)
  end
  return ("%02x%02x%02x %d"):format(code(r), code(g), code(b), math.floor(255 * a + 0.5))
end

--- A deflate stream of 65 MiB of one letter, in 430 kB: a code of the fixed table stands for 258
--- more of it.
function lotties.bomb()
  local again, bits = "1100010100000", "1" .. "10" .. "10101000"
  local function bytes(text)
    return (text:gsub("........", function(eight)
      return string.char(tonumber(eight:reverse(), 2))
    end))
  end
  return bytes(bits .. again) .. bytes(again:rep(8)):rep(33024)
end

--- A zip archive of members { name, text }, stored, or { name, bytes, 8 }, deflated.
function lotties.archive(members)
  local files, entries, at = {}, {}, 0
  for _, member in ipairs(members) do
    local name, text, method = member[1], member[2], member[3] or 0
    local facts = string.pack("<I4I4I4I2I2", stored.crc32(text), #text, #text, #name, 0)
    local how = string.pack("<I2I2I2I2I2", 20, 0, method, 0, 0)
    local file = "PK\3\4" .. how .. facts .. name .. text
    entries[#entries + 1] = "PK\1\2" .. string.pack("<I2", 20) .. how .. facts
      .. string.pack("<I2I2I2I4I4", 0, 0, 0, 0, at) .. name
    files[#files + 1], at = file, at + #file
  end
  local list = table.concat(entries)
  return table.concat(files) .. list
    .. "PK\5\6" .. string.pack("<I2I2I2I2I4I4I2", 0, 0, #members, #members, #list, at, 0)
end

return lotties
