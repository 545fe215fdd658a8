--- Flashes, by success criterion 2.3.1 of WCAG: more than three in a second, over more than a
--- quarter of the frame.
--
--   1.0        +---+   +---+         a change is one of 0.1 or more of the relative luminance of a
--              |   |   |   |         cell, of which the darker end is below 0.8; slow and stepped
--   0.2   -----+   +---+   +---      changes count from the last extreme
--              up  down up down      two opposing changes are a flash: here are two
--
-- A cell flashes at a frame if it made 8 changes in the second that ends there. Cells are small
-- parts of the frame, of equal size; the luminance of one is the mean of its light.
local flashes = {}
flashes.__index = flashes

local CHANGE, DARK, AREA = 0.1, 0.8, 0.25
local CHANGES = 8 -- the changes of four flashes
local ROUNDING = 1e-6 -- lights are floats

--- fps: of the film. area: the share of the cells that must flash, by default that of WCAG.
function flashes.new(fps, area)
  return setmetatable({ fps = fps, area = area or AREA, list = {} }, flashes)
end

--- Forgets the cells. Needed before a frame that does not follow the previous one.
function flashes:cut() self.cells = nil end

local function new_cell(light) return { low = light, high = light, way = 0, at = {}, next = 1 } end

--- Examines the light of a cell. way: the direction of its last change, 1 up, -1 down, 0 none.
--- Returns whether this is a change.
local function change(cell, light)
  if cell.way >= 0 then
    cell.high = math.max(cell.high, light)
    if cell.high - light >= CHANGE - ROUNDING and light < DARK - ROUNDING then
      cell.way, cell.low = -1, light
      return true
    end
  end
  if cell.way <= 0 then
    cell.low = math.min(cell.low, light)
    if light - cell.low >= CHANGE - ROUNDING and cell.low < DARK - ROUNDING then
      cell.way, cell.high = 1, light
      return true
    end
  end
  return false
end

--- Adds the frame of a change: the last CHANGES of them are kept in a ring.
local function keep(cell, frame)
  cell.at[cell.next] = frame
  cell.next = cell.next % CHANGES + 1
end

--- The first of the last CHANGES changes; nil: there were fewer.
local function first_of(cell) return cell.at[cell.next] end

--- Adds a stretch, or extends the last one.
local function add(list, first, last, share)
  local before = list[#list]
  if before and first <= before.last then
    before.last, before.share = last, math.max(before.share, share)
  else
    list[#list + 1] = { first = first, last = last, share = share }
  end
end

--- Examines the next frame: its number, and the relative luminances of its cells.
function flashes:add(frame, lights)
  if not self.cells or #self.cells ~= #lights then
    self.cells = {}
    for i, light in ipairs(lights) do self.cells[i] = new_cell(light) end
    return
  end
  local flashing, first = 0, frame
  for i, cell in ipairs(self.cells) do
    if change(cell, lights[i]) then keep(cell, frame) end
    local began = first_of(cell)
    if began and frame - began < self.fps then
      flashing, first = flashing + 1, math.min(first, began)
    end
  end
  local share = flashing / #lights
  if share > self.area then add(self.list, first, frame, share) end
end

return flashes
