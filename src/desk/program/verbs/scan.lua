--- celspan scan PATTERN -o OUT: scanned drawings, registered by their peg holes, and cleaned.
--
--   OUT          level.0007.png        all inks of drawing 7
--   with inks    level.red.0007.png    each ink alone: its name and a dot precede the number
--   --contact    a panel for each drawing: its lines, the page, and where its scan lies on it
local program, request = ...
local celspan = require "celspan"
local native = require "celspan.native"
local scan = require "celspan.ink_scan"
local number_at = program.part "numerals.lua"

local PANEL, COLUMNS, GAP, LABEL = 360, 4, 12, 44 -- pixels
local output = request.output

-- ---------------------------------------------------------------- options

local function inks_of(text)
  local inks = {}
  for _, part in ipairs(program.split(text)) do
    local name, colour = part:match "^([%w_-]+)=(.+)$"
    if not name then
      program.usage("--ink: '%s' is not NAME=COLOUR, such as red=#c33; a name has letters, "
        .. "digits, _ and -", part)
    elseif inks[name] then
      program.usage("--ink: '%s' is given twice", name)
    end
    inks[name] = colour
  end
  return inks
end

--- What the module says of its options, with those of the verb.
local function said(message)
  return (message:gsub("^.*ink: scan: ", "--"):gsub("pegs = false", "--pegs none")
    :gsub("match = true", "--match"):gsub("give dpi, such as", "give --dpi, such as"))
end

--- The scans, for scan.drawing.
local function open()
  local options = { pegs = request.pegs, match = request.match, dpi = tonumber(request.dpi),
    frames = request.frames, dust = math.tointeger(request.dust),
    ink = request.ink and inks_of(request.ink) }
  if request.pegs == "none" then
    options.pegs = false
  elseif request.pegs and request.pegs ~= "acme" then
    program.usage("--pegs: '%s' is not acme or none; other holes can be given only in a script: "
      .. "field pegs of ink.scan", request.pegs)
  end
  if request.levels then
    local list = program.split(request.levels)
    options.levels = { tonumber(list[1]), tonumber(list[2]), list[3] }
  end
  local good, job, message = pcall(scan.open, request[1], options)
  if not good then program.usage("%s", said(job)) end
  return program.input(job, message)
end

-- ---------------------------------------------------------------- files

local function write(drawing, object, pattern, number)
  program.write(celspan.rostrum { size = { drawing.width, drawing.height }, antialias = "none",
    celspan.cel { object } }, program.check(native.frame_name(pattern, number)))
end

--- The files of an ink alone.
local function pattern_of(ink)
  local tail = output:match "#+[^#/]*$" or output:match "%%%d*d[^/]*$"
  return output:sub(1, -#tail - 1) .. ink .. "." .. tail
end

--- Refuses to write over the scans that are read.
local function refuse_scans(job)
  local scans, patterns = {}, { output }
  for i, ink in ipairs(job.names) do patterns[i + 1] = pattern_of(ink) end
  local function path_of(pattern, number)
    return program.resolve(program.check(native.frame_name(pattern, number)))
  end
  for _, number in ipairs(job.numbers) do scans[path_of(job.pattern, number) or ""] = true end
  for _, number in ipairs(job.numbers) do
    for _, pattern in ipairs(patterns) do
      if scans[path_of(pattern, number)] then
        program.usage("-o: '%s' is a scan that is read; choose another folder",
          native.frame_name(pattern, number))
      end
    end
  end
end

local function write_all(drawing, number)
  write(drawing, drawing.object, output, number)
  for name, texture in pairs(drawing.colours) do
    write(drawing, celspan.rect { 0, 0, drawing.width, drawing.height, texture = texture },
      pattern_of(name), number)
  end
end

-- ---------------------------------------------------------------- how each was moved

--- Adds panel i to a sheet: what was scanned is white, and has a red rim; the page has a grey one.
-- Returns the height of the sheet.
local function add_panel(sheet, i, number, drawing)
  local w, h, offset = drawing.width, drawing.height, drawing.offset
  local scale = PANEL / math.max(w, h)
  local size = { math.max(1, w * scale // 1), math.max(1, h * scale // 1) }
  local x = GAP + (i - 1) % COLUMNS * (PANEL + GAP)
  local y = GAP + (i - 1) // COLUMNS * (size[2] + LABEL)
  local page = celspan.rect { 0, 0, w, h, texture = "#c9c5bc" }
  local function rim(colour)
    return celspan.stroke { d = ("M0 0 H%d V%d H0 Z"):format(w, h), width = 2 / scale,
      texture = colour }
  end
  local function moved(object)
    return object:rotate(drawing.turned, w / 2, h / 2):translate(offset[1], offset[2])
  end
  local all = celspan.union { page, moved(page:with { texture = "#fff" }), drawing.object,
    moved(rim "#d33"), rim "#777" }
  local pixels = program.check(celspan.pixels(celspan.rostrum { celspan.cel { all:scale(scale) } },
    { size = size, film = size }))
  table.insert(sheet, celspan.image { x = x, y = y, w = size[1], h = size[2], size = size,
    format = "rgba8", pixels = pixels:bytes { depth = 8, alpha = "straight" } })
  for j, word in ipairs { tostring(number), ("%.2f"):format(drawing.turned),
    ("%.1f"):format(offset[1]), ("%.1f"):format(offset[2]) } do
    table.insert(sheet, number_at(word, x + 1 + (j - 1) * PANEL / 4, y + size[2] + 8))
  end
  return y + size[2] + LABEL
end

-- ---------------------------------------------------------------- the verb

if not output then program.usage "-o is missing: give -o clean/level.####.png" end
if not program.has_number(output) then
  program.usage("-o: '%s' needs a number, as in clean/level.####.png", output)
end
program.refuse_target(output)
if request.contact then program.refuse_target(request.contact) end
local job = open()
refuse_scans(job)
local facts, sheet, height = {}, {}, 0
program.count_frames(#job.numbers)
for i, number in ipairs(job.numbers) do
  local drawing, message = scan.drawing(job, number)
  if not drawing then program.input(nil, said(message)) end
  write_all(drawing, number)
  facts[i] = { number = number, turned = drawing.turned, offset = { list = drawing.offset },
    levels = { list = drawing.levels }, width = drawing.width, height = drawing.height }
  if request.contact then height = add_panel(sheet, i, number, drawing) end
  program.made_frame(number, program.check(native.frame_name(output, number)))
end
if request.contact then
  local width = GAP + math.min(COLUMNS, #facts) * (PANEL + GAP)
  table.insert(sheet, 1, celspan.rect { 0, 0, width, height, texture = "#e8e6e1" })
  program.write(celspan.rostrum { size = { width, height }, celspan.cel(sheet) }, request.contact)
end
if request.json then print(program.json { drawings = { list = facts } }) end
