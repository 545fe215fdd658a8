-- Tracing: the shapes found in small pictures, the output, and refusals.
local celspan = require "celspan"
local svg = require "celspan.svg"
local trace = require "celspan.trace"
local present = require "tests.support.present"
local raised = require("tests.support.raised").message
local workbench = require "tests.support.workbench"

local it_traces = present.pictures() and it or pending -- pictures are files here

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

--- Writes a picture of letters, one per pixel, with their colours; "." is clear. Each under another
--- name: a picture is read once.
local function write(rows, colours, name)
  local bytes = {}
  for _, row in ipairs(rows) do
    for letter in row:gmatch "." do
      local r, g, b = (colours[letter] or "#000000"):match "#(%x%x)(%x%x)(%x%x)"
      bytes[#bytes + 1] = string.char(tonumber(r, 16), tonumber(g, 16), tonumber(b, 16),
        letter == "." and 0 or 255)
    end
  end
  local w, h = #rows[1], #rows
  local image = celspan.image { pixels = table.concat(bytes), size = { w, h }, format = "rgba8",
    x = 0, y = 0, sampling = "nearest" }
  local path = bench.folder .. "/" .. (name or "drawing.png")
  assert(celspan.render(celspan.rostrum { celspan.cel { image } }, path, { size = { w, h } }))
  return path
end

local drawn = 0

--- Each under another name: a picture is read once.
local function draw(object, w, h, antialias)
  drawn = drawn + 1
  local path = ("%s/drawing%d.png"):format(bench.folder, drawn)
  assert(celspan.render(celspan.rostrum { antialias = antialias, celspan.cel { object } }, path,
    { size = { w, h } }))
  return path
end

local function codes(object, w, h, k)
  return celspan.pixels(celspan.rostrum { celspan.cel { object } },
    { film = { w, h }, size = { w * (k or 1), h * (k or 1) } }):bytes { depth = 8 }
end

local paper, ink = "#ffffff", "#202020"
local two = { ["#"] = ink, [" "] = paper, ["+"] = "#c03030" }

describe("trace.picture", function()
  it_traces("follows an edge between two corners with a few curves", function()
    local half = celspan.intersection {
      celspan.circle { centre = { 50, 50 }, radius = 40.3, texture = ink },
      celspan.rect { 0, 0, 100, 50, texture = ink } }
    local path = bench.folder .. "/half.png"
    assert(celspan.render(celspan.rostrum { back = paper, celspan.cel { half } }, path,
      { size = { 100, 100 } }))
    local pieces = 0
    for _, shape in ipairs(assert(trace.picture(path, { colours = 2 })).shapes) do
      pieces = pieces + select(2, shape.d:gsub("[LCQAHV]", ""))
    end
    assert.is_true(pieces <= 20, pieces .. " pieces")
  end)

  it_traces("finds the areas, the largest first, with their colours and sizes", function()
    local path = write({ "          ", "  ####    ", "  #  #  + ", "  ####    ", "          " },
      two)
    local art = assert(trace.picture(path, { colours = 3, smooth = 0, speckle = 0 }))
    assert.equal(10, art.width)
    assert.equal(5, art.height)
    local found = {}
    for i, shape in ipairs(art.shapes) do
      found[i] = ("%s %d %d,%d"):format(shape.colour, shape.area, shape.x, shape.y)
    end
    assert.same({ "#ffffff 37 0,0", "#202020 10 2,1", "#ffffff 2 3,2", "#c03030 1 8,2" }, found)
  end)

  it_traces("restores the pixels if curves follow their sides", function()
    local rows = { "#  +##", " ## + ", "+ #+ #", "##  ##", " + #  " }
    local path = write(rows, two)
    local art = assert(trace.picture(path, { colours = { paper, ink, "#c03030" }, smooth = 0,
      speckle = 0 }))
    local image = celspan.image { file = path, x = 0, y = 0, sampling = "nearest" }
    assert.equal(codes(image, 6, 5, 3), codes(art.object, 6, 5, 3))
  end)

  it_traces("distinguishes nearly equal colours, whichever comes first", function()
    local near = { ["#"] = "#434343", [" "] = "#404040" }
    for i, rows in ipairs { { "    ####", "    ####" }, { "####    ", "####    " } } do
      local art = assert(trace.picture(write(rows, near, i .. ".png"),
        { colours = { "#404040", "#434343" }, smooth = 0, speckle = 0 }))
      local found = {}
      for k, shape in ipairs(art.shapes) do found[k] = shape.colour .. " " .. shape.area end
      table.sort(found)
      assert.same({ "#404040 8", "#434343 8" }, found)
    end
  end)

  it_traces("leaves clear areas clear", function()
    local path = write({ "......", ".####.", ".####.", ".####.", "......" }, two)
    local art = assert(trace.picture(path, { smooth = 0 }))
    assert.equal(1, #art.shapes)
    assert.same({ 1, 1, 4, 3 }, { art.object:bounds() })
  end)

  it_traces("finds no shapes in a completely clear picture", function()
    local art = assert(trace.picture(write({ "...", "..." }, two)))
    assert.equal(0, #art.shapes)
    assert.is_nil(art.object:bounds())
  end)

  it_traces("removes speckles, and only those", function()
    local rows = { "            ", " #  ##  ### ", "            " }
    local path = write(rows, two)
    local function count(speckle)
      return #assert(trace.picture(path, { speckle = speckle })).shapes
    end
    assert.equal(4, count(0))
    assert.equal(3, count(1))
    assert.equal(2, count(2))
    assert.equal(1, count(3))
  end)

  it_traces("finds an edge inside pixels from their coverage", function()
    local art = assert(trace.picture(draw(celspan.rect { 0, 0, 40, 30, texture = paper }
      | celspan.rect { 8.3, 6.45, 20.4, 15.2, texture = ink }, 40, 30)))
    local x, y, w, h = art.shapes[2].object:bounds()
    for i, pair in ipairs { { x, 8.3 }, { y, 6.45 }, { w, 20.4 }, { h, 15.2 } } do
      assert.is_true(math.abs(pair[1] - pair[2]) < 0.02,
        ("%d: %g, not %g"):format(i, pair[1], pair[2]))
    end
  end)

  it_traces("keeps corners, and makes a circle from few curves", function()
    local disc = assert(trace.picture(draw(celspan.rect { 0, 0, 120, 120, texture = paper }
      | celspan.circle { centre = { 60, 60 }, radius = 44.7, texture = ink }, 120, 120)))
    local _, curves = disc.shapes[2].d:gsub("C", "")
    assert.is_true(curves <= 6, curves .. " curves")
    assert.is_nil(disc.shapes[2].d:find "L")
    local box = assert(trace.picture(draw(celspan.rect { 0, 0, 120, 120, texture = paper }
      | celspan.rect { 20, 20, 60, 60, texture = ink }:rotate(20, 60, 60), 120, 120)))
    _, curves = box.shapes[2].d:gsub("C", "")
    local _, lines = box.shapes[2].d:gsub("L", "")
    assert.same({ 0, 4 }, { curves, lines })
  end)

  it_traces("keeps bends of two pixels round, and dots of four pixels", function()
    local box = celspan.rect { -21, -21, 42, 42, radius = 2.2, texture = ink }
    local art = assert(trace.picture(draw(celspan.rect { 0, 0, 100, 100, texture = paper }
      | box:rotate(12.54):translate(50.3, 49.7), 100, 100)))
    assert.is_nil(art.shapes[2].d:find "L", art.shapes[2].d)
    for width, letter in pairs { "L", "C" } do
      local dot = assert(trace.picture(draw(celspan.rect { 0, 0, 12, 12, texture = paper }
        | celspan.rect { 4, 4, width, 2, texture = ink }, 12, 12), { speckle = 0 }))
      assert.equal(letter, dot.shapes[2].d:gsub("[^LC]", ""):sub(1, 1))
    end
  end)

  it_traces(
    "makes a tilted square of whole pixels into four lines, and restores its pixels", function()
    for _, turn in ipairs { 3, 20, 45 } do
      local square = celspan.rect { 10, 10, 20, 20, texture = ink }:rotate(turn, 20, 20)
      local object = celspan.union { celspan.rect { 0, 0, 40, 40, texture = paper }, square }
      local path = draw(object, 40, 40, "none")
      local art = assert(trace.picture(path, { colours = { paper, ink } }))
      assert.equal("MLLLLZ", (art.shapes[2].d:gsub("[^%a]", "")))
      local function whole(drawing)
        return celspan.pixels(celspan.rostrum { antialias = "none", celspan.cel { drawing } },
          { film = { 40, 40 }, size = { 40, 40 } }):bytes { depth = 8 }
      end
      assert.is_true(whole(object) == whole(art.object), "turned by " .. turn)
    end
  end)

  it_traces("finds lines thinner than a pixel with their middle and width", function()
    local art = assert(trace.picture(draw(celspan.rect { 0, 0, 60, 20, texture = paper }
      | celspan.rect { 5, 8.1, 50, 0.8, texture = ink }, 60, 20), { colours = { paper, ink } }))
    local line = art.shapes[2].object
    for _, x in ipairs { 15, 25, 35 } do
      assert.same({ false, true, true, false }, { line:contains(x, 7.9), line:contains(x, 8.25),
        line:contains(x, 8.75), line:contains(x, 9.1) })
    end
  end)

  it_traces("paints a shape in another colour", function()
    local art =
      assert(trace.picture(write({ "        ", "  ####  ", "  ####  ", "        " }, two)))
    local red = art.shapes[2].object:with { texture = "#ff0000" }
    local r, g = celspan.probe(celspan.rostrum { celspan.cel { red } }, 4, 2, { film = { 8, 4 } })
    assert.same({ 1, 0 }, { r, g })
  end)

  it_traces("traces the same picture to the same shapes", function()
    local path = draw(celspan.rect { 0, 0, 90, 60, texture = paper }
      | celspan.ellipse { centre = { 40, 30 }, radii = { 30, 18 }, texture = ink }, 90, 60)
    local a, b = assert(trace.picture(path)), assert(trace.picture(path))
    assert.equal(a.shapes[2].d, b.shapes[2].d)
  end)
end)

describe("tiny and hostile pictures", function()
  local cases = {
    one = { "#" }, row = { "# ## +#" }, column = { "#", " ", "+", "#", "#" },
    board = { "# # # # ", " # # # #", "# # # # ", " # # # #" },
    colours = { "#+ #+ #+", "+ #+ #+ ", " #+ #+ #", "#+ #+ #+" },
    touch = { "##  ", "##  ", "  ##", "  ##" }, same = { "    ", "    " },
    clear = { "#.#.", ".#.#", "#.#." }, ring = { "#####", "#   #", "# # #", "#   #", "#####" },
  }
  for name, rows in pairs(cases) do
    it_traces("are covered without gaps: " .. name, function()
      local path = write(rows, two)
      for _, options in ipairs { { colours = 3 }, { colours = 3, speckle = 0 },
        { colours = 3, speckle = 0, smooth = 4 }, { colours = 3, speckle = 0, smooth = 0 },
        { colours = 3, speckle = 0, lines = true } } do
        local art = assert(trace.picture(path, options))
        local w, h = #rows[1], #rows
        local image = celspan.pixels(celspan.rostrum { celspan.cel { art.object } },
          { film = { w, h }, size = { 3 * w + 1, 3 * h + 2 } })
        for y = 0, (options.lines or name == "clear") and -1 or image.height - 1 do
          for x = 0, image.width - 1 do
            local _, _, _, alpha = image:get(x, y)
            assert.equal(1, alpha)
          end
        end
      end
    end)
  end
end)

describe("centre lines", function()
  local function stroke(d, width)
    return celspan.rect { 0, 0, 120, 80, texture = paper }
      | celspan.stroke { d = d, width = width, cap = "round", texture = ink }
  end

  it_traces("run along the middle, as wide as the line", function()
    local art = assert(trace.picture(draw(stroke("M20 40.3 H100", 6.4), 120, 80), { lines = true }))
    assert.equal(1, #art.shapes)
    for _, point in ipairs(art.shapes[1].points) do
      assert.is_true(math.abs(point[2] - 40.3) < 0.3, "y " .. point[2])
      assert.is_true(math.abs(point[3] - 6.4) < 0.5, "width " .. point[3])
    end
    local x, _, w = art.object:bounds()
    assert.is_true(math.abs(x - 16.8) < 1.5 and math.abs(w - 86.4) < 3, x .. " " .. w)
  end)

  it_traces("are closed where a line is", function()
    local ring = celspan.rect { 0, 0, 80, 80, texture = paper }
      | celspan.circle { centre = { 40, 40 }, radius = 25 }:stroke { width = 4, texture = ink }
    local art = assert(trace.picture(draw(ring, 80, 80), { lines = true }))
    assert.equal(1, #art.shapes)
    assert.is_true(art.shapes[1].closed)
    local x, y, w, h = art.object:bounds()
    for i, side in ipairs { x - 13, y - 13, x + w - 67, y + h - 67 } do
      assert.is_true(math.abs(side) < 0.5, ("side %d is off by %g"):format(i, side))
    end
  end)

  it_traces("get wider and narrower with the pressure of the pen", function()
    local line = celspan.rect { 0, 0, 120, 80, texture = paper }
      | celspan.stroke { points = { { 20, 40, 2 }, { 60, 40, 12 }, { 100, 40, 2 } }, texture = ink }
    local points = assert(trace.picture(draw(line, 120, 80), { lines = true })).shapes[1].points
    local most = 0
    for _, point in ipairs(points) do most = math.max(most, point[3]) end
    assert.is_true(most > 9 and points[1][3] < 5 and points[#points][3] < 5)
  end)
end)

describe("celspan trace", function()
  local art = celspan.rect { 0, 0, 90, 60, texture = paper }
    | celspan.ellipse { centre = { 40, 30 }, radii = { 30, 18 }, texture = ink }
    | celspan.rect { 50, 20, 20, 30, texture = "#c03030" }

  it_traces("writes SVG and scripts that look like the module's result", function()
    local path = draw(art, 90, 60)
    local traced = assert(trace.picture(path, { colours = 3 }))
    for _, name in ipairs { "art.svg", "art.lua" } do
      local code, _, err = bench:celspan("trace %s -o %s/%s --colours 3", path, bench.folder, name)
      assert.equal(0, code, err)
    end
    local wanted = codes(traced.object, 90, 60, 2)
    assert.equal(wanted, codes(assert(svg.read(bench.folder .. "/art.svg")).object, 90, 60, 2))
    local film, module = dofile(bench.folder .. "/art.lua")
    assert.equal(wanted, codes(module.object, 90, 60, 2))
    assert.equal(#traced.shapes, #module.shapes)
    assert.equal(wanted, celspan.pixels(film, { size = { 180, 120 } }):bytes { depth = 8 })
    local required = assert(loadfile(bench.folder .. "/art.lua"))("art")
    assert.equal(traced.shapes[3].d, required.shapes[3].d)
  end)

  it_traces("writes strokes", function()
    local line = celspan.rect { 0, 0, 120, 80, texture = paper }
      | celspan.stroke { d = "M20 40 C 40 0 70 80 100 30", width = 6, texture = ink }
    local path = draw(line, 120, 80)
    local script, drawing = bench.folder .. "/art.lua", bench.folder .. "/art.svg"
    assert.equal(0, (bench:celspan("trace %s --lines -o %s", path, script)))
    assert.equal(0, (bench:celspan("trace %s --lines -o %s", path, drawing)))
    local traced = assert(trace.picture(path, { lines = true }))
    assert.equal(codes(traced.object, 120, 80), codes(select(2, dofile(script)).object, 120, 80))
    local x, y, w, h = traced.object:bounds()
    local u, v, p, q = assert(svg.read(drawing)).object:bounds()
    for _, pair in ipairs { { x, u }, { y, v }, { w, p }, { h, q } } do
      assert.is_true(math.abs(pair[1] - pair[2]) < 0.2, pair[1] .. " " .. pair[2])
    end
  end)

  it_traces("uses the given colours", function()
    local path = draw(art, 90, 60)
    assert.equal(0,
      (bench:celspan("trace %s -o %s/a.svg --colours '#fff,#202020'", path, bench.folder)))
    local text = bench:read "a.svg"
    assert.is_truthy(text:find "#ffffff" and text:find "#202020" and not text:find "#c0")
  end)

  it_traces("refuses files that it cannot read or write, with the name and the reason", function()
    local path = draw(art, 90, 60)
    local function refused(code, text, ...)
      local got, _, err = bench:celspan(...)
      assert.equal(code, got, err)
      assert.is_truthy(err:find(text, 1, true), err)
    end
    refused(4, "none.png: cannot be opened", "trace none.png -o a.svg")
    bench:write("text.png", "this is no picture")
    refused(4, "text.png", "trace %s/text.png -o a.svg", bench.folder)
    refused(2, "-o is missing", "trace %s", path)
    refused(2, "must end in .svg or .lua", "trace %s -o a.eps", path)
    refused(2, "--colours", "trace %s -o a.svg --colours 65", path)
    refused(2, "--colours", "trace %s -o a.svg --colours '#fff,#ggg'", path)
    for _, text in ipairs { "0", "two", "#ffffff,", "#ffffff,red", "#fff;#000", "#ffffff80",
      "#ffffffffffff",
                            "#fff,,#000", "#010203" .. (",#010203"):rep(64) } do
      refused(2, "--colours: '", "trace %s -o a.svg --colours '%s'", path, text)
    end
    refused(4, "none.png", "trace none.png -o a.svg --colours '%s'",
      "#010203" .. (",#010203"):rep(63))
    refused(2, "--smooth", "trace %s -o a.svg --smooth -1", path)
    refused(2, "--speckle", "trace %s -o a.svg --speckle x", path)
    refused(5, "/proc/none", "trace %s -o /proc/none/a.svg", path)
    refused(3, "there twice", "trace %s -o a.svg --colours '#fff,#fff'", path)
    assert.same({ path:match "[^/]*$", "stderr", "stdout", "text.png" }, bench:files())
  end)
end)

describe("options of trace.picture", function()
  it("are checked at the caller's line", function()
    for text, options in pairs {
      ["unknown field 'colurs'; did you mean 'colours'?"] = { colurs = 3 },
      ["colours must be a whole number from 1 to 64, got 0"] = { colours = 0 },
      ["colours must be a whole number from 1 to 64, got 2.5"] = { colours = 2.5 },
      ["colours[2] must be a colour like \"#336699\", got \"redd\""] = {
        colours = { "#fff", "redd" } },
      ["colours[2] must be a colour like \"#336699\", got nil"] = {
        colours = { "#fff", nil, "#000" } },
      ["smooth must be from 0 to 16, got 17"] = { smooth = 17 },
      ["speckle must be a whole number from 0"] = { speckle = -1 },
      ["field 'lines' must be a boolean, got number"] = { lines = 1 },
    } do
      local message = raised(function() trace.picture("a.png", options) end)
      assert.is_truthy(message:find(text, 1, true), message)
      assert.is_truthy(message:find("trace_spec.lua:", 1, true), message)
    end
    assert.is_truthy(raised(function() trace.picture(7) end):find "takes a file name, got number")
  end)

  it_traces("return nil and a message for pictures that cannot be read", function()
    local art, message = trace.picture(bench.folder .. "/none.png")
    assert.is_nil(art)
    assert.is_truthy(message:find "none.png: cannot be opened")
  end)
end)
