-- SVG drawings of what can be seen: their areas, what other programs draw, and what is refused.
local celspan = require "celspan"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local PYTHON = "/usr/bin/python3"
local it_measures = os.execute(PYTHON .. " -c 'import shapely' 2>/dev/null") and it or pending
local it_draws = present.program "rsvg-convert" and present.pictures() and it or pending

-- Shapes that abut and overlap, holes, curves, thin lines, both gradients; some beyond the frame.
local SHAPES = [[
local celspan = require "celspan"
local sky = celspan.linear { from = { 0, 0 }, to = { 30, 90 },
  { 0, "#204060" }, { 1, "#f0d0a0" } }
local sun = celspan.radial { centre = { 120, 30 }, radius = 25, focus = { 112, 24 },
  { 0, "#fff4d0" }, { 0.6, "#ffb040" }, { 1, "#c04020" } }
local disc = celspan.circle { centre = { 50, 50 }, radius = 30 }
local bar = celspan.rect { 45, 5, 10, 80 }
return celspan.film { size = { 160, 90 }, frames = 2, space = SPACE, frame = function(f)
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.rect { -20, 0, 200, 60, texture = sky },
    celspan.circle { centre = { 120, 30 }, radius = 25, texture = sun },
    (disc - bar):paint("#f26419"),
    celspan.circle { centre = { 0, 80 }, radius = 22 + f.number, texture = "#33658ac0" },
    celspan.polygon { { 80, 90 }, { 110, 60 }, { 140, 90 }, texture = "#55dde0" },
    celspan.polygon { { 110, 60 }, { 140, 90 }, { 170, 60 }, texture = "#2f4858" },
    celspan.circle { centre = { 78, 70 }, radius = 12 }
      :stroke { width = 2, texture = "#101010" } } }
end }
]]

local bench

before_each(function()
  bench = workbench.new()
  bench:write("light.lua", (SHAPES:gsub("SPACE", '"linear"')))
  bench:write("codes.lua", (SHAPES:gsub("SPACE", '"srgb"')))
end)
after_each(function() bench:remove() end)

local function done(arguments, ...)
  local code, _, err = bench:celspan_inside(arguments, ...)
  assert.equal(0, code, err)
  return err
end

local function refused(exit, message, arguments)
  local code, _, err = bench:celspan_inside(arguments)
  assert.equal(exit, code, err)
  assert.matches(message, err, 1, true)
end

local function pixels(name, w, h)
  local picture = celspan.image { file = bench.folder .. "/" .. name, x = 0, y = 0, w = w, h = h }
  local rostrum = celspan.rostrum { celspan.cel { picture } }
  return assert(celspan.pixels(rostrum, { size = { w, h }, film = { w, h } })):bytes { depth = 8 }
end

--- For each channel of each pixel, the least and the greatest code within a number of pixels.
local function ranges(bytes, w, h, radius)
  local function pass(list, least, count, stride, step)
    local out, better = {}, least and math.min or math.max
    for i = 0, #list - 1 do
      local at, best = (i // stride) % count, list[i + 1]
      for k = -radius, radius do
        if at + k >= 0 and at + k < count then best = better(best, list[i + 1 + k * step]) end
      end
      out[i + 1] = best
    end
    return out
  end
  local codes = {}
  for i = 1, #bytes do codes[i] = bytes:byte(i) end
  local low = pass(pass(codes, true, w, 4, 4), true, h, 4 * w, 4 * w)
  return low, pass(pass(codes, false, w, 4, 4), false, h, 4 * w, 4 * w)
end

--- Compares a picture that another program has drawn with the frame: the share of the pixels away
--- from edges that are within 3 codes; how far a pixel is beyond the codes around it.
local function compare(frame, drawn, w, h)
  local ours, theirs = pixels(frame, w, h), pixels(drawn, w, h)
  local near_low, near_high = ranges(ours, w, h, 1)
  local low, high = ranges(ours, w, h, 2)
  local flat, same, beyond = 0, 0, 0
  for i = 1, #ours, 4 do
    local is_flat, off = true, 0
    for c = i, i + 3 do
      local code = theirs:byte(c)
      is_flat = is_flat and near_high[c] - near_low[c] <= 3
      off = math.max(off, math.abs(code - ours:byte(c)))
      beyond = math.max(beyond, low[c] - code, code - high[c])
    end
    flat, same = flat + (is_flat and 1 or 0), same + (is_flat and off <= 3 and 1 or 0)
  end
  assert.is_true(flat > w * h // 3)
  return same / flat, beyond
end

describe("a drawing", function()
  --- How many areas x.svg has, what each two have in common, and what they leave out.
  local function measured()
    local command = ("%s tests/support/areas.py %s/x.svg"):format(PYTHON, bench.folder)
    local out = io.popen(command):read "a"
    local count, overlap, gap = out:match "(%S+) (%S+) (%S+)"
    return tonumber(count), tonumber(overlap), tonumber(gap)
  end

  it_measures("of regions has areas that do not overlap and leave nothing out", function()
    done "render light.lua -o x.svg --flat regions --precision 6 --frames 1"
    local count, overlap, gap = measured()
    assert.is_true(count >= 8 and overlap <= 1e-6 and math.abs(gap) <= 1e-6)
  end)

  it_measures("of regions has areas that meet at one point where flat borders end", function()
    done("render '%s/scripts/demo.lua' -o x.svg --flat regions --precision 6 --frames 12",
      os.getenv "PWD")
    local count, overlap = measured()
    assert.is_true(count >= 60 and overlap <= 1e-6)
  end)

  it_measures("of regions has no slivers where outlines have a part in common", function()
    bench:write("cut.lua", [[
local celspan = require "celspan"
local function disc(radius) return celspan.circle { centre = { 50, 50 }, radius = radius } end
return celspan.film { size = { 100, 100 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { disc(40):paint("#f26419"),
    celspan.clip(celspan.rect { 0, 60, 100, 40, texture = "#33658a" }, disc(40)),
    celspan.clip(celspan.rect { 60, 0, 40, 100, texture = "#55dde0" }, disc(40)) } } end }]])
    done "render cut.lua -o x.svg --flat regions --precision 6"
    local count, overlap = measured()
    assert.is_true(count == 3 and overlap <= 1e-6)
    -- The first disc ends where the others begin: no part of its outline is right or below of them.
    local first = bench:read("x.svg"):match 'fill="#f26419" d="([^"]*)"'
    assert.equal(1, select(2, first:gsub("z", "")))
    assert.is_true(#first < 800, first)
  end)

  it("of regions has nothing under its areas, and no clipping", function()
    done "render light.lua -o x.svg --flat regions --frames 1"
    local text = bench:read "x.svg"
    assert.is_nil(text:find("stroke", 1, true))
    assert.is_nil(text:find("clip", 1, true))
    assert.is_nil(text:find("<image", 1, true))
    assert.matches("<linearGradient", text, 1, true)
    assert.matches("<radialGradient", text, 1, true)
  end)

  it("has as many digits as are asked for", function()
    done "render light.lua -o x.svg --flat regions --precision 0 --frames 1"
    for path in bench:read("x.svg"):gmatch ' d="(.-)"' do assert.is_nil(path:find(".", 1, true)) end
  end)

  for _, name in ipairs { "codes", "light" } do
    it_draws("in " .. name .. " looks as the frame in librsvg, and shows no seams", function()
      for _, scale in ipairs { 2, 3 } do
        local size = ("%dx%d"):format(160 * scale, 90 * scale)
        done(("render %s.lua -o frame.png --frames 1 --size %s"):format(name, size))
        done(("render %s.lua -o x.svg --frames 1 --size %s"):format(name, size))
        assert.equal(0, (bench:inside "rsvg-convert x.svg -o drawn.png"))
        local share, beyond = compare("frame.png", "drawn.png", 160 * scale, 90 * scale)
        assert.is_true(share >= 0.99, ("%.4f"):format(share))
        -- A pointed tip has no pixel of its own; and light is mixed in another way at edges.
        assert.is_true(beyond <= (name == "codes" and 8 or 60), tostring(beyond))
      end
    end)
  end

  it_draws("of areas alone does show seams, which the strokes under them cover", function()
    done "render codes.lua -o frame.png --frames 1 --size 320x180"
    done "render codes.lua -o x.svg --frames 1 --size 320x180 --flat regions"
    assert.equal(0, (bench:inside "rsvg-convert x.svg -o drawn.png"))
    local _, beyond = compare("frame.png", "drawn.png", 320, 180)
    assert.is_true(beyond > 20, tostring(beyond))
  end)

  it("of a plane is that of its frame", function()
    done "render light.lua -o film.plane"
    done("convert film.plane plane.svg --frame 2")
    done "render light.lua -o frame.svg --frames 2"
    assert.equal(bench:read "frame.svg", bench:read "plane.svg")
  end)

  it_draws("is clear where nothing is, and keeps alpha", function()
    bench:write("clear.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 1, space = "srgb", frame = function()
  return celspan.rostrum { celspan.cel {
    celspan.rect { 10, 10, 20, 20, texture = "#204060" },
    celspan.rect { 30, 10, 20, 20, texture = "#f2641980" } } } end }]])
    done "render clear.lua -o x.svg"
    assert.equal(0, (bench:inside "rsvg-convert x.svg -o drawn.png"))
    local drawn = pixels("drawn.png", 60, 40)
    local function code(x, y) return { drawn:byte(4 * (60 * y + x) + 1, 4 * (60 * y + x) + 4) } end
    assert.same({ 0, 0, 0, 0 }, code(5, 5))
    assert.same({ 0x20, 0x40, 0x60, 255 }, code(20, 20))
    assert.equal(0x80, code(40, 20)[4])
  end)

  it("becomes a picture where SVG has no vectors, and says so", function()
    bench:write("mixed.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.circle { centre = { 15, 20 }, radius = 10, texture = "#f26419" } },
    celspan.cel { celspan.circle { centre = { 40, 20 }, radius = 10 }, defocus = 3 } } end }]])
    local err = done "render mixed.lua -o x.svg --scale 3"
    assert.matches("what SVG has no vectors for is a picture of", err, 1, true)
    local text = bench:read "x.svg"
    assert.matches('href="data:image/png;base64,iVBOR', text, 1, true)
    assert.matches('fill="#f26419"', text, 1, true)
    bench:write("all.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { celspan.scanline { bounds = { 0, 0, 60, 40 },
    spans = function() return { { 0, 60, "#f26419" } } end } } } end }]])
    err = done "render all.lua -o y.svg"
    assert.matches("is a picture of 120 x 80 pixels, because", err, 1, true)
    assert.matches("<image", bench:read "y.svg", 1, true)
  end)

  it("has a picture for each part that is apart", function()
    bench:write("spots.lua", [[
local celspan = require "celspan"
local function spot(x, y)
  return celspan.cel { celspan.circle { centre = { x, y }, radius = 4 }, defocus = 1 }
end
return celspan.film { size = { 300, 200 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#fff", spot(20, 20), spot(270, 180), spot(280, 175) } end }]])
    assert.matches("is 2 pictures, the largest of 4[0-9] x 3[0-9] pixels, beside",
      done "render spots.lua -o x.svg")
    local places = {}
    for x, y in bench:read("x.svg"):gmatch '<image x="(%d+)%.?%d*" y="(%d+)' do
      places[#places + 1] = x .. "," .. y
    end
    assert.same({ "13,13", "263,168" }, places)
  end)

  it("of a sum of pictures is a picture, of a frame and of its plane", function()
    bench:write("sum.lua", [[
local celspan = require "celspan"
local function disc(x)
  return celspan.rostrum { back = "#fff", celspan.cel {
    celspan.circle { centre = { x, 20 }, radius = 10, texture = "#f26419" } } }
end
return celspan.film { size = { 60, 40 }, frames = 1, frame = function()
  return { { disc(20), 0.5 }, { disc(26), 0.5 } } end }]])
    local err = done "render sum.lua -o frame.svg"
    assert.matches("of 120 x 80 pixels, because it has no vectors for this: the plane is a sum of "
      .. "several pictures", err, 1, true)
    done "render sum.lua -o sum.plane"
    local again = done "convert sum.plane plane.svg"
    assert.equal(err:match "because.-areas", again:match "because.-areas")
    assert.equal(bench:read "frame.svg", bench:read "plane.svg")
  end)

  it("has small pictures of large films", function()
    bench:write("wide.lua", [[
local celspan = require "celspan"
local function layer(from, to)
  return celspan.rect { WHERE, texture =
    celspan.linear { from = from, to = to, { 0, "#f26419" }, { 1, "#33658a80" } } }
end
return celspan.film { size = { 20000, 10 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#fff", celspan.cel { layer({ 0, 0 }, { 9, 0 }),
    layer({ 0, 0 }, { 0, 9 }) } } end }]])
    bench:write("small.lua", (bench:read("wide.lua"):gsub("WHERE", "0, 0, 9, 9")))
    assert.matches("is a picture of 1[89] x 1[89] pixels", done "render small.lua -o x.svg")
    bench:write("large.lua", (bench:read("wide.lua"):gsub("WHERE", "0, 0, 19000, 9")))
    refused(6, "pixels; a side has at most 16384: give a smaller --scale",
      "render large.lua -o y.svg")
    refused(6, "would have 4000000000 x 2000000 pixels; a side has at most 2147483647",
      "render small.lua -o y.svg --scale 200000")
    assert.is_nil(io.open(bench.folder .. "/y.svg"))
  end)

  it("has strokes under the borders of pictures through which nothing shines", function()
    bench:write("floor.lua", [[
local celspan = require "celspan"
local wood = celspan.linear { from = { 0, 0 }, to = { 100, 0 }, { 0, "#c8a25c" }, { 1, "#4b2e3a" } }
local floor = celspan.rect { 0, 0, 100, 100, texture = wood }
  :quad({ { 0, 0 }, { 100, 0 }, { 100, 100 }, { 0, 100 } },
    { { 40, 20 }, { 60, 20 }, { 100, 60 }, { 0, 60 } })
return celspan.film { size = { 100, 60 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 100, 60, texture = "#3f6f73" },
    floor } } end }]])
    done "render floor.lua -o x.svg"
    local text = bench:read "x.svg"
    assert.matches('<path stroke="#3f6f73"', text, 1, true)
    assert.matches('<clipPath id="picture"', text, 1, true)
    assert.is_nil(text:find('id="opaque"', 1, true))
  end)

  it("has no arcs of no height, where edges leave the frame", function()
    for i, corners in ipairs { "{ 999, 100 }, { 3000, 100.01 }", "{ 999.9, 100 }, { 3000, 100.1 }",
      "{ 999.99, 100 }, { 3000, 100.5 }" } do
      bench:write("flat.lua", ([[
local celspan = require "celspan"
return celspan.film { size = { 1000, 1000 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel {
    celspan.triangle { %s, { 500, 500 }, texture = "#000" } } } end }]]):format(corners))
      done("render flat.lua -o %d.svg", i)
      assert.matches(' d="m999[.9]* 100l', bench:read(i .. ".svg"))
    end
  end)

  it("of a film's plane has its thin lines, however wide the film is", function()
    bench:write("thin.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 4000, 100 }, frames = 2, frame = function(f)
  local art = {}
  for i = 1, 8 do
    art[i] = celspan.rect { 400 * i, 10 + f.number, 0.05 * i, 60, texture = "#000" }
    art[8 + i] = celspan.rect { 10 + f.number, 70 + 2 * i, 60, 0.05 * i, texture = "#000" }
  end
  return celspan.rostrum { back = "#fff", celspan.cel(art) } end }]])
    done "render thin.lua -o thin.plane --depth 8"
    done "convert thin.plane thin.svg --frame 1"
    local lines = bench:read("thin.svg"):match '<path fill="#000000" d="([^"]*)"'
    assert.equal(16, select(2, lines:gsub("z", "")))
  end)

  it("of nothing is empty", function()
    bench:write("none.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 1, frame = function()
  return celspan.rostrum {} end }]])
    done "render none.lua -o x.svg"
    assert.is_nil(bench:read("x.svg"):find("<path", 1, true))
  end)

  it("has colours within sRGB, whatever the scene has", function()
    bench:write("bright.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { front = { 4, 1, 1 },
    celspan.rect { 0, 0, 60, 40, texture = "#ff0000" } } } end }]])
    done "render bright.lua -o x.svg"
    assert.matches('fill="#ff0000"', bench:read "x.svg", 1, true)
  end)

  it("is made for each frame under a numbered name", function()
    done "render light.lua -o x.####.svg"
    assert.matches("^<svg", bench:read "x.0001.svg")
    assert.matches("^<svg", bench:read "x.0002.svg")
    refused(2, "several frames (2) need a number in the name", "render light.lua -o x.svg")
  end)

  it("has no pixels to speak of", function()
    refused(2, "x.svg: svg takes no --crop: leave it out; it is only for raw frames (-), vid",
      "render light.lua -o x.svg --crop 0,0,9,9")
    refused(2, "svg takes no --depth", "render light.lua -o x.svg --depth 8")
    local flat = "no --flat: leave it out; it is only for drawings (svg, pdf)"
    refused(2, flat, "render light.lua -o x.png --frames 1 --flat over")
    bench:write("light.0001.png", "no picture")
    for _, output in ipairs { "-o x.mp4", "-o -", "--hash", "-o x.plane" } do
      refused(2, flat, "render light.lua --flat over " .. output)
      refused(2, "no --precision: leave it out; it is only for drawings (svg)",
        "render light.lua --precision 2 " .. output)
    end
    refused(2, flat, "convert 'light.####.png' x.mp4 --flat over")
    refused(2, "--precision", "render light.lua -o x.svg --precision 10")
    bench:write("light.png", "no picture")
    bench:write("light.mp4", "no movie")
    for _, input in ipairs { "light.png", "'light.####.png'", "light.mp4" } do
      refused(2, "a drawing is made of a script or a drawing or a plane",
        "convert " .. input .. " 'x.####.svg'")
    end
  end)

  it("has a limit of borders #plain", function()
    bench:write("dust.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 1000, 1000 }, frames = 1, frame = function()
  local dots = {}
  for i = 0, 599 do
    local all = {}
    for k = 0, 899 do all[k + 1] = { i * 1.6, k * 1.1, 1, 0.6 } end
    for k, r in ipairs(all) do dots[#dots + 1] = celspan.rect { r[1], r[2], r[3], r[4] } end
  end
  return celspan.rostrum { celspan.cel(dots) } end }]])
    refused(6, "more than 1000000 borders", "render dust.lua -o x.svg --trust")
    assert.is_nil(io.open(bench.folder .. "/x.svg"))
  end)

  it("appears whole or not at all", function()
    bench:write("x.svg", "before")
    local code = bench:inside("ulimit -f 1; '" .. workbench.binary
      .. "' render light.lua -o x.svg --frames 1 --precision 9; exit $?")
    assert.not_equal(0, code)
    assert.equal("before", bench:read "x.svg")
  end)
end)

describe("a drawing as PDF", function()
  local it = present.pdf() and present.program("pdfinfo", "pdftoppm", "pdfimages") and it or pending
  local it_compares = present.pictures() and it or pending

  --- What a program of Poppler prints.
  local function said(command, ...)
    local code, out, err = bench:inside(command:format(...))
    assert.equal(0, code, err)
    return out
  end

  --- The codes of a page at one pixel for each point.
  local function drawn(name, page, w, h)
    said("pdftoppm -f %d -singlefile -r 72 -png %s drawn", page, name)
    return pixels("drawn.png", w, h)
  end

  local function code_at(bytes, w, x, y)
    return ("%02x%02x%02x"):format(bytes:byte(4 * (w * y + x) + 1, 4 * (w * y + x) + 3))
  end

  for _, name in ipairs { "codes", "light" } do
    it_compares("in " .. name .. " looks as the frame in Poppler, and shows no seams", function()
      local w, h = 320, 180
      done("render %s.lua -o x.pdf --size 320x180", name)
      for page = 1, 2 do
        done("render %s.lua -o frame.png --frames %d --size 320x180", name, page)
        drawn("x.pdf", page, w, h)
        local share, beyond = compare("frame.png", "drawn.png", w, h)
        assert.is_true(share >= 0.99, ("%.4f"):format(share))
        -- At the rim of the sun, where its gradient is steep. Poppler has 16 samples a pixel.
        assert.is_true(beyond <= (name == "codes" and 8 or 20), tostring(beyond))
      end
      assert.is_nil(said("pdfimages -list x.pdf"):find("image", 60, true))
    end)
  end

  it("has a page for each frame, or is a file for each", function()
    done "render light.lua -o x.pdf"
    local about = said "pdfinfo x.pdf"
    assert.matches("Pages: +2\n", about)
    assert.matches("Page size: +160 x 90 pts", about)
    assert.is_nil(about:find("Date", 1, true))
    done "render light.lua -o x.##.pdf --size 320x90"
    assert.matches("Pages: +1\n", said "pdfinfo x.02.pdf")
    assert.matches("Page size: +320 x 90 pts", said "pdfinfo x.02.pdf")
    done "render light.lua -o film.plane"
    done "convert film.plane plane.pdf --frame 2 --size 320x90"
    assert.is_true(bench:read "x.02.pdf" == bench:read "plane.pdf")
    done "render light.lua -o one.pdf --frames 2 --size 320x90 --strict"
    assert.is_true(bench:read "x.02.pdf" == bench:read "one.pdf")
  end)

  it("has the same bytes whatever the workers", function()
    done "render light.lua -o x.pdf --workers 1"
    done "render light.lua -o y.pdf --workers 4"
    assert.is_true(bench:read "x.pdf" == bench:read "y.pdf")
  end)

  it_compares("keeps opacity, and has pictures where PDF has no vectors", function()
    bench:write("mixed.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 60, 40 }, frames = 2, space = "srgb", frame = function(f)
  local disc = celspan.circle { centre = { 45, 20 }, radius = 10, texture = "#204060" }
  return celspan.rostrum { celspan.cel {
    celspan.rect { 0, 0, 20, 40, texture = "#f26419" },
    celspan.rect { 20, 0, 10, 40, texture = "#00000080" } },
    celspan.cel { disc, defocus = f.number == 2 and 1 or nil } } end }]])
    local err = done "render mixed.lua -o x.pdf --scale 3"
    assert.equal(1, select(2, err:gsub("what PDF has no vectors for is a picture", "")))
    for page = 1, 2 do
      local codes = drawn("x.pdf", page, 60, 40)
      assert.equal("f26419", code_at(codes, 60, 10, 20))
      assert.equal("7f7f7f", code_at(codes, 60, 25, 20))
      assert.equal("204060", code_at(codes, 60, 45, 20))
      assert.equal("ffffff", code_at(codes, 60, 32, 2))
    end
    local list = said "pdfimages -list x.pdf"
    assert.matches("\n +2 +0 image", list)
    assert.is_nil(list:find "\n +1 +%d image")
  end)

  it("is whole or not there", function()
    bench:write("x.pdf", "before")
    local code, _, err = bench:inside("ulimit -f 1; '" .. workbench.absolute
      .. "' render light.lua -o x.pdf; exit $?")
    assert.equal(5, code, err)
    assert.matches("x.pdf: ", err, 1, true)
    bench:write("late.lua", (bench:read("light.lua"):gsub("return celspan.rostrum",
      "assert(f.number < 2, 'no second frame') return celspan.rostrum")))
    refused(3, "no second frame", "render late.lua -o x.pdf")
    assert.equal("before", bench:read "x.pdf")
    for _, name in ipairs(bench:files()) do assert.falsy(name:find "part$", name) end
  end)

  it("refuses what it does not have", function()
    refused(2, "pdf takes no --precision", "render light.lua -o x.pdf --precision 3")
    refused(2, "pdf takes no --crop", "render light.lua -o x.pdf --crop 0,0,9,9")
    refused(2, "leave --keep-going out, or render shot.####.pdf",
      "render light.lua -o x.pdf --keep-going")
    refused(2, "one pdf file holds all frames, and is made in one run: leave --task out",
      "render light.lua -o x.pdf --task 1/2")
    refused(6, "a side of PDF has at most 14400", "render light.lua -o x.pdf --size 14401x9")
    bench:write("light.png", "no picture")
    refused(2, "a drawing is made of a script", "convert light.png x.pdf")
    local code, _, err = bench:inside("CELSPAN_PDF_MODULE=none.so '" .. workbench.absolute
      .. "' render light.lua -o x.pdf")
    assert.equal(5, code, err)
    assert.matches("writing PDF needs the module celspan-pdf.so", err, 1, true)
    assert.is_nil(io.open(bench.folder .. "/x.pdf"))
  end)
end)
