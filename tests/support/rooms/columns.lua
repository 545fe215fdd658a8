--- Lines that are too long, in sources of every language, and fields of headers whose name is alone
--- on a line, because the formatter made room for a comment: it belongs on the line before. An
--- annotation (---@field) has to be one line.
local system = require "tests.support.system"

local columns = {}

local MOST = 100
local FIND = "find %s -type d \\( -name 'build*' -o -name out -o -name '.?*' \\) -prune -o -type f "
  .. "\\( -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.lua' -o -name '*.sh' -o -name '*.py' "
  .. "-o -name run \\) -print | LC_ALL=C sort"

--- Whether a line of a header has only a name and a comment, and the line before it only the type.
local function is_torn(before, line)
  return line:find "^%s+%*?[%a_][%w_]*[^%s(]*;%s+/%*" and before:find "^%s+[%a_][%w_ ,]*[%w_,]$"
end

--- Reports a file by fault(sentence), at most once, with a line for each of its faulty lines.
local function check_file(path, fault)
  local number, long, before = 0, {}, ""
  local is_header = path:find "%.h$"
  for line in io.lines(path) do
    number = number + 1
    local length = utf8.len(line) or #line
    if length > MOST and not line:find "^%s*%-%-%-@" then
      long[#long + 1] = ("%s:%d: %d columns, more than %d"):format(path, number, length, MOST)
    end
    if is_header and is_torn(before, line) then
      long[#long + 1] = ("%s:%d: a name alone: put its comment on the line before"):format(path,
        number)
    end
    before = line
  end
  if #long > 0 then fault("%s", table.concat(long, "\n")) end
end

--- Calls fault(format, ...) for each file with lines that are too long, in the sources of a folder
--- or in one file; returns the number of files.
function columns.check(place, fault)
  local paths = system.lines(FIND:format(system.quote(place)))
  for _, path in ipairs(paths) do check_file(path, fault) end
  return #paths
end

return columns
