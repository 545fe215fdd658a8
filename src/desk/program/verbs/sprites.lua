--- celspan sprites SCRIPT -o SHEET: the frames of a film on one sheet for games, without what is
--- clear around them, and an atlas that says where each is.
--
--   frame            sheet.png                sheet.json, in the hash form of TexturePacker
--   +--------+       +---------------+        frame             its place on the sheet
--   |   ##   |       |######|###|    |        spriteSourceSize  its place in the frame, and size
--   |  ####  |  -->  |######|###|    |        sourceSize        the size of the frame
--   +--------+       +---------------+        duration          milliseconds
--
-- Sprites stand in shelves, the highest first. Frames that show the same share a sprite. Of a frame
-- only the sprite is kept, and the sheet is made row by row.
local program, request = ...
local celspan = require "celspan"

local BYTES = 4 -- bytes of a pixel
local SHEET_MOST = 16384 -- pixels a side, which graphics cards take
local PIXELS_MOST = 2 ^ 26 -- all sprites together, because all are in memory at once
local ROOM = 1.1 -- more than the sprites, for what shelves leave free
local workers = math.tointeger(request.workers)
local gap = math.tointeger(request.padding) or 2

-- ---------------------------------------------------------------- sprites

--- The first and the last pixel of a row that is not clear, from 0; nil if all are.
local function ends_of(row)
  if not row:find "[^\0]" then return nil end
  local alphas = row:gsub("...(.)", "%1")
  local first = alphas:find "[^\0]"
  return first and first - 1, first and #alphas - alphas:reverse():find "[^\0]"
end

--- The least box { x, y, w, h } of what is drawn in rows of pixels; a pixel if nothing is.
local function box_of(bytes, width, height)
  local stride, left, right, top, bottom = width * BYTES, width, -1, nil, nil
  for y = 0, height - 1 do
    local first, last = ends_of(bytes:sub(y * stride + 1, (y + 1) * stride))
    if first then
      left, right = math.min(left, first), math.max(right, last)
      top, bottom = top or y, y
    end
  end
  if not top then return { 0, 0, 1, 1 } end
  return { left, top, right - left + 1, bottom - top + 1 }
end

--- The pixels of a box.
local function cut_out(bytes, width, box)
  local rows = {}
  for y = box[2], box[2] + box[4] - 1 do
    local at = (y * width + box[1]) * BYTES
    rows[#rows + 1] = bytes:sub(at + 1, at + box[3] * BYTES)
  end
  return table.concat(rows)
end

--- The sprites of a film, and for each of its frames { sprite =, box = }.
local function read_frames(script, numbers, size)
  local sprites, frames, known, pixels = {}, {}, {}, 0
  program.count_frames(#numbers)
  for i, number in ipairs(numbers) do
    local image = program.check(celspan.pixels(program.still(script, script:at(number)),
      { size = size, workers = workers }))
    local bytes = image:bytes()
    local box = box_of(bytes, size[1], size[2])
    local art = cut_out(bytes, size[1], box)
    local alike = known[box[3]] or {} -- by their pixels, of which there is no second copy
    if not alike[art] then
      alike[art] = { w = box[3], h = box[4], bytes = art, place = #sprites + 1 }
      sprites[#sprites + 1] = alike[art]
      pixels = pixels + box[3] * box[4]
    end
    known[box[3]] = alike
    if pixels > PIXELS_MOST then
      program.fail("limit", "up to frame %d the sprites have more than %d pixels, which is the "
        .. "limit: give fewer --frames, or a smaller --scale or --size", number, PIXELS_MOST)
    end
    frames[i] = { sprite = alike[art], box = box, number = number }
    program.made_frame(number, request.output)
  end
  return sprites, frames
end

-- ---------------------------------------------------------------- the sheet

local function is_before(one, other)
  if one.h ~= other.h then return one.h > other.h end
  if one.w ~= other.w then return one.w > other.w end
  return one.place < other.place
end

--- Gives each sprite its x and y. Returns the size of the sheet.
local function lay_out(sprites)
  local area, widest, order = 0, 0, table.move(sprites, 1, #sprites, 1, {})
  for _, one in ipairs(sprites) do
    area, widest = area + (one.w + gap) * (one.h + gap), math.max(widest, one.w)
  end
  table.sort(order, is_before)
  local most = math.max(widest + 2 * gap, math.ceil(math.sqrt(area * ROOM)))
  local x, y, shelf, width = gap, gap, order[1].h, 0
  for _, one in ipairs(order) do
    if x + one.w + gap > most then
      x, y, shelf = gap, y + shelf + gap, one.h
    end
    one.x, one.y = x, y
    x = x + one.w + gap
    width = math.max(width, x)
  end
  return { width, y + shelf + gap }
end

local function write_sheet(sprites, size, output)
  local images = { antialias = "none" }
  for i, one in ipairs(sprites) do
    images[i] = celspan.cel { celspan.image { x = one.x, y = one.y, w = one.w, h = one.h,
      size = { one.w, one.h }, format = "rgba8", pixels = one.bytes } }
  end
  program.check(celspan.render(celspan.rostrum(images), output, { size = size, depth = 8,
    workers = workers }))
end

-- ---------------------------------------------------------------- the atlas

local function rectangle(x, y, w, h) return { x = x, y = y, w = w, h = h } end

--- The milliseconds of the frame in this place: together they are as long as the film.
local function duration_of(script, place)
  local function until_frame(count) return math.floor(count * 1000 / script.fps + 0.5) end
  return until_frame(place) - until_frame(place - 1)
end

local function atlas_of(script, frames, size, sheet, output)
  local stem, listed = output:match "([^/]*)%.[^./]*$", {}
  for i, one in ipairs(frames) do
    local box, sprite = one.box, one.sprite
    listed[("%s.%04d.png"):format(stem, one.number)] = {
      frame = rectangle(sprite.x, sprite.y, sprite.w, sprite.h), rotated = false,
      trimmed = box[3] < size[1] or box[4] < size[2],
      spriteSourceSize = rectangle(table.unpack(box)), sourceSize = { w = size[1], h = size[2] },
      duration = duration_of(script, i) }
  end
  return { frames = listed, meta = { app = "celspan", version = celspan._VERSION:match "%S+$",
    image = output:match "[^/]*$", format = "RGBA8888", scale = ("%g"):format(request.scale or 1),
    size = { w = sheet[1], h = sheet[2] } } }
end

local function make_sprites(script, output)
  local size = { script:view_size() }
  local sprites, frames = read_frames(script, script:numbers(), size)
  local sheet = lay_out(sprites)
  if math.max(sheet[1], sheet[2]) > SHEET_MOST then
    program.fail("limit", "%s: the sheet would have %d x %d pixels, and at most %d a side: give "
      .. "fewer --frames, or a smaller --scale or --size", output, sheet[1], sheet[2], SHEET_MOST)
  end
  write_sheet(sprites, sheet, output)
  program.save((output:gsub("%.[^./]*$", ".json")),
    program.json(atlas_of(script, frames, size, sheet, output)) .. "\n")
end

if not request.output then program.usage "-o is missing: give -o sheet.png" end
if not program.has_ending(request.output, ".png", ".tga", ".tif", ".tiff") then
  program.usage("%s: sprites need alpha without loss: give a name such as sheet.png",
    request.output)
end
program.refuse_target(request.output)
make_sprites(program.script(), request.output)
