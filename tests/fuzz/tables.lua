--- Any bytes as a table of values and as captions; the first byte chooses the options. Rows that
--- are read are as wide as the first; written with quotes, they are read again as they were.
local captions = require "celspan.captions"
local csv = require "celspan.csv"

local target = {}

local function check_message(message, bytes)
  local line = tonumber(message:match "^line (%d+): %g")
  local _, ends = bytes:gsub("\n", "")
  assert(line and line <= ends + 1, "no sentence that names the line: " .. message)
end

local function quoted(row)
  local cells = {}
  for i, text in ipairs(row) do cells[i] = '"' .. text:gsub('"', '""') .. '"' end
  return table.concat(cells, ",")
end

local function check_rows(rows)
  local lines = {}
  for i, row in ipairs(rows) do
    assert(#row == #rows[1], "a row of another width")
    lines[i] = quoted(row)
  end
  local again = assert(csv.decode(table.concat(lines, "\r\n"), { header = false }))
  assert(#again == #rows, "another number of rows")
  for i, row in ipairs(rows) do
    for j, text in ipairs(row) do assert(again[i][j] == text, "another text") end
  end
end

local function try_table(bytes, separator)
  local rows, message = csv.decode(bytes, { header = false, separator = separator })
  if rows then check_rows(rows) else check_message(message, bytes) end
end

local function try_captions(bytes)
  local list, message = captions.decode(bytes)
  if not list then return message:find "^the text is" or check_message(message, bytes:gsub("\r",
    "\n")) end
  for i, caption in ipairs(list) do
    assert(caption.from < caption.to, "a caption without a length")
    assert(i == 1 or list[i - 1].from <= caption.from, "captions out of order")
    assert(list:at(caption.from), "a caption that is not shown")
  end
end

function target.try_bytes(bytes)
  local rest = bytes:sub(2)
  try_table(rest, ({ ",", ";", "\t", nil })[(bytes:byte() or 0) % 4 + 1])
  try_captions(rest)
end

return target
