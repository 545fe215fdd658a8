--- Exposure sheets as comma-separated values: of TVPaint and Krita, "CSV 1.0", read and written;
--- and of Clip Studio, read.
local columns = require "celspan.columns"
local csv = require "celspan.csv"
local fields = require "celspan.fields"

local sheet_csv = {}

local CIRCLE, DISC, CROSS = "\u{25CB}", "\u{25CF}", "\u{D7}"
--- Contents of a cell that continue the cell above.
local holds = { [""] = true, ["|"] = true, ["\u{FF5C}"] = true, ["\u{2502}"] = true, ["-"] = true,
                ["\u{2015}"] = true, ["\u{2014}"] = true }

-- ---------------------------------------------------------------- cells

--- The cells of a line, which may be in quotes.
local function split(line, number) return (csv.record(line, 1, number, ",", true)) end

local function check_count(count, number)
  if count > columns.most_layers then
    columns.fail("line %d: there are more than %d columns, which is the limit", number,
      columns.most_layers)
  end
end

-- ---------------------------------------------------------------- TVPaint and Krita

--- The values of line 3 by the names of line 2, in lower case.
local function read_head(lines)
  local names, values = split(lines[2] or "", 2), split(lines[3] or "", 3)
  local head = {}
  for i, name in ipairs(names) do head[name:lower()] = values[i] end
  return head
end

local function number_of(head, name, least, most, default)
  local text = head[name]
  if text == nil or text == "" then return default end
  local number = tonumber(text)
  if not number or not (number >= least and number <= most) then
    columns.fail("line 3: %s is %q; it must be a number from %.10g to %.10g", name, text, least,
      most)
  end
  return number
end

local rows = { ["#layers"] = "name", ["#density"] = "opacity", ["#blending"] = "blend",
               ["#visible"] = "visible" }
local made = {
  name = function(text) return text end,
  blend = function(text) return text == "Color" and "normal" or text:lower() end,
  opacity = function(text) return tonumber(text) or 1 end,
  visible = function(text) return text ~= "0" end,
}

--- Reads a line with properties of the layers; true if the line is one.
local function read_row(layers, cells, number)
  local what = rows[cells[1]:lower()]
  if not what then return cells[1]:sub(1, 1) == "#" and not cells[1]:find "^#%d+$" end
  check_count(#cells - 1, number)
  for i = 2, #cells do
    if what == "name" then
      layers[i - 1] = layers[i - 1] or columns.new(cells[i])
      layers[i - 1].name = cells[i]
    elseif layers[i - 1] then
      layers[i - 1].look = layers[i - 1].look or {}
      layers[i - 1].look[what] = made[what](cells[i])
    end
  end
  return true
end

local function read_frame(layers, cells, number)
  local digits = cells[1]:match "^#0*(%d+)$"
  if not digits then
    columns.fail("line %d begins with %q; a frame begins with # and its number", number, cells[1])
  end
  local frame = tonumber(digits) -- a float if there are many digits
  if frame >= columns.most_frames then
    columns.fail("line %d: frame %s is beyond %d, which is the limit", number, digits,
      columns.most_frames)
  end
  if #cells - 1 > #layers then
    columns.fail("line %d has %d cells; there are %d layers", number, #cells - 1, #layers)
  end
  return math.tointeger(frame) + 1
end

--- The rows of frames in order, { frame =, cells = }; a row that repeats the row before it shares
--- its cells.
local function read_frames(lines, layers)
  local list, repeated, cells = {}, nil, nil
  for number = 4, #lines do
    local line = lines[number]
    local digits, tail = line:match "^(#%d+)()"
    local is_repeated = digits and line:sub(tail) == repeated
    if is_repeated then
      list[#list + 1] = { frame = read_frame(layers, { digits }, number), cells = cells }
    elseif line:find "%S" then
      local row = split(line, number)
      if not read_row(layers, row, number) then
        list[#list + 1] = { frame = read_frame(layers, row, number), cells = row }
        cells, repeated = row, digits and line:sub(tail)
      end
    end
  end
  return columns.sort(list)
end

local function decode_tvpaint(lines)
  local head = read_head(lines)
  local layers = {}
  local list, before = read_frames(lines, layers), nil
  for _, row in ipairs(list) do
    for i, column in ipairs(row.cells ~= before and layers or {}) do
      local name = row.cells[i + 1]
      columns.add(column, row.frame, name ~= nil and name ~= "" and name or false)
    end
    before = row.cells
  end
  local told = math.tointeger(number_of(head, "frame count", 0, columns.most_frames, 0) // 1)
  local last = #list > 0 and list[#list].frame or 0
  return { name = head["project name"] or "", layers = layers, notes = {},
           width = number_of(head, "width", 1, columns.most_pixels),
           height = number_of(head, "height", 1, columns.most_pixels),
           fps = number_of(head, "frame rate", 1e-3, 1000, 24),
           frames = math.max(1, last, columns.length(told, layers, {})) }
end

-- ---------------------------------------------------------------- Clip Studio

--- The change that a cell makes (nil: none), and the mark of the cell.
local function read_cell(text)
  if holds[text] then return nil end
  if text == CIRCLE then return nil, "inbetween" end
  if text == DISC then return nil, "reverse" end
  if text == CROSS or text == "SYMBOL_NULL_CELL" then return false end
  return text
end

local function decode_clip_studio(lines)
  local folders, names = split(lines[1], 1), split(lines[2] or "", 2)
  local count = math.max(#folders, #names)
  check_count(count, 2)
  local layers, list = {}, {}
  for i = 2, count do
    local folder, name = folders[i] or "", names[i] or ""
    layers[i - 1] = columns.new(folder ~= "" and folder .. "/" .. name or name)
  end
  while #layers > 0 and layers[#layers].name == "" do layers[#layers] = nil end
  for number = 3, #lines do
    local cells = split(lines[number], number)
    local frame = math.tointeger(tonumber(cells[1]))
    if lines[number]:find "[^%s,]" then
      if not frame or frame < 1 or frame > columns.most_frames then
        columns.fail("line %d begins with %q; it must be the number of a frame, from 1", number,
          cells[1])
      end
      list[#list + 1] = { frame = frame, cells = cells }
    end
  end
  if #layers == 0 or #list == 0 then
    columns.fail("line 2: it is neither the CSV of TVPaint or Krita nor that of Clip Studio")
  end
  columns.sort(list)
  for _, row in ipairs(list) do
    for i, column in ipairs(layers) do
      local change, mark = read_cell(row.cells[i + 1] or "")
      if change ~= nil then columns.add(column, row.frame, change) end
      if mark then columns.mark(column, row.frame, mark) end
    end
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
  if #lines == 0 then columns.fail("the file is empty") end
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
