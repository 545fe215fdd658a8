-- The printers for gdb: a developer sees the spans and edges of a row and the layers of a composer,
-- not pointers.
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local PROGRAM = workbench.build .. "/tests/debugged"

--- What gdb prints of an expression; nil where gdb or the program is missing.
local function printed(expression)
  if not system.exists(PROGRAM) or not select(2, system.output "gdb --version 2>&1") then
    return nil
  end
  return (system.output(("gdb -batch -nx -x tests/support/gdb.py -ex 'print %s' '%s' 2>&1")
    :format(expression, PROGRAM)))
end

describe("in gdb #plain", function()
  it("a row is a list of spans", function()
    local text = printed "row"
    if not text then return pending "gdb is missing" end
    assert.are.equal("$1 = 3 spans = {[0] = [0, 3) single (0.5 0 0 1), "
      .. "[1] = [3, 7) gradient (0 0.5 0 1) + (0 0.125 0 0) * (x - 3), "
      .. "[2] = [7, 9) array from (0.25 0.5 0.75 1) on}\n", text)
  end)

  it("the edges of a row have their places, their shares and the cells on their right", function()
    local text = printed "area"
    if not text then return pending "gdb is missing" end
    assert.are.equal("$1 = 2 edges = {[0] = layer 0 at 2.75 to 2.5: 0.375 of [2, 3), "
      .. "then (0.5 0 0 1), [1] = layer 4 at 9 to 9.5: 0.75 of [9, 10), then a program}\n", text)
  end)

  it("a composer has the numbers of the layers that are present", function()
    local text = printed "$layers(composer)"
    if not text then return pending "gdb is missing" end
    assert.are.equal('$1 = "4 of 70 layers: 1 4 63 64"\n', text)
  end)
end)
