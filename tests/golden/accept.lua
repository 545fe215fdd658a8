-- Accepts the current output of the scripts below tests/golden and of those that ship, and shows
-- old against new:
--   lua5.4 tests/golden/accept.lua [part of a name]
-- Run it at the top of the tree after a build; CELSPAN names another celspan. A new script gets its
-- spans, or a question of its own in digests.txt.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"

local count, part = 0, arg[1] or ""

--- Shows what is new, and counts it.
local function show(name, before, text)
  if before == text then return end
  print(("%s  %s"):format(before and "changed" or "new", name))
  print(golden.difference(before or "", text))
  count = count + 1
end

local function write(path, text)
  local file = assert(io.open(path, "w"))
  file:write(text)
  file:close()
end

for _, case in ipairs(golden.cases()) do
  if case:find(part, 1, true) then
    local text = assert(golden.actual(case))
    show(case .. ".spans", golden.expected(case), text)
    write(case .. ".spans", text)
  end
end

local digests = golden.digests()
for _, drawn in ipairs(golden.unasked(digests)) do digests[#digests + 1] = { drawn[2]() } end
local blocks = {}
for i, digest in ipairs(digests) do
  local question, before = table.unpack(digest)
  if not before or question:find(part, 1, true) then
    local now = assert(golden.answer(question))
    show(question, before, now)
    digest[2] = now
  end
  blocks[i] = question .. "\n" .. digest[2]
end
write(golden.digests_path, table.concat(blocks, "\n"))
print(count .. " accepted")
