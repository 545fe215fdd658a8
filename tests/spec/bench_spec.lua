-- What the benchmark draws and what it makes of its table; its speeds are no business of tests.
local asked = require "tests.bench.asked"
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"
local shapes = require "tests.bench.shapes"
local svg = require "tests.bench.svg"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local bench, folder

setup(function()
  bench = workbench.new()
  folder = bench.folder
end)

teardown(function() bench:remove() end)

local function write(name, text) return bench:write(name, text) end

--- The lines of a drawing of 10 x 10 units, as they are.
local function lines(body)
  local path = write("a.svg", '<svg viewBox="0 0 10 10">' .. body .. "</svg>")
  return svg.lines(path, 0, 0, 10)
end

describe("the drawings of the benchmark", function()
  it("take fills, rules and transforms from groups and styles", function()
    local found = lines [[<g transform="translate(1,2)" fill="#102030" style="fill-rule:evenodd">
      <path d="M0 0h2v3z" style="fill-opacity:.5"/></g><path d="M0 0L1 1L0 1Z"/>]]
    assert.same({ "path evenodd 16 32 48 128 M 1 2L 3 2L 3 5L 1 2",
                  "path nonzero 0 0 0 255 M 0 0L 1 1L 0 1L 0 0" }, found)
  end)

  it("make cubics of arcs", function()
    local found = lines [[<circle cx="5" cy="5" r="4"/>]]
    assert.equal(4, select(2, found[1]:gsub("C", "")))
    assert.truthy(found[1]:find("M 1 5C", 1, true))
  end)

  it("fill gradients with the mean of their stops, and leave out what is hidden", function()
    local found = lines [[<defs><linearGradient id="a"><stop stop-color="#000000"/>
      <stop stop-color="#ffffff"/></linearGradient><path d="M0 0L1 1L2 0Z"/></defs>
      <rect width="2" height="2" fill="url(#a)"/><path d="M0 0L1 1L2 0Z" fill="none"/>]]
    assert.equal(1, #found)
    assert.truthy(found[1]:find("^path nonzero 127 127 127 255 "))
  end)

  it("are made by the rule of the given ones where those are missing", function()
    local list = shapes.random(1000)
    local alpha, spread = 0, 0
    for _, shape in ipairs(list) do
      alpha = alpha + shape.rgba[4]
      for _, value in ipairs(shape.points) do
        assert.is_true(value >= 0 and value < 1)
        spread = spread + value
      end
    end
    assert.near(153, alpha / #list, 6)
    assert.near(0.5, spread / #list / 8, 0.02)
    local material = present.material
    local given = material and shapes.read(material .. "/bench-scenes/scene1000.txt")
    if given then assert.equal(#list, #given) end
  end)

  --- The least and the greatest x of a closed uniform cubic B-spline on four points, among many.
  local function spline_columns(p)
    local least, most = math.huge, -math.huge
    for i = 0, 3 do
      local function x(k) return p[2 * ((i + k) % 4) + 1] end
      for step = 0, 1000 do
        local t = step / 1000
        local s = 1 - t
        local at = (s ^ 3 * x(0) + (3 * t ^ 3 - 6 * t ^ 2 + 4) * x(1)
          + (3 * s ^ 3 - 6 * s ^ 2 + 4) * x(2) + t ^ 3 * x(3)) / 6
        least, most = math.min(least, at), math.max(most, at)
      end
    end
    return least, most
  end

  it("have gradients from the left to the right of their boxes, of one alpha", function()
    for _, shape in ipairs(shapes.with_gradients(shapes.random(50))) do
      local least, most = spline_columns(shape.points)
      assert.near(least, shape.columns[1], 1e-5)
      assert.near(most, shape.columns[2], 1e-5)
      assert.equal(shape.rgba[4], shape.far_rgba[4])
    end
  end)

  it("are written with their gradients", function()
    local shape = { rgba = { 1, 2, 3, 4 }, far_rgba = { 5, 6, 7, 4 }, columns = { 0.25, 0.5 },
                    points = { 0, 0, 0, 0, 0, 0, 0, 0 } }
    shapes.write({ shape }, folder .. "/g.txt")
    local file = assert(io.open(folder .. "/g.txt"))
    local text = file:read "a"
    file:close()
    local paint = "across 0.250000000 0.500000000 1 2 3 4 5 6 7 4  0.0"
    assert.truthy(text:find("\nspline evenodd " .. paint, 1, true))
  end)
end)

describe("the table of the benchmark", function()
  local function table_of(rows)
    local runner = Runner.new { programs = "", seconds = 0, share = 1 }
    runner.rows = rows
    runner:write(folder .. "/t.csv")
    return results.read(folder .. "/t.csv")
  end

  local function row(side, seconds)
    return { part = "shapes", scene = "100", side = side, output = "spans", antialias = "area",
             renderer = "celspan", workers = 1, wall = 9 * seconds, processor = seconds,
             peak_kib = 3000, crossings = 1 }
  end

  it("is read back as it was written", function()
    local run = table_of { row(4096, 0.25), row(30000, 0.5) }
    assert.equal(2, #run:all { part = "shapes" })
    assert.equal(0.5, results.seconds(run:one { side = 30000 }))
    assert.is_nil(run:one { side = 5 })
  end)

  it("gives the power of the side that a time follows", function()
    local run = table_of { row(1000, 0.001), row(10000, 0.1), row(100000, 10.0) }
    assert.near(2, run:exponent({ part = "shapes" }, { 1000, 10000, 100000 }), 1e-9)
  end)

  it("says of each figure that is asked whether it is met, or that it was not measured", function()
    local told = {}
    for _, line in ipairs(asked.lines(table_of { row(1000000, 0.3), row(30000, 0.02) })) do
      told[line.what] = line
    end
    assert.is_true(told["100 shapes at 1M, `area`, to spans: at most 420 ms"].is_met)
    assert.is_false(told["100 shapes at 30k, `area`, to spans: at most 16 ms"].is_met)
    local other = told["1000 shapes at 1M, `area`, to spans: at most 1 s"]
    assert.is_nil(other.is_met)
    assert.equal("not measured", other.told)
  end)

  local function pixels_row(scene, renderer, seconds)
    return { part = "shapes", scene = scene, side = 1024, output = "row", antialias = "area",
             renderer = renderer, workers = 1, wall = seconds, processor = seconds }
  end

  it("names the fastest peer, and sets it against what is asked", function()
    local run = table_of { pixels_row("emoji", "celspan", 0.004),
                           pixels_row("emoji", "qt", 0.006), pixels_row("emoji", "agg", 0.005),
                           pixels_row("emoji", "blend2d", 0.001) }
    local least, name = run:best_peer("emoji", 1024)
    assert.equal(0.005, least)
    assert.equal("AGG", name)
    assert.is_nil(run:best_peer("emoji", 2048))
    for _, line in ipairs(asked.lines(run)) do
      if line.what:find("`emoji` at 1k", 1, true) then assert.equal("1.25 times", line.told) end
    end
  end)

  it("sets the worst of all drawings against the accuracy that is asked", function()
    local function told(most)
      local run = table_of { { part = "accuracy", scene = "10", rms = 0.02, worst = 1.5 },
                             { part = "accuracy", scene = "small", rms = 0.09, worst = most } }
      for _, line in ipairs(asked.lines(run)) do
        if line.what:find "every pixel of every drawing" then return line.is_met end
      end
    end
    assert.is_true(told(2.0))
    assert.is_false(told(2.01))
  end)

  it("tells how far two pictures are apart", function()
    assert.equal(0, Runner.distance("00ff10", "00ff10"))
    assert.equal(3, Runner.distance("0000", "0303"))
  end)
end)
