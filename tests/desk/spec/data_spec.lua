-- Files of data that scripts read: tables, captions, JSON, text, and pictures of a sequence.
local captions = require "celspan.captions"
local celspan = require "celspan"
local csv = require "celspan.csv"
local json = require "celspan.json"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function joined(text, options)
  local rows = assert(csv.decode(text, options))
  local lines = {}
  for i, row in ipairs(rows) do lines[i] = table.concat(row, "|") end
  return table.concat(lines, "/")
end

local bare = { header = false }

describe("csv", function()
  -- RFC 4180, section 2, by its numbers
  it("reads the seven rules of RFC 4180", function()
    assert.are.equal("aaa|bbb|ccc/zzz|yyy|xxx", joined("aaa,bbb,ccc\r\nzzz,yyy,xxx\r\n", bare)) -- 1
    assert.are.equal("aaa|bbb|ccc/zzz|yyy|xxx", joined("aaa,bbb,ccc\r\nzzz,yyy,xxx", bare)) -- 2
    assert.are.equal("zzz|yyy", joined("name,other\r\nzzz,yyy")) -- 3
    assert.are.equal(" a| b ", joined(" a, b ", bare)) -- 4: spaces belong to a field
    assert.are.equal("aaa|bbb|ccc/zzz|y", joined('"aaa","bbb","ccc"\r\nzzz,y,', bare):gsub("|$",
      "")) -- 5
    assert.are.equal("aaa|b\r\nb|c,c", joined('"aaa","b\r\nb","c,c"', bare)) -- 6
    assert.are.equal('aaa|b"bb|"', joined('"aaa","b""bb",""""', bare)) -- 7
  end)

  it("reads lines that end with LF, empty lines, a byte order mark and UTF-8", function()
    assert.are.equal("é|b/c|d", joined("\239\187\191é,b\n\n\r\nc,d\n\n", bare))
  end)

  it("finds the separator in the first line, outside of quotes", function()
    assert.are.equal("a|b,c", joined("a;b,c", bare))
    assert.are.equal("x;y|z", joined('"x;y",z', bare))
    assert.are.equal("a|b;c", joined("a\tb;c", bare))
    assert.are.equal("a,b", joined("a,b", { header = false, separator = "|" }))
  end)

  it("gives values by the name and by the place of their column", function()
    local rows = assert(csv.decode("name,age,on\nAnn,31,yes\nBob,,FALSE\n007,1e2,1",
      { types = { age = "number", on = "boolean" } }))
    assert.are.same({ "Ann", 31, true }, { rows[1].name, rows[1].age, rows[1].on })
    assert.are.same({ "Bob", nil, false }, { rows[2].name, rows[2].age, rows[2][3] })
    assert.are.same({ "007", 100.0, true }, { rows[3][1], rows[3][2], rows[3].on })
  end)

  it("names the line, the column and what is allowed", function()
    for text, message in pairs {
      ['a,b\n1,"x'] = "line 2: a quote is not closed",
      ['a,"b\nc"\n1,"x"y'] = "line 3: a separator (,) is missing after a quote",
      ["a,b\n1\n"] = "line 2: the row has 1 field; the first has 2",
      ['"a\nb",c\n1,2,3\n'] = "line 3: the row has 3 fields; the first has 2",
      ["a,b,a\n"] = "line 1: columns 1 and 3 are both named 'a'",
      ["name\nJos\xe9\n"] = "line 2 is not UTF-8 (byte 233): export the table as UTF-8",
    } do
      assert.are.same({ n = 2, nil, message }, table.pack(csv.decode(text)))
    end
    assert.are.equal("line 2: column 'a' is '3 m'; it must be a number",
      select(2, csv.decode("a\n3 m", { types = { a = "number" } })))
    assert.are.equal("line 2: column '2' is 'on'; it must be true, false, yes, no, 1 or 0",
      select(2, csv.decode("a,yes\ne,on", { header = false, types = { [2] = "boolean" } })))
    assert.are.equal("line 1: there is no column 'age', for which a type is given; there are a, b",
      select(2, csv.decode("a,b\n", { types = { age = "number" } })))
  end)

  it("refuses wrong options at the caller's line", function()
    assert.are.equal("csv: unknown field 'headers'; did you mean 'header'?",
      raised.sentence(function() csv.decode("", { headers = true }) end))
    assert.are.equal('csv: field \'decimal\' must be "." or ",", got ";"',
      raised.sentence(function() csv.decode("", { decimal = ";" }) end))
    local rows = assert(csv.decode("town;share\nBern;1,5\nChur;-2", { decimal = ",",
      types = { share = "number" } }))
    assert.are.same({ 1.5, -2 }, { rows[1].share, rows[2].share })
    assert.are.equal("line 2: column 'share' is '1.5'; it must be a number",
      select(2, csv.decode("share\n1.5", { decimal = ",", types = { share = "number" } })))
    assert.are.equal("csv: there is no column 'shares'; did you mean 'share'?",
      raised.sentence(function() return rows[1].shares end))
    assert.are.equal("csv: there is no column 'votes'; there are town, share",
      raised.sentence(function() return rows[1].votes end))
    assert.is_nil(rows[1][3])
    assert.are.equal("csv: field 'separator' must be one character, and no quote or end of a line",
      raised.sentence(function() csv.decode("", { separator = "::" }) end))
    assert.are.equal("csv: the type of column 'a' must be \"number\", \"boolean\" or \"string\"",
      raised.sentence(function() csv.decode("", { types = { a = "int" } }) end))
    assert.are.equal("csv: read takes a file name, got nil",
      raised.sentence(function() csv.read() end))
  end)
end)

describe("captions", function()
  local vtt = "WEBVTT - a film\r\n\r\nSTYLE\r\n::cue { color: red }\r\n\r\nNOTE\r\nnothing\r\n\r\n"
    .. "intro\r\n00:01.000 --> 00:02.500 align:start line:0\r\n"
    .. "<v Ann>Hello &amp; <c.loud>you</c>\r\ntwo lines\r\n\r\n"
    .. "00:00:02.000 --> 100:00:03.000\r\n&lt;end&gt; &#233;&#xe9;"

  it("reads WebVTT: names, settings, notes, styles, tags and entities", function()
    local list = assert(captions.decode(vtt))
    assert.are.same({ from = 1, to = 2.5, text = "Hello & you\ntwo lines",
      markup = "<v Ann>Hello &amp; <c.loud>you</c>\ntwo lines" }, list[1])
    assert.are.same({ 2, 360003, "<end> éé", 2 }, { list[2].from, list[2].to, list[2].text, #list })
  end)

  -- WebVTT, W3C: the syntax of files, cues, timestamps and cue text
  it("reads the forms that W3C's text allows, and no others", function()
    local CUE = "00:01.000 --> 00:02.000\n"
    for text, expected in pairs {
      ["WEBVTT"] = "", ["WEBVTT\n"] = "", ["WEBVTT\tsome words\n\n" .. CUE .. "x"] = "1-2 x",
      ["WEBVTT\nKind: x\nLanguage: en\n\n" .. CUE .. "x\n"] = "1-2 x",
      ["\239\187\191WEBVTT\n\n" .. CUE .. "x"] = "1-2 x",
      ["WEBVTT\r\r00:01.000 --> 00:02.000\rx\ry\r"] = "1-2 x\ny",
      ["WEBVTT\n\n100:00:01.000 --> 100:00:02.000\nx"] = "360001-360002 x",
      ["WEBVTT\n\n00:01.000-->00:02.000 align:start line:0 position:10%\nx"] = "1-2 x",
      ["WEBVTT\n\nintro\n" .. CUE .. "x"] = "1-2 x",
      ["WEBVTT\n\nNOTE a\nb\n\nREGION\nid:fred\n\nSTYLE\n::cue{}\n\n" .. CUE .. "x"] = "1-2 x",
      ["WEBVTT\n\n" .. CUE .. "<v Mary>Hi <c.loud>you</c> <00:01.500><i>there</i></v>"]
        = "1-2 Hi you there",
      ["WEBVTT\n\n" .. CUE .. "<ruby>a<rt>b</rt></ruby>"] = "1-2 ab",
      ["WEBVTT\n\n" .. CUE .. "&amp;&lt;&gt;&nbsp;&foo; & x"] = "1-2 &<>\u{a0}&foo; & x",
      ["WEBVTT\n\n" .. CUE .. "a\0b"] = "1-2 a\u{FFFD}b",
      ["WEBVTT\n\n" .. CUE .. "\n00:02.000 --> 00:03.000\ny"] = "1-2 |2-3 y",
      ["WEBVTT\n\n00:03.000 --> 00:04.000\nx\n\n" .. CUE .. "y"] = "1-2 y|3-4 x",
      ["WEBVTTX\n\n" .. CUE .. "x"] = false, ["WEBVTT\n\n60:01.000 --> 60:02.000\nx"] = false,
      ["WEBVTT\n\n00:01.00 --> 00:02.000\nx"] = false, ["WEBVTT\n\n" .. CUE .. "a --> b"] = false,
      ["WEBVTT\n\n00:02.000 --> 00:02.000\nx"] = false,
    } do
      local list, message = captions.decode(text)
      local found = {}
      for i, one in ipairs(list or {}) do
        found[i] = ("%g-%g %s"):format(one.from, one.to, one.text)
      end
      assert.are.equal(expected, list ~= nil and table.concat(found, "|"),
        ("%q: %s"):format(text, message))
    end
  end)

  it("shows a caption from its first moment until just before its last", function()
    local list = assert(captions.decode(vtt))
    assert.are.same({ n = 5, nil, "Hello & you\ntwo lines", "Hello & you\ntwo lines\n<end> éé",
      "<end> éé", nil }, table.pack(list:at(0.999), list:at(1), list:at(2), list:at(2.5),
      list:at(360003)))
  end)

  it("reads SubRip, in the order of its times", function()
    local list = assert(captions.decode("2\n00:00:05,000 --> 00:00:06,000\n{\\an8}<i>b</i>\n\n"
      .. "1\n00:00:01,000 --> 00:00:02,250\na\n"))
    assert.are.same({ "a", 2.25, "b", "{\\an8}<i>b</i>" },
      { list[1].text, list[1].to, list[2].text, list[2].markup })
  end)

  it("begins a caption at its times where the empty line before it is missing", function()
    local list = assert(captions.decode("WEBVTT\n\n00:01.000 --> 00:02.000\na\n"
      .. "00:02.000 --> 00:03.000\nb"))
    assert.are.same({ "a", "b" }, { list[1].text, list[2].text })
  end)

  it("reads arrows in the text of SubRip as text, and times there as times", function()
    local first = "1\n00:00:01,000 --> 00:00:02,000\n- a --> b?\n--> c\n"
    local list = assert(captions.decode(first .. "00:00:02,000 --> 00:00:03,000\nd"))
    assert.are.same({ "- a --> b?\n--> c", "d" }, { list[1].text, list[2].text })
    local _, message = captions.decode(first .. "00:61,000 --> 00:62,000\nd")
    assert.are.equal("line 5: '00:61,000 --> 00:62,000' must be two times with an arrow, "
      .. "00:00:01.000 --> 00:00:02.500", message)
  end)

  it("names the line of what it cannot read", function()
    for text, message in pairs {
      ["1\n00:01,000 -> 00:02,000\na"] = "line 1: '1' begins a block without times",
      ["WEBVTT\n\n00:61.000 --> 00:62.000\n"] = "line 3: '00:61.000 --> 00:62.000' must be two "
        .. "times with an arrow, 00:00:01.000 --> 00:00:02.500",
      ["1\n00:00:00,000 --> 99999999999999999999:00:00,000\nx"] =
        "line 2: the caption ends after 99999999999999999999:00:00,000; at most 1000000 hours are "
        .. "read",
      ["\n\n1\n00:00:03,000 --> 00:00:02,000"] = "line 4: the caption ends (00:00:02,000) before "
        .. "it begins (00:00:03,000), or at the same time",
      ["1\nx\n00:00:03,000 --> 00:00:04,000"] = "line 2: the times of a caption are on its first "
        .. "or second line",
      ["\255"] = "the text is not UTF-8",
    } do
      assert.are.same({ n = 2, nil, message }, table.pack(captions.decode(text)))
    end
  end)
end)

describe("files of data", function()
  local ways = { ["csv"] = csv.read, ["json"] = json.read, ["captions"] = captions.read,
                 ["text"] = celspan.read, ["sheet"] = require "celspan.sheet".read,
                 ["lips"] = require "celspan.lips".read, ["track"] = require "celspan.track".read }

  it("are read from beside the script", function()
    bench:write("a.csv", "n\n3\n")
    bench:write("a.json", '{ "n": [1, 2] }')
    bench:write("a.srt", "1\n00:00:00,000 --> 00:00:01,000\nhello\n")
    bench:write("film.lua", [[
local celspan, csv, json = require "celspan", require "celspan.csv", require "celspan.json"
local captions = require "celspan.captions"
print(assert(csv.read "a.csv")[1].n, assert(json.read "a.json").n[2],
  assert(captions.read "a.srt"):at(0),
  #assert(celspan.read "a.csv"), (select(2, celspan.read "none.txt")))
return celspan.film { size = { 4, 4 }, frames = 1,
  frame = function() return celspan.rostrum {} end }]])
    local code, out, err = bench:celspan("render '%s/film.lua' -o '%s/a.png' --progress none",
      bench.folder, bench.folder)
    assert.are.equal(0, code, err)
    assert.are.equal("3\t2\thello\t4", (out .. err):match "^(.-)\t[^\t]*\n")
    assert.is_truthy((out .. err):find "none.txt")
  end)

  it("are closed when they are read, however long the collector waits", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
local large = {}
for i = 1, 300000 do large[i] = {} end
for _ = 1, 500 do assert(celspan.read "film.lua") end
return celspan.rostrum {}]])
    local code, _, err = bench:inside(("ulimit -n 64 && '%s' check film.lua"):format(
      workbench.absolute))
    assert.are.equal(0, code, err)
  end)

  it("that are pipes, folders or devices are refused, and not waited for", function()
    bench:inside "mkfifo pipe"
    for name, read in pairs(ways) do
      local value, message = read(bench.folder .. "/pipe")
      assert.is_nil(value, name)
      assert.is_truthy(message:find("/pipe: is not a file; a text must be one", 1, true), message)
    end
    for _, path in ipairs { bench.folder, "/dev/zero" } do
      assert.are.same({ n = 2, nil, path .. ": is not a file; a text must be one" },
        table.pack(celspan.read(path)))
    end
  end)

  it("that are missing or wrong give nil and a message with their name", function()
    for name, read in pairs(ways) do
      local value, message = read(bench.folder .. "/no/such.file")
      assert.is_nil(value, name)
      assert.is_truthy(message:find("no/such.file", 1, true), name)
    end
    bench:write("bad", '"')
    for _, name in ipairs { "csv", "json", "captions" } do
      local value, message = ways[name](bench.folder .. "/bad")
      assert.is_nil(value)
      assert.is_truthy(message:find(bench.folder .. "/bad: line 1: ", 1, true), message)
    end
  end)
end)

local function filled(texture)
  local rect = celspan.rect { 0, 0, 2, 2, texture = texture }
  return assert(celspan.pixels(celspan.rostrum { celspan.cel { rect } }, { size = { 2, 2 } }))
end

describe("a picture of a sequence", function()
  it("is found by its frame, also when the frame is changed", function()
    for i = 1, 2 do
      assert(filled(i == 1 and "#ff0000" or "#0000ff")
        :write(("%s/roto.%02d.png"):format(bench.folder, i)))
    end
    local picture = celspan.picture { file = bench.folder .. "/roto.##.png", frame = 2 }
    assert.are.same({ 0, 0, 1, 1 }, { filled(picture):get(0, 0) })
    assert.are.same({ 1, 0, 0, 1 }, { filled(picture:with { frame = 1 }):get(0, 0) })
  end)

  it("needs a place for the number", function()
    assert.are.equal("picture: field 'frame' needs a file with a place for its number, such as "
      .. '"roto.####.png", got "a.png"',
      raised.sentence(function() celspan.picture { file = "a.png", frame = 1 } end))
    assert.are.equal("image: field 'frame' needs field 'file'", raised.sentence(function()
      celspan.image { pixels = "rgba", size = { 1, 1 }, frame = 1 }
    end))
  end)
end)
