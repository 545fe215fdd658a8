-- A helper for busted: a test that checks nothing fails, and so does a block or a file without
-- tests.
--
-- Otherwise a loop over an empty list, a return before the first assertion and an empty list of
-- tests all look like success. A test that cannot check here reports that with `pending`.
local busted = require "busted"
local assertions = require "luassert"

-- With this, `require "celspan.motion"` gives the built-in module, and not its file in the tree:
-- the lines of errors depend on this.
pcall(require, "celspan")

local checks = 0  -- of the current test
local counts = {} -- the counts of the current file, and of the blocks around this place

-- A tail call, because the level of an error counts frames.
local function counting(call)
  return function(...)
    checks = checks + 1
    return call(...)
  end
end

-- The metatables for assert(...) and for assert.is_true(...): luassert has one for each.
for _, callable in ipairs { assertions, assertions.is_true } do
  local meta = getmetatable(callable)
  meta.__call = counting(meta.__call)
end

busted.subscribe({ "test", "start" }, function(test)
  local run = test.run
  checks = 0
  test.run = function(...)
    run(...)
    if checks == 0 then busted.fail("this test checks nothing", 2) end
  end
  return nil, true
end)

local function enter()
  counts[#counts + 1] = 0
  return nil, true
end

local function leave()
  if table.remove(counts) == 0 then error("there are no tests here", 0) end
  return nil, true
end

local function count()
  counts[#counts] = counts[#counts] + 1
  return nil, true
end

for _, container in ipairs { "file", "describe" } do
  busted.subscribe({ container, "start" }, enter)
  busted.subscribe({ container, "end" }, leave)
end

-- Runs before the subscribers that leave out tests, which are already registered.
busted.subscribe({ "suite", "start" }, function()
  for _, member in ipairs { "describe", "it", "pending" } do
    busted.subscribe({ "register", member }, count, { priority = 1 })
  end
  return nil, true
end)
