-- A decoder of span files, written from docs/spanfile.md alone: `lua decode.lua FILE OUT` writes all
-- pixels; `lua decode.lua FOLDER COUNT` holds FOLDER/i.span against FOLDER/i.pixels.

local function crc32c(bytes)
  local sum = 0xffffffff
  for i = 1, #bytes do
    sum = sum ~ bytes:byte(i)
    for _ = 1, 8 do
      sum = (sum & 1) ~= 0 and sum >> 1 ~ 0x82f63b78 or sum >> 1
    end
  end
  return sum ~ 0xffffffff
end

local function varint(bytes, at)
  local number, shift = 0, 0
  repeat
    local byte = bytes:byte(at)
    number, shift, at = number | (byte & 127) << shift, shift + 7, at + 1
  until byte < 128
  return number, at
end

local function from_half(half)
  local exponent, fraction = half >> 10 & 31, half & 1023
  local size = exponent == 0 and fraction * 2.0 ^ -24 or (1024 + fraction) * 2.0 ^ (exponent - 25)
  return half & 0x8000 ~= 0 and -size or size
end

local function to_half(number)
  local sign = (number < 0 or 1 / number < 0) and 0x8000 or 0
  local size, exponent = math.abs(number), 1
  while size >= 2.0 ^ (exponent - 14) do
    exponent = exponent + 1
  end
  local steps = size / 2.0 ^ (exponent - 25) -- 1024 to 2048, or less with exponent 1
  local whole = math.floor(steps)
  local rest = steps - whole
  whole = (rest > 0.5 or rest == 0.5 and whole % 2 == 1) and whole + 1 or whole
  return sign | ((exponent - 1) << 10) + whole
end

local function gradient(layout, first, last, count)
  local a, b, pixels = {layout:unpack(first)}, {layout:unpack(last)}, {}
  for i = 0, count - 1 do
    local v, n = {}, count - 1
    for c = 1, 4 do
      if layout.is_half then
        v[c] = to_half((from_half(a[c]) * (n - i) + from_half(b[c]) * i) / n)
      else
        v[c] = (a[c] * (n - i) + b[c] * i + n // 2) // n
      end
    end
    pixels[#pixels + 1] = layout.format:pack(table.unpack(v))
  end
  return table.concat(pixels)
end

-- The spans of a row from its packets: {kind, length, pixel of a run}, and the values of the others.
local function packets(payload, pixel_size)
  local spans, values, at = {}, {}, 1
  while at <= #payload do
    local kind, count = ("<BI2"):unpack(payload, at)
    count = count + 1
    local size = (kind == 0 and count or kind) * pixel_size
    local data, last = payload:sub(at + 3, at + 2 + size), spans[#spans]
    local pixel = kind == 1 and data or ""
    if last and kind ~= 2 and last.kind == kind and last.pixel == pixel then
      last.length = last.length + count
    else
      spans[#spans + 1] = {kind = kind, length = count, pixel = pixel}
    end
    values[#values + 1] = kind == 1 and "" or data
    at = at + 3 + size
  end
  return spans, table.concat(values)
end

local function move(spans, moves, payload)
  local at, shift = (#spans - 1 + 3) // 4 + 1, 0
  for i = 1, #spans - 1 do
    local code = payload:byte((i - 1) // 4 + 1) >> (i - 1) % 4 * 2 & 3
    local rest = code == 2 and -1 or code
    if code == 3 then
      rest, at = varint(payload, at)
      rest = rest & 1 ~= 0 and -(rest >> 1) - 1 or rest >> 1
    end
    moves[i] = (moves[i] or 0) + rest
    spans[i].length, shift = spans[i].length + moves[i] - shift, moves[i]
  end
  spans[#spans].length = spans[#spans].length - shift
  return payload:sub(at)
end

local function pixels_of(spans, values, layout)
  local row, at = {}, 1
  for i, span in ipairs(spans) do
    local size = (span.kind == 0 and span.length or span.kind == 2 and 2 or 0) * layout.pixel_size
    local data = values:sub(at, at + size - 1)
    row[i] = span.kind == 0 and data or span.kind == 1 and span.pixel:rep(span.length)
      or gradient(layout, data:sub(1, size // 2), data:sub(size // 2 + 1), span.length)
    at = at + size
  end
  return table.concat(row)
end

local function decode(bytes)
  local width, height, format = ("<I4I4I4"):unpack(bytes, 27)
  assert(bytes:sub(19, 26) == "celspan\1" and crc32c(bytes:sub(1, 42)) == ("<I4"):unpack(bytes, 43))
  local layout = {is_half = format == 2, pixel_size = format * 4, format = format == 2 and "<I2I2I2I2" or "BBBB"}
  function layout:unpack(pixel) return self.format:unpack(pixel) end
  local rows, at, spans, values, moves = {}, 47, nil, nil, nil
  while #rows < height do
    local kind, size = bytes:sub(at, at), nil
    local payload_at
    size, payload_at = varint(bytes, at + 1)
    local payload, sum_at = bytes:sub(payload_at, payload_at + size - 1), payload_at + size
    local number = kind == "I" and 0xffffffff or #rows
    assert(crc32c(("<I4"):pack(number) .. bytes:sub(at, sum_at - 1)) == ("<I4"):unpack(bytes, sum_at))
    at = sum_at + 4
    if kind == "P" then
      spans, values = packets(payload, layout.pixel_size)
      moves = {}
    elseif kind == "M" then
      values = move(spans, moves, payload)
    elseif kind == "S" then
      moves = {}
    end
    if kind ~= "I" then
      rows[#rows + 1] = pixels_of(spans, values, layout)
      assert(#rows[#rows] == width * layout.pixel_size)
    end
  end
  return table.concat(rows)
end

local function read(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

local count = tonumber(arg[2])
if not count then
  local file = assert(io.open(arg[2], "wb"))
  file:write(decode(read(arg[1])))
  file:close()
  return
end
local good = 0
for i = 0, count - 1 do
  local path = arg[1] .. "/" .. i
  if decode(read(path .. ".span")) == read(path .. ".pixels") then
    good = good + 1
  else
    io.stderr:write(path, ".span: other pixels\n")
  end
end
print(good == count and ("%d checks passed"):format(count)
  or ("%d of %d checks failed"):format(count - good, count))
os.exit(good == count)
