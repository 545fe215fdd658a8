--- Areas of a drawing that are found again in the drawings after it: ink.follow.
--
--   areas as they were --likely movement--> how like each is to each area of the next drawing, by
--     place, size, length and width --what lies beside both--> shares of each in each, which with
--     NOISE add up to 1 both ways --> sure, or not
--
-- What has no name takes part, too: so it does not get the name of what it hides. What is not sure
-- stays as it was, moved, until it is found. Only sqrt is used of libm: all machines name alike.
local native = require "celspan.native"
local fields = require "celspan.fields"
local charts = require "celspan.ink_chart"

local ink = {}

local SURE = 0.5   -- the least share: only one can have it
local REACH = 0.04 -- of the drawing's size: how far areas stray from the common movement
local NOISE = 0.04 -- the likeness of what is nowhere
local FAINT = 1e-4 -- likenesses below do not count
local STAYS = 0.6  -- how far the part of the drawing that an area has may differ from the first one
local ROUNDS, TURNS = 2, 6

local function sorted(list)
  local keys = {}
  for key in pairs(list) do keys[#keys + 1] = key end
  table.sort(keys)
  return keys
end

--- number, at, x, y of the middle, size, long, wide, in units; beside = { { other, share } }, where
--- the other is false for the outside.
local function trait_of(chart, number, measure)
  local size, scale = measure[1], chart.scale
  local x, y = measure[2] / size, measure[3] / size
  local xx, xy, yy = measure[4] / size - x * x, measure[5] / size - x * y, measure[6] / size - y * y
  local mean, half = (xx + yy) / 2, math.sqrt((xx - yy) * (xx - yy) / 4 + xy * xy)
  x, y = chart:place(x, y)
  return { number = number, at = { chart:place(measure[7], measure[8]) }, x = x, y = y, beside = {},
    size = size / (scale * scale), long = math.sqrt(mean + half + 1 / 12) / scale,
    wide = math.sqrt(math.max(mean - half, 0) + 1 / 12) / scale }
end

--- The traits of all areas of a drawing, in the order of their numbers, with x, y of their middle;
--- and by their numbers.
local function traits_of(search)
  local list, by_number, all = { x = 0, y = 0 }, { [0] = false }, 0
  local measures = search.chart
    and native.areas_measures(search.chart:divide(search.noun, search.gap)) or {}
  for i, number in ipairs(sorted(measures)) do
    if i > 1 then -- the first one is the outside
      list[i - 1] = trait_of(search.chart, number, measures[number])
      by_number[number], all = list[i - 1], all + list[i - 1].size
    end
  end
  for _, trait in ipairs(list) do
    local borders, sum = measures[trait.number].borders, 0
    for _, count in pairs(borders) do sum = sum + count end
    for i, other in ipairs(sorted(borders)) do
      trait.beside[i] = { by_number[other], borders[other] / sum }
    end
    trait.part = trait.size / all
    list.x, list.y = list.x + trait.x * trait.part, list.y + trait.y * trait.part
  end
  return list, by_number
end

local function square(value) return value * value end

--- The square of about the logarithm of a ratio.
local function apart(a, b) return square(2 * (a - b) / (a + b)) end

--- About exp(-q / 2).
local function falling(q) return square(square(square(1 / (1 + q / 16)))) end

--- A movement { a, b, x, y, u, v }: x, y goes to u, v, and what is about it is turned and scaled.
local function moved(move, one)
  local x, y = one.x - move[3], one.y - move[4]
  return move[1] * x - move[2] * y + move[5], move[2] * x + move[1] * y + move[6]
end

--- The pairs that are like each other after a movement.
local function pair(rows, columns, move, reach)
  local found = {}
  for _, row in ipairs(rows) do
    local far = square(reach + math.sqrt(row.size) / 3)
    local x, y = moved(move, row)
    for _, one in ipairs(columns) do
      local plain = falling((square(x - one.x) + square(y - one.y)) / far
        + apart(row.size, one.size) / 0.09 + apart(row.long, one.long) / 0.04
        + apart(row.wide, one.wide) / 0.04)
      if plain > FAINT then found[#found + 1] = { row = row, column = one, plain = plain } end
    end
  end
  return found
end

--- The movement that fits pairs best, by their shares; the one before if there are none.
local function fit(found, before)
  local sum, x, y, u, v, a, b, all = 0, 0, 0, 0, 0, 0, 0, 0
  for _, one in ipairs(found) do
    local row, column, w = one.row, one.column, one.share
    sum, x, y, u, v = sum + w, x + w * row.x, y + w * row.y, u + w * column.x, v + w * column.y
  end
  x, y, u, v = x / sum, y / sum, u / sum, v / sum
  for _, one in ipairs(found) do
    local w, p, q = one.share, one.row.x - x, one.row.y - y
    local r, s = one.column.x - u, one.column.y - v
    a, b, all = a + w * (p * r + q * s), b + w * (p * s - q * r), all + w * (p * p + q * q)
  end
  return all > 0 and { a / all, b / all, x, y, u, v } or before
end

--- How much of a row's border has the neighbours of its column: 0..1.
local function support(one)
  local sum = 0
  for _, near in ipairs(one.row.beside) do
    for _, other in ipairs(one.column.beside) do
      local share = near[1] and other[1] and (near[1].to and near[1].to[other[1]] or 0)
        or near[1] == other[1] and 1 or 0
      sum = sum + share * math.min(near[2], other[2])
    end
  end
  return sum
end

--- Scales one side of the pairs so that the shares of each of its areas, with NOISE, are 1 in all.
local function balance(found, side, other)
  local sums = {}
  for _, one in ipairs(found) do
    sums[one[side]] = (sums[one[side]] or NOISE) + one.like * (one[other].scaled or 1)
  end
  for one, sum in pairs(sums) do one.scaled = 1 / sum end
end

--- Gives pairs their shares, and rows their best pair.
local function share_out(found, rows)
  for _, one in ipairs(found) do
    one.like, one.column.scaled = one.plain * (0.2 + 0.8 * (one.support or 1)), nil
  end
  for _ = 1, TURNS do
    balance(found, "row", "column")
    balance(found, "column", "row")
  end
  for _, row in ipairs(rows) do row.to, row.best = {}, nil end
  for _, one in ipairs(found) do
    local row = one.row
    one.share = one.like * row.scaled * one.column.scaled
    row.to[one.column] = one.share
    if not row.best or one.share > row.best.share then row.best = one end
  end
  for _, one in ipairs(found) do one.support = support(one) end
end

--- The movement from rows to columns; and the rows have their best pairs.
local function match(rows, columns, reach)
  local move = { 1, 0, rows.x, rows.y, columns.x, columns.y }
  for _ = 1, ROUNDS do
    local found = pair(rows, columns, move, reach)
    share_out(found, rows)
    move = fit(found, move)
  end
  local found = pair(rows, columns, move, reach)
  for _ = 1, ROUNDS do share_out(found, rows) end
  return move
end

--- names, seeds and options as given, the results in `cels` and `unsure`; rows: the traits of what
--- is looked for, with `name`, and `first`, the part of the drawing that it had.
local Follower = {}
Follower.__index = Follower

local function name_of(name) return "seeds." .. name end

--- The rows, and what is found by name, of the first drawing.
function Follower:begin(search)
  local rows, by_number = traits_of(search)
  local found = search:seek(self.seeds, self.names, name_of, function() end)
  for name, number in pairs(found) do
    local trait = by_number[number]
    found[name], trait.name, trait.sure, trait.first = trait, name, 1, trait.part
  end
  return rows, found
end

--- The rows, what is found by name, and where the others may be, in a drawing after it.
function Follower:go_on(search)
  local columns, rows = traits_of(search), self.rows
  if #columns == 0 then columns.x, columns.y = rows.x, rows.y end
  local _, _, w, h = search.object:bounds()
  local move = match(rows, columns, REACH * math.max(w or 0, h or 0))
  local next_rows, found, guesses, guessed = { x = columns.x, y = columns.y }, {}, {}, {}
  for _, row in ipairs(rows) do
    local column, name = row.best and row.best.column, row.name
    local sure = column and name
      and row.best.share * falling(apart(row.first, column.part) / (STAYS * STAYS)) or 0
    row.x, row.y = moved(move, row)
    if sure >= SURE then
      found[name], column.name, column.sure, column.first = column, name, sure, row.first
    elseif name then
      guesses[name] = { at = column and column.at or { row.x, row.y }, sure = sure }
      next_rows[#next_rows + 1], guessed[column or row] = row, true
    end
  end
  for _, column in ipairs(columns) do
    if column.name or not guessed[column] then next_rows[#next_rows + 1] = column end
  end
  return next_rows, found, guesses
end

--- Adds the results of a drawing.
function Follower:add(key, lines)
  local options, numbers, cels = self.options, {}, {}
  local search = charts.search(("ink: follow: drawings[%d]"):format(key), lines, options)
  local rows, found, guesses = self[self.rows and "go_on" or "begin"](self, search)
  self.rows = rows
  for _, name in ipairs(self.names) do
    numbers[#numbers + 1] = found[name] and found[name].number
  end
  local paths = search:outline(numbers, options.under ~= false)
  for _, name in ipairs(self.names) do
    local one = found[name] or guesses[name]
    cels[name] = { at = one.at, sure = one.sure, object = found[name]
      and paths[one.number]:with { fill = self.seeds[name][3] } or options.fallback }
    if not found[name] then
      table.insert(self.unsure, { drawing = key, name = name, at = one.at })
    end
  end
  self.cels[key] = cels
  search:finish()
end

local function keys_of(list, is_key, what)
  fields.takes("ink: follow", "table", what, list)
  local is_right = next(list) ~= nil
  for key in pairs(list) do is_right = is_right and is_key(key) end
  return is_right and sorted(list) or native.refuse("ink: follow takes " .. what)
end

---@class celspan.ink.cel
---@field object? celspan.object The area in the paint of its seed; `fallback` if it is not sure
---@field at number[] A point inside; of one that is not sure, where it may be
---@field sure number 0 to 1: at least 0.5 is sure

--- The areas of the first drawing in all drawings. Errors are those of `areas`, for the first one.
---@param drawings table<integer, celspan.object|table> Lines by number, as of `areas`
---@param seeds table<string, any[]> By name: { x, y [, paint] }, a point inside the area
---@param options? celspan.ink.areas.options `gap`, `under`, `scale`; `fallback` is shown for what is not sure
---@return table<integer, table<string, celspan.ink.cel>> cels By number and name
---@return { drawing: integer, name: string, at: number[] }[] unsure What must be looked at
function ink.follow(drawings, seeds, options)
  local noun = "ink: follow"
  local keys = keys_of(drawings, function(key) return math.type(key) == "integer" end,
    "lines of one or more drawings by number")
  local names = keys_of(seeds, function(key) return type(key) == "string" end,
    "one or more seeds {x, y [, paint]} by name")
  for _, name in ipairs(names) do
    fields.numbers(noun, name_of(name) .. "[%d]", seeds[name], 2, "{x, y [, paint]}")
  end
  local follower = setmetatable({ names = names, seeds = seeds, cels = {}, unsure = {},
    options = charts.check(noun, options or {}, {}) }, Follower)
  for _, key in ipairs(keys) do follower:add(key, drawings[key]) end
  return follower.cels, follower.unsure
end

return ink
