-- Sheets on paper, the way of a camera, and the colours of a film.
local celspan = require "celspan"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_prints = present.pdf() and present.program("pdfinfo", "pdftoppm") and it or pending
local bench, pictures

before_each(function()
  bench, pictures = workbench.new(), {}
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

local function shell(command, ...)
  local pipe = assert(io.popen(("cd %s && "):format(bench.folder) .. command:format(...)))
  local said = pipe:read "a"
  assert.is_true((pipe:close()))
  return said
end

--- A picture of the folder, and its size.
local function picture(name)
  if not pictures[name] then
    local w, h = (">I4I4"):unpack(bench:read(name), 17)
    local image = celspan.image { file = bench.folder .. "/" .. name, x = 0, y = 0 }
    pictures[name] = { w = w, h = h, pixels = assert(celspan.pixels(celspan.rostrum {
      celspan.cel { image } }, { size = { w, h }, film = { w, h }, antialias = "none" })) }
  end
  return pictures[name]
end

--- Whether a pixel has a colour in light, nearly.
local function shows(name, x, y, ...)
  local found = { picture(name).pixels:get(x, y) }
  for i, wanted in ipairs { ... } do
    if math.abs(found[i] - wanted) > 0.02 then return false, table.concat(found, " ") end
  end
  return true
end

-- ---------------------------------------------------------------- sheets

--- Writes a sheet: lines of cells, and what comes before them.
local function write_sheet(name, head, rows)
  bench:write(name, "celspan sheet 1\n" .. head .. "\n" .. table.concat(rows, "\n") .. "\n")
end

local function page_facts(name)
  local said = shell("pdfinfo %s", name)
  return math.tointeger(said:match "Pages: +(%d+)"), said:match "Page size: +(%d+ x %d+)"
end

--- The ink of a page at 144 dots an inch in a box of points: the share of black.
local function ink(name, x, y, w, h)
  local sum, count = 0, 0
  for py = math.floor(2 * y), math.floor(2 * (y + h)) - 1 do
    for px = math.floor(2 * x), math.floor(2 * (x + w)) - 1 do
      sum, count = sum + 1 - (picture(name).pixels:get(px, py)), count + 1
    end
  end
  return sum / count
end

describe("a sheet on paper", function()
  it_prints("has a page for each six seconds, and for layers that do not fit", function()
    for name, rows in pairs { short = 24, long = 145 } do
      write_sheet(name .. ".txt", "fps 24\nframes " .. rows .. "\nlayers A", { "1 1" })
      done("sheet %s.txt -o new/%s.pdf", name, name)
      assert.same({ rows > 144 and 2 or 1, "595 x 842" }, { page_facts("new/" .. name .. ".pdf") })
    end
    local names, cells = {}, {}
    for i = 1, 45 do names[i], cells[i] = '"layer ' .. i .. '"', "1" end
    write_sheet("many.txt", "fps 24\nframes 73\nlayers " .. table.concat(names, " "),
      { "1 " .. table.concat(cells, " ") })
    done "sheet many.txt -o many.pdf --paper a3"
    assert.same({ 4, "842 x 1191" }, { page_facts "many.pdf" })
    assert.same({}, bench:read ".many.pdf.ttf" and { "the letters are left" } or {})
  end)

  it_prints("draws seconds, held drawings, in-betweens and keys", function()
    write_sheet("a.txt", "fps 24\nframes 24\nlayers A",
      { "1 1", "2 |", "4 |/i", "6 |", "7 -", "12 3", "14 4/k", "15 -" })
    done "sheet a.txt -o a.pdf"
    shell "pdftoppm -r 144 -png -singlefile a.pdf a"
    local function line(y) return ink("a.png", 80, y - 1.5, 30, 3) end
    assert.is_true(line(334) > line(214) and line(214) > line(174) and line(174) > line(104))
    local function cell(row, w) return ink("a.png", 210 - w / 2, 94 + row * 10 - 8, w, 6) end
    assert.is_true(cell(3, 1) > 0.4) -- held
    assert.is_true(cell(9, 8) < 0.02) -- nothing
    assert.is_true(cell(4, 4) > cell(3, 4) + 0.2) -- a dot
    assert.is_true(cell(14, 12) > cell(12, 12) + 0.05) -- a circle
  end)

  it_prints("shows what a film has, and survives long names and letters it lacks", function()
    bench:write("film.lua", [[
return film { size = { 160, 90 }, frames = 30, marks = { wave = 5 },
  captions = { { from = 0.5, to = 1, text = "Hello" } },
  frame = function(f)
    return rostrum { camera = { centre = { 80 + f.index // 10, 45 }, width = 100 },
      cel { circle { centre = { f.index, 45 }, radius = 9 }:named(("\u{539f} long "):rep(20)) } }
  end }]])
    assert.equal("", done "sheet film.lua -o film.pdf")
    shell "pdftoppm -r 144 -png -singlefile film.pdf film"
    assert.is_true(ink("film.png", 67, 135, 60, 8) > ink("film.png", 67, 145, 60, 8) + 0.03) -- wave
    done "sheet film.lua -o part.pdf --frames 10-12"
  end)

  it("is refused with a sentence", function()
    write_sheet("a.txt", "fps 24\nframes 2\nlayers A", { "1 1" })
    refused(2, "--paper: 'a5' is not a4 or a3", "sheet a.txt -o a.pdf --paper a5")
    refused(2, "go with a sheet on paper: -o cut.pdf", "sheet a.txt -o a.csv --paper a4")
    refused(2, "must end in .xdts, .csv, .txt, .otio, .edl or .pdf", "sheet a.txt -o a.doc")
    refused(5, "a.txt", "sheet a.txt -o a.txt/a.pdf")
  end)

  it_prints("has its letters in a file of its own, which is removed", function()
    write_sheet("a.txt", "fps 24\nlayers A", { "1 1" })
    bench:write(".a.pdf.ttf", "mine")
    bench:inside "mkdir run"
    bench:write("three.lua", "return film { frames = 3, frame = function() return {} end }")
    bench:write("run/other.txt", "")
    for _, name in ipairs { "a.pdf", "a.txt/a.pdf" } do
      bench:inside(("XDG_RUNTIME_DIR=run '%s' sheet a.txt -o %s"):format(workbench.absolute, name))
    end
    assert.equal("mine", bench:read ".a.pdf.ttf")
    assert.truthy(bench:read "a.pdf")
    assert.same({ "other.txt" }, bench:files "run")
    done "sheet three.lua -o strict.pdf --strict"
    bench:inside "rm -f stdout stderr"
    assert.same({ ".a.pdf.ttf", "a.pdf", "a.txt", "run", "strict.pdf", "three.lua" }, bench:files())
  end)

  it_prints("is refused without its font", function()
    write_sheet("a.txt", "fps 24\nframes 2\nlayers A", { "1 1" })
    refused(4, "none.ttf", "sheet a.txt -o a.pdf --font none.ttf")
  end)
end)

-- ---------------------------------------------------------------- pictures of a film

--- A film whose left half is red and whose right half is blue, seen by a camera.
local function write_seen(camera)
  bench:write("film.lua", ([[
return film { size = { 160, 90 }, frames = 49, frame = function(f)
  return rostrum { camera = { %s }, cel { rect { -500, -500, 660, 1500, texture = "#f00" },
    rect { 160, -500, 660, 1500, texture = "#00f" } } }
end }]]):format(camera))
end

describe("celspan contact --camera", function()
  it("shows all that a pan sees, with the first and the last frame thick", function()
    write_seen "centre = { 80 + f.index / 48 * 160, 45 }"
    done "contact film.lua --camera -o way.png"
    local way = picture "way.png"
    assert.equal(1920, way.w) -- 320 units and a margin of 12.8 on each side
    assert.equal(math.floor((90 + 25.6) * 1920 / 345.6 + 0.5), way.h)
    assert.is_true(shows("way.png", 200, way.h - 120, 1, 0, 0))
    assert.is_true(shows("way.png", 1700, way.h - 120, 0, 0, 1))
    local left = math.floor(12.8 * 1920 / 345.6)
    assert.is_true(shows("way.png", left, way.h // 2, 0.0137, 0.2542, 0.0723))
  end)

  it("shows zooms and turns, and one place once", function()
    write_seen "width = 160 - f.index, rotate = f.index"
    done "contact film.lua --camera -o way.png"
    write_seen "centre = { 80, 45 }"
    done "contact film.lua --camera -o still.png --frames 1-30"
    assert.equal(1920, picture "still.png".w)
  end)

  it("is refused without a camera, and with a grid", function()
    bench:write("film.lua", "return film { size = { 9, 9 }, frame = function() return {} end }")
    refused(4, "film.lua: its frames have no camera", "contact film.lua --camera -o way.png")
    refused(2, "--grid does not go with --camera", "contact film.lua --camera --grid 1x1 -o a.png")
    refused(2, "--palette does not go", "contact film.lua --camera --palette -o a.png")
    refused(2, "no place for a number", "contact film.lua --camera -o a.##.png")
  end)
end)

describe("celspan contact --palette", function()
  it("shows the main colours of three shots, and their means in light", function()
    bench:write("film.lua", [[
local function shot(a, b) return { film = film { size = { 160, 90 }, frames = 24,
  frame = function() return { back = a, rect { 0, 0, 40, 90, texture = b } } end } } end
return cut { shot("#f00", "#0f0"), shot("#00f", "#fff"), shot("#000", "#fff") }]])
    done "contact film.lua --palette -o colours.png"
    local colours = picture "colours.png"
    assert.equal(1440, colours.w)
    for place, wanted in pairs {
      [{ 200, 20 }] = { 0, 1, 0 }, [{ 200, 200 }] = { 1, 0, 0 }, [{ 700, 20 }] = { 1, 1, 1 },
      [{ 700, 200 }] = { 0, 0, 1 }, [{ 200, 340 }] = { 0.75, 0.25, 0 },
      [{ 700, 340 }] = { 0.25, 0.25, 1 }, [{ 1200, 340 }] = { 0.25, 0.25, 0.25 } } do
      assert.is_true(shows("colours.png", place[1], place[2], table.unpack(wanted)))
    end
  end)
end)
