--- Lines that are too long, in sources of every language. An annotation (---@field) has to be one
--- line.
local system = require "tests.support.system"

local columns = {}

local MOST = 100
local FIND = "find %s -type d \\( -name 'build*' -o -name out -o -name '.?*' \\) -prune -o -type f "
  .. "\\( -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.lua' -o -name '*.sh' -o -name '*.py' "
  .. "-o -name run \\) -print | LC_ALL=C sort"

--- Calls fault(format, ...) for each line that is too long in the sources of a folder, or in one
--- file; returns the number of lines.
function columns.check(place, fault)
  local count = 0
  for _, path in ipairs(system.lines(FIND:format(system.quote(place)))) do
    local number = 0
    for line in io.lines(path) do
      number = number + 1
      local length = utf8.len(line) or #line
      if length > MOST and not line:find "^%s*%-%-%-@" then
        fault("%s:%d: %d columns, more than %d", path, number, length, MOST)
      end
    end
    count = count + number
  end
  return count
end

return columns
