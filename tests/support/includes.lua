-- Checks that includes go only down the list of folders, are never circular, and reach the core
-- from the other houses through its door alone.
--
--   lua5.4 tests/support/includes.lua [ROOT]
--
-- The list is the one in src/meson.build, followed by the folders that are built separately (see
-- rooms/tree.lua). A public header, celspan/..., includes other public headers alone.

package.path = "./?.lua;" .. package.path
local tree = require "tests.support.rooms.tree"

local root = arg[1] or "."

local function read(path)
  local file = assert(io.open(path, "r"))
  local text = file:read("a")
  file:close()
  return text
end

local function source_files()
  local paths = {}
  local find =
    assert(io.popen("cd '" .. root .. "/src' && find . -name '*.[ch]' -o -name '*.cpp' | sort"))
  for line in find:lines() do
    paths[#paths + 1] = line:sub(3)
  end
  find:close()
  return paths
end

local function includes_of(path)
  local found, number = {}, 0
  for line in (read(root .. "/src/" .. path) .. "\n"):gmatch("(.-)\n") do
    number = number + 1
    local name = line:match('^%s*#%s*include%s*"([^"]+)"')
    if name then
      found[#found + 1] = { name = name, line = number }
    end
  end
  return found
end

local faults = {}
local function fault(format, ...)
  faults[#faults + 1] = string.format(format, ...)
end

local ranks = tree.folder_ranks(root)
local paths = source_files()
local known, edges = {}, {}
for _, path in ipairs(paths) do
  known[tree.name(path)] = path
end

-- A generated header is named in its folder's meson.build.
local function is_generated(name)
  local folder, file = name:match("^([%w_/]+)/([%w_]+%.h)$")
  for _, house in ipairs { "core", "kit", "desk" } do
    local path = ("%s/src/%s/%s"):format(root, house, folder)
    local build = folder and io.open(path .. "/meson.build")
    local text = build and build:read "a" or ""
    if build then
      build:close()
    end
    if text:find("'" .. file .. "'", 1, true) then
      return path:sub(#root + 6) .. "/" .. file
    end
  end
end

local function check_include(path, include)
  local place = ("src/%s:%d"):format(path, include.line)
  local target = known[include.name] or is_generated(include.name)
  local from, to = tree.listed(ranks, path), target and tree.listed(ranks, target)
  if not target then
    fault('%s: "%s" is no file of src/ (write it as "folder/file.h")', place, include.name)
  elseif tree.is_public(path) and not tree.is_public(target) then
    fault('%s: the public header includes "%s", which is not public', place, include.name)
  elseif not from or not to then
    fault("%s: the folder of %s is not in the list", place, from and include.name or path)
  elseif ranks[to] > ranks[from] then
    fault('%s: "%s" comes after %s in the list of folders', place, include.name, from)
  elseif to:find "^core/" and to ~= tree.DOOR and not tree.is_public(target)
    and not from:find "^core/" then
    fault('%s: "%s" is behind the door of the core, %s', place, include.name, tree.DOOR)
  end
end

local checks = 0
for _, path in ipairs(paths) do
  local name = tree.name(path)
  edges[name] = {}
  for _, include in ipairs(includes_of(path)) do
    checks = checks + 1
    check_include(path, include)
    table.insert(edges[name], include.name)
  end
end

local DONE, OPEN = 2, 1
local state = {}
local function visit(name, trail)
  if state[name] == DONE or not edges[name] then
    return
  end
  trail[#trail + 1] = name
  if state[name] == OPEN then
    fault("includes go in a circle: %s", table.concat(trail, " -> "))
  else
    state[name] = OPEN
    for _, next_name in ipairs(edges[name]) do
      visit(next_name, trail)
    end
    state[name] = DONE
  end
  trail[#trail] = nil
end
for _, path in ipairs(paths) do
  visit(tree.name(path), {})
end

for _, sentence in ipairs(faults) do
  io.stderr:write(sentence, "\n")
end
if #faults > 0 then
  print(("%d of %d checks failed"):format(#faults, checks))
  os.exit(1)
end
print(("%d checks passed"):format(checks))
