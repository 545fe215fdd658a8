-- Random scenes against headless Chromium, which draws the same as SVG: translucent shapes over
-- each other, with gradients and blurs, with modes, in groups that are faded, isolated or masked.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local drawn = require "tests.support.drawn"
local json = require "celspan.json"
local present = require "tests.support.present"
local svg = require "celspan.svg"
local workbench = require "tests.support.workbench"

-- This share of the pixels is within NEAR codes, and all are within MOST.
local SHARE, NEAR, MOST = 0.999, 2, 4

local bench

--- The codes of an object that fills the frame.
local function codes(object)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local film = celspan.film { size = { drawn.w, drawn.h }, frames = 1, space = "srgb",
                              frame = function() return rostrum end }
  return assert(celspan.pixels(film)):bytes { depth = 8 }
end

--- Writes the files of a scene for tests/support/drawn.js.
local function write(number)
  local scene = drawn.scene(number)
  local path = bench:write(number .. ".svg", scene.svg)
  bench:write(number .. ".film", codes(scene.object))
  if not scene.is_blurred then
    bench:write(number .. ".read", codes(assert(svg.read(path)).object))
  end
  bench:write(number .. ".edges", codes(scene.edges))
end

--- What drawn.js found in the scenes of the list, `count` in all.
local function compared(count)
  local code, out, err = bench:shell(("CELSPAN_DRAWN='%s' CELSPAN_BROWSER_SECONDS=%d "
    .. "node tests/support/browser.js '%s/chromium' about:blank tests/support/drawn.js")
    :format(bench.folder, 60 + 2 * count, bench.folder))
  assert.are.equal(0, code, err)
  return json.decode(out)
end

--- Of all scenes with a picture and a canvas of these names: how many pixels were compared, the
--- share within NEAR, and the worst with its scene and place.
local function summary(scenes, name)
  local all, near, worst = 0, 0, { off = -1 }
  for _, scene in ipairs(scenes) do
    local one = scene.found[name] or { counts = {} }
    for i, count in ipairs(one.counts) do
      all, near = all + count, near + (i - 1 <= NEAR and count or 0)
      if count > 0 and i - 1 > worst.off then
        worst = { off = i - 1, where = ("scene %s at %d, %d"):format(scene.number, one.place[1],
          one.place[2]) }
      end
    end
  end
  return all, near / all, worst
end

describe("a browser #plain", function()
  if not (present.type() and present.program("chromium", "node")) then
    return pending "there is no chromium or no node"
  end

  local scenes

  setup(function()
    bench = workbench.new()
    local list = {}
    for _, number in cases.of(40) do
      write(number)
      list[#list + 1] = number
    end
    bench:write("list", table.concat(list, " "))
    scenes = compared(#list)
  end)

  teardown(function() bench:remove() end)

  local function agrees(name, share, most)
    local all, near, worst = summary(scenes, name)
    print(("# %s: %d pixels, %.4f %% within %d codes, the worst off by %d: %s"):format(name, all,
      100 * near, NEAR, worst.off, worst.where))
    assert.is_true(all > 190000)
    assert.is_true(near >= share and worst.off <= most, worst.where)
  end

  it("shows the same as a film where no edge is", function()
    agrees("film float16", SHARE, MOST)
  end)

  it("shows the same as a drawing that celspan reads", function()
    agrees("read float16", SHARE, MOST)
  end)

  -- Modes that divide, such as color-dodge, enlarge what the browser rounds.
  it("shows nearly the same where it rounds every group to 8 bits", function()
    agrees("film unorm8", 0.99, 32)
  end)
end)
