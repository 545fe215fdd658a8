-- The error of traced edges over random drawings with known edges.
--
--   LUA_PATH='?.lua;;' LUA_CPATH=build/?.so \
--     lua5.4 tests/bench/trace_edges.lua [LAST [FIRST]]
--
-- The drawings are numbers FIRST to LAST of those that tests/core/property/trace_spec.lua tries, 1
-- to 30 by default; each is rasterised with antialiasing, and without, so that each pixel has one
-- colour or the other. Printed are the largest error of any edge of a drawing, in its pixels: how
-- many
-- drawings are within a quarter and within half a pixel, the median and the worst; and how many
-- pixels of all drawings change when drawing and tracing are drawn without antialiasing. EACH=1
-- prints every drawing.
local traced = require "tests.support.traced"
local last, first = tonumber(arg[1] or 30), tonumber(arg[2] or 1)

local function within(offs, most)
  local count = 0
  for _, off in ipairs(offs) do count = count + (off <= most and 1 or 0) end
  return count
end

local function measure(antialias, name)
  local offs, changed = {}, 0
  for case = first, last do
    local off, object, w, h, original = traced.retrace(case, antialias)
    offs[#offs + 1], changed = off, changed + traced.changed(original, object, w, h)
    if os.getenv "EACH" then print(("%-13s %5d %.3f"):format(name, case, offs[#offs])) end
  end
  table.sort(offs)
  print(("%-13s %8d %12d %10d %8.3f %8.3f %8d"):format(name, #offs, within(offs, 0.25),
    within(offs, 0.5), offs[#offs // 2 + 1], offs[#offs], changed))
end

print(("%-13s %8s %12s %10s %8s %8s %8s"):format("", "drawings", "within 0.25", "within 0.5",
  "median", "worst", "changed"))
measure("area", "antialiased")
measure("none", "one bit")
