-- Sequences: frames by several workers, equal frames, failures, --keep-going, and reports. One
-- file, because all tests use the same film.
local celspan = require "celspan"
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local bench

--- 12 frames of 96 x 64: on twos from frame 7 on, where only every second frame differs.
local FILM = [[
local celspan = require "celspan"
return celspan.film{ size = {96, 64}, frames = 12, title = "moon", frame = function(f)
  local at = f.number < 7 and f.index or f:on(2)
  return celspan.rostrum{ celspan.cel{
    celspan.rect{ 0, 0, 96, 64, texture = celspan.linear{ from = {0, 0}, to = {96, 9},
      {0, "#123"}, {1, "#fa0"} } },
    celspan.circle{ centre = {10 + 6 * at, 30.5}, radius = 20, texture = "#e8e0d0a0" } },
    celspan.cel{ celspan.circle{ centre = {70 - at, 40}, radius = 9, texture = "#205080" }, defocus
      = 4 } }
end }
]]

--- The same with a fault in frames 3, 6 and 7.
local FAULTY =
  (FILM:gsub("local at",
    'if f.number == 3 or f.number // 2 == 3 then error("no moon") end\n  local at', 1))

--- Frames with procedures among frames without; the procedure sees the latest change by the frame
--- function.
local PROCEDURES = [[
local celspan = require "celspan"
local last
return celspan.film{ size = {96, 64}, frames = 9, frame = function(f)
  last = f.number
  local art = celspan.circle{ centre = {8 * f.number, 30}, radius = 12 }
  if f.number % 3 == 0 then
    art = celspan.scanline{ bounds = {0, 0, 96, 64}, spans = function(y)
      return { {last, 10 * last + y / 9, "#f00"} }
    end }
  end
  return celspan.rostrum{ celspan.cel{ art } }
end }
]]

local function render(script, arguments, ...)
  return bench:celspan("render %s/%s " .. arguments, bench.folder, script, ...)
end

--- The files of a folder of the bench by name.
local function contents(folder)
  local found = {}
  for _, name in ipairs(bench:files(folder)) do found[name] = bench:read(folder .. "/" .. name) end
  return found
end

--- The events of --progress json of one kind; every line must be an object.
local function events(text, kind)
  local found = {}
  for line in text:gmatch "[^\n]+" do
    local event = assert(json.decode(line))
    assert.are.equal("string", type(event.event), line)
    if event.event == kind then found[#found + 1] = event end
  end
  return found
end

--- How each frame was made, in the order of the reports: "1 made 2 copied".
local function ways(text)
  local list = {}
  for _, event in ipairs(events(text, "frame")) do
    list[#list + 1] = ("%d %s"):format(event.number, event.how)
  end
  return table.concat(list, " ")
end

local function count(text, pattern) return select(2, text:gsub(pattern, "")) end

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
  bench:write("faulty.lua", FAULTY)
end)
after_each(function() bench:remove() end)

describe("frames by several workers", function()
  local function assert_alike(script, ending, arguments)
    local alone
    for workers = 1, 3 do
      local folder = "w" .. workers
      local code, out, err = render(script,
        "-o %s/%s/f.##.%s --workers %d --progress none --hash %s",
        bench.folder, folder, ending, workers, arguments or "")
      assert.are.equal(0, code, err)
      local made = { out, contents(folder) }
      alone = alone or made
      assert.are.same(alone, made)
    end
    return alone[2]
  end

  it("are the same to the byte, in files and digests #workers", function()
    local files = assert_alike("film.lua", "png")
    assert.is_truthy(files["f.12.png"] and files["f.01.png"] ~= files["f.02.png"])
    assert_alike("film.lua", "tga", "--size 50x40 --antialias gaussian:4")
    assert_alike("film.lua", "span", "--frames 12-1:-1")
  end)

  it("are reported in order #workers", function()
    local function told(workers)
      local code, _, err = render("film.lua", "-o %s/t%d/f.##.png --workers %d --progress lines",
        bench.folder, workers, workers)
      assert.are.equal(0, code)
      return (err:gsub("/t%d/", "/"):gsub(", %d+:%d+ left", ""):gsub("in %d+:%d+", "in"))
    end
    local alone = told(1)
    assert.is_truthy(alone:find("frame 12: .*f%.12%.png %(12 of 12, 100 %%%)"))
    for workers = 2, 3 do assert.are.equal(alone, told(workers)) end
  end)

  it("with procedures see the changes by their frame function #workers", function()
    bench:write("procedures.lua", PROCEDURES)
    assert_alike("procedures.lua", "png")
  end)

  it("stop at the first frame that fails; those before it are kept #workers", function()
    for workers = 1, 3 do
      local code, _, err = render("faulty.lua", "-o %s/e%d/f.##.png --workers %d --progress none",
        bench.folder, workers, workers)
      assert.are.equal(3, code)
      assert.is_truthy(err:find("faulty.lua:3: frame 3: no moon", 1, true), err)
      assert.are.equal(1, count(err, "error"), err)
      assert.is_truthy(err:find("2 of 12 frames are finished", 1, true), err)
      assert.are.same({ "f.01.png", "f.02.png" }, bench:files("e" .. workers))
    end
  end)

  it("name the frame and the cel that fails when it is made #workers", function()
    bench:write("singular.lua", [[
      local celspan = require "celspan"
      return celspan.film{ size = {8, 4}, frames = 9, frame = function(f)
        return celspan.rostrum{ celspan.cel{ celspan.circle{ centre = {f.number, 2}, radius = 2 },
          viewport = {0, 0, f.number == 5 and 1e-300 or 1, 1} } } end }]])
    for workers = 1, 3 do
      local code, _, err = render("singular.lua", "--hash --workers %d --progress none", workers)
      assert.are.equal(3, code, err)
      assert.is_truthy(err:find("^celspan: error: frame 5: cel 1 %([^)]*singular.lua:3%): "), err)
    end
  end)

  it("leave only complete frames after a signal #workers", function()
    bench:write("long.lua", (FILM:gsub("frames = 12", "frames = 100000")
      :gsub("f.number < 7", "f.number > 0"):gsub("f.index", "f.index %% 977 / 7")))
    local code, _, err =
      bench:shell(("env --default-signal=INT '%s' render %s/long.lua --size 900x600 --workers 3"
      .. " --progress none -o %s/out/f.######.png & pid=$!; "
      .. "sleep 0.7; kill -INT $pid; wait $pid; exit $?")
      :format(bench.binary, bench.folder, bench.folder))
    assert.are.equal(130, code, err)
    for _, name in ipairs(bench:files "out") do
      assert.is_truthy(name:find("^f%.%d+%.png$"), name)
      assert.are.equal("IEND", bench:read("out/" .. name):sub(-8, -5))
    end
  end)

  it("leave no files if a file may not grow #workers", function()
    local code, _, err =
      bench:shell(("ulimit -f 4; '%s' render %s/film.lua --size 3000x2000 --workers 2 "
      .. "--depth 16 --progress none -o %s/out/f.##.png")
      :format(bench.binary, bench.folder, bench.folder))
    assert.are.equal(5, code, err)
    assert.is_truthy(err:find("^celspan: error: frame 1: "), err)
    assert.are.same({}, bench:files "out")
  end)

  it("are made by celspan.render too, whose progress only grows #workers", function()
    local film = assert(loadfile(bench.folder .. "/film.lua"))()
    for workers = 1, 3 do
      local last, seen = 0, 0
      assert(celspan.render(film, bench.folder .. "/l" .. workers .. "/f.##.png",
        { workers = workers,
        progress = function(share, frame)
          assert(share >= last and share <= 1 and frame >= seen and frame <= 12)
          last, seen = share, frame
        end }))
      assert.are.same({ 1, 12 }, { last, seen })
      assert.are.same(contents "l1", contents("l" .. workers))
      local done, message = celspan.render(film, bench.folder .. "/s/f.##.png", { workers = workers,
        progress = function(share) return share < 0.5 end })
      assert.is_nil(done)
      assert.is_truthy(message:find "^stopped after %d of 12 frames"
        or message:find "^stopped after %d+ of 64 rows")
      done, message = celspan.render(film, bench.folder .. "/s/f.##.png", { workers = workers,
        progress = function(share) return share < 0.5 or error "enough" end })
      assert.is_nil(done)
      assert.is_truthy(message:find "enough")
    end
  end)

  it("pass on an error of a frame function in celspan.render #workers", function()
    local film = assert(loadfile(bench.folder .. "/faulty.lua"))()
    for workers = 1, 3 do
      local done, message = celspan.render(film, bench.folder .. "/f.##.png", { workers = workers })
      assert.is_nil(done)
      assert.is_truthy(message:find("faulty.lua:3: frame 3: no moon", 1, true), message)
    end
  end)
end)

describe("frames to standard output by several workers", function()
  local FRAME = 96 * 64 * 4 -- bytes

  local function raw(script, workers, arguments)
    return render(script, "-o - --workers %d --progress none %s", workers, arguments or "")
  end

  it("are the same to the byte, whatever memory they have #workers", function()
    bench:write("procedures.lua", PROCEDURES)
    for _, script in ipairs { "film.lua", "procedures.lua" } do
      local code, alone, err = raw(script, 1)
      assert.are.equal(0, code, err)
      assert.are.equal((script == "film.lua" and 12 or 9) * FRAME, #alone)
      assert.is_true(alone:sub(1, FRAME) ~= alone:sub(FRAME + 1, 2 * FRAME))
      for workers = 2, 3 do
        for _, memory in ipairs { "", "--memory 0", "--memory 1" } do
          local _, out = raw(script, workers, memory)
          assert.is_true(alone == out, ("%s %d %s"):format(script, workers, memory))
        end
      end
    end
  end)

  it("have the codes and the place that was asked for #workers", function()
    for _, arguments in ipairs { "--depth 16", "--depth half", "--dither --alpha premultiplied",
      "--depth float --colour linear", "--crop 10,7,33,21" } do
      local code, alone, err = raw("film.lua", 1, arguments)
      assert.are.equal(0, code, err)
      local _, out = raw("film.lua", 2, arguments)
      assert.is_true(alone == out, arguments)
    end
  end)

  it("end before the first that fails #workers", function()
    bench:write("singular.lua", (FILM:gsub("defocus%s*= 4",
      "viewport = {0, 0, f.number == 5 and 1e-300 or 1, 1}")))
    for script, frame in pairs { ["faulty.lua"] = 3, ["singular.lua"] = 5 } do
      local alone
      for workers = 1, 3 do
        local code, out, err = raw(script, workers)
        alone = alone or out
        assert.are.equal(3, code, err)
        assert.is_truthy(err:find(("frame %d: "):format(frame), 1, true), err)
        assert.are.equal(1, count(err, "error"), err)
        -- one worker writes the rows of a frame while it makes them
        assert.are.equal((frame - 1) * FRAME, #out)
        assert.is_true(alone == out)
      end
    end
  end)

  it("end with 5 when nobody reads them any more #workers", function()
    for workers = 1, 3 do
      local _, out = bench:shell(("{ '%s' render %s/film.lua -o - --workers %d --progress none "
        .. "2>&3; echo $? >&3; } 3>&1 >/dev/full"):format(workbench.binary, bench.folder, workers))
      assert.is_truthy(out:find "^celspan: error: frame 1: standard output: [^\n]+\n", out)
      assert.is_truthy(out:find "\n5\n$", out)
      local _, said = bench:shell(("{ { '%s' render %s/film.lua -o - --workers %d --progress none "
        .. "2>&3; echo $? >&3; } | head -c 1000 >/dev/null; } 3>&1")
        :format(workbench.binary, bench.folder, workers))
      assert.is_truthy(said:find "frame %d+: standard output: Broken pipe\n", said)
      assert.are.equal(1, count(said, "error"), said)
      assert.is_truthy(said:find "\n5\n$", said)
    end
  end)
end)

describe("a frame by several workers", function()
  local function assert_alike(ending, arguments)
    local alone
    for workers = 1, 4 do
      local name = ("one%d.%s"):format(workers, ending)
      local code, out, err = render("film.lua",
        "-o %s/%s --frames 4 --hash --progress none --workers %d %s",
        bench.folder, name, workers, arguments)
      assert.are.equal(0, code, err)
      local made = out .. bench:read(name)
      alone = alone or made
      assert.is_true(alone == made, ("%s with %d workers"):format(arguments, workers))
    end
  end

  it("is the same PNG to the byte, with one strip or many #workers", function()
    -- A strip has 2^18 pixels and more: with sanitizers, which are slow, there are only three.
    local w, h = 1500, 2100
    if present.sanitizer() then w, h = 600, 1000 end
    assert_alike("png", "--size 700x300")
    assert_alike("png", ("--size %dx%d"):format(w, h))
    assert_alike("png", ("--size %dx%d --depth 16 --crop 3,70,%d,%d"):format(w, h, w - 10, h - 101))
    assert_alike("png", "--size 30000x60 --antialias none")
  end)

  it("is the same file in the other formats too #workers", function()
    assert_alike("tga", "--size 700x300")
    assert_alike("span", "--size 700x300")
  end)

  it("can be rendered only for statistics, or as discarded pixels #workers", function()
    for _, pixels in ipairs { "", "--pixels 8", "--pixels float" } do
      local alone
      for workers = 1, 4 do
        local code, out, err =
          bench:celspan("spans %s/film.lua --frame 4 --size 700x900 --stats %s "
          .. "--workers %d", bench.folder, pixels, workers)
        assert.are.equal(0, code, err)
        local counts = out:match "^(rows 900 .- pixels_in_arrays %d+)"
        alone = alone or counts
        assert.are.equal(alone, counts)
      end
    end
  end)
end)

describe("equal frames", function()
  it("are copied, with the same result as if they were made #workers", function()
    for workers = 1, 2 do
      local code, _, err = render("film.lua", "-o %s/a%d/f.##.png --progress json --workers %d",
        bench.folder, workers, workers)
      assert.are.equal(0, code, err)
      assert.are.equal("1 made 2 made 3 made 4 made 5 made 6 made 7 made 8 copied 9 made 10 copied "
        .. "11 made 12 copied", ways(err))
      assert.are.equal(3, events(err, "end")[1].copied)
    end
    local _, _, err = render("film.lua", "-o %s/again/f.##.png --progress json --memory 0",
      bench.folder)
    assert.are.equal(0, events(err, "end")[1].copied)
    assert.are.same(contents "again", contents "a2")
  end)

  it("are separate files", function()
    render("film.lua", "-o %s/own/f.##.png --frames 7-8 --progress none", bench.folder)
    local before = bench:read "own/f.07.png"
    assert.are.equal(before, bench:read "own/f.08.png")
    bench:write("own/f.08.png", "painted over")
    assert.are.equal(before, bench:read "own/f.07.png")
  end)

  it("have equal digests without files", function()
    local _, out, err = render("film.lua", "--hash --progress json --frames 7-8")
    assert.are.equal("7 made 8 copied", ways(err))
    local seven, eight = out:match "^7 (%x+)\n8 (%x+)\n$"
    assert.are.equal(seven, eight)
  end)

  it("are made if the file contains its frame number, or with procedures", function()
    bench:write("procedures.lua", (PROCEDURES:gsub("f%.number %% 3 == 0", "true")
      :gsub("last = f.number", "last = 1")))
    local code, _, err = render("procedures.lua", "--hash --progress json")
    assert.are.equal(0, code, err)
    assert.is_falsy(ways(err):find "copied")
    code, _, err = render("film.lua", "-o %s/f.##.exr --frames 7-8 --progress json", bench.folder)
    if code == 5 and err:find("celspan-picture.so", 1, true) then return pending(err) end
    assert.are.equal("7 made 8 made", ways(err))
  end)

  it("are counted by info", function()
    local _, out = bench:celspan("info %s/film.lua", bench.folder)
    assert.is_truthy(out:find("\ndifferent 9\n", 1, true), out)
  end)
end)

describe("--keep-going", function()
  it("makes the other frames after a failure, and ends with 1 and a list #workers", function()
    local alone
    for workers = 1, 3 do
      local code, out, err = render("faulty.lua",
        "-o %s/k%d/f.##.png --workers %d --keep-going --hash "
        .. "--progress none", bench.folder, workers, workers)
      assert.are.equal(1, code, err)
      assert.is_truthy(err:find("celspan: error: 3 of 12 frames failed: 3, 6-7\n", 1, true), err)
      assert.are.equal(3, count(err, "no moon"), err)
      assert.are.equal(9, #bench:files("k" .. workers))
      local made = { out, (err:gsub("/k%d/", "/")), contents("k" .. workers) }
      alone = alone or made
      assert.are.same(alone, made)
    end
  end)

  it("lists as many as fit a line, without cutting a number", function()
    bench:write("odd.lua", [[
      local celspan = require "celspan"
      return celspan.film{ size = {1, 1}, frames = 900, frame = function(f)
        return f.number % 3 > 0 and error "odd" or celspan.rostrum{} end }]])
    local code, _, err = render("odd.lua", "--hash --keep-going --progress none")
    assert.are.equal(1, code)
    local list = err:match "celspan: error: 600 of 900 frames failed: 1%-2, 4%-5, ([^\n]*)\n$"
    assert.is_truthy(list and list:find ", %.%.%.$", err:sub(-1200))
    local last = 5
    for first, second in list:gmatch "(%d+)%-(%d+), " do
      assert.are.same({ last + 2, last + 3 }, { tonumber(first), tonumber(second) })
      last = last + 3
    end
    assert.is_true(#list > 900 and last > 300)
  end)

  it("ends with 0 when nothing failed, and with 3 when there is no film", function()
    assert.are.equal(0, (render("film.lua", "--hash --keep-going --progress none")))
    bench:write("none.lua", "return 7")
    assert.are.equal(3, (render("none.lua", "--hash --keep-going --progress none")))
  end)

  it("reports the frames that failed to programs", function()
    local _, out, err = render("faulty.lua", "-o %s/f.##.png --keep-going --progress json",
      bench.folder)
    assert.are.equal("", out)
    assert.are.same({ 3, 6, 7 }, events(err, "end")[1].failed)
    assert.are.equal(4, #events(err, "error"))
    _, out = render("faulty.lua", "-o %s/f.##.png --keep-going --progress openjd", bench.folder)
    assert.are.equal(4, count(out, "openjd_fail: [^\n]+\n"))
  end)
end)

describe("--progress", function()
  it("json is one object per line on standard error", function()
    local code, out, err = render("film.lua", "-o %s/f.##.png --progress json --workers 2",
      bench.folder)
    assert.are.same({ 0, "" }, { code, out })
    assert.are.equal(12, events(err, "start")[1].count)
    local last
    for i, event in ipairs(events(err, "frame")) do
      assert.are.same({ i, i, 12 }, { event.number, event.done, event.count })
      assert.is_true(math.abs(event.percent - 100 * i / 12) < 0.01 and event.seconds >= 0
        and event.left >= 0)
      assert.are.equal(("%s/f.%02d.png"):format(bench.folder, i), event.output)
      last = event
    end
    assert.are.equal(0, last.left)
    assert.are.equal(12, events(err, "end")[1].done)
  end)

  it("json reports failures and any name", function()
    local code, _, err = render("faulty.lua", "-o '%s/a \"b\" \\\195\255/f.##.png' --progress=json",
      bench.folder)
    assert.are.equal(3, code)
    assert.is_truthy(events(err, "error")[1].message:find("frame 3: no moon", 1, true))
    assert.is_truthy(events(err, "frame")[1].output:find('a "b" \\\239\191\189', 1, true))
    code, _, err = render("nothing.lua", "--hash --progress json")
    assert.are.equal(4, code)
    assert.are.equal(1, #events(err, "error"))
  end)

  --- The lines in short: the kind and its number; and the end, which is last.
  local function course(text)
    local list, last = {}, nil
    for line in text:gmatch "[^\n]+" do
      last = json.decode(line)
      list[#list + 1] = last.event .. (last.number and " " .. last.number or "")
    end
    return table.concat(list, ", "), last
  end

  it("json reports the frame that failed before the end of the run #workers", function()
    for workers = 1, 3 do
      local code, _, err = render("faulty.lua", "-o %s/f.##.png --progress json --workers %d",
        bench.folder, workers)
      local lines, last = course(err)
      assert.are.equal("start, frame 1, frame 2, error 3, note, end", lines)
      assert.are.same({ 3, 3, 1, { 3 }, 2, 12 },
        { code, last.exit, last.failures, last.failed, last.done, last.count })
    end
  end)

  it("json lists all failed frames under --keep-going, with a summary before the end", function()
    local code, _, err = render("faulty.lua", "-o %s/f.##.png --progress json --keep-going",
      bench.folder)
    local lines, last = course(err)
    assert.are.equal("start, frame 1, frame 2, error 3, frame 4, frame 5, error 6, error "
      .. "7, frame 8, frame 9, frame 10, frame 11, frame 12, note, error, end", lines)
    assert.are.same({ 1, 1, 3, { 3, 6, 7 }, 9 },
      { code, last.exit, last.failures, last.failed, last.done })
  end)

  it("json reports that a signal stopped the run", function()
    bench:write("slow.lua", (FILM:gsub("frames = 12", "frames = 100000"):gsub("local at = .-\n",
      'local at = f.number\n  if at == 2 then error "no moon" end\n')))
    local code =
      bench:shell(("'%s' render %s/slow.lua --hash --keep-going --progress json 2>%s/log & "
      .. "pid=$!; sleep 0.5; kill -TERM $pid; wait $pid; exit $?")
      :format(workbench.binary, bench.folder,
      bench.folder))
    local lines, last = course(bench:read "log")
    assert.are.equal(143, code, lines:sub(-300))
    assert.is_truthy(lines:find(", note, error, end$"), lines:sub(-300))
    assert.are.same({ "end", 143, { 2 } }, { last.event, last.exit, last.failed })
    assert.is_true(last.done < 100000)
  end)

  it("json reports a full standard output before the end", function()
    local code, _, err = bench:shell(("'%s' render %s/film.lua --hash --progress json >/dev/full")
      :format(workbench.binary, bench.folder))
    local lines, last = course(err)
    assert.is_truthy(lines:find("frame 12, error, end$"), lines)
    assert.are.same({ 5, 5, 0 }, { code, last.exit, last.failures })
  end)

  it("json has names with any bytes as text", function()
    local names = { ["\u{e9}\u{a3ff}\u{ffee}\u{e000}\u{1f600}\u{10ffff}"] = false,
      ["\x7f\"\\\9"] = false,
      ["\xe0\x9f\xbf"] = 3, ["\xed\xa0\x80"] = 3, ["\xf0\x8f\xbf\xbf"] = 4,
      ["\xf4\x90\x80\x80"] = 4, ["\xf5\xc1"] = 2,
      ["\xc3x"] = 1, ["\xf0\x9f\x98"] = 3, ["\x80"] = 1 }
    for name, broken in pairs(names) do
      local output = bench.folder .. "/" .. name .. ".#.png"
      local code, _, err =
        bench:shell(("'%s' render %s/film.lua --frames 1 --size 4x4 --progress json -o '%s'")
        :format(bench.binary, bench.folder, output))
      assert.are.equal(0, code, err)
      local expected = broken and (name:gsub("[\x80-\xff]", "\u{fffd}")) or name
      assert.are.equal(bench.folder .. "/" .. expected .. ".1.png", events(err, "frame")[1].output)
    end
  end)

  it("json of tiles reports errors before the end, too", function()
    local arguments = "tiles %s/film.lua -o %s/t --tile 32 --progress json"
    local code, _, err = bench:celspan(arguments, bench.folder, bench.folder)
    local lines, last = course(err)
    assert.is_truthy(lines:find("^start, tile row 0, .*, note, end$"), lines)
    assert.are.same({ 0, 0 }, { code, last.exit })
    bench:shell(("rm %s/t/index.html; mkdir %s/t/index.html"):format(bench.folder, bench.folder))
    code, _, err = bench:celspan(arguments, bench.folder, bench.folder)
    lines, last = course(err)
    assert.are.equal("start, error, end", lines)
    assert.are.same({ 5, 5 }, { code, last.exit })
  end)

  it("openjd writes lines to standard output", function()
    local code, out, err = render("film.lua", "-o %s/f.##.png --progress openjd", bench.folder)
    assert.are.same({ 0, 1 }, { code, count(err, "\n") }, err)
    local shares = {}
    for line in out:gmatch "([^\n]*)\n" do
      local share = line:match "^openjd_progress: (%d+%.?%d*)$"
      assert.is_truthy(share or line:find "^openjd_status: [^\n]+$", line)
      shares[#shares + 1] = tonumber(share)
    end
    assert.are.same({ 13, 0, 100 }, { #shares, shares[1], shares[13] })
    assert.are.equal(2, (render("film.lua", "-o - --progress openjd")))
  end)
end)

describe("--resume", function()
  local function resume(arguments, script)
    local code, _, err = render(script or "film.lua",
      "-o %s/out/f.##.png --resume --progress json %s",
      bench.folder, arguments or "")
    assert.are.equal(0, code, err)
    return ways(err)
  end
  local function whole()
    render("film.lua", "-o %s/whole/f.##.png --progress none", bench.folder)
    local frames = contents "out"
    frames[".f.##.png.frames"] = nil
    assert.are.same(contents "whole", frames)
  end
  local RECORD = "out/.f.##.png.frames"

  it("keeps frames that would not change and makes the rest #workers", function()
    assert.are.equal("1 made 2 made", resume "--frames 1-2 --workers 2")
    assert.are.equal("1 kept 2 kept 3 made 4 made", resume "--frames 1-4 --workers 2")
    assert.are.equal("4 made", resume "--frames 4 --size 90x64")
    assert.are.equal("3 kept 4 made 5 made", resume "--frames 3-5")
    assert.is_truthy(resume():find("5 kept 6 made 7 made 8 copied", 1, true))
    whole()
    assert.are.equal(12, count(resume(), "kept"))
  end)

  it("makes frames again if their file is not the one that was written", function()
    resume()
    local five = bench:read "out/f.05.png"
    bench:write("out/f.05.png", five:sub(1, -2) .. "x")
    bench:write("out/f.07.png", bench:read("out/f.07.png"):sub(1, 200))
    os.remove(bench.folder .. "/out/f.08.png")
    local found = resume()
    assert.are.equal(9, count(found, "kept"))
    assert.is_truthy(found:find("5 made 6 kept 7 made 8 copied 9 kept", 1, true), found)
    whole()
  end)

  it("makes only those frames again whose scene was edited", function()
    resume()
    bench:write("film.lua", (FILM:gsub("radius = 9", "radius = f.number == 4 and 8 or 9")))
    assert.is_truthy(resume():find("^1 kept 2 kept 3 kept 4 made 5 kept"))
    whole()
  end)

  it("ignores a truncated line of its record", function()
    resume "--frames 1-3"
    bench:write(RECORD, bench:read(RECORD):sub(1, -20))
    assert.are.equal("1 kept 2 kept 3 made", resume "--frames 1-3")
    assert.are.equal("1 kept 2 kept 3 kept", resume "--frames 1-3")
    bench:write(RECORD, "celspan frames 7\nof another time\n")
    assert.are.equal("1 made 2 made 3 made", resume "--frames 1-3")
    assert.are.equal("1 kept 2 kept 3 kept", resume "--frames 1-3")
  end)

  it("ignores invalid lines of its record", function()
    resume "--frames 1-2"
    local record = bench:read(RECORD)
    bench:write(RECORD,
      (record:gsub("\n(frame 1 [^\n]*)", "\n%1 and more")
        :gsub("\n(frame 2 .* )[^ \n]+\n", "\n%1zz\n")))
    assert.are.equal("1 made 2 made", resume "--frames 1-2")
    bench:write(RECORD, "")
    assert.are.equal("1 made 2 made", resume "--frames 1-2")
  end)

  it("ends with 5 if its record cannot be read or written", function()
    bench:shell(("mkdir -p '%s/out/%s'"):format(bench.folder, ".f.##.png.frames"))
    local code, _, err = render("film.lua", "-o %s/out/f.##.png --resume --progress none",
      bench.folder)
    assert.are.equal(5, code, err)
    assert.is_truthy(err:find(".f.##.png.frames: cannot ", 1, true), err)
    bench:shell(("cd '%s/out' && rmdir .f* && ln -s .f.##.png.frames .f.##.png.frames")
      :format(bench.folder))
    code, _, err = render("film.lua", "-o %s/out/f.##.png --resume --progress none", bench.folder)
    assert.are.equal(5, code, err)
    assert.is_truthy(err:find(".f.##.png.frames: cannot read: ", 1, true), err)
    code, _, err = render("film.lua", "-o %sf.##.png --resume --progress none", ("x/"):rep(2050))
    assert.are.equal(5, code, err)
    assert.is_truthy(err:find("the name is too long", 1, true), err)
  end)

  it("always makes frames with procedures", function()
    bench:write("procedures.lua", PROCEDURES)
    resume("", "procedures.lua")
    assert.are.equal("1 kept 2 kept 3 made 4 kept 5 kept 6 made 7 kept 8 kept 9 made",
      resume("", "procedures.lua"))
  end)

  it("with --hash prints the digests of kept frames", function()
    local function digests(arguments)
      return select(2, render("film.lua", "-o %s/out/f.##.png --frames 1-3 --progress none --hash "
        .. arguments, bench.folder))
    end
    resume "--frames 1"
    local made = digests ""
    assert.are.equal(3, count(made, "\n"))
    assert.are.equal(made, digests "--resume")
    assert.are.equal(made, digests "--resume")
    os.remove(bench.folder .. "/" .. RECORD)
    assert.are.equal(made, digests "--resume --force") -- frames without a known digest are made
  end)

  it("with --force keeps every complete file", function()
    render("film.lua", "-o %s/out/f.##.png --frames 1-2 --progress none", bench.folder)
    assert.are.equal("1 kept 2 kept 3 made", resume "--force --frames 1-3")
    bench:write("film.lua", (FILM:gsub("radius = 20", "radius = 19")))
    assert.are.equal("1 kept 2 kept 3 kept", resume "--force --frames 1-3")
    bench:write("out/f.03.png", "no picture")
    assert.are.equal("1 kept 2 kept 3 made", resume "--force --frames 1-3")
    bench:write("out/f.04.png", "")
    assert.are.equal("4 made 5 made", resume "--force --frames 4-5")
    assert.are.equal("1 made 2 made 3 kept", resume "--frames 1-3")
  end)

  it("never copies from a frame that --force kept", function()
    bench:write("film.lua", (FILM:gsub("radius = 20", "radius = 19")))
    resume "--frames 7"
    bench:write("film.lua", FILM)
    assert.are.equal("7 kept 8 made", resume "--force --frames 7-8")
  end)

  it("after kill -9, at any moment, gives the same as a run that was never killed", function()
    for i = 1, 6 do -- a build for coverage would leave truncated counts: it must write none
      bench:shell(("GCOV_PREFIX=/dev/null '%s' render %s/film.lua -o %s/out/f.##.png --resume "
        .. "--workers 2 --size 1200x800 "
        .. "--progress none & pid=$!; sleep %.2f; kill -9 $pid; wait $pid")
        :format(bench.binary, bench.folder, bench.folder, 0.02 * i * i))
    end
    assert.are.equal(0,
      (render("film.lua", "-o %s/out/f.##.png --resume --size 1200x800 --progress none",
      bench.folder)))
    render("film.lua", "-o %s/whole/f.##.png --size 1200x800 --progress none", bench.folder)
    local frames = contents "out"
    assert.is_truthy(frames[".f.##.png.frames"])
    frames[".f.##.png.frames"] = nil
    assert.are.same(contents "whole", frames)
  end)

  it("does not touch files that others are still writing, or that are not its own", function()
    bench:shell(("mkdir %s/out"):format(bench.folder))
    for _, name in ipairs { ".f.03.png.00ff.part", ".f.04.png.0001.part", ".g.03.png.00ff.part",
                            ".f.x.png.00ff.part", "f.03.png.00ff.part", ".f.03.png.00gg.part",
                            ".f.03.png.00ff.gone",
                            ".f.03.pngx00ff.part" } do
      bench:write("out/" .. name, "half")
    end
    local code, _, err = bench:shell(("flock %s/out/.f.04.png.0001.part '%s' render %s/film.lua "
      .. "-o %s/out/f.##.png --resume --frames 1 --progress none")
      :format(bench.folder, bench.binary,
      bench.folder, bench.folder))
    assert.are.equal(0, code, err)
    assert.are.same({ ".f.##.png.frames", ".f.03.png.00ff.gone", ".f.03.png.00gg.part",
      ".f.03.pngx00ff.part",
      ".f.04.png.0001.part", ".f.x.png.00ff.part",
      ".g.03.png.00ff.part", "f.01.png", "f.03.png.00ff.part" }, bench:files "out")
  end)

  it("makes frames again whose pictures changed", function()
    bench:write("picture.lua", [[
      local celspan = require "celspan"
      return celspan.film{ size = {8, 4}, frames = 2, frame = function(f)
        return celspan.rostrum{ celspan.cel{ f.number == 1 and
          celspan.image{ file = "still.png", w = 8, h = 4 } or celspan.rect{ 0, 0, 8, 4 } } } end
            }]])
    render("film.lua", "-o %s/still.png --frames 1 --size 8x4 --progress none", bench.folder)
    local code, _, err = render("picture.lua", "-o %s/out/f.##.png --resume --progress none",
      bench.folder)
    if code == 4 and err:find("celspan-picture.so", 1, true) then return pending(err) end
    assert.are.equal("1 kept 2 kept", resume("", "picture.lua"))
    render("film.lua", "-o %s/still.png --frames 2 --size 8x4 --progress none", bench.folder)
    assert.are.equal("1 made 2 kept", resume("", "picture.lua"))
  end)

  it("needs files, and --force needs it", function()
    assert.are.equal(2, (render("film.lua", "--hash --resume")))
    assert.are.equal(2, (render("film.lua", "-o - --resume")))
    assert.are.equal(2, (render("film.lua", "-o %s/f.##.png --force", bench.folder)))
  end)
end)
