--- In-betweens of exposure sheets: the keys around a cell, and what a morph makes of them.
--
--   A1    |     o     |     A3    |     o     |     A5       o: a mark alone; A3 is not drawn
--   key         1/4         1/2         3/4         key      a run: two keys, three in-betweens
--
-- A cell begins where the drawing changes, or at a mark alone. A run goes from key to key without
-- an empty cell, or as a chart says: all between two names is then in-between.
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local morph = require "celspan.morph"
local native = require "celspan.native"
local ordered = require "celspan.ordered"

local between = {}
local known_fields = { between = "boolean", charts = "table", pairs = "table" }

local function refuse(subject, text, ...)
  native.refuse(("sheet: drawing: layer %q: "):format(subject.layer) .. text:format(...))
end

function between.missing(subject, name, frame)
  native.refuse(("sheet: drawing: layer %q shows %q at frame %d, which is missing from %s")
    :format(subject.layer, name, frame, subject.where))
end

local kept_cells = setmetatable({}, { __mode = "k" })

--- The cells of a column. A name is false where the layer is empty, and nil at a mark alone.
local function cells_of(column, frames)
  if kept_cells[column] then return kept_cells[column] end
  local cells, changes = {}, {}
  for i, frame in ipairs(column.at) do
    local marks = column.marks[frame] or {}
    cells[i] = { frame = frame, name = column.names[i], is_key = marks.key,
                 is_between = marks.inbetween and not marks.key }
    changes[frame] = true
  end
  for frame, marks in pairs(column.marks) do
    if marks.inbetween and not changes[frame] and frame >= 1 and frame <= frames then
      cells[#cells + 1] = { frame = frame, is_between = true }
    end
  end
  table.sort(cells, function(a, b) return a.frame < b.frame end)
  kept_cells[column] = cells
  return cells
end

local function is_key(subject, cell)
  return cell.name and not cell.is_between and (cell.is_key or subject.find(cell.name) ~= nil)
end

--- The cell of the next key in a direction; nil if there is none before the layer is empty.
local function next_key(subject, i, step)
  local cells = subject.cells
  repeat i = i + step until not cells[i] or cells[i].name == false or is_key(subject, cells[i])
  return cells[i] and cells[i].name and i
end

--- The run around a cell: that of a chart, else from key to key; nil and the side of a missing key.
local function run_around(subject, i)
  for _, run in ipairs(subject.charted) do
    if run.first < i and i < run.last then return run end
  end
  local first = next_key(subject, i, -1)
  local last = first and next_key(subject, i, 1)
  if not last then return nil, first and "after" or "before" end
  return { first = first, last = last,
           name = subject.cells[first].name .. "-" .. subject.cells[last].name }
end

--- The same for a drawing: a name is one drawing wherever it is shown, so its first run counts.
local function run_of(subject, i)
  local name = subject.cells[i].name
  for k, cell in ipairs(name and subject.cells or {}) do
    local run = cell.name == name and run_around(subject, k)
    if run then return run end
  end
  return run_around(subject, i)
end

local function all_runs(subject)
  local list, last = {}, 1
  for i, cell in ipairs(subject.cells) do
    local run = i >= last and cell.name ~= false and run_around(subject, i)
    if run and (run.is_charted or not is_key(subject, cell)) then
      list[#list + 1], last = run, run.last
    end
  end
  return list
end

--- The drawings of a run between its keys: their first frames, and their numbers by name or cell.
local function inner_of(subject, run)
  local frames, numbers = {}, {}
  for i = run.first + 1, run.last - 1 do
    local cell = subject.cells[i]
    if not numbers[cell.name or i] then
      frames[#frames + 1] = cell.frame
      numbers[cell.name or i] = #frames
    end
  end
  return frames, numbers
end

-- As animators say it: the drawings are close to the key that they go into, or come out of.
local spacings = { even = ease "linear", ["slow in"] = ease "outQuad",
                   ["slow out"] = ease "inQuad" }
local spacing_names = table.move(ease.names, 1, #ease.names, 4, { "even", "slow in", "slow out" })

local function spacing_of(subject, name, value)
  local good, found = pcall(ease, value)
  return spacings[value] or good and found or refuse(subject, "chart %q: there is no spacing %s%s",
    name, fields.shown(value), fields.hint(value, spacing_names)
      or "; write \"even\", \"slow in\", \"slow out\", an ease, or a list of shares")
end

local function shares_of(subject, run)
  local count, name, shares, before = #inner_of(subject, run), run.name, {}, 0
  local value = subject.charts[name] or "even"
  local curve = type(value) ~= "table" and spacing_of(subject, name, value)
  if not curve and rawlen(value) ~= count then
    refuse(subject, "chart %q: it has %d shares for %d in-betweens", name, rawlen(value), count)
  end
  for i = 1, count do
    local share = curve and curve(i / (count + 1)) or value[i]
    if not fields.is_finite(share) or share < before or share > 1 then
      refuse(subject, "chart %q: share %d must be from %s to 1, as shares ascend, got %s", name, i,
        fields.shown(before), fields.shown(share))
    end
    shares[i], before = share, share
  end
  return shares
end

--- Appends the runs with the names "FIRST-LAST" of a chart; names may have hyphens themselves.
local function add_named(cells, name, list)
  for at in name:gmatch "()%-" do
    local first, last = name:sub(1, at - 1), nil
    for i, cell in ipairs(cells) do
      if cell.name == false then last = nil end
      if last and cell.name == name:sub(at + 1) and i > last + 1 then
        list[#list + 1], last = { first = last, last = i, name = name, is_charted = true }, nil
      end
      if cell.name == first then last = i end
    end
  end
end

--- The runs that charts and pairs name, in order; checks all of them.
local function charted_runs(subject, names)
  local list = {}
  for _, name in ipairs(ordered.names(names)) do
    local count, others = #list, {}
    add_named(subject.cells, name, list)
    if #list == count then
      for i, run in ipairs(all_runs(subject)) do others[i] = run.name end
      refuse(subject, "chart %q: there are no in-betweens from key to key of this name%s", name,
        fields.choice(name, others))
    end
  end
  table.sort(list, function(a, b) return a.first < b.first end)
  for i, run in ipairs(list) do
    if i > 1 and run.first < list[i - 1].last then
      refuse(subject, "the charts %q and %q overlap", list[i - 1].name, run.name)
    end
    shares_of(subject, run)
  end
  return list
end

--- Reads and checks the options of a subject. Returns whether the caller wants in-betweens.
function between.read(subject)
  local options, names = subject.options, {}
  fields.check("sheet: drawing", options, known_fields)
  subject.charts, subject.pairs = options.charts or {}, options.pairs or {}
  subject.cells, subject.charted = cells_of(subject.column, subject.frames), {}
  for _, given in ipairs { subject.charts, subject.pairs } do
    for name in next, given do
      if given == subject.charts or type(name) == "string" then names[fields.key(name)] = true end
    end
  end
  subject.charted = charted_runs(subject, names)
  return options.between or options.between == nil and (options.charts or options.pairs)
end

local function key_drawing(subject, cell)
  local object = subject.find(cell.name) or between.missing(subject, cell.name, cell.frame)
  fields.expect_kind(fields.is_object(object), object,
    "sheet: drawing: the key %q must be an object to be morphed", cell.name)
  if tostring(object):find "^image" then
    refuse(subject, "the key %q is a picture, which has no in-betweens: trace it (trace.picture), "
      .. "or draw the in-betweens", cell.name)
  end
  return object
end

--- The object of a run at a share of the way, and the pairs that are not sure.
local function morphed(subject, run, share)
  local cells = subject.cells
  return morph.drawings(key_drawing(subject, cells[run.first]),
    key_drawing(subject, cells[run.last]), share, subject.pairs[run.name] or subject.pairs)
end

--- Warns of what may be a mistake in a run, around one of its cells.
local function warn_of(subject, run, cell, unsure)
  local function warn(text, ...)
    native.warn(("sheet: layer %q, %s: "):format(subject.layer, run.name) .. text:format(...))
  end
  for _, pair in ipairs(unsure or {}) do
    warn("the piece at (%g, %g) may not be the one at (%g, %g): name both, or give pairs",
      pair[1][1], pair[1][2], pair[2][1], pair[2][2])
  end
  if cell.name and not cell.is_between and not run.is_charted then
    warn("%q has no drawing and no mark i, and is shown as an in-between", cell.name)
  end
  local first, last = subject.cells[run.first], subject.cells[run.last]
  local is_first_empty = not key_drawing(subject, first):bounds()
  if is_first_empty ~= not key_drawing(subject, last):bounds() then
    warn("the key %q is empty, and the other one is not",
      is_first_empty and first.name or last.name)
  end
end

function between.drawing(subject, frame)
  local i = ordered.last(subject.cells, frame, "frame")
  local cell = subject.cells[i]
  if not cell or cell.name == false or frame > subject.frames then return nil end
  local own = cell.name and subject.find(cell.name)
  if own ~= nil then return own end
  local run, side = run_of(subject, i)
  if cell.is_key or not run and not cell.is_between then
    between.missing(subject, cell.name, cell.frame)
  end
  if not run then
    refuse(subject, "the in-between at frame %d has no key %s it; give the drawing of a key there, "
      .. "or take its mark away", cell.frame, side)
  end
  local number = select(2, inner_of(subject, run))[cell.name or i]
  local object, unsure = morphed(subject, run, shares_of(subject, run)[number])
  if native.warns() then warn_of(subject, run, cell, unsure) end
  return object
end

local Charts = { __tostring = function(list)
  local lines = {}
  for i, chart in ipairs(list) do
    lines[i] = ("%s, frames %d to %d:%s"):format(chart.name, chart.from, chart.to,
      (" %.4g"):rep(#chart.shares):format(table.unpack(chart.shares)))
  end
  return table.concat(lines, "\n")
end }

--- The charts of all runs. has_drawings: pairs of pieces are looked at, too.
function between.charts(subject, has_drawings)
  local list, cells = {}, subject.cells
  for i, run in ipairs(all_runs(subject)) do
    list[i] = { name = run.name, from = cells[run.first].frame, to = cells[run.last].frame,
                frames = inner_of(subject, run), shares = shares_of(subject, run),
                unsure = has_drawings and select(2, morphed(subject, run, 0.5)) or nil }
  end
  return setmetatable(list, Charts)
end

return between
