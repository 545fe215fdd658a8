--- The merged picture of a Photoshop document, as Photoshop made it: the reference for its layers.
--
--   merged.read(path) -> { width =, height =, channels =, [c] = { [y * width + x] = 0..255 } }
--
-- 8 bits per channel, raw or PackBits.
local system = require "tests.support.system"

local merged = {}

local function unpack_row(text, at, size, out)
  local stop = at + size
  while at < stop do
    local head = text:byte(at)
    if head < 128 then
      for i = 1, head + 1 do out[#out + 1] = text:byte(at + i) end
      at = at + head + 2
    else
      if head > 128 then
        for _ = 1, 257 - head do out[#out + 1] = text:byte(at + 1) end
      end
      at = at + (head > 128 and 2 or 1)
    end
  end
end

local function read_packed(text, at, picture)
  local rows = picture.channels * picture.height
  local data = at + 2 * rows
  for row = 0, rows - 1 do
    local channel = picture[row // picture.height + 1]
    local size = string.unpack(">I2", text, at + 2 * row)
    unpack_row(text, data, size, channel)
    data = data + size
  end
end

function merged.read(path)
  local text = assert(system.read(path))
  local channels, height, width, depth = string.unpack(">I2I4I4I2", text, 13)
  assert(depth == 8, "8 bits per channel")
  local at = 27
  for _ = 1, 3 do at = at + 4 + string.unpack(">I4", text, at) end
  local picture = { width = width, height = height, channels = channels }
  for c = 1, channels do picture[c] = {} end
  local packing = string.unpack(">I2", text, at)
  if packing == 1 then
    read_packed(text, at + 2, picture)
  else
    for c = 1, channels do
      for i = 0, width * height - 1 do
        picture[c][i + 1] = text:byte(at + 2 + (c - 1) * width * height + i)
      end
    end
  end
  for c = 1, channels do
    local values = picture[c]
    table.move(values, 1, #values, 0)
    values[#values] = nil
  end
  return picture
end

return merged
