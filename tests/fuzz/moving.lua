--- Any bytes as a drawing that moves: objects at some times, or a sentence that names the file.
local svg = require "celspan.svg"

local target = {}

local folder = os.tmpname()
local count = 0

--- A name of its own: a file that has not changed since is not read again.
local function write(bytes)
  count = count + 1
  local path = ("%s-%d.svg"):format(folder, count)
  local file = assert(io.open(path, "wb"))
  file:write(bytes)
  file:close()
  return path
end

--- The drawing at some times, if the bytes are one.
function target.try_bytes(bytes)
  local path = write(bytes)
  local art, message = svg.read(path)
  os.remove(path)
  if not art then
    assert(message:find(path, 1, true), message)
    return
  end
  assert(not art.seconds or art.seconds > 0 and art.seconds <= 1e12)
  for _, seconds in ipairs { 0, 0.7, 1e5 } do
    local is_good, result = pcall(art.at, art, seconds)
    assert(is_good or tostring(result):find(path, 1, true), result)
  end
end

return target
