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

local sheet_text = {}

local head = "celspan sheet 1"

--- Whether a name needs no quotes.
local function is_bare(text) return text:find "^[%w_.+%-\128-\255]+$" ~= nil and text ~= "-" end

local escapes = { ["\\"] = "\\\\", ['"'] = '\\"', ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }
local signs = { ["\\"] = "\\", ['"'] = '"', n = "\n", r = "\r", t = "\t" }

local function quote(text)
  return '"' .. text:gsub('[%c"\\]', function(sign)
    return escapes[sign] or ("\\%03d"):format(sign:byte())
  end) .. '"'
end

local function word_of(text) return is_bare(text) and text or quote(text) end

-- ---------------------------------------------------------------- reading

--- The character of an escape: the sign after the backslash, and up to two more digits.
local function unescape(sign, more, number)
  local code = tonumber(sign .. more)
  if sign:find "%d" and #more == 2 and code < 256 then return string.char(code) end
  if not signs[sign] then
    columns.fail("line %d: \\%s is not an escape; there are \\\\ \\\" \\n \\r \\t and \\ddd",
      number, sign)
  end
  return signs[sign] .. more
end

--- A quoted text at `at`: returns the text and the position after it.
local function read_quoted(line, at, number)
  local from = at + 1
  while true do
    local stop = line:find('["\\]', from)
    if not stop then columns.fail("line %d: a quote is not closed", number) end
    if line:sub(stop, stop) == '"' then
      local text = line:sub(at + 1, stop - 1):gsub("\\(.)(%d?%d?)", function(sign, more)
        return unescape(sign, more, number)
      end)
      return text, stop + 1
    end
    from = stop + 2
  end
end

--- The words of a line: { { text, is_quoted, marks }, ... }.
local function read_words(line, number)
  local words, at = {}, line:find "%S"
  while at do
    local word
    if line:sub(at, at) == '"' then
      local text, after = read_quoted(line, at, number)
      local marks = line:match("^/(%a*)", after)
      word = { text = text, is_quoted = true, marks = marks }
      at = after + (marks and #marks + 1 or 0)
      if line:find("^%S", at) then
        columns.fail("line %d: a space is missing after a quote", number)
      end
    else
      local text, marks = line:match("^([^%s/]*)/?(%S*)", at)
      word = { text = text, marks = marks ~= "" and marks or nil }
      at = line:find("%s", at) or #line + 1
    end
    words[#words + 1] = word
    at = line:find("%S", at)
  end
  return words
end

local letters = {}
for _, mark in ipairs(columns.marks) do letters[mark[2]] = mark[1] end

local function add_marks(column, frame, marks, number)
  for letter in marks:gmatch "." do
    if not letters[letter] then
      columns.fail("line %d: %q is not a mark; the marks are i, r, k, f, m and p", number, letter)
    end
    columns.mark(column, frame, letters[letter])
  end
end

--- A fast path for the cells of a frame's line without quotes, which are the most frequent ones.
local plain = { ["|"] = true }

local function read_cell(column, frame, word, number)
  local text = word.text
  if word.is_quoted or not plain[text] then
    if text == "" then columns.fail("line %d: a drawing's name is empty", number) end
    columns.add(column, frame, (word.is_quoted or text ~= "-") and text or false)
  end
  if word.marks then add_marks(column, frame, word.marks, number) end
end

local function read_frame(state, line, number)
  local layers, i = state.sheet.layers, 0
  local digits, rest = line:match "^%s*(%d+)()"
  local frame = math.tointeger(tonumber(digits))
  if not frame or frame < 1 or frame > columns.most_frames then
    columns.fail("line %d: frame %s; frames are numbered from 1 to %d", number, digits,
      columns.most_frames)
  end
  if frame <= state.last then
    columns.fail("line %d: frame %d follows frame %d; frames ascend", number, frame, state.last)
  end
  state.last = frame
  -- most lines of a long sheet contain no changes
  if line:sub(rest) == state.hold then return end
  local is_hold = true
  if line:find('["/]', rest) then
    for place, word in ipairs(read_words(line:sub(rest), number)) do
      i, is_hold = place, false
      if layers[i] then read_cell(layers[i], frame, word, number) end
    end
  else
    local add = columns.add
    for text in line:gmatch("%S+", rest) do
      i = i + 1
      if text ~= "|" then
        is_hold = false
        if layers[i] then add(layers[i], frame, text ~= "-" and text or false) end
      end
    end
  end
  if i ~= #layers then
    columns.fail("line %d has %d cells; there are %d layers", number, i, #layers)
  end
  if is_hold then state.hold = line:sub(rest) end
end

local function whole(word, what, number, most)
  local value = word and math.tointeger(tonumber(word.text))
  if not value or value < 1 or value > most then
    columns.fail("line %d: %s must be a whole number from 1 to %d", number, what, most)
  end
  return value
end

local function text_at(words, i, what, number)
  if not words[i] then columns.fail("line %d: %s is missing", number, what) end
  return words[i].text
end

local readers = {}

function readers.name(state, words, number)
  state.sheet.name = text_at(words, 2, "a name", number)
end
function readers.cut(state, words, number) state.sheet.cut = text_at(words, 2, "a cut", number) end
function readers.scene(state, words, number)
  state.sheet.scene = text_at(words, 2, "a scene", number)
end
function readers.fps(state, words, number)
  local fps = tonumber(text_at(words, 2, "the frame rate", number))
  if not fps then columns.fail("line %d: fps must be a number", number) end
  state.sheet.fps = fps
end
function readers.frames(state, words, number)
  state.sheet.frames = whole(words[2], "frames", number, columns.most_frames)
end
function readers.size(state, words, number)
  state.sheet.width = whole(words[2], "the width", number, columns.most_pixels)
  state.sheet.height = whole(words[3], "the height", number, columns.most_pixels)
end
function readers.layers(state, words, number)
  if state.has_layers then columns.fail("line %d: the layers are defined twice", number) end
  if #words - 1 > columns.most_layers then
    columns.fail("line %d: there are more than %d layers, which is the limit", number,
      columns.most_layers)
  end
  state.has_layers = true
  for i = 2, #words do state.sheet.layers[i - 1] = columns.new(words[i].text) end
end

--- note KIND COLUMN FROM-TO [SPEAKER] TEXT
function readers.note(state, words, number)
  local from, to = text_at(words, 4, "the frames", number):match "^(%d+)%-?(%d*)$"
  if not from or #words < 5 or #words > 6 then
    columns.fail("line %d: a note is: note KIND COLUMN FROM-TO [SPEAKER] TEXT", number)
  end
  local note = { kind = words[2].text, column = words[3].text,
    from = whole({ text = from }, "a frame", number, columns.most_frames),
    to = whole({ text = to ~= "" and to or from }, "a frame", number, columns.most_frames),
    speaker = words[6] and words[5].text, text = words[#words].text }
  if note.to < note.from then columns.fail("line %d: the note ends before it begins", number) end
  table.insert(state.sheet.notes, note)
end

--- Whether a text is a sheet in this form, by its first line.
function sheet_text.accepts(text) return text:find("^" .. head .. "%s") ~= nil end

--- Raises { message = }.
function sheet_text.decode(text)
  columns.check_text(text, "the file")
  local lines = columns.lines(text)
  if not (lines[1] or ""):find("^" .. head .. "%s*$") then
    columns.fail("line 1 is not %q", head)
  end
  local sheet = { name = "", cut = "", scene = "", fps = 24, frames = 1, layers = {}, notes = {} }
  local state = { sheet = sheet, last = 0 }
  for number = 2, #lines do
    local line = lines[number]
    if line:find "^%s*%d" and state.has_layers then
      read_frame(state, line, number)
    elseif line:find "^%s*[^%s#]" then
      local words = read_words(line, number)
      local read = not words[1].is_quoted and readers[words[1].text]
      if not read then
        columns.fail("line %d begins with %q; it must be the number of a frame, after layers, or "
          .. "cut, fps, frames, layers, name, note, scene, size", number, words[1].text)
      end
      read(state, words, number)
    end
  end
  sheet.frames = math.max(sheet.frames, state.last,
    columns.length(sheet.frames, sheet.layers, sheet.notes))
  return sheet
end

-- ---------------------------------------------------------------- writing

local function marks_of(marks)
  local list = {}
  for _, mark in ipairs(columns.marks) do
    if marks[mark[1]] then list[#list + 1] = mark[2] end
  end
  return #list > 0 and "/" .. table.concat(list) or ""
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

--- The cell of a column at a frame, unless it is the plain `|`.
local function cell_of(column, place, frame)
  local marks = column.marks[frame]
  local text = "|"
  if column.at[place] == frame then
    local name = column.names[place]
    text = name and word_of(name) or "-"
  elseif frame == 1 then
    text = "-"
  elseif not marks then
    return nil
  end
  return text .. (marks and marks_of(marks) or "")
end

--- Larger sheets are written without the lines where nothing changes.
local WHOLE_CELLS = 1000000

--- The frames that have a line, ascending.
local function frames_of(sheet)
  local list, is_there = {}, {}
  if sheet.frames * (#sheet.layers + 1) <= WHOLE_CELLS then
    for frame = 1, sheet.frames do list[frame] = frame end
    return list
  end
  local function add(frame)
    if not is_there[frame] then is_there[frame], list[#list + 1] = true, frame end
  end
  add(1)
  for _, column in ipairs(sheet.layers) do
    for _, frame in ipairs(column.at) do add(frame) end
    for frame in pairs(column.marks) do add(frame) end
  end
  table.sort(list)
  return list
end

--- Raises { message = } if the text would be too long.
function sheet_text.encode(sheet)
  local lines, layers = write_head(sheet), sheet.layers
  local words, at, holds, widths = { pad("layers", 8) }, {}, {}, {}
  for i, column in ipairs(layers) do
    widths[i], at[i] = width_of(column), 1
    words[i + 1] = pad(word_of(column.name), widths[i])
    holds[i] = pad("|", widths[i])
  end
  lines[#lines + 1] = table.concat(words, "  ")
  local frames = frames_of(sheet)
  columns.check_cells(#frames, layers)
  for _, frame in ipairs(frames) do
    words[1] = ("%8d"):format(frame)
    for i, column in ipairs(layers) do
      local cell = cell_of(column, at[i], frame)
      words[i + 1] = cell and pad(cell, widths[i]) or holds[i]
      if column.at[at[i]] == frame then at[i] = at[i] + 1 end
    end
    lines[#lines + 1] = table.concat(words, "  ")
  end
  lines[#lines + 1] = ""
  return table.concat(lines, "\n")
end

return fields.seal("sheet_text", sheet_text)
