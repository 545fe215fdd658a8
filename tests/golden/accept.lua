-- Accepts what the scripts below tests/golden give now, and shows old against new:
--   lua5.4 tests/golden/accept.lua [part of a name]
-- Run it at the top of the tree after a build; CELSPAN names another celspan.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"

--- Writes what is new into the file at `path`, and shows it; whether there was something.
local function accept(path, before, text)
  if before == text then return 0 end
  print(("%s  %s"):format(before and "changed" or "new", path))
  print(golden.difference(before or "", text))
  local file = assert(io.open(path, "w"))
  file:write(text)
  file:close()
  return 1
end

local count, part = 0, arg[1] or ""
for _, case in ipairs(golden.cases()) do
  if case:find(part, 1, true) then
    count = count + accept(case .. ".spans", golden.expected(case), assert(golden.actual(case)))
  end
end
for _, path in ipairs(golden.films()) do
  if path:find(part, 1, true) then
    local before, now, message = golden.digests(path)
    count = count + accept(path, before, assert(now, message))
  end
end
print(count .. " accepted")
