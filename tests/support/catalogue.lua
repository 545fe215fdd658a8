--- The tests of a build folder, as meson lists them.
local system = require "tests.support.system"

local catalogue = {}

--- Meson's description of a build folder: its "tests" or its "targets", as JSON without escapes.
local function introspect(build, what)
  local text, ended_well =
    system.output(("meson introspect --%s %s"):format(what, system.quote(build)))
  assert(ended_well, "meson introspect failed")
  return text
end

--- The file of each target of a build folder, relative to its top, by the target's id.
local function files_of_targets(build)
  local files = {}
  local text = introspect(build, "targets")
  for id, path in text:gmatch '"id": "([^"]*)".-"filename": %["([^"]+)"' do
    files[id] = path:sub(#build + 2)
  end
  return files
end

--- The name of a test here: meson's name, and "unit/planefile" for a test of a subproject.
function catalogue.name(name) return name:find "/" and name or "unit/" .. name end

--- A list of all: name, such as "unit/wide" or "spec/svg"; called, its name for meson; suite, one
--- of its suites; command, which runs it from the top of the tree; targets, which ninja has to
--- build for it. `root` is the top of the tree, `folder` the name of the build folder in it,
--- `options` those of busted.
function catalogue.of(root, folder, options)
  local build = system.output(("cd %s/%s && pwd -P"):format(system.quote(root), folder)):sub(1, -2)
  local list, files = {}, files_of_targets(build)
  local pattern = '"cmd": (%b[]).-"name": "(.-)".-"suite": %["(.-)".-"depends": (%b[])'
  for words, name, suite, depends in introspect(build, "tests"):gmatch(pattern) do
    local command, targets = {}, {}
    for word in words:gmatch '"(.-)"' do
      if word:find "^subprojects/" then word = build .. "/" .. word end
      command[#command + 1] = system.quote(word)
      if word:find "busted%.sh$" then command[#command + 2] = options end
    end
    for id in depends:gmatch '"(.-)"' do targets[#targets + 1] = files[id] end
    list[#list + 1] = { name = catalogue.name(name), called = name, suite = suite:match "[^:]*$",
      command = table.concat(command, " "), targets = targets }
  end
  return list
end

return catalogue
