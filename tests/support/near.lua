--- Which tests cover a file of the tree best: see tests/mutate/nearest.lua.
local nearest = require "tests.mutate.nearest"
local system = require "tests.support.system"

local near = {}

--- The name under which nearest.lua lists a path, or nil. A file of src/ is listed under the
--- innermost of its folders that has an entry; any other path under itself or under a folder above
--- it.
function near.key(path)
  local rest = path
  while rest do
    local key = path:find "^src/" and rest:match "[^/]*$" or rest
    if nearest[key] then return key end
    rest = rest:match "^(.*)/[^/]*$"
  end
end

--- The unit tests that are only linked with a folder of src/ and the folders below it.
function near.units(root)
  local units = {}
  local listed = system.output(("cat '%s'/tests/*/meson.build"):format(root))
  for name, folder in listed:gmatch "%['([%w_]+)', '([%w_/]+)'%]" do
    units["unit/" .. name] = folder:match "[^/]*$"
  end
  return units
end

--- The test whose source is a file of tests/, or nil.
function near.test_of(path)
  local unit = path:match "^tests/%a+/unit/test_([%w_]+)%.c$"
  local script, corpus = path:match "^tests/fuzz/fuzz_([%w_]+)%.c$",
    path:match "^tests/fuzz/corpus/([%w_-]+)"
  return unit and "unit/" .. unit or path:match "^tests/.-([%w_]+/[%w_]+)_spec%.lua$"
    or script and "unit/fuzz-" .. script or corpus and "unit/fuzz-" .. corpus
end

--- The tests whose source names a helper, such as tests/support/picture.h.
local function users_of(path)
  local name = path:gsub("%.lua$", ""):gsub("/", path:find "%.lua$" and "." or "/")
  local users = {}
  local grep = "grep -rlF --include='*.[ch]' --include='*_spec.lua' %s tests"
  for _, user in ipairs(system.lines(grep:format(system.quote(name)))) do
    users[#users + 1] = near.test_of(user)
  end
  return users
end

--- The names of the tests near a path, relative to the top of the tree, the nearest first. `units`
--- is the result of near.units.
function near.tests(path, units)
  local test, key = near.test_of(path), near.key(path)
  if test then return { test } end
  local list = {}
  for name, folder in pairs(units) do
    if folder == key then list[#list + 1] = name end
  end
  table.sort(list)
  for _, name in ipairs(nearest[key] or path:find "^tests/" and users_of(path) or {}) do
    list[#list + 1] = name
  end
  return list
end

return near
