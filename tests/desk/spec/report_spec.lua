-- What a run says of itself in files: the log of --log and the report of --report.
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 32, 18 }, fps = 24, frames = 6, frame = function(f)
  if f.number == BAD then error "no such\nframe" end
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9 * (f.number // 2), 9 },
    radius = 4 } } }
end }
]]

local LINE = "^%d%d%d%d%-%d%d%-%d%dT%d%d:%d%d:%d%d%.%d%d%dZ %S+ celspan%[%d+%] (%l+): (.*)$"

local bench

setup(function()
  bench = workbench.new()
  bench:write("film.lua", (FILM:gsub("BAD", "0")))
  bench:write("bad.lua", (FILM:gsub("BAD", "4")))
end)

teardown(function() bench:remove() end)

local function render(arguments) return bench:celspan_inside("%s", "render " .. arguments) end

--- The lines of a log as "kind: text".
local function log_of(name)
  local list = {}
  for line in bench:read(name):gmatch "[^\n]+" do
    local kind, text = line:match(LINE)
    if kind then
      list[#list + 1] = kind .. ": " .. text
    else
      list[#list] = list[#list] .. "\n" .. line
    end
  end
  return list
end

local function report_of(name) return json.decode(bench:read(name)) end

describe("the log of a run", function()
  it("has each frame and each message, whatever the progress is", function()
    for _, style in ipairs { "none", "lines", "json" } do
      local name = style .. ".log"
      assert.equal(0, (render(("film.lua -o %s.##.png --log %s --progress %s"):format(style, name,
        style))))
      local lines = log_of(name)
      assert.equal(9, #lines)
      assert.is_truthy(lines[1]:find("^note: celspan %S+ %(%S+%): render film.lua$"), lines[1])
      assert.equal(("note: begins: %s.##.png: 6 frames"):format(style), lines[2])
      assert.equal(("note: frame 1: %s.01.png: made (1 of 6)"):format(style), lines[3])
      assert.equal(("note: frame 3: %s.03.png: copied (3 of 6)"):format(style), lines[5])
      assert.is_truthy(lines[9]:find("^note: ends: %w+.##.png: 6 of 6 finished, 0 failed, in %S+ "
        .. "seconds, exit code 0$"), lines[9])
    end
  end)

  it("grows, and shows a message as one", function()
    assert.equal(3, (render "bad.lua -o bad.##.png --log both.log"))
    assert.equal(2, (render "film.lua -o bad.##.png --log both.log --frames 99"))
    local lines = log_of "both.log"
    local failed = lines[6]
    assert.is_truthy(failed:find("^error: .*frame 4: no such\n    frame"), failed)
    assert.is_truthy(lines[#lines]:find("^error: .*99"), lines[#lines])
  end)

  it("is refused where it cannot be written, and ends where a disk is full", function()
    local code, _, err = render "film.lua -o no.##.png --log missing/run.log"
    assert.equal(5, code)
    assert.is_truthy(err:find("missing/run.log: the log cannot be written: No such file", 1, true))
    assert.is_nil(bench:read "no.01.png")
    assert(os.execute(("mkfifo '%s/nobody.log'"):format(bench.folder)))
    code, _, err = render "film.lua -o no.##.png --log nobody.log"
    assert.equal(5, code)
    assert.is_truthy(err:find("nobody.log: the log cannot be written", 1, true), err)
    code, _, err = render "film.lua -o full.##.png --log /dev/full"
    assert.equal(0, code)
    assert.equal(1, select(2, err:gsub("the log of %-%-log ends here", "")))
    assert.is_truthy(bench:read "full.06.png")
  end)
end)

describe("the report of a run", function()
  it("has counts, memory, versions and the slowest frames", function()
    assert.equal(0, (render "film.lua -o r.##.png --report out/run.json"))
    local found = report_of "out/run.json"
    local _, version = bench:celspan_inside "--version"
    assert.equal(version, ("celspan %s (%s)\n"):format(found.celspan, found.commit))
    if present.pictures() then assert.is_truthy(found.openimageio:find "^%d+%.%d+") end
    if present.avif() then assert.is_truthy(found.libavif:find "^%d+%.%d+") end
    assert.same({ 6, 4, 2, 0, 0, 0 }, { found.frames, found.made, found.copied, found.kept,
      found.failures, found.exit })
    assert.same({ "film.lua", "r.##.png" }, { found.script, found.output })
    assert.equal(6, #found.slowest)
    for i = 2, 6 do assert.is_true(found.slowest[i].seconds <= found.slowest[i - 1].seconds) end
    assert.is_true(found.memory.process > 1e6 and found.memory.celspan > 1e4)
    assert.is_nil(found.ffmpeg)
  end)

  it("is written after failures, too, and under --strict in a folder of its own", function()
    assert.equal(1, (render "bad.lua -o k/k.##.png --report k.json --keep-going --strict"))
    local found = report_of "k.json"
    assert.same({ 1, 1, 5 }, { found.exit, found.failures, found.made + found.copied })
    assert.equal(4, found.failed[1])
  end)

  it("finds a slow frame", function()
    bench:write("slow.lua", (FILM:gsub("if f.number == BAD.-end",
      "if f.number == 5 then for _ = 1, 5e7 do end end")))
    assert.equal(0, (render "slow.lua -o s.##.png --report s.json"))
    assert.equal(5, report_of "s.json".slowest[1].frame)
  end)

  it("does not wait for an ffmpeg that does not say its version", function()
    if not present.program "ffmpeg" then return pending "there is no ffmpeg" end
    local _, where = bench:shell "command -v ffmpeg"
    assert(os.execute(("mkdir -p '%s/bin'"):format(bench.folder)))
    bench:write("bin/ffmpeg", ("#!/bin/sh\n[ \"$1\" != -version ] || sleep 99\nexec %s \"$@\"\n")
      :format(where:match "%S+"))
    local code, _, err = bench:inside(("chmod +x bin/ffmpeg && PATH=\"$PWD/bin:$PATH\" timeout 60 "
      .. "'%s' render film.lua -o v.gif --progress none --report v.json"):format(
      workbench.absolute))
    assert.equal(0, code, err)
    assert.is_nil(report_of "v.json".ffmpeg)
    bench:write("bin/ffmpeg", ("#!/bin/sh\n[ \"$1\" != -version ] || exec echo ffmpeg version 9 x\n"
      .. "exec %s \"$@\"\n"):format(where:match "%S+"))
    assert.equal(0, (bench:inside(("PATH=\"$PWD/bin:$PATH\" '%s' render film.lua -o v.gif "
      .. "--progress none --report v.json"):format(workbench.absolute))))
    assert.equal("9", report_of "v.json".ffmpeg)
  end)

  it("is refused for tables, and where it cannot be written the run has failed", function()
    bench:write("rows.csv", "a\n1\n")
    local code, _, err = render "film.lua --table rows.csv -o '{a}.##.png' --report t.json"
    assert.equal(2, code)
    assert.is_truthy(err:find("--report is of one film", 1, true), err)
    code, _, err = render "film.lua -o u.##.png --report film.lua/r.json"
    assert.equal(5, code)
    assert.is_truthy(err:find("film.lua/r.json", 1, true), err)
  end)
end)

describe("the header of a file", function()
  it("names the version and the commit of celspan", function()
    local version = select(2, bench:celspan_inside "--version"):match "^[^\n]*"
    assert.is_truthy(version:find "^celspan %S+ %(%S+%)$")
    for _, ending in ipairs(present.pictures() and { "exr", "tif" } or {}) do
      assert.equal(0, (render(("film.lua --frames 1 -o h.%s"):format(ending))))
      assert.is_truthy(bench:read("h." .. ending):find(version, 1, true), ending)
    end
  end)
end)
