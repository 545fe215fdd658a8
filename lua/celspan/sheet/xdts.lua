--- Exchange digital time sheets (XDTS, version 5): text in, columns out, and back.
--
-- The entries of a track are changes: a gap holds the entry before it. Frames count from 0 in the
-- file and from 1 here. The format has neither a frame rate nor a size: celspan writes them as
-- frameRate, width and height of a table, which other programs ignore.
local columns = require "celspan.columns"
local fields = require "celspan.fields"
local json = require "celspan.json"
local ordered = require "celspan.ordered"
local values = require "celspan.values"

local xdts = {}

local head = "exchangeDigitalTimeSheet Save Data"
local CELLS = 0
local kinds = { [3] = "dialogue", [5] = "camera" }
local numbers = { dialogue = 3, camera = 5 }
local ticks = { SYMBOL_TICK_1 = "inbetween", SYMBOL_TICK_2 = "reverse" }
local options = { OPTION_KEYFRAME = "key", OPTION_REFERENCEFRAME = "reference" }

-- ---------------------------------------------------------------- reading

--- The texts of a list; programs write whole numbers among them.
local function texts_of(object, where, name)
  local list = {}
  for i, value in ipairs(values.get(object, where, name, "table", {})) do
    local what = ("%s%s[%d]"):format(where, name, i)
    local whole = type(value) == "number" and math.tointeger(value)
    local text = whole and tostring(whole) or value
    if type(text) ~= "string" then
      values.fail("%s must be a string, got %s", what, fields.kind(value))
    end
    list[i] = columns.check_text(text, what)
  end
  return list
end

local function field_number(object, where)
  return values.whole(object, where, "fieldId", -2 ^ 31, 2 ^ 31)
end

--- The entries of a track in order: { frame, values, options }. Frames are counted from 1; an entry
--- before the sheet is valid in its first frame.
local function entries_of(track, where)
  local list, most = {}, columns.most_frames
  for frame, here in values.each(track, where, "frames", {}) do
    local number = values.whole(frame, here, "frame", -most, most)
    for data, there in values.each(frame, here, "data", {}) do
      if values.whole(data, there, "id", -2 ^ 31, 2 ^ 31, 0) == 0 then
        list[#list + 1] = { frame = number, values = texts_of(data, there, "values"),
                            options = values.get(data, there, "options", "table", {}) }
      end
    end
  end
  columns.sort(list)
  for _, entry in ipairs(list) do entry.frame = math.max(0, entry.frame) + 1 end
  return list
end

local function read_cells(column, entries)
  for _, entry in ipairs(entries) do
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
local function read_notes(notes, kind, name, entries)
  local note, hyphen
  local function close(frame, is_empty)
    if not note then return end
    local to = frame and (is_empty or not hyphen) and frame - 1 or hyphen
    note.to = to and math.max(note.from, to)
    note, hyphen = nil, nil
  end
  for _, entry in ipairs(entries) do
    local first = entry.values[1]
    if first == "SYMBOL_HYPHEN" then
      hyphen = note and entry.frame
    elseif first then
      close(entry.frame, first == "SYMBOL_NULL_CELL")
    end
    if first and first ~= "SYMBOL_HYPHEN" and first ~= "SYMBOL_NULL_CELL" then
      local speaker = kind == "dialogue" and entry.values[2] and first or nil
      note = { kind = kind, column = name, from = entry.frame, speaker = speaker,
               text = table.concat(entry.values, "\n", speaker and 2 or 1) }
      notes[#notes + 1] = note
    end
  end
  close()
end

--- The column of cells for a track. Tracks without a name have their numbers, from 1.
local function column_at(state, place, where)
  if state.has_cells[place] then values.fail("%strackNo %d is a duplicate", where, place - 1) end
  state.has_cells[place] = true
  for i = #state.layers + 1, place do state.layers[i] = columns.new(("track %d"):format(i)) end
  return state.layers[place]
end

local function read_tracks(state, field, id, where)
  local names = state.headers[id] or {}
  for track, here in values.each(field, where, "tracks", {}) do
    local place = values.whole(track, here, "trackNo", 0, columns.most_layers - 1) + 1
    if id == CELLS then
      read_cells(column_at(state, place, here), entries_of(track, here))
    else
      read_notes(state.notes, kinds[id] or ("field %d"):format(id),
        names[place] or ("track %d"):format(place), entries_of(track, here))
    end
  end
  return state.notes
end

--- The columns and the notes of a table. A field that the format does not define is read as notes
--- if it has their form, and ignored otherwise.
local function read_fields(tables, where)
  local state = { headers = {}, layers = {}, notes = {}, has_cells = {} }
  for header, here in values.each(tables, where, "timeTableHeaders") do
    state.headers[field_number(header, here)] = texts_of(header, here, "names")
  end
  local names = state.headers[CELLS] or {}
  if #names > columns.most_layers then
    values.fail("%stimeTableHeaders: there are more than %d tracks, which is the limit", where,
      columns.most_layers)
  end
  for i, name in ipairs(names) do state.layers[i] = columns.new(name) end
  for field, here in values.each(tables, where, "fields", {}) do
    local id = field_number(field, here)
    if id == CELLS or kinds[id] then
      read_tracks(state, field, id, here)
    else
      local apart = { headers = state.headers, notes = {} }
      local found = fields.caught(read_tracks, apart, field, id, here) or {}
      table.move(found, 1, #found, #state.notes + 1, state.notes)
    end
  end
  return state.layers, state.notes
end

local function read_table(document, tables, where)
  local layers, notes = read_fields(tables, where)
  local header = values.get(document, "", "header", "table", {})
  local has_size = tables.width ~= nil or tables.height ~= nil
  local function side(name)
    return has_size and values.whole(tables, where, name, 1, columns.most_pixels) or nil
  end
  return { name = values.get(tables, where, "name", "string", ""), layers = layers, notes = notes,
    cut = values.get(header, "header.", "cut", "string", ""),
    scene = values.get(header, "header.", "scene", "string", ""),
    fps = values.get(tables, where, "frameRate", "number", 24),
    width = side "width", height = side "height",
    frames = columns.length(values.whole(tables, where, "duration", 1, columns.most_frames), layers,
      notes) }
end

--- Whether a text is an XDTS, by its first line.
function xdts.accepts(text) return text:find("^%s*" .. head) ~= nil end

--- which: the number or name of the table to read. Raises { message = }.
function xdts.decode(text, which)
  local first, rest = text:match "^([^\r\n]*)(.*)$"
  if first ~= head then values.fail("line 1 is not %q", head) end
  local document, count = values.decode(rest, "the sheet"), 0
  local version = values.get(document, "", "version", "number")
  if version ~= 5 then
    values.fail("version is %s; version 5 can be read", fields.shown(version))
  end
  for item, where in values.each(document, "", "timeTables") do
    count = count + 1
    if which == count or which == item.name then return read_table(document, item, where) end
  end
  values.fail("timeTables has %d tables, and none of them is %s", count,
    type(which) == "string" and ("%q"):format(which) or fields.shown(which))
end

-- ---------------------------------------------------------------- writing

local function quoted(list)
  local texts = {}
  for i, text in ipairs(list) do texts[i] = json.encode(text) end
  return table.concat(texts, ",")
end

--- What a track says of a frame: texts, and the names of options, if there are some.
local function entry_of(frame, texts, more)
  return ('{"frame":%d,"data":[{"id":0,"values":[%s]%s}]}'):format(frame - 1, quoted(texts),
    more and more[1] and (',"options":[%s]'):format(quoted(more)) or "")
end

--- The options, or the ticks, for the marks of a frame.
local function names_for(known, marks)
  local list = {}
  for _, name in ipairs(ordered.names(known)) do
    if marks and marks[known[name]] then list[#list + 1] = name end
  end
  return list
end

--- A tick continues the previous cell, so a frame with a change has no tick.
local function write_cells(column, frames)
  local list, lines = {}, {}
  for i, frame in ipairs(column.at) do
    list[i] = { frame = frame, value = column.names[i] or "SYMBOL_NULL_CELL" }
  end
  for frame, marks in pairs(column.marks) do
    local tick, place = names_for(ticks, marks)[1], columns.find(column, frame)
    local has_more = names_for(options, marks)[1] and column.at[place] ~= frame
    local value = tick or has_more and "SYMBOL_HYPHEN"
    if value then list[#list + 1] = { frame = frame, value = value } end
  end
  columns.sort(list)
  for i, entry in ipairs(list) do
    local is_last = not list[i + 1] or list[i + 1].frame ~= entry.frame
    lines[i] = entry_of(entry.frame, { entry.value },
      is_last and names_for(options, column.marks[entry.frame]))
  end
  if column.names[#column.at] then
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

--- The fields of notes in order of their numbers, each with the names and the lines of its tracks.
local function fields_of_notes(sheet)
  local by_id, list = {}, {}
  for _, note in ipairs(sheet.notes) do
    local id = numbers[note.kind] or math.tointeger(tonumber(note.kind:match "^field (%-?%d+)$"))
    if id and not by_id[id] then
      by_id[id] = { id = id, names = {}, tracks = {}, places = {} }
      list[#list + 1] = by_id[id]
    end
    if id then
      local field = by_id[id]
      local place = field.places[note.column] or #field.names + 1
      field.places[note.column], field.names[place] = place, note.column
      field.tracks[place] = field.tracks[place] or {}
      write_note(field.tracks[place], note, sheet.frames)
    end
  end
  table.sort(list, function(a, b) return a.id < b.id end)
  return list
end

local function write_field(field)
  local tracks = {}
  for i, lines in ipairs(field.tracks) do
    tracks[i] = ('{"trackNo":%d,"frames":[\n%s]}'):format(i - 1, table.concat(lines, ",\n"))
  end
  return ('{"fieldId":%d,"tracks":[\n%s]}'):format(field.id, table.concat(tracks, ",\n"))
end

function xdts.encode(sheet)
  local cells, headers, body = { id = CELLS, names = {}, tracks = {} }, {}, {}
  for i, column in ipairs(sheet.layers) do
    cells.names[i], cells.tracks[i] = column.name, write_cells(column, sheet.frames)
  end
  local list = fields_of_notes(sheet)
  table.insert(list, 1, cells)
  for i, field in ipairs(list) do
    headers[i] = ('{"fieldId":%d,"names":[%s]}'):format(field.id, quoted(field.names))
    body[i] = write_field(field)
  end
  local size = sheet.width and sheet.height
    and ('"width":%d,"height":%d,'):format(sheet.width, sheet.height) or ""
  return ('%s\n{"version":5,"header":{"cut":%s,"scene":%s},"timeTables":[\n'
    .. '{"name":%s,"duration":%d,"frameRate":%.14g,%s'
    .. '"timeTableHeaders":[%s],\n"fields":[\n%s]}]}\n')
    :format(head, json.encode(sheet.cut), json.encode(sheet.scene), json.encode(sheet.name),
      sheet.frames, sheet.fps, size, table.concat(headers, ","), table.concat(body, ",\n"))
end

return fields.seal("xdts", xdts)
