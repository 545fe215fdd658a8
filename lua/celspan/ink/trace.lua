--- Scanned line art and flat-colour drawings as shapes.
--
--   local art = assert(trace.picture("scan.png", { colours = 3 }))
--   art.object                              -- the whole, from (0, 0) to art.width, art.height
--   art.shapes[2].object:with { texture = "#ffcc66" }          -- an area in another colour
--   assert(trace.picture("sketch.png", { lines = true }))      -- strokes along the lines
--
-- Adjacent areas share their border: there are no gaps between them at any size.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local trace = {}

---@class celspan.trace.shape
---@field object celspan.object A path, or a stroke, painted with the colour
---@field colour string "#rrggbb"
---@field x integer Of a pixel inside it
---@field y integer
---@field area number In pixels of the picture; of a stroke, the area that it covers
---@field d? string The path data
---@field points? number[][] Of a stroke: x, y and width, of a spline of degree 3
---@field closed? boolean Of a stroke

---@class celspan.trace.art
---@field object celspan.object All shapes
---@field shapes celspan.trace.shape[] Areas, the largest first, or strokes, the longest first
---@field width integer Of the picture, in pixels: the units of the shapes
---@field height integer
local Art = { __name = "celspan.trace" }
Art.__index = fields.reads("a tracing", {})

local Shape = { __name = "celspan.trace.shape" }
Shape.__index = fields.reads("a shape of a tracing", {}, { d = true, points = true, closed = true })

---@class celspan.trace.options
---@field colours? integer|string[] The number to find in the picture, 1 to 64, or a list: "#rrggbb"; default 2
---@field smooth? number How far curves may deviate from the edges, 0 to 16: 1 means 0.15 pixels; 0: the sides of the pixels; default 1
---@field speckle? integer Areas of at most this many pixels are merged into their neighbours; default 2
---@field lines? boolean Strokes along the lines on the ground, instead of areas

local known = { colours = "any", smooth = "number", speckle = "number", lines = "boolean" }

--- A message that `picture` raises; the checks below return a value, or nil and a message.
local function wrong(text, ...) return nil, "trace: " .. text:format(...) end

local function whole(name, value, least, most)
  local number = math.tointeger(value)
  if number and number >= least and number <= most then return number end
  return wrong("%s must be a whole number from %d to %d, got %s", name, least, most,
    fields.shown(value))
end

--- "#abc" as "#aabbcc", and the name of a colour likewise.
local function whole_colour(text)
  text = native.hex(text) or text
  local r, g, b = text:match "^#(%x)(%x)(%x)$"
  return r and ("#" .. r:rep(2) .. g:rep(2) .. b:rep(2)) or text:match "^#%x%x%x%x%x%x$"
end

local function colours_of(colours)
  if type(colours) ~= "table" then return whole("colours", colours, 1, 64) end
  if #colours < 1 or #colours > 64 then
    return wrong("colours must be a number or a list of 1 to 64 colours, got %d", #colours)
  end
  local list = {}
  for i = 1, #colours do
    local colour = colours[i]
    list[i] = type(colour) == "string" and whole_colour(colour)
    if not list[i] then
      return wrong("colours[%d] must be a colour like \"#336699\", got %s", i,
        type(colour) == "string" and ("%q"):format(colour) or fields.kind(colour))
    end
  end
  return list
end

--- The options in the form that the core takes.
local function check(options)
  local smooth = options.smooth or 1
  local colours, message = colours_of(options.colours or 2)
  if not colours then return nil, message end
  local speckle
  speckle, message = whole("speckle", options.speckle or 2, 0, 2147483647)
  if not speckle then return nil, message end
  if smooth < 0 or smooth > 16 then
    return wrong("smooth must be from 0 to 16, got %s", fields.shown(smooth))
  end
  return { colours = colours, smooth = smooth, speckle = speckle, lines = options.lines }
end

local function make_object(shape)
  if shape.d then return celspan.path { d = shape.d, texture = shape.colour } end
  return celspan.stroke { points = shape.points, closed = shape.closed, degree = 3, cap = "round",
    join = "round", texture = shape.colour }
end

local function wrap(found)
  local objects = {}
  for i, shape in ipairs(found.shapes) do
    shape.object = make_object(shape)
    objects[i] = shape.object
    setmetatable(shape, Shape)
  end
  found.object = celspan.union(objects)
  return setmetatable(found, Art)
end

---@param path string A picture; relative to the caller's file, else to the script
---@param options? celspan.trace.options
---@return celspan.trace.art? art
---@return string? message
function trace.picture(path, options)
  fields.takes("trace: picture", "string", "a file name", path)
  options = fields.check("trace: picture", options == nil and {} or options, known)
  local checked, refused = check(options)
  if not checked then native.refuse(refused) end
  local found, message = native.trace(native.find(path), checked)
  if found then return wrap(found) end
  return nil, message
end

return fields.publish("trace", trace)
