-- What people write first, by habits from other programs: it works, or the message says what to
-- write.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local with_art = present.type() and it or pending

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function run(arguments, ...) return bench:celspan_inside(arguments, ...) end

--- Runs a command that must fail with this code and these words.
local function refused(code, words, arguments, ...)
  local got, _, message = run(arguments, ...)
  assert.equal(code, got, message)
  assert.is_truthy(message:find(words, 1, true), message)
end

describe("a wrong field of a library function", function()
  -- The call is on line 4, and ends the frame function.
  local function film(call)
    bench:write("film.lua", [[
local celspan, library = require "celspan", require "celspan.]] .. call:match "^%w+" .. [["
local cel = celspan.cel {}
return celspan.film { size = { 64, 36 }, frame = function(f)
  return ]] .. call:gsub("^%w+", "library") .. [[

end }]])
  end

  it("has its line in `return multiplane { ... }` too", function()
    for call, words in pairs {
      ["multiplane { film = { 64, 36 }, focl = 800 }"] = "unknown field 'focl'",
      ["multiplane { film = { 64, 36 }, camera = { rotate = 10 } }"] = "unknown field 'rotate'",
      ["multiplane { film = { 64, 36 }, cel }"] = "plane 1 must be {cel, z = depth}, got a cel",
      ["multiplane { film = { 64, 36 }, { cel, z = 'far' } }"] = "field 'z' must be a number",
      ["multiplane { film = { 64, 36 }, front = { 1 }, { cel } }"] = "front",
      ["shutter { angel = 180 }"] = "unknown field 'angel'",
      ["shutter { angle = 720, frame = print }"] = "field 'angle' must be 0..360",
      ["keys { { 1, 'a' }, { 0, 'b' } }"] = "keys: key 2 is at 0",
      ["keys { lop = 'repeat', { 0, 1 } }"] = "unknown field 'lop'",
    } do
      film(call)
      local _, _, message = run "check film.lua"
      assert.is_truthy(message:find("film.lua:4: ", 1, true), message)
      assert.is_truthy(message:find(words, 1, true), message)
    end
  end)

  it("keeps it where the call stands alone", function()
    local multiplane = require "celspan.multiplane"
    local message = raised.message(function()
      local rostrum = multiplane { film = { 64, 36 }, focl = 800 }
      return rostrum
    end)
    assert.matches("^tests/desk/spec/habits_spec.lua:%d+: multiplane: unknown", message)
  end)
end)

describe("what a frame function returns", function()
  it("is one value, and two are refused", function()
    bench:write("film.lua", [[
return film { size = { 64, 36 }, frames = 1, frame = function()
  return circle { 9, 9, 5 }, circle { 20, 9, 5 }
end }]])
    refused(3, "film.lua:1: the frame function returned two values: write return { a, b }",
      "check film.lua")
  end)
end)

describe("a module that is not there", function()
  it("may be one of celspan's, or the scenery of a recipe", function()
    bench:write("film.lua", 'local rows = require "csv"')
    refused(3, "module 'csv' not found; celspan's own is require \"celspan.csv\":",
      "check film.lua")
    bench:write("film.lua", 'local noto = require "stage.noto"')
    refused(3, "not found; copy the folder scripts/stage of celspan beside the script:",
      "check film.lua")
  end)
end)

describe("a misspelt word", function()
  it("is answered with the nearest of those that are allowed", function()
    for given, meant in pairs { middle = "centre", rigth = "right" } do
      local message = raised.message(function()
        celspan.text { "A", font = "f.ttf", align = given }
      end)
      assert.is_truthy(message:find(('got "%s"; did you mean "%s"?'):format(given, meant), 1, true),
        message)
    end
    local message = raised.message(function()
      celspan.stroke { points = { { 0, 0 }, { 1, 1 } }, join = "mitre" }
    end)
    assert.is_truthy(message:find('did you mean "miter"?', 1, true), message)
    message = raised.message(function()
      celspan.stroke { points = { { 0, 0 }, { 1, 1 } }, join = 3 }
    end)
    assert.is_falsy(message:find("did you mean", 1, true), message)
  end)
end)

describe("artwork instead of a script", function()
  local SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="19.5" height="8">'
    .. '<rect width="10" height="8" fill="#f00"/><blink/></svg>'

  with_art("is a film of one frame, and what is not shown is printed", function()
    bench:shell("mkdir " .. bench.folder .. "/art")
    bench:write("art/hero.svg", SVG)
    local code, _, message = run "render art/hero.svg -o out.png"
    assert.equal(0, code, message)
    assert.is_truthy(message:find("hero.svg: not shown: line 1: blink", 1, true), message)
    local _, out = run "info out.png"
    assert.is_truthy(out:find("size 20x8", 1, true), out)
    local _, red = run "probe art/hero.svg 5 4"
    assert.equal("1 0 0 1\n", red)
    bench:write("hero.svg", "<svg")
    refused(4, "hero.svg", "render hero.svg -o out.png")
  end)

  with_art("is converted to pictures, of any size", function()
    bench:write("hero.svg", SVG)
    local code, _, message = run "convert hero.svg out.png --size 40x16 --crop 0,0,30,16"
    assert.equal(0, code, message)
    local _, out = run "info out.png"
    assert.is_truthy(out:find("size 30x16", 1, true), out)
  end)

  it("is not a picture, and the message names what reads it", function()
    if not present.pictures() then return pending "there is no picture module" end
    bench:write("hero.svg", SVG)
    bench:write("film.lua", [[local celspan = require "celspan"
return celspan.rostrum { celspan.cel { celspan.image { file = "hero.svg" } } }]])
    refused(4, "celspan.svg reads SVG drawings", "check film.lua")
  end)

  it("may be a layered painting", function()
    bench:shell("cp scripts/paintings/valley.ora " .. bench.folder)
    for _, command in ipairs { "render valley.ora --size 120x54 -o out.png",
      "convert valley.ora out.png --size 120x54" } do
      local code, _, message = run(command)
      assert.equal(0, code, message)
      local _, out = run "info out.png"
      assert.is_truthy(out:find("size 120x54", 1, true), out)
      local _, _, _, alpha = celspan.pixels(celspan.rostrum { celspan.cel {
        celspan.image { file = bench.folder .. "/out.png" } } }, { size = { 120, 54 } }):get(60, 27)
      assert.is_true(alpha > 0.9)
    end
  end)
end)

describe("an element without a name", function()
  local SVG = [[
<svg xmlns="http://www.w3.org/2000/svg" width="40" height="10">
<defs><rect id="r" width="10" height="10" fill="#00f"/></defs>
<g><rect class="leaf big" width="10" height="10" fill="#f00"/>
<rect class="leaf" x="10" width="10" height="10" style="fill:lime"/></g>
<use href="#r" x="20"/><use href="#r" x="30"/></svg>]]

  local function read()
    return assert(require "celspan.svg".read(bench:write("leaves.svg", SVG)))
  end

  local function names(art, what)
    local list = {}
    for i, element in ipairs(art:elements(what)) do list[i] = element.name .. element.tag end
    return table.concat(list, " ")
  end

  local function colour(art, x)
    local r, g, b = celspan.probe(celspan.rostrum { celspan.cel { art.object } }, x, 5,
      { film = { 40, 10 } })
    return ("%g %g %g"):format(r, g, b)
  end

  with_art("is found by its place, class, fill or line", function()
    local art = read()
    assert.equal("#3g #4rect #5rect #6use #7use #2rect", names(art))
    assert.equal("#4rect #5rect", names(art, { class = "leaf" }))
    assert.equal("#4rect", names(art, { class = "big", fill = "#F00" }))
    assert.equal("#5rect", names(art, { fill = "#00ff00" }))
    assert.equal("#3g #4rect", names(art, { line = 3 }))
    assert.equal("", names(art, { class = "lea" }))
    assert.are.same({ 10, 0, 10, 10 }, { art:elements({ fill = "#0f0" })[1].object:bounds() })
    assert.is_truthy(raised.message(function() art:elements { colour = "#f00" } end)
      :find("unknown field 'colour'", 1, true))
  end)

  with_art("is changed by its number, wherever it is shown, and again", function()
    local art = read():with { ["#4"] = function(leaf) return leaf:paint "#fff" end,
      ["#2"] = function(box) return box:paint "#000" end }
    assert.equal("1 1 1", colour(art, 5))
    assert.equal("0 1 0", colour(art, 15))
    assert.equal("0 0 0", colour(art, 25))
    assert.equal("0 0 0", colour(art, 35))
    art = art:with { ["#3"] = function(group) return group:fade(0) end }
    assert.equal("0 0 0", colour(art, 5))
    assert.is_truthy(raised.message(function() art:with { ["#9"] = print } end)
      :find("the drawing has no part '#9'", 1, true))
  end)

  with_art("has its number on the sheet of --parts-picture", function()
    read()
    local code, out, message = run "info leaves.svg --parts-picture parts.png"
    assert.equal(0, code, message)
    assert.is_truthy(out:find("element #5 line 4 rect class leaf fill #00ff00\n", 1, true), out)
    local _, facts = run "info parts.png"
    assert.is_truthy(facts:find("size 1044x76", 1, true), facts)
    bench:write("film.lua", "return require 'celspan'.rostrum {}")
    refused(2, "--parts-picture is for SVG drawings", "info film.lua --parts-picture parts.png")
  end)
end)

describe("art:show", function()
  local function puppet()
    local svg = require "celspan.svg"
    return assert(svg.read(bench:write("face.svg", [[
<svg xmlns="http://www.w3.org/2000/svg" width="40" height="10">
<rect id="head" width="40" height="10" fill="#fff"/>
<rect id="mouth A" width="10" height="10" fill="#f00"/>
<rect id="mouth-B" x="10" width="10" height="10" fill="#0f0"/>
<rect id="eyes/open" x="20" width="10" height="10" fill="#00f"/>
<rect id="eyes/shut" x="30" width="10" height="10" fill="#000"/></svg>]])))
  end

  --- The greens at the middles of mouth A, mouth B, eyes open, eyes shut.
  local function greens(art)
    local found = {}
    for i = 1, 4 do
      found[i] = select(2, celspan.probe(celspan.rostrum { celspan.cel { art.object } },
        10 * i - 5, 5, { film = { 40, 10 } }))
    end
    return found
  end

  with_art("shows one part of a set, or none", function()
    local art = puppet()
    assert.are.same({ 0, 1, 0, 0 }, greens(art))
    assert.are.same({ 0, 1, 0, 1 }, greens(art:show { mouth = "A", eyes = "open" }))
    assert.are.same({ 1, 1, 1, 1 }, greens(art:show { mouth = "B", eyes = false }))
  end)

  with_art("shows one child of a group, by its label or else its id", function()
    local svg = require "celspan.svg"
    local INK = 'xmlns:ink="http://www.inkscape.org/namespaces/inkscape"'
    local function drawing(mouth)
      return assert(svg.read(bench:write("group.svg", ([[
<svg xmlns="http://www.w3.org/2000/svg" %s width="40" height="10">
<g id="layer1" ink:label="other"><rect id="r9" ink:label="A" x="30" width="9" height="9"/></g>
<g id="g7" ink:label="mouth">%s</g></svg>]]):format(INK, mouth))))
    end
    local art = drawing [[<g id="g1" ink:label="A"><g id="g2" ink:label="teeth">
<rect width="10" height="10" fill="#0f0"/></g></g>
<rect id="g3" ink:label="C" x="10" width="10" height="10" fill="#0f0"/>
<rect id="g4" x="20" width="10" height="10" fill="#0f0"/>]]
    assert.are.same({ 1, 0, 1, 0 }, greens(art:show { mouth = "A" }))
    assert.are.same({ 0, 1, 1, 0 }, greens(art:show { mouth = "C" }))
    assert.are.same({ 0, 0, 1, 0 }, greens(art:show { g7 = false }))
    art = drawing [[<rect id="A" width="10" height="10" fill="#0f0"/>
<rect id="mouth C" x="10" width="10" height="10" fill="#0f0"/>]]
    assert.are.same({ 1, 0, 0, 0 }, greens(art:show { mouth = "A" }))
    assert.are.same({ 0, 1, 0, 0 }, greens(art:show { mouth = "C" }))
    local rig = require "celspan.puppet" { art = art, switches = { "mouth" },
      joints = { hip = { 0, 0 }, knee = { 0, 9 } },
      bones = { { "thigh", from = "hip", to = "knee", parts = { "other" } } } }
    assert.are.same({ 1, 0, 0, 0 }, greens { object = rig:pose {} })
    assert.are.same({ 0, 1, 0, 0 }, greens { object = rig:pose { mouth = "C" } })
  end)

  with_art("refuses what the drawing does not have", function()
    local art = puppet()
    for words, choices in pairs {
      ["the parts of 'eyes' are open, shut, and not 'shot'; did you mean 'shut'?"] =
        { eyes = "shot" },
      ["no parts named 'nose A'"] = { nose = "A" },
      ["no parts named 'mouht A', 'mouht B' and so on; did you mean 'mouth'?"] = { mouht = "A" },
      ["such as { mouth = \"C\" }, got mouth = number"] = { mouth = 3 },
    } do
      local message = raised.message(function() art:show(choices) end)
      assert.is_truthy(message:find(words, 1, true), message)
      assert.is_truthy(message:find "^tests/desk/spec/habits_spec.lua:", message)
    end
  end)
end)

describe("a line that begins later", function()
  it("has the mouth at rest before it", function()
    local lips = require "celspan.lips"
    local path = bench:write("line.tsv", "0.00\tB\n0.50\tD\n1.00\tX\n")
    local function at(start, ...)
      local track, list = assert(lips.read(path, { fps = 4, hold = 1, start = start })), {}
      for i, frame in ipairs { ... } do list[i] = track:at(frame) end
      return table.concat(list) .. track.frames
    end
    assert.equal("BBDDX4", at(nil, 1, 2, 3, 4, 5))
    assert.equal("XXBBDDX6", at(0.5, 1, 2, 3, 4, 5, 6, 7))
    assert.equal("BDDX3", at(-0.25, 1, 2, 3, 4))
    assert.equal("X0", at(-9, 1))
    assert.is_truthy(raised.message(function() lips.read(path, { start = 1e9 }) end)
      :find("field 'start' must be within 1000000 frames", 1, true))
  end)
end)

describe("--draft", function()
  it("is half the size, even, and without antialiasing", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 50, 21 }, frame = function()
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 20, 10 }, radius = 8,
    texture = "#fff" } } }
end }]])
    assert.equal(0, (run "render film.lua --draft -o draft.png"))
    local _, out = run "info draft.png"
    assert.is_truthy(out:find("size 26x12", 1, true), out)
    assert.equal(0, (run "render film.lua --size 26x12 --antialias none -o small.png"))
    assert.equal(0, (run "compare draft.png small.png"))
    assert.equal(0, (run "render film.lua --draft --scale 2 --antialias area -o large.png"))
    _, out = run "info large.png"
    assert.is_truthy(out:find("size 50x22", 1, true), out)
  end)
end)

describe("a font", function()
  local SCRIPT = [[
local celspan = require "celspan"
return celspan.rostrum { celspan.cel { celspan.text { "A", font = "%s", size = 20 } } }]]

  with_art("that is named and not a file is answered with what a font is", function()
    bench:write("film.lua", SCRIPT:format "Arial")
    refused(4, 'a font is given by its file, such as "arial.ttf"', "check film.lua")
    bench:write("film.lua", SCRIPT:format "arial.ttf")
    refused(4, 'a font of the system is given by its whole path', "check film.lua")
    bench:write("film.lua", SCRIPT:format "type/arial.ttf")
    local _, _, message = run "check film.lua"
    assert.is_falsy(message:find("is given by", 1, true), message)
  end)

  with_art("of the system is read with --allow-system-fonts alone", function()
    local path = bench.folder .. "/home/.fonts/block.ttf"
    bench:shell(("mkdir -p %s/home/.fonts %s/film; cp scripts/type/block.ttf %s")
      :format(bench.folder, bench.folder, path))
    bench:write("film/film.lua", SCRIPT:format(path))
    refused(3, "--allow-system-fonts", "check film/film.lua")
    local code, _, message = bench:inside(("HOME=$PWD/home '%s' check film/film.lua "
      .. "--allow-system-fonts"):format(workbench.absolute))
    assert.equal(0, code, message)
    refused(2, "--allow-system-fonts", "check film/film.lua --trust --allow-system-fonts")
    refused(2, "--allow-system-fonts", "info home/.fonts/block.ttf --allow-system-fonts")
  end)
end)

describe("check --files", function()
  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  --- The lines that celspan prints, and the SHA-256 of these files by another program.
  it("names what a film reads, with sums of files of any length", function()
    local script = { 'local csv = require "celspan.csv"', 'require "part"' }
    for _, size in ipairs { 0, 55, 56, 63, 64, 65, 119, 120, 40000 } do
      bench:write(size .. ".csv", ("a"):rep(size))
      script[#script + 1] = ('pcall(csv.read, "%d.csv")'):format(size)
    end
    script[#script + 1] = 'pcall(csv.read, "none.csv")'
    script[#script + 1] = [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#fff" }
end }]]
    bench:write("part.lua", "return 1")
    bench:write("film.lua", table.concat(script, "\n"))
    local code, out, err = bench:celspan_inside "check film.lua --files"
    assert.equal(0, code, err)
    assert.equal(11, select(2, out:gsub("\n", "")))
    assert.truthy(out:find("script %d+ %x+ film.lua\n"), out)
    assert.truthy(out:find("module 8 %x+ [./]*part.lua\n"), out)
    local sums = {}
    for kind, size, sum, path in out:gmatch "(%l+) (%d+) (%x+) (%C+)\n" do
      if kind == "data" then
        assert.equal(size .. ".csv", path)
        sums[#sums + 1] = sum .. "  " .. path .. "\n"
      end
    end
    bench:write("sums", table.concat(sums))
    assert.equal(0, (bench:inside "sha256sum -c sums"))
    local _, text = bench:celspan_inside "check film.lua --files --json"
    local list = require "celspan.json".decode(text)
    assert.same({ 11, "0.csv", "data", 0 }, { #list, list[2].path, list[2].kind, list[2].size })
    assert.equal(64, #list[1].sha256)
  end)
end)

describe("a film with palettes", function()
  it("is checked for colours that are in none", function()
    bench:write("face.lua", [[
return film { size = { 20, 20 }, space = "srgb", frame = function()
  return union { circle { 10, 10, 8, fill = "#f2c6a0" }, rect { 9, 9, 3, 3, fill = "#ff0000" } }
end }]])
    bench:write("film.lua", [[
return film { size = { 20, 20 }, frames = 4, background = "#9bd1ff",
  palettes = { { skin = "#f2c6a0" }, colour.palette { day = { sky = "#9bd1ff" } } },
  frame = function(f)
    return { circle { 5, 5, 4, fill = f.index > 1 and "#f2c6a1" or "#f2c6a0" }:named "hat",
             image { file = "face.png" } }
  end }]])
    bench:celspan_inside "render face.lua -o face.png --frames 1"
    local _, _, said = run "check film.lua"
    assert.matches("frame 1: #ff0000 is in no palette of the film: %(film.lua:5%), pixel 9,", said)
    assert.matches("warning: frames 3%-4: #f2c6a1 is in no palette of the film: 'hat'", said)
    assert.matches("no faults, 2 warnings", said)
    bench:write("film.lua", [[
return film { frames = 9, palettes = { { skin = "#f2c6a0" } }, frame = function(f)
  local strange = f.index % 2 == 1 and { circle { 5, 5, 4, fill = "#f2c6a1" } } or {}
  for i = 1, 30 do
    strange[i + 1] = circle { 5, 5, 4, fill = ("#%06x"):format(30 * f.index + i - 1) }
  end
  return strange
end }]])
    _, _, said = run "check film.lua"
    assert.matches("frames 2%-8: #f2c6a1 is in no palette of the film, in 4 of these frames: %(",
      said)
    assert.matches("no faults, 256 warnings", said)
    bench:write("film.lua", "return film { palettes = { 7 }, frame = function() end }")
    _, _, said = run "check film.lua"
    assert.matches("film.lua:1: film: palettes%[1%] must be a table of colours by name, got number",
      said)
  end)
end)

describe("a value that is made and thrown away", function()
  --- What check says, from the line on.
  local function said(name)
    local _, _, message = run("check " .. (name or "film.lua"))
    local list = {}
    for line in message:gmatch "celspan: warning: ([^\n]*)" do list[#list + 1] = line end
    return list, message
  end

  it("is reported with its line and what to write", function()
    bench:shell("mkdir " .. bench.folder .. "/parts")
    bench:write("parts/hand.lua", [[
local C = require("celspan")
C.circle { centre = { 0, 0 }, radius = 1 }
return C.rect { 0, 0, 4, 4 }:fade(0.5)]])
    bench:write("film.lua", [[
local celspan, hand = require "celspan", require "parts.hand"
local c = celspan.circle { centre = { 1, 1 }, radius = 3 }
c:translate(10, 0)
c = c:scale(2) c:scale(2)
  :rotate(4)
local cel <const> = celspan.cel { c, hand }
if c then cel:fade(0.5) end
return celspan.film { size = { 8, 8 }, frames = 2, frame = function(f)
  local x = celspan.rect { 0, 0, f.number, 4 }; x:paint "#fff"
  do celspan.rostrum { cel } end
  return celspan.rostrum { cel, celspan.cel { x } }
end }]])
    local unused = " makes a value that nothing uses: return it, give it a name, or put it into "
      .. "another value"
    local function changed(written, name)
      return ("%s makes a new value and does not change %s: write %s = %s"):format(written, name,
        name, written)
    end
    assert.same({ "film.lua:3: " .. changed("c:translate(...)", "c"),
      "film.lua:4: " .. changed("c:scale(...):rotate(...)", "c"),
      "film.lua:7: " .. changed("cel:fade(...)", "cel"),
      'film.lua:9: ' .. changed('x:paint "#fff"', "x"),
      "film.lua:10: celspan.rostrum {...}" .. unused,
      "parts/hand.lua:2: C.circle {...}" .. unused }, (said()))
    local code, out = run "check film.lua --json"
    assert.equal(0, code)
    local first = require "celspan.json".decode(out)[1]
    assert.same({ "warning", "film.lua", 3 }, { first.level, first.file, first.line })
    assert.is_nil(first.frame)
  end)

  it("is not looked for in modules that are not beside the script", function()
    bench:shell("mkdir -p " .. bench.folder .. "/outside")
    bench:write("outside/away.lua", [[
local celspan = require "celspan"
local c = celspan.circle { centre = { 1, 1 }, radius = 3 }
c:scale(2)]])
    local _, place = bench:inside "pwd"
    bench:write("film.lua", ([[
local celspan = require "celspan"
local _ = function() return require "%s.outside.away" end
return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 1, 1 } } }]])
      :format((place:gsub("%s", ""):gsub("/", "."))))
    local _, _, message = bench:celspan_inside "check film.lua"
    assert.is_truthy(message:find("1 frame checked: no faults\n", 1, true), message)
  end)

  it("is what is not used, and not what may be something else", function()
    bench:write("film.lua", [==[
#!/usr/bin/env celspan
local celspan = require "celspan"
local c, random = celspan.circle { centre = { 1, 1 }, radius = 3 }, celspan.random(1)
local d = c:translate(1, 1):fade(0.5) -- c:fade(1)
local _ = c:translate(2, 2)
local list = { c:translate(1, 1); c:fade(1), x = c:scale(2), [c:contains(1, 1)] = d:scale(2) }
list[1], list.x = c:scale(3), c:scale(4)
local text = [[
c:translate(1)]] .. "c:fade(1) \" c:fade(2)" .. 'c:fade(1)' --[=[
c:fade(1) ]] c:fade(1) ]=]
local Ball = {}
function Ball:scale(k) self.k = k return self end
local ball = setmetatable({}, { __index = Ball })
ball:scale(2)
ball.scale(ball, 3):scale(4)
local function mover(c) c:scale(2) return c:scale(3) end
mover(ball)
local both = celspan.rect { 0, 0, 1, 1 }
both = ball
both:scale(2)
local first, second = celspan.rect { 0, 0, 1, 1 }, celspan.rect { 0, 0, 1, 1 }
list.x, first = 1, ball
second, list.x = ball, 1
first:scale(2)
second:scale(2)
for _, c in ipairs { ball } do c:scale(2) end
random(3)
local union = c | d:scale(2)
  - c:fade(0.5)
print(c:bounds(), #text, 0x1p4, 1e-3, 3 // 2, function() return c:scale(2) end)
return celspan.rostrum { celspan.cel { c, d, union,
  c:scale(2) } }]==])
    local list, message = said()
    assert.same({}, list, message)
    assert.is_truthy(message:find("1 frame checked: no faults", 1, true), message)
  end)

  with_art("is a drawing or a puppet in another pose too", function()
    bench:write("face.svg", [[
<svg xmlns="http://www.w3.org/2000/svg" width="40" height="10">
<rect id="head" width="40" height="10"/><rect id="mouth A" width="10" height="10"/>
<rect id="mouth B" width="10" height="10"/></svg>]])
    bench:write("film.lua", [[
local celspan, svg, puppet = require "celspan", require "celspan.svg", require "celspan.puppet"
local art = assert(svg.read "face.svg")
local rig = puppet { art = art, joints = { neck = { 0, 0 }, top = { 9, 0 } },
  bones = { { "head", from = "neck", to = "top" } } }
art:show { mouth = "A" }
rig:pose { head = 3 }
rig:joint({}, "top")
return celspan.rostrum { celspan.cel { art.object, rig:pose {} } }]])
    local list, message = said()
    assert.equal(2, #list, message)
    assert.is_truthy(list[1]:find("film.lua:5: art:show {...} makes a new value and does not "
      .. "change art: write art = art:show {...}", 1, true), message)
    assert.is_truthy(list[2]:find("film.lua:6: rig:pose {...} makes a value that nothing uses", 1,
      true), message)
  end)
end)
