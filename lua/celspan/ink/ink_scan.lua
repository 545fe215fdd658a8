--- ink.scan: scans become drawings that lie alike.
--
--   file --> page --> where its holes, its corners or its lines are --> turned and moved onto the
--     place that all share --> lines on a clear ground, a layer for each ink
--
-- With holes that place depends on the size of the scan alone, so that several levels of a shot,
-- which are scanned one by one, lie alike, too.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local ink = {}

---@class celspan.ink.drawing
---@field lines celspan.texture In the darkest of the inks; the darker, the less clear
---@field colours table<string, celspan.texture> One for each named ink
---@field object celspan.object All inks, one unit a pixel
---@field turned number Degrees clockwise, about the scan's middle
---@field offset number[] {x, y}: the pixels by which it was then moved
---@field width integer Pixels
---@field height integer
---@field levels number[] The brightness of black and of white that was used
local Drawing = fields.class("celspan.ink.drawing", "a drawing")

-- ACME: the middles of the slots lie 101.6 mm from that of the round hole. EDGE: millimetres from
-- the nearer edge of the page at which the holes of all scans are laid.
local ACME = { { 0, 0, 6.35, 6.35 }, { -101.6, 0, 12.7, 3.2 }, { 101.6, 0, 12.7, 3.2 } }
local EDGE = 12
local MOST_HOLES, MOST_INKS, MOST_DUST = 16, 8, 1000000
local MOST_ERROR, MOST_SCALE = 0.1, 0.02 -- millimetres; how far from 1
local MOST_SKEW = math.rad(0.5)          -- of a side of the paper
local LEAST_LIKENESS = 0.15              -- of lines that are laid onto others
local LEAST_INK = 16                     -- pixels
local MILLIMETRES = 25.4

-- ---------------------------------------------------------------- options

---@class celspan.ink.scan.options
---@field pegs? "acme"|number[][]|false The holes: x, y of the middle, w, h in millimetres from the paper's middle; false: by the corners of the paper; default "acme"
---@field match? boolean Without holes: by the best shift of the lines onto those of the first drawing
---@field dpi? number Default: what the file says
---@field levels? number[]|"auto" The brightness of black and of white, 0 to 1; default "auto"
---@field ink? table<string, string> Colours of pencils by name, at most 8: each becomes a layer
---@field dust? integer Blots of at most that many pixels are left out, 0 to 1000000; default 8
---@field frames? string Such as "1-100"; default: all files of the pattern
local known = { pegs = "any", match = "boolean", dpi = "number", levels = "any", ink = "table",
  dust = "number", frames = "string" }

local function must(holds, name, rule, value)
  fields.must(holds, "ink: scan: " .. name, rule, value)
end

local function check_holes(pegs)
  fields.expect_kind(type(pegs) == "table", pegs,
    'ink: scan: pegs must be "acme", a list of holes or false')
  must(#pegs >= 2 and #pegs <= MOST_HOLES, "the number of pegs", "2 to " .. MOST_HOLES, #pegs)
  local seen = {}
  for i, hole in ipairs(pegs) do
    local name = ("pegs[%d]"):format(i)
    fields.numbers("ink: scan", name .. "[%d]", hole, 4, "{x, y, w, h} in millimetres")
    for j = 1, 4 do
      must(math.abs(hole[j]) <= 1000 and (j < 3 or hole[j] >= 1), ("%s[%d]"):format(name, j),
        ("from %d to 1000"):format(j < 3 and -1000 or 1), hole[j])
    end
    local place = ("%a %a"):format(hole[1] + 0.0, hole[2] + 0.0)
    must(not seen[place], name, "elsewhere than the holes before it", hole[1])
    seen[place] = true
  end
  return pegs
end

--- The names of the inks, the darkest first, and their colours.
local function inks_of(given)
  local names, light = {}, {}
  for name, colour in pairs(given) do
    fields.expect_kind(type(name) == "string", name, "ink: scan: ink must have names")
    local good, paint = pcall(celspan.rgb, colour)
    if type(colour) ~= "string" or not good or paint.beta ~= 1 then
      native.refuse(("ink: scan: ink.%s must be an opaque colour, got %s"):format(name,
        type(colour) == "string" and ("%q"):format(colour) or fields.kind(colour)))
    end
    local p = paint.pigment
    light[name], names[#names + 1] = 0.2126 * p[1] + 0.7152 * p[2] + 0.0722 * p[3], name
  end
  must(#names >= 1 and #names <= MOST_INKS, "ink", ("1 to %d colours by name"):format(MOST_INKS),
    #names)
  table.sort(names, function(a, b)
    return light[a] < light[b] or light[a] == light[b] and a < b
  end)
  return names
end

local function levels_of(levels)
  if levels == nil or levels == "auto" then return {} end
  fields.numbers("ink: scan", "levels[%d]", levels, 2, '{black, white} or "auto"')
  local black, white = levels[1], levels[2]
  if #levels ~= 2 or black < 0 or white > 1 or black >= white then
    native.refuse("ink: scan: levels must be black and white, 0 <= black < white <= 1, got "
      .. (#levels == 2 and fields.shown(black) .. " and " .. fields.shown(white)
        or #levels .. " values"))
  end
  return levels
end

--- The options in the form in which `drawing` needs them.
local function settings_of(given)
  given = fields.check("ink: scan", given or {}, known)
  if given.match and given.pegs then
    native.refuse "ink: scan: match goes without pegs: leave one of them out"
  end
  local acme = given.pegs == "acme" or given.pegs == nil
  local holes = acme and ACME or given.pegs and check_holes(given.pegs)
  must(given.dpi == nil or given.dpi >= 30 and given.dpi <= 4800, "dpi", "from 30 to 4800",
    given.dpi)
  local names, colours = given.ink and inks_of(given.ink) or {}, {}
  for i, name in ipairs(names) do colours[i] = given.ink[name] end
  return { holes = not given.match and holes, acme = acme, match = given.match, dpi = given.dpi,
    names = names, colours = given.ink and colours or { "#000" }, levels = levels_of(given.levels),
    dust = fields.whole("ink: scan: dust", given.dust or 8, 0, MOST_DUST) }
end

-- ---------------------------------------------------------------- where a page lies

local function dpi_of(job, page)
  local dpi = job.dpi or page.dpi
  if dpi == 0 then return nil, "it does not say its dpi: give dpi, such as 300" end
  if dpi >= 30 and dpi <= 4800 then return dpi end
  return nil, ("it says %g dpi, which no scan has: give the right dpi"):format(dpi)
end

--- What is wrong with holes that were found; nil: nothing.
local function fault_of(job, dpi, found, scale, error_of)
  local wanted = #job.holes
  if found == 0 then
    return ("none of the %d peg holes was found, at %g dpi: scan the whole sheet on black, with "
      .. "the holes above or below, or give pegs = false"):format(wanted, dpi)
  elseif found < wanted then
    return ("only %d of the %d peg holes were found: free the others of tape, ink and shadows, and "
      .. "scan the whole sheet on black"):format(found, wanted)
  elseif math.abs(scale - 1) > MOST_SCALE then
    return ("the peg holes lie as in a scan of %.0f dpi, not %g: give the right dpi"):format(
      scale * dpi, dpi)
  elseif error_of > MOST_ERROR then
    return ("the peg holes do not lie as they must, one is %.2f mm off: is one torn, or are the "
      .. "pegs others?"):format(error_of)
  end
end

--- Whether the holes are nearer to where those of a page upside down are.
local function is_upside_down(job, page, x, y, unit)
  local w, h = page.width, page.height
  if job.acme then
    local side = y < h / 2 and "top" or "bottom"
    job.side, job.sided = job.side or side, job.sided or page.file
    return side ~= job.side
  end
  local middle_x, middle_y = 0, 0
  for _, hole in ipairs(job.holes) do
    middle_x, middle_y = middle_x + hole[1] / #job.holes, middle_y + hole[2] / #job.holes
  end
  -- (x, y) is the paper's middle if the page is upright: else it lies off by twice theirs
  local near, far = math.abs(x - w / 2) + math.abs(y - h / 2),
    math.abs(x + 2 * middle_x * unit - w / 2) + math.abs(y + 2 * middle_y * unit - h / 2)
  return far < near
end

local function by_holes(job, page)
  local dpi, message = dpi_of(job, page)
  if not dpi then return nil, message end
  local found, scale, turn, x, y, error_of = native.scan_pegs(page.page, dpi, job.holes)
  if not found then return nil, scale end
  local fault = fault_of(job, dpi, found, scale, error_of)
  if fault then return nil, fault end
  local unit = dpi / MILLIMETRES
  if is_upside_down(job, page, x, y, unit) then
    return nil, "the scan is upside down: turn it by 180 degrees, so that its peg holes lie as "
      .. (job.acme and "those of " .. job.sided or "pegs says")
  end
  local to_y = job.height / 2
  if job.acme then to_y = job.side == "top" and EDGE * unit or job.height - EDGE * unit end
  return { turn, x, y, job.width / 2, to_y }
end

local function by_corners(job, page)
  local turn, x, y, error_of = native.scan_corners(page.page)
  if not turn then
    return nil, "the paper does not end inside of the scan on all four sides: scan it on black, "
      .. "with some of the black around it, or give match = true"
  elseif error_of > MOST_SKEW then
    return nil, ("a side of the paper is off by %.1f degrees: it is torn or bent; give match = "
      .. "true"):format(math.deg(error_of))
  end
  return { turn, x, y, job.width / 2, job.height / 2 }
end

local function by_lines(job, page)
  if page.width ~= job.width or page.height ~= job.height then
    return nil, ("it has %d x %d pixels, and the first drawing %d x %d: match needs scans of one "
      .. "size"):format(page.width, page.height, job.width, job.height)
  end
  job.onto = job.onto or page
  local x, y, likeness = native.scan_shift(page.page, job.onto.page)
  if not x then return nil, y end
  if page ~= job.onto and likeness < LEAST_LIKENESS then
    return nil, ("its lines are too unlike those of %s to be laid onto them"):format(job.onto.file)
  end
  return { 0, 0, 0, page ~= job.onto and x or 0, page ~= job.onto and y or 0 }
end

-- ---------------------------------------------------------------- a drawing

--- By how much a scan was moved after it was turned about its middle.
local function offset_of(page, place)
  local turn, x, y = -place[1], page.width / 2 - place[2], page.height / 2 - place[3]
  local cosine, sine = math.cos(turn), math.sin(turn)
  return { place[4] + cosine * x - sine * y - page.width / 2,
           place[5] + sine * x + cosine * y - page.height / 2 }
end

local function drawing_of(job, page, place)
  place[6], place[7] = job.width, job.height
  local offset = offset_of(page, place)
  local turned = -math.deg(place[1])
  place[1] = -place[1]
  local pixels, black, white, covered = native.scan_lines(page.page, place, job.colours, job.dust,
    job.levels[1], job.levels[2])
  if not pixels then return nil, black end
  if covered < LEAST_INK then
    return nil, "the drawing is empty: take it out, or give levels if its lines are very pale"
  end
  local textures, colours, objects = {}, {}, {}
  for i, layer in ipairs(pixels) do
    textures[i] = celspan.picture { pixels = layer, size = { job.width, job.height } }
    if job.names[i] then colours[job.names[i]] = textures[i] end
    table.insert(objects, 1, celspan.rect { 0, 0, job.width, job.height, texture = textures[i] })
  end
  return setmetatable({ lines = textures[1], colours = colours, object = celspan.union(objects),
    turned = turned + 0.0, offset = offset, width = job.width, height = job.height,
    levels = { black, white } }, Drawing)
end

-- ---------------------------------------------------------------- a level

--- The drawings of a level, one by one: .numbers, and next(number) -> drawing | nil, message.
---@return table? job
---@return string? message
function ink.open(pattern, options)
  fields.takes("ink: scan", "string", "the pattern of files", pattern)
  local job = settings_of(options)
  local name, message = native.frame_name(pattern, 0)
  if not name then return nil, message end
  local where = select(2, pcall(native.find, name))
  job.pattern = where:sub(1, #where - #name) .. pattern
  job.numbers, message = native.frames(job.pattern, options and options.frames)
  if not job.numbers then return nil, message end
  if #job.numbers == 0 then return nil, pattern .. ": there are no such files" end
  table.sort(job.numbers)
  return job
end

--- Drawing `number` of a job; the first one gives the size of all.
function ink.drawing(job, number)
  local page = { file = native.frame_name(job.pattern, number) }
  page.page, page.width, page.height, page.dpi = native.scan_open(page.file)
  if not page.page then return nil, page.width end
  job.width, job.height = job.width or page.width, job.height or page.height
  local lay = job.match and by_lines or job.holes and by_holes or by_corners
  local place, message = lay(job, page)
  local drawing
  if place then drawing, message = drawing_of(job, page, place) end
  if page ~= job.onto then native.scan_close(page.page) end
  if drawing then return drawing end
  return nil, page.file .. ": " .. message
end

--- The scanned drawings of a level, registered by the holes of the peg bar, and cleaned: lines on a
--- clear ground.
---@param pattern string Files with a number: "rough.####.png"; beside the caller's file or the script
---@param options? celspan.ink.scan.options
---@return table<integer, celspan.ink.drawing>? drawings
---@return string? message
function ink.scan(pattern, options)
  local job, message = ink.open(pattern, options)
  if not job then return nil, message end
  local drawings = {}
  for _, number in ipairs(job.numbers) do
    drawings[number], message = ink.drawing(job, number)
    if not drawings[number] then break end
  end
  if job.onto then native.scan_close(job.onto.page) end
  if message then return nil, message end
  return drawings
end

return fields.seal("ink_scan", ink)
