-- Random drawings, rasterised, traced, and drawn again: edges have an error of less than half a
-- source pixel, and areas that abut leave no gap between them, at any size.
--
-- CASE=n runs one random drawing alone; REPORT=1 prints the error of each.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local present = require "tests.support.present"
local traced = require "tests.support.traced"

local REPORT = os.getenv "REPORT"
local COUNT = 30
--- The fewest pixels of alpha that are not 1.
local function leaks(object, w, h, size)
  local image = celspan.pixels(celspan.rostrum { celspan.cel { object, back = { 4, 0, 4, 0 } } },
    { film = { w, h }, size = size })
  for y = 0, image.height - 1 do
    for x = 0, image.width - 1 do
      local _, _, _, alpha = image:get(x, y)
      if alpha ~= 1 then return ("alpha %.17g at %d, %d of %d x %d"):format(alpha, x, y, size[1],
        size[2]) end
    end
  end
end

local function retrace(case, antialias)
  local off, object, w, h, original = traced.retrace(case, antialias)
  if REPORT then print(("case %d: %d x %d, %s, off %.3f"):format(case, w, h, antialias, off)) end
  return off, object, w, h, original
end

local it_traces = present.pictures() and it or pending

describe("a drawing that is traced", function()
  for _, case in cases.of(COUNT) do
    it_traces("keeps its edges within half a pixel and has no gaps, number "
      .. case, function()
      local off, object, w, h = retrace(case, "area")
      assert.is_true(off <= 0.5, ("off by %.3f pixels"):format(off))
      for _, k in ipairs { 0.37, 1, 1 + case % 7 / 4 } do
        assert.is_nil(leaks(object, w, h, { math.ceil(w * k), math.ceil(h * k) }))
      end
    end)

    -- A pixel then has one colour or the other: that determines an edge to half a pixel, and a
    -- corner between two such edges even less.
    it_traces("is near if pixels are whole, number " .. case, function()
      local off, object, w, h = retrace(case, "none")
      assert.is_true(off <= 1.25, ("off by %.3f pixels"):format(off))
      assert.is_nil(leaks(object, w, h, { w, h }))
    end)
  end

  -- Means of all drawings: a few that a seed draws could be the worst of them.
  it_traces("keeps six of seven within half a pixel if pixels are whole, and their pixels #plain",
    function()
      local far, changed = 0, 0
      for case = 1, COUNT do
        local off, object, w, h, original = retrace(case, "none")
        far = far + (off > 0.5 and 1 or 0)
        changed = changed + traced.changed(original, object, w, h)
      end
      assert.is_true(far <= COUNT / 7, ("%d of %d are farther off"):format(far, COUNT))
      assert.is_true(changed <= 2 * COUNT, ("%d pixels of %d drawings changed"):format(changed,
        COUNT))
    end)
end)
