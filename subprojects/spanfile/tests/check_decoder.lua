-- check_decoder.lua DECODER FOLDER COUNT: compares FOLDER/i.span with FOLDER/i.pixels.
local decode, folder, count = dofile(arg[1]), arg[2], tonumber(arg[3])

local function read(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

local good = 0
for i = 0, count - 1 do
  local path = folder .. "/" .. i
  local is_same = decode(read(path .. ".span")) == read(path .. ".pixels")
  good = good + (is_same and 1 or 0)
  if not is_same then io.stderr:write(path, ".span: other pixels\n") end
end
print(good == count and ("%d checks passed"):format(count)
  or ("%d of %d checks failed"):format(count - good, count))
os.exit(good == count)
