--- The letters of a text of Lottie, each at its place: from outlines in the file (`chars`), or from
--- the fonts that the reader is given.
--
--   letter: x, y (its start on the baseline), advance, text, line, and an object or outlines
local celspan = require "celspan"
local contours = require "celspan.lottie_contour"
local values = require "celspan.lottie_values"

local letters = {}

local MOST = 20000 -- letters of a text
local LEADING = 1.2 -- times the size, where the file has none

-- ---------------------------------------------------------------- outlines in the file

--- Adds the outlines of a list of shapes.
local function collect(list, found)
  for _, one in ipairs(values.items(list)) do
    local item = one[2]
    if values.table(item.it) then collect(item.it, found) end
    local path = item.ty == "sh" and values.table(item.ks)
    if path then
      local k = values.table(path.k)
      -- some files say that the outlines of letters are open
      local outline = contours.read(k and (values.table(k[1]) or k), true, true)
      if #outline > 0 then found[#found + 1] = outline end
    end
  end
end

--- The outlines of a file by family, style and character.
function letters.table_of(document)
  local by_name = {}
  for _, one in ipairs(values.items(document.chars)) do
    local char = one[2]
    if type(char.ch) == "string" then
      local found, data = {}, values.table(char.data)
      collect(data and data.shapes, found)
      local key = ("%s\0%s\0%s"):format(tostring(char.fFamily), tostring(char.style), char.ch)
      by_name[key] = { outlines = found, advance = values.number(char.w, 0) / 100 }
    end
  end
  return by_name
end

--- The fonts of a file by the names that texts use.
function letters.fonts_of(document)
  local fonts = {}
  local list = values.table(document.fonts)
  for _, one in ipairs(values.items(list and list.list)) do
    if type(one[2].fName) == "string" then fonts[one[2].fName] = one[2] end
  end
  return fonts
end

-- ---------------------------------------------------------------- letters of a line

--- A letter of the file's own; nil: the file has no outline of this character.
local function own_letter(root, font, char, size)
  local glyph = root.chars[("%s\0%s\0%s"):format(tostring(font.fFamily), tostring(font.fStyle),
    char)]
  if not glyph then return nil end
  return { text = char, advance = glyph.advance * size, outlines = glyph.outlines,
           scale = size / 100 }
end

--- The file of a font: by family and style, by family, or the one for all others.
local function font_file(root, font)
  local family, style = tostring(font.fFamily), tostring(font.fStyle)
  return root.font_files[family .. " " .. style] or root.font_files[family]
    or root.font_files[tostring(font.fName)] or root.font_files.default
end

--- Players place letter by letter, without the font's kerning and ligatures.
local plain = { kern = false, liga = false }

--- The letters of a text from a font file; nil and why there are none.
local function of_font(root, font, text, size)
  local file, line = font_file(root, font), {}
  if not file then
    local name = values.name(font.fFamily, "the text") .. " " .. values.name(font.fStyle, "")
    return nil, ("no font is given for '%s'"):format((name:gsub(" $", "")))
  end
  local good, glyphs = pcall(celspan.glyphs, { text, font = file, size = size, features = plain })
  if not good then return nil, tostring(glyphs) end
  for i, glyph in ipairs(glyphs) do
    line[i] = { text = glyph.text, advance = glyph.advance, object = glyph.object, from = glyph.x }
  end
  return line
end

--- Adds a character that the outlines in the file lack, from a font or as nothing.
local function add_missing(root, font, char, size, line)
  for _, letter in ipairs(of_font(root, font, char, size) or {}) do line[#line + 1] = letter end
end

--- The letters of a line from the outlines in the file. Returns also the characters that it lacks;
--- nil: it lacks all.
local function of_outlines(root, font, text, size)
  local line, missing, has_any = {}, {}, false
  for _, code in utf8.codes(text) do
    local char = utf8.char(code)
    local letter = own_letter(root, font, char, size)
    has_any = has_any or letter ~= nil
    if letter then
      line[#line + 1] = letter
    else
      add_missing(root, font, char, size, line)
      missing[#missing + 1] = char
    end
  end
  if has_any then return line, table.concat(missing) end
end

--- The letters of a line without line ends.
local function line_of(root, font, text, size, note)
  if text == "" then return {} end
  local line, missing = nil, ""
  if next(root.chars) then line, missing = of_outlines(root, font, text, size) end
  if not line then return of_font(root, font, text, size) end
  if missing ~= "" then
    note(("the file has no outlines of '%s'; %s"):format(values.name(missing, "?"),
      font_file(root, font) and "they are those of the font that is given" or "they are left out"))
  end
  return line
end

-- ---------------------------------------------------------------- lines

local function width_of(line, tracking)
  local width = 0
  for _, letter in ipairs(line) do width = width + letter.advance + tracking end
  return #line > 0 and width - tracking or 0
end

--- Breaks a line into lines that fit a width, at spaces.
local function wrap(line, width, tracking)
  local lines, start, x, last_space = {}, 1, 0, nil
  local i = 1
  while i <= #line do
    local letter = line[i]
    if letter.text == " " then last_space = i end
    if x + letter.advance > width and last_space and last_space >= start and letter.text ~= " " then
      lines[#lines + 1] = table.move(line, start, last_space - 1, 1, {})
      start, i, x, last_space = last_space + 1, last_space, 0, nil
    else
      x = x + letter.advance + tracking
    end
    i = i + 1
  end
  lines[#lines + 1] = table.move(line, start, #line, 1, {})
  return lines
end

--- The texts between line ends, which are CR, LF, CR LF and U+0003.
local function split(text)
  local parts = {}
  text = text:gsub("\r\n", "\n"):gsub("[\r\3]", "\n")
  for part in (text .. "\n"):gmatch "(.-)\n" do parts[#parts + 1] = (part:gsub("%c", "")) end
  return parts
end

local shares = { [0] = 0, 1, 0.5 } -- of the free width that lies before a line

--- Puts the letters of a line in their places, from x on.
local function place(line, number, x, y, tracking, out)
  for _, letter in ipairs(line) do
    letter.x, letter.y, letter.line = x, y, number
    x = x + letter.advance + tracking
    out[#out + 1] = letter
  end
end

--- The letters of a document of a text.
---@param root table
---@param given table s, f, t, j, tr, lh, ls, sz, ps, ca
---@param note fun(what: string)
---@return table[]
function letters.lay(root, given, note)
  local text = values.text(given.t, "")
  if not utf8.len(text) or #text > 4 * MOST then
    note "the text is no UTF-8, or too long; it is left out"
    return {}
  end
  if given.ca == 1 then text = text:upper() end
  local size, font = math.max(0, values.number(given.s, 12)),
    root.fonts[given.f] or { fFamily = given.f }
  local tracking = values.number(given.tr, 0) * size / 1000
  local leading = values.number(given.lh, 0)
  local box = values.table(given.sz) and values.list(given.sz, { 0, 0 }, 2)
  local corner = values.list(given.ps, { 0, 0 }, 2)
  local out, number, width = {}, 0, box and box[1] or 0
  if leading == 0 then leading = LEADING * size end
  local top = box and corner[2] + values.number(font.ascent, 75) / 100 * size or 0
  for _, part in ipairs(split(text)) do
    local line, message = line_of(root, font, part, size, note)
    if not line then
      note(message)
      return {}
    end
    for _, one in ipairs(box and wrap(line, width, tracking) or { line }) do
      local free = width - width_of(one, tracking)
      local x = (box and corner[1] or 0) + free * (shares[values.number(given.j, 0) % 3] or 0)
      place(one, number + 1, x, top + number * leading - values.number(given.ls, 0), tracking, out)
      number = number + 1
    end
  end
  return out
end

--- The object of a letter at 0, 0, filled or as a stroke { width =, texture = }.
function letters.object(letter, texture, stroke)
  if letter.outlines then
    if #letter.outlines == 0 then return nil end
    local k = letter.scale
    local fields = { contours = letter.outlines, texture = texture, width = stroke and stroke / k }
    return (stroke and celspan.stroke or celspan.path)(fields):scale(k)
  end
  local object = letter.object
  object = stroke and object:stroke { width = stroke, texture = texture }
    or object:with { texture = texture }
  return object:translate(-letter.from, 0)
end

return require "celspan.fields".seal("lottie_letters", letters)
