--- celspan probe SCRIPT X Y: the colour of one point, by direct evaluation of the scene.
local program, request = ...
local celspan = require "celspan"

local function coordinate(name, text)
  local number = not text:find "%s" and tonumber(text)
  if not number or number - number ~= 0 then
    program.usage("%s: '%s' is not a number of film units", name, text)
  end
  return number
end

local x, y = coordinate("X", request[2]), coordinate("Y", request[3])
local script = program.script()
local frame, number = script:chosen()
local facts = program.part("facts.lua", program, request)
local r, g, b, a = celspan.probe(program.still(script, frame), x, y)
if not r then program.check(nil, ("frame %d: %s"):format(number, g)) end
for name, value in pairs { frame = number, x = x, y = y, r = r, g = g, b = b, a = a } do
  facts:set(name, value)
end
facts:line("%.9g %.9g %.9g %.9g", r, g, b, a)
facts:finish()
