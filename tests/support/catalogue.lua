--- The tests of a build folder: unit tests and examples, as meson lists them, and the specs, one
--- test for each file.
local system = require "tests.support.system"

local catalogue = {}

--- Meson's description of a build folder: its "tests" or its "targets", as JSON without escapes.
local function introspect(build, what)
  local text, ended_well =
    system.output(("meson introspect --%s %s"):format(what, system.quote(build)))
  assert(ended_well, "meson introspect failed")
  return text
end

--- The paths of a build folder relative to its top, as targets of ninja.
local function target_of(build, path)
  return path:sub(1, #build + 1) == build .. "/" and path:sub(#build + 2) or nil
end

local function programs(build)
  local list = {}
  for words, name in introspect(build, "tests"):gmatch '"cmd": (%b[]).-"name": "(.-)"' do
    local command, targets = {}, {}
    for word in words:gmatch '"(.-)"' do
      if word:find "^subprojects/" then word = build .. "/" .. word end
      targets[#targets + 1] = #targets == 0 and target_of(build, word) or nil
      command[#command + 1] = system.quote(word)
    end
    name = name:gsub("^example ", "example/"):gsub("[ ,]", "")
    list[#list + 1] = {
      name = name:find "/" and name or "unit/" .. name,
      command = table.concat(command, " "),
      targets = targets,
    }
  end
  return list
end

--- The programs and modules that are built by default: every spec needs them.
local function defaults(build)
  local targets = {}
  local pattern = '"filename": %["([^"]+)"%], "build_by_default": true'
  for path in introspect(build, "targets"):gmatch(pattern) do
    local file = assert(target_of(build, path), path)
    if not file:find "%.a$" and not file:find "fuzz_" and not file:find "^subprojects/" then
      targets[#targets + 1] = file
    end
  end
  return targets
end

--- A list of all: name, such as "unit/wide" or "spec/svg"; command, which runs it from the top of
--- the tree; targets, which ninja has to build for it. `root` is the top of the tree, `folder` the
--- name of the build folder in it, `options` those of busted.
function catalogue.of(root, folder, options)
  local build = system.output(("cd %s/%s && pwd -P"):format(system.quote(root), folder)):sub(1, -2)
  local list, targets = programs(build), defaults(build)
  local find = ("cd %s && ls tests/*/*_spec.lua"):format(system.quote(root))
  for _, path in ipairs(system.lines(find)) do
    list[#list + 1] = {
      name = path:match "tests/(.*)_spec%.lua$",
      command = ("tests/support/busted.sh %s %s %s"):format(folder, options or "", path),
      targets = targets,
    }
  end
  return list
end

return catalogue
