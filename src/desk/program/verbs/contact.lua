--- celspan contact SCRIPT -o SHEET: frames of a film side by side, each with its number below.
--
--   +------+ +------+ +------+       panels of the film's shape, row by row, a number under each
--   |      | |      | |      |
--   +------+ +------+ +------+
--    1        5        9
--
-- Without --every the frames are thinned until they fit on one page; with it there may be several,
-- numbered by #### in SHEET. The last frame is always there.
local program, request = ...
local celspan = require "celspan"
local native = require "celspan.native"
local number_at = program.part "numerals.lua"

local PANEL_MOST, SHEET_MOST, PANEL_LEAST = 480, 3840, 16 -- pixels
-- pixels of all panels of a page, because all are in memory at the same time
local PAGE_MOST = 2 ^ 28
local GAP, LABEL = 12, 24 -- pixels between panels, and below them

-- ---------------------------------------------------------------- a page

--- A frame of the film at the size of a panel, as an image at x, y.
local function panel_of(script, number, size, x, y)
  local pixels = program.check(celspan.pixels(program.still(script, script:at(number)),
    { size = size, workers = math.tointeger(request.workers) }))
  return celspan.image { x = x, y = y, w = size[1], h = size[2], size = size, format = "rgba16",
    pixels = pixels:bytes { depth = 16, colour = "srgb", alpha = "straight" } }
end

--- The page with the frames of these numbers, and its size. path: for the progress.
local function page_of(script, numbers, columns, panel, path)
  local w, h = panel[1], panel[2]
  local across, down = math.min(columns, #numbers), (#numbers - 1) // columns + 1
  local width, height = GAP + across * (w + GAP), GAP + down * (h + LABEL)
  local objects = { celspan.rect { 0, 0, width, height, texture = "#e8e6e1" } }
  for i, number in ipairs(numbers) do
    local x, y = GAP + (i - 1) % columns * (w + GAP), GAP + (i - 1) // columns * (h + LABEL)
    local count = #objects
    objects[count + 1] = celspan.rect { x - 1, y - 1, w + 2, h + 2, texture = "#8a8780" }
    objects[count + 2] = celspan.rect { x, y, w, h, texture = "#fff" }
    objects[count + 3] = panel_of(script, number, panel, x, y)
    program.made_frame(number, path)
    objects[count + 4] = number_at(tostring(number), x + 1, y + h + 6)
  end
  return celspan.rostrum { celspan.cel(objects) }, width, height
end

-- ---------------------------------------------------------------- the sheet

--- A panel has the requested size, or else the proportions of the film; in this case it is not
--- larger than the film, and fits on the page.
local function panel_size(script, columns)
  if request.size or request.scale then return { script:view_size() } end
  local w, h = table.unpack(script.size)
  local scale = math.min(1, math.min(SHEET_MOST / columns, PANEL_MOST) / math.max(w, h))
  local function side(length) return math.max(PANEL_LEAST, math.floor(length * scale + 0.5)) end
  return { side(w), side(h) }
end

--- Every n-th number, and the last one. most: the limit for their count; if necessary, the last
--- number replaces the one before it.
local function thinned(numbers, every, most)
  local list = {}
  for i = 1, #numbers, every do list[#list + 1] = numbers[i] end
  if list[#list] ~= numbers[#numbers] then
    list[#list < (most or math.huge) and #list + 1 or #list] = numbers[#numbers]
  end
  return list
end

local function make_sheet(script, output)
  local grid = program.numbers(request.grid or "6x4")
  local columns, panels, numbers = grid[1], grid[1] * grid[2], script:numbers()
  local every = math.tointeger(request.every) or (#numbers + panels - 1) // panels
  numbers = thinned(numbers, every, not (request.every and program.has_number(output)) and panels)
  local shown = #numbers
  if shown > panels and not program.has_number(output) then
    program.usage("%s: %d frames do not fit into a grid of %d x %d: give a larger --grid or "
      .. "--every, or a name with a number, such as sheet.####.png", output, shown, columns,
      grid[2])
  end
  local size = panel_size(script, columns)
  if size[1] * size[2] * math.min(panels, shown) > PAGE_MOST then
    program.fail("limit", "%d pictures of %d x %d pixels do not fit into memory: give a smaller "
      .. "--scale, --size or --grid", math.min(panels, shown), size[1], size[2])
  end
  script:lay_onion(size[1], size[2])
  program.count_frames(shown)
  for page = 1, (shown + panels - 1) // panels do
    local on_page = table.move(numbers, (page - 1) * panels + 1, math.min(page * panels, shown), 1,
      {})
    local path = program.check(native.frame_name(output, page))
    local rostrum, width, height = page_of(script, on_page, columns, size, path)
    program.check(celspan.render(rostrum, path, { size = { width, height },
      workers = math.tointeger(request.workers) }))
  end
end

--- Makes the picture of --camera or --palette, a single one.
local function make_picture(kind, output)
  for _, name in ipairs { "camera", "palette", "grid", "every", "size", "scale", "onion" } do
    if request[name] and name ~= kind then
      program.usage("--%s does not go with --%s", name, kind)
    end
  end
  if program.has_number(output) then
    program.usage("%s: one picture is made, so its name has no place for a number", output)
  end
  local part = kind == "camera" and "way.lua" or "colours.lua"
  program.part(part, program, request, program.script(), number_at, output)
end

if not request.output then program.usage "-o is missing: give -o sheet.png" end
program.refuse_target(request.output)
local kind = request.camera and "camera" or request.palette and "palette"
if kind then return make_picture(kind, request.output) end
make_sheet(program.script(), request.output)
