-- Properties of rows of spans: table 1 of the paper, order, size.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local present = require "tests.support.present"
local rows = require "tests.support.rows"
local scenes = require "tests.support.scenes"
local workbench = require "tests.support.workbench"

local COUNT, ONLY = 300, cases.only

local function each_scene(count, antialias, options, test)
  for _, case in cases.of(count) do
    local script, traits = scenes.script(case, options)
    if ONLY then print(script) end
    local list = assert(celspan.spans(scenes.load(script):at(1), {
      size = traits.size, film = { traits.width, traits.height }, antialias = antialias,
      workers = 1 }))
    for y = 0, traits.size[2] - 1 do test(list[y], traits, ("CASE=%d: row %d"):format(case, y)) end
  end
end

describe("a row of spans", function()
  it("is sorted, disjoint and covers its columns under none", function()
    each_scene(COUNT, "none", {}, function(row, traits, where)
      local fault = rows.fault(row, traits.size[1])
      if fault then error(where .. ": " .. fault) end
    end)
  end)

  it("is sorted, disjoint and covers its columns under area", function()
    each_scene(COUNT // 2, "area", {}, function(row, traits, where)
      local fault = rows.fault(row, traits.size[1])
      if fault then error(where .. ": " .. fault) end
    end)
  end)

  it("contains no array where one gradient lies over flat paints, under none", function()
    local stops = { { 0, "#f00" }, { 0.4, "#0f08" }, { 1, "#00f" } }
    for case = 1, COUNT // 3 do
      local random, label = celspan.random(case), 0
      local function number(low, high)
        label = label + 1
        return low + (high - low) * random(label)
      end
      local function place() return { number(-20, 60), number(-20, 60) } end
      local paints = {
        celspan.linear { from = place(), to = place(), table.unpack(stops) },
        celspan.radial { centre = place(), radius = number(1, 60), table.unpack(stops) },
        celspan.gradient { { 0, 0, "#f00" }, { number(20, 60), 0, "#0f08" },
          { 0, 50, "#00f" } } }
      for kind, paint in ipairs(paints) do
        local list = assert(celspan.spans(celspan.rostrum { celspan.cel {
          celspan.rect { 0, 0, 40, 40, texture = "#246" },
          celspan.circle { centre = place(), radius = 30, texture = paint },
          celspan.rect { 10, 10, 9, 50, texture = "#fff8" } } }, { size = { 40, 40 },
          antialias = "none" }))
        for y = 0, 39 do
          for _, span in ipairs(list[y]) do
            assert(span.kind ~= "array", ("case %d, paint %d, row %d"):format(case, kind, y))
          end
        end
      end
    end
  end)

  it("contains only single spans if all paints are flat, under none", function()
    each_scene(COUNT, "none", { is_flat = true, has_rows = false }, function(row, _, where)
      for _, span in ipairs(row) do
        if span.kind ~= "single" then error(where .. " holds a " .. span.kind .. " span") end
      end
    end)
  end)

  it("keeps alpha in 0..1 and light at 0 or more, without grades", function()
    for _, antialias in ipairs { "none", "area" } do
      each_scene(COUNT // 2, antialias, { has_grades = false }, function(row, traits, where)
        for x = 0, traits.size[1] - 1 do
          local colour, kind = rows.colour(row, x)
          -- Gradient spans may exceed their range by their allowed error.
          local slack = kind == "gradient" and 1 / 1023 or 1e-5
          for c = 1, 4 do
            if colour[c] < -slack or (c == 4 and colour[c] > 1 + slack) then
              error(("%s (%s): column %d is %s")
                :format(where, antialias, x, table.concat(colour, " ")))
            end
          end
        end
      end)
    end
  end)
end)

-- ---------------------------------------------------------------- counters

local celspan_command = workbench.binary

--- The counters of `celspan spans --stats` for a script's text.
local function statistics(script, options)
  local path = os.tmpname()
  local file = assert(io.open(path, "w"))
  file:write(script)
  file:close()
  local pipe =
    assert(io.popen(("'%s' spans %s --stats --workers 1 %s")
      :format(celspan_command, path, options)))
  local line = pipe:read "a"
  pipe:close()
  os.remove(path)
  local counters = {}
  for name, value in line:gmatch "(%a[%a_]*) ([%d.]+)" do counters[name] = tonumber(value) end
  assert(counters.peak_bytes, "no counters: " .. line)
  return counters
end

--- A script of B-splines in the unit square, as the benchmark's scenes.
local function bench_script(path)
  local lines = { [[
local celspan = require "celspan"
local list = { celspan.rect{ 0, 0, 1000, 1000, texture = "#fff" } }
local function add(r, g, b, a, ...)
  local n, points = {...}, {}
  for i = 1, 7, 2 do points[#points + 1] = { 1000 * n[i], 1000 * n[i + 1] } end
  list[#list + 1] = celspan.nurbs{ points = points, degree = 3, rule = "evenodd",
                                   texture = celspan.rgb(r / 255, g / 255, b / 255, a / 255) }
end]] }
  for line in io.lines(path) do
    if line:find "^%d" then lines[#lines + 1] = "add(" .. line:gsub("%s+", ", ") .. ")" end
  end
  lines[#lines + 1] = "return celspan.film{ size = {1000, 1000}, frame = function() return "
    .. "celspan.rostrum{ celspan.cel(list) } end }"
  return table.concat(lines, "\n")
end

describe("a row a million pixels wide", function()
  -- Edges far from the left coincide with pixels' edges by rounding; row 741157 has one that did.
  it("is covered by its spans without overlap", function()
    local command = ("'%s' spans scripts/terapixel.lua --size 1000000x1000000 --rows 741150-741160")
      :format(celspan_command)
    local pipe, ends, count = assert(io.popen(command)), {}, 0
    for line in pipe:lines() do
      local y, x0, x1 = line:match "^(%d+) (%d+) (%d+) "
      if y then
        assert.are.equal(ends[y] or 0, tonumber(x0), line)
        ends[y], count = tonumber(x1), count + 1
      end
    end
    pipe:close()
    assert.is_true(count > 11)
    for y, x1 in pairs(ends) do assert.are.equal(1000000, x1, "row " .. y) end
  end)
end)

describe("the work for a frame", function()
  local still = [[
local celspan = require "celspan"
local ramp = celspan.linear{ from = {0, 0}, to = {90, 40}, {0, "#f00"}, {1, "#0000ff88"} }
return celspan.rostrum{ celspan.cel{
  celspan.rect{ 3, 3, 90, 90, texture = ramp },
  celspan.circle{ centre = {50, 50}, radius = 30, texture = "#00ff0088" } - celspan.rect{ 40, 40,
    20, 20 } } }
]]

  it("needs memory that does not grow with the height, and hardly with the width", function()
    for _, antialias in ipairs { "none", "area" } do
      local function peak(size)
        return statistics(still, ("--size %s --antialias %s"):format(size, antialias)).peak_bytes
      end
      local small = peak "500x500"
      assert.is_true(peak "500x20000" <= 1.25 * small, "height under " .. antialias)
      assert.is_true(peak "20000x500" <= 2 * small, "width under " .. antialias)
    end
  end)

  it("needs memory that grows with the edges in a row, not with their square", function()
    local scribble = [[
local celspan = require "celspan"
local seed, points = 1, { rule = "evenodd" }
local function random()
  seed = (seed * 1103515245 + 12345) % 2147483648
  return seed / 2147483648
end
for i = 1, COUNT do points[i] = { 100 * random(), 100 * random() } end
return celspan.film{ size = { 100, 100 }, frame = function()
  return celspan.rostrum{ celspan.cel{ celspan.polygon(points) } } end }
]]
    local function peak(count, size)
      return statistics(scribble:gsub("COUNT", count),
        "--antialias area --size " .. size).peak_bytes
    end
    -- All boundaries begin in the first row, and cross there at some millions of places.
    assert.is_true(peak(64000, "4x4") <= 100e6, "in rows of 4 pixels")
    assert.is_true(peak(64000, "20x20") <= 100e6, "in rows of 20 pixels")
  end)

  it("composes few colours for 100 shapes at 30,000 x 30,000", function()
    local material = present.material
    if not material then return pending "CELSPAN_MATERIAL is not set" end
    local counters = statistics(bench_script(material .. "/bench-scenes/scene100.txt"),
                                "--size 30000x30000 --antialias none")
    assert.are.equal(30000, counters.rows)
    assert.are.equal(0, counters.array)
    assert.is_true(counters.colour_evaluations < 40000,
      counters.colour_evaluations .. " evaluations")
  end)
end)
