--- Any bytes as a file of lip-sync: a track with a mouth for every frame, or nil and a sentence
--- that names the file. The first byte chooses the options.
local lips = require "celspan.lips"

local target = {}

local path = os.tmpname()

local function write(bytes)
  local file = assert(io.open(path, "wb"))
  file:write(bytes)
  file:close()
end

local function options_of(byte)
  return {
    fps = ({ 24, 1, 999.5, 1e-3 })[byte % 4 + 1],
    hold = ({ 2, 1, 40, 1e300 })[byte // 4 % 4 + 1],
    set = byte & 16 > 0 and { "A", "C" } or nil,
    map = byte & 32 > 0 and { A = "closed", MBP = 1 } or nil,
  }
end

function target.try_bytes(bytes)
  write(bytes:sub(2))
  local track, message = lips.read(path, options_of((bytes:byte() or 0)))
  os.remove(path)
  if not track then
    assert(message:find(path, 1, true) and #message < #path + 500,
      "no sentence that names the file")
    return
  end
  assert(track.frames == #track.shapes and track.frames >= 1, "a track without frames")
  for _, frame in ipairs { 1, 0, -1e300, track.frames, track.frames + 1, 1e300, 1.5 } do
    assert(track:at(frame) ~= nil, "a frame without a mouth")
  end
end

return target
