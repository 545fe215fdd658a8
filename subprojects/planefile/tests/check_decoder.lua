-- check_decoder.lua DECODER FOLDER COUNT COLUMNS ROWS: compares FOLDER/i.plane and frame i of
-- FOLDER/film.plane, as the decoder draws them, with FOLDER/i.pixels. FOLDER has the codes of the
-- pictures of a name, too.
local decode = dofile(arg[1])
local folder, count, columns, rows = arg[2], tonumber(arg[3]), tonumber(arg[4]), tonumber(arg[5])
local MOST, MEAN = 65535 * 2 / 255, 65535 * 0.02 / 255

local function read(name)
  local file = assert(io.open(folder .. "/" .. name, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

local function compare(drawn, known, name)
  local sum = 0
  assert(#known == 16 * columns * rows)
  for y = 0, rows - 1 do
    for i = 1, 4 * columns do
      local value = ("<i4"):unpack(known, 16 * columns * y + 4 * (i - 1) + 1)
      local off = math.abs(value - drawn[y][i])
      if off > MOST then
        error(("%s, row %d, column %d: %g and %g"):format(name, y, (i - 1) // 4, value,
          drawn[y][i]))
      end
      sum = sum + off
    end
  end
  assert(sum / (4 * columns * rows) <= MEAN, name .. " differs everywhere")
end

local function find_codes(name, width, height)
  local codes = read(name)
  assert(#codes == 4 * width * height)
  return codes
end

local film = read("film.plane")
for number = 0, count - 1 do
  local known = read(number .. ".pixels")
  compare(decode(read(number .. ".plane"), columns, rows, 0, find_codes), known, "plane " .. number)
  compare(decode(film, columns, rows, number, find_codes), known, "frame " .. number)
end
print(count .. " planes and frames are the same")
