-- Nothing that is not initialized decides what is drawn: hosts run their own tests in valgrind.
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

-- A gradient, an array beside single colours, a blur, a picture, a coloured medium, a mode, a key.
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
    celspan.cel { celspan.circle { centre = { 9, 14 }, radius = 4, texture = "#c33" }:blur(3) },
    celspan.cel { celspan.key { celspan.rect { 24, 11, 13, 7, texture = glow }, colour = "#f80",
                                spill = 1 } },
    celspan.cel { celspan.rect { 4, 12, 17, 7, texture = glow }:blend "overlay" } }
end }
]]

--- A film of one frame from the middle of each script.
local MIDDLES = [[
local celspan = require "celspan"
local films = {}
for i, name in ipairs { ... } do films[i] = dofile("scripts/" .. name .. ".lua") end
return celspan.film { size = { 640, 360 }, frames = #films, frame = function(f)
  local film = films[f.number]
  return film:at(film.first + film.frames // 2)
end }
]]

describe("valgrind #plain", function()
  local test = present.program "valgrind" and it or pending
  local bench

  setup(function()
    bench = workbench.new()
    bench:write("film.lua", SCRIPT)
    bench:write("middles.lua", MIDDLES)
  end)
  teardown(function() bench:remove() end)

  --- Renders a script of the bench in valgrind, which says nothing.
  local function is_silent(name, options)
    local text, ended_well = system.output(
      ("{ CELSPAN_PATH='scripts/?.lua' valgrind -q --error-exitcode=9 '%s' render %s/%s "
        .. "--workers 1 --progress none %s >/dev/null; } 2>&1"):format(workbench.binary,
        bench.folder, name, options))
    assert.is_true(ended_well, text)
    assert.are.equal("", text)
  end

  for name, options in pairs {
    ["raw pixels"] = "-o -", ["a picture of 16 bits"] = "-o %s/film.png --depth 16",
    ["rows of floats"] = "-o - --depth float",
  } do
    test("is silent when a film becomes " .. name, function()
      is_silent("film.lua", options:format(bench.folder))
    end)
  end

  -- Where a side is odd, the last register of a row has pixels to spare. No script has a picture:
  -- valgrind does not know all instructions of the module that reads them.
  local options = "--size 47x27 --depth float -o - --trust -- "
  test("is silent when scripts with gradients and gels are drawn", function()
    is_silent("middles.lua", options .. "waving turn gradient lights_and_gels layers")
  end)
  test("is silent when scripts with maps, lenses and strokes are drawn #full", function()
    is_silent("middles.lua", options .. "perspective rack_focus fox kernels strokes")
  end)
end)
