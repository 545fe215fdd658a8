-- One cel of the demo film with its light, as a compositing program would be given it. Arguments:
-- the exposure and the cel, from 1; or nothing, which prints how many cels each exposure has.
local celspan = require "celspan"
local demo = require "demo"

local exposure, index = ...

--- The exposures of a frame, as a list of rostrums.
local function exposures(number)
  local shown = demo:at(number)
  if type(shown) ~= "table" then return { shown } end
  local list = {}
  for i, one in ipairs(shown) do list[i] = one[1] end
  return list
end

if not exposure then
  for i, rostrum in ipairs(exposures(demo.frames)) do
    local count = 0
    while rostrum[count + 1] do count = count + 1 end
    print(i, count)
  end
end

return demo:with { frame = function(f)
  local rostrum = exposures(f.number)[tonumber(exposure)]
  local cel = rostrum and rostrum[tonumber(index)]
  return celspan.rostrum { cel, brightness = rostrum and rostrum.brightness or 1 }
end }
