--- Palettes of painting programs as tables of colours by name, { skin = "#f2c6a0" }.
--
--   file --by its ending--> a reader of its format --each colour--> add --> the table
--
-- A colour without a name is named by its code, "#f2c6a0". Two different colours of one name are
-- refused, and a colour that cannot be seen at all is left out: Toonz begins a palette with one.
--
-- What is not RGB is converted: CMYK plainly, without a profile, and Lab and XYZ of D50, as Adobe
-- and ICC have them, with the matrix of Bruce Lindbloom (adapted after Bradford).
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local json = require "celspan.json"

local palette_files = {}

local MOST_BYTES = 16 * 1024 * 1024

local function fail(text, ...) error({ message = text:format(...) }, 0) end

-- ---------------------------------------------------------------- colours

local function byte(x) return math.floor(255 * math.max(0, math.min(1, x)) + 0.5) end

local function rgb(r, g, b)
  if r ~= r or g ~= g or b ~= b then fail "a colour has a number that is not finite" end
  return ("#%02x%02x%02x"):format(byte(r), byte(g), byte(b))
end

local function grey(g) return rgb(g, g, g) end

local function cmyk(c, m, y, k)
  return rgb((1 - c) * (1 - k), (1 - m) * (1 - k), (1 - y) * (1 - k))
end

local function light(r, g, b) return rgb(native.code(r), native.code(g), native.code(b)) end

local function lab(lightness, a, b)
  local y = (lightness + 16) / 116
  local function part(t) return t > 6 / 29 and t ^ 3 or 3 * (6 / 29) ^ 2 * (t - 4 / 29) end
  local X, Y, Z = 0.96422 * part(y + a / 500), part(y), 0.82521 * part(y - b / 200)
  return light(3.1338561 * X - 1.6168667 * Y - 0.4906146 * Z,
    -0.9787684 * X + 1.9161415 * Y + 0.0334540 * Z, 0.0719453 * X - 0.2289914 * Y + 1.4052427 * Z)
end

-- ---------------------------------------------------------------- texts

local function read_gpl(text, add)
  if not text:find "^GIMP Palette" then fail "it does not begin with 'GIMP Palette'" end
  local has_alpha, number = text:find "\nChannels:%s*RGBA", 0
  for line in (text .. "\n"):gmatch "(.-)\r?\n" do
    number = number + 1
    if number > 1 and line:find "%S" and not line:find "^%s*#" and not line:find "^%a+:" then
      local r, g, b, rest = line:match "^%s*(%d+)%s+(%d+)%s+(%d+)%s*(.*)$"
      if has_alpha and rest then rest = rest:match "^%d+%s*(.*)$" end
      if not rest or tonumber(r) > 255 or tonumber(g) > 255 or tonumber(b) > 255 then
        fail("line %d is no colour: three numbers from 0 to 255, and a name", number)
      end
      add(rest:match "^(.-)%s*$", rgb(r / 255, g / 255, b / 255))
    end
  end
end

local entities = { amp = "&", lt = "<", gt = ">", quot = '"', apos = "'" }

local function unescape(text)
  return (text:gsub("&(#?)(x?)(%w+);", function(sign, base, name)
    local point = sign == "#" and tonumber(name, base == "x" and 16 or 10)
    return point and point < 0x110000 and utf8.char(point) or entities[base .. name]
  end))
end

local function attribute(text, name)
  local value = text:match("%s" .. name .. '%s*=%s*"([^"]*)"')
    or text:match("%s" .. name .. "%s*=%s*'([^']*)'")
  return value and unescape(value)
end

--- How Krita's elements become colours; each has the names of its numbers.
local krita = { sRGB = { rgb, "r", "g", "b" }, RGB = { rgb, "r", "g", "b" },
                Gray = { grey, "g" },
                CMYK = { cmyk, "c", "m", "y", "k" } }

local function krita_colour(name, kind, text)
  local known, space = krita[kind], attribute(text, "space") or ""
  local is_linear = kind == "RGB" and space:find "^sRGB.*g10"
  if not known or kind == "RGB" and space ~= "" and not is_linear and not space:find "^sRGB" then
    fail("the colour '%s' is %s%s; make it an sRGB colour in Krita", name, kind,
      space ~= "" and " of the space '" .. space .. "'" or "")
  end
  local numbers = {}
  for i = 2, #known do
    numbers[i - 1] = fields.read_number(attribute(text, known[i]) or "")
      or fail("the colour '%s' has no number '%s'", name, known[i])
  end
  return (is_linear and light or known[1])(table.unpack(numbers))
end

local function read_kpl(text, add)
  text = text:gsub("<!%-%-.-%-%->", "")
  if not text:find "<ColorSet[%s>]" or not text:find "</ColorSet>%s*$" then
    fail "its colorset.xml is no whole colour set of Krita"
  end
  for start, inside in text:gmatch "<ColorSetEntry(%s[^<>]*[^/<>])>(.-)</ColorSetEntry>" do
    local name = attribute(start, "name") or ""
    local kind, numbers = inside:match "<(%a+)(%s[^<>]*)/?>"
    if not kind then fail("the colour '%s' has no numbers", name) end
    add(name, krita_colour(name, kind, numbers))
  end
end

--- The words of a style: bare ones, and others in quotes, with a backslash before marks.
local function toonz_words(text)
  text = text:gsub("\\(.)", function(mark) return ("&#%d;"):format(mark:byte()) end)
  local words, at = {}, text:match "^%s*()"
  while at <= #text do
    local quoted, after = text:match('^"([^"]*)"%s*()', at)
    if not quoted then quoted, after = text:match('^([^"%s]%S*)%s*()', at) end
    if not quoted then fail "a name of a style does not end" end
    words[#words + 1], at = unescape(quoted), after
  end
  return words
end

local FLAT = "3" -- the number of a style of one colour; textures and others are left out

--- The name may follow flags, "_1", and for a colour of a studio palette "|global" and "@original".
local function read_tpl(text, add)
  if not text:find "<palette[%s>]" or not text:find "</palette>%s*$" then
    fail "it is no whole palette of Toonz"
  end
  for inside in text:gmatch "<style>(.-)</style>" do
    local words, at = toonz_words(inside), 1
    if words[at] and words[at]:find "^_%d$" then at = at + 1 end
    if words[at] and words[at]:find "^|" then at = at + 1 end
    if at > 1 and words[at] and words[at]:find "^@" then at = at + 1 end
    local name, kind = (words[at] or ""):gsub("^_([%d_])", "%1"), words[at + 1]
    if not kind then fail("the style '%s' has no kind", name) end
    if kind == FLAT then
      local r, g, b = tonumber(words[at + 2]), tonumber(words[at + 3]), tonumber(words[at + 4])
      if not b then fail("the style '%s' is no colour of three or four numbers", name) end
      if words[at + 5] ~= "0" then add(name, rgb(r / 255, g / 255, b / 255)) end
    end
  end
end

local function read_json(text, add)
  local value, message = json.decode(text)
  if type(value) ~= "table" then fail("%s", message or "it is no object of colours by name") end
  local seen, names = {}, {}
  for name in text:gmatch '"([^"\\]*)"%s*:' do
    if seen[name] then fail("the name '%s' is there twice", name) end
    seen[name] = true
  end
  for name, paint in next, value do
    local good = type(name) == "string" and type(paint) == "string" and pcall(celspan.rgb, paint)
    if not good then fail("'%s' must be a colour, such as \"#f2c6a0\"", fields.key(name)) end
    names[#names + 1] = name
  end
  table.sort(names)
  for _, name in ipairs(names) do add(name, native.hex(value[name])) end
end

-- ---------------------------------------------------------------- bytes

--- A function that reads the next values of a text by a format of string.unpack.
local function reader(text)
  local at = 1
  return function(format, size)
    size = size or string.packsize(format)
    if size > #text - at + 1 then fail("it ends after %d bytes, within a colour", #text) end
    at = at + size
    return string.unpack(format, text, at - size)
  end
end

--- The text of UTF-16, the greater byte first, up to its zero: JSON has its units, too.
local function utf16(bytes)
  local units = bytes:gsub("(.)(.)", function(high, low)
    return ("\\u%02x%02x"):format(high:byte(), low:byte())
  end)
  return json.decode('"' .. (units:match "^(.-)\\u0000" or units) .. '"')
end

local adobe = { ["RGB "] = { ">fff", rgb }, CMYK = { ">ffff", cmyk }, Gray = { ">f", grey },
  ["LAB "] = { ">fff", function(l, a, b) return lab(100 * l, a, b) end } }
local COLOUR = 1 -- the kind of a block; others begin and end groups

local function read_ase(text, add)
  local take = reader(text)
  if text:sub(1, 4) ~= "ASEF" then fail "it does not begin with 'ASEF'" end
  local _, _, _, count = take ">I4I2I2I4"
  for i = 1, count do
    local kind, size = take ">I2I4"
    local block = reader(take("c" .. size, size))
    if kind == COLOUR then
      local length = 2 * block ">I2"
      local name = utf16(block("c" .. length, length))
      local model = adobe[block "c4"] or fail("block %d, '%s', has an unknown model", i, name)
      add(name, model[2](block(model[1])))
    end
  end
end

--- A space of colours: how its numbers are stored, by what they are divided, and their function.
local function space(format, scale, make)
  return function(bytes)
    local numbers = { format:unpack(bytes) }
    for i, number in ipairs(numbers) do numbers[i] = number / scale end
    return make(table.unpack(numbers))
  end
end

--- The spaces of Photoshop's swatches, by their numbers.
local swatches = { [0] = space(">I2I2I2", 65535, rgb), [7] = space(">I2i2i2", 100, lab),
  [2] = space(">I2I2I2I2", 65535, function(c, m, y, k)
    return cmyk(1 - c, 1 - m, 1 - y, 1 - k)
  end),
  [8] = space(">I2", 10000, function(g) return grey(1 - g) end),
  [9] = space(">I2I2I2I2", 10000, cmyk) }

--- Two lists of the same colours: the second one, which old files do not have, has names.
local function read_aco(text, add)
  local take = reader(text)
  local version, count = take ">I2I2"
  if version == 1 and #text > 4 + 10 * count then
    take("c" .. 10 * count, 10 * count)
    version, count = take ">I2I2"
  end
  if version ~= 1 and version ~= 2 then fail "it is no file of swatches of version 1 or 2" end
  for i = 1, count do
    local number, bytes = take ">I2c8"
    local length = version == 2 and 2 * take ">I4" or 0
    local name = utf16(take("c" .. length, length))
    local make = swatches[number]
      or fail("colour %d, '%s', has the unknown space %d", i, name, number)
    add(name, make(bytes))
  end
end

-- ---------------------------------------------------------------- files

local formats = { gpl = read_gpl, kpl = read_kpl, ase = read_ase, aco = read_aco, tpl = read_tpl,
                  json = read_json }

--- A function that puts a colour into `palette`.
local function adder(palette)
  return function(name, paint)
    if name == "" or name == "Untitled" then name = paint end
    if palette[name] and palette[name] ~= paint then
      fail("the name '%s' is there twice, for %s and for %s", name, palette[name], paint)
    end
    palette[name] = paint
  end
end

local function read(path)
  local format = formats[(path:match "%.(%w+)$" or ""):lower()]
  if not format then
    return nil, path .. ": a palette is a .gpl, .kpl, .ase, .aco, .tpl or .json file"
  end
  local is_archive = format == read_kpl
  local text, message = (is_archive and native.archive or files.read)(path,
    is_archive and "colorset.xml" or MOST_BYTES, MOST_BYTES)
  if not text then return nil, message end
  local palette = {}
  local _, problem = fields.caught(format, text, adder(palette))
  if problem then return nil, ("%s: %s"):format(path, problem) end
  if next(palette) == nil then return nil, path .. ": the palette has no colours" end
  return palette
end

--- The colours of a file, found as all files that scripts name.
---@param path string
---@return table<string, string>? colours "#rrggbb" by name
---@return string? message
function palette_files.read(path) return files.found(path, read) end

return palette_files
