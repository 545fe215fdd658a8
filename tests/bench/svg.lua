--- The filled shapes of an SVG drawing, as the benchmark's path lines: enough to draw real artwork
--- with every renderer alike. Strokes, text, clips and masks are left out; a gradient is replaced
--- by the mean of its stops.
local walk = require "tests.bench.walk"

local svg = {}

local hidden = { defs = true, clipPath = true, mask = true, symbol = true, marker = true,
                 pattern = true, metadata = true }
local named = { black = "#000000", white = "#ffffff", red = "#ff0000", green = "#008000",
                blue = "#0000ff", yellow = "#ffff00", gray = "#808080", grey = "#808080",
                orange = "#ffa500", brown = "#a52a2a", purple = "#800080", pink = "#ffc0cb" }

-- ---------------------------------------------------------------- elements

--- { { name, attributes, depth }, ... } of all elements in order; declarations of `style` are
--- attributes.
local function elements(text)
  local list, depth = {}, 0
  text = text:gsub("<!%-%-.-%-%->", ""):gsub("<[?!].->", "")
  for slash, name, rest in text:gmatch "<(/?)([%w:_]+)(.-)>" do
    if slash == "/" then
      depth = depth - 1
    else
      local attributes = {}
      for key, _, value in rest:gmatch "([%w:_-]+)%s*=%s*([\"'])(.-)%2" do
        attributes[key] = value
      end
      for key, value in (attributes.style or ""):gmatch "([%w-]+)%s*:%s*([^;]+)" do
        attributes[key] = value
      end
      list[#list + 1] = { name = name, attributes = attributes, depth = depth }
      if rest:sub(-1) ~= "/" then depth = depth + 1 end
    end
  end
  return list
end

-- ---------------------------------------------------------------- colours

local function hex_colour(text)
  text = named[text] or text
  local short = text:match "^#(%x%x%x)$"
  if short then text = "#" .. short:gsub("%x", "%0%0") end
  local r, g, b = text:match "^#(%x%x)(%x%x)(%x%x)"
  if r then return { tonumber(r, 16), tonumber(g, 16), tonumber(b, 16), 1 } end
  r, g, b = text:match "^rgb%(%s*(%d+)[%s,]+(%d+)[%s,]+(%d+)"
  if r then return { tonumber(r), tonumber(g), tonumber(b), 1 } end
end

local function share(text) return tonumber(text and text:match "^[%d.eE-]+") or 1 end

--- The mean colour of each gradient by its name.
local function gradients(list)
  local means, links, open = {}, {}, nil
  for _, element in ipairs(list) do
    local a = element.attributes
    if element.name:find "Gradient$" and a.id then
      open = a.id
      links[open] = (a["xlink:href"] or ""):match "#(.+)"
    elseif element.name == "stop" and open then
      local colour = hex_colour(a["stop-color"] or "#000000") or { 0, 0, 0, 1 }
      local mean = means[open] or { 0, 0, 0, 0, count = 0 }
      for c = 1, 3 do mean[c] = mean[c] + colour[c] end
      mean[4], mean.count = mean[4] + share(a["stop-opacity"]), mean.count + 1
      means[open] = mean
    end
  end
  return function(id)
    while id and not means[id] do id = links[id] end
    local mean = means[id]
    if not mean then return nil end
    local out = {}
    for c = 1, 4 do out[c] = mean[c] / mean.count end
    return out
  end
end

-- ---------------------------------------------------------------- transforms: { a, b, c, d, e, f }

local function compose(m, n)
  return { m[1] * n[1] + m[3] * n[2], m[2] * n[1] + m[4] * n[2],
           m[1] * n[3] + m[3] * n[4], m[2] * n[3] + m[4] * n[4],
           m[1] * n[5] + m[3] * n[6] + m[5], m[2] * n[5] + m[4] * n[6] + m[6] }
end

local transforms = {}

function transforms.matrix(...) return { ... } end
function transforms.translate(x, y) return { 1, 0, 0, 1, x, y or 0 } end
function transforms.scale(x, y) return { x, 0, 0, y or x, 0, 0 } end
function transforms.skewX(degrees) return { 1, 0, math.tan(math.rad(degrees)), 1, 0, 0 } end
function transforms.skewY(degrees) return { 1, math.tan(math.rad(degrees)), 0, 1, 0, 0 } end

function transforms.rotate(degrees, x, y)
  local c, s = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  x, y = x or 0, y or 0
  return { c, s, -s, c, x - c * x + s * y, y - s * x - c * y }
end

local function numbers(text)
  local list = {}
  for number in (text or ""):gmatch "[+-]?%d*%.?%d+[eE]?[+-]?%d*" do
    list[#list + 1] = tonumber(number)
  end
  return list
end

local function transform(text)
  local m = { 1, 0, 0, 1, 0, 0 }
  for name, given in (text or ""):gmatch "(%a+)%s*%((.-)%)" do
    m = compose(m, transforms[name](table.unpack(numbers(given))))
  end
  return m
end

-- ---------------------------------------------------------------- outlines

--- A pen of walk that writes absolute M, L, C and Z under a transform.
local Pen = {}
Pen.__index = Pen

function Pen:put(letter, ...)
  local m, given = self.matrix, { ... }
  local words = { letter }
  for i = 1, #given, 2 do
    local x, y = given[i], given[i + 1]
    words[#words + 1] = ("%.9g %.9g"):format(m[1] * x + m[3] * y + m[5], m[2] * x + m[4] * y + m[6])
  end
  self.out[#self.out + 1] = table.concat(words, " ")
end

function Pen:move(x, y) self:put("M", x, y) end
function Pen:line(x, y) self:put("L", x, y) end
function Pen:curve(...) self:put("C", ...) end

--- At most a quarter of the ellipse per cubic.
function Pen:arc(point, from, to, x, y)
  local count = math.ceil(math.abs(to - from) / (math.pi / 2) - 1e-9)
  local step = (to - from) / count
  local reach = 4 / 3 * math.tan(step / 4)
  for i = 1, count do
    local ax, ay, au, av = point(from + (i - 1) * step)
    local bx, by, bu, bv = point(from + i * step)
    if i == count then bx, by = x, y end
    self:put("C", ax + reach * au, ay + reach * av, bx - reach * bu, by - reach * bv, bx, by)
  end
end

local outline = {}

function outline.path(a) return a.d end

function outline.rect(a)
  local x, y = tonumber(a.x) or 0, tonumber(a.y) or 0
  return ("M%g %gh%gv%gh%gZ"):format(x, y, share(a.width), share(a.height), -share(a.width))
end

function outline.ellipse(a)
  local rx, ry = tonumber(a.rx or a.r), tonumber(a.ry or a.r)
  return ("M%g %ga%g %g 0 0 1 %g 0a%g %g 0 0 1 %g 0Z"):format((tonumber(a.cx) or 0) - rx,
    tonumber(a.cy) or 0, rx, ry, 2 * rx, rx, ry, -2 * rx)
end

outline.circle = outline.ellipse

function outline.polygon(a)
  local points = table.concat(numbers(a.points), " ")
  return points ~= "" and "M" .. points .. "Z" or nil
end

outline.polyline = outline.polygon

-- ---------------------------------------------------------------- the drawing

--- The properties that the children of an element inherit.
local function inherit(above, a)
  return {
    fill = a.fill or above.fill, rule = a["fill-rule"] or above.rule,
    fill_opacity = a["fill-opacity"] or above.fill_opacity,
    opacity = above.opacity * share(a.opacity),
    matrix = compose(above.matrix, transform(a.transform)),
    is_hidden = above.is_hidden or a.display == "none",
  }
end

--- The size of the drawing as x, y, width, height of its own units.
local function view(a)
  local box = numbers(a.viewBox)
  if #box == 4 then return box end
  return { 0, 0, share(a.width), share(a.height) }
end

local function path_line(state, colour, data)
  local alpha = math.floor(255 * colour[4] * state.opacity * share(state.fill_opacity) + 0.5)
  local pen = setmetatable({ matrix = state.matrix, out = {} }, Pen)
  if alpha == 0 or not walk(data, pen) or #pen.out < 2 then return nil end
  return ("path %s %d %d %d %d %s"):format(state.rule == "evenodd" and "evenodd" or "nonzero",
    colour[1] // 1, colour[2] // 1, colour[3] // 1, alpha, table.concat(pen.out))
end

--- The path lines of a drawing that is fitted into the square at x, y of this side.
function svg.lines(path, x, y, side)
  local file = assert(io.open(path, "rb"))
  local list = elements(file:read "a")
  file:close()
  local mean, lines, states = gradients(list), {}, {}
  local box = view(list[1].attributes)
  local scale = side / math.max(box[3], box[4])
  local left = x + (side - scale * box[3]) / 2 - scale * box[1]
  local top = y + (side - scale * box[4]) / 2 - scale * box[2]
  states[-1] = { fill = "#000000", opacity = 1, matrix = { scale, 0, 0, scale, left, top } }
  for _, element in ipairs(list) do
    local a = element.attributes
    local state = inherit(states[element.depth - 1], a)
    state.is_hidden = state.is_hidden or hidden[element.name]
    states[element.depth] = state
    local draw = outline[element.name]
    local data = draw and not state.is_hidden and draw(a)
    local colour = data and (hex_colour(state.fill) or mean(state.fill:match "url%(#(.-)%)"))
    lines[#lines + 1] = colour and path_line(state, colour, data) or nil
  end
  return lines
end

--- Several drawings on one sheet, in rows of `across`.
function svg.sheet(paths, across)
  local lines = {}
  for i, path in ipairs(paths) do
    local column, row = (i - 1) % across, (i - 1) // across
    local part = svg.lines(path, column / across, row / across, 1 / across)
    table.move(part, 1, #part, #lines + 1, lines)
  end
  return lines
end

function svg.write(lines, path)
  local file = assert(io.open(path, "w"))
  file:write("drawing ", #lines, "\n")
  for _, line in ipairs(lines) do file:write(line, "\n") end
  assert(file:close())
end

return svg
