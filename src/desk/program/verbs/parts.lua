--- The elements of a drawing on a numbered sheet: what `celspan info --parts-picture` makes.
--
--   +------+ +------+       each element in its colours over the whole drawing, which is pale,
--   |  ##  | |    # |       with its number: art:with { ["#7"] = ... }
--   +------+ +------+
--    2        7
local program, art, output = ...
local celspan = require "celspan"
local number_at = program.part "numerals.lua"

-- panels in a row; the longer side of a panel; the most panels on a sheet
local COLUMNS, PANEL, MOST = 6, 160, 240
local GAP, LABEL = 12, 24

local all = art:elements()
local shown = math.max(1, math.min(#all, MOST))
local scale = PANEL / math.max(art.width, art.height)
local w, h = math.max(1, math.ceil(art.width * scale)), math.max(1, math.ceil(art.height * scale))
local rows = (shown - 1) // COLUMNS + 1
local width, height = GAP + math.min(shown, COLUMNS) * (w + GAP), GAP + rows * (h + LABEL)

local pale = art.object:fade(0.15)
local objects = { celspan.rect { 0, 0, width, height, texture = "#e8e6e1" } }
for i = 1, math.min(#all, MOST) do
  local x, y = GAP + (i - 1) % COLUMNS * (w + GAP), GAP + (i - 1) // COLUMNS * (h + LABEL)
  local page = celspan.rect { 0, 0, art.width, art.height, texture = "#fff" }
  local panel = page | celspan.clip(pale | all[i].object, page)
  objects[#objects + 1] = panel:scale(scale):translate(x, y)
  objects[#objects + 1] = number_at(all[i].name:sub(2), x + 1, y + h + 6)
end
program.write(celspan.rostrum { size = { width, height }, celspan.cel(objects) }, output)
if #all > MOST then
  program.note("%s: the first %d of %d elements are shown", output, MOST, #all)
end
