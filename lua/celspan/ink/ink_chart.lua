--- Lines as a picture, and the areas between them, for all functions of ink that paint.
--
--   lines --rendered--> chart --native.areas--> numbered areas --traced together--> paths
--
-- Areas that touch share their border, because they are traced together.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local charts = {}

local GAP = 8          -- units
local MARGIN = 8       -- pixels around the lines
local LEAST, MOST = 1024, 4096 -- pixels of the longer side
local FEW = 0.01       -- of lines may be thinner than three pixels
local NEAR = 64         -- pixels: so far from a point on a line is a place beside it looked for
local WAYS = { { 0, -1 }, { 0, 1 }, { -1, 0 }, { 1, 0 }, { -0.7, -0.7 }, { 0.7, -0.7 },
               { -0.7, 0.7 }, { 0.7, 0.7 } }
local BLACK = "#000000"

-- ---------------------------------------------------------------- the lines as a picture

local Chart = {}
Chart.__index = Chart

--- A chart of an object at a scale in pixels for each unit; nil and a message.
local function render(object, scale)
  local x, y, w, h = object:bounds()
  local chart = setmetatable({ scale = scale, x = x - MARGIN / scale, y = y - MARGIN / scale,
    width = math.ceil(w * scale) + 2 * MARGIN, height = math.ceil(h * scale) + 2 * MARGIN }, Chart)
  local placed = object:translate(-chart.x, -chart.y):scale(scale)
  local size = { chart.width, chart.height }
  local mask = celspan.matte(celspan.rect { 0, 0, size[1], size[2], texture = BLACK }, placed)
  local image, message = celspan.pixels(celspan.rostrum { antialias = "area",
    celspan.cel { mask } }, { size = size, film = size })
  if not image then return nil, message end
  chart.bytes = image:bytes()
  return chart
end

--- Frees the areas, which are large, but small to Lua's collector.
function Chart:close()
  if self.areas then native.areas_close(self.areas) end
  self.areas, self.gap = nil, nil
end

--- The areas where openings up to a gap, in units, are closed. They live until it is called again.
function Chart:divide(noun, gap)
  if self.gap ~= gap then
    self:close()
    local areas, thin = native.areas(self.bytes, self.width, self.height, gap * self.scale)
    if not areas then native.refuse(noun .. ": " .. thin) end
    self.gap, self.areas, self.thin = gap, areas, thin
  end
  return self.areas
end

function Chart:pixel(at) return (at[1] - self.x) * self.scale, (at[2] - self.y) * self.scale end

function Chart:place(x, y) return x / self.scale + self.x, y / self.scale + self.y end

--- The chart of an object, as fine as its thinnest lines need if no scale is given; nil where there
-- are no lines.
local function chart_of(noun, object, scale, gap)
  local _, _, w, h = object:bounds()
  if not w or math.max(w, h) <= 0 then return nil end
  local side = math.max(w, h)
  local most = (MOST - 2 * MARGIN - 1) / side
  if scale then
    fields.must(scale > 0 and scale <= most, noun .. ": field 'scale'", ("above 0, up to %.6g: "
      .. "the longer side of these lines may have %d pixels"):format(most, MOST), scale)
  end
  local pixels = scale or LEAST / side
  local chart, message
  repeat
    if chart then chart:close() end
    chart, message = render(object, pixels)
    if not chart then native.refuse(noun .. ": " .. message) end
    chart:divide(noun, gap)
    local is_fine = scale or chart.thin <= FEW or pixels == most
    pixels = math.min(2 * pixels, most)
  until is_fine
  return chart
end

-- ---------------------------------------------------------------- a search

--- What one call asks of lines: `noun` for its messages, `gap`, and `chart`, nil where there are no
-- lines.
local Search = {}
Search.__index = Search

local kept = setmetatable({}, { __mode = "k" })

--- A search in lines, whose chart is kept as long as they are.
function charts.search(noun, lines, options)
  local object = fields.is_object(lines) and lines
    or type(lines) == "table" and fields.is_object(lines.object) and lines.object
  fields.expect_kind(object, lines, "%s: lines must be an object, or a drawing with one", noun)
  local scale, gap = options.scale, options.gap or GAP
  local one = kept[object]
  if not one or one.asked ~= scale then
    one = { asked = scale, chart = chart_of(noun, object, scale, gap) }
    kept[object] = one
  end
  if one.chart then one.chart:divide(noun, gap) end
  return setmetatable({ noun = noun, gap = gap, chart = one.chart, object = object }, Search)
end

--- Lets go of the chart, which is large.
function Search:finish()
  if self.chart then self.chart:close() end
  kept[self.object] = nil
end

--- The number of the area at a point; nil and why there is none. gap: another one.
function Search:find(at, gap)
  if not self.chart then return nil, "outside" end
  local x, y = self.chart:pixel(at)
  local number, is_line = native.areas_at(self.chart:divide(self.noun, gap or self.gap), x, y)
  if is_line then return nil, "line" end
  if number == 0 then return nil, "outside" end
  return number
end

-- ---------------------------------------------------------------- where an area runs out

local function tenth(value) return ("%.14g"):format(math.floor(value * 10 + 0.5) / 10) end

local function place_text(at) return ("(%s, %s)"):format(tenth(at[1]), tenth(at[2])) end

--- The first gap, of some that are hardly wider than an opening, that makes `holds()` true.
function Search:wider(width, holds)
  local step = width < 2 and 0.1 or 1
  local least = math.max(math.ceil(width / step - 1e-9) * step, self.gap)
  for _, more in ipairs { 0, step, 2 * step, math.ceil(least / 2) } do
    if least + more > self.gap and holds(least + more) then return least + more end
  end
end

--- The narrowest opening on the way from a point to another one, or out: `at`, `width`, `gap`, in
--- units, and `text`. holds: whether a gap closes it.
function Search:opening(from, to, holds)
  local chart = self.chart
  local x, y = chart:pixel(from)
  local areas = chart:divide(self.noun, self.gap)
  local u, v, width
  if to then
    u, v, width = native.areas_way(areas, x, y, chart:pixel(to))
  else
    u, v, width = native.areas_way(areas, x, y)
  end
  if not u then native.refuse(self.noun .. ": " .. v) end
  local leak = { at = { chart:place(u, v) }, width = width / chart.scale }
  leak.gap = leak.width < math.huge and self:wider(leak.width, holds) or nil
  local remedy = leak.gap and ("gap = %s would close it"):format(tenth(leak.gap))
    or "no gap near that closes it: draw a line there" .. (to and ", or leave one out" or "")
  leak.text = ("through an opening of %s at %s; %s"):format(tenth(leak.width), place_text(leak.at),
    remedy)
  return leak
end

--- Whether lines go around a point as far as its picture shows: not if it is beside all of them.
local function is_within(chart, at)
  local x, y = chart:pixel(at)
  return x > MARGIN and y > MARGIN and x < chart.width - MARGIN and y < chart.height - MARGIN
end

--- The nearest place beside the line on which a point lies, as a text; "" where none is near.
function Search:beside(at)
  local x, y = self.chart:pixel(at)
  local areas = self.chart:divide(self.noun, self.gap)
  for far = 2, NEAR do
    for _, way in ipairs(WAYS) do
      local u, v = self.chart:place(x + far * way[1], y + far * way[2])
      local near = { tonumber(tenth(u)), tonumber(tenth(v)) } -- as it is written
      local number, is_line = native.areas_at(areas, self.chart:pixel(near))
      if number > 0 and not is_line then return ("; %s is beside it"):format(place_text(near)) end
    end
  end
  return ""
end

--- Why there is no area at a point: a table with `message`, and of an opening where it is.
function Search:leak(at, what)
  local place = place_text(at)
  if what == "line" then
    return { message = ("the point %s lies on a line%s"):format(place, self:beside(at)) }
  end
  local leak = self.chart and is_within(self.chart, at)
    and self:opening(at, nil, function(more) return self:find(at, more) end)
  if not leak or leak.width == math.huge then
    return { message = ("the point %s is outside: no lines go around it"):format(place) }
  end
  leak.message, leak.text = ("the area at %s runs out %s"):format(place, leak.text), nil
  return leak
end

--- Raises an error about two points that must not be in one area.
function Search:refuse_both(one, name, other, other_name)
  local x, y = self.chart:pixel(one)
  local u, v = self.chart:pixel(other)
  if x // 1 == u // 1 and y // 1 == v // 1 then
    native.refuse(("%s: %s and %s are at one place: leave one of them out"):format(self.noun, name,
      other_name))
  end
  local leak = self:opening(one, other, function(more)
    local first, second = self:find(one, more), self:find(other, more)
    return first and second and first ~= second
  end)
  native.refuse(("%s: %s and %s are in one area, which runs from one to the other %s"):format(
    self.noun, name, other_name, leak.text))
end

--- The numbers of the areas at points, by their keys; nil for one that has none, which is an error
--- unless `is_left`. keys: their order; name: of a key; may_share: whether two may be in one area.
function Search:seek(points, keys, name, may_share, is_left)
  local numbers, first = {}, {}
  for _, key in ipairs(keys) do
    local number, what = self:find(points[key])
    local before = number and first[number]
    if not number and not is_left then
      native.refuse(("%s: %s: %s"):format(self.noun, name(key),
        self:leak(points[key], what).message))
    elseif before and not may_share(points[before], points[key]) then
      self:refuse_both(points[before], name(before), points[key], name(key))
    elseif number then
      first[number], numbers[key] = before or key, number
    end
  end
  return numbers
end

-- ---------------------------------------------------------------- paths

--- Paths around areas, by their numbers: a list in which none is twice.
function Search:outline(numbers, is_under)
  local chart, codes, seen, data, paths = self.chart, {}, {}, {}, {}
  if #numbers == 0 then return paths end
  local areas = chart:divide(self.noun, self.gap)
  local bytes, colours, x, y, w, h = native.areas_picture(areas, numbers, is_under)
  for _, number in ipairs(numbers) do
    local code = colours[number]
    if not seen[code] then seen[code], codes[#codes + 1] = true, code end
    data[number] = {}
  end
  local art, message = native.trace(celspan.picture { pixels = bytes, size = { w, h } },
    { colours = codes, smooth = 1, speckle = 0 })
  if not art then native.refuse(self.noun .. ": " .. message) end
  for _, shape in ipairs(art.shapes) do
    local number = native.areas_at(areas, shape.x + x, shape.y + y)
    if data[number] then table.insert(data[number], shape.d) end
  end
  for _, number in ipairs(numbers) do
    if #data[number] == 0 then
      native.refuse(self.noun .. ": an area is too narrow to be outlined")
    end
    paths[number] = celspan.path { d = table.concat(data[number], " ") }:translate(x, y)
      :scale(1 / chart.scale):translate(chart.x, chart.y)
  end
  return paths
end

-- ---------------------------------------------------------------- options

--- The checked options of a function. names: what it takes beside those of all.
function charts.check(noun, options, names)
  local known = { gap = "number", scale = "number", under = "boolean", fallback = "any" }
  for name, kind in pairs(names) do known[name] = kind end
  options = fields.check(noun, options, known)
  local gap, fallback = options.gap or GAP, options.fallback
  fields.must(gap >= 0 and gap <= 1e6, noun .. ": field 'gap'", "from 0 to 1000000", gap)
  fields.expect_kind(fallback == nil or fields.is_object(fallback), fallback,
    "%s: field 'fallback' must be an object", noun)
  return options
end

return charts
