--- Contact sheets of the sample material: every file of its folders of artwork, with its name, for
--- inspection.
--
--   lua5.4 tests/material/contact.lua MATERIAL OUT [FOLDER...]
--
-- with LUA_PATH and LUA_CPATH as for specs.
--
-- Writes OUT/FOLDER-1.png, OUT/FOLDER-2.png, ... A drawing is a picture on a checked background; a
-- layered painting is two: its layers composited by celspan, and the picture merged by the program
-- that made it. A file that cannot be read has the reason in its place, and on standard output.
local celspan = require "celspan"
local layers = require "celspan.layers"
local svg = require "celspan.svg"
local merged = require "tests.support.merged"

local SIDE, CAPTION, COLUMNS, ROWS = 220, 22, 8, 6
local FONT = "../../scripts/type/block.ttf"
local folders = { "artwork-noto", "artwork-openclipart", "artwork-twemoji", "character-matt",
  "parallax-platformer", "psd" }

-- ---------------------------------------------------------------- pictures of a file

--- An object of that size, in the middle of a square of SIDE.
local function fitted(object, x, y, w, h)
  local scale = (SIDE - 16) / math.max(w, h)
  return object:translate(-x - w / 2, -y - h / 2):scale(scale):translate(SIDE / 2, SIDE / 2)
end

local function drawing(path)
  local art, message = svg.read(path)
  if not art then return nil, message end
  local clipped = celspan.clip(art.object, celspan.rect { 0, 0, art.width, art.height })
  return { fitted(clipped, 0, 0, art.width, art.height) }
end

local function picture(path)
  local object = celspan.image { file = path, x = 0, y = 0 }
  local x, y, w, h = object:bounds()
  return { fitted(object, x, y, w, h) }
end

--- The picture merged by Photoshop, if its channels are red, green and blue, or grey.
local function merged_picture(path)
  local good, found = pcall(merged.read, path)
  if not good then return nil end
  local rows = {}
  for y = 0, found.height - 1 do
    local row = {}
    for x = 0, found.width - 1 do
      local k = y * found.width + x
      local red = found[1][k]
      row[#row + 1] = string.char(red, (found[2] or found[1])[k], (found[3] or found[1])[k])
    end
    rows[#rows + 1] = table.concat(row)
  end
  return celspan.image { pixels = table.concat(rows), format = "rgb8", x = 0, y = 0,
    size = { found.width, found.height } }
end

--- Cels over white, as in the merged picture.
local function over_white(cels)
  cels.back = "#fff"
  return celspan.rostrum(cels)
end

local function painting(path)
  local tree, message = layers.read(path)
  if not tree then return nil, message end
  local image = assert(celspan.pixels(over_white(tree:cels()),
    { size = { tree.width, tree.height } }))
  local ours = celspan.image { pixels = image:bytes { depth = 8, colour = "srgb",
    alpha = "straight" },
    format = "rgba8", size = { tree.width, tree.height }, x = 0, y = 0 }
  local list = { fitted(ours, 0, 0, tree.width, tree.height) }
  local theirs = merged_picture(path)
  if theirs then list[2] = fitted(theirs, 0, 0, tree.width, tree.height) end
  for _, note in ipairs(tree.skipped) do
    print(("%s: %s: %s"):format(path, note.layer, note.what))
  end
  return list
end

local readers = { svg = drawing, png = picture, webp = picture, psd = painting, ora = painting,
  kra = painting }

-- ---------------------------------------------------------------- sheets

--- The font has only letters, numbers and a few signs.
local function text_of(text, size, width)
  text = text:gsub("[^%w%.,:;%-]", " ")
  return celspan.text { text, font = FONT, size = size, width = width, texture = "#333" }
end

--- The squares of a file: a list of objects.
local function squares_of(path)
  local read = readers[path:match "%.(%w+)$"]
  local good, list, message = pcall(read, path)
  if good and list then return list end
  message = tostring(good and message or list):gsub("^.*/", "")
  print(path .. ": " .. message)
  return { text_of(message, 13, SIDE - 24):translate(12, 40) }
end

local function checks()
  local list = {}
  for y = 0, SIDE - 1, 20 do
    for x = (y // 20 % 2) * 20, SIDE - 1, 40 do
      list[#list + 1] = celspan.rect { x, y, 20, 20, texture = "#dedede" }
    end
  end
  return celspan.union { celspan.rect { 0, 0, SIDE, SIDE, texture = "#f2f2f2" },
    celspan.union(list) }
end

--- As much of the end of a name as fits.
local function caption_of(name) return #name > 27 and "..." .. name:sub(-25) or name end

local function write_sheet(squares, path)
  local rows = (#squares + COLUMNS - 1) // COLUMNS
  local w, h = COLUMNS * (SIDE + 8), rows * (SIDE + CAPTION + 8)
  local ground, art = checks(), {}
  for i, square in ipairs(squares) do
    local x, y = (i - 1) % COLUMNS * (SIDE + 8) + 4, (i - 1) // COLUMNS * (SIDE + CAPTION + 8) + 4
    art[#art + 1] = celspan.union { ground, square.object }:translate(x, y)
    art[#art + 1] = text_of(caption_of(square.name), 14):translate(x, y + SIDE + 4)
  end
  assert(celspan.render(celspan.rostrum { celspan.cel(art), back = "#fff", size = { w, h } }, path,
    { size = { w, h } }))
  print(path)
end

local function write_sheets(material, folder, out)
  local squares, count = {}, 0
  local find =
    assert(io.popen(("cd '%s/%s' && find . -type f | LC_ALL=C sort"):format(material, folder)))
  for line in find:lines() do
    local name = line:sub(3)
    if readers[name:match "%.(%w+)$"] then
      for i, object in ipairs(squares_of(("%s/%s/%s"):format(material, folder, name))) do
        squares[#squares + 1] = { name = i == 1 and name or "as it was merged", object = object }
      end
    end
  end
  find:close()
  while count * COLUMNS * ROWS < #squares do
    local first = count * COLUMNS * ROWS + 1
    count = count + 1
    write_sheet(table.move(squares, first, math.min(#squares, count * COLUMNS * ROWS), 1, {}),
      ("%s/%s-%d.png"):format(out, folder, count))
  end
end

local material, out = arg[1], arg[2]
assert(out, "usage: contact.lua MATERIAL OUT [FOLDER...]")
for _, folder in ipairs(#arg > 2 and table.move(arg, 3, #arg, 1, {}) or folders) do
  write_sheets(material, folder, out)
end
