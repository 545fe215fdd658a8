--- How specs render the film of a workbench, which is film.lua, without its progress.
local assert = require "luassert"

local rendering = {}

--- Returns the exit code, what was printed and what was said. arguments: a format.
function rendering.run(bench, arguments, ...)
  return bench:celspan_inside("render film.lua --progress none " .. arguments, ...)
end

--- The same, which must succeed. Returns what was said.
function rendering.done(bench, arguments, ...)
  local code, _, err = rendering.run(bench, arguments, ...)
  assert.equal(0, code, err)
  return err
end

--- The same, which must fail with an exit code and these words, and leave nothing of its output.
function rendering.refused(bench, exit, words, arguments)
  local code, _, err = rendering.run(bench, arguments)
  assert.equal(exit, code, err)
  assert.truthy(err:find(words, 1, true), err)
  local stem, ending = arguments:match "-o (%w+)[^ ]*(%.%w+)"
  for _, name in ipairs(bench:files()) do
    assert.falsy(name:find(stem, 1, true) and name:find(ending, 1, true), name)
  end
end

return rendering
