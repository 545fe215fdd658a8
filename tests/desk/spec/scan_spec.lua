-- Scans whose truth is known, registered and cleaned. tests/bench/scan.lua measures 200 of them.
local celspan = require "celspan"
local ink = require "celspan.ink"
local markdown = require "tests.support.markdown"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local scans = require "tests.support.scans"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

if not present.pictures() then
  describe("scans", function()
    it("are pictures", function() pending "there is no picture module" end)
  end)
  return
end

local DPI, UNIT = 75, 75 / 25.4
local bench, folder

setup(function()
  bench = workbench.new()
  folder = bench.folder
end)

teardown(function() bench:remove() end)

--- Writes a scan, upright unless `more` says how it lies, and returns it.
local function write(name, more)
  local scan = { seed = 1, dpi = DPI, turn = 0, shift = { 0, 0 } }
  for key, value in pairs(more or {}) do scan[key] = value end
  scans.write(folder .. "/" .. name, scan)
  return scan
end

local function scanned(pattern, options) return ink.scan(folder .. "/" .. pattern, options) end

describe("registering", function()
  it("lays the holes of all scans alike, to a tenth of a millimetre", function()
    for i = 1, 4 do
      local scan, ending = scans.any(i, DPI)
      scan.bed, scan.grain = nil, math.min(scan.grain, 0.02)
      scans.write(("%s/any.%d.%s"):format(folder, i, ending), scan)
      local drawing = assert(scanned("any.#." .. ending, { dpi = DPI, frames = tostring(i) }))[i]
      assert.is_true(scans.error_of(drawing, scan) < 0.1, "scan " .. i)
      assert.is_true(math.abs(drawing.turned + scan.turn) < 0.02)
    end
  end)

  it("finds holes in front of white", function()
    local scan = write("white.1.png", { bed = "#fff", paper = "#d8d4cc", turn = 2,
      shift = { 3, 2 } })
    assert.is_true(scans.error_of(assert(scanned("white.#.png", { dpi = DPI }))[1], scan) < 0.1)
  end)

  it("says that holes are hidden by grain, in front of white", function()
    for i, seed in ipairs { 64, 139 } do -- they would be laid off by a pixel and more
      scans.write(("%s/grainy.%d.png"):format(folder, i), scans.any(seed, DPI))
      local drawings, message = scanned("grainy.#.png", { dpi = DPI, frames = tostring(i) })
      assert.is_nil(drawings)
      assert.matches("of the 3 peg holes were found: .* scan the whole sheet on black", message)
    end
  end)

  it("lays given holes where they are on the paper, and reads the dpi of a file", function()
    local scan = write("own.1.tif", { turn = -3, shift = { 4, -2 }, grey = true })
    local y = 24 - 105
    local holes = { { 0, y, 6.35, 6.35 }, { -101.6, y, 12.7, 3.2 }, { 101.6, y, 12.7, 3.2 } }
    local drawing = assert(scanned("own.#.tif", { pegs = holes }))[1]
    local to = { drawing.width / 2, drawing.height / 2 + y * UNIT }
    assert.is_true(scans.error_of(drawing, scan, to) < 0.1)
    write("own.2.tif", { upside = true })
    assert.matches("own.2.tif: the scan is upside down", select(2, scanned("own.#.tif", {
      pegs = holes })), 1, true)
  end)

  it("is by the corners of the paper, or by the best shift of the lines", function()
    local scan = write("corners.1.png", { small = 0.85, turn = 3, shift = { 5, -4 } })
    local drawing = assert(scanned("corners.#.png", { pegs = false }))[1]
    assert.is_true(math.abs(drawing.turned + scan.turn) < 0.05)
    local cosine, sine = math.cos(math.rad(3)), math.sin(math.rad(3))
    assert.is_true(math.abs(drawing.offset[1] + (cosine * 5 - sine * 4) * UNIT) < 0.5)
    assert.is_true(math.abs(drawing.offset[2] - (sine * 5 + cosine * 4) * UNIT) < 0.5)
    write("match.1.png", { missing = { true, true, true } })
    write("match.2.png", { missing = { true, true, true }, shift = { -6, 7.5 }, grain = 0.02 })
    drawing = assert(scanned("match.#.png", { match = true }))[2]
    assert.is_true(math.abs(drawing.offset[1] - 6 * UNIT) < 0.3)
    assert.is_true(math.abs(drawing.offset[2] + 7.5 * UNIT) < 0.3)
  end)

  it("says which scan cannot be registered, and what to do", function()
    for name, case in pairs {
      none = { { missing = { true, true, true } }, "none of the 3 peg holes was found" },
      two = { { missing = { false, true } }, "only 2 of the 3 peg holes were found" },
      empty = { { blank = true }, "the drawing is empty" },
      scale = { {}, "the peg holes lie as in a scan of 75 dpi, not 150", 150 },
      unsaid = { {}, "it does not say its dpi", false },
    } do
      write(name .. ".1.png", case[1])
      local dpi = case[3] ~= false and (case[3] or DPI) or nil
      local drawings, message = scanned(name .. ".#.png", { dpi = dpi })
      assert.is_nil(drawings)
      assert.matches(name .. ".1.png: " .. case[2], message, 1, true)
    end
    write("side.1.png")
    write("side.2.png", { upside = true })
    assert.matches("side.2.png: the scan is upside down", select(2, scanned("side.#.png", {
      dpi = DPI })), 1, true)
    bench:write("text.1.png", "no picture")
    assert.matches("text.1.png", select(2, scanned("text.#.png")), 1, true)
    assert.matches("no such files", select(2, scanned "absent.#.png"), 1, true)
    local _, message = scanned("side.#.png", { pegs = false })
    assert.matches("does not end inside", message, 1, true)
  end)
end)

--- The colour of a picture at a place of the paper, as codes and alpha.
local function shown(drawing, texture, x, y)
  local object = celspan.rect { 0, 0, drawing.width, drawing.height, texture = texture }
  local px, py = drawing.width / 2 + (x - 148.5) * UNIT, 12 * UNIT + (y - 24) * UNIT
  local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { object } }, {
    size = { drawing.width, drawing.height }, crop = { px // 1, py // 1, 1, 1 } }))
  return { image:bytes():byte(1, 4) }
end

describe("cleaning", function()
  it("divides the shadow of a binding out, and leaves dust out", function()
    local scan = write("shade.1.png", { shadow = 0.5, dust = 60, turn = 1, grain = 0.01 })
    local drawing = assert(scanned("shade.#.png", { dpi = DPI }))[1]
    local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { drawing.object } },
      { size = { drawing.width, drawing.height } }))
    local bytes, clear = image:bytes(), 0
    for alpha in bytes:gmatch "...(.)" do clear = clear + (alpha == "\0" and 1 or 0) end
    -- all that is not clear belongs to lines, of which this scan without anything else has as much
    write("plain.1.png", { turn = scan.turn })
    local plain = assert(scanned("plain.#.png", { dpi = DPI }))[1]
    local other = assert(celspan.pixels(celspan.rostrum { celspan.cel { plain.object } },
      { size = { plain.width, plain.height } })):bytes()
    local same = 0
    for alpha in other:gmatch "...(.)" do same = same + (alpha == "\0" and 1 or 0) end
    assert.is_true(math.abs(clear - same) < 0.01 * #bytes / 4)
  end)

  it("takes the inks of pencils apart", function()
    local inks = { black = "#262624", red = "#c23b38", blue = "#4c9ac6" }
    local patches = {}
    for i, name in ipairs { "red", "blue", "black" } do
      patches[i] = celspan.rect { 60 * i, 90, 20, 6, texture = inks[name] }
    end
    write("inks.1.png", { drawn = patches, grain = 0.02, turn = 2 })
    local drawing = assert(scanned("inks.#.png", { dpi = DPI, ink = inks }))[1]
    for i, name in ipairs { "red", "blue", "black" } do
      for other, texture in pairs(drawing.colours) do
        local pixel = shown(drawing, texture, 60 * i + 10, 93)
        assert.is_true(other == name and pixel[4] > 200 or other ~= name and pixel[4] == 0)
      end
    end
    assert.same({ 0xc2, 0x3b, 0x38 }, { table.unpack(shown(drawing, drawing.colours.red, 70, 93),
      1, 3) })
    assert.equal(drawing.colours.black, drawing.lines)
  end)

  it("makes the same lines of 8 and of 16 bits, in grey and in colour", function()
    local first
    for i, more in ipairs { { grey = true }, { grey = true, bits = 16 }, { bits = 16 } } do
      more.paper, more.bed, more.colours = "#e0e0e0", "#101010", { "#202020" }
      write(("depth.%d.tif"):format(i), more)
      local drawing = assert(scanned("depth.#.tif", { frames = tostring(i) }))[i]
      first = first or drawing
      assert.same(first.offset, drawing.offset)
      assert.same(first.levels, drawing.levels)
    end
  end)

  it("refuses impossible options at the caller's line", function()
    for message, options in pairs {
      ["pegs must be"] = { pegs = "oxberry" }, ["number of pegs must be 2"] = { pegs = { {} } },
      ["dpi must be from 30"] = { dpi = 3 },
      ["levels must be black and white, 0 <= black < white <= 1, got 0.1 and 1.2"] = {
        levels = { 0.1, 1.2 } }, ["got 3 values"] = { levels = { 0.1, 0.8, 0.9 } },
      ["dust must be a whole"] = { dust = -1 }, ["ink.red must be"] = { ink = { red = "crimsn" } },
      ["ink must be 1 to 8 colours by name, got 0"] = { ink = {} },
      ["match goes without pegs"] = { match = true, pegs = "acme" },
      ["unknown field 'dip'"] = { dip = 300 },
    } do
      assert.matches(message, raised.message(scanned, "x.#.png", options), 1, true)
    end
  end)
end)

describe("a level", function()
  it("frees each page before it reads the next one", function()
    write("many.1.png")
    bench:write("many.lua", [[
local level = require "celspan.ink"
for _ = 1, 14 do assert(level.scan("many.#.png", { match = true, dpi = 75 })) end
return film { size = { 9, 9 }, frame = function() return {} end }
]])
    local code, _, text = bench:celspan_inside("render many.lua --hash --limit memory=40M")
    assert.equal(0, code, text)
  end)
end)

describe("celspan scan", function()
  it("writes each drawing and each ink, and how they were moved", function()
    write("rough.1.tif", { turn = 2, colours = { "#262624", "#c23b38" } })
    write("rough.2.tif", { turn = -1, shift = { 4, 3 }, colours = { "#262624", "#c23b38" } })
    local code, text = bench:celspan_inside("scan 'rough.#.tif' -o clean/level.##.png --json "
      .. "--contact moved.png --ink 'black=#222,red=#c33'")
    assert.equal(0, code, text)
    local facts = require "celspan.json".decode(text)
    assert.is_true(math.abs(facts.drawings[2].turned - 1) < 0.02)
    for _, name in ipairs { "clean/level.02.png", "clean/level.red.01.png", "moved.png" } do
      assert.is_truthy(bench:read(name), name)
    end
  end)

  it("makes the clean lines of scripts/pencil, by the commands of the page", function()
    assert.equal(0, (bench:inside "mkdir pencil"))
    local clean = { body = "body.black.0004.png", legs = "legs.0004.png", mouth = "mouth.0002.png" }
    for _, name in pairs(clean) do
      local scan = "pencil/" .. name:gsub("black%.", "")
      bench:write(scan, (system.read("scripts/" .. scan)))
    end
    local count = 0
    for line in markdown.read "docs/from-pencil.md":gmatch "\ncelspan (scan [^\n]+)" do
      local code, _, text = bench:celspan_inside("%s", line)
      assert.equal(0, code, text)
      local name = "pencil/clean/" .. clean[line:match "pencil/(%l+)"]
      assert.is_true(bench:read(name) == system.read("scripts/" .. name), name)
      count = count + 1
    end
    assert.equal(3, count)
  end)

  it("puts the name of an ink before the number", function()
    write("named.1.png")
    for output, name in pairs { ["named/##.png"] = "named/red.01.png",
      ["named/level_#.png"] = "named/level_red.1.png",
      ["named/level.%%02d.png"] = "named/level.red.01.png" } do
      local code, _, text = bench:celspan_inside("scan 'named.#.png' -o '" .. output
        .. "' --dpi 75 --ink 'black=#222,red=#c33'")
      assert.equal(0, code, text)
      assert.is_truthy(bench:read(name), name)
    end
  end)

  it("does not write over the scans that it reads", function()
    write("over.1.png")
    write("over.red.1.png")
    local before = bench:read "over.1.png"
    for options, name in pairs {
      ["'over.#.png' -o 'over.#.png'"] = "over.1.png",
      ["'./over.#.png' -o \"$PWD/over.#.png\""] = "over.1.png",
      ["'over.red.#.png' -o 'over.#.png' --ink 'red=#c33'"] = "over.red.1.png",
    } do
      local code, _, text = bench:celspan_inside("scan " .. options .. " --dpi 75")
      assert.equal(2, code)
      assert.matches(name .. "' is a scan that is read; choose another folder", text, 1, true)
    end
    assert.equal(before, bench:read "over.1.png")
  end)

  it("refuses wrong options, and names the scan that fails", function()
    write("bad.1.png", { missing = { true, true, true } })
    for options, message in pairs {
      [""] = "-o is missing", ["-o a.png"] = "needs a number",
      ["-o a.#.png --pegs oxberry"] = "--pegs: 'oxberry' is not acme or none",
      ["-o a.#.png --levels 1"] = "--levels",
      ["-o a.#.png --ink red"] = "--ink: 'red' is not NAME=COLOUR, such as red=#c33",
      ["-o a.#.png --ink 'a b=red'"] = "a name has letters, digits, _ and -",
      ["-o a.#.png --ink a=red,a=#222"] = "--ink: 'a' is given twice",
      ["-o a.#.png --dpi 3"] = "--dpi", ["-o a.#.png --pegs acme --match"] = "--match goes",
      ["-o a.#.png --dpi 75"] = "with the holes above or below, or give --pegs none",
      ["-o a.#.png"] = "bad.1.png: it does not say its dpi: give --dpi, such as 300",
      ["-o a.#.png --dpi 75 --contact foo.xyz"] = "foo.xyz",
      ["-o a.#.png --ink a=red,b=red,c=red,d=red,e=red,f=red,g=red,h=red,i=red"] =
        "--ink must be 1 to 8 colours by name, got 9",
    } do
      local code, _, text = bench:celspan_inside("scan 'bad.#.png' " .. options)
      assert.is_true(code > 0)
      assert.matches(message, text, 1, true)
    end
  end)
end)
