-- Every script below tests/golden gives the accepted spans, to the last digit, and the scripts that
-- ship give the accepted digests. After an intended change: lua5.4 tests/golden/accept.lua, and
-- read its output.
local golden = require "tests.support.golden"
local present = require "tests.support.present"

describe("the spans of", function()
  for _, case in ipairs(golden.cases()) do
    it(case:match "golden/(.*)", function()
      if not present.type() and case:find "/text/" then pending "the type module was not built" end
      local text = assert(golden.actual(case))
      local accepted = assert(golden.expected(case),
        case .. ".spans is missing: see tests/golden/accept.lua")
      assert.are.equal("", golden.difference(accepted, text))
      assert.are.equal(accepted, text)
    end)
  end
end)

describe("the digests of", function()
  local digests = golden.digests()

  it("every script that ships and every scene here are kept", function()
    local missing = {}
    for i, drawn in ipairs(golden.unasked(digests)) do missing[i] = drawn[1] end
    assert.are.same({}, missing)
  end)

  for _, digest in ipairs(digests) do
    local test = golden.lacks_module(digest[1]) and pending or it
    test(digest[1], function()
      local now, message = golden.answer(digest[1])
      assert.are.equal(digest[2], now, message)
    end)
  end
end)
