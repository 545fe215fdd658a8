--- The columns of a sheet from the frames of a film.
local columns = require "celspan.columns"
local native = require "celspan.native"
local scenes = require "celspan.scenes"

local sheet_film = {}

local function key_of(part) return part.kind .. " " .. part.name end

--- The column of a part: its name; with the kind, if two kinds have the same name.
local function column_for(state, part)
  local column, name = state.by_key[key_of(part)], part.name
  if column then return column end
  if state.taken[name] then name = ("%s (%s)"):format(name, part.kind) end
  column = columns.new(name)
  column.numbers, column.count = {}, 0
  state.taken[name], state.by_key[key_of(part)] = true, column
  state.layers[#state.layers + 1] = column
  return column
end

--- A drawing is numbered when it first appears, and recognised later by its contents.
local function number_of(column, drawing)
  if not column.numbers[drawing] then
    column.count = column.count + 1
    column.numbers[drawing] = tostring(column.count)
  end
  return column.numbers[drawing]
end

--- The parts of a frame by name. A part that occurs several times, for instance in two exposures,
--- is one part, and each different drawing and placement of it counts once.
local function merge_parts(list)
  local order, by_key = {}, {}
  for _, part in ipairs(list) do
    local one = by_key[key_of(part)]
    if not one then
      one = { kind = part.kind, name = part.name, drawing = "", placement = "", known = {} }
      by_key[key_of(part)], order[#order + 1] = one, one
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

--- What a frame shows, where multiplane cameras rest.
local function shown(film, number)
  scenes.rest "on"
  local good, made = pcall(film.at, film, number)
  scenes.rest "off"
  return good and made or error(made, 0)
end

--- The columns of all frames, or of those with the listed numbers.
function sheet_film.columns(film, listed)
  local state = { layers = {}, by_key = {}, taken = {} }
  for frame = 1, listed and #listed or film.frames do
    local number = listed and listed[frame] or film.first + frame - 1
    for _, part in ipairs(merge_parts(native.parts(shown(film, number)))) do
      add_part(column_for(state, part), part, frame)
    end
    for _, column in ipairs(state.layers) do
      if column.met ~= frame then columns.add(column, frame, false) end
    end
  end
  return state.layers
end

return sheet_film
