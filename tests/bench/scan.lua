-- Registering and cleaning scans: how exact, and processor time beside decoding and encoding.
--
--   LUA_CPATH=build/?.so lua5.4 tests/bench/scan.lua [COUNT [DPI [FIRST]]]
local celspan = require "celspan"
local ink = require "celspan.ink"
local scans = require "tests.support.scans"

local count, dpi, from = tonumber(arg[1] or 200), tonumber(arg[2] or 300), tonumber(arg[3] or 1)
local folder = os.tmpname()
os.remove(folder)
assert(os.execute("mkdir " .. folder))

local good, refused, worst, clean, encode = 0, 0, 0, 0, 0

--- The processor time of a call, and its results.
local function timed(call, ...)
  local begun = os.clock()
  local results = table.pack(call(...))
  return os.clock() - begun, table.unpack(results, 1, results.n)
end

for i = from, from + count - 1 do
  local scan, ending = scans.any(i, dpi)
  local path = ("%s/%04d.%s"):format(folder, i, ending)
  scans.write(path, scan)
  local seconds, drawings, message = timed(ink.scan, folder .. "/####." .. ending,
    { dpi = dpi, frames = tostring(i) })
  clean = clean + seconds
  if not drawings then
    refused = refused + 1
    print(message)
  else
    local drawing = drawings[i]
    local off = scans.error_of(drawing, scan)
    worst, good = math.max(worst, off), good + (off <= 0.1 and 1 or 0)
    if off > 0.1 then print(("%s: off by %.3f mm"):format(path, off)) end
    encode = encode + timed(celspan.render, celspan.rostrum { celspan.cel { drawing.object } },
      folder .. "/out.png", { size = { drawing.width, drawing.height } })
  end
  os.remove(path)
end
os.execute("rm -r " .. folder)
print(("%d scans at %g dpi: %d within 0.1 mm, %d refused, the worst %.3f mm; seconds of a "
  .. "processor a scan: %.3f with decoding, %.3f encoding"):format(count, dpi, good, refused, worst,
  clean / count, encode / count))
