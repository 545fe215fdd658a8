-- A font without its variations, which are as large as its outlines.
--
--   lua5.4 font.lua IN.ttf OUT.ttf
local WITHOUT = { fvar = true, gvar = true }
local HEAD, ROW = 12, 16 -- bytes

local file = assert(io.open(arg[1], "rb"))
local font = file:read "a"
file:close()

local kept = {}
for i = 0, string.unpack(">I2", font, 5) - 1 do
  local tag, sum, place, size = string.unpack(">c4I4I4I4", font, 1 + HEAD + ROW * i)
  local text = font:sub(place + 1, place + size)
  if not WITHOUT[tag] then kept[#kept + 1] = { tag, sum, text .. ("\0"):rep(-size % 4), size } end
end

local place, rows, texts = HEAD + ROW * #kept, {}, {}
for i, one in ipairs(kept) do
  rows[i], texts[i] = string.pack(">c4I4I4I4", one[1], one[2], place, one[4]), one[3]
  place = place + #one[3]
end
local level = math.tointeger(math.log(#kept, 2) // 1)
local head = string.pack(">c4I2I2I2I2", font:sub(1, 4), #kept, ROW << level, level,
  ROW * (#kept - (1 << level)))
file = assert(io.open(arg[2], "wb"))
assert(file:write(head, table.concat(rows), table.concat(texts)))
assert(file:close())
