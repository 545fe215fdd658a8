-- The formatter and the checker of a language report nothing. From the top of the tree:
--
--   lua5.4 tests/support/format.lua c|lua [FILE...]      all files of the tree, or these
--
-- clang-format for C and C++, luacheck for Lua. Without the program the check is skipped.
package.path = "./?.lua;" .. package.path
local system = require "tests.support.system"

local KINDS = {
  c = { program = "clang-format", options = "--dry-run -Werror",
    endings = { c = true, h = true, cpp = true, hpp = true } },
  lua = { program = "luacheck", options = "-q --no-color", endings = { lua = true } },
}
local ALL = "find src lua scripts tests examples docs subprojects -type f"

local PRINTED = "^tests/face/%d" -- files that tests/face/main.lua prints in its own form

local kind = KINDS[arg[1]]
local paths = {}
for _, path in ipairs(arg[2] and { table.unpack(arg, 2) } or system.lines(ALL)) do
  if kind.endings[path:match "%.(%w+)$"] and not path:find(PRINTED) then
    paths[#paths + 1] = system.quote(path)
  end
end
if not os.execute(("command -v %s >/dev/null"):format(kind.program)) then
  print(("skipped: %s is not installed\n1 checks skipped"):format(kind.program))
elseif #paths == 0 or os.execute(("%s %s %s"):format(kind.program, kind.options,
    table.concat(paths, " "))) then
  print(("%d checks passed"):format(#paths))
else
  print(("1 of %d checks failed"):format(#paths))
  os.exit(1)
end
