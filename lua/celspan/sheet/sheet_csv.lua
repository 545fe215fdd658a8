--- Exposure sheets as comma-separated values: of TVPaint and Krita, "CSV 1.0", read and written;
--- and of Clip Studio, read.
local columns = require "celspan.columns"
local csv = require "celspan.csv"
local fields = require "celspan.fields"
local values = require "celspan.values"

local sheet_csv = {}

local CIRCLE, DISC, CROSS = "\u{25CB}", "\u{25CF}", "\u{D7}"
--- Contents of a cell that continue the cell above.
local holds = { [""] = true, ["|"] = true, ["\u{FF5C}"] = true, ["\u{2502}"] = true, ["-"] = true,
                ["\u{2015}"] = true, ["\u{2014}"] = true }

--- The cells of a line, which may be in quotes.
local function split(line, number)
  local cells = csv.record(line or "", 1, number, ",", true)
  if #cells - 1 > columns.most_layers then
    values.fail("line %d: there are more than %d columns, which is the limit", number,
      columns.most_layers)
  end
  return cells
end

--- The rows of frames in order, { frame =, cells = }, from a line on; a row that repeats the row
--- before it shares its cells. frame_of(cells, number): the frame of a line; nil: it has none.
local function read_frames(lines, first, frame_of)
  local list, repeated, cells = {}, nil, nil
  for number = first, #lines do
    local digits, rest = lines[number]:match "^(#?%d+)(.*)$"
    local is_repeated = rest and rest == repeated
    local row = is_repeated and { digits } or split(lines[number], number)
    local frame = lines[number]:find "[^%s,]" and frame_of(row, number)
    if frame then
      if not is_repeated then cells, repeated = row, rest end
      list[#list + 1] = { frame = frame, cells = cells }
    end
  end
  return columns.sort(list)
end

-- ---------------------------------------------------------------- TVPaint and Krita

--- The numbers of line 3 by the names of line 2, in lower case, and the name of the project.
local function read_head(lines)
  local names, texts, head = split(lines[2], 2), split(lines[3], 3), {}
  for i, name in ipairs(names) do head[name:lower()] = texts[i] ~= "" and texts[i] or nil end
  return function(name, least, most, default)
    local number = tonumber(head[name] or "")
    if head[name] and not (number and number >= least and number <= most) then
      values.fail("line 3: %s is %q; it must be a number from %.10g to %.10g", name, head[name],
        least, most)
    end
    return number or default
  end, head["project name"] or ""
end

--- The lines with properties of the layers, and what a cell of them says.
local rows = {
  ["#density"] = { "opacity", function(text) return tonumber(text) or 1 end },
  ["#blending"] = { "blend",
    function(text) return text == "Color" and "normal" or text:lower() end },
  ["#visible"] = { "visible", function(text) return text ~= "0" end },
}

--- Reads a line with properties of the layers; true if the line is one.
local function read_row(layers, cells)
  local first = cells[1]:lower()
  local row = rows[first]
  for i = 2, #cells do
    local column = layers[i - 1]
    if first == "#layers" then
      layers[i - 1] = column or columns.new ""
      layers[i - 1].name = cells[i]
    elseif row and column then
      column.look = column.look or {}
      column.look[row[1]] = row[2](cells[i])
    end
  end
  return first:find "^#" and not first:find "^#%d+$"
end

--- The frame of a line; nil if it has properties of the layers, which are read.
local function read_line(layers, cells, number)
  if read_row(layers, cells) then return nil end
  local digits = cells[1]:match "^#0*(%d+)$"
  if not digits then
    values.fail("line %d begins with %q; a frame begins with # and its number", number, cells[1])
  end
  local frame = tonumber(digits) -- a float if there are many digits
  if frame >= columns.most_frames then
    values.fail("line %d: frame %s is beyond %d, which is the limit", number, digits,
      columns.most_frames)
  end
  if #cells - 1 > #layers then
    values.fail("line %d has %d cells; there are %d layers", number, #cells - 1, #layers)
  end
  return math.tointeger(frame) + 1
end

local function decode_tvpaint(lines)
  local layers, before = {}, nil
  local number, name = read_head(lines)
  local list = read_frames(lines, 4, function(cells, place)
    return read_line(layers, cells, place)
  end)
  for _, row in ipairs(list) do
    for i, column in ipairs(row.cells ~= before and layers or {}) do
      local drawing = row.cells[i + 1] or ""
      columns.add(column, row.frame, drawing ~= "" and drawing)
    end
    before = row.cells
  end
  local told = number("frame count", 0, columns.most_frames, 0) // 1 | 0
  return { name = name, layers = layers, notes = {},
           width = number("width", 1, columns.most_pixels),
           height = number("height", 1, columns.most_pixels),
           fps = number("frame rate", 1e-3, 1000, 24),
           frames = columns.length(math.max(1, told, #list > 0 and list[#list].frame or 0), layers,
             {}) }
end

-- ---------------------------------------------------------------- Clip Studio

--- The columns by the lines of their folders and of their names.
local function read_names(lines)
  local folders, names, layers = split(lines[1], 1), split(lines[2], 2), {}
  for i = 2, math.max(#folders, #names) do
    local folder, name = folders[i] or "", names[i] or ""
    layers[i - 1] = columns.new(folder ~= "" and folder .. "/" .. name or name)
  end
  while #layers > 0 and layers[#layers].name == "" do layers[#layers] = nil end
  return layers
end

local function read_cell(column, frame, text)
  if text == CIRCLE then
    columns.mark(column, frame, "inbetween")
  elseif text == DISC then
    columns.mark(column, frame, "reverse")
  elseif not holds[text] then
    columns.add(column, frame, text ~= CROSS and text ~= "SYMBOL_NULL_CELL" and text)
  end
end

local function decode_clip_studio(lines)
  local layers = read_names(lines)
  local list = read_frames(lines, 3, function(cells, number)
    local frame = math.tointeger(tonumber(cells[1]))
    if frame and frame >= 1 and frame <= columns.most_frames then return frame end
    values.fail("line %d begins with %q; it must be the number of a frame, from 1", number,
      cells[1])
  end)
  if #layers == 0 or #list == 0 then
    values.fail "line 2: it is neither the CSV of TVPaint or Krita nor that of Clip Studio"
  end
  for _, row in ipairs(list) do
    for i, column in ipairs(layers) do read_cell(column, row.frame, row.cells[i + 1] or "") end
  end
  return { name = "", layers = layers, notes = {}, fps = 24, frames = list[#list].frame }
end

-- ---------------------------------------------------------------- the formats

--- Whether a text is the CSV of TVPaint or Krita, by its first line.
function sheet_csv.accepts(text) return text:find "^UTF%-8,%s*TVPaint" ~= nil end

--- Raises { message = }.
function sheet_csv.decode(text)
  columns.check_text(text, "the file")
  local lines = columns.lines(text)
  if #lines == 0 then values.fail "the file is empty" end
  return sheet_csv.accepts(lines[1]) and decode_tvpaint(lines) or decode_clip_studio(lines)
end

-- ---------------------------------------------------------------- writing

local function quote(text) return '"' .. text:gsub('"', '""'):gsub("[\r\n]", " ") .. '"' end

local function row_of(first, layers, make)
  local cells = { first }
  for i, column in ipairs(layers) do cells[i + 1] = make(column.look or {}, column) end
  return table.concat(cells, ", ")
end

--- The CSV of TVPaint and Krita: drawings and layers, but no notes and marks. Raises { message = }
--- if it would be too long.
function sheet_csv.encode(sheet)
  local layers = sheet.layers
  columns.check_cells(sheet.frames, layers)
  local lines = { 'UTF-8, TVPaint, "CSV 1.0"',
    "Project Name, Width, Height, Frame Count, Layer Count, Frame Rate, Pixel Aspect Ratio, "
      .. "Field Mode",
    ("%s, %d, %d, %d, %d, %.6f, 1.000000, Progressive"):format(quote(sheet.name),
      sheet.width or 1920, sheet.height or 1080, sheet.frames, #layers, sheet.fps),
    row_of("#Layers", layers, function(_, column) return quote(column.name) end),
    row_of("#Density", layers, function(look) return ("%.6f"):format(look.opacity or 1) end),
    row_of("#Blending", layers, function(look)
      local blend = look.blend or "normal"
      return quote(blend == "normal" and "Color" or blend:gsub("^%l", string.upper))
    end),
    row_of("#Visible", layers, function(look) return look.visible == false and "0" or "1" end) }
  local cells, at = {}, {}
  for i = 1, #layers do cells[i + 1], at[i] = '""', 1 end
  for frame = 1, sheet.frames do
    cells[1] = ("#%05d"):format(frame - 1)
    for i, column in ipairs(layers) do
      local place = at[i]
      if column.at[place] == frame then
        cells[i + 1], at[i] = quote(column.names[place] or ""), place + 1
      end
    end
    lines[#lines + 1] = table.concat(cells, ", ")
  end
  lines[#lines + 1] = ""
  return table.concat(lines, "\r\n")
end

return fields.seal("sheet_csv", sheet_csv)
