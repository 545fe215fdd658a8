--- The parts of PNG files and of archives: checksums, zlib streams, chunks.
local stored = {}

local remainders = {}
for i = 0, 255 do
  local c = i
  for _ = 1, 8 do c = c & 1 == 1 and 0xEDB88320 ~ (c >> 1) or c >> 1 end
  remainders[i] = c
end

function stored.crc32(text)
  local c = 0xFFFFFFFF
  for i = 1, #text do c = remainders[(c ~ text:byte(i)) & 255] ~ (c >> 8) end
  return c ~ 0xFFFFFFFF
end

local function adler32(text)
  local a, b = 1, 0
  for i = 1, #text do
    a = (a + text:byte(i)) % 65521
    b = (b + a) % 65521
  end
  return b << 16 | a
end

--- A deflate stream of stored blocks.
function stored.deflate(text)
  local out = {}
  for at = 1, math.max(1, #text), 65535 do
    local piece = text:sub(at, at + 65534)
    local is_last = at + 65535 > #text
    out[#out + 1] = string.pack("<BI2I2", is_last and 1 or 0, #piece, ~#piece & 0xFFFF) .. piece
  end
  return table.concat(out)
end

function stored.zlib(text)
  return "\x78\x01" .. stored.deflate(text) .. string.pack(">I4", adler32(text))
end

function stored.chunk(kind, data)
  return string.pack(">I4", #data) .. kind .. data
    .. string.pack(">I4", stored.crc32(kind .. data))
end

return stored
