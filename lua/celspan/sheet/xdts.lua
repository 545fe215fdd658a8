--- Exchange digital time sheets (XDTS, version 5): text in, columns out, and back.
--
-- The entries of a track are changes: a gap holds the entry before it. Frames count from 0 in the
-- file and from 1 here. The format has neither a frame rate nor a size: celspan writes them as
-- frameRate, width and height of a table, which other programs ignore.
local columns = require "celspan.columns"
local fields = require "celspan.fields"
local json = require "celspan.json"

local xdts = {}

local head = "exchangeDigitalTimeSheet Save Data"
local CELLS = 0
local kinds = { [3] = "dialogue", [5] = "camera" }
local numbers = { dialogue = 3, camera = 5 }
local ticks = { SYMBOL_TICK_1 = "inbetween", SYMBOL_TICK_2 = "reverse" }
local options = { OPTION_KEYFRAME = "key", OPTION_REFERENCEFRAME = "reference" }

-- ---------------------------------------------------------------- values of the document

--- object[name], or the default. path: the place of the object, for messages.
local function get(object, path, name, wanted, default)
  local value = object[name]
  if value == nil or value == json.null then
    if default == nil then columns.fail("%s.%s is missing", path, name) end
    return default
  end
  if type(value) ~= wanted then
    columns.fail("%s.%s must be a %s, got %s", path, name, wanted == "table" and "list" or wanted,
      fields.kind(value))
  end
  return value
end

local function whole(object, path, name, least, most, default)
  local number = get(object, path, name, "number", default)
  if number ~= math.floor(number) or number < least or number > most then
    columns.fail("%s.%s is %s; it must be a whole number from %d to %d", path, name,
      fields.shown(number), least, most)
  end
  return math.tointeger(number)
end

--- Each object of a list, with its path.
local function each(object, path, name, default)
  local list = get(object, path, name, "table", default)
  local i = 0
  return function()
    i = i + 1
    local item = list[i]
    if item == nil then return nil end
    local here = ("%s.%s[%d]"):format(path, name, i)
    if type(item) ~= "table" or item == json.null then
      columns.fail("%s must be an object, got %s", here, fields.kind(item))
    end
    return item, here
  end
end

local function text_of(value, path)
  if math.type(value) == "integer" or type(value) == "number" and value == math.floor(value) then
    return ("%d"):format(value)
  end
  if type(value) ~= "string" then
    columns.fail("%s must be a string, got %s", path, fields.kind(value))
  end
  return columns.check_text(value, path)
end

-- ---------------------------------------------------------------- reading

--- The entries of a track in order: { frame, values, options }. Frames are counted from 1; an entry
--- before the sheet is valid in its first frame.
local function entries_of(track, path)
  local list = {}
  for frame, here in each(track, path, "frames", {}) do
    local number = whole(frame, here, "frame", -columns.most_frames, columns.most_frames)
    for data, there in each(frame, here, "data", {}) do
      if whole(data, there, "id", -2 ^ 31, 2 ^ 31, 0) == 0 then
        local values = {}
        for i, value in ipairs(get(data, there, "values", "table", {})) do
          values[i] = text_of(value, ("%s.values[%d]"):format(there, i))
        end
        list[#list + 1] = { frame = number, values = values,
                            options = get(data, there, "options", "table", {}) }
      end
    end
  end
  columns.sort(list)
  for _, entry in ipairs(list) do entry.frame = math.max(0, entry.frame) + 1 end
  return list
end

local function read_cells(column, track, path)
  for _, entry in ipairs(entries_of(track, path)) do
    local value = entry.values[1]
    if ticks[value] then
      columns.mark(column, entry.frame, ticks[value])
    elseif value == "SYMBOL_NULL_CELL" or value == "" then
      columns.add(column, entry.frame, false)
    elseif value and value ~= "SYMBOL_HYPHEN" then
      columns.add(column, entry.frame, value)
    end
    for _, option in ipairs(entry.options) do
      if options[option] then columns.mark(column, entry.frame, options[option]) end
    end
  end
end

--- A note lasts until the change that ends it. If only another note or nothing follows, it lasts
--- until its last hyphen, and without hyphens until the end of the sheet.
local function read_notes(notes, kind, name, track, path)
  local note, hyphen
  local function close(frame, is_empty)
    if note and frame then
      note.to = (is_empty or not hyphen) and frame - 1 or hyphen
    elseif note then
      note.to = hyphen
    end
    if note and note.to then note.to = math.max(note.from, note.to) end
    note, hyphen = nil, nil
  end
  for _, entry in ipairs(entries_of(track, path)) do
    local first = entry.values[1]
    if first == "SYMBOL_HYPHEN" then
      hyphen = note and entry.frame
    elseif first == "SYMBOL_NULL_CELL" then
      close(entry.frame, true)
    elseif first then
      close(entry.frame, false)
      note = { kind = kind, column = name, from = entry.frame }
      if kind == "dialogue" and entry.values[2] then
        note.speaker, note.text = first, table.concat(entry.values, "\n", 2)
      else
        note.text = table.concat(entry.values, "\n")
      end
      notes[#notes + 1] = note
    end
  end
  close()
end

--- The names of the tracks of each field, from the headers.
local function read_headers(tables, path)
  local headers = {}
  for header, here in each(tables, path, "timeTableHeaders") do
    local names, field = {}, whole(header, here, "fieldId", -2 ^ 31, 2 ^ 31)
    for i, name in ipairs(get(header, here, "names", "table", {})) do
      names[i] = text_of(name, ("%s.names[%d]"):format(here, i))
    end
    headers[field] = names
  end
  return headers
end

local function check_places(number, path)
  if number > columns.most_layers then
    columns.fail("%s: there are more than %d tracks, which is the limit", path,
      columns.most_layers)
  end
end

local function read_tracks(state, field, id, path)
  local names = state.headers[id] or {}
  for track, here in each(field, path, "tracks", {}) do
    local place = whole(track, here, "trackNo", 0, columns.most_layers - 1) + 1
    if id == CELLS then
      if state.has_cells[place] then
        columns.fail("%s: track %d is a duplicate", here, place - 1)
      end
      state.has_cells[place] = true
      for i = #state.layers + 1, place do state.layers[i] = columns.new(("track %d"):format(i)) end
      read_cells(state.layers[place], track, here)
    else
      read_notes(state.notes, kinds[id] or ("field %d"):format(id),
        names[place] or ("track %d"):format(place), track, here)
    end
  end
end

--- Reads a field that the format does not define as notes if it has their form, and ignores it
--- otherwise.
local function try_tracks(state, field, id, path)
  local count = #state.notes
  local good, problem = pcall(read_tracks, state, field, id, path)
  if not good and type(problem) ~= "table" then error(problem, 0) end
  for i = #state.notes, good and #state.notes + 1 or count + 1, -1 do state.notes[i] = nil end
end

local function read_fields(tables, path)
  local state = { headers = read_headers(tables, path), layers = {}, notes = {}, has_cells = {} }
  for i, name in ipairs(state.headers[CELLS] or {}) do
    check_places(i, path)
    state.layers[i] = columns.new(name)
  end
  for field, here in each(tables, path, "fields", {}) do
    local id = whole(field, here, "fieldId", -2 ^ 31, 2 ^ 31)
    local is_known = id == CELLS or kinds[id]
    if is_known then read_tracks(state, field, id, here) else try_tracks(state, field, id, here) end
  end
  return state.layers, state.notes
end

--- The size of the drawings; nothing if the table has none.
local function read_size(tables, path)
  if tables.width == nil and tables.height == nil then return end
  local function side(name) return whole(tables, path, name, 1, columns.most_pixels) end
  return side "width", side "height"
end

local function read_table(document, tables, path)
  local sheet = { name = get(tables, path, "name", "string", ""),
                  fps = get(tables, path, "frameRate", "number", 24) }
  local layers, notes = read_fields(tables, path)
  sheet.layers, sheet.notes = layers, notes
  sheet.width, sheet.height = read_size(tables, path)
  local told = whole(tables, path, "duration", 1, columns.most_frames)
  sheet.frames = columns.length(told, layers, notes)
  local header = get(document, "the sheet", "header", "table", {})
  sheet.cut = get(header, "header", "cut", "string", "")
  sheet.scene = get(header, "header", "scene", "string", "")
  return sheet
end

--- Whether a text is an XDTS, by its first line.
function xdts.accepts(text) return text:find("^%s*" .. head) ~= nil end

--- which: the number or name of the table to read. Raises { message = }.
function xdts.decode(text, which)
  local first, rest = text:match "^([^\r\n]*)(.*)$"
  if first ~= head then columns.fail("line 1 is not %q", head) end
  local document, problem = json.decode(rest)
  if document == nil then columns.fail("%s", problem) end
  if type(document) ~= "table" or document == json.null then
    columns.fail("the sheet must be an object, got %s", fields.kind(document))
  end
  local version = get(document, "the sheet", "version", "number")
  if version ~= 5 then
    columns.fail("version is %s; version 5 can be read", fields.shown(version))
  end
  local tables = {}
  for item, path in each(document, "the sheet", "timeTables") do
    tables[#tables + 1] = { item, path:gsub("^the sheet%.", "") }
    local name = item.name
    if which == #tables or which == name then
      return read_table(document, item, tables[#tables][2])
    end
  end
  columns.fail("timeTables has %d tables, and none of them is %s", #tables,
    type(which) == "string" and ("%q"):format(which) or fields.shown(which))
end

-- ---------------------------------------------------------------- writing

local escapes = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }

local function quote(text)
  return '"' .. text:gsub('[%c"\\]', function(sign)
    return escapes[sign] or sign ~= "\127" and ("\\u%04x"):format(sign:byte()) or nil
  end) .. '"'
end

local function entry_of(frame, values, more)
  for i, value in ipairs(values) do values[i] = quote(value) end
  return ('{"frame":%d,"data":[{"id":0,"values":[%s]%s}]}'):format(frame - 1,
    table.concat(values, ","), more or "")
end

local function options_of(marks)
  local list = {}
  if marks and marks.key then list[#list + 1] = '"OPTION_KEYFRAME"' end
  if marks and marks.reference then list[#list + 1] = '"OPTION_REFERENCEFRAME"' end
  return #list > 0 and (',"options":[%s]'):format(table.concat(list, ",")) or nil
end

--- A tick continues the previous cell, so a frame with a change has no tick.
local function tick_of(marks)
  return marks and (marks.inbetween and "SYMBOL_TICK_1" or marks.reverse and "SYMBOL_TICK_2")
end

local function write_cells(column, frames)
  local list = {}
  for i, frame in ipairs(column.at) do
    list[i] = { frame = frame, value = column.names[i] or "SYMBOL_NULL_CELL" }
  end
  for frame, marks in pairs(column.marks) do
    local tick, more = tick_of(marks), options_of(marks)
    local place = columns.find(column, frame)
    if more and column.at[place] ~= frame then tick = tick or "SYMBOL_HYPHEN" end
    if tick then list[#list + 1] = { frame = frame, value = tick } end
  end
  columns.sort(list)
  local lines = {}
  for i, entry in ipairs(list) do
    local is_last = not list[i + 1] or list[i + 1].frame ~= entry.frame
    lines[i] = entry_of(entry.frame, { entry.value },
      is_last and options_of(column.marks[entry.frame]) or nil)
  end
  local count = #column.at
  if count > 0 and column.names[count] then
    lines[#lines + 1] = entry_of(frames + 1, { "SYMBOL_NULL_CELL" })
  end
  return lines
end

--- A longer note has one hyphen, on its last frame, instead of one on each frame. Both forms mean
--- the same, because an entry lasts until the next one.
local HYPHENS = 10000

local function write_note(lines, note, frames)
  local to = note.to or frames
  lines[#lines + 1] = entry_of(note.from,
    note.speaker and { note.speaker, note.text } or { note.text })
  for frame = math.max(note.from + 1, to - note.from > HYPHENS and to or 0), to do
    lines[#lines + 1] = entry_of(frame, { "SYMBOL_HYPHEN" })
  end
  lines[#lines + 1] = entry_of(to + 1, { "SYMBOL_NULL_CELL" })
end

--- Notes by field and column: { id, names, tracks }, in order of the numbers of the fields.
local function group_notes(sheet)
  local groups, order = {}, {}
  for _, note in ipairs(sheet.notes) do
    local id = numbers[note.kind] or math.tointeger(tonumber(note.kind:match "^field (%-?%d+)$"))
    if id then
      local group = groups[id]
      if not group then
        group = { id = id, names = {}, tracks = {} }
        groups[id], order[#order + 1] = group, group
      end
      local lines = group.tracks[note.column]
      if not lines then
        lines = {}
        group.names[#group.names + 1], group.tracks[note.column] = note.column, lines
      end
      write_note(lines, note, sheet.frames)
    end
  end
  table.sort(order, function(a, b) return a.id < b.id end)
  return order
end

local function write_field(id, tracks)
  return ('{"fieldId":%d,"tracks":[\n%s]}'):format(id, table.concat(tracks, ",\n"))
end

local function write_track(place, lines)
  return ('{"trackNo":%d,"frames":[\n%s]}'):format(place - 1, table.concat(lines, ",\n"))
end

local function write_header(id, names)
  local list = {}
  for i, name in ipairs(names) do list[i] = quote(name) end
  return ('{"fieldId":%d,"names":[%s]}'):format(id, table.concat(list, ","))
end

function xdts.encode(sheet)
  local names, tracks = {}, {}
  for i, column in ipairs(sheet.layers) do
    names[i] = column.name
    tracks[i] = write_track(i, write_cells(column, sheet.frames))
  end
  local headers, body = { write_header(CELLS, names) }, { write_field(CELLS, tracks) }
  for _, group in ipairs(group_notes(sheet)) do
    local list = {}
    for i, name in ipairs(group.names) do list[i] = write_track(i, group.tracks[name]) end
    headers[#headers + 1] = write_header(group.id, group.names)
    body[#body + 1] = write_field(group.id, list)
  end
  local size = sheet.width and sheet.height
    and ('"width":%d,"height":%d,'):format(sheet.width, sheet.height) or ""
  return ('%s\n{"version":5,"header":{"cut":%s,"scene":%s},"timeTables":[\n'
    .. '{"name":%s,"duration":%d,"frameRate":%.14g,%s'
    .. '"timeTableHeaders":[%s],\n"fields":[\n%s]}]}\n')
    :format(head, quote(sheet.cut), quote(sheet.scene), quote(sheet.name), sheet.frames,
      sheet.fps, size, table.concat(headers, ","), table.concat(body, ",\n"))
end

return fields.seal("xdts", xdts)
