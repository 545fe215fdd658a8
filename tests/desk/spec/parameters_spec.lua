-- celspan.parameters, and the options that set them: --set, --set-from, --table, info --parameters.
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { title = "Hello", side = { "left", "right" }, on = true,
  speed = { 1, min = 0, max = 4, about = "Widths of the frame in a second" },
  tint = { colour = "#f26419" }, take = { file = "a.wav" } }
print(p.title, p.side, p.speed, p.on, p.tint, p.take)
return celspan.film { size = { 8, 8 }, frames = 2, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8, texture = p.tint } } }
end }
]]

--- A WAV file of 16 bits, one channel.
local function silence(seconds)
  local data = ("\0\0"):rep(math.floor(seconds * 48000))
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4s4"):pack("RIFF", 36 + #data, "WAVE", "fmt ", 16, 1, 1, 48000,
    96000, 2, 16, "data", data)
end

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)
after_each(function() bench:remove() end)

local function render(options)
  return bench:celspan("render '%s/film.lua' -o '%s/f.#.png' --progress none %s", bench.folder,
    bench.folder, options or "")
end

--- What the script printed; the render ends well.
local function values(options)
  local code, out, err = render(options)
  assert.are.equal(0, code, err)
  return (out .. err):gsub("\n", "")
end

--- The sentence that refuses the options.
local function refusal(expected, options)
  local code, _, err = render(options)
  assert.are.equal(expected, code, err)
  return err:match "celspan: error: ([^\n]*)\n$"
end

describe("parameters", function()
  it("have their defaults, or the values of --set", function()
    assert.are.equal("Hello\tleft\t1\ttrue\t#f26419\ta.wav", values())
    assert.are.equal("a=b c\tright\t2.5\tfalse\t#fff\tdir/b.wav", values("--set 'title=a=b c' "
      .. "--set side=right --set speed=2.5 --set on=no --set tint=#fff --set take=dir/b.wav"))
  end)

  it("take the last of two values, and --set before --set-from", function()
    bench:write("p.json", '{ "speed": 3, "on": false, "title": "J" }')
    assert.are.equal("K\tleft\t3\tfalse\t#f26419\ta.wav",
      values(("--set title=I --set-from '%s/p.json' --set title=K"):format(bench.folder)))
  end)

  it("refuse what they do not allow as wrong usage", function()
    for given, message in pairs {
      ["speed=9"] = "--set: speed is '9'; it must be a number from 0 to 4",
      ["speed=0x1"] = "--set: speed is '0x1'; it must be a number from 0 to 4",
      ["speed=nan"] = "--set: speed is 'nan'; it must be a number from 0 to 4",
      ["on=maybe"] = "--set: on is 'maybe'; it must be true, false, yes, no, 1 or 0",
      ["side=up"] = "--set: side is 'up'; it must be one of left, right",
      ["tint=redd"] = '--set: tint is \'redd\'; it must be a colour, such as "#f80" or '
        .. '"#ff8800"',
      ["take="] = "--set: take is ''; it must be the name of a file",
      ["sped=1"] = "--set: the script has no parameter 'sped'; did you mean 'speed'?",
      ["speed"] = "--set: 'speed' is not NAME=VALUE",
    } do
      assert.are.equal(message, refusal(2, "--set " .. given))
    end
  end)

  it("are refused where the script declares none, or catches the error", function()
    bench:write("film.lua", "return require 'celspan'.film { size = { 1, 1 }, frames = 1, "
      .. "frame = function() return require 'celspan'.rostrum {} end }")
    assert.are.equal("--set: the script declares no parameters (celspan.parameters)",
      refusal(2, "--set a=1"))
    bench:write("film.lua", "local celspan = require 'celspan'\nlocal x = = 1\n"
      .. "celspan.parameters { a = 1 }")
    local place = bench.folder .. "/film.lua:2: "
    bench:write("set.json", '{ "a": 2 }')
    for _, options in ipairs { "--set a=1", "--set-from '" .. bench.folder .. "/set.json'" } do
      assert.are.equal(place .. "unexpected symbol near '='", refusal(3, options))
      for _, verb in ipairs { "check", "info" } do
        local code, _, err = bench:celspan("%s '%s/film.lua' %s", verb, bench.folder, options)
        assert.are.equal(3, code, err)
        assert.is_truthy(err:find(place .. "unexpected symbol near '='", 1, true), err)
      end
    end
    bench:write("film.lua", "pcall(require 'celspan'.parameters, { b = 1 })\n"
      .. FILM:gsub("local p",
      "do return celspan.film { size = { 1, 1 }, frames = 1, frame = function() end } end local p"))
    assert.are.equal("--set: the script has no parameter 'alpha'; there are b",
      refusal(2, "--set alpha=1"))
  end)

  it("name the file of --set-from in messages", function()
    local path = bench:write("p.json", '{ "speed": "3" }')
    assert.are.equal("--set-from " .. path .. ": speed is '3'; it must be a number from 0 to 4",
      refusal(2, "--set-from " .. path))
    for text, message in pairs { ["[1]"] = "it must be a JSON object, { \"name\": value }",
                                 ["{"] = "line 1: a name in quotes is missing in an object" } do
      bench:write("p.json", text)
      assert.are.equal("--set-from " .. path .. ": " .. message, refusal(2, "--set-from " .. path))
    end
    assert.are.equal("--set-from " .. path .. "x: No such file or directory",
      refusal(4, "--set-from " .. path .. "x"))
  end)

  it("are points and curves too", function()
    bench:write("film.lua", [[local celspan = require "celspan"
      local p = celspan.parameters { at = { 12.5, 80, point = true }, how = { ease = "outBack" } }
      local names = {}
      for name, value in pairs(p) do
        names[#names + 1] = name .. (value == p[name] and "" or "?")
      end
      table.sort(names)
      print(p.at[1] .. " " .. p.at[2] .. " " .. #p.at .. " " .. p.how .. " of "
        .. table.concat(names, "+"))
      return celspan.film { size = { 1, 1 }, frames = 1, frame = function()
        return celspan.rostrum {} end }]])
    bench:write("p.json", '{ "at": [3, -4], "how": "linear" }')
    for options, said in pairs { [""] = "12.5 80 2 outBack of at+how",
                                 ["--set at=1,2e2"] = "1 200.0 2 outBack of at+how",
                                 ["--set how=inOutQuad"] = "12.5 80 2 inOutQuad of at+how",
                                 ["--set-from p.json"] = "3 -4 2 linear of at+how" } do
      local _, out, err = bench:celspan_inside("check film.lua " .. options)
      assert.truthy((out .. err):find(said, 1, true), options .. ": " .. out .. err)
    end
    for setting, wrong in pairs { ["at=1"] = "a point", ["at=1,2,3"] = "a point",
                                  ["at=nan,1"] = "a point", ["how="] = "the name of a curve",
                                  ["how=outBak"] = "the name of a curve" } do
      local code, _, err = bench:celspan_inside("check film.lua --set " .. setting)
      assert.equal(2, code)
      assert.truthy(err:find("it must be " .. wrong, 1, true), err)
    end
    bench:write("p.json", '{ "at": [1] }')
    assert.equal(2, (bench:celspan_inside "check film.lua --set-from p.json"))
  end)

  it("may be given to points by the script, for all ways to read them", function()
    bench:write("given.lua", [[
local celspan = require "celspan"
local p = celspan.parameters { sun = { 1, 2, point = true }, size = 3 }
p.sun, p.size = { 5, 6 }, 4
local found = {}
for name, value in pairs(p) do found[name] = value end
print(p.sun[1], found.sun[1], p.size, found.size)
return celspan.film { size = { 8, 8 }, frame = function() return celspan.rostrum {} end }
]])
    local _, said, err = bench:celspan_inside "info given.lua"
    assert.matches("5%s+5%s+4%s+4", said .. err)
  end)

  it("are checked where they are declared", function()
    for declared, message in pairs {
      ["speed = { 5, max = 4 }"] = "'speed' has the default 5, which is not a number of at most 4",
      ["speed = { 9, min = 0, max = 4 }"] =
        "'speed' has the default 9, which is not a number from 0 to 4",
      ["side = { 'a', 'b', 'a' }"] = "'side' has the choice \"a\" twice",
      ["tint = { colour = 'redd' }"] =
        "'tint' has the default 'redd', which is not a colour, such as \"#f80\" or \"#ff8800\"",
      ["speed = { 1, mni = 0 }"] =
        "'speed' is a number, which has no field 'mni'; did you mean 'min'?",
      ["side = { 'a', 'b', grop = 'x' }"] =
        "'side' is a choice, which has no field 'grop'; did you mean 'group'?",
      ["speed = { 1, most = 4 }"] = "'speed' is a number, which has no field 'most'",
      ["['a-b'] = 1"] = "'a-b' is not a name: letters, digits and _, not beginning with a digit",
      ["[setmetatable({}, { __tostring = print })] = 1"] =
        "table is not a name: letters, digits and _, not beginning with a digit",
      ["a = {}"] = "'a' must be a string, a number, a boolean, a list of strings, or a table with "
        .. "a default as [1], a point, colour, ease or file",
      ["at = { point = { 430, 110 } }"] = "'at' has a field 'point' that is not true: write { 430, "
        .. "110, point = true }",
      ["at = { point = 1 }"] = "'at' has a field 'point' that is not true: write { 120, 80, "
        .. "point = true }",
      ["at = { 1, point = true }"] = "'at' has the default a table, which is not a point, such as "
        .. '"120,80"',
      ["at = { 1, 2, 3, point = true }"] = "'at' is a point, which has no field '3'",
      ["at = { 1, 2, point = 1 }"] = "'at' has a field 'point' that is not true: write { 1, 2, "
        .. "point = true }",
      ["how = { ease = 'outBak' }"] = "'how' has the default 'outBak', which is not the name of a "
        .. 'curve, such as "outBack"',
      ["side = { 'a', 'b', group = 1 }"] = "'side' has a field 'group' that is not a string",
    } do
      bench:write("film.lua", "local celspan = require 'celspan'\ncelspan.parameters { "
        .. declared .. " }")
      assert.are.equal(("%s/film.lua:2: parameters: %s"):format(bench.folder, message), refusal(3))
    end
    bench:write("film.lua", "local c = require 'celspan'\nc.parameters {}\nc.parameters {}")
    assert.is_truthy(refusal(3):find("film.lua:3: parameters: a script declares", 1, true))
    bench:write("film.lua", "local p = require 'celspan'.parameters { speed = 1 }\nprint(p.sped)")
    assert.is_truthy(refusal(3):find("film.lua:2: parameters has no 'sped'; did you mean 'speed'?",
      1, true))
  end)

  it("decide what --resume renders again", function()
    local function picture(options)
      bench:celspan("render '%s/film.lua' -o '%s/f.#.png' --resume %s", bench.folder, bench.folder,
        options)
      return bench:read "f.1.png"
    end
    local before = picture ""
    assert.are_not.equal(before, picture "--set tint=#000")
    assert.are.equal(before, picture "--set title=x")
  end)

  it("are listed by info without control characters", function()
    bench:write("odd.lua", 'local celspan = require "celspan"\n'
      .. 'celspan.parameters { t = "a\\27[2J\\n\\u{9b}\\u{e4}" } return celspan.rostrum {}')
    local _, out = bench:celspan_inside "info odd.lua --parameters"
    assert.are.equal("parameter t text a\\x1b[2J\\x0a\\x9b\u{e4}\n", out)
  end)

  it("are listed by info, as lines and as JSON Schema", function()
    local function info(options)
      local code, out, err = bench:celspan("info '%s/film.lua' --parameters %s", bench.folder,
        options)
      assert.are.equal(0, code, err)
      return out
    end
    assert.is_truthy(info "":find("parameter speed number 1 (a number from 0 to 4)\n", 1, true))
    local schema = assert(json.decode((info "--json":gsub("^Hello[^\n]*\n", ""))))
    assert.are.same({ type = "number", default = 1, minimum = 0, maximum = 4,
      description = "Widths of the frame in a second" }, schema.properties.speed)
    assert.are.same({ "left", "right" }, schema.properties.side.enum)
    assert.are.same({ "object", false, "film.lua" },
      { schema.type, schema.additionalProperties, schema.title })
  end)

  it("are parameters of a job for Open Job Description", function()
    local code, out, err = bench:celspan("farm '%s/film.lua' -o '%s/f.#.png' --openjd --set "
      .. "title=A --set 'title=B {{x}}'", bench.folder, bench.folder)
    assert.are.equal(0, code, err)
    local job = assert(json.decode((out:gsub("^Hello[^\n]*\n", ""):gsub("^B[^\n]*\n", ""))))
    local found
    for _, one in ipairs(job.parameterDefinitions) do
      if one.name == "Set_title" then found = one.default end
    end
    assert.are.equal("B {{x}}", found)
    local words = table.concat(job.steps[1].script.actions.onRun.args, " ")
    assert.is_truthy(words:find("--set title={{Param.Set_title}}", 1, true))
  end)
end)

describe("--table", function()
  local function film_of(rows, options, output)
    bench:write("rows.csv", rows)
    return bench:celspan("render '%s/film.lua' -o '%s/%s' --table '%s/rows.csv' %s", bench.folder,
      bench.folder, output or "{lang}.#.png", bench.folder, options or "")
  end

  it("renders a film for each row, as --set would", function()
    local code, _, err = film_of("lang,tint\nen,#f00\nde,#0000ff\n", "--workers 2")
    assert.are.equal(0, code, err)
    assert.is_truthy(err:find("celspan: 1/2 " .. bench.folder .. "/en.#.png\n", 1, true))
    render "--set tint=#00f"
    assert.are.equal(bench:read "f.2.png", bench:read "de.2.png")
    assert.are.same({ "de.1.png", "de.2.png", "en.1.png", "en.2.png" },
      { table.unpack(bench:files(), 1, 4) })
  end)

  it("may come through a pipe", function()
    local code, out, err = bench:inside(("printf 'lang,tint\\nen,#f00\\n' | '%s' render film.lua "
      .. "--table /dev/stdin -o {lang}.#.png"):format(require "tests.support.workbench".absolute))
    assert.are.equal(0, code, out .. err)
    assert.is_truthy(bench:read "en.2.png")
  end)

  it("makes a contact sheet of each row, and checks each row", function()
    bench:write("rows.csv", "lang,tint\nen,#f00\nde,#0000ff\n")
    local place = bench.folder
    local function on(verb, more)
      return bench:celspan("%s '%s/film.lua' --table '%s/rows.csv' %s", verb, place, place,
        more or "")
    end
    local code, _, err = on("contact", ("-o '%s/{lang}.png'"):format(place))
    assert.are.equal(0, code, err)
    bench:celspan("contact '%s/film.lua' -o '%s/alone.png' --set tint=#00f", place, place)
    assert.are.equal(bench:read "alone.png", bench:read "de.png")
    assert.are_not.equal(bench:read "en.png", bench:read "de.png")
    code, _, err = on "check"
    assert.are.equal(0, code, err)
    assert.is_truthy(err:find("2/2 line 3\n", 1, true), err)
    bench:write("film.lua", "local celspan = require 'celspan'\n"
      .. "local p = celspan.parameters { tint = '#fff' }\nassert(p.tint ~= '#f00', 'red')\n"
      .. FILM:gsub("local p = .-\nprint%b()", ""):gsub("^[^\n]*\n", ""))
    code, _, err = on "check"
    assert.are.equal(3, code, err)
    assert.is_truthy(err:find("rows.csv: line 2: exit code 3\n", 1, true), err)
    assert.is_truthy(err:find("2/2 line 3\n", 1, true), err)
    code, _, err = on("check", "--json")
    assert.are.equal(2, code, err)
  end)

  it("is refused before the first frame", function()
    for rows, message in pairs {
      ["lang,size\nen,1\n"] =
        "column 'size' is neither a parameter of the script nor {size} in OUT; did you mean "
        .. "'side'?",
      ["lang,speed\nen,1\nde,9\n"] = "line 3: speed is '9'; it must be a number from 0 to 4",
      ["lang\n../x\n"] = "line 2: column 'lang' is '../x': in the name of a file it must not be "
        .. "empty nor have / or .. in it",
      ["lang,on\nen,1\nen,0\n"] = "lines 2 and 3 would both make " .. bench.folder
        .. "/en.#.png: put a column in OUT, as {NAME}",
      ["lang\na\0b\n"] = "line 2: column 'lang' is 'a\\x00b': in the name of a file it must not "
        .. "be empty nor have / or .. in it",
      ["lang\n"] = "it has no rows",
      [""] = "it is empty: its first line names the columns",
      ["speed\n1\n"] = "there is no column 'lang' for {lang} in OUT; there are speed",
    } do
      local code, _, err = film_of(rows)
      assert.are.equal(2, code, err)
      assert.is_truthy(err:find("rows.csv: " .. message .. "\n", 1, true), err)
    end
    local code, _, err = film_of('lang\n"en\n')
    assert.are.equal(4, code)
    assert.is_truthy(err:find("rows.csv: line 2: a quote is not closed\n", 1, true))
    code, _, err = film_of("lang,speed,speed\nen,1,2\n")
    assert.are.equal(4, code)
    assert.is_truthy(err:find("columns 2 and 3 are both named 'speed'\n", 1, true))
    assert.are.equal("--table writes files: name them by its columns, as -o {NAME}.mp4",
      (select(3, bench:celspan("render '%s/film.lua' --table '%s/rows.csv'", bench.folder,
        bench.folder)):match "celspan: error: ([^\n]*)\n"))
    for _, name in ipairs(bench:files()) do assert.is_nil(name:find "png$") end
  end)

  it("may set more parameters than a line of a shell has words", function()
    local names, ones = {}, {}
    for i = 1, 1200 do names[i], ones[i] = "n" .. i, "1" end
    bench:write("film.lua", ([[
      local celspan, declared = require "celspan", {}, {}
      for i = 1, 1200 do declared["n" .. i] = 0 end
      local sum, p = 0, celspan.parameters(declared)
      for name in pairs(declared) do sum = sum + p[name] end
      print('sum', sum)
    ]]) .. FILM:gsub("local p = .-\nprint%b()", "local p = { tint = '#fff' }")
      :gsub("^[^\n]*\n", ""))
    local rows = table.concat(names, ",") .. "\n" .. table.concat(ones, ",") .. "\n"
    local code, _, err = film_of(rows, "", "f.#.png")
    assert.are.equal(0, code, err)
    assert.is_truthy(err:find("sum\t1200", 1, true))
  end)

  --- A film that fails in its second frame where n is 2, with a sound beside it.
  local function write_failing()
    bench:write("film.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { n = 0, tint = "#f00" }
      return celspan.film { size = { 8, 8 }, frames = 3, fps = 12,
        sound = { "a.wav", pan = p.n / 9 }, frame = function(f)
          if p.n == 2 and f.number == 2 then error "two" end
          return celspan.rostrum { celspan.cel { celspan.rect { f.number, p.n, 4, 4,
            texture = p.tint } } }
        end }
    ]])
    bench:write("a.wav", silence(0.25))
  end

  --- The last event of --progress json, and how each row came to be.
  local function events(err)
    local last, ways = nil, {}
    for line in err:gmatch "[^\n]+" do
      last = assert(json.decode(line), line)
      if last.event == "row" then ways[#ways + 1] = last.line .. " " .. last.how end
    end
    return last, table.concat(ways, ", ")
  end

  local OUTPUTS = { "{n}.#.png", "{n}.mkv", "{n}.plane", "{n}.gif" }

  it("keeps going and resumes by rows, whatever the output is", function()
    if not present.program "ffmpeg" then return pending "no ffmpeg" end
    write_failing()
    for _, output in ipairs(OUTPUTS) do
      local code, _, err = film_of("n\n1\n2\n3\n", "--keep-going --resume --workers 2", output)
      assert.are.equal(1, code, err)
      local bad = bench.folder .. "/" .. output:gsub("{n}", "2")
      assert.is_truthy(err:find("two\n", 1, true), err)
      assert.is_truthy(err:find(("rows.csv: 2 made, 1 failed: line 3 (%s)\n"):format(bad), 1, true),
        err)
      code, _, err = film_of("n\n1\n2\n4\n", "--keep-going --resume --progress json", output)
      assert.are.equal(1, code, err)
      local last, ways = events(err)
      assert.are.equal("2 kept, 3 failed, 4 made", ways)
      assert.are.same({ "end", 2, 3, 1, 1, 1, { 3 }, { bad } }, { last.event, last.done,
        last.count, last.kept, last.failures, last.exit, last.failed, last.outputs })
      code, _, err = film_of("n\n1\n", "--resume --set tint=#0f0 --progress json", output)
      assert.are.equal(0, code, err)
      assert.are.equal("2 made", select(2, events(err)))
    end
  end)

  it("reports a frame that fails now, of a file that is there, between start and end", function()
    bench:write("film.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { bad = false }
      return celspan.film { size = { 8, 8 }, frames = 3, frame = function(f)
        if p.bad and f.number == 2 then error "two" end
        return celspan.rostrum { celspan.cel { celspan.rect { f.number, 0, 4, 4 } } }
      end }
    ]])
    local command = "render film.lua -o film.plane --resume --progress json"
    assert.are.equal(0, (bench:celspan_inside(command)))
    local code, _, err = bench:celspan_inside(command .. " --set bad=true")
    assert.are.equal(3, code, err)
    local names = {}
    for name in err:gmatch '"event":"(%l+)"' do names[#names + 1] = name end
    assert.are.same({ "start", "frame", "error", "note", "end" }, names)
    assert.is_truthy(err:find('"exit":3,"failures":1,"failed":[2]', 1, true), err)
  end)

  it("makes the sound of each row, and keeps what would be the same", function()
    if not present.program "ffmpeg" then return pending "no ffmpeg" end
    write_failing()
    bench:write("rows.csv", "n\n1\n2\n")
    local function sounds(options)
      local code, _, err = bench:celspan("sound '%s/film.lua' -o '%s/{n}.wav' --table "
        .. "'%s/rows.csv' --resume --progress json %s", bench.folder, bench.folder, bench.folder,
        options or "")
      assert.are.equal(0, code, err)
      return select(2, events(err))
    end
    assert.are.equal("2 made, 3 made", sounds())
    assert.are.equal("2 kept, 3 kept", sounds())
    bench:write("1.wav", "cut off")
    assert.are.equal("2 made, 3 kept", sounds())
    bench:write("a.wav", silence(0.125))
    assert.are.equal("2 made, 3 made", sounds())
    bench:write("b.wav", silence(0.125))
    bench:inside "touch -r a.wav b.wav" -- as files of one archive may have it
    bench:write("film.lua", (bench:read("film.lua"):gsub("a%.wav", "b.wav")))
    assert.are.equal("2 made, 3 made", sounds())
    local code = bench:celspan("sound '%s/film.lua' -o '%s/x.wav' --keep-going", bench.folder,
      bench.folder)
    assert.are.equal(2, code)
  end)

  it("makes a row again that was killed, and leaves nothing of it under its name", function()
    bench:write("film.lua", [[
      local celspan = require "celspan"
      local p = celspan.parameters { n = 0 }
      return celspan.film { size = { 8, 8 }, frames = 3, frame = function(f)
        if p.n == 2 and f.number == 2 then
          local kill = io.open "kill"
          if kill then os.execute "kill -9 $PPID" end
        end
        return celspan.rostrum { celspan.cel { celspan.rect { f.number, p.n, 4, 4 } } }
      end }
    ]])
    bench:write("rows.csv", "n\n1\n2\n3\n")
    local function run()
      return bench:celspan_inside("render film.lua -o '{n}.plane' --table rows.csv --resume "
        .. "--trust --keep-going")
    end
    bench:write("kill", "")
    local code, _, err = run()
    assert.are.equal(1, code, err)
    assert.is_truthy(err:find("2 made, 1 failed: line 3 (2.plane)\n", 1, true), err)
    assert.is_nil(bench:read "2.plane")
    os.remove(bench.folder .. "/kill")
    code, _, err = run()
    assert.are.equal(0, code, err)
    assert.is_truthy(err:find("rows.csv: 1 made, 2 kept\n", 1, true), err)
    assert.is_truthy(bench:read "2.plane")
  end)

  it("ends at the first row that fails, or continues with --keep-going", function()
    bench:write("film.lua", "local celspan = require 'celspan'\n"
      .. "local p = celspan.parameters { n = 0 }\nassert(p.n ~= 1, 'one')\n"
      .. FILM:gsub("local p = .-\nprint%b()", "p.tint = '#fff'"):gsub("^[^\n]*\n", ""))
    local code, _, err = film_of("n\n1\n2\n3\n", "--workers 1", "{n}.#.png")
    assert.are.equal(3, code)
    assert.is_truthy(err:find("rows.csv: line 2 (" .. bench.folder .. "/1.#.png): exit code 3\n",
      1, true))
    assert.is_nil(bench:read "3.1.png")
    code = film_of("n\n1\n2\n3\n", "--keep-going", "{n}.#.png")
    assert.are.equal(1, code)
    assert.is_truthy(bench:read "3.1.png")
  end)
end)
