--- celspan trace IN -o OUT: a drawing as shapes, written as SVG or as a script.
local program, request = ...
local native = require "celspan.native"

local COLOURS_MOST = 64

local output = request.output

--- The value of --colours: a number of colours, or a list of them.
local function colours_of(text)
  local count = text:find "^[+-]?%d+$" and math.tointeger(text)
  local list = program.split(text)
  local length = count or #list
  local is_right = length >= 1 and length <= COLOURS_MOST
  for _, colour in ipairs(count and {} or list) do
    is_right = is_right and program.colour(colour)
  end
  if not is_right then program.refuse "--colours" end
  return count or list
end

if not output then program.usage "-o is missing: give -o art.svg or -o art.lua" end
if not program.has_ending(output, ".svg", ".lua") then
  program.usage("-o: '%s' must end in .svg or .lua", output)
end
local picture = program.pictured(request[1])
program.check(native.trace_write(picture, {
  colours = request.colours and colours_of(request.colours), smooth = tonumber(request.smooth),
  speckle = math.tointeger(request.speckle), lines = request.lines,
}, output))
