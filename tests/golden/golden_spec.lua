-- Every script below tests/golden gives the spans that were accepted, to the last digit.
-- Frames of films that ship have the digests that were accepted.
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

-- Built without the libraries for type and XML, there are no drawings and paintings; without
-- OpenImageIO, no pictures.
local command = os.getenv "CELSPAN" or "build/celspan"
local pipe = assert(io.popen(command .. " check scripts/title.lua 2>&1; true"))
local has_art = not pipe:read "a":find("celspan-art.so", 1, true)
pipe:close()

describe("the digests of", function()
  for _, path in ipairs(golden.films()) do
    local test = has_art and it or pending
    test(path:match "golden/(.*)", function()
      local accepted, now, message = golden.digests(path)
      assert.are.equal(accepted, now, message)
    end)
  end
end)
