--- Random scenes of translucent shapes and groups, drawn three times: as objects of celspan, as an
--- element of SVG for a browser, and as lines along all edges.
---
---   drawn.scene(seed) -> { object =, svg =, edges =, is_blurred = }
---
--- Shapes are rectangles, ellipses and polygons of a colour or a gradient; in one of four scenes,
--- some are blurred. Groups may be faded, isolated or masked; both may have a mode. A scene covers
--- drawn.w by drawn.h pixels, and its rearmost shape all of it, opaquely.
---
--- edges: lines 1 pixel wide along the edges of all shapes, those of masks too. In a pixel without
--- such a line, no edge is nearer than half a pixel.
local celspan = require "celspan"
local prng = require "tests.support.prng"

local drawn = { w = 640, h = 360 }

-- "add" is not among them: CSS's mode for it, "plus-lighter", is limited to 1 in every group.
local MODES = { "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
                "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue",
                "saturation", "color", "luminosity" }
-- Modes that do not enlarge differences much, for scenes with blurs: Chromium rounds blurred pixels
-- to 8 bits on every canvas.
local GENTLE = { "normal", "multiply", "screen", "overlay", "darken", "lighten", "hard-light",
                 "difference", "exclusion" }

-- A region of masks and filters that cuts nothing.
local EVERYWHERE = 'x="-2000" y="-2000" width="5000" height="5000"'

local maker = {}
maker.__index = maker

-- ---------------------------------------------------------------- numbers

--- A number of at most three decimals, which both renderers read alike.
function maker:number(low, high)
  return math.floor(self.random:between(low, high) * 1000 + 0.5) / 1000
end

function maker:place() return self:number(0, drawn.w), self:number(0, drawn.h) end

function maker:colour() return ("#%06x"):format(self.random:whole(0, 0xffffff)) end

--- A name for an element of SVG.
function maker:name()
  self.names = self.names + 1
  return ("s%d-%d"):format(self.seed, self.names)
end

--- An element of SVG to which others refer.
function maker:define(format, ...) self.defs[#self.defs + 1] = format:format(...) end

-- ---------------------------------------------------------------- textures

--- The stops of a gradient: colours with the same alpha, or the same colour with several alphas,
--- since SVG mixes colours before they are multiplied by alpha, and celspan afterwards.
function maker:stops()
  local list, svg = {}, {}
  local one_colour = self.random:once(3) and self:colour()
  local alpha, count = self:number(0.3, 1), self.random:whole(2, 4)
  for i = 1, count do
    local at = math.floor((i - 1) / (count - 1) * 100 + 0.5) / 100
    local colour = one_colour or self:colour()
    alpha = one_colour and self:number(0.3, 1) or alpha
    list[i] = { at, celspan.rgb(colour, alpha) }
    svg[i] = ('<stop offset="%g" stop-color="%s" stop-opacity="%g"/>'):format(at, colour, alpha)
  end
  return list, table.concat(svg)
end

function maker:linear(svg)
  local x0, y0 = self:place()
  local x1, y1 = self:place()
  svg.kind = "linearGradient"
  svg.where = ('x1="%g" y1="%g" x2="%g" y2="%g"'):format(x0, y0, x1, y1)
  return celspan.linear, { from = { x0, y0 }, to = { x1, y1 } }
end

function maker:radial(svg)
  local x, y = self:place()
  local radius = self:number(60, 300)
  local fx, fy = x + self:number(-0.6, 0.6) * radius, y + self:number(-0.6, 0.6) * radius
  svg.kind = "radialGradient"
  svg.where = ('cx="%g" cy="%g" r="%g" fx="%.9g" fy="%.9g"'):format(x, y, radius, fx, fy)
  return celspan.radial, { centre = { x, y }, radius = radius, focus = { fx, fy } }
end

--- A gradient of celspan's, and the name of the same gradient in SVG.
function maker:gradient()
  local svg, name = {}, self:name()
  local make, fields = maker[self.random:pick { "linear", "radial" }](self, svg)
  local stops, elements = self:stops()
  table.move(stops, 1, #stops, 1, fields)
  local is_reflected = self.random:once(2)
  fields.spread = is_reflected and "reflect" or "hold"
  self:define('<%s id="%s" gradientUnits="userSpaceOnUse" spreadMethod="%s" %s>%s</%s>', svg.kind,
    name, is_reflected and "reflect" or "pad", svg.where, elements, svg.kind)
  return make(fields), ('fill="url(#%s)"'):format(name)
end

function maker:texture()
  if self.random:once(2) then return self:gradient() end
  local colour, alpha = self:colour(), self:number(0.3, 1)
  return celspan.rgb(colour, alpha), ('fill="%s" fill-opacity="%g"'):format(colour, alpha)
end

-- ---------------------------------------------------------------- shapes

local outlines = {}

function outlines.rect(make)
  local x, y = make:place()
  local w, h = make:number(80, 320), make:number(60, 240)
  x, y = x - w / 2, y - h / 2
  return celspan.rect { x, y, w, h },
    ('<rect x="%.9g" y="%.9g" width="%g" height="%g"'):format(x, y, w, h)
end

function outlines.ellipse(make)
  local x, y = make:place()
  local rx, ry = make:number(50, 180), make:number(40, 140)
  return celspan.ellipse { centre = { x, y }, radii = { rx, ry } },
    ('<ellipse cx="%g" cy="%g" rx="%g" ry="%g"'):format(x, y, rx, ry)
end

function outlines.polygon(make)
  local points, text = {}, {}
  for i = 1, make.random:whole(3, 5) do
    points[i] = { make:place() }
    text[i] = ("%g,%g"):format(points[i][1], points[i][2])
  end
  return celspan.polygon(points), ('<polygon points="%s"'):format(table.concat(text, " "))
end

--- Three boxes after each other, each a whole number of pixels wide: Chromium blurs in this way,
--- which the text of SVG allows. The Gaussian that celspan has would differ by some codes.
function maker:blurred(object, style)
  local side, name = 2 * self.random:whole(3, 6) + 1, self:name()
  local sigma = side * 4 / 3 / math.sqrt(2 * math.pi)
  self.is_blurred = true
  self:define('<filter id="%s" filterUnits="userSpaceOnUse" %s color-interpolation-filters="sRGB">'
    .. '<feGaussianBlur stdDeviation="%g"/></filter>', name, EVERYWHERE, sigma)
  style[#style + 1] = ("filter:url(#%s)"):format(name)
  for _ = 1, 3 do object = object:blur(side / 2, { kernel = "box" }) end
  return object
end

--- A shape, rotated, with a texture and a mode.
function maker:shape(mode)
  local is_blurred = self.modes == GENTLE and self.random:once(4)
  local kinds = is_blurred and { "rect", "polygon" } or { "rect", "ellipse", "polygon" }
  local outline, svg = outlines[self.random:pick(kinds)](self)
  local texture, fill = self:texture()
  local x, y = self:place()
  local degrees = self:number(0, 360)
  local turned, style = outline:rotate(degrees, x, y), {}
  local object = turned:with { texture = texture }
  if is_blurred then object = self:blurred(object, style) end
  if mode then
    object = object:blend(mode)
    style[#style + 1] = "mix-blend-mode:" .. mode
  end
  svg = ('<g style="%s">%s %s transform="rotate(%g %g %g)"/></g>'):format(table.concat(style, ";"),
    svg, fill, degrees, x, y)
  return { object = object, edges = turned:stroke { width = 1 }, svg = svg }
end

-- ---------------------------------------------------------------- groups

--- Shapes and, if less than three levels deep, groups; half of them with a mode.
function maker:members(depth)
  local objects, edges, svg = {}, {}, {}
  for i = 1, self.random:whole(2, 4) do
    local mode = self.random:once(2) and self:mode() or nil
    local is_group = depth < 3 and self.random:once(3)
    local one = is_group and self:group(depth + 1, mode) or self:shape(mode)
    objects[i], edges[i], svg[i] = one.object, one.edges, one.svg
  end
  return objects, edges, table.concat(svg, "\n")
end

--- An object behind a mask of two shapes, by alpha or luminance.
function maker:masked(object, edges, style)
  local from, name = self.random:pick { "alpha", "luma" }, self:name()
  local a, b = self:shape(), self:shape()
  self:define('<mask id="%s" maskUnits="userSpaceOnUse" %s mask-type="%s">%s%s</mask>', name,
    EVERYWHERE, from == "luma" and "luminance" or from, a.svg, b.svg)
  edges[#edges + 1], edges[#edges + 2] = a.edges, b.edges
  style[#style + 1] = ("mask:url(#%s)"):format(name)
  return celspan.matte(object, celspan.group { a.object, b.object }, { from = from })
end

--- The group of these objects, of some kind; the properties of CSS for it are appended to `style`.
function maker:composited(objects, edges, style)
  local kind = self.random:pick { "plain", "faded", "isolated", "masked" }
  if kind == "faded" then
    objects.opacity = self:number(0.3, 0.9)
    style[#style + 1] = ("opacity:%g"):format(objects.opacity)
  elseif kind == "isolated" then
    objects.isolate = true
    style[#style + 1] = "isolation:isolate"
  end
  local group = celspan.group(objects)
  return kind == "masked" and self:masked(group, edges, style) or group
end

function maker:group(depth, mode)
  local objects, edges, svg = self:members(depth)
  local style = { mode and "mix-blend-mode:" .. mode }
  local object = self:composited(objects, edges, style)
  return { object = mode and object:blend(mode) or object, edges = celspan.union(edges),
           svg = ('<g style="%s">%s</g>'):format(table.concat(style, ";"), svg) }
end

--- A random mode; none is used again before all others have been used.
function maker:mode()
  self.mode_count = self.mode_count + 1
  return self.modes[(self.seed * 5 + self.mode_count * 7) % #self.modes + 1]
end

function drawn.scene(seed)
  local make = setmetatable({ random = prng.new(seed), seed = seed, names = 0, mode_count = 0,
                              defs = {}, modes = seed % 4 == 0 and GENTLE or MODES }, maker)
  local ground = make:colour()
  local objects, edges, svg = make:members(1)
  local more, more_edges, more_svg = make:members(1)
  table.insert(objects, 1, celspan.rect { 0, 0, drawn.w, drawn.h, texture = ground })
  table.move(more, 1, #more, #objects + 1, objects)
  table.move(more_edges, 1, #more_edges, #edges + 1, edges)
  return {
    object = celspan.union(objects), edges = celspan.union(edges), is_blurred = make.is_blurred,
    svg = ('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d"><defs>%s</defs>'
      .. '<rect width="100%%" height="100%%" fill="%s"/>%s\n%s</svg>'):format(drawn.w, drawn.h,
        table.concat(make.defs), ground, svg, more_svg),
  }
end

return drawn
