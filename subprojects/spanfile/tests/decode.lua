-- A decoder of span files, written only from docs/spanfile.md: all bytes in, all pixels out.

local function crc32c(bytes)
  local sum = 0xffffffff
  for i = 1, #bytes do
    sum = sum ~ bytes:byte(i)
    for _ = 1, 8 do sum = sum & 1 == 1 and sum >> 1 ~ 0x82f63b78 or sum >> 1 end
  end
  return sum ~ 0xffffffff
end

local function varint(bytes, at)
  local number, shift = 0, 0
  while bytes:byte(at) >= 128 do
    number, shift, at = number | (bytes:byte(at) & 127) << shift, shift + 7, at + 1
  end
  return number | bytes:byte(at) << shift, at + 1
end

local function from_half(half)
  local exponent, fraction = half >> 10 & 31, half & 1023
  local size = exponent == 0 and fraction * 2.0 ^ -24 or (1024 + fraction) * 2.0 ^ (exponent - 25)
  return half & 0x8000 ~= 0 and -size or size
end

local function to_half(number)
  local sign = (number < 0 or 1 / number < 0) and 0x8000 or 0
  local size, exponent = math.abs(number), 1
  while size >= 2.0 ^ (exponent - 14) do exponent = exponent + 1 end
  local steps = size / 2.0 ^ (exponent - 25)
  local whole, rest = math.floor(steps), steps - math.floor(steps)
  if rest > 0.5 or rest == 0.5 and whole % 2 == 1 then whole = whole + 1 end
  return sign | ((exponent - 1) << 10) + whole
end

local function gradient(layout, ends, count)
  local a, b, n = {layout.form:unpack(ends)}, {layout.form:unpack(ends, layout.size + 1)}, count - 1
  local pixels, v = {}, {}
  for i = 0, n do
    for c = 1, 4 do
      v[c] = not layout.is_half and (a[c] * (n - i) + b[c] * i + n // 2) // n
        or to_half((from_half(a[c]) * (n - i) + from_half(b[c]) * i) / n)
    end
    pixels[i + 1] = layout.form:pack(table.unpack(v, 1, 4))
  end
  return table.concat(pixels)
end

-- The spans of a row from its packets, and the pixels of those that are not runs.
local function read_packets(payload, size)
  local spans, values, at = {}, {}, 1
  while at <= #payload do
    local kind, count = ("<BI2"):unpack(payload, at)
    local data = payload:sub(at + 3, at + 2 + (kind == 0 and count + 1 or kind) * size)
    local last, pixel = spans[#spans], kind == 1 and data or ""
    if last and kind ~= 2 and last.kind == kind and last.pixel == pixel then
      last.length = last.length + count + 1
    else
      spans[#spans + 1] = {kind = kind, length = count + 1, pixel = pixel, move = 0}
    end
    values[#values + 1] = kind == 1 and "" or data
    at = at + 3 + #data
  end
  return spans, table.concat(values)
end

local function read_moves(spans, payload)
  local at, before = (#spans - 1 + 3) // 4 + 1, 0
  for i, span in ipairs(spans) do
    if i < #spans then
      local code = payload:byte((i - 1) // 4 + 1) >> 2 * ((i - 1) % 4) & 3
      local more = code == 2 and -1 or code
      if code == 3 then
        more, at = varint(payload, at)
        more = more % 2 == 0 and more // 2 or -(more + 1) // 2
      end
      span.move = span.move + more
    end
    span.length, before = span.length + span.move - before, span.move
  end
  return payload:sub(at)
end

local function pixels_of(spans, values, layout)
  local row, at = {}, 1
  for i, span in ipairs(spans) do
    local count = span.kind == 0 and span.length or span.kind == 2 and 2 or 0
    local data = values:sub(at, at + count * layout.size - 1)
    at = at + #data
    row[i] = span.kind == 0 and data or span.kind == 1 and span.pixel:rep(span.length)
      or gradient(layout, data, span.length)
  end
  return table.concat(row)
end

local function decode(bytes)
  local magic, width, height, format = ("<c8I4I4I4"):unpack(bytes, 19)
  assert(magic == "celspan\1" and crc32c(bytes:sub(1, 42)) == ("<I4"):unpack(bytes, 43))
  local is_half = format == 2
  local layout = {is_half = is_half, size = 4 * format, form = is_half and "<I2I2I2I2" or "BBBB"}
  local rows, at, spans, values = {}, 47, nil, nil
  while #rows < height do
    local kind, size, start = bytes:sub(at, at), varint(bytes, at + 1)
    local payload = bytes:sub(start, start + size - 1)
    local number = ("<I4"):pack(kind == "I" and 0xffffffff or #rows)
    assert(crc32c(number .. bytes:sub(at, start + size - 1)) == ("<I4"):unpack(bytes, start + size))
    at = start + size + 4
    if kind == "P" then spans, values = read_packets(payload, layout.size) end
    if kind == "M" then values = read_moves(spans, payload) end
    for i = 1, kind == "S" and #spans or 0 do spans[i].move = 0 end
    if kind ~= "I" then rows[#rows + 1] = pixels_of(spans, values, layout) end
  end
  return table.concat(rows), width, height
end

return decode
