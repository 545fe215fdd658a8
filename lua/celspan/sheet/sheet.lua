--- Exposure sheets: which drawing each layer shows at each frame.
--
--   local s = assert(sheet.read "shot.xdts")           -- .xdts, .csv, .txt, .kra, an OCA folder
--   s:at("body", 12)                                   -- "3", or nil if the layer is empty
--   s:drawing("body", f, "drawings/body_####.png")     -- the picture of that drawing
--
-- Frames count from 1. A drawing holds until the next one. Layers are rearmost first.
local celspan = require "celspan"
local columns = require "celspan.columns"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local sheet_between = require "celspan.sheet_between"
local sheet_csv = require "celspan.sheet_csv"
local sheet_film = require "celspan.sheet_film"
local sheet_krita = require "celspan.sheet_krita"
local sheet_oca = require "celspan.sheet_oca"
local sheet_text = require "celspan.sheet_text"
local values = require "celspan.values"
local xdts = require "celspan.xdts"

local sheet = {}

--- Larger files are refused.
sheet.most_bytes = 256 * 1024 * 1024

---@class celspan.sheet
---@field name string
---@field scene string
---@field cut string
---@field fps number
---@field frames integer
---@field layers string[] Rearmost first
---@field notes celspan.sheet.note[] In order of their first frames
---@field looks table[] Further properties of each layer, if the file has them: opacity, blend, visible
---@field width? integer
---@field height? integer
local Sheet = { __name = "celspan.sheet" }
local methods = {}
Sheet.__index = fields.reads("a sheet", methods, { width = true, height = true })

---@class celspan.sheet.note
---@field kind string "dialogue", "camera", or "field N" for the contents of field N of the file
---@field column string The name of its column
---@field from integer
---@field to integer
---@field speaker? string Of dialogue
---@field text string

--- The columns of each sheet, hidden from scripts, which could break their invariant.
local stores = setmetatable({}, { __mode = "k" })

-- ---------------------------------------------------------------- making

local function check_names(list)
  local known = { [false] = true }
  for i, column in ipairs(list) do
    columns.check_text(column.name, ("the name of layer %d"):format(i))
    for _, name in ipairs(column.names) do
      if not known[name] then
        columns.check_text(name, ("layer %q: a drawing's name"):format(column.name))
        if name == "" then values.fail("layer %q: a drawing's name is empty", column.name) end
        known[name] = true
      end
    end
  end
end

local function check_notes(notes, frames)
  for i, note in ipairs(notes) do
    note.frame, note.to = note.from, math.min(note.to or frames, frames)
    for _, field in ipairs { "kind", "column", "text", "speaker" } do
      if note[field] then columns.check_text(note[field], ("note %d: its %s"):format(i, field)) end
    end
  end
  for _, note in ipairs(columns.sort(notes)) do note.frame = nil end
end

--- Makes a sheet from the result of a reader. Raises { message = }.
local function finish(found)
  if not (found.fps > 0 and found.fps <= 1000) then
    values.fail("its frame rate is %s; it must be above 0 and at most 1000",
      fields.shown(found.fps))
  end
  if not (found.frames >= 1 and found.frames <= columns.most_frames) then
    values.fail("it has %s frames; it must be 1 to %d", fields.shown(found.frames),
      columns.most_frames)
  end
  check_names(found.layers)
  check_notes(found.notes, found.frames)
  local made = { fps = math.tointeger(found.fps) or found.fps, frames = found.frames, layers = {},
                 looks = {}, notes = found.notes }
  if found.width and found.height then
    made.width, made.height = found.width // 1 | 0, found.height // 1 | 0
  end
  for _, field in ipairs { "name", "scene", "cut" } do
    made[field] = columns.check_text(found[field] or "", "its " .. field)
  end
  for i, column in ipairs(found.layers) do
    made.layers[i], made.looks[i] = column.name, column.look or {}
    while (column.at[#column.at] or 0) > found.frames do -- these only close the column
      column.at[#column.at], column.names[#column.names] = nil, nil
    end
  end
  stores[made] = found.layers
  return setmetatable(made, Sheet)
end

-- ---------------------------------------------------------------- new

local known_fields = { name = "string", scene = "string", cut = "string", fps = "number",
                       frames = "number", layers = "table", drawings = "table", marks = "table",
                       notes = "table", width = "number", height = "number" }

--- A copy of a note that a script gives. where: "notes[2]: "
local function note_of(note, where)
  fields.takes("sheet: " .. where:sub(1, -3), "table", "a table", note)
  local function text(name) return values.get(note, where, name, "string") end
  local function frame(name, least, default)
    return values.whole(note, where, name, least, columns.most_frames, default)
  end
  local from = frame("from", 1)
  return { kind = text "kind", column = text "column", text = text "text", from = from,
    to = frame("to", from, from), speaker = note.speaker and text "speaker" or nil }
end

--- Checks that the keys of `drawings` and `marks` are layers.
local function check_layers(given, places)
  for _, field in ipairs { "drawings", "marks" } do
    for name, value in next, given[field] or {} do
      if not places[name] or type(value) ~= "table" then
        values.fail("%s: %s must be a layer, with a table from frames", field, fields.key(name))
      end
    end
  end
end

local function make(given)
  local list, notes, places = {}, {}, {}
  for i, name in ipairs(given.layers or {}) do
    if type(name) ~= "string" then
      values.fail("layers[%d] must be a name, got %s", i, fields.kind(name))
    end
    if places[name] then values.fail("layers[%d]: %q is a duplicate", i, name) end
    list[i], places[name] = columns.new(name), i
  end
  check_layers(given, places)
  for _, column in ipairs(list) do
    columns.fill(column, (given.drawings or {})[column.name] or {},
      (given.marks or {})[column.name] or {})
  end
  for i, note in ipairs(given.notes or {}) do
    notes[i] = note_of(note, ("notes[%d]: "):format(i))
  end
  for _, side in ipairs { "width", "height" } do
    values.whole(given, "", side, 1, columns.most_pixels, 1)
  end
  local frames = math.tointeger(given.frames or 1) or values.fail "frames must be a whole number"
  return finish { name = given.name, scene = given.scene, cut = given.cut, fps = given.fps or 24,
    frames = columns.length(frames, list, notes), layers = list, notes = notes,
    width = given.width, height = given.height }
end

---@class celspan.sheet.fields
---@field name? string
---@field scene? string
---@field cut? string
---@field fps? number Default 24
---@field frames? integer Default: as many as the drawings need
---@field layers? string[] Rearmost first
---@field drawings? table<string, table<integer, string|false>> For each layer: the drawing from a frame on; false: empty
---@field marks? table<string, table<integer, string>>
---@field notes? celspan.sheet.note[]
---@field width? integer
---@field height? integer

---@param given celspan.sheet.fields
---@return celspan.sheet
function sheet.new(given)
  fields.check("sheet", given, known_fields)
  local made, message = fields.caught(make, given)
  return made or native.refuse("sheet: " .. message)
end

-- ---------------------------------------------------------------- reading

local function decode(text, path, which)
  if type(text) == "table" then return finish(sheet_krita.decode(text)) end
  local start = text:gsub("^\239\187\191", "", 1)
  if xdts.accepts(start) then return finish(xdts.decode(start, which)) end
  if sheet_text.accepts(start) then return finish(sheet_text.decode(start)) end
  if start:find "^%s*{" then return finish(sheet_oca.decode(start)) end
  if sheet_csv.accepts(start) or path:lower():find "%.csv$" then
    return finish(sheet_csv.decode(start))
  end
  values.fail("it is not XDTS, the CSV of TVPaint, Krita or Clip Studio, OCA, .kra, or celspan's "
    .. "text, which begins with \"celspan sheet 1\"")
end

local function read_whole(path)
  if path:lower():find "%.kra$" then return native.painting(path) end
  local names = native.folder(path)
  if names then
    local document = sheet_oca.file(names)
    if not document then return nil, path .. ": the folder contains no OCA document" end
    path = path .. "/" .. document
  end
  return files.read(path, sheet.most_bytes)
end

---@param path string Relative to the caller's file, else to the script
---@param options? { table?: integer|string } The table of an XDTS, by number or name; default 1
---@return celspan.sheet? sheet
---@return string? message
function sheet.read(path, options)
  fields.takes("sheet: read", "string", "the name of a file or folder", path)
  options = options or {}
  fields.check("sheet: read", options, { table = "any" })
  local text, message = files.found(path, read_whole)
  if not text then return nil, message end
  return fields.caught_in(path, decode, text, path, options.table or 1)
end

-- ---------------------------------------------------------------- asking

local function place_of(self, layer, method)
  if math.type(layer) == "integer" and self.layers[layer] then return layer end
  for i, name in ipairs(self.layers) do
    if name == layer then return i end
  end
  native.refuse(("sheet: %s: there is no layer '%s'%s"):format(method, fields.key(layer),
    fields.hint(layer, { table.unpack(self.layers, 1, 100) }) or ""))
end

--- The column of a layer; checks that a method is called as one.
local function column_of(self, layer, method)
  fields.expect_kind(stores[self], self, "sheet: %s: call it as a method, value:%s(...)", method,
    method)
  return stores[self][place_of(self, layer, method)]
end

local function check_frame(frame, method)
  fields.expect(fields.is_finite(frame), frame,
    "sheet: %s takes a frame's number, a finite number", method)
  return math.floor(frame)
end

--- The name of the drawing that a layer shows at a frame; nil if the layer is empty, or for a frame
--- outside the sheet.
---@param layer string|integer
---@param frame integer From 1
---@return string? drawing
function methods:at(layer, frame)
  local column = column_of(self, layer, "at")
  frame = check_frame(frame, "at")
  if frame < 1 or frame > self.frames then return nil end
  return column.names[columns.find(column, frame)] or nil
end

local function copy_of(marks)
  local copy = {}
  for mark in pairs(marks or {}) do copy[mark] = true end
  return copy
end

--- The marks of a layer at a frame, as keys: inbetween, reverse, key, reference, moved, procedure.
--- Without a frame, the marks of all frames that have some, by frame.
---@param layer string|integer
---@param frame? integer
---@return table<string, true>|table<integer, table<string, true>> marks
function methods:marks(layer, frame)
  local column, all = column_of(self, layer, "marks"), {}
  if frame then return copy_of(column.marks[check_frame(frame, "marks")]) end
  for number, marks in pairs(column.marks) do all[number] = copy_of(marks) end
  return all
end

--- The changes of a layer in order: { { frame =, drawing = }, ... }; drawing is nil where the layer
--- becomes empty.
---@param layer string|integer
---@return { frame: integer, drawing?: string }[] changes
function methods:changes(layer)
  local column, list = column_of(self, layer, "changes"), {}
  for i, frame in ipairs(column.at) do
    list[i] = { frame = frame, drawing = column.names[i] or nil }
  end
  return list
end

--- The notes that cover a frame.
---@param frame integer
---@return celspan.sheet.note[] notes
function methods:notes_at(frame)
  fields.self("sheet", Sheet, self, "notes_at")
  frame = check_frame(frame, "notes_at")
  local list = {}
  for _, note in ipairs(self.notes) do
    if note.from <= frame and frame <= note.to then list[#list + 1] = note end
  end
  return list
end

-- ---------------------------------------------------------------- drawings

--- Checks that a name can be part of a file name; raises an error if it leads to another folder.
local function safe_name(name)
  local path = name:gsub("\\", "/")
  if path:find "^/" or path:find "^%a:" or path:find "%c"
    or ("/" .. path .. "/"):find("/../", 1, true) then
    native.refuse(("sheet: drawing: %q cannot be part of a file's name"):format(name))
  end
  return path
end

--- "A7b" of layer "A" with "hand_####.png": hand_0007b.png.
local function by_pattern(name, layer, pattern)
  local before, star, after = pattern:match "^(.*)(%*)([^*]*)$"
  if star then return before .. safe_name(name) .. after end
  local first = pattern:find "#+[^#]*$"
  if not first then
    native.refuse(("sheet: drawing: the pattern %q has neither # nor *"):format(pattern))
  end
  local last = pattern:find("[^#]", first) or #pattern + 1
  local start, digits, letter = name:match "^(.-)(%d+)(%a?)$"
  if not digits or start ~= "" and start:gsub("[ _.-]$", "") ~= layer then
    native.refuse(("sheet: drawing: %q has no number, for %q; a * takes the name unchanged")
      :format(name, pattern))
  end
  digits = digits:gsub("^0+(%d)", "%1")
  return pattern:sub(1, first - 1) .. ("0"):rep(last - first - #digits) .. digits .. letter
    .. pattern:sub(last)
end

local function from_tree(tree, name, layer)
  local entry = tree:find(layer .. "/" .. name) or tree:find(name) or tree:find(layer)
  return entry and entry.object
end

local function from_table(list, name)
  local found = rawget(list, name)
  if found == nil then found = rawget(list, math.tointeger(tonumber(name)) or name) end
  return found
end

--- A function from a name to the drawing, or nil, and where it looks, in words.
local function finder(drawings, layer)
  local kind = type(drawings)
  if kind == "function" then return drawings, "the function" end
  if kind == "string" then
    return function(name) return celspan.image { file = by_pattern(name, layer, drawings) } end,
      "the files"
  end
  fields.expect_kind(kind == "table", drawings,
    "sheet: drawing: drawings must be a table, a pattern, layers or a function")
  if (getmetatable(drawings) or {}).__name == "celspan.layers.tree" then
    return function(name) return from_tree(drawings, name, layer) end, "the layers"
  end
  return function(name) return from_table(drawings, name) end, "the table"
end

--- The sheet's frame at a time in seconds; rounding errors just before a frame are tolerated.
local function frame_at(self, time) return math.floor(time * self.fps + 1e-6) + 1 end

local function subject_of(self, layer, method, drawings, options)
  local column = column_of(self, layer, method)
  local find, where = finder(drawings, column.name)
  return { column = column, frames = self.frames, layer = column.name, find = find,
           where = where, options = options }
end

--- The object of the drawing that a layer shows at a frame; nil if the layer is empty.
---@param layer string|integer
---@param f celspan.frame|integer The film's frame, or one of the sheet, from 1
---@param drawings table|string|fun(name: string): celspan.object? A table by name, "hand_####.png", "hand_*.png", layers, or a function
---@param options? { between?: boolean, charts?: table<string, number[]|string|function>, pairs?: table }
---@return celspan.object? object
function methods:drawing(layer, f, drawings, options)
  local subject = subject_of(self, layer, "drawing", drawings, options)
  local frame = type(f) == "userdata" and frame_at(self, f.time) or check_frame(f, "drawing")
  if options ~= nil and sheet_between.read(subject) then
    return sheet_between.drawing(subject, frame)
  end
  local name = self:at(layer, frame)
  if not name then return nil end
  local found = subject.find(name)
  if found == nil and type(drawings) ~= "function" then
    sheet_between.missing(subject, name, frame)
  end
  return found
end

--- For each run of a layer its `name`, the frames of its keys (`from`, `to`) and of its in-betweens
--- (`frames`), their `shares`, and, with drawings, `unsure`: pairs of places.
---@param layer string|integer
---@param drawings? table|string|fun(name: string): celspan.object?
---@param options? { between?: boolean, charts?: table<string, number[]|string|function>, pairs?: table }
---@return table[] charts
function methods:charts(layer, drawings, options)
  local subject = subject_of(self, layer, "charts", drawings or function() return true end,
    options or {})
  sheet_between.read(subject)
  return sheet_between.charts(subject, drawings ~= nil)
end

-- ---------------------------------------------------------------- writing

--- The data for the writers.
local function plain(self)
  return { name = self.name, scene = self.scene, cut = self.cut, fps = self.fps,
           frames = self.frames, width = self.width, height = self.height, notes = self.notes,
           layers = stores[self] }
end

--- The sheet as plain text.
---@return string? text nil if it would be too long
---@return string? message
function methods:text()
  fields.self("sheet", Sheet, self, "text")
  return fields.caught(sheet_text.encode, plain(self))
end

local writers = { xdts = xdts.encode, csv = sheet_csv.encode, txt = sheet_text.encode }

--- Writes the sheet: .xdts, .csv (TVPaint, Krita) or .txt.
---@param path string Relative to the current folder
---@return true? done
---@return string? message
function methods:write(path)
  fields.self("sheet", Sheet, self, "write")
  fields.takes("sheet: write", "string", "the name of a file", path)
  local encode = writers[(path:match "%.(%w+)$" or ""):lower()]
  if not encode then
    return nil, ("%s: sheets are written as .xdts, .csv or .txt"):format(path)
  end
  local text, refused = fields.caught_in(path, encode, plain(self))
  if not text then return nil, refused end
  return files.write(path, text)
end

-- ---------------------------------------------------------------- the sheet of a film

--- The sheet of a film: a layer for each named cel and each named object, and for unnamed cels by
--- their positions. Drawings are numbered in the order of their appearance; `moved` marks the
--- frames on which only the placement changes: transform, fade, viewport, lights, defocus. If
--- frames are listed, the first one is frame 1 of the sheet, and so on.
---@param film celspan.film
---@param options? { frames?: integer[] } The numbers of frames; default: all
---@return celspan.sheet
function sheet.of(film, options)
  fields.expect_kind(tostring(film):find "^film", film, "sheet: of takes a film")
  options = options or {}
  fields.check("sheet: of", options, { frames = "table" })
  local listed = options.frames
  local made, message = fields.caught(finish, { name = film.title, fps = film.fps,
    frames = listed and #listed or film.frames, layers = sheet_film.columns(film, listed),
    notes = {}, width = film.size[1], height = film.size[2] })
  return made or native.refuse("sheet: " .. message)
end

return fields.publish("sheet", sheet, methods)
