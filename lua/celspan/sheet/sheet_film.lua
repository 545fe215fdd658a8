--- The columns of a sheet from the frames of a film.
local columns = require "celspan.columns"
local native = require "celspan.native"

local sheet_film = {}

--- The label of each part of a frame: its name; with the kind, if two kinds have the same name.
local function column_for(state, part)
  local column = state.by_key[part.kind .. " " .. part.name]
  if column then return column end
  local name = part.name
  if state.taken[name] then name = ("%s (%s)"):format(name, part.kind) end
  column = columns.new(name)
  column.numbers, column.count = {}, 0
  state.taken[name] = true
  state.by_key[part.kind .. " " .. part.name] = column
  state.layers[#state.layers + 1] = column
  return column
end

--- A drawing is numbered when it first appears, and recognised later by its contents.
local function number_of(column, drawing)
  local number = column.numbers[drawing]
  if not number then
    column.count = column.count + 1
    number = tostring(column.count)
    column.numbers[drawing] = number
  end
  return number
end

--- The parts of a frame by name. A part that occurs several times, for instance in two exposures,
--- is one part, and each different drawing and placement of it counts once.
local function merge_parts(list)
  local order, by_key = {}, {}
  for _, part in ipairs(list) do
    local key = part.kind .. " " .. part.name
    local one = by_key[key]
    if not one then
      one = { kind = part.kind, name = part.name, drawing = "", placement = "", known = {} }
      by_key[key], order[#order + 1] = one, one
    end
    for _, half in ipairs { "drawing", "placement" } do
      local hash = part[half]
      if not one.known[half .. hash] then
        one.known[half .. hash], one[half] = true, one[half] .. hash
      end
    end
    one.procedure = one.procedure or part.procedure
  end
  return order
end

local function add_part(column, part, frame)
  if part.procedure then
    columns.add(column, frame, column.names[#column.names] or "procedure")
    columns.mark(column, frame, "procedure")
  else
    columns.add(column, frame, number_of(column, part.drawing))
  end
  if column.met == frame - 1 and column.placement ~= part.placement then
    columns.mark(column, frame, "moved")
  end
  column.placement, column.met = part.placement, frame
end

local function add_frame(state, list, frame)
  for _, part in ipairs(merge_parts(list)) do add_part(column_for(state, part), part, frame) end
  for _, column in ipairs(state.layers) do
    if column.met ~= frame then columns.add(column, frame, false) end
  end
end

--- The columns of all frames, or of those with the listed numbers.
function sheet_film.columns(film, listed)
  local state = { layers = {}, by_key = {}, taken = {} }
  for index = 1, listed and #listed or film.frames do
    local number = listed and listed[index] or film.first + index - 1
    add_frame(state, native.parts(film:at(number)), index)
  end
  return state.layers
end

return sheet_film
