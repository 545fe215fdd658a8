-- The exact reference for antialiasing: the mean of k x k pixel centres of the same scene.
local celspan = require "celspan"

local supersample = {}

--- Adds columns [x0, x1) of a span to the sums of pixels that are k columns wide.
local function add_span(sums, base, span, k)
  local x = span.x0
  while x < span.x1 do
    local pixel = x // k
    local stop = math.min(span.x1, (pixel + 1) * k)
    local at = base + 4 * pixel
    for c = 1, 4 do
      if span.kind == "single" then
        sums[at + c] = sums[at + c] + (stop - x) * span[c]
      else
        local middle = span.kind == "array" and error "an array span of flat paints"
          or span.x1 - span.x0 > 1 and (0.5 * (x + stop - 1) - span.x0) / (span.x1 - 1 - span.x0)
          or 0
        sums[at + c] = sums[at + c] + (stop - x) * (span[c] + (span[4 + c] - span[c]) * middle)
      end
    end
    x = stop
  end
end

--- The means of the pixels of a crop {x, y, w, h} (the whole frame by default), as one list of
--- r, g, b, a. options: size, film, crop, k.
function supersample.means(exposures, options)
  local size, k = options.size, options.k
  local crop = options.crop or { 0, 0, size[1], size[2] }
  local sums = {}
  for i = 1, 4 * crop[3] * crop[4] do sums[i] = 0 end
  for y = 0, crop[4] - 1 do -- one row of pixels at a time, to use little memory
    local rows = assert(celspan.spans(exposures, {
      size = { size[1] * k, size[2] * k }, film = options.film or size, antialias = "none",
      workers = 1,
      crop = { crop[1] * k, (crop[2] + y) * k, crop[3] * k, k } }))
    for j = 0, k - 1 do
      for _, span in ipairs(rows[j]) do add_span(sums, 4 * y * crop[3], span, k) end
    end
  end
  for i = 1, #sums do sums[i] = sums[i] / (k * k) end
  return sums
end

--- The greatest and the root mean square difference between an image's pixels and such means, and
--- the pixel with the greatest. options.crop: the position of the image.
function supersample.errors(image, means)
  local most, square, at_x, at_y = 0, 0, 0, 0
  for y = 0, image.height - 1 do
    for x = 0, image.width - 1 do
      local pixel, base = { image:get(x, y) }, 4 * (y * image.width + x)
      for c = 1, 4 do
        local difference = math.abs(pixel[c] - means[base + c])
        square = square + difference ^ 2
        if difference > most then most, at_x, at_y = difference, x, y end
      end
    end
  end
  return most, (square / #means) ^ 0.5, at_x, at_y
end

return supersample
