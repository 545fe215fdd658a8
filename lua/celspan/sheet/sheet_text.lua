--- Exposure sheets as plain text, to be read, compared and edited line by line:
--
--   celspan sheet 1
--   name "scene 12"
--   fps 24
--   frames 4
--   note dialogue "Anna" 2-4 "Anna" "Good evening"
--   layers       body  mouth
--        1          1      X
--        2         |/m     B
--        3          |      |
--        4          2      -
--
-- A cell is a drawing's name, `|` (the cell above continues) or `-` (empty). A slash and marks may
-- follow: i inbetween, r reverse, k key, f reference, m moved, p procedure. Lines of frames may be
-- left out where nothing changes; a line that begins with `#` is a comment.
local columns = require "celspan.columns"
local fields = require "celspan.fields"
local values = require "celspan.values"

local sheet_text = {}

local head = "celspan sheet 1"

--- Whether a name needs no quotes.
local function is_bare(text) return text:find "^[%w_.+%-\128-\255]+$" ~= nil and text ~= "-" end

local signs = { ["\\"] = "\\", ['"'] = '"', n = "\n", r = "\r", t = "\t" }
local escapes = {}
for sign, character in pairs(signs) do escapes[character] = "\\" .. sign end

local function quote(text)
  return '"' .. text:gsub('[%c"\\]', function(sign)
    return escapes[sign] or ("\\%03d"):format(sign:byte())
  end) .. '"'
end

local function word_of(text) return is_bare(text) and text or quote(text) end

-- ---------------------------------------------------------------- reading

local function fail(state, text, ...)
  values.fail("line %d%s", state.number, text:format(...))
end

--- The character of an escape: the sign after the backslash, and up to two more digits.
local function unescape(state, sign, more)
  local code = tonumber(sign .. more)
  if sign:find "%d" and #more == 2 and code < 256 then return string.char(code) end
  return (signs[sign] or fail(state,
    ": \\%s is not an escape; there are \\\\ \\\" \\n \\r \\t and \\ddd", sign)) .. more
end

--- A quoted text at `at`: returns the text and the position after it.
local function read_quoted(state, line, at)
  local stop = at
  repeat
    local _, escaped = line:find('^[^"\\]*\\.', stop + 1)
    stop = escaped or line:find('"', stop + 1, true) or fail(state, ": a quote is not closed")
  until not escaped
  local text = line:sub(at + 1, stop - 1):gsub("\\(.)(%d?%d?)", function(sign, more)
    return unescape(state, sign, more)
  end)
  return text, stop + 1
end

--- The words of a line: { { text, is_quoted, marks }, ... }.
local function read_words(state, line)
  local words, at = {}, line:find "%S"
  while at do
    local word = { is_quoted = line:byte(at) == 34 }
    if word.is_quoted then
      word.text, at = read_quoted(state, line, at)
    else
      word.text, at = line:match("^([^%s/]*)()", at)
    end
    local marks, after = line:match("^/(%S*)()", at)
    word.marks, at = marks or "", after or at
    if line:find("^%S", at) then fail(state, ": a space is missing after a quote") end
    words[#words + 1] = word
    at = line:find("%S", at)
  end
  return words
end

local letters = {}
for _, mark in ipairs(columns.marks) do letters[mark[2]] = mark[1] end

local function read_cell(state, column, frame, word)
  local text = word.text
  if text == "" then fail(state, ": a drawing's name is empty") end
  if word.is_quoted or text ~= "|" then
    columns.add(column, frame, (word.is_quoted or text ~= "-") and text)
  end
  for letter in word.marks:gmatch "." do
    if not letters[letter] then
      fail(state, ": %q is not a mark; the marks are i, r, k, f, m and p", letter)
    end
    columns.mark(column, frame, letters[letter])
  end
end

--- Reads the cells of a frame; most lines of a long sheet have none but `|`.
local function read_frame(state, line)
  local layers, digits, rest = state.sheet.layers, line:match "^%s*(%d+)(.*)$"
  local frame = math.tointeger(tonumber(digits))
  if not frame or frame < 1 or frame > columns.most_frames then
    fail(state, ": frame %s; frames are numbered from 1 to %d", digits, columns.most_frames)
  end
  if frame <= state.last then
    fail(state, ": frame %d follows frame %d; frames ascend", frame, state.last)
  end
  state.last = frame
  if rest == state.hold then return end
  local words = read_words(state, rest)
  if #words ~= #layers then
    fail(state, " has %d cells; there are %d layers", #words, #layers)
  end
  for i, word in ipairs(words) do read_cell(state, layers[i], frame, word) end
  if not rest:find "[^%s|]" then state.hold = rest end
end

local function whole(state, text, what, most)
  local value = math.tointeger(tonumber(text))
  if not value or value < 1 or value > most then
    fail(state, ": %s must be a whole number from 1 to %d", what, most)
  end
  return value
end

local function text_at(state, words, i, what)
  return words[i] and words[i].text or fail(state, ": %s is missing", what)
end

local readers = {}

for _, name in ipairs { "name", "cut", "scene" } do
  readers[name] = function(state, words)
    state.sheet[name] = text_at(state, words, 2, "a " .. name)
  end
end
function readers.fps(state, words)
  state.sheet.fps = tonumber(text_at(state, words, 2, "the frame rate"))
    or fail(state, ": fps must be a number")
end
function readers.frames(state, words)
  state.sheet.frames = whole(state, words[2] and words[2].text, "frames", columns.most_frames)
end
function readers.size(state, words)
  for i, side in ipairs { "width", "height" } do
    local word = words[i + 1]
    state.sheet[side] = whole(state, word and word.text, "the " .. side, columns.most_pixels)
  end
end
function readers.layers(state, words)
  if state.has_layers then fail(state, ": the layers are defined twice") end
  if #words - 1 > columns.most_layers then
    fail(state, ": there are more than %d layers, which is the limit", columns.most_layers)
  end
  state.has_layers = true
  for i = 2, #words do state.sheet.layers[i - 1] = columns.new(words[i].text) end
end

--- note KIND COLUMN FROM-TO [SPEAKER] TEXT
function readers.note(state, words)
  local from, to = text_at(state, words, 4, "the frames"):match "^(%d+)%-?(%d*)$"
  if not from or #words < 5 or #words > 6 then
    fail(state, ": a note is: note KIND COLUMN FROM-TO [SPEAKER] TEXT")
  end
  local note = { kind = words[2].text, column = words[3].text,
    from = whole(state, from, "a frame", columns.most_frames),
    to = whole(state, to ~= "" and to or from, "a frame", columns.most_frames),
    speaker = words[6] and words[5].text, text = words[#words].text }
  if note.to < note.from then fail(state, ": the note ends before it begins") end
  table.insert(state.sheet.notes, note)
end

--- Whether a text is a sheet in this form, by its first line.
function sheet_text.accepts(text) return text:find("^" .. head .. "%s") ~= nil end

local function read_line(state, line)
  if line:find "^%s*%d" and state.has_layers then return read_frame(state, line) end
  local words = read_words(state, line)
  local read = not words[1].is_quoted and readers[words[1].text]
  if not read then
    fail(state, " begins with %q; it must be the number of a frame, after layers, or "
      .. "cut, fps, frames, layers, name, note, scene, size", words[1].text)
  end
  read(state, words)
end

--- Raises { message = }.
function sheet_text.decode(text)
  columns.check_text(text, "the file")
  local lines = columns.lines(text)
  if not (lines[1] or ""):find("^" .. head .. "%s*$") then values.fail("line 1 is not %q", head) end
  local sheet = { name = "", cut = "", scene = "", fps = 24, frames = 1, layers = {}, notes = {} }
  local state = { sheet = sheet, last = 0 }
  for number = 2, #lines do
    state.number = number
    if lines[number]:find "^%s*[^%s#]" then read_line(state, lines[number]) end
  end
  sheet.frames = columns.length(math.max(sheet.frames, state.last), sheet.layers, sheet.notes)
  return sheet
end

-- ---------------------------------------------------------------- writing

local function marks_of(marks)
  local text = "/"
  for _, mark in ipairs(columns.marks) do
    if marks[mark[1]] then text = text .. mark[2] end
  end
  return text
end

local function pad(text, width)
  return (" "):rep(width - (utf8.len(text) or #text)) .. text
end

local function write_head(sheet)
  local lines = { head }
  for _, name in ipairs { "name", "scene", "cut" } do
    if sheet[name] ~= "" then lines[#lines + 1] = name .. " " .. quote(sheet[name]) end
  end
  if sheet.width then lines[#lines + 1] = ("size %d %d"):format(sheet.width, sheet.height) end
  lines[#lines + 1] = ("fps %.14g"):format(sheet.fps)
  lines[#lines + 1] = ("frames %d"):format(sheet.frames)
  for _, note in ipairs(sheet.notes) do
    local words = { "note", word_of(note.kind), quote(note.column),
                    ("%d-%d"):format(note.from, note.to) }
    if note.speaker then words[#words + 1] = quote(note.speaker) end
    words[#words + 1] = quote(note.text)
    lines[#lines + 1] = table.concat(words, " ")
  end
  return lines
end

local function width_of(column)
  local width = utf8.len(word_of(column.name)) or #column.name
  for _, name in ipairs(column.names) do
    width = math.max(width, name and utf8.len(word_of(name)) or 1)
  end
  local most = 0
  for _, marks in pairs(column.marks) do most = math.max(most, #marks_of(marks)) end
  return width + most
end

--- The cell of a column at a frame, of which `place` is the next change.
local function cell_of(column, place, frame)
  local text = frame == 1 and "-" or "|"
  if column.at[place] == frame then
    local name = column.names[place]
    text = name and word_of(name) or "-"
  end
  local marks = column.marks[frame]
  return marks and text .. marks_of(marks) or text
end

--- Larger sheets are written without the lines where nothing changes.
local WHOLE_CELLS = 1000000

--- The frames that have a line, ascending.
local function frames_of(sheet)
  local list, is_there = {}, { true }
  if sheet.frames * (#sheet.layers + 1) <= WHOLE_CELLS then
    for frame = 1, sheet.frames do list[frame] = frame end
    return list
  end
  for _, column in ipairs(sheet.layers) do
    for _, frame in ipairs(column.at) do is_there[frame] = true end
    for frame in pairs(column.marks) do is_there[frame] = true end
  end
  for frame in pairs(is_there) do list[#list + 1] = frame end
  table.sort(list)
  return list
end

--- Raises { message = } if the text would be too long.
function sheet_text.encode(sheet)
  local lines, layers, frames = write_head(sheet), sheet.layers, frames_of(sheet)
  local words, at, widths, holds = { pad("layers", 8) }, {}, {}, {}
  columns.check_cells(#frames, layers)
  for i, column in ipairs(layers) do
    widths[i], at[i] = width_of(column), 1
    words[i + 1], holds[i] = pad(word_of(column.name), widths[i]), pad("|", widths[i])
  end
  lines[#lines + 1] = table.concat(words, "  ")
  for _, frame in ipairs(frames) do
    words[1] = ("%8d"):format(frame)
    for i, column in ipairs(layers) do
      local cell = cell_of(column, at[i], frame)
      words[i + 1] = cell == "|" and holds[i] or pad(cell, widths[i])
      if column.at[at[i]] == frame then at[i] = at[i] + 1 end
    end
    lines[#lines + 1] = table.concat(words, "  ")
  end
  return table.concat(lines, "\n") .. "\n"
end

return fields.seal("sheet_text", sheet_text)
