-- Exposure sheets: reading, queries, writing, and the sheets of films. One file, because every
-- format must read what another one writes.
local celspan = require "celspan"
local layers = require "celspan.layers"
local lips = require "celspan.lips"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local sheet = require "celspan.sheet"
local workbench = require "tests.support.workbench"

local material = present.material
local root = io.popen("pwd"):read "l"

local bench, folder

local function write(name, text) return bench:write(name, text) end

setup(function()
  bench = workbench.new()
  folder = bench.folder
  assert(os.execute("mkdir -p " .. folder .. "/shot.oca/body"))
end)

teardown(function() bench:remove() end)

local function read(name, text, options) return sheet.read(write(name, text), options) end

--- The drawings of a layer frame by frame: "1 1 2 .".
local function exposed(s, layer, count)
  local list = {}
  for n = 1, count or s.frames do list[n] = s:at(layer, n) or "." end
  return table.concat(list, " ")
end

--- An XDTS of one table; tracks of cells as JSON.
local function xdts_of(duration, tracks, more, names)
  return ([[exchangeDigitalTimeSheet Save Data
{"version":5,"header":{"cut":"12","scene":"3"},"timeTables":[{"name":"one","duration":%d,
"timeTableHeaders":[{"fieldId":0,"names":[%s]},{"fieldId":3,"names":["Anna"]},
{"fieldId":5,"names":["cam"]}],
"fields":[{"fieldId":0,"tracks":[%s]}%s]}]}]]):format(duration, names or '"A","B"', tracks, more or
  "")
end

local function track(number, entries)
  local list = {}
  for i, entry in ipairs(entries) do
    local values = {}
    for k = 2, #entry do values[k - 1] = ('"%s"'):format(entry[k]) end
    list[i] = ('{"frame":%d,"data":[{"id":0,"values":[%s]}]}'):format(entry[1],
      table.concat(values, ","))
  end
  return ('{"trackNo":%d,"frames":[%s]}'):format(number, table.concat(list, ","))
end

describe("an XDTS", function()
  it("holds drawings through gaps, and is empty before the first", function()
    local s = assert(read("a.xdts", xdts_of(6, track(0, { { 1, "1" }, { 3, "2" } }))))
    assert.are.same({ "A", "B" }, s.layers)
    assert.are.equal(". 1 1 2 2 2", exposed(s, "A"))
    assert.are.equal(". . . . . .", exposed(s, "B"))
    assert.are.same({ 6, 24, "one", "12", "3" }, { s.frames, s.fps, s.name, s.cut, s.scene })
    assert.is_nil(s:at("A", 0))
    assert.is_nil(s:at("A", 7))
  end)

  it("treats hyphens and ticks as continuations", function()
    local s = assert(read("a.xdts", xdts_of(6, track(0, { { 0, "1a" }, { 1, "SYMBOL_HYPHEN" },
      { 2, "SYMBOL_TICK_1" }, { 3, "SYMBOL_TICK_2" }, { 4, "SYMBOL_NULL_CELL" } }))))
    assert.are.equal("1a 1a 1a 1a . .", exposed(s, "A"))
    assert.are.same({ inbetween = true }, s:marks("A", 3))
    assert.are.same({ reverse = true }, s:marks("A", 4))
    assert.are.same({}, s:marks("A", 1))
  end)

  it("sorts entries, and continues those before the sheet into its first frame", function()
    local s = assert(read("a.xdts", xdts_of(4, track(0, { { 2, "9" }, { -3, "7" }, { -1, "8" } }))))
    assert.are.equal("8 8 9 9", exposed(s, "A"))
    s = assert(read("a.xdts", xdts_of(4, track(0, { { 0, "1" }, { -1, "8" } }))))
    assert.are.equal("1 1 1 1", exposed(s, "A"))
  end)

  it("may be shorter than its drawings, but a closing empty cell adds no frame", function()
    assert.are.equal(11,
      assert(read("a.xdts", xdts_of(4, track(0, { { 0, "1" }, { 10, "2" } })))).frames)
    assert.are.equal(4, assert(read("a.xdts",
      xdts_of(4, track(0, { { 0, "1" }, { 4, "SYMBOL_NULL_CELL" } })))).frames)
  end)

  it("gives tracks by number their layers, the lowest rearmost", function()
    local s = assert(read("a.xdts", xdts_of(2, track(2, { { 0, "c" } }) .. ","
      .. track(0, { { 0, "a" } }))))
    assert.are.same({ "A", "B", "track 3" }, s.layers)
    assert.are.equal("c", s:at(3, 1))
    assert.are.equal("a", s:at("A", 1))
  end)

  it("keeps dialogue, camera and fields it does not know as notes", function()
    local s = assert(read("a.xdts", xdts_of(20, track(0, {}), ',{"fieldId":5,"tracks":['
      .. track(0, { { 2, "PAN" }, { 3, "SYMBOL_HYPHEN" }, { 9, "SYMBOL_NULL_CELL" }, { 12, "TU" },
                    { 13, "SYMBOL_HYPHEN" }, { 14, "SYMBOL_HYPHEN" } })
      .. ']},{"fieldId":3,"tracks":[' .. track(0, { { 4, "Anna", "Hello" }, { 5, "SYMBOL_HYPHEN" },
                                                    { 8, "Anna", "Bye" } })
      .. ']},{"fieldId":9,"tracks":[' .. track(0, { { 0, "12F" } }) .. ']}')))
    assert.are.same({
      { kind = "field 9", column = "track 1", from = 1, to = 20, text = "12F" },
      { kind = "camera", column = "cam", from = 3, to = 9, text = "PAN" },
      { kind = "dialogue", column = "Anna", from = 5, to = 6, speaker = "Anna", text = "Hello" },
      { kind = "dialogue", column = "Anna", from = 9, to = 20, speaker = "Anna", text = "Bye" },
      { kind = "camera", column = "cam", from = 13, to = 15, text = "TU" } }, s.notes)
    assert.are.equal(3, #s:notes_at(5))
  end)

  it("may have fields of later programs, an extension, and data beside the drawings", function()
    local text = xdts_of(3,
      '{"trackNo":0,"frames":[{"frame":0,"data":[{"id":1,"values":[true]},'
        .. '{"id":0,"values":["7"]}]}]}',
      ',{"fieldId":7,"tracks":[{"trackNo":0,"frames":[{"frame":0,"data":[{"values":["12F"]}]},'
      .. '{"frame":1,"data":[{"values":[{"folder":1}]}]}]}]},'
      .. '{"fieldId":8,"tracks":{"a":1},"more":[]},'
      .. '{"fieldId":9,"tracks":[' .. track(0, { { 1, "kept" } }) .. ']}')
      :gsub('"version":5', '"version":5,"subversion":"_p1_","later":{}')
    local s = assert(read("a.xdts", text))
    assert.are.equal("7 7 7", exposed(s, "A"))
    assert.are.same({ { kind = "field 9", column = "track 1", from = 2, to = 3, text = "kept" } },
      s.notes)
    text = text:gsub('"header":{.-},', "", 1)
    assert.are.equal("", assert(read("a.xdts", text)).cut)
    local none, message = read("a.xdts", (text:gsub("exchangeDigital", " exchangeDigital", 1)))
    assert.is_nil(none)
    assert.is_truthy(message:find("line 1 is not", 1, true), message)
  end)

  it("reads the options of the extension, and escapes", function()
    local text = xdts_of(4,
      '{"trackNo":0,"frames":[{"frame":1,"data":[{"id":0,"values":["\\u732b"],'
      .. '"options":["OPTION_KEYFRAME","OPTION_REFERENCEFRAME"]}]}]}')
    local s = assert(read("a.xdts", (text:gsub("\n", "\r\n"))))
    assert.are.equal("猫", s:at("A", 2))
    assert.are.same({ key = true, reference = true }, s:marks("A", 2))
  end)

  it("has a table for the number or the name", function()
    local text = 'exchangeDigitalTimeSheet Save Data\n{"version":5,"timeTables":['
      .. '{"name":"a","duration":1,"timeTableHeaders":[]},'
      .. '{"name":"b","duration":2,"timeTableHeaders":[]}]}'
    assert.are.equal(2, assert(read("a.xdts", text, { table = "b" })).frames)
    assert.are.equal(2, assert(read("a.xdts", text, { table = 2 })).frames)
    local _, message = read("a.xdts", text, { table = "c" })
    assert.is_truthy(message:find('timeTables has 2 tables, and none of them is "c"', 1, true))
  end)

  it("is refused with the line or the path", function()
    local head = "exchangeDigitalTimeSheet Save Data\n"
    local cases = {
      [head .. "{\n]"] = "line 3: a name in quotes is missing",
      [head .. "3"] = "the sheet must be an object, got number",
      [head .. "{}"] = "version is missing",
      [head .. '{"version":6}'] = "version is 6; version 5 can be read",
      [head .. '{"version":5}'] = "timeTables is missing",
      [head .. '{"version":5,"timeTables":[]}'] = "timeTables has 0 tables",
      [head .. '{"version":5,"timeTables":[null]}'] = "timeTables[1] must be an object",
      [head .. '{"version":5,"timeTables":[{"timeTableHeaders":[]}]}'] =
        "timeTables[1].duration is missing",
      [head .. '{"version":5,"timeTables":[{"duration":0,"timeTableHeaders":[]}]}'] =
        "timeTables[1].duration must be a whole number from 1 to 10000000, got 0",
      [head .. '{"version":5,"timeTables":[{"duration":1e300,"timeTableHeaders":[]}]}'] =
        "timeTables[1].duration must be a whole number from 1 to 10000000, got 1e+300",
      [xdts_of(3, '{"trackNo":0},{"trackNo":0}')] =
        "timeTables[1].fields[1].tracks[2].trackNo 0 is a duplicate",
      [xdts_of(3, '{"trackNo":-1}')] =
        "timeTables[1].fields[1].tracks[1].trackNo must be a whole number from 0 to "
        .. "65535, got -1",
      [xdts_of(3, ""):gsub('"name"', '"width":640,"name"')] = "timeTables[1].height is missing",
      [xdts_of(3, ""):gsub('"name"', '"width":0,"height":9,"name"')] =
        "timeTables[1].width must be a whole number from 1 to 1048576, got 0",
      [xdts_of(3, '{"trackNo":0,"frames":[{"frame":"x"}]}')] =
        "timeTables[1].fields[1].tracks[1].frames[1].frame must be a number, got string",
      [xdts_of(3, '{"trackNo":0,"frames":[{"frame":0,"data":[{"values":[true]}]}]}')] =
        "timeTables[1].fields[1].tracks[1].frames[1].data[1].values[1] must be a string, "
        .. "got boolean",
    }
    for text, wanted in pairs(cases) do
      local s, message = read("bad.xdts", text)
      assert.is_nil(s)
      assert.is_truthy(message:find(wanted, 1, true), message)
      assert.is_truthy(message:find("bad.xdts", 1, true), message)
    end
  end)

  it("of the material has the known values", function()
    if not material then return pending "CELSPAN_MATERIAL is not set" end
    local s = assert(sheet.read(material .. "/xdts/export-single-a.xdts"))
    assert.are.same({ 144, 24, "001", "001", "" }, { s.frames, s.fps, s.name, s.cut, s.scene })
    assert.are.same({ { frame = 1, drawing = "A1" }, { frame = 5, drawing = "A2" } }, s:changes "A")
    assert.are.equal("A1 A1 A1 A1 A2", exposed(s, "A", 5))
    assert.are.equal("A2", s:at("A", 144))
  end)
end)

describe("the CSV of TVPaint and Krita", function()
  local text =
    'UTF-8, TVPaint, "CSV 1.0"\r\nProject Name, Width, Height, Frame Count, Layer Count, '
    .. 'Frame Rate, Pixel Aspect Ratio, Field Mode\r\n"shot ""1"", a", 640, 480, 4, 2, 12.000000, '
    .. '1.000000, Progressive\r\n#Layers, "ground", "hero, left"\r\n#Density, 1.000000, '
    .. '0.500000\r\n'
    .. '#Blending, "Color", "Multiply"\r\n#Visible, 1, 0\r\n'
    .. '#00000, "a.frames/frame00-00000.png", ""\r\n#00001, "a.frames/frame00-00000.png", '
    .. '"x.png"\r\n'
    .. '#00002, "", "x.png"\r\n#00003, "", "y.png"\r\n'

  it("can have empty cels, holds and layers", function()
    local s = assert(read("a.csv", text))
    assert.are.same({ 'shot "1", a', 640, 480, 12, 4 },
      { s.name, s.width, s.height, s.fps, s.frames })
    assert.are.same({ "ground", "hero, left" }, s.layers)
    assert.are.equal("a.frames/frame00-00000.png a.frames/frame00-00000.png . .", exposed(s, 1))
    assert.are.equal(". x.png x.png y.png", exposed(s, 2))
    assert.are.same({ opacity = 0.5, blend = "multiply", visible = false }, s.looks[2])
    assert.are.same({ opacity = 1, blend = "normal", visible = true }, s.looks[1])
  end)

  it("is written as it was read", function()
    local s = assert(read("a.csv", text))
    local path = folder .. "/b.csv"
    assert.is_true(s:write(path))
    assert.are.equal(text, bench:read(path))
  end)

  it("is refused by line", function()
    for wanted, bad in pairs {
      ["line 8: a quote is not closed"] = text:gsub('00000.png", ""', '00000.png", "', 1),
      ["line 9 has 3 cells; there are 2 layers"] = text:gsub('"x.png"', '"x.png", "z"', 1),
      ['line 8 begins with "7"'] = text:gsub("#00000", "7"),
      ["line 3: frame rate"] = text:gsub("12%.000000", "fast"),
      ["line 11: frame 10000000 is beyond 10000000"] = text:gsub("#00003", "#010000000"),
      ["frame 1" .. ("0"):rep(30) .. " is beyond"] = text:gsub("#00003", "#01" .. ("0"):rep(30)),
    } do
      local s, message = read("a.csv", bad)
      assert.is_nil(s)
      assert.is_truthy(message:find(wanted, 1, true), message)
    end
  end)
end)

it("the CSV of Clip Studio has folders, marks and holds", function()
  local s =
    assert(read("a.csv", "\239\187\191,,chars/main,\n,BG,A,B\n1,1,1,\n2,,○,2\n3,,●,×\n4,,2,\n"))
  assert.are.same({ "BG", "chars/main/A", "B" }, s.layers)
  assert.are.equal("1 1 1 1", exposed(s, "BG"))
  assert.are.equal("1 1 1 2", exposed(s, "chars/main/A"))
  assert.are.equal(". 2 . .", exposed(s, "B"))
  assert.are.same({ inbetween = true }, s:marks("chars/main/A", 2))
  assert.are.same({ reverse = true }, s:marks("chars/main/A", 3))
  local none, message = read("a.csv", ",A\n,B\nx,1\n")
  assert.is_nil(none)
  assert.is_truthy(message:find('line 3 begins with "x"', 1, true), message)
  assert.is_truthy(select(2, read("a.csv", ",A\n,\130\1\n1,1\n")):find "not UTF%-8")
end)

local document = [[{"name":"shot","frameRate":12,"width":8,"height":8,"startTime":2,"endTime":8,
"layers":[
    {"name":"body","type":"paintlayer","frames":[
      {"name":"b2","fileName":"body\\b2.png","frameNumber":4,"duration":2,"width":8,"height":8,
      "position":[4,4]},
      {"name":"b1","fileName":"body/b1.png","frameNumber":0,"duration":4.0,"width":8,"height":8,
      "position":[4.0,4.0]},
      {"name":"_blank","fileName":"","frameNumber":6,"duration":1}]},
    {"name":"group","type":"grouplayer","childLayers":[{"name":"bg","animated":false,"opacity":0.5,
      "frames":[{"name":"","fileName":"body/b1.png","frameNumber":0}]}]}]}]]

describe("an OCA folder", function()
  it("has durations, gaps, groups, and layers that do not change", function()
    write("shot.oca/shot.oca", document)
    local s = assert(sheet.read(folder .. "/shot.oca"))
    assert.are.same({ 6, 12, "shot", 8 }, { s.frames, s.fps, s.name, s.width })
    assert.are.same({ "body", "group/bg" }, s.layers)
    assert.are.equal("b1 b1 b2 b2 . .", exposed(s, "body"))
    assert.are.equal("b1 b1 b1 b1 b1 b1", exposed(s, "group/bg"))
    assert.are.equal(0.5, s.looks[2].opacity)
    assert.are.equal("b2", assert(sheet.read(folder .. "/shot.oca/shot.oca")):at("body", 3))
  end)

  it("counts from its start, and hides layers that are for reference", function()
    local s = assert(read("one.json", (document:gsub('"startTime":2', '"startTime":-1')
      :gsub('"animated":false', '"animated":false,"reference":true'))))
    assert.are.equal(9, s.frames)
    assert.are.equal(". b1 b1 b1 b1 b2 b2 . .", exposed(s, "body"))
    assert.is_false(s.looks[2].visible)
    assert.is_true(s.looks[1].visible)
  end)

  it("draws with its own layers", function()
    local pixel = celspan.pixels(celspan.rostrum { back = "#fff" }, { size = { 8, 8 } })
    assert(pixel:write(folder .. "/shot.oca/body/b1.png"))
    assert(pixel:write(folder .. "/shot.oca/body/b2.png"))
    write("shot.oca/shot.oca", document)
    local s = assert(sheet.read(folder .. "/shot.oca"))
    local tree = assert(layers.read(folder .. "/shot.oca"))
    assert.are.equal(tree:find("body/b2").object, s:drawing("body", 3, tree))
    assert.is_nil(s:drawing("body", 5, tree))
  end)

  it("is refused if it is a folder in a folder, or contains no document", function()
    assert(os.execute("mkdir -p " .. folder .. "/deep.oca/inner.oca"))
    assert.is_truthy(select(2, sheet.read(folder .. "/deep.oca"))
      :find("inner.oca: is not a file; a text must be one", 1, true))
    local _, message = sheet.read(folder .. "/deep.oca/inner.oca")
    assert.is_truthy(message:find("contains no OCA document", 1, true))
  end)

  it("is refused by layer and frame", function()
    for wanted, bad in pairs {
      ["layer 1: frame 1: frameNumber must be a number, got string"] =
        document:gsub('"frameNumber":4', '"frameNumber":"4"'),
      ["layer 2: layer 1: opacity must be a number from 0 to 1, got 5"] =
        document:gsub('"opacity":0.5', '"opacity":5'),
      ["frameRate must be a number from 0.001 to 1000, got 0"] =
        document:gsub('"frameRate":12', '"frameRate":0'),
      ["not an OCA document"] = '{"a":1}',
    } do
      local s, message = read("bad.json", bad)
      assert.is_nil(s)
      assert.is_truthy(message:find(wanted, 1, true), message)
    end
  end)
end)

describe("the text", function()
  local text = 'celspan sheet 1\nname "a \\"b\\""\nfps 12.5\nframes 5\n# remark\n'
    .. 'note dialogue "A" 2-4 "Anna" "Hi\\nyou"\nlayers  A  "b c"\n  1  1/ik  -\n\n  2  |/r  "x '
    .. 'y"/m\n  4  |  |\n'

  it("is read", function()
    local s = assert(read("a.txt", text))
    assert.are.same({ 'a "b"', 12.5, 5 }, { s.name, s.fps, s.frames })
    assert.are.equal("1 1 1 1 1", exposed(s, "A"))
    assert.are.equal(". x y x y x y x y", exposed(s, "b c"))
    assert.are.same({ inbetween = true, key = true }, s:marks("A", 1))
    assert.are.same({ moved = true }, s:marks("b c", 2))
    assert.are.same({ { kind = "dialogue", column = "A", from = 2, to = 4, speaker = "Anna",
                        text = "Hi\nyou" } }, s.notes)
    assert.are.equal(s:text(), assert(read("b.txt", s:text())):text())
  end)

  it("is refused by line", function()
    for wanted, bad in pairs {
      ["line 3: fps must be a number"] = text:gsub("12%.5", "fast"),
      ["line 8 has 1 cells; there are 2 layers"] = text:gsub("  %-\n", "\n", 1),
      ["line 8: \"q\" is not a mark"] = text:gsub("1/ik", "1/q"),
      ["line 10: frame 1 follows frame 1"] = text:gsub("\n  2", "\n  1"),
      ["line 6: the note ends before it begins"] = text:gsub("2%-4", "4-2"),
      ["line 2: a quote is not closed"] = text:gsub('b\\""', "b"),
      ["line 5 begins with \"remark\""] = text:gsub("# ", ""),
      ["line 8: frame 0"] = text:gsub("\n  1", "\n  0"),
      ["line 2: \\q is not an escape"] = text:gsub('a \\"b', "a \\qb"),
    } do
      local s, message = read("a.txt", bad)
      assert.is_nil(s)
      assert.is_truthy(message:find(wanted, 1, true), message)
    end
  end)
end)

-- ---------------------------------------------------------------- asking

describe("a sheet", function()
  local s = sheet.new { layers = { "A", "B" }, frames = 9,
                        drawings = { A = { [1] = "1", [3] = "A2b", [5] = false, [7] = "3" } } }

  it("can be made from tables", function()
    assert.are.equal("1 1 A2b A2b . . 3 3 3", exposed(s, "A"))
    assert.are.equal(12, sheet.new { layers = { "A" }, drawings = { A = { [12] = "x" } } }.frames)
  end)

  it("is refused with the reason", function()
    for wanted, given in pairs {
      ["unknown field 'layer'; did you mean 'layers'?"] = { layer = {} },
      ["layers[2]: \"A\" is a duplicate"] = { layers = { "A", "A" } },
      ["drawings: B must be a layer"] = { layers = { "A" }, drawings = { B = {} } },
      ["a frame must be a whole number from 1 to 10000000, got 0"] =
        { layers = { "A" }, drawings = { A = { [0] = "1" } } },
      ["frame 1 must be a name, or false if empty, got number"] =
        { layers = { "A" }, drawings = { A = { 1 } } },
      ["its frame rate is 0"] = { fps = 0 },
      ["frames must be a whole number"] = { frames = 1.5 },
      ["notes[1]: text is missing"] = {
        notes = { { kind = "camera", column = "", from = 1 } } },
      ["a drawing's name is empty"] = { layers = { "A" }, drawings = { A = { "" } } },
    } do
      local message = raised.sentence(function() sheet.new(given) end)
      assert.is_truthy(message:find(wanted, 1, true), message)
    end
  end)

  it("suggests the nearest layer", function()
    local hand = sheet.new { layers = { "hand" } }
    local message = raised.sentence(function() hand:at("hnad", 1) end)
    assert.is_truthy(message:find("there is no layer 'hnad'; did you mean 'hand'?", 1, true),
      message)
    message = raised.sentence(function() hand:at("hand", 0 / 0) end)
    assert.is_truthy(message:find("got nan", 1, true), message)
  end)

  it("returns drawings from tables, functions and patterns", function()
    local dot = celspan.circle { centre = { 0, 0 }, radius = 1 }
    assert.are.equal(dot, s:drawing("A", 1, { ["1"] = dot }))
    assert.are.equal(dot, s:drawing("A", 1, { dot }))
    assert.are.equal("A2b", s:drawing("A", 3, function(name) return name end))
    assert.is_nil(s:drawing("A", 5, {}))
    local message = raised.sentence(function() s:drawing("A", 7, { dot }) end)
    assert.is_truthy(message:find('layer "A" shows "3" at frame 7', 1, true), message)
  end)

  local it_reads_pictures = present.pictures() and it or pending
  it_reads_pictures("returns the files of a pattern", function()
    assert(os.execute("mkdir -p " .. folder .. "/A2b"))
    local pixel = celspan.pixels(celspan.rostrum { back = "#fff" }, { size = { 2, 2 } })
    for pattern, file in pairs { ["hand_####.png"] = "hand_0002b.png", ["*/x#.png"] = "A2b/x#.png",
                                 ["hand_*.png"] = "hand_A2b.png", ["#.png"] = "2b.png" } do
      assert(pixel:write(folder .. "/" .. file))
      local image = s:drawing("A", 3, folder .. "/" .. pattern)
      assert.are.equal(folder .. "/" .. file, image.file)
    end
    local message = raised.sentence(function() s:drawing("A", 1, folder .. "/none_##.png") end)
    assert.is_truthy(message:find("none_01.png", 1, true), message)
  end)

  it("lets no name lead out of its folder", function()
    for _, name in ipairs { "../x", "/etc/x", "a/../../x", "C:x", "a\\..\\..\\x", "a\nb" } do
      local bad = sheet.new { layers = { "A" }, drawings = { A = { name } } }
      local message = raised.sentence(function() bad:drawing("A", 1, "*.png") end)
      assert.is_truthy(message:find("cannot be part of a file's name", 1, true), message)
    end
    local bad = sheet.new { layers = { "A" }, drawings = { A = { "../7" } } }
    assert.is_truthy(raised.sentence(function()
      bad:drawing("A", 1, "#.png")
    end):find "has no number")
  end)

  it("follows the time of a film with other frames per second", function()
    local ones = {}
    for n = 1, 12 do ones[n] = tostring(n) end
    local twelve = sheet.new { fps = 12, layers = { "A" }, drawings = { A = ones } }
    local list = {}
    local film = celspan.film { frames = 24, frame = function(f)
      list[f.number] = twelve:drawing("A", f, function(name) return name end)
      return celspan.rostrum {}
    end }
    for n = 1, 24 do film:at(n) end
    assert.are.equal("1 1 2 2 3 3 4 4 5 5 6 6 7 7 8 8 9 9 10 10 11 11 12 12",
      table.concat(list, " "))
  end)

  it("shows every one of its frames at any frame rate", function()
    for _, fps in ipairs { 12, 23.976, 24, 25, 29.97, 30, 60, 120 } do
      local names = {}
      for n = 1, 300 do names[n] = tostring(n) end
      local same = sheet.new { fps = fps, layers = { "A" }, drawings = { A = names } }
      local film = celspan.film { fps = fps, frames = 300, frame = function(f)
        assert.are.equal(tostring(f.number), same:drawing("A", f, function(name) return name end))
        return celspan.rostrum {}
      end }
      for n = 1, 300 do film:at(n) end
    end
  end)
end)

-- ---------------------------------------------------------------- write and read

--- A random sheet, each with its own seed, so that failures can be repeated.
local function random_sheet(seed)
  local random = celspan.random(seed)
  local words = { "1", "2", "3a", "-", "|", "a b", 'q"', "\\", "x/y", "猫", "a,b", "#1", " ", "\\n1",
    "1/m" }
  local marks = { "inbetween", "reverse", "key", "reference" }
  local frames = random("frames", 1, 40)
  local given = { fps = random("fps", 1, 60), frames = frames,
    name = words[random("name", 1, #words)],
                  layers = {}, drawings = {}, marks = {}, notes = {}, scene = "1", cut = "" }
  for l = 1, random("layers", 1, 5) do
    local layer = words[l] .. l
    given.layers[l], given.drawings[layer], given.marks[layer] = layer, {}, {}
    for n = 1, frames do
      local label = l .. " " .. n
      if random("change " .. label) < 0.3 then
        given.drawings[layer][n] = random("empty " .. label) > 0.2
          and words[random(label, 1, #words)]
      end
      if random("mark " .. label) < 0.1 then
        given.marks[layer][n] = marks[random("m" .. label, 1, 4)]
      end
    end
  end
  local from = 1
  while random("note " .. from) < 0.7 and from <= frames do
    local to = math.min(frames, from + random("to " .. from, 0, 5))
    local is_spoken = random("kind " .. from) < 0.5
    given.notes[#given.notes + 1] = { kind = is_spoken and "dialogue" or "camera", column = "c",
      from = from,
      to = to, speaker = is_spoken and "Anna" or nil,
      text = words[random("text " .. from, 1, #words)] }
    from = to + 1
  end
  return sheet.new(given)
end

--- The results of all queries of a sheet.
local function content(s, without_notes)
  local all = { s.name, s.fps, s.frames, s.layers, without_notes or s.notes }
  for i in ipairs(s.layers) do
    local marks = {}
    for n = 1, s.frames do marks[n] = without_notes and 0 or s:marks(i, n) end
    all[#all + 1] = { s:changes(i), marks, exposed(s, i) }
  end
  return all
end

--- A value as text, in one order.
local function said(value)
  if type(value) ~= "table" then
    return type(value) == "string" and ("%q"):format(value) or tostring(value)
  end
  local keys, parts = {}, {}
  for key in pairs(value) do keys[#keys + 1] = key end
  table.sort(keys, function(a, b) return said(a) < said(b) end)
  for i, key in ipairs(keys) do parts[i] = said(key) .. "=" .. said(value[key]) end
  return "{" .. table.concat(parts, " ") .. "}"
end

describe("a written sheet is read back unchanged", function()
  for _, ending in ipairs { "xdts", "txt", "csv" } do
    it("as " .. ending, function()
      local path = folder .. "/random." .. ending
      for seed = 1, 150 do
        local s = random_sheet(seed)
        assert.is_true(s:write(path))
        local again = assert(sheet.read(path), seed)
        local is_csv = ending == "csv" or nil
        assert.are.equal(said(content(s, is_csv)), said(content(again, is_csv)), "seed " .. seed)
      end
    end)
  end

  it("and a file that cannot be written is reported", function()
    local s = sheet.new { layers = { "A" } }
    assert.is_nil(s:write(folder .. "/none/a.txt"))
    assert.is_truthy(select(2, s:write "a.doc"):find "sheets are written as .xdts, .csv or .txt")
  end)
end)

it("truncations and changed bytes cause at most a message", function()
  local s = random_sheet(7)
  local texts = {}
  for _, ending in ipairs { "xdts", "txt", "csv" } do
    local path = folder .. "/whole." .. ending
    assert.is_true(s:write(path))
    texts[ending] = bench:read(path)
  end
  texts.oca = document
  for ending, text in pairs(texts) do
    local random = celspan.random(ending)
    for n = 1, 400 do
      local at = random("at " .. n, 1, #text)
      local cut = text:sub(1, at - 1)
      local changed = cut .. string.char(random("byte " .. n, 0, 255)) .. text:sub(at + 1)
      for _, bad in ipairs { cut, changed } do
        local made, message = read("bad." .. ending, bad)
        assert.is_true(made ~= nil or type(message) == "string")
        if made then made:text() end
      end
    end
  end
end)

it("damaged sheets of every format are refused, or can be read and written", function()
  local fuzz = require "tests.fuzz.sheets"
  assert.is_true(fuzz.run(300, 1, folder) > 150)
end)

it("a small sheet can be read by a script with little memory", function()
  write("small.txt", "celspan sheet 1\nfps 12\nframes 2\nlayers A\n 1 a\n")
  write("small.lua", [[local celspan, sheet = require "celspan", require "celspan.sheet"
    local s = assert(sheet.read "small.txt")
    return celspan.film { size = { 8, 8 }, frames = s.frames, frame = function() return
      celspan.rostrum {} end }]])
  assert.are.equal(0, (bench:celspan("check %s/small.lua --limit memory=60M", folder)))
end)

describe("a sheet of few words and millions of frames", function()
  local text = "celspan sheet 1\nfps 24\nframes 10000000\nnote camera A 2-9000000 PAN\n"
    .. "layers A B C D E F G H I J\n1 1 1 1 1 1 1 1 1 1 1\n9999999 2" .. (" |"):rep(9) .. "\n"

  it("is written without the frames on which nothing changes", function()
    local s = assert(read("far.txt", text))
    assert.is_true(#s:text() < 500)
    local again = assert(read("again.txt", s:text()))
    assert.are.equal(s:text(), again:text())
    assert.are.equal("2", again:at("A", 9999999))
    assert.are.equal("1", again:at("J", 10000000))
    local path = folder .. "/far.xdts"
    assert.is_true(s:write(path))
    assert.is_true(#bench:read(path) < 10000)
    local note = assert(sheet.read(path)).notes[1]
    assert.are.same({ 2, 9000000 }, { note.from, note.to })
  end)

  it("is refused if it would become an endless text", function()
    local path = folder .. "/far.csv"
    local done, message = assert(read("far.txt", text)):write(path)
    assert.is_nil(done)
    assert.is_truthy(message:find("far.csv: it would have 10000000 rows of 11 cells, more "
      .. "than 100000000", 1, true), message)
    assert.is_nil(io.open(path))
    assert.are.equal(5, (bench:celspan("sheet %s/far.txt -o %s", folder, path)))
    local names = {}
    for i = 1, 20000 do names[i] = "L" .. i end
    local drawings = {}
    for i = 1, 20000 do drawings[names[i]] = { [i] = "1" } end
    local wide = sheet.new { layers = names, drawings = drawings }
    local none, problem = wide:text()
    assert.is_nil(none)
    assert.is_truthy(problem:find("20000 rows of 20001 cells", 1, true), problem)
    assert.is_true(wide:write(folder .. "/wide.xdts"))
    local code, _, err = bench:celspan("sheet %s/wide.xdts", folder)
    assert.are.equal(6, code)
    assert.is_truthy(err:find("wide.xdts: it would have 20000 rows", 1, true))
  end)
end)

-- Builds with sanitizers, for which CELSPAN_SCENES is set, read a sheet of a fiftieth.
local LAST = os.getenv "CELSPAN_SCENES" and 2000 or 100000

it("a sheet of " .. LAST .. " frames and 200 columns is read again", function()
  local names, drawings = {}, {}
  for l = 1, 200 do
    names[l] = "layer" .. l
    local changes = {}
    for n = 1, LAST, 90 do changes[n] = tostring(n) end
    drawings[names[l]] = changes
  end
  local s = sheet.new { layers = names, drawings = drawings, frames = LAST }
  for _, ending in ipairs { "txt", "csv", "xdts" } do
    local path = folder .. "/large." .. ending
    assert.is_true(s:write(path))
    local again = assert(sheet.read(path))
    assert.are.equal(tostring(LAST - (LAST - 1) % 90), again:at(200, LAST))
  end
end)

-- ---------------------------------------------------------------- films

describe("the sheet of a film", function()
  local hand = celspan.rect { 0, 0, 10, 10 }
  local fist = celspan.circle { centre = { 5, 5 }, radius = 5 }

  local function sheet_of(count, frame)
    return sheet.of(celspan.film { frames = count, frame = frame })
  end

  it("distinguishes drawing from placement", function()
    local s = sheet_of(6, function(f)
      local art = (f.number < 4 and hand or fist):translate(f.number == 3 and 5 or 0, 0)
      return celspan.rostrum { celspan.cel { art:named "hand",
        front = f.number == 6 and { 2, 2, 2 } or nil } }
    end)
    assert.are.same({ "cel 1", "hand" }, s.layers)
    assert.are.equal("1 1 1 2 2 2", exposed(s, "hand"))
    assert.is_true(s:marks("hand", 3).moved)
    assert.is_true(s:marks("hand", 4).moved)
    assert.are.same({}, s:marks("hand", 2))
    assert.are.same({}, s:marks("hand", 6))
    assert.is_true(s:marks("cel 1", 6).moved)
    assert.are.equal("1 1 2 3 3 3", exposed(s, "cel 1"))
  end)

  it("counts fade, viewport, defocus and lights of a cel as its placement", function()
    local changes = { {}, { opacity = 0.5 }, { viewport = { 0, 0, 9, 9 } }, { defocus = 2 },
      { back = "#fff" } }
    local s = sheet_of(#changes, function(f)
      local desc = { hand, table.unpack {} }
      for name, value in pairs(changes[f.number]) do desc[name] = value end
      return celspan.rostrum { celspan.cel(desc):named "c" }
    end)
    assert.are.equal("1 1 1 1 1", exposed(s, "c"))
    for n = 2, #changes do assert.is_true(s:marks("c", n).moved, n) end
  end)

  it("has the drawings of a multiplane camera as it rests", function()
    local multiplane = require "celspan.multiplane"
    local function frame(f)
      return multiplane { film = { 32, 18 }, aperture = 5,
        camera = { x = 4 * f.number, z = 100 * f.number }, { hand, z = 800 },
        { fist:translate(f.number == 3 and 2 or 0, 0), z = 0 } }
    end
    for _, made in ipairs { frame, function(f) return { { frame(f), 1 } } end } do
      local s = sheet_of(3, made)
      assert.are.same({ "cel 1", "cel 2" }, s.layers)
      assert.are.equal("1 1 1", exposed(s, "cel 1"))
      assert.are.equal("1 1 2", exposed(s, "cel 2"))
      assert.are.same({}, s:marks("cel 1", 3))
    end
    write("depth.lua", [[
return film { size = { 32, 18 }, frames = 3, frame = function(f)
  return multiplane { film = { 32, 18 }, camera = { x = f.number }, { rect { 0, 0, 9, 9 }, z = 9 } }
end }
]])
    local code, out = bench:celspan_inside "sheet depth.lua"
    assert.are.equal(0, code)
    assert.matches("1 *1\n *2 *|\n *3 *|\n", out)
  end)

  it("names the parts of a rostrum that has a name, such as a shot, by it", function()
    local s = sheet_of(2, function(f)
      local shot = celspan.rostrum { size = { 20, 20 },
        celspan.cel { hand:named "nell" }:named "nell", celspan.cel { fist } }
      shot = shot:named(f.number == 1 and "day" or "night")
      return celspan.rostrum { celspan.cel { shot }, celspan.cel { hand }:named "sign" }
    end)
    assert.are.same({ "cel 1", "day", "day/nell", "day/nell (object)", "day/cel 2", "sign", "night",
                      "night/nell", "night/nell (object)", "night/cel 2" }, s.layers)
    write("day.lua", [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function shot()
  return celspan.film { size = { 9, 9 }, fps = 24, frames = 3, frame = function()
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 9, 9 } }:named "nell",
      celspan.cel { celspan.rect { 0, 0, 9, 9 } } }
  end }
end
return cut { { film = shot(), name = "day" }, cut.dissolve(1 / 24), shot() }
]])
    local code, out = bench:celspan_inside "sheet day.lua --json"
    assert.are.equal(0, code)
    local names = {}
    for name in out:gmatch '"name": "([^"]+)"' do names[#names + 1] = name end
    table.sort(names)
    assert.are.same({ "day/cel 2", "day/nell", "shot 2/cel 2", "shot 2/nell" }, names)
  end)

  it("recognises a drawing that returns, and frames without one", function()
    local s = sheet_of(5, function(f)
      local art = ({ hand, fist, hand })[f.number]
      return celspan.rostrum { celspan.cel { art and art:named "hand" }:named "c" }
    end)
    assert.are.equal("1 2 1 . .", exposed(s, "hand"))
  end)

  it("counts cels of two exposures once", function()
    local s = sheet_of(4, function(f)
      local rostrum = celspan.rostrum { celspan.cel { hand:named "hand" }:named "c" }
      return f.number > 2 and { { rostrum, 0.5 }, { rostrum, 0.5 } } or rostrum
    end)
    assert.are.equal("1 1 1 1", exposed(s, "hand"))
    assert.are.same({}, s:marks("c", 3))
  end)

  it("includes booleans and compositions, and separates names of two kinds", function()
    local s = sheet_of(2, function(f)
      local inner = celspan.rostrum { size = { 20, 20 },
        celspan.cel { celspan.union { hand:fade(f.number / 2):named "x", fist } } }
      return celspan.rostrum { celspan.cel { inner }:named "x" }
    end)
    assert.are.same({ "x", "x (object)" }, s.layers) -- the inner cel is no part of its own
    assert.are.equal("1 1", exposed(s, "x (object)"))
    assert.is_true(s:marks("x (object)", 2).moved)
    assert.are.equal("1 2", exposed(s, "x"))
  end)

  it("marks procedures and does not treat them as changed", function()
    local s = sheet_of(3, function()
      return celspan.rostrum { celspan.cel { celspan.scanline { bounds = { 0, 0, 9, 9 },
        spans = function() return {} end }:named "fire" } }
    end)
    assert.are.equal("procedure procedure procedure", exposed(s, "fire"))
    assert.are.same({ procedure = true }, s:marks("fire", 2))
  end)

  it("names exactly the frames on which the mouth of the demo changes", function()
    local path = folder .. "/demo.txt"
    assert.are.equal(0, (bench:celspan("sheet '%s/scripts/demo.lua' -o %s", root, path)))
    local s = assert(sheet.read(path))
    local mouths = assert(lips.read(root .. "/scripts/demo/line.tsv", { fps = 24 }))
    local wanted, found, numbers, count = {}, {}, {}, 0
    for n = 1, s.frames do
      local shape = mouths:at(n)
      if shape ~= mouths:at(n - 1) or n == 1 then
        if not numbers[shape] then
          count = count + 1
          numbers[shape] = tostring(count)
        end
        wanted[#wanted + 1] = { frame = n, drawing = numbers[shape] }
      end
    end
    for i, change in ipairs(s:changes "mouth") do found[i] = change end
    assert.are.same(wanted, found)
    assert.is_true(#found > 40)
  end)
end)

-- ---------------------------------------------------------------- lip sync and the command

it("the lip-sync material is exposed frame by frame", function()
  if not material then return pending "CELSPAN_MATERIAL is not set" end
  for _, path in ipairs { "espeak/fox", "espeak/peter", "human/austen-0880",
    "human/austen-0930" } do
    local mouths = assert(lips.read(material .. "/lipsync/" .. path .. ".rhubarb.tsv"))
    local drawings = {}
    for n = 1, mouths.frames do drawings[n] = mouths:at(n) end
    local s = sheet.new { fps = mouths.fps, frames = mouths.frames, layers = { "mouth" },
      drawings = { mouth = drawings } }
    local file = folder .. "/lips.xdts"
    assert.is_true(s:write(file))
    local again = assert(sheet.read(file))
    assert.are.equal(mouths.frames, again.frames)
    for n = 1, mouths.frames do assert.are.equal(mouths:at(n), again:at("mouth", n)) end
  end
end)

describe("celspan sheet", function()
  local function run(arguments)
    return bench:celspan("sheet %s", arguments)
  end

  it("keeps the size in every format, and says where none is known", function()
    local made = sheet.new { layers = { "A" }, width = 640, height = 360 }
    local text = write("sized.txt", made:text())
    local xdts, csv = folder .. "/sized.xdts", folder .. "/sized.csv"
    assert.are.equal(0, (run(text .. " -o " .. xdts)))
    local code, _, err = run(xdts .. " -o " .. csv)
    assert.are.same({ 0, "" }, { code, err })
    for _, path in ipairs { xdts, csv } do
      local s = assert(sheet.read(path))
      assert.are.same({ 640, 360 }, { s.width, s.height })
    end
    local bare = write("bare.xdts", xdts_of(3, track(0, { { 0, "1" } })))
    assert.is_nil(assert(sheet.read(bare)).width)
    code, _, err = run(bare .. " -o " .. csv)
    assert.are.equal(0, code)
    assert.is_truthy(err:find("bare.xdts has no size: .*sized.csv says 1920 x 1080"), err)
    assert.are.equal(1920, assert(sheet.read(csv)).width)
  end)

  it("prints and converts", function()
    local path = write("a.xdts", xdts_of(3, track(0, { { 0, "1" } })))
    local code, out = run(path)
    assert.are.equal(0, code)
    assert.are.equal(assert(sheet.read(path)):text(), out)
    assert.are.equal(0, (run(path .. " -o " .. folder .. "/c.csv")))
    assert.are.equal("1 1 1", exposed(assert(sheet.read(folder .. "/c.csv")), "A"))
  end)

  it("makes the sheet of some frames of a script", function()
    local script = write("three.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 9, 9 }, first = 5, frames = 12, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 1, f:on(2) }:named "bar" } }
end }]])
    local path = folder .. "/part.txt"
    local code, _, err = run(("%s --frames 8-10,15 -o %s"):format(script, path))
    assert.are.equal(0, code, err)
    local s = assert(sheet.read(path))
    assert.are.equal(4, s.frames)
    assert.are.equal("1 2 2 3", exposed(s, "bar"))
    assert.are.equal(2, (run(script .. " --frames 1-3")))
    assert.are.equal(2, (run(path .. " --frames 1")))
    assert.has_error(function()
      sheet.of(celspan.film { frame = function() end }, { frames = 3 })
    end)
  end)

  it("has exit codes for all failures", function()
    assert.are.equal(4, (run(folder .. "/none.xdts")))
    local code, _, err = run(write("bad.txt", "celspan sheet 1\nfps x\n"))
    assert.are.equal(4, code)
    assert.is_truthy(err:find("line 2: fps must be a number", 1, true), err)
    assert.are.equal(2, (run(write("a.txt", "celspan sheet 1\n") .. " -o " .. folder .. "/a.doc")))
    assert.are.equal(5, (run(folder .. "/a.txt -o " .. folder .. "/a.txt/a.csv")))
    assert.are.equal(0, (run(folder .. "/a.txt -o " .. folder .. "/new/folder/a.csv")))
    code, _, err = run(write("bad.lua", [[
local celspan = require "celspan"
return celspan.film { frames = 2, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 1, 1 - f.index * 3 } } }
end }]]))
    assert.are.equal(3, code)
    assert.is_truthy(err:find("bad.lua:3: frame 2: rect: ", 1, true), err)
    assert.are.equal(1, select(2, err:gsub("bad.lua", "")), err)
  end)
end)
