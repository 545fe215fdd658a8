-- Drawings by celspan as other programs draw them: SVG by headless Chromium, librsvg and resvg, and
-- PDF by Poppler.
-- 12 drawings and 6 frames of films, of 512 pixels and of 2048. All but SOON are tagged #full, and
-- at 2048 these alone are drawn unless every case is wanted, because each takes six seconds.
local browsing = require "tests.support.browsing"
local celspan = require "celspan"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

if not (present.type() and present.pictures()
  and present.program("chromium", "node", "rsvg-convert")) then
  return pending "there is no chromium, no node or no librsvg"
end

-- At 2048 pixels, and by Poppler at 512, borders of translucent areas, which have no strokes, can
-- show seams.
local TRANSLUCENT = { chromium = 10, librsvg = 10, resvg = 10, poppler = 10 }
-- There resvg draws the outline of a picture, a mask, in another way than that of an area.
local PICTURE = { resvg = 6 }
-- Each: a file, a frame, and how many codes are allowed at 2048 pixels where it is not 4.
local CASES = {
  { "scripts/drawings/child.svg" }, { "scripts/drawings/head-front.svg" },
  { "scripts/drawings/head-quarter.svg" }, { "scripts/drawings/head-side.svg" },
  { "scripts/drawings/owl.svg" }, { "scripts/strokes.lua", 1 },
  { "scripts/title.lua", 20, PICTURE },
  { "tests/golden/area/abutting.lua", 1 }, { "tests/golden/booleans/nested.lua", 1 },
  { "tests/golden/booleans/operators.lua", 1, TRANSLUCENT },
  { "tests/golden/shapes/primitives.lua", 1 }, { "tests/golden/view/camera.lua", 1, TRANSLUCENT },
  { "scripts/booleans.lua", 12 }, { "scripts/demo.lua", 12 },
  -- 24 pixels of the uppermost row by librsvg.
  { "scripts/lights_and_gels.lua", 12, { librsvg = 13 } },
  { "scripts/pan.lua", 12 }, { "scripts/perspective.lua", 12 },
  -- 96 pixels where lines of the lantern meet, by resvg.
  { "scripts/rack_focus.lua", 12, { resvg = 10 } },
}
local SOON = { ["scripts/drawings/owl.svg"] = true, ["scripts/demo.lua"] = true,
  ["tests/golden/shapes/primitives.lua"] = true, ["scripts/perspective.lua"] = true,
  ["scripts/rack_focus.lua"] = true }
local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 300) >= 300
local RESVG = "out/npm/node_modules/@resvg/resvg-js/index.js"
-- Colours of lines that are thinner than a pixel are in a frame of more pixels alone.
local FINE = 4

local HAS_PDF = present.pdf() and present.program "pdftoppm"

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function done(...)
  local code, _, err = bench:celspan(...)
  assert.equal(0, code, err)
end

--- The arguments that render the frame of a case, before the name of an output.
local function rendering(case)
  return ("render %s --trust --frames %d --progress none -o"):format(case[1], case[2] or 1)
end

--- Writes an output of a case with a number of pixels, or a drawing in its own.
local function write(case, name, w, h)
  done("%s '%s/%s' %s", case[2] and rendering(case) or "convert " .. case[1], bench.folder, name,
    w and ("--size %dx%d"):format(w, h) or "")
end

--- Writes the codes of the frame of a case, without a picture between: one of many pixels takes
--- seconds to read.
local function write_codes(case, name, w, h)
  done("%s - --size %dx%d >'%s/%s'", rendering(case), w, h, bench.folder, name)
end

--- Writes the codes of a picture.
local function unpack_picture(name, w, h)
  local file = ("%s/%s.png"):format(bench.folder, name)
  local picture = celspan.image { file = file, x = 0, y = 0, w = w, h = h }
  local rostrum = celspan.rostrum { celspan.cel { picture } }
  local pixels = assert(celspan.pixels(rostrum, { size = { w, h }, film = { w, h } }))
  bench:write(name, pixels:bytes { depth = 8 })
end

--- The width and the height of a drawing in pixels, where that of its longer side is given.
local function size_of(side)
  local text = bench:read "x.svg"
  local w, h = text:match 'viewBox="0 0 ([%d.]+) ([%d.]+)"'
  local scale = side / math.max(w, h)
  return math.floor(w * scale + 0.5), math.floor(h * scale + 0.5)
end

local function found_in(case, side)
  write(case, "x.svg")
  local w, h = size_of(side)
  write(case, "x.svg", w, h)
  write_codes(case, "frame", w, h)
  write_codes(case, "fine", FINE * w, FINE * h)
  assert.equal(0, (bench:inside "rsvg-convert x.svg -o librsvg.png"))
  unpack_picture("librsvg", w, h)
  if HAS_PDF and side == 512 then
    write(case, "x.pdf", w, h)
    assert.equal(0, (bench:inside "pdftoppm -singlefile -r 72 -png x.pdf poppler"))
    unpack_picture("poppler", w, h)
  end
  local given = ("const CASE = { folder: %q, width: %d, height: %d, fine: %d, resvg: %q };\n")
    :format(bench.folder, w, h, FINE, system.exists(RESVG) and RESVG or "")
  return browsing.see("about:blank", given .. system.read "tests/support/svg_drawn.js", 600), w, h
end

local function it_is_drawn(case, side, tag)
  it(("of %s is its frame in %d pixels, without seams%s"):format(case[1], side, tag), function()
    local found, w, h = found_in(case, side)
    for program, is in pairs(found) do
      local text = ("%s: %.4f, %g codes at %d, %d, in all %d"):format(program, is.share, is.worst,
        is.place[1], is.place[2], is.seams)
      local is_allowed = case[3] and (side == 2048 or program == "poppler")
      assert.is_true(is.flat > w * h // 3, text)
      assert.is_true(is.share >= 0.99, text)
      assert.is_true(is.worst <= (is_allowed and case[3][program] or 4), text)
    end
  end)
end

describe("a drawing", function()
  for _, case in ipairs(CASES) do
    it_is_drawn(case, 512, SOON[case[1]] and "" or " #full")
    if HAS_ALL or SOON[case[1]] then it_is_drawn(case, 2048, " #full") end
  end

  local it_has_resvg = system.exists(RESVG) and it or pending
  it_has_resvg("is also drawn by resvg", function()
    assert.is_table(found_in(CASES[1], 128).resvg)
  end)
end)
