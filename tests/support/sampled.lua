-- A helper for busted: of the tests of a file it runs one in CELSPAN_TESTS, drawn by CELSPAN_SEED.
--
-- Builds with sanitizers take some files so, whose tests do little but start the program many times:
-- what a plain build has run whole. Which tests are run is told by the seed and by nothing else.
local busted = require "busted"
local prng = require "tests.support.prng"

local ONE_IN = tonumber(os.getenv "CELSPAN_TESTS") or 1
local random = prng.new(tonumber(os.getenv "CELSPAN_SEED") or 1)
local left_out = 0

-- Before busted's own subscriber: false keeps what is registered from that.
busted.subscribe({ "register", "it" }, function()
  if random:once(ONE_IN) then return nil, true end
  left_out = left_out + 1
  return nil, false
end, { priority = 1 })

-- A comment of TAP.
busted.subscribe({ "suite", "end" }, function()
  print(("# left out by CELSPAN_SEED: %d"):format(left_out))
  return nil, true
end)
