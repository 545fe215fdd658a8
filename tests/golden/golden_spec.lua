-- Every script below tests/golden gives the spans that were accepted, to the last digit.
-- After a change that is meant: lua5.4 tests/golden/accept.lua, and read what it prints.
local golden = require "tests.support.golden"

local lacks_art = golden.lacks_art()

describe("the spans of", function()
  for _, case in ipairs(golden.cases()) do
    it(case:match "golden/(.*)", function()
      if lacks_art and case:find "/text/" then pending "the art module was not built" end
      local text = assert(golden.actual(case))
      local accepted = assert(golden.expected(case), case .. ".spans is missing: see tests/golden/accept.lua")
      assert.are.equal("", golden.difference(accepted, text))
      assert.are.equal(accepted, text)
    end)
  end
end)
