--- Two pictures of one size, pixel by pixel: how far their coded values lie apart, and a picture that
--- shows where.
--
-- Codes are sRGB of 8 bits, alpha straight, as pictures hold them; a difference is 0..1. The colour
-- under an alpha of 0 does not count. Rows that are equal are not opened, so that equal pictures cost
-- nothing.
local celspan = require "celspan"

local difference = {}

---@class celspan.difference
---@field largest number Of all coded values, 0..1
---@field x? integer Of the pixel where it is, from 0
---@field y? integer
---@field channel? "r"|"g"|"b"|"a"
---@field count integer Pixels that differ by more than the tolerance
---@field rows table<integer, string> The rows of the difference picture that are not even, RGBA

local channels = { "r", "g", "b", "a" }

--- What the picture of differences shows of a pixel that is as it should be: the first picture in a
--- pale grey, to find one's way.
local function pale(r, g, b, a)
  local grey = 255 - (255 - (r * 54 + g * 183 + b * 18) // 255) * a // 255 * 2 // 5
  return string.char(grey, grey, grey, 255)
end

--- A pixel that differs: red, the darker the more.
local function marked(distance)
  local rest = math.floor(150 * (1 - distance))
  return string.char(255 - math.floor(90 * distance), rest, rest // 2, 255)
end

--- The largest difference of two pixels and its channel.
local function distance_of(r, g, b, a, r2, g2, b2, a2)
  if a == 0 and a2 == 0 then return 0, 4 end
  local most, channel = math.abs(a - a2), 4
  local red, green, blue = math.abs(r - r2), math.abs(g - g2), math.abs(b - b2)
  if a == 0 or a2 == 0 then red, green, blue = 0, 0, 0 end
  if red > most then most, channel = red, 1 end
  if green > most then most, channel = green, 2 end
  if blue > most then most, channel = blue, 3 end
  return most / 255, channel
end

local function compare_row(found, y, row, row2, tolerance)
  local pixels = {}
  for at = 1, #row, 4 do
    local r, g, b, a = row:byte(at, at + 3)
    local distance, channel = distance_of(r, g, b, a, row2:byte(at, at + 3))
    local x = at // 4
    if distance > found.largest then
      found.largest, found.x, found.y, found.channel = distance, x, y, channels[channel]
    end
    if distance > tolerance then found.count = found.count + 1 end
    pixels[x + 1] = distance > tolerance and marked(distance) or pale(r, g, b, a)
  end
  found.rows[y] = table.concat(pixels)
end

--- Compares two images of celspan.pixels; they must have one size.
---@param first celspan.pixels.image
---@param second celspan.pixels.image
---@param tolerance number 0..1
---@return celspan.difference
function difference.of(first, second, tolerance)
  local coding = { depth = 8, colour = "srgb", alpha = "straight" }
  local bytes, bytes2 = first:bytes(coding), second:bytes(coding)
  local found, stride = { largest = 0, count = 0, rows = {} }, 4 * first.width
  if bytes == bytes2 then return found end
  for y = 0, first.height - 1 do
    local row = bytes:sub(y * stride + 1, (y + 1) * stride)
    local row2 = bytes2:sub(y * stride + 1, (y + 1) * stride)
    if row ~= row2 then compare_row(found, y, row, row2, tolerance) end
  end
  return found
end

--- The first picture in pale grey with what differs in red, as a rostrum of its size.
---@param found celspan.difference
---@param first celspan.pixels.image
---@return celspan.rostrum
function difference.picture(found, first)
  local bytes, stride, rows = first:bytes { depth = 8, colour = "srgb", alpha = "straight" },
    4 * first.width, {}
  for y = 0, first.height - 1 do
    rows[y + 1] = found.rows[y] or bytes:sub(y * stride + 1, (y + 1) * stride)
      :gsub("(.)(.)(.)(.)", function(r, g, b, a) return pale(r:byte(), g:byte(), b:byte(), a:byte()) end)
  end
  return difference.scene(table.concat(rows), first.width, first.height)
end

--- RGBA bytes as a rostrum that shows them pixel for pixel.
function difference.scene(bytes, width, height)
  local size = { width, height }
  return celspan.rostrum { size = size, antialias = "none", celspan.cel {
    celspan.image { pixels = bytes, size = size, format = "rgba8", x = 0, y = 0, w = width, h = height } } }
end

return difference
