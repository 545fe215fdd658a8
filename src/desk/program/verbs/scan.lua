--- celspan scan PATTERN -o OUT: scanned drawings, registered by their peg holes, and cleaned.
--
--   OUT          level.0007.png        all inks of drawing 7
--   with inks    level.red.0007.png    each ink alone
--   --contact    a panel for each drawing: its lines, the page, and where its scan lies on it
local program, request = ...
local celspan = require "celspan"
local native = require "celspan.native"
local scan = require "celspan.ink_scan"
local number_at = program.part "numerals.lua"

local PANEL, COLUMNS, GAP, LABEL = 360, 4, 12, 44 -- pixels
local output = request.output

-- ---------------------------------------------------------------- options

local pegs = { acme = "acme", none = false }

local function inks_of(text)
  local inks = {}
  for _, part in ipairs(program.split(text)) do
    local name, colour = part:match "^([%w_-]+)=(.+)$"
    if not name or inks[name] or not program.colour(colour) then
      program.usage("--ink: '%s' is not a new NAME=COLOUR, such as red=#c33", part)
    end
    inks[name] = colour
  end
  return inks
end

local function levels_of(text)
  local list = program.split(text)
  local black, white = tonumber(list[1]), tonumber(list[2])
  if #list ~= 2 or not black or not white or not (0 <= black and black < white and white <= 1) then
    program.usage("--levels: '%s' is not A,B with 0 <= A < B <= 1, such as 0.2,0.9", text)
  end
  return { black, white }
end

local function options_of()
  local kind, dpi = request.pegs or "acme", tonumber(request.dpi)
  if pegs[kind] == nil then program.usage("--pegs: '%s' is neither acme nor none", kind) end
  if request.match and pegs[kind] and request.pegs then
    program.usage "--match goes without pegs: leave --pegs out"
  end
  if dpi and (dpi < 30 or dpi > 4800) then
    program.usage("--dpi: '%s' is not from 30 to 4800", request.dpi)
  end
  return { pegs = not request.match and pegs[kind] or false, match = request.match, dpi = dpi,
    levels = request.levels and levels_of(request.levels), frames = request.frames,
    ink = request.ink and inks_of(request.ink), dust = math.tointeger(request.dust) }
end

-- ---------------------------------------------------------------- files

--- The pattern for one ink: its name before the number.
local function pattern_of(name) return (output:gsub("%.?#+[^/]*$", "." .. name .. "%0", 1)) end

local function write(texture, drawing, pattern, number)
  local w, h = drawing.width, drawing.height
  program.write(celspan.rostrum { size = { w, h }, antialias = "none", celspan.cel { texture } },
    program.check(native.frame_name(pattern, number)))
end

local function write_all(drawing, number)
  write(drawing.object, drawing, output, number)
  for name, texture in pairs(drawing.colours) do
    write(celspan.rect { 0, 0, drawing.width, drawing.height, texture = texture }, drawing,
      pattern_of(name), number)
  end
end

-- ---------------------------------------------------------------- how each was moved

--- A rectangle's outline, of a width in units.
local function outline(w, h, width, colour)
  return celspan.stroke { d = ("M0 0 H%d V%d H0 Z"):format(w, h), width = width, texture = colour }
end

--- The panel of a drawing as an image: what was scanned is white, and has a red rim; the page has a
--- grey one.
local function panel_of(drawing)
  local w, h, offset = drawing.width, drawing.height, drawing.offset
  local scale = PANEL / math.max(w, h)
  local size = { math.max(1, w * scale // 1), math.max(1, h * scale // 1) }
  local function moved(object)
    return object:rotate(drawing.turned, w / 2, h / 2):translate(offset[1], offset[2])
  end
  local all = celspan.union { celspan.rect { 0, 0, w, h, texture = "#c9c5bc" },
    moved(celspan.rect { 0, 0, w, h, texture = "#fff" }), drawing.object,
    moved(outline(w, h, 2 / scale, "#d33")), outline(w, h, 2 / scale, "#777") }
  local pixels = program.check(celspan.pixels(celspan.rostrum { celspan.cel { all:scale(scale) } },
    { size = size, film = size }))
  return { w = size[1], h = size[2], bytes = pixels:bytes { depth = 8, alpha = "straight" } }
end

local function write_contact(panels, path)
  local across, most = math.min(COLUMNS, #panels), 0
  for _, one in ipairs(panels) do most = math.max(most, one.panel.h) end
  local width = GAP + across * (PANEL + GAP)
  local height = GAP + ((#panels - 1) // COLUMNS + 1) * (most + LABEL)
  local objects = { celspan.rect { 0, 0, width, height, texture = "#e8e6e1" } }
  for i, one in ipairs(panels) do
    local x, y = GAP + (i - 1) % COLUMNS * (PANEL + GAP), GAP + (i - 1) // COLUMNS * (most + LABEL)
    local panel, drawing = one.panel, one.drawing
    table.insert(objects, celspan.image { x = x, y = y, w = panel.w, h = panel.h,
      size = { panel.w, panel.h }, format = "rgba8", pixels = panel.bytes })
    local words = { tostring(one.number), ("%.2f"):format(drawing.turned),
      ("%.1f"):format(drawing.offset[1]), ("%.1f"):format(drawing.offset[2]) }
    for j, word in ipairs(words) do
      table.insert(objects, number_at(word, x + 1 + (j - 1) * PANEL / 4, y + panel.h + 8))
    end
  end
  program.write(celspan.rostrum { size = { width, height }, celspan.cel(objects) }, path)
end

-- ---------------------------------------------------------------- the verb

if not output then program.usage "-o is missing: give -o clean/level.####.png" end
if not program.has_number(output) then
  program.usage("-o: '%s' needs a number, as in clean/level.####.png", output)
end
program.refuse_target(output)
local options = options_of()
local job = program.input(scan.open(request[1], options))
local facts, panels = {}, {}
program.count_frames(#job.numbers)
for i, number in ipairs(job.numbers) do
  local drawing = program.input(scan.drawing(job, number))
  write_all(drawing, number)
  facts[i] = { number = number, turned = drawing.turned, offset = { list = drawing.offset },
    levels = { list = drawing.levels }, width = drawing.width, height = drawing.height }
  if request.contact then
    panels[i] = { number = number, panel = panel_of(drawing),
      drawing = { turned = drawing.turned, offset = drawing.offset } }
  end
  program.made_frame(number, program.check(native.frame_name(output, number)))
end
if request.contact then write_contact(panels, request.contact) end
if request.json then print(program.json { drawings = { list = facts } }) end
