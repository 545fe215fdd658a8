-- Asks the questions of tests/golden of the program that CELSPAN names, and prints a row of the
-- table in docs/trust.md; what differs goes to standard error.
--
--   lua5.4 tests/portable/digests.lua NAME [EVERY]     EVERY: 10 asks every tenth question
--
-- In emulation no process can be confined, so scripts and pictures are trusted everywhere.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"

local name, every = arg[1], tonumber(arg[2] or 1)
local equal, different, left_out = 0, 0, 0

local function compare(question, expected, answer, message)
  if answer == expected then
    equal = equal + 1
    return
  end
  different = different + 1
  io.stderr:write(("%s: %s\n%s\n"):format(name, question,
    message or golden.difference(expected, answer)))
end

local function trusting(question)
  if not question:find "^render" then return question end
  return question:gsub(" %-%-allow %S+", "") .. " --trust"
end

for i, digest in ipairs(golden.digests()) do
  local question, expected = table.unpack(digest)
  if golden.lacks_module(question) then
    left_out = left_out + 1
  elseif i % every == 0 then
    compare(question, expected, golden.answer(trusting(question)))
  end
end
for i, case in ipairs(golden.cases()) do
  if golden.lacks_module("render " .. case .. ".lua") then
    left_out = left_out + 1
  elseif i % every == 0 then
    compare(case, assert(golden.expected(case)), golden.actual(case, "--trust"))
  end
end
print(("| %s | %d | %d | %d |"):format(name, equal, different, left_out))
os.exit(different == 0)
