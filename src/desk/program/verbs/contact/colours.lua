--- celspan contact --palette: the main colours of a film by time, and the mean of each shot.
--
--   +---+---+---+---+    a column for each frame that is looked at: its main colours, dark ones
--   |   |   |   |   |    below, as high as their share of the frame
--   +---+---+---+---+
--   |  mean | mean  |    a bar for each shot, in light, with the number of its first frame
--   +-------+-------+
--   1       25
local program, request, script, number_at, output = ...
local celspan = require "celspan"
local json = require "celspan.json"
local ordered = require "celspan.ordered"

local WIDE, HIGH, BAR, LABEL = 1440, 300, 72, 28 -- pixels
local COLUMNS_MOST, MAIN = 360, 6
local LOOKED = 32 -- pixels of the longer side of a frame that is looked at
local STEPS = 6 -- of each channel, in which colours are alike

local longer = math.max(script.size[1], script.size[2])
local size = { math.max(1, math.floor(LOOKED * script.size[1] / longer + 0.5)),
               math.max(1, math.floor(LOOKED * script.size[2] / longer + 0.5)) }

--- The pixels of a frame in light, over black: a list of r, g, b.
local function light_of(number)
  local pixels = program.check(celspan.pixels(program.still(script, script:at(number)),
    { size = size, antialias = "none", workers = math.tointeger(request.workers) }))
  local list = {}
  for y = 0, size[2] - 1 do
    for x = 0, size[1] - 1 do list[#list + 1] = { pixels:get(x, y) } end
  end
  return list
end

--- Adds a colour, or another sum, to a sum of several.
local function add(sum, colour)
  sum.count = sum.count + (colour.count or 1)
  for i = 1, 3 do sum[i] = sum[i] + colour[i] end
end

local function new() return { 0, 0, 0, count = 0 } end

--- The texture of the mean of a sum.
local function texture_of(sum)
  local mean = {}
  for i = 1, 3 do mean[i] = math.min(1, math.max(0, sum[i] / math.max(1, sum.count))) end
  return celspan.paint { pigment = mean }
end

local function brightness(sum)
  return (0.2126 * sum[1] + 0.7152 * sum[2] + 0.0722 * sum[3]) / math.max(1, sum.count)
end

--- The main colours of a frame, the brightest first, and the sum of all.
local function main_colours(number)
  local bins, whole = {}, new()
  for _, colour in ipairs(light_of(number)) do
    local key = 0
    for i = 1, 3 do
      local code = math.min(1, math.max(0, colour[i])) ^ 0.5 -- nearly as bright as it looks
      key = key * STEPS + math.min(STEPS - 1, math.floor(code * STEPS))
    end
    bins[key] = bins[key] or new()
    add(bins[key], colour)
    add(whole, colour)
  end
  local list = {}
  for key = 0, STEPS ^ 3 - 1 do list[#list + 1] = bins[key] end
  for _, bin in ipairs(list) do bin.rarity, bin.darkness = -bin.count, -brightness(bin) end
  local main = table.move(ordered.sort(list, "rarity"), 1, math.min(MAIN, #list), 1, {})
  return ordered.sort(main, "darkness"), whole
end

--- The places of the first frames of shots among the numbers; of a film without shots, 1.
local function starts_of(numbers)
  local text, starts = script:kept("celspan.shots", "text", tostring(script.frames)), { [1] = true }
  for _, shot in ipairs(text ~= "" and json.decode(text) or {}) do
    for i, number in ipairs(numbers) do
      if number - script.first + 1 >= shot.from then
        starts[i] = true
        break
      end
    end
  end
  return starts
end

local function rectangle(x, y, width, height, texture)
  return celspan.rect { x, y, width, height, texture = texture }
end

--- Adds the column of a frame.
local function add_column(objects, main, x, width)
  local sum, y = 0, 0
  for _, one in ipairs(main) do sum = sum + one.count end
  for _, one in ipairs(main) do
    local height = HIGH * one.count / sum
    objects[#objects + 1] = rectangle(x, y, width, height, texture_of(one))
    y = y + height
  end
end

--- Adds the bar of a shot, with a light line where it begins.
local function add_shot(objects, shot, x, to)
  objects[#objects + 1] = rectangle(x, HIGH + 8, to - x, BAR, texture_of(shot.sum))
  objects[#objects + 1] = rectangle(x, HIGH, 1, BAR + LABEL, "#8a8780")
  objects[#objects + 1] = number_at(tostring(shot.number), x + 5, HIGH + BAR + 14)
end

local numbers = script:numbers()
local starts = starts_of(numbers)
local every = (#numbers + COLUMNS_MOST - 1) // COLUMNS_MOST
local objects = { rectangle(0, 0, WIDE, HIGH + BAR + LABEL + 8, "#e8e6e1") }
local shots, columns = {}, {}
program.count_frames(#numbers)
for i, number in ipairs(numbers) do
  if starts[i] then shots[#shots + 1] = { number = number, from = i, sum = new() } end
  if (i - 1) % every == 0 or starts[i] then
    local main, whole = main_colours(number)
    add(shots[#shots].sum, whole)
    columns[#columns + 1] = { main = main, from = i }
  end
  program.made_frame(number, output)
end
local function place(i) return WIDE * (i - 1) / #numbers end
for i, column in ipairs(columns) do
  local next_column = columns[i + 1]
  local to = place(next_column and next_column.from or #numbers + 1)
  add_column(objects, column.main, place(column.from), to - place(column.from))
end
for i, shot in ipairs(shots) do
  local after = shots[i + 1]
  add_shot(objects, shot, place(shot.from), place(after and after.from or #numbers + 1))
end
program.check(celspan.render(celspan.rostrum { antialias = "area", celspan.cel(objects) }, output,
  { size = { WIDE, HIGH + BAR + LABEL + 8 }, workers = math.tointeger(request.workers) }))
