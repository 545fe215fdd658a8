-- Random scenes as the text of Lua scripts, so that a failing case can be printed unchanged.
--
--   scenes.script(seed [, options]) -> text of a film script, traits
--
-- traits: width, height (of the film), size (in pixels), is_curved (edges that are flattened),
-- light (the brightest that can leave the frame), has_rows (scan-line primitives: placed upright).
--
-- One file, because every kind of thing contains every other, and all draw from one sequence of
-- random numbers.
local prng = require "tests.support.prng"

-- By its whole path, as scenes are read from several folders.
local FONT = os.getenv "PWD" .. "/scripts/type/block.ttf"

local scenes = {}
local maker = {}
maker.__index = maker

-- ---------------------------------------------------------------- numbers

local function text_of(number)
  local text = ("%.4f"):format(number):gsub("0+$", ""):gsub("%.$", "")
  return text == "-0" and "0" or text
end

--- A number; sometimes one for which edges coincide with pixel centres or pixel borders.
function maker:number(low, high)
  local number = self.random:between(low, high)
  if self.random:once(5) then number = math.floor(number * 2 + 0.5) / 2 end
  return text_of(number)
end

function maker:share()
  local any = self.random:between(0, 1)
  return text_of(self.random:pick { 0, 1, any, any })
end

--- A share; rarely one that makes its object invisible.
function maker:part()
  return self.random:once(20) and "0" or text_of(self.random:between(0.2, 1))
end

--- A point inside the frame, or a little outside.
function maker:point()
  local w, h = self.traits.width, self.traits.height
  return self:number(-0.3 * w, 1.3 * w), self:number(-0.3 * h, 1.3 * h)
end

function maker:point_text() return ("{%s, %s}"):format(self:point()) end

function maker:points(count)
  local points = {}
  for i = 1, count do points[i] = self:point_text() end
  return table.concat(points, ", ")
end

-- ---------------------------------------------------------------- paints and textures

function maker:triple() return self:share() .. ", " .. self:share() .. ", " .. self:share() end

function maker:paint(depth)
  local kind = self.random:whole(1, depth and 6 or 7)
  if kind == 1 then return ("%q"):format(("#%06x"):format(self.random:whole(0, 0xffffff))) end
  if kind == 2 then return ("celspan.rgb(%s)"):format(self:triple()) end
  if kind == 3 then return ("celspan.rgb(%s, %s)"):format(self:triple(), self:share()) end
  if kind == 4 then return ("celspan.gel(%s)"):format(self:triple()) end
  if kind == 5 then
    return ("celspan.paint{ pigment = {%s}, medium = {%s}, beta = %s }")
      :format(self:triple(), self:triple(), self:share())
  end
  if kind == 6 then return ("%q"):format(("#%08x"):format(self.random:whole(0, 0xffffffff))) end
  return ("celspan.mix(%s, %s, %s)"):format(self:paint(true), self:paint(true), self:share())
end

function maker:stops()
  local places, stops = {}, {}
  for i = 1, self.random:whole(1, 4) do
    places[i] = self.random:once(4) and self.random:pick { 0, 0.5, 1 } or self.random:between(0, 1)
  end
  table.sort(places)
  for i, place in ipairs(places) do stops[i] = ("{%s, %s}"):format(text_of(place), self:paint()) end
  return table.concat(stops, ", ")
end

--- The spread and the matrix of a gradient, as text. A repeating gradient has no horizon, and is so
--- large that its number of repetitions is limited.
function maker:extent(repeats)
  local fields = ""
  if repeats then fields = ('spread = "%s", '):format(self.random:pick { "repeat", "reflect" }) end
  if self.random:once(3) then
    local turn, scale = self.random:between(0, 6.28), self.random:between(0.7, 2)
    local c, s = text_of(scale * math.cos(turn)), text_of(scale * math.sin(turn))
    local tilt = not repeats and self.random:once(3) and text_of(self.random:between(-0.01, 0.01))
      or "0"
    fields = fields .. ("matrix = { %s, -(%s), %s, %s, %s, %s, %s, 0, 1 }, ")
      :format(c, s, self:number(-9, 9), s, c,
      self:number(-9, 9), tilt)
  end
  return fields
end

--- Gradients that repeat: from a point, with an extent to the right and down.
function maker:repeating()
  local x, y = self.random:between(0, 40), self.random:between(0, 40)
  local stops, extent = self:stops(), self:extent(true)
  if self.random:once(2) then
    return ("celspan.linear{ from = {%s, %s}, to = {%s, %s}, %s%s }"):format(text_of(x), text_of(y),
      text_of(x + self.random:between(4, 30)), text_of(y + self.random:between(4, 30)), extent,
      stops)
  end
  local radius = self.random:between(5, 30)
  local focus = self.random:once(2) and ("focus = {%s, %s}, ")
    :format(text_of(x + radius / 3), text_of(y - radius / 4)) or ""
  return ("celspan.radial{ centre = {%s, %s}, radius = %s, %s%s%s }")
    :format(text_of(x), text_of(y), text_of(radius),
    focus, extent, stops)
end

--- Noise whose finest octave is larger than pixels, so that the oracle sees the same. It has its
--- own series of random numbers.
function maker:noise()
  local own = self.noises
  local kind = own:pick { "perlin", "value", "fractal", "turbulence", "cells" }
  local fields = ("kind = %q, size = %s, seed = %d, "):format(kind, text_of(own:between(120, 400)),
    own:whole(-99, 99))
  if kind == "fractal" or kind == "turbulence" then
    fields = ("%soctaves = %d, gain = %s, "):format(fields, own:whole(1, 2),
      text_of(own:between(0, 1)))
  end
  if own:once(2) then fields = ("%sat = %s, "):format(fields, text_of(own:between(-3, 3))) end
  if own:once(3) then
    local turn = own:between(0, 6.28)
    local c, s = text_of(math.cos(turn)), text_of(math.sin(turn))
    fields = ("%smatrix = { %s, -(%s), 9, %s, %s, %s, 0, 0, 1 }, "):format(fields, c, s, s, c,
      text_of(own:between(-99, 99)))
  end
  local colours = {}
  for i = 1, own:whole(2, 4) do colours[i] = ("celspan.paint{ pigment = {%s, %s, %s}, "
    .. "medium = {%s, %s, %s}, beta = %s }"):format(text_of(own:between(0, 1)),
    text_of(own:between(0, 1)), text_of(own:between(0, 1)), text_of(own:between(0, 1)),
    text_of(own:between(0, 1)), text_of(own:between(0, 1)), text_of(own:between(0, 1))) end
  return ("celspan.noise{ %scolours = { %s } }"):format(fields, table.concat(colours, ", "))
end

function maker:texture()
  if not self.is_flat and self.has_pictures and self.noises:once(12) then return self:noise() end
  local kind = self.is_flat and 8 or self.random:whole(1, 8)
  if kind == 1 then
    return ("celspan.gradient{ {%s, %s, %s}, {%s, %s, %s}, {%s, %s, %s} }"):format(
      self:number(0, 40), self:number(0, 40), self:paint(), self:number(0, 40), self:number(0, 40),
      self:paint(), self:number(0, 40), self:number(0, 40), self:paint())
  end
  if kind == 2 then
    if self.random:once(3) then return self:repeating() end
    local extent = self:extent(false)
    return ("celspan.linear{ from = %s, to = %s, %s%s }")
      :format(self:point_text(), self:point_text(),
      extent, self:stops())
  end
  if kind == 3 then
    if self.random:once(3) then return self:repeating() end
    if self.changes:once(4) then
      return ("celspan.conic{ centre = %s, angle = %s, %s }"):format(self:point_text(),
        self:number(-400, 400), self:stops())
    end
    local extent, centre, radius = self:extent(false), self:point_text(), self:number(1, 30)
    local focus = self.random:whole(1, 2) == 1 and "focus = " .. self:point_text() .. ", " or ""
    return ("celspan.radial{ centre = %s, radius = %s, %s%s%s }")
      :format(centre, radius, focus, extent, self:stops())
  end
  if kind == 4 and self.has_pictures then return self:picture() end
  return self:paint()
end

local formats = { { "rgba8", 4 }, { "rgb8", 3 }, { "grey8", 1 }, { "rgba16", 8 } }

--- A few pixels in memory, bilinear, in the form that the oracle accepts.
function maker:picture()
  local format, w, h = self.random:pick(formats), self.random:whole(1, 5), self.random:whole(1, 4)
  local bytes = {}
  for i = 1, w * h * format[2] do
    bytes[i] = ("\\x%02x"):format(self.random:pick { 0, 255, self.random:whole(0, 255) })
  end
  local fields = ""
  if self.random:once(4) then fields = fields .. ', as = "gel"' end
  if self.random:once(3) then fields = fields .. ', alpha = "premultiplied"' end
  if self.random:once(3) then fields = fields .. ', colour = "linear"' end
  if self.random:once(2) then
    fields = ('%s, wrap = "%s", box = {%s, %s, %s, %s}'):format(
      fields, self.random:pick { "clear", "clamp", "repeat" }, self:number(0, 20),
      self:number(0, 20), self:number(4, 40), self:number(4, 40))
  end
  return ('celspan.picture{ pixels = "%s", size = {%d, %d}, format = %q, sampling = "bilinear"%s }')
    :format(table.concat(bytes), w, h, format[1], fields)
end

-- ---------------------------------------------------------------- primitives

--- The filling of a primitive: a texture, or a pattern of it. Patterns have their own series of
--- random numbers, so that all other numbers are the same without patterns.
function maker:filling()
  local texture, own = self:texture(), self.fillings
  if not self.has_modes or not own:once(16) or not self.has_patterns then return texture end
  local function number(low, high) return text_of(own:between(low, high)) end
  local art = {}
  for i = 1, own:whole(1, 2) do
    art[i] = ("celspan.rect{ %s, %s, %s, %s, texture = %s }"):format(number(-5, 9), number(-5, 9),
      number(1, 15), number(1, 15), i == 1 and texture or ("%q"):format("#33aa77c0"))
  end
  local turn = own:between(0, 6.28)
  local c, s = text_of(math.cos(turn)), text_of(math.sin(turn))
  return ("celspan.pattern{ art = celspan.union{ %s }, box = {%s, %s, %s, %s}, %s }"):format(
    table.concat(art, ", "), number(-9, 9), number(-9, 9), number(6, 20), number(6, 20),
    own:once(2) and "" or ("matrix = { %s, -(%s), %s, %s, %s, 1, 0, 0, 1 }"):format(c, s,
      number(-9, 9), s, c))
end

function maker:rule() return self.random:once(2) and 'rule = "evenodd", ' or "" end

function maker:rect()
  local radius = ""
  if not self.is_straight and self.random:once(3) then
    radius = (", radius = %s"):format(self:number(0, 9))
    self.traits.is_curved = true
  end
  local x, y = self:point()
  return ("celspan.rect{ %s, %s, %s, %s%s, texture = %s }"):format(
    x, y, self:number(0, 30), self:number(0, 30), radius, self:filling())
end

function maker:triangle()
  return ("celspan.triangle{ %s, texture = %s }"):format(self:points(3), self:filling())
end

function maker:polygon()
  return ("celspan.polygon{ %s, %stexture = %s }"):format(self:points(self.random:whole(3, 9)),
                                                         self:rule(), self:filling())
end

function maker:circle()
  self.traits.is_curved = true
  return ("celspan.circle{ centre = %s, radius = %s, texture = %s }"):format(
    self:point_text(), self:number(0, 20), self:filling())
end

function maker:ellipse()
  self.traits.is_curved = true
  return ("celspan.ellipse{ centre = %s, radii = {%s, %s}, texture = %s }"):format(
    self:point_text(), self:number(0, 25), self:number(0, 25), self:filling())
end

function maker:knots(count)
  local knots, at = {}, 0
  for i = 1, count do
    knots[i] = text_of(at)
    at = at + self.random:pick { 1, 1, 0.25, self.random:between(0.01, 3) }
  end
  return "{" .. table.concat(knots, ", ") .. "}"
end

function maker:nurbs()
  self.traits.is_curved = true
  local degree = self.random:pick { 1, 2, 3, 3, 3, 4, 5 }
  local count = degree + self.random:whole(1, 5)
  local is_weighted, is_clamped = self.random:once(3), self.random:once(3)
  local points, fields = {}, {}
  for i = 1, count do
    local x, y = self:point()
    points[i] = is_weighted and ("{%s, %s, %s}"):format(x, y, text_of(self.random:between(0.05, 8)))
      or ("{%s, %s}"):format(x, y)
  end
  if is_clamped then fields[#fields + 1] = 'closed = "clamped", ' end
  if self.random:once(2) then
    fields[#fields + 1] = ("knots = %s, "):format(
      self:knots(is_clamped and count + degree + 1 or count + 1))
  end
  return ("celspan.nurbs{ points = {%s}, degree = %d, %s%stexture = %s }"):format(
    table.concat(points, ", "), degree, table.concat(fields), self:rule(), self:texture())
end

local segments = {
  L = "xy", H = "x", V = "y", C = "xyxyxy", S = "xyxy", Q = "xyxy", T = "xy", A = "a", Z = "",
}

function maker:segment(letter)
  local is_relative = self.random:once(2)
  local words = { is_relative and letter:lower() or letter }
  local pattern = segments[letter] == "a" and "xy" or segments[letter]
  if letter == "A" then
    words[1] = ("%s%s %s %s %d %d"):format(words[1], self:number(0.5, 20), self:number(0.5, 20),
      self:number(-180, 180), self.random:whole(0, 1), self.random:whole(0, 1))
  end
  for axis in pattern:gmatch "." do
    local side = axis == "x" and self.traits.width or self.traits.height
    words[#words + 1] = is_relative and self:number(-0.5 * side, 0.5 * side)
      or self:number(-0.2 * side, 1.2 * side)
  end
  return table.concat(words, " ")
end

function maker:path()
  local letters = { "L", "H", "V", "C", "S", "Q", "T", "A" }
  if self.is_straight then letters = { "L", "H", "V" } else self.traits.is_curved = true end
  local words = {}
  for _ = 1, self.random:whole(1, 3) do
    words[#words + 1] = ("M%s %s"):format(self:point())
    for _ = 1, self.random:whole(2, 6) do
      words[#words + 1] = self:segment(self.random:pick(letters))
    end
    if self.random:once(2) then words[#words + 1] = "Z" end
  end
  return ("celspan.path{ d = %q, %stexture = %s }"):format(table.concat(words, " "), self:rule(),
                                                          self:texture())
end

--- A line: through points, along path data or around a shape, with all properties that a line may
--- have.
function maker:stroke()
  local fields, kind = {}, self.random:whole(1, 3)
  local function add(format, ...) fields[#fields + 1] = format:format(...) end
  if not self.is_straight then self.traits.is_curved = true end
  if kind == 1 then
    local points = {}
    for i = 1, self.random:whole(1, 6) do
      local x, y = self:point()
      -- Where widths change, straight lines have arcs at their ends.
      points[i] = self.is_straight and ("{%s, %s}"):format(x, y)
        or ("{%s, %s, %s}"):format(x, y, self:number(0, 12))
    end
    add("points = {%s}, width = %s", table.concat(points, ", "), self:number(0, 12))
    if not self.is_straight then add("degree = %d", self.random:whole(1, 4)) end
    if self.random:once(3) then add "closed = true" end
  else
    local letters = self.is_straight and { "L", "H", "V" } or { "L", "H", "C", "S", "Q", "T", "A" }
    local words = { ("M%s %s"):format(self:point()) }
    for _ = 1, self.random:whole(1, 4) do
      words[#words + 1] = self:segment(self.random:pick(letters))
    end
    if self.random:once(3) then words[#words + 1] = "Z" end
    add("d = %q", table.concat(words, " "))
    add("width = %s", self:number(0, kind == 2 and 3 or 16))
  end
  local joins = self.is_straight and { "miter", "bevel" } or { "miter", "round", "bevel" }
  local caps = self.is_straight and { "butt", "square" } or { "butt", "round", "square" }
  add("join = %q, cap = %q", self.random:pick(joins), self.random:pick(caps))
  if self.random:once(3) then
    add("dash = {%s, %s}, dash_offset = %s", self:number(3, 12), self:number(1, 8),
      self:number(-9, 9))
  elseif not self.is_straight and self.random:once(3) then
    add("taper = {%s, %s}, profile = %q", self:number(1, 20), self:number(0, 20),
      self.random:pick { "straight", "round" })
  end
  if self.random:once(4) then
    add("from = %s, to = %s", self:number(0, 0.5), self:number(0.4, 1))
  end
  return ("celspan.stroke{ %s, texture = %s }"):format(table.concat(fields, ", "), self:texture())
end

--- Spans that move with the row: one flat, one of two paints, one of several.
function maker:scanline()
  self.traits.has_rows = true
  local w, h = self.traits.width, self.traits.height
  local a, b = text_of(self.random:between(-0.06, 0.06)), text_of(self.random:between(-0.06, 0.06))
  local x0, x1 = self:number(0, 0.3 * w), self:number(0.35 * w, 0.5 * w)
  local x2, x3 = self:number(0.8 * w, w), self:number(1.2 * w, 1.3 * w)
  local kinds = {
    ("{%s + %s * y, %s + %s * y, %s}"):format(x0, a, x1, a, self:paint()),
    ("{%s + %s * y, %s + %s * y, %s, %s}"):format(x1, a, x2, b, self:paint(), self:paint()),
    ("{%s + %s * y, %s, array = {%s, %s, %s}}"):format(x2, b, x3, self:paint(), self:paint(),
                                                     self:paint()),
  }
  local spans = {}
  for i, span in ipairs(kinds) do
    if i == 1 or self.random:once(2) then spans[#spans + 1] = span end
  end
  return ("celspan.scanline{ bounds = {%s, %s, %d, %d}, spans = function(y) return {%s} end }")
    :format(self:number(-5, 5), self:number(-5, 5), w, h, table.concat(spans, ", "))
end

local letters = { "A", "g", "O", "S", "W", "8", "R", "->", "e\u{301}", "ש", "ל", "三", " " }

--- A few letters of the font that ships, large enough to be visible.
function maker:text()
  self.traits.is_curved = true
  local words = {}
  for i = 1, self.random:whole(1, 4) do words[i] = self.random:pick(letters) end
  local fields = {}
  if self.random:once(3) then fields[#fields + 1] = ", width = " .. self:number(0, 40) end
  if self.random:once(3) then fields[#fields + 1] = ", tracking = " .. self:number(-300, 300) end
  if self.random:once(2) then
    fields[#fields + 1] = (", variations = { wght = %s }"):format(self:number(200, 900))
  end
  return ("celspan.text{ %q, font = %q, size = %s, at = %s, align = %q%s, texture = %s }")
    :format(table.concat(words), FONT, self:number(4, 40), self:point_text(),
      self.random:pick { "left", "centre", "right" }, table.concat(fields), self:texture())
end

--- A primitive; sometimes one that was used before, so that edges coincide.
function maker:primitive()
  if #self.made > 0 and self.random:once(6) then return self.random:pick(self.made) end
  self.made[#self.made + 1] = self:fresh()
  return self.made[#self.made]
end

--- Every other time a circle is taken away from the object, or joined to it by exclusive or.
function maker:cut(object)
  local own = self.cuts
  if not own:once(2) then return object end
  return ("celspan.%s{ %s, celspan.circle{ centre = {%s, %s}, radius = %s } }"):format(
    own:pick { "difference", "xor" }, object, text_of(own:between(0, 40)),
    text_of(own:between(0, 30)), text_of(own:between(3, 20)))
end

--- Path operators on an object. They have their own series of random numbers, as patterns have.
function maker:changed(object)
  local own = self.changes
  local function number(low, high) return text_of(own:between(low, high)) end
  self.traits.is_curved = true
  local calls = {
    function()
      return ("celspan.trim(%s, %s, %s, { offset = %s, together = %s })"):format(object,
        number(0, 1), number(0, 1), number(-1, 1), tostring(own:once(2)))
    end,
    function() return ("celspan.round_corners(%s, %s)"):format(object, number(0, 15)) end,
    function()
      return ("celspan.zigzag(%s, { size = %s, ridges = %d, smooth = %s })"):format(object,
        number(-3, 3), own:whole(0, 4), tostring(own:once(2)))
    end,
    function() return ("celspan.pucker(%s, %s)"):format(object, number(-1, 1)) end,
    function() return ("celspan.twist(%s, %s)"):format(object, number(-200, 200)) end,
    function()
      return ("celspan.repeater(%s, { count = %d, offset = %s, translate = {%s, %s}, rotate = %s, "
        .. "scale = %s, opacity = {%s, 1}, order = %q })"):format(object, own:whole(0, 4),
        number(-1, 1), number(-9, 9), number(-9, 9), number(-40, 40), number(0.7, 1.2),
        number(0, 1), own:pick { "above", "below" })
    end,
    function()
      return ("celspan.offset(%s, %s, { join = %q })"):format(self:cut(object), number(-4, 4),
        own:pick { "round", "miter", "bevel" })
    end,
    function()
      return ("celspan.merge({ %s, celspan.star{ centre = {%s, %s}, points = %d, outer = %s, "
        .. "inner = %s, outer_round = %s } }, { mode = %q, texture = %q })"):format(object,
        number(0, 40), number(0, 30), own:whole(3, 7), number(3, 20), number(1, 9), number(0, 1),
        own:pick { "merge", "add", "subtract", "intersect", "exclude" }, "#20808080")
    end,
  }
  return own:pick(calls)()
end

local operable = { rect = true, triangle = true, circle = true, ellipse = true, polygon = true,
                   nurbs = true, path = true }

function maker:fresh()
  if self.has_text and self.random:once(2) then return self:text() end
  if self.is_upright and self.random:once(3) then return self:scanline() end
  local kinds = { "rect", "triangle", "polygon", "polygon", "path", "stroke" }
  if not self.is_straight then
    kinds = { "rect", "triangle", "circle", "ellipse", "polygon", "nurbs", "nurbs", "path", "path",
              "stroke", "stroke" }
  end
  local kind = self.random:pick(kinds)
  local object = self[kind](self)
  local is_changed = operable[kind] and not self.is_straight and self.has_modes
    and self.changes:once(8)
  return is_changed and self:changed(object) or object
end

-- ---------------------------------------------------------------- transforms and booleans

function maker:quad()
  local w, h = self.traits.width, self.traits.height
  local jitter = 0.35
  local corners = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }
  local from, to = {}, {}
  for i, corner in ipairs(corners) do
    from[i] = ("{%d, %d}"):format(corner[1] * w, corner[2] * h)
    to[i] = ("{%s, %s}"):format(
      self:number((corner[1] - jitter) * w, (corner[1] + jitter) * w),
      self:number((corner[2] - jitter) * h, (corner[2] + jitter) * h))
  end
  return (":quad({%s}, {%s})"):format(table.concat(from, ", "), table.concat(to, ", "))
end

--- A perspective; often its horizon crosses the frame.
function maker:perspective()
  local function small() return ("%.5f"):format(self.random:between(-0.03, 0.03)) end
  return (":transform{ %s, %s, %s, %s, %s, %s, %s, %s, 1 }"):format(
    self:number(0.5, 1.5), self:number(-0.4, 0.4), self:number(-8, 8), self:number(-0.4, 0.4),
    self:number(0.5, 1.5), self:number(-8, 8), small(), small())
end

function maker:transform()
  local kind = self.random:whole(1, 9)
  if kind <= 2 then
    return (":translate(%s, %s)"):format(self:number(-12, 12), self:number(-12, 12))
  end
  if kind == 3 then return (":scale(%s)"):format(self:number(0.3, 1.8)) end
  if kind == 4 then
    return (":scale(%s%s, %s):translate(%s, %s)"):format(
      self.random:pick { "-", "" }, self:number(0.3, 1.5), self:number(0.2, 1.5),
      self:number(0, 20), self:number(0, 10))
  end
  if self.is_upright then return "" end
  if kind == 5 then
    return (":rotate(%s, %s, %s)")
      :format(self:number(-180, 180), self:number(0, 40), self:number(0, 30))
  end
  if kind == 6 then return (":skew(%s, %s)"):format(self:number(-40, 40), self:number(-40, 40)) end
  if kind == 7 then return self:quad() end
  if kind == 8 then return self:perspective() end
  return (":rotate(%d)"):format(self.random:pick { 90, 180, 270, 45 })
end

local modes = { "multiply", "screen", "overlay", "darken", "lighten", "color-dodge", "color-burn",
                "hard-light", "soft-light", "difference", "exclusion", "hue", "saturation", "color",
                "luminosity", "add", "linear-dodge", "soft-light-photoshop", "linear-burn",
                "vivid-light", "linear-light", "pin-light", "subtract", "divide" }

--- A mode; adding may double the light.
function maker:mode()
  local mode = self.modes:pick(modes)
  if mode == "add" then self.brightest = self.brightest * 2 end
  return mode
end

local steps = {
  function(r) return "exposure = " .. text_of(r:between(-1, 1)) end,
  function(r)
    return ("slope = { %s, 1, 0.5 }, offset = { 0, -0.1, 0.2 }, power = { 1, 1, %s }")
      :format(text_of(r:between(0, 2)), text_of(r:between(1, 2)))
  end,
  function(r) return "contrast = " .. text_of(r:between(0.3, 1.5)) end,
  function(r) return "saturation = " .. text_of(r:between(0, 1.5)) end,
  function(r) return "hue = " .. text_of(r:between(-180, 180)) end,
  function(r) return "temperature = " .. text_of(r:between(-1, 1)) end,
  function(r) return "gamma = " .. text_of(r:between(0.6, 1)) end,
  function(r)
    return ("matrix = { { 0, %s, 0, 0 }, { 0.5, 0.5, 0, 0.1 }, { 0, 0, 1, 0 } }")
      :format(text_of(r:between(0, 1)))
  end,
  function(r)
    return ("curve = { {0, 0.1}, {%s, 0.5}, {1, 1} }"):format(text_of(r:between(0.2, 0.8)))
  end,
}

--- One or two steps of a grade, which may make light four times as bright.
function maker:grade()
  local from, to = self.modes:whole(1, #steps), self.modes:whole(1, #steps)
  self.brightest = self.brightest * 4
  local first = steps[from](self.modes)
  return ("grade = { %s }"):format(from == to and first or first .. ", " .. steps[to](self.modes))
end

--- Sometimes adds a space, and a grade, to the fields of a value.
function maker:develop(fields, has_space)
  if not self.has_spaces then return end
  if has_space and self.modes:once(3) then
    fields[#fields + 1] = ("space = %q"):format(self.modes:pick { "linear", "srgb", "srgb" })
  end
  local grade = self.modes:once(6) and self:grade()
  if self.has_grades then fields[#fields + 1] = grade or nil end
end

--- A shape of one opaque colour, which grows and shrinks exactly.
function maker:solid()
  local own = self.keys
  self.traits.is_curved = true
  return ("celspan.circle{ centre = {%s, %s}, radius = %s, texture = \"#fff\" }"):format(
    text_of(own:between(0, 40)), text_of(own:between(0, 30)), text_of(own:between(2, 20)))
end

--- The object, keyed by a colour or by brightness, or under a matte that is grown or choked, or
--- before a circle that dissolves.
function maker:keyed(object)
  local own = self.keys
  local function number(low, high) return text_of(own:between(low, high)) end
  local kind = own:whole(1, 4)
  if kind == 1 then
    return ("celspan.key{ %s, colour = %q, tolerance = %s, softness = %s, spill = %s }"):format(
      object, own:pick { "#0b0", "#24c", "#c08030" }, number(0, 0.4), number(0.1, 0.5),
      number(0, 1))
  end
  if kind == 2 then
    return ("celspan.key{ %s, luma = true, from = %s, to = %s }"):format(object, number(0, 0.3),
      number(0.6, 1))
  end
  if kind == 3 and self.has_pictures and not self.is_flat then
    return ("celspan.union{ celspan.dissolve(%s:fade(%s)), %s }"):format(self:solid(),
      number(0.1, 0.9), object)
  end
  return ("celspan.matte(%s, %s, { grow = %s })"):format(object, self:solid(), number(-6, 6))
end

--- The object in a group, with a mode or with a matte.
function maker:compose(object, depth)
  local fields = { object }
  self:develop(fields, true)
  if #fields > 1 then return ("celspan.group{ %s }"):format(table.concat(fields, ", ")) end
  local kind = self.modes:whole(1, 4)
  if kind == 1 then return ("%s:blend(%q)"):format(object, self:mode()) end
  if kind == 2 then
    return ("celspan.group{ %s, blend = %q, opacity = %s }"):format(object,
      self.modes:once(2) and "normal" or self:mode(), text_of(self.modes:between(0.2, 1)))
  end
  if kind == 3 then return ("celspan.group{ %s, isolate = true }"):format(object) end
  return ("celspan.matte(%s, %s, { from = %q, invert = %s })"):format(object,
    self:object(depth > 0 and depth - 1 or 0), self.modes:pick { "alpha", "luma" },
    self.modes:once(3))
end

function maker:dress(object)
  if self.random:once(2) then object = object .. self:transform() end
  if self.random:once(8) then object = object .. self:transform() end
  if self.random:once(6) then object = ("%s:fade(%s)"):format(object, self:part()) end
  return object
end

--- A composition inside another, in a film of its own size. Its paint may be brighter than white,
-- so any light that falls on it is multiplied by that.
function maker:nested()
  local traits, lights, most = self.traits, self.lights, self.most
  local width, height, brightest = traits.width, traits.height, self.brightest
  traits.width, traits.height = self.random:whole(10, 50), self.random:whole(10, 40)
  self.level, self.brightest, self.most = self.level + 1, 1, self.random:pick { 1, 2 }
  local text = self:rostrum(("size = {%d, %d}"):format(traits.width, traits.height))
  self.level, self.brightest, self.most = self.level - 1, math.max(brightest, self.lights), most
  traits.width, traits.height, self.lights = width, height, lights
  return text
end

--- Objects that cannot be outlined to the bit: those whose alpha is spread, as cs_grow_is_vector
--- decides, which `probe` does not see, and those that may reach the horizon.
local without_outline = { "image", "picture", "matte", "key", "rostrum", "scanline", ":quad",
                          ":transform" }

--- The object, sometimes with an outline if it contains only vector art.
function maker:outlined(object)
  if not self.has_modes or not self.outlines:once(12) then return object end
  for _, word in ipairs(without_outline) do
    if object:find(word, 1, true) then return object end
  end
  local width, join = text_of(self.outlines:between(0, 6)),
    self.outlines:pick { "round", "miter", "bevel" }
  if join == "round" then self.traits.is_curved = true end -- its corners are arcs
  return ("%s:outline{ width = %s, texture = %q, join = %q, opacity = %s }"):format(object, width,
    "#e8c070", join, text_of(self.outlines:between(0.3, 1)))
end

--- The object, displaced, blurred in a direction, or sharpened.
function maker:shifted(object)
  local own = self.shifts
  object = ("celspan.group{ %s }"):format(object)
  local function number(low, high) return text_of(own:between(low, high)) end
  local at = ("{%s, %s}"):format(number(0, 40), number(0, 30))
  local kind = own:whole(1, 6)
  if kind == 1 then return ("%s:blur(%s, { angle = %s })"):format(object, number(0, 9),
    number(-200, 200)) end
  if kind == 2 then return ("%s:blur(%s, { zoom = %s })"):format(object, number(0, 60), at) end
  if kind == 3 then return ("%s:blur(%s, { spin = %s })"):format(object, number(0, 90), at) end
  if kind == 4 then return ("%s:sharpen{ radius = %s, amount = %s }"):format(object,
    number(0, 9), number(0, 1.5)) end
  local by = ("celspan.circle { centre = %s, radius = %s, texture = celspan.linear { "
    .. "from = {0, 0}, to = {40, 30}, { 0, \"#f0%d\" }, { 1, \"#2c8\" } } }"):format(at,
    number(3, 40), own:whole(0, 9))
  return ("%s:displace{ by = %s, scale = %s, x = %q }"):format(object, by, number(-30, 30),
    own:pick { "r", "g", "b", "a" })
end

function maker:object(depth)
  local object = self:outlined(self:plain_object(depth))
  if self.has_shifts and self.shifts:once(8) then object = self:shifted(object) end
  if not self.has_modes or not self.modes:once(4) then return object end
  local composed = self:compose(object, depth)
  local is_keyed = not self.is_plain and self.keys:once(6)
  return self:dress(is_keyed and self:keyed(composed) or composed)
end

function maker:plain_object(depth)
  if self.level < 2 and not self.is_plain and self.random:once(12) then
    return self:dress(self:nested())
  end
  if depth == 0 or self.random:once(3) then return self:dress(self:primitive()) end
  local kind = self.random:pick { "union", "intersection", "difference", "xor", "clip",
                                  "|", "&", "-", "~" }
  if #kind == 1 then
    return self:dress(("(%s %s %s)"):format(self:object(depth - 1), kind, self:object(depth - 1)))
  end
  if kind == "clip" then
    return self:dress(("celspan.clip(%s, %s)")
      :format(self:object(depth - 1), self:object(depth - 1)))
  end
  local operands = {}
  for i = 1, self.random:whole(1, 4) do operands[i] = self:object(depth - 1) end
  return self:dress(("celspan.%s{ %s }"):format(kind, table.concat(operands, ", ")))
end

-- ---------------------------------------------------------------- cels and rostrums

function maker:light(most)
  local light, values = math.max(1, most), {}
  for i = 1, 3 do values[i] = self:number(0, most) end
  self.lights = self.lights + light
  return table.concat(values, ", ")
end

--- A light with a shape, on the frame or on the cel. has_matte: a back light.
function maker:light_shape(places, has_matte)
  local gain = self.random:between(0, 2)
  self.lights = self.lights + math.max(1, gain)
  local matte = has_matte and gain > 1 and ", matte = " .. text_of(gain - 1) or ""
  return ("{ texture = %s, gain = %s, on = %q%s }"):format(self:texture(), text_of(gain),
    self.random:pick(places), matte)
end

local anywhere, on_frame = { "frame", "frame", "cel" }, { "frame" }

function maker:front(most)
  if not self.is_plain and self.random:once(3) then return self:light_shape(anywhere) end
  return ("{%s}"):format(self:light(most))
end

function maker:back(places)
  if not self.is_plain and self.random:once(3) then return self:light_shape(places, true) end
  return ("{%s, %s}"):format(self:light(1), self:share())
end

function maker:cel()
  local fields = {}
  for i = 1, self.random:whole(1, self.most) do
    fields[i] = "\n        " .. self:object(self.random:whole(0, self.depth))
  end
  if self.random:once(3) then fields[#fields + 1] = "front = " .. self:front(1.5) end
  if self.random:once(5) then fields[#fields + 1] = "back = " .. self:back(anywhere) end
  if self.random:once(6) then
    fields[#fields + 1] = ("viewport = {%s, %s, %s, %s}"):format(
      self:number(-10, 10), self:number(-10, 10), self:number(15, 60), self:number(15, 60))
  end
  if self.random:once(5) then fields[#fields + 1] = ("opacity = %s"):format(self:part()) end
  if self.has_modes and self.modes:once(4) then
    fields[#fields + 1] = ("blend = %q"):format(self:mode())
  end
  self:develop(fields, false)
  local transform = self.random:once(5) and self:transform() or ""
  return ("celspan.cel{ %s }%s"):format(table.concat(fields, ", "), transform)
end

function maker:rostrum(size)
  local fields = { size }
  self.lights = 1
  for _ = 1, self.random:whole(1, self.most) do fields[#fields + 1] = "\n      " .. self:cel() end
  if self.random:once(4) then fields[#fields + 1] = "front = " .. self:front(1.2) end
  if self.random:once(3) then fields[#fields + 1] = "back = " .. self:back(on_frame) end
  if self.random:once(5) then
    local brightness = self.random:between(0, 2)
    fields[#fields + 1] = ("brightness = %s"):format(text_of(brightness))
    self.lights = self.lights * math.max(1, brightness)
  end
  if self.random:once(4) then
    local rotate = not self.is_upright and self.random:once(2) and self:number(-180, 180) or "0"
    fields[#fields + 1] = ("camera = { centre = %s, width = %s, rotate = %s }"):format(
      self:point_text(), self:number(15, 70), rotate)
  end
  self:develop(fields, size or self.is_exposed)
  if self.has_spaces and self.has_grades and self.has_pictures and not self.is_flat and
    self.noises:once(6) then
    fields[#fields + 1] = ("grain = { amount = %s, size = %s }"):format(
      text_of(self.noises:between(0, 0.3)), text_of(self.noises:between(1, 12)))
  end
  self.lights = self.lights * self.brightest
  return ("celspan.rostrum{ %s }"):format(table.concat(fields, ", "))
end

function maker:exposures()
  if self.is_single or not self.random:once(6) then
    local rostrum = self:rostrum()
    self.traits.light = self.lights
    return rostrum
  end
  local list = {}
  self.is_exposed = true
  for i = 1, self.random:whole(1, 3) do
    local weight = self.random:between(0, 1.2)
    list[i] = ("{ %s, %s }"):format(self:rostrum(), text_of(weight))
    self.traits.light = self.traits.light + weight * self.lights
  end
  return "{ " .. table.concat(list, ", ") .. " }"
end

local function start(seed, options)
  local random = prng.new(seed)
  local traits = { width = random:whole(20, 56), height = random:whole(16, 40), light = 0,
                   is_curved = false, has_rows = false }
  local scale = random:pick { 1, 1, random:between(0.5, 8) }
  traits.size = { math.ceil(traits.width * scale), math.ceil(traits.height * scale) }
  return setmetatable({
    random = random, traits = traits, made = {},
    is_straight = random:once(2), is_upright = options.has_rows ~= false and random:once(4),
    is_flat = options.is_flat, is_single = options.is_single, is_plain = options.is_plain,
    has_pictures = options.has_pictures ~= false, has_text = options.has_text, level = 0,
    lights = 1, brightest = 1, modes = prng.new(~seed),
    fillings = prng.new(seed ~ 0x7061747465726e), outlines = prng.new(seed ~ 0x6f75746c696e65),
    changes = prng.new(seed ~ 0x6368616e6765), keys = prng.new(seed ~ 0x6b657973),
    noises = prng.new(seed ~ 0x6e6f697365), shifts = prng.new(seed ~ 0x736869667473),
    cuts = prng.new(seed ~ 0x63757473), has_shifts = options.has_shifts,
    has_modes = options.has_modes ~= false and seed % 2 == 0,
    has_spaces = options.has_modes ~= false and seed % 4 == 0,
    has_grades = options.has_grades ~= false, has_patterns = options.has_patterns ~= false,
    most = random:pick { 1, 1, 3 }, depth = random:pick { 0, 1, 2, 4 },
  }, maker)
end

--- Half of all scenes have only straight edges; a quarter are upright, with scan-line primitives.
-- options: is_flat (no gradients or pictures), is_single (one exposure), has_rows = false (no
-- scan-lines), has_pictures = false (no noise, and nothing dissolves), has_text (every second
-- primitive is text), is_plain (no lights with a shape, no compositions inside others),
-- has_modes = false, has_grades = false, has_patterns = false; has_shifts (objects that are
-- displaced, blurred in a direction or sharpened, of which the oracle sees no means over pixels).
-- Half of the scenes have modes, groups, mattes and outlines; half of these have spaces and grades,
-- too. The outermost space is that of light.
function scenes.script(seed, options)
  local self = start(seed, options or {})
  local exposures = self:exposures()
  return ([[
local celspan = require "celspan"
return celspan.film{ size = {%d, %d}, frame = function()
  return %s
end }
]]):format(self.traits.width, self.traits.height, exposures), self.traits
end

--- A random object as text, and the traits of the frame around it.
function scenes.object(seed, options)
  local self = start(seed, options or {})
  return self:object(self.depth), self.traits
end

--- The value of an expression, given as text.
function scenes.value(text)
  return assert(load('local celspan = require "celspan" return ' .. text, "=object"))()
end

--- The film of a script's text.
function scenes.load(text) return assert(load(text, "=scene"))() end

return scenes
