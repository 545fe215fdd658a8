-- Accepts what the scripts below tests/golden give now, and shows old against new:
--   lua5.4 tests/golden/accept.lua [part of a name]
-- Run it at the top of the tree after a build; CELSPAN names another celspan.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"

local function accept(case)
  local text = assert(golden.actual(case))
  local before = golden.expected(case)
  if before == text then return false end
  print(("%s  %s"):format(before and "changed" or "new", case))
  print(golden.difference(before or "", text))
  local file = assert(io.open(case .. ".spans", "w"))
  file:write(text)
  file:close()
  return true
end

local count = 0
for _, case in ipairs(golden.cases()) do
  if case:find(arg[1] or "", 1, true) and accept(case) then count = count + 1 end
end
print(count .. " accepted")
