--- Columns of exposure sheets: shared by sheet.lua and the readers and writers of its formats.
--
--   column.at      { 1, 5, 9 }              frames of change, ascending, from 1
--   column.names   { "A1", "A2", false }    the drawing from that frame; false: empty
--   column.marks   { [3] = { inbetween = true } }
--
-- INVARIANT: neighbours in `names` differ, so each column has only one representation.
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"
local values = require "celspan.values"

local columns = {}

--- Larger sheets are refused.
columns.most_frames = 10000000
columns.most_layers = 65536
columns.most_pixels = 1048576 -- of a side
--- Texts of more cells than this are not written.
columns.most_cells = 100000000

--- The marks that a frame may have, with their letters in text.
columns.marks = { { "inbetween", "i" }, { "reverse", "r" }, { "key", "k" }, { "reference", "f" },
                  { "moved", "m" }, { "procedure", "p" } }

function columns.new(name) return { name = name, at = {}, names = {}, marks = {} } end

--- Appends a change; frames must ascend. If a frame has several changes, the last one counts.
function columns.add(column, frame, name)
  local at, names = column.at, column.names
  local count = #at
  if at[count] == frame then
    at[count], names[count] = nil, nil
    count = count - 1
  end
  -- a column is empty at its beginning
  if (names[count] or false) ~= name then at[count + 1], names[count + 1] = frame, name end
end

function columns.mark(column, frame, mark)
  column.marks[frame] = column.marks[frame] or {}
  column.marks[frame][mark] = true
end

local lookups = 0

--- How often drawings were looked up, as text: it shows whether a frame asked a sheet.
function columns.lookups() return tostring(lookups) end

--- The index of the change in force at a frame; 0 before the first.
function columns.find(column, frame)
  lookups = lookups + 1
  return ordered.last(column.at, frame)
end

--- Sorts by `frame`; items of one frame keep their order.
function columns.sort(list) return ordered.sort(list, "frame") end

--- Raises an error if a text with this number of rows is too large to be written.
function columns.check_cells(rows, list)
  local count = rows * (#list + 1)
  if count > columns.most_cells then
    values.fail("it would have %d rows of %d cells, more than %d cells, which is the limit", rows,
      #list + 1, columns.most_cells)
  end
end

--- Raises an error unless the text is UTF-8 without zero bytes. what: its name in the message.
function columns.check_text(text, what)
  if not utf8.len(text) then values.fail("%s is not UTF-8", what) end
  if text:find "%z" then values.fail("%s holds a zero byte", what) end
  return text
end

--- The lines of a text, with any kind of line end.
function columns.lines(text)
  local list = {}
  for line in text:gsub("^\239\187\191", ""):gsub("\r\n?", "\n"):gmatch "([^\n]*)\n?" do
    list[#list + 1] = line
  end
  while list[#list] == "" do list[#list] = nil end
  return list
end

--- The number of frames of a sheet: `given`, or more if its changes and notes need more.
function columns.length(given, list, notes)
  local frames = given
  for _, column in ipairs(list) do
    local count = #column.at
    -- if the last change is to nothing, it ends the previous drawing
    local last = count > 0 and column.at[count] - (column.names[count] and 0 or 1) or 0
    frames = math.max(frames, last)
  end
  for _, note in ipairs(notes) do frames = math.max(frames, note.from) end
  return frames
end

local known_marks = {}
for _, mark in ipairs(columns.marks) do known_marks[mark[1]] = true end

--- Fills a column with drawings or marks that a script gives by frame. use: columns.add or
--- columns.mark; what they must be; is_right: whether a value is.
local function fill(column, given, kind, what, use, is_right)
  local list, place = {}, ("%s of %q"):format(kind, column.name)
  for frame, value in next, given do
    if math.type(frame) ~= "integer" or frame < 1 or frame > columns.most_frames then
      values.fail("%s: a frame must be a whole number from 1 to %d, got %s", place,
        columns.most_frames, fields.shown(frame))
    end
    list[#list + 1] = { frame = frame, value = value }
  end
  for _, entry in ipairs(columns.sort(list)) do
    if not is_right(entry.value) then
      values.fail("%s: frame %d must be %s, got %s", place, entry.frame, what,
        fields.kind(entry.value))
    end
    use(column, entry.frame, entry.value)
  end
end

--- Fills a column with drawings and marks that a script gives, both by frame.
function columns.fill(column, drawings, marks)
  fill(column, drawings, "drawings", "a name, or false if empty", columns.add, function(name)
    return type(name) == "string" or name == false
  end)
  fill(column, marks, "marks", "inbetween, reverse, key, reference, moved or procedure",
    columns.mark, function(mark) return known_marks[mark] end)
end

return columns
