--- celspan join STRIP ... -o OUT: joins the strips of a frame.
local program, request = ...
local native = require "celspan.native"

if not request.output then program.usage "-o is missing: give -o and the name of the picture" end
local paths = {}
for _, path in ipairs(request) do
  local numbers = program.has_number(path) and program.check(native.frames(path))
  if numbers and #numbers == 0 then
    program.fail("input", "%s: no file matches this pattern", path)
  end
  for _, number in ipairs(numbers or {}) do
    paths[#paths + 1] = program.check(native.frame_name(path, number))
  end
  if not numbers then paths[#paths + 1] = path end
end
program.join(paths, request.output)
