-- Nothing that is not initialized decides what is drawn: hosts run their own tests in valgrind.
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

-- A gradient, an array beside single colours, a blur, a picture and a coloured medium.
local SCRIPT = [[
local celspan = require "celspan"
local glow = celspan.radial { centre = { 20, 12 }, radius = 14, { 0, "#fff" }, { 1, "#f800" } }
local photo = celspan.image { x = 3, y = 2, w = 9, h = 7, size = { 2, 2 },
  pixels = ("\200\100\50\180"):rep(4) }
local gel = celspan.paint { pigment = "#102030", medium = { 1, 0.6, 0.3 }, beta = 0.2 }
return celspan.film { size = { 39, 21 }, frame = function()
  return celspan.rostrum { back = "#fffbe0", camera = { width = 38, rotate = 3 },
    celspan.cel { celspan.circle { centre = { 20, 12 }, radius = 9, texture = glow }, photo },
    celspan.cel { celspan.rect { 25, 3, 9, 9, texture = gel }:rotate(20) },
    celspan.cel { celspan.circle { centre = { 9, 14 }, radius = 4, texture = "#c33" }:blur(3) } }
end }
]]

describe("valgrind #plain", function()
  local test = present.program "valgrind" and it or pending
  local bench, script

  setup(function()
    bench = workbench.new()
    script = bench:write("film.lua", SCRIPT)
  end)
  teardown(function() bench:remove() end)

  for name, options in pairs {
    ["raw pixels"] = "-o -", ["a picture of 16 bits"] = "-o %s/film.png --depth 16",
    ["rows of floats"] = "-o - --depth float",
  } do
    test("is silent when a film becomes " .. name, function()
      local text, ended_well = system.output(
        ("{ valgrind -q --error-exitcode=9 '%s' render %s --workers 1 --progress none %s "
          .. ">/dev/null; } 2>&1"):format(workbench.binary, script, options:format(bench.folder)))
      assert.is_true(ended_well, text)
      assert.are.equal("", text)
    end)
  end
end)
