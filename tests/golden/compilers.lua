-- Whether compilers agree: asks the programs of several builds for the digests of every script that
-- ships, at 640 x 360, and compares the answers with those of the first build. What differs goes to
-- standard error.
--
--   lua5.4 tests/golden/compilers.lua BUILD BUILD...
--
-- In frames as small as those of digests.txt many pixels are edges, and few loops run for long.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"

local equal, different, left_out = 0, 0, 0

local function compare(question, expected, build)
  local answer, message = golden.answer(question, build .. "/celspan")
  if answer == expected then
    equal = equal + 1
    return
  end
  different = different + 1
  io.stderr:write(("%s: %s\n%s\n"):format(build, question,
    message or golden.difference(expected, answer)))
end

assert(arg[2], "usage: compilers.lua BUILD BUILD...")
for _, question in ipairs(golden.wide()) do
  if golden.lacks_module(question) then
    left_out = left_out + 1
  else
    local expected = assert(golden.answer(question, arg[1] .. "/celspan"))
    for i = 2, #arg do compare(question, expected, arg[i]) end
  end
end
print(("%d equal, %d different, %d not asked"):format(equal, different, left_out))
os.exit(different == 0 and equal > 0)
