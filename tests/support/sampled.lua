-- A helper for busted: runs one in CELSPAN_TESTS tests of a file, selected by CELSPAN_SEED.
--
-- Builds with sanitizers use it for some files whose tests do little but start the program many
-- times, and which a plain build has run completely. The selection depends on the seed and on
-- nothing else. Tests that are tagged #always are run whatever the seed is: they alone try what a
-- sanitizer is needed for.
local busted = require "busted"
require "tests.support.checked"
local prng = require "tests.support.prng"

local ONE_IN = tonumber(os.getenv "CELSPAN_TESTS") or 1
local random = prng.new(tonumber(os.getenv "CELSPAN_SEED") or 1)
local left_out = 0

-- Called before busted's own subscriber: if it returns false, the test is hidden from that one.
busted.subscribe({ "register", "it" }, function(name)
  if random:once(ONE_IN) or name:find("#always", 1, true) then return nil, true end
  left_out = left_out + 1
  return nil, false
end, { priority = 1 })

-- A comment of TAP.
busted.subscribe({ "suite", "end" }, function()
  print(("# left out by CELSPAN_SEED: %d"):format(left_out))
  return nil, true
end)
