--- A sheet on paper: the film of its pages, a point for each unit.
--
--   | title        | scene | cut | time    | page |
--   | s  frame  action  dialogue  A  B  C  camera |  | s  frame ...    two strips of a page, or one
--   | 1                           1  A1  |        |  | 4
--   |       2                     |  |   |        |  |                  a row is a frame
--
-- A strip has as many whole seconds as its height holds. Where the layers are too many for a
-- strip, further pages have the others, for the same frames.
local program, request, made = ...
local celspan = require "celspan"
local ordered = require "celspan.ordered"

local SIZES = { a4 = { 595, 842, row = 9.4 }, a3 = { 842, 1191, row = 12 } } -- points
local SIDE, TOP, HEAD, NAMES, GAP = 34, 28, 40, 26, 12
local SECOND, FRAME, CELL, CELL_MOST = 14, 18, 19, 44 -- widths of columns
local NOTES = { -- the columns of notes: their share of the room that the cels leave
  { kind = "action", least = 34, share = 3 }, { kind = "dialogue", least = 34, share = 2 },
  { kind = "camera", least = 38, share = 2 },
}
local INK, LINE, FAINT = "#1d2226", "#5d7f8c", "#8fa9b3"
local LANES_MOST = 4

local paper = SIZES[request.paper or "a4"]
local LETTERS, SMALLEST = paper.row * 0.7, 4.2
local rate = math.max(1, math.floor(made.fps + 0.5))

-- ---------------------------------------------------------------- letters

local font, known, widths = nil, {}, {}

local function has_letter(letter)
  if known[letter] == nil then
    known[letter] = pcall(celspan.glyphs, { letter, font = font })
  end
  return known[letter]
end

--- A text in letters that the font has, others as question marks.
local function letters_of(text)
  return (program.utf8(text):gsub("%s+", " "):gsub(utf8.charpattern, function(letter)
    return has_letter(letter) and letter or "?"
  end))
end

--- The width of a text of size 1.
local function width_of(text)
  if not widths[text] then
    widths[text] = text == "" and 0 or celspan.text({ text, font = font, size = 1 }):metrics().width
  end
  return widths[text]
end

--- A text and its size where there is this much room: it becomes smaller, then it is cut.
local function fitted(text, room, size)
  text = letters_of(text)
  local small = math.max(SMALLEST, math.min(size, room / math.max(width_of(text), 1e-6)))
  if width_of(text) * small <= room + 1e-6 then return text, small end
  local ends = has_letter "…" and "…" or ".."
  local function cut(count) return text:sub(1, utf8.offset(text, count + 1) - 1) .. ends end
  local low, high = 0, utf8.len(text)
  while low < high do
    local middle = (low + high + 1) // 2
    local is_short = width_of(cut(middle)) * small <= room
    low, high = is_short and middle or low, is_short and high or middle - 1
  end
  return cut(low), small
end

-- ---------------------------------------------------------------- a page while it is drawn

--- Adds a text whose middle, or left end, is at x, y. Returns its width.
local function add_text(page, text, x, y, room, options)
  local words, size = fitted(text, room, options and options.size or LETTERS)
  if words == "" then return 0 end
  local object = celspan.text { words, font = font, size = size, valign = "middle",
    align = options and options.align or "centre", texture = options and options.ink or INK }
  if options and options.degrees then object = object:rotate(options.degrees) end
  page.texts[#page.texts + 1] = object:translate(x, y)
  return width_of(words) * size
end

local function add_line(page, width, ink, x, y, to_x, to_y)
  local key = width .. ink
  if not page.lines[key] then
    page.lines[key] = { width = width, ink = ink }
    page.lines[#page.lines + 1] = page.lines[key]
  end
  table.insert(page.lines[key], ("M%.3f %.3fL%.3f %.3f"):format(x, y, to_x, to_y))
end

local function add_shape(page, object) page.texts[#page.texts + 1] = object end

local function objects_of(page)
  local list = {} -- no white: the paper is, and areas without neighbours are small files
  for _, line in ipairs(page.lines) do
    list[#list + 1] = celspan.stroke { d = table.concat(line), width = line.width,
      texture = line.ink }
  end
  return table.move(page.texts, 1, #page.texts, #list + 1, list)
end

-- ---------------------------------------------------------------- the grid

local PART = rate % 3 == 0 and rate // 3 or rate % 5 == 0 and rate // 5 or rate

--- The line below row `inside` of a second: thick, middle at half of it, light at thirds or fifths.
local function line_below(inside)
  if inside == rate then return 1.3, LINE end
  if rate % 2 == 0 and inside == rate // 2 then return 0.7, LINE end
  if inside % PART == 0 then return 0.45, LINE end
  return 0.2, FAINT
end

local function add_rows(page, strip)
  for frame = strip.from, strip.from + strip.rows - 1 do
    local inside, y = (frame - 1) % rate + 1, strip.y + (frame - strip.from + 1) * strip.row
    local middle = y - strip.row / 2
    local width, ink = line_below(inside)
    add_line(page, width, ink, strip.x, y, strip.x + strip.w, y)
    if inside == 1 and frame <= made.frames then
      add_text(page, tostring((frame - 1) // rate + 1), strip.x + SECOND / 2, middle, SECOND - 2,
        { size = LETTERS * 1.25 })
    end
    if inside % 2 == 0 or inside == rate then
      add_text(page, tostring(frame), strip.x + SECOND + FRAME - 2, middle, FRAME - 3,
        { size = LETTERS * 0.8, align = "right", ink = inside == rate and INK or LINE })
    end
  end
end

--- Hatches the rows after the last frame.
local function add_end(page, strip)
  local y = strip.y + (made.frames - strip.from + 1) * strip.row
  local bottom = strip.y + strip.rows * strip.row
  if y >= bottom - 1e-6 then return end
  add_line(page, 1.6, INK, strip.x, math.max(y, strip.y), strip.x + strip.w, math.max(y, strip.y))
  add_line(page, 0.6, INK, strip.x, bottom, strip.x + strip.w, math.max(y, strip.y))
end

local function add_names(page, strip)
  local top, bottom = strip.y - NAMES, strip.y + strip.rows * strip.row
  add_line(page, 0.9, LINE, strip.x, top, strip.x + strip.w, top)
  add_line(page, 0.9, LINE, strip.x, strip.y, strip.x + strip.w, strip.y)
  for _, column in ipairs(strip.columns) do
    local x, w = column.x, column.w
    add_line(page, column.layer and 0.35 or 0.9, LINE, x, top, x, bottom)
    if column.layer and w < 30 and width_of(letters_of(column.name)) * LETTERS > w - 3 then
      add_text(page, column.name, x + w / 2, top + NAMES / 2, NAMES - 4, { degrees = -90 })
    else
      add_text(page, column.name, x + w / 2, top + NAMES / 2, w - 3)
    end
  end
  add_line(page, 0.9, LINE, strip.x + strip.w, top, strip.x + strip.w, bottom)
end

-- ---------------------------------------------------------------- cels

local function row_middle(strip, frame) return strip.y + (frame - strip.from + 0.5) * strip.row end

local function add_dot(page, x, y)
  add_shape(page, celspan.circle { centre = { x, y }, radius = 1.7, texture = INK })
end

local function add_oval(page, x, y, across, down)
  add_shape(page, celspan.stroke { width = 0.6, texture = INK,
    d = ("M%f %fa%f %f 0 1 0 %f 0a%f %f 0 1 0 %f 0Z"):format(x - across, y, across, down,
      2 * across, across, down, -2 * across) })
end

--- Adds the name of a drawing with its marks: a dot before it, a circle around it.
local function add_drawing(page, x, y, w, name, marks, row)
  local dot = marks.inbetween and 5 or 0
  local wide = add_text(page, name, x + w / 2 + dot / 2, y, w - 4 - dot)
  if dot > 0 then add_dot(page, x + w / 2 - wide / 2, y) end
  if marks.key then
    local radius = row * 0.46
    local reach = math.min(math.max(radius, wide / 2 + 1.6), w / 2 - 0.6)
    add_oval(page, x + w / 2, y, reach, radius)
  end
end

--- Adds the marks that lie on the line of a held drawing, and a tick where it is moved.
local function add_marks(page, x, y, w, marks, is_new)
  if marks.inbetween and not is_new then add_dot(page, x + w / 2, y) end
  if marks.key and not is_new then add_oval(page, x + w / 2, y, 3.6, 3.6) end
  if marks.reverse then add_oval(page, x + w / 2, y, 2.2, 2.2) end
  if marks.moved then add_line(page, 0.9, FAINT, x + w - 3, y, x + w - 0.8, y) end
end

--- Adds a run of frames with the same drawing, as far as it is in the strip. last: of the sheet.
local function add_run(page, strip, column, run)
  local from, to = math.max(run.frame, strip.from), math.min(run.last, strip.last)
  if from > to then return end
  local x, w, y = column.x, column.w, row_middle(strip, from)
  local centre, starts = x + w / 2, from == run.frame
  if not run.drawing then
    if starts then add_text(page, "x", centre, y, w - 4, { ink = LINE }) end
    return
  end
  if starts or from == strip.from then
    local name = starts and run.drawing or ("(%s)"):format(run.drawing)
    add_drawing(page, x, y, w, name, starts and column.marks[from] or {}, strip.row)
  end
  if to > from then
    local bottom = row_middle(strip, to) + strip.row / 2 - (to == run.last and 1.5 or 0)
    add_line(page, 0.7, INK, centre, y + strip.row / 2 + 0.6, centre, bottom)
  end
end

local function add_cels(page, strip, column)
  for _, run in ipairs(column.runs) do add_run(page, strip, column, run) end
  for frame = strip.from, strip.last do
    local marks = column.marks[frame]
    if marks then
      add_marks(page, column.x, row_middle(strip, frame), column.w, marks, column.starts[frame])
    end
  end
end

-- ---------------------------------------------------------------- notes

--- Puts notes that share frames beside each other: sets `lane` of each; returns how many there are.
local function lay_lanes(notes)
  local ends, count = {}, 1
  for _, note in ipairs(notes) do
    local lane = 1
    while lane < LANES_MOST and (ends[lane] or 0) >= note.from do lane = lane + 1 end
    note.lane, ends[lane] = lane, math.max(ends[lane] or 0, note.to)
    count = math.max(count, lane)
  end
  return count
end

--- A note that is short in frames is written across, any other beside its line, from top to bottom.
local function add_note(page, strip, column, note)
  local from, to = math.max(note.from, strip.from), math.min(note.to, strip.last)
  if from > to then return end
  local w = column.w / column.lanes
  local x, y = column.x + (note.lane - 1) * w, row_middle(strip, from)
  local bottom = row_middle(strip, to)
  if note.to - note.from < 3 then
    if from == note.from then add_text(page, note.text, x + w / 2, y, w - 3) end
    return
  end
  local top, half = y - strip.row / 2 + 1, strip.row / 2 - 1
  add_line(page, 0.7, INK, x + 4, top, x + 4, bottom + half)
  if from == note.from then add_line(page, 0.7, INK, x + 2, top, x + 6, top) end
  if to == note.to then add_line(page, 0.7, INK, x + 2, bottom + half, x + 6, bottom + half) end
  add_text(page, note.text, x + 4 + (w - 4) / 2, (top + bottom + half) / 2, bottom - top - 1,
    { degrees = 90, size = math.min(LETTERS, w - 5) })
end

-- ---------------------------------------------------------------- what a sheet has

--- The columns of cels: their runs, marks, and at which frames runs start.
local function columns_of_layers()
  local list = {}
  for i, name in ipairs(made.layers) do
    local column = { layer = i, name = name, runs = made:changes(i), marks = made:marks(i),
                     starts = {} }
    for k, run in ipairs(column.runs) do
      run.last = (column.runs[k + 1] or { frame = made.frames + 1 }).frame - 1
      column.starts[run.frame] = true
    end
    list[i] = column
  end
  return list
end

local function column_of_notes(kind, more)
  local notes = {}
  for _, given in ipairs { made.notes, more } do
    for _, note in ipairs(given) do
      local own = (note.kind == "dialogue" or note.kind == "camera") and note.kind or "action"
      local text = note.speaker and note.speaker .. ": " .. note.text or note.text
      if own == kind then notes[#notes + 1] = { from = note.from, to = note.to, text = text } end
    end
  end
  ordered.sort(ordered.sort(notes, "text"), "from")
  return { name = kind:upper(), notes = notes, lanes = lay_lanes(notes) }
end

-- ---------------------------------------------------------------- pages

--- How the pages are made: strips of a page, rows of a strip, and the layers of a page.
local function plan(layers)
  local height, width = paper[2] - TOP * 2 - HEAD - NAMES, paper[1] - 2 * SIDE
  local own = SECOND + FRAME
  for _, column in ipairs(NOTES) do own = own + column.least end
  local most = height // paper.row
  local rows = most >= rate and most // rate * rate or most
  local half = (width - GAP) / 2
  local strips = #layers * CELL <= half - own and 2 or 1
  local w = strips == 2 and half or width
  local across = math.max(1, math.tointeger((w - own) // CELL))
  local groups = math.max(1, (#layers + across - 1) // across)
  return { strips = strips, rows = math.tointeger(rows), w = w, own = own, groups = groups,
           across = (#layers + groups - 1) // groups, row = height / rows }
end

--- The columns of a strip, with their places: notes, cels, camera.
local function lay_columns(form, layers, notes, group, x)
  local first = (group - 1) * form.across + 1
  local shown = table.move(layers, first, math.min(#layers, first + form.across - 1), 1, {})
  local cell = math.min(CELL_MOST, (form.w - form.own) / math.max(1, form.across))
  local rest = form.w - form.own - cell * #shown
  local list = {}
  local function add(column, w)
    local one = setmetatable({ x = x, w = w }, { __index = column })
    list[#list + 1], x = one, x + w
  end
  add({ name = "" }, SECOND)
  add({ name = "" }, FRAME)
  for i, kind in ipairs(NOTES) do
    if i == #NOTES then for _, layer in ipairs(shown) do add(layer, cell) end end
    add(notes[i], kind.least + rest * kind.share / 7)
  end
  return list
end

local function add_strip(page, form, columns, from, x)
  local strip = { x = x, y = TOP + HEAD + NAMES, w = form.w, from = from, rows = form.rows,
                  row = form.row, columns = columns,
                  last = math.min(made.frames, from + form.rows - 1) }
  add_rows(page, strip)
  add_names(page, strip)
  for _, column in ipairs(columns) do
    if column.layer then add_cels(page, strip, column) end
    for _, note in ipairs(column.notes or {}) do add_note(page, strip, column, note) end
  end
  add_end(page, strip)
end

local function add_head(page, title, number, count)
  local x, w, bottom = SIDE, paper[1] - 2 * SIDE, TOP + HEAD - 10
  local facts = { { "TITLE", title, 0.4 }, { "SCENE", made.scene, 0.13 }, { "CUT", made.cut, 0.13 },
    { "TIME", ("%d+%02d"):format(made.frames // rate, made.frames % rate), 0.14 },
    { "RATE", ("%g"):format(made.fps), 0.08 }, { "PAGE", ("%d/%d"):format(number, count), 0.12 } }
  for _, y in ipairs { TOP, bottom } do add_line(page, 0.9, LINE, x, y, x + w, y) end
  for _, fact in ipairs(facts) do
    add_line(page, 0.9, LINE, x, TOP, x, bottom)
    add_text(page, fact[1], x + 4, TOP + 6, 40,
      { size = LETTERS * 0.7, align = "left", ink = LINE })
    add_text(page, fact[2], x + 4, TOP + 19, w * fact[3] - 8, { size = 11, align = "left" })
    x = x + w * fact[3]
  end
  add_line(page, 0.9, LINE, x, TOP, x, bottom)
end

--- The film of the pages. file: the font. more: notes beside those of the sheet.
return function(title, file, more)
  font = file
  local is_font, fault = pcall(celspan.glyphs, { "1", font = font })
  if not is_font then program.fail("input", "%s", (fault:gsub("^[^ ]*: ", ""))) end
  local layers, notes = columns_of_layers(), {}
  for i, column in ipairs(NOTES) do notes[i] = column_of_notes(column.kind, more) end
  local form = plan(layers)
  local frames_page = form.rows * form.strips
  local count = (made.frames + frames_page - 1) // frames_page * form.groups
  return celspan.film { title = title, size = { paper[1], paper[2] }, frames = count,
    frame = function(f)
      local page, group = { lines = {}, texts = {} }, f.index % form.groups + 1
      local first = f.index // form.groups * frames_page + 1
      add_head(page, title, f.index + 1, count)
      for i = 1, form.strips do
        local x, from = SIDE + (i - 1) * (form.w + GAP), first + (i - 1) * form.rows
        add_strip(page, form, lay_columns(form, layers, notes, group, x), from, x)
      end
      return celspan.rostrum { celspan.cel(objects_of(page)) }
    end }
end
