-- check_decoder.lua DECODER FOLDER COUNT COLUMNS ROWS: compares FOLDER/i.plane, as the decoder
-- draws it, with FOLDER/i.pixels.
local decode = dofile(arg[1])
local folder, count, columns, rows = arg[2], tonumber(arg[3]), tonumber(arg[4]), tonumber(arg[5])
local MOST, MEAN = 65535 * 2 / 255, 65535 * 0.02 / 255

local function read(name)
  local file = assert(io.open(folder .. "/" .. name, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

for number = 0, count - 1 do
  local drawn = decode(read(number .. ".plane"), columns, rows)
  local known, sum = read(number .. ".pixels"), 0
  assert(#known == 16 * columns * rows)
  for y = 0, rows - 1 do
    for i = 1, 4 * columns do
      local value = ("<i4"):unpack(known, 16 * columns * y + 4 * (i - 1) + 1)
      local off = math.abs(value - drawn[y][i])
      if off > MOST then
        error(("plane %d, row %d, column %d: %g and %g"):format(number, y, (i - 1) // 4, value,
          drawn[y][i]))
      end
      sum = sum + off
    end
  end
  assert(sum / (4 * columns * rows) <= MEAN, "plane " .. number .. " differs everywhere")
end
print(count .. " planes are the same")
