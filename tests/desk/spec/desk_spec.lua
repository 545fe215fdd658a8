-- The animator's desk: test, init, contact, onion skin and pictures of differences. One file,
-- because its verbs are tried on the same film.
local json = require "celspan.json"
local celspan = require "celspan"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BINARY = workbench.binary

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function run(arguments) return bench:celspan_inside("%s", arguments) end

local pictures = {} -- as pixels, by their bytes

--- The colour of a pixel in a picture of the folder: linear, premultiplied.
local function pixel(name, x, y)
  local bytes = bench:read(name)
  if not pictures[bytes] then
    local w, h = (">I4I4"):unpack(bytes, 17) -- of a PNG
    local image = celspan.image { file = bench.folder .. "/" .. name, x = 0, y = 0 }
    pictures[bytes] = assert(celspan.pixels(celspan.rostrum { celspan.cel { image } },
      { size = { w, h }, film = { w, h }, antialias = "none" }))
  end
  return pictures[bytes]:get(x, y)
end

local function size_of(name)
  local _, out = run("info " .. name)
  return out:match "size (%d+x%d+)"
end

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 40, 20 }, frames = 12, frame = function(f)
  local ground = celspan.cel { celspan.rect { 0, 0, 40, 20, texture = "#fff" } }
  local ball = celspan.cel { celspan.rect { 3 * f.index, 0, 3, 20, texture = "#000" } }
  return celspan.rostrum { ground, ball }
end }
]]

local SPEC = [[
require "celspan.spec"
local film = require "film"
describe("the film", function()
  it("begins at the left", function() assert.point(film, 1, 1, 10).shows "#000" end)
  it("is not there any more", function() assert.point(film, 5, 1, 10).is_not.shows "#000" end)
end)
]]

describe("celspan test", function()
  it("runs every spec of the folder in Lua 5.4 and sums up", function()
    bench:write("film.lua", FILM)
    bench:shell("mkdir -p " .. bench.folder .. "/spec/deeper")
    bench:write("spec/film_spec.lua", SPEC)
    bench:write("spec/deeper/version_spec.lua", [[
      it("is Lua 5.4", function() assert.equal("Lua 5.4", _VERSION) end)
      pending "is for later"]])
    bench:write("spec/helper.lua", "error 'not a spec'")
    local code, out, err = run "test"
    assert.equal(0, code, out .. err)
    assert.truthy(out:find("spec/deeper/version_spec.lua: 1 passed, 0 failed, 1 skipped\n", 1,
      true), out)
    assert.truthy(out:find("spec/film_spec.lua: 2 passed, 0 failed, 0 skipped\n", 1, true), out)
    assert.truthy(out:find("\n3 passed, 0 failed, 1 skipped in 2 spec files, ", 1, true), out)
    assert.equal("", err)
  end)

  it("writes the results as XML for other programs, whatever tests are called", function()
    bench:write("first_spec.lua", [[
      it("is <good> & \"quoted\"", function() end)
      it("is \xff\1 wrong", function() error "with <a> reason" end)
      pending "is for later"]])
    assert.equal(1, (run "test first_spec.lua --junit out/report.xml"))
    local xml = bench:read "out/report.xml"
    for _, part in ipairs { '<testsuite name="first_spec.lua" tests="3" failures="1" skipped="1" ',
      'name="is &lt;good&gt; &amp; &quot;quoted&quot;" ', 'name="is ?  wrong" ',
      "with &lt;a&gt; reason</failure>", '<skipped message="is for later">' } do
      assert.truthy(xml:find(part, 1, true), part .. "\n" .. xml)
    end
    assert.equal(0, (bench:shell(([[python3 -c 'import sys, xml.dom.minidom as d; d.parse("%s")']])
      :format(bench.folder .. "/out/report.xml"))))
  end)

  it("gives the scripts of specs the values of parameters", function()
    bench:write("film.lua", [[local celspan = require "celspan"
return celspan.film { frames = celspan.parameters { count = 3 }.count, frame = function() end }]])
    bench:write("count_spec.lua", [[
      it("has frames", function() assert.equal(5, dofile("film.lua").frames) end)]])
    assert.equal(1, (run "test count_spec.lua"))
    assert.equal(0, (run "test count_spec.lua --set count=5"))
    bench:write("values.json", '{ "count": 5 }')
    assert.equal(0, (run "test count_spec.lua --set-from values.json"))
    assert.equal(2, (run "test count_spec.lua --set count"))
    local _, out = run "test count_spec.lua --set-from none.json"
    assert.truthy(out:find("with exit code 4", 1, true), out)
  end)

  it("prints the same, in the order of the list, with any number of workers", function()
    bench:write("slow_spec.lua", [[
      it("takes its time", function() local n = 0 for i = 1, 3e6 do n = n + i end end)]])
    bench:write("quick_spec.lua", [[it("fails", function() assert.is_true(false) end)]])
    local function printed(workers)
      local code, out = run("test slow_spec.lua quick_spec.lua --workers " .. workers)
      assert.equal(1, code)
      return (out:gsub("[%d.]+ seconds", ""))
    end
    local one = printed(1)
    assert.truthy(one:find("^slow_spec.lua: 1 passed"), one)
    assert.equal(one, printed(2))
  end)

  it("ends with 1 and prints test, position and message of each failure", function()
    bench:write("film.lua", FILM)
    bench:write("bad_spec.lua", (SPEC:gsub("is_not%.", "")))
    local code, out = run "test bad_spec.lua"
    assert.equal(1, code)
    assert.truthy(out:find("failed: the film is not there any more (bad_spec.lua:5)\n"
      .. "    frame 5 shows #ffffff at 1, 10, not #000000", 1, true), out)
    assert.truthy(out:find("bad_spec.lua: 1 passed, 1 failed, 0 skipped\n", 1, true), out)
  end)

  it("prints the position of an assertion that cannot be decided", function()
    bench:write("film.lua", FILM)
    bench:write("new_spec.lua", [[
require "celspan.spec"
local film = require "film"
it("has no picture", function() assert.frame(film, 1).looks_like "new.png" end)
it("has no such cel", function() assert.cel(film, 1, "hand").is_visible() end)
it("has no such frame", function() assert.frame(film, 99).looks_like "new.png" end)
it("has no such row", function() assert.row(film, 1, 99).holds { single = 1 } end)]])
    local code, out = run "test new_spec.lua"
    assert.equal(1, code)
    for line, name in ipairs { "picture", "cel", "frame", "row" } do
      local position = ("has no %s%s (new_spec.lua:%d)\n"):format(line > 1 and "such " or "", name,
        line + 2)
      assert.truthy(out:find(position, 1, true), out)
    end
  end)

  it("counts a spec that cannot be loaded, ends its process, or is killed", function()
    bench:write("a_spec.lua", "it(")
    bench:write("b_spec.lua", [[it("stops", function() os.exit(3) end)]])
    bench:write("c_spec.lua", [[it("dies", function() os.execute("kill -9 $PPID") end)]])
    bench:write("d_spec.lua", [[it("passes", function() end)]])
    local code, out = run "test ."
    assert.equal(1, code)
    assert.truthy(out:find("a_spec.lua:1: ", 1, true), out)
    assert.truthy(out:find("failed: ./b_spec.lua ended before its tests did, with exit code 3", 1,
      true), out)
    assert.truthy(out:find("failed: ./c_spec.lua was ended by signal 9", 1, true), out)
    assert.truthy(out:find("1 passed, 3 failed, 0 skipped in 4 spec files", 1, true), out)
  end)

  it("counts a spec that busted cannot run, and reports why", function()
    bench:write("film_spec.lua", SPEC)
    bench:shell(("mkdir -p %s/broken/busted"):format(bench.folder))
    for _, part in ipairs { "init", "runner", "core" } do
      bench:write("broken/busted/" .. part .. ".lua", "error 'this one is broken'")
    end
    local code, out =
      bench:shell(("cd %s && LUA_PATH_5_4='./broken/?.lua;./broken/?/init.lua' '%s' test "
      .. "film_spec.lua")
      :format(bench.folder, BINARY))
    assert.equal(1, code)
    assert.truthy(out:find("this one is broken\n", 1, true), out)
    assert.truthy(out:find("stack traceback:\n", 1, true), out)
    assert.truthy(out:find("film_spec.lua ended before its tests did, with exit code 3", 1, true),
      out)
  end)

  it("ends with its specs at a signal", function()
    bench:write("slow_spec.lua",
      [[it("waits", function() os.execute "echo $PPID >id; exec sleep 60" end)]])
    bench:write("slower_spec.lua", [[it("waits", function() os.execute "exec sleep 60" end)]])
    local code, _, err = bench:shell(([[cd %s && {
      '%s' test slow_spec.lua slower_spec.lua --workers 1 & pid=$!
      for i in $(seq 200); do [ -s id ] && break; sleep 0.02; done
      kill -TERM $pid; wait $pid; }]]):format(bench.folder, BINARY))
    assert.equal(143, code, err)
    local id = assert(tonumber(bench:read "id"))
    assert.falsy(os.execute(("kill -0 %d 2>/dev/null"):format(id)))
  end)

  it("looks for specs in deep folders, except hidden ones", function()
    bench:write("film.lua", FILM)
    local deep = ("d/"):rep(31)
    bench:shell(("cd %s && mkdir -p %sd .hidden"):format(bench.folder, deep))
    for _, folder in ipairs { deep, ".hidden/", deep .. "d/" } do
      bench:write(folder .. "a_spec.lua", "it('passes', function() end)")
    end
    local code, out = run "test ."
    assert.equal(0, code, out)
    assert.truthy(out:find("1 passed, 0 failed, 0 skipped in 1 spec file", 1, true), out)
  end)

  it("runs the tests that --only selects, and fails if there are none", function()
    bench:write("film.lua", FILM)
    bench:write("film_spec.lua", SPEC)
    local code, out = run "test film_spec.lua --only 'at the left'"
    assert.equal(0, code)
    assert.truthy(out:find("1 passed, 0 failed", 1, true), out)
    local none, _, err = run "test film_spec.lua --only nothing"
    assert.equal(1, none)
    assert.truthy(err:find("no test has a name that matches --only", 1, true), err)
    bench:write("empty_spec.lua", "describe('nothing', function() end)")
    none, _, err = run "test empty_spec.lua"
    assert.equal(1, none)
    assert.truthy(err:find("the spec files contain no tests", 1, true), err)
  end)

  it("shows the output of a test under the name of its spec", function()
    bench:write("talk_spec.lua", [[it("talks", function() print "good evening" end)]])
    local _, out = run "test talk_spec.lua"
    assert.truthy(out:find("printed by talk_spec.lua:\ngood evening\n", 1, true), out)
  end)

  it("ends with 4 if there is no spec", function()
    for arguments, said in pairs { ["test"] = "spec: cannot be opened",
      ["test no.lua"] = "no.lua: cannot be opened",
                                   ["test ."] = "no file in it ends in _spec.lua" } do
      local code, _, err = run(arguments)
      assert.equal(4, code, err)
      assert.truthy(err:find(said, 1, true), err)
    end
  end)

  it("ends with 5 and the name of the package if busted is missing", function()
    bench:write("film_spec.lua", SPEC)
    local code, _, err = bench:shell(("cd %s && LUA_PATH_5_4='./none/?.lua' '%s' test "
      .. "film_spec.lua"):format(bench.folder, BINARY))
    assert.equal(5, code, err)
    assert.truthy(err:find("lua-busted", 1, true), err)
  end)
end)

describe("celspan init", function()
  it("lays out a film that renders and whose tests pass", function()
    local code, out, err = run "init walk"
    assert.equal(0, code, err)
    assert.truthy(out:find("cd walk", 1, true))
    for _, name in ipairs { "film.lua", "cat.lua", "town.lua", "timing.lua", "tune.lua", "tune.wav",
      "spec/film_spec.lua", "type/block.ttf", "README.md", ".luarc.json", ".luacheckrc", ".busted",
      ".vscode/tasks.json", ".vscode/extensions.json" } do
      assert.truthy(bench:read(bench.folder .. "/walk/" .. name), name)
    end
    assert.truthy(bench:read(bench.folder .. "/walk/README.md"):find("^# walk\n"))
    for line in bench:read(bench.folder .. "/walk/film.lua"):gmatch "[^\n]+" do
      assert.is_true(utf8.len(line) <= 120, line) -- the limit in its .luacheckrc
    end
    local checked, _, faults = run "check walk/film.lua"
    assert.equal(0, checked, faults)
    local tested, told = bench:shell(("cd %s/walk && '%s' test"):format(bench.folder, BINARY))
    assert.equal(0, tested, told)
    assert.truthy(told:find("4 passed, 0 failed, 0 skipped", 1, true), told)
    local rendered = run "render walk/film.lua --scale 0.1 --progress none -o out/####.png"
    assert.equal(0, rendered)
  end)

  local counts = present.program "valgrind" and it or pending
  counts("takes at most 100 million instructions #plain", function()
    local count = "valgrind --tool=callgrind --callgrind-out-file=/dev/null '%s' init %s/walk 2>&1"
    local text = system.output(count:format(BINARY, bench.folder))
    local found = text:match "Collected : (%d+)"
    assert.is_true(found and tonumber(found) <= 100e6, text)
  end)

  it("takes names with spaces and letters of every script", function()
    local code, out, err = run "init 'Mein Füchslein 2'"
    assert.equal(0, code, err)
    assert.truthy(out:find("cd 'Mein Füchslein 2'", 1, true), out)
    assert.equal(0, (run "check 'Mein Füchslein 2/film.lua'"))
  end)

  it("lays out tasks whose pattern finds the lines of faults", function()
    run "init walk"
    local tasks = json.decode(bench:read(bench.folder .. "/walk/.vscode/tasks.json")).tasks
    local pattern
    for _, task in ipairs(tasks) do
      if task.label == "celspan: check" then pattern = task.problemMatcher.pattern.regexp end
    end
    local steps = bench:write("match.js", ([[
      const pattern = new RegExp(process.argv[2]);
      const found = ["film.lua:3: unexpected symbol", "frames 3-17, 20: film.lua:7: no",
        "frame 2: cel 2 'a' (walk.lua:12), primitive 3: n.png: cannot be opened", "other"]
        .map(text => ("celspan: error: " + text).match(pattern));
      console.log(JSON.stringify(found.map(one => one ? one.slice(1) : [])));]]))
    local _, out = bench:shell(("node '%s' '%s'"):format(steps, pattern))
    assert.same({ { "film.lua", "3", "unexpected symbol" }, { "film.lua", "7", "no" },
                  { "walk.lua", "12", "n.png: cannot be opened" }, {} }, json.decode(out))
  end)

  it("names the folder of the annotations that exists", function()
    run "init walk"
    local folder = bench:read(bench.folder .. "/walk/.luarc.json"):match 'library": %["([^"]*)"'
    assert.truthy(bench:read(folder .. "/celspan.d.lua"), folder)
  end)

  it("lays out a film of six seconds whose sound its own program computes", function()
    run "init walk"
    local _, told = run "info walk/film.lua"
    assert.truthy(told:find("\nseconds 6\n", 1, true), told)
    assert.truthy(told:find("\nmark 70 catch\n", 1, true), told)
    local tune = bench:read(bench.folder .. "/walk/tune.wav")
    assert.equal(44 + 6 * 16000 * 2, #tune)
    bench:shell(("cd %s/walk && lua5.4 tune.lua >again.wav"):format(bench.folder))
    assert.is_true(tune == bench:read(bench.folder .. "/walk/again.wav"))
  end)

  it("replaces nothing", function()
    bench:shell("mkdir " .. bench.folder .. "/walk")
    bench:write("walk/film.lua", "mine")
    local code, _, err = run "init walk"
    assert.equal(5, code)
    assert.truthy(err:find("walk: the folder is not empty", 1, true), err)
    assert.equal("mine", bench:read(bench.folder .. "/walk/film.lua"))
  end)

  it("accepts an empty folder, and reports why another place is not possible", function()
    bench:shell(("cd %s && mkdir empty && echo >file"):format(bench.folder))
    assert.equal(0, (run "init empty"))
    for path, expected in pairs {
      ["file/walk"] = { 5, "file/walk: cannot be a folder for the film: Not a directory" },
      ["/proc/none/walk"] = { 5, "/proc/none/walk/" },
      [("x/"):rep(1100) .. "walk"] = { 2, "is too long a path" } } do
      local code, _, err = run("init " .. path)
      assert.equal(expected[1], code, err)
      assert.truthy(err:find(expected[2], 1, true), err)
    end
  end)

  it("refuses invalid names", function()
    for _, name in ipairs { "' b'", "'b '", "'a\"b'", "'\255'", ".", "..", "''", "walk/",
      "'@NAME@'", ("long"):rep(26) } do
      local code, _, err = run("init " .. name)
      assert.equal(2, code, name)
      assert.truthy(err:find("cannot be the name of a film", 1, true), err)
    end
    assert.equal(2, (run "init"))
  end)
end)

describe("celspan contact", function()
  before_each(function() bench:write("film.lua", FILM) end)

  it("lays all frames of a short film side by side", function()
    local code, _, err = run "contact film.lua -o sheet.png"
    assert.equal(0, code, err)
    -- 6 and 2 frames of 40 x 20, 12 and 24 pixels apart
    assert.equal("324x100", size_of "sheet.png")
    local black, white = pixel("sheet.png", 13, 20), pixel("sheet.png", 13 + 52, 20)
    -- the first frame begins at the left, the second does not
    assert.is_true(black < 0.01 and white > 0.99)
    assert.is_true(pixel("sheet.png", 12 + 52 + 4, 20) < 0.01)
  end)

  it("leaves out frames until the film fits, or shows every N-th, or those of --frames", function()
    run "contact film.lua -o four.png --grid 2x2"
    run "contact film.lua -o three.png --grid 3x4 --every 4"
    run "contact film.lua -o two.png --frames 3-4"
    assert.equal("116x100", size_of "four.png")
    assert.equal("168x100", size_of "three.png")
    assert.equal("116x56", size_of "two.png")
    assert.is_true(pixel("three.png", 12 + 52 + 13, 20) < 0.01) -- frame 5 is the second
    assert.is_true(pixel("two.png", 12 + 7, 20) < 0.01)
  end)

  it("always shows the last frame", function()
    run "contact film.lua -o last.png --frames 12"
    run "contact film.lua -o five.png --grid 5x1"
    run "contact film.lua -o every.png --grid 3x1 --every 8"
    for name, place in pairs { ["five.png"] = 4, ["every.png"] = 2 } do
      for x = 12, 51 do
        assert.equal(pixel("last.png", x, 20), pixel(name, x + 52 * place, 20), name .. x)
      end
    end
    run "contact film.lua -o two.png --grid 5x1 --frames 1,3,4,6,8,9"
    run "contact film.lua -o nine.png --frames 9"
    assert.equal("220x56", size_of "two.png")
    for x = 12, 51 do assert.equal(pixel("nine.png", x, 20), pixel("two.png", x + 156, 20)) end
  end)

  it("writes a number under each frame", function()
    run "contact film.lua -o sheet.png --frames 8"
    local darkest = 1
    for x = 12, 24 do
      for y = 38, 50 do darkest = math.min(darkest, (pixel("sheet.png", x, y))) end
    end
    assert.is_true(darkest < 0.3)
  end)

  it("writes the number of the frame, not of its position", function()
    run "contact film.lua -o one.png --frames 1"
    run "contact film.lua -o eight.png --frames 8"
    local function ink(name)
      local sum = 0
      for x = 12, 24 do
        for y = 38, 50 do sum = sum + 1 - (pixel(name, x, y)) end
      end
      return sum
    end
    assert.is_true(ink "eight.png" > ink "one.png" + 1)
  end)

  it("makes panels no wider than 480 pixels, in the film's shape", function()
    bench:write("wide.lua", (FILM:gsub("size = { 40, 20 }", "size = { 1000, 500 }")))
    assert.equal(0, (run "contact wide.lua -o wide.png --frames 1 --grid 1x1"))
    assert.equal("504x276", size_of "wide.png")
  end)

  it("makes panels of the size that is asked for", function()
    run "contact film.lua -o scaled.png --frames 1,2 --scale 2.5"
    run "contact film.lua -o sized.png --frames 1,2 --size 60x50"
    assert.equal("236x86", size_of "scaled.png") -- two of 100 x 50
    assert.equal("156x86", size_of "sized.png")
    local code, _, err = run "contact film.lua -o sheet.png --size 9x9 --scale 2"
    assert.equal(2, code)
    assert.truthy(err:find("--size and --scale say the same thing twice", 1, true), err)
    for _, scale in ipairs { "100000", "1000" } do
      code, _, err = run("contact film.lua -o sheet.png --scale " .. scale)
      assert.equal(6, code)
      assert.truthy(err:find("give a smaller --scale", 1, true), err)
    end
  end)

  it("makes pages if the name has a number, and else refuses more than fit", function()
    local code = run "contact film.lua -o page.##.png --grid 2x2 --every 1"
    assert.equal(0, code)
    assert.equal("116x100", size_of "page.03.png")
    assert.equal(4, (run "info page.04.png"))
    local refused, _, err = run "contact film.lua -o page.png --grid 2x2 --every 1"
    assert.equal(2, refused)
    assert.truthy(err:find("12 frames do not fit into a grid of 2 x 2", 1, true), err)
  end)

  it("ends like render does", function()
    bench:write("bad.lua", (FILM:gsub("%-%- ", ""):gsub("3 %* f%.index", "f.nothing")))
    bench:write("missing.lua",
      (FILM:gsub('celspan.rect { 3 %* f.index.-}',
        'celspan.image { file = "no.png", w = 1, h = 1 }')))
    assert.equal(3, (run "contact bad.lua -o sheet.png"))
    assert.equal(4, (run "contact missing.lua -o sheet.png"))
    assert.equal(4, (run "contact no.lua -o sheet.png"))
    assert.equal(2, (run "contact film.lua"))
    assert.equal(2, (run "contact film.lua -o sheet.png --grid 0x3"))
    assert.equal(2, (run "contact film.lua -o sheet.xyz"))
    assert.equal(5, (run "contact film.lua -o /dev/null/sheet.png"))
  end)
end)

describe("render --onion", function()
  before_each(function() bench:write("film.lua", FILM) end)

  it(
    "shows drawings before in red and after in green, fading by half", function()
    local code, _, err = run "render film.lua --frames 6 --onion 2,1 -o onion.png"
    assert.equal(0, code, err)
    local function at(frame) return pixel("onion.png", 3 * (frame - 1) + 1, 10) end
    local r, g, b = at(5)
    assert.is_true(r > 0.6 and g < 0.65 and b < 0.65 and r > g + 0.1)
    local far_r, far_g = at(4)
    assert.is_true(far_r - far_g < r - g and far_r > far_g) -- half as strong
    local after_r, after_g = at(7)
    assert.is_true(after_g > after_r + 0.1)
    assert.is_true(at(6) < 0.01) -- the frame itself
    for _, frame in ipairs { 1, 2, 3, 8, 9 } do
      local other_r, other_g, other_b = at(frame)
      -- the ground is in all of them
      assert.is_true(other_r > 0.99 and other_g > 0.99 and other_b > 0.99)
    end
  end)

  it("leaves out frames before the first and after the last", function()
    run "render film.lua --frames 1,12 --onion 3,3 -o onion.##.png"
    local r, g = pixel("onion.01.png", 4, 10)
    assert.is_true(g > r)
    local last_r, last_g = pixel("onion.12.png", 31, 10)
    assert.is_true(last_r > last_g)
  end)

  it("keeps frames in place under a camera, and in any size", function()
    bench:write("camera.lua",
      (FILM:gsub("{ ground, ball }", "{ ground, ball, camera = { width = 20 } }")))
    assert.equal(0, (run "render camera.lua --frames 6 --onion 1,0 --size 64x32 -o camera.png"))
    -- frame 5's ball is at 12..15 of the film, and the camera sees 10..30
    local r, g = pixel("camera.png", math.floor((13.5 - 10) * 64 / 20), 16)
    assert.is_true(r > g + 0.1)
    assert.is_true(pixel("camera.png", math.floor((16.5 - 10) * 64 / 20), 16) < 0.01)
  end)

  it("is the same with any number of workers, and refuses impossible options", function()
    local _, one = run "render film.lua --onion 2,2 --hash --workers 1"
    local _, four = run "render film.lua --onion 2,2 --hash --workers 4"
    assert.equal(one, four)
    for _, wrong in ipairs { "2", "0,0", "-1,2", "2,99" } do
      assert.equal(2, (run("render film.lua --hash --onion=" .. wrong)))
    end
  end)

  it("shows what moves before a camera that moves, and no more", function()
    bench:write("camera.lua", (FILM:gsub("{ ground, ball }",
      "{ ground, ball, camera = { centre = { 18 + f.index, 10 }, width = 20 } }")))
    assert.equal(0, (run "render camera.lua --frames 6 --onion 1,0 -o camera.png"))
    -- the camera sees 13..33 of the film, twice as large; frame 5's ball is at 12..15
    local r, g = pixel("camera.png", 2, 10)
    assert.is_true(r > g + 0.1)
    for _, x in ipairs { 12, 30, 39 } do
      local red, green, blue = pixel("camera.png", x, 4)
      assert.is_true(red == green and green == blue, "x = " .. x)
    end
  end)

  --- The middle row of a frame, as pixels of 8 bits.
  local function row_of(options, frame)
    local code, bytes = run(("render shot.lua --frames %d -o - --crop 0,10,40,1 ")
      :format(frame or 6) .. options)
    assert.equal(0, code)
    return bytes
  end

  --- The columns where onion skin changes something in a frame, as text.
  local function changed(script, onion, frame)
    bench:write("shot.lua", script)
    local plain = row_of(onion:match "%-%-cel.*" or "", frame)
    local skinned, list = row_of("--onion " .. onion, frame), {}
    for x = 0, 39 do
      local from, to = 4 * x + 1, 4 * x + 4
      if plain:sub(from, to) ~= skinned:sub(from, to) then list[#list + 1] = x end
    end
    return table.concat(list, " ")
  end

  --- A film of 40 by 20 with the ball of each frame, 9 units wide, at 3 * f.index.
  local function film_of(cels)
    return ([[
local celspan = require "celspan"
local multiplane = require "celspan.multiplane"
return celspan.film { size = { 40, 20 }, frames = 12, frame = function(f)
  local ground = celspan.rect { 0, 0, 40, 20, texture = "#fff" }
  local ball = celspan.rect { 3 * f.index, 0, 9, 20, texture = celspan.rgb(f.index / 20, 0, 0) }
  return %s
end }]]):format(cels)
  end

  it("never covers the drawing of the frame, which is at 15 to 23", function()
    for _, cels in ipairs {
      "celspan.rostrum { celspan.cel { ground }, celspan.cel { ball } }",
      "celspan.rostrum { celspan.cel { ground, ball } }", -- in one cel
      "celspan.rostrum { back = '#fff', celspan.cel { ball } }",
      "celspan.rostrum { celspan.cel { ground, celspan.circle { centre = { f.index, 1 }, "
        .. "radius = 1 } }, celspan.cel { ball } }", -- an opaque ground that moves
      "{ { celspan.rostrum { celspan.cel { ground }, celspan.cel { ball } }, 0.5 }, "
        .. "{ celspan.rostrum { celspan.cel { ground }, celspan.cel { ball } }, 0.5 } }",
    } do
      assert.equal("9 10 11 12 13 14 24 25 26", changed(film_of(cels), "2,1"), cels)
    end
  end)

  it("does not show differences of less than four codes", function()
    local film = film_of [[celspan.rostrum { celspan.cel { ground }, celspan.cel { celspan.rect {
      0, 0, 40, 20, texture = celspan.rgb(0.2 + %s * f.index / 255, 0.2, 0.2, 0.9) } } }]]
    assert.equal("", changed(film:format(2), "1,1"))
    assert.is_true(#changed(film:format(20), "1,1") > 40)
  end)

  it("counts drawings, also of a ball on twos behind a cloud on ones", function()
    local film = film_of [[celspan.rostrum { celspan.cel { ground },
      celspan.cel { celspan.rect { 8 * (f.index // 2), 0, 4, 20 } }:named "ball",
      celspan.cel { celspan.rect { 28 + f.index, 0, 1, 20 } } }]]
    local both = "8 9 10 11 24 25 26 27 "
    assert.equal(both .. "31 33", changed(film, "1,1", 5))
    assert.equal(both .. "32 34", changed(film, "1,1", 6))
    for frame = 5, 6 do
      assert.equal("0 1 2 3 8 9 10 11 24 25 26 27 32 33 34 35",
        changed(film, "2,2 --cel ball", frame))
    end
  end)

  it("passes over drawings that return", function()
    assert.equal("0 1 30 31", changed(film_of [[celspan.rostrum { celspan.cel { ground },
      celspan.cel { celspan.rect { ({ 30, 30, 0, 10, 0, 10 })[f.number] or 10, 0, 2, 20 } } }]],
      "2,0"))
  end)

  it("finds the drawings around one that is held for long, and of other cels half a second on",
    function()
      local film = film_of([[celspan.rostrum { celspan.cel { ground },
        celspan.cel { celspan.rect { f.number > %d and 9 or 0, 0, 2, 20 } },
        celspan.cel { celspan.rect { f.number > %d and 29 or 20, 0, 2, 20 } } }]])
        :gsub("frames = 12", "frames = 200"):gsub("f.index / 20", "0")
      assert.equal("29 30", changed(film:format(199, 99), "1,1"))
      assert.equal("9 10 29 30", changed(film:format(110, 99), "1,1"))
      assert.equal("", changed(film:format(199, 198), "1,1"))
    end)

  it("shows nothing of held planes before a multiplane camera that pans or moves in", function()
    for _, camera in ipairs { "x = 4 * f.index", "z = 9 * f.index", "x = f.index, z = -f.index" } do
      local film = film_of([[multiplane { film = { 40, 20 }, camera = { %s }, aperture = 1,
        { celspan.cel { celspan.rect { -99, -99, 300, 300, texture = "#fff" } }, z = 900 },
        { celspan.cel { celspan.rect { 12, 0, 4, 20 } }, z = 300 },
        { celspan.cel { celspan.rect { 4 * BALL, 0, 4, 20 } }, z = 0 },
        over = { celspan.cel { celspan.rect { 0, 0, 3, 20 } } } }]]):format(camera)
      assert.equal("", changed(film:gsub("BALL", "1"), "2,2"), camera)
      assert.are_not.equal("", changed(film:gsub("BALL", "f.index"), "2,2"), camera)
    end
  end)

  it("shows nothing of planes that only a multiplane camera moves", function()
    assert.equal("10 11 12 13 22 23 24 25", changed(film_of [[multiplane {
      film = { 40, 20 }, camera = { x = f.index / 3 }, focal = 100,
      { celspan.cel { celspan.rect { -99, 0, 200, 20, texture = "#fff" } }, z = 100 },
      { celspan.cel { celspan.rect { 30, 0, 4, 20, texture = "#888" } }, z = 50 },
      { celspan.cel { ball }, z = 0 },
      { celspan.cel { celspan.rect { 5, 0, 2, 20, texture = "#888" } }, z = -20 } }]], "1,1"))
  end)

  it("lies over a frame that is one opaque drawing", function()
    assert.is_true(#changed(film_of [[celspan.rostrum { celspan.cel {
      celspan.rect { 0, 0, 40, 20, texture = celspan.rgb(f.progress, 0, 0) } } }]], "1,0") > 40)
  end)

  it("is on contact sheets too", function()
    assert.equal(0, (run "contact film.lua -o plain.png --grid 4x3"))
    assert.equal(0, (run "contact film.lua -o sheet.png --grid 4x3 --onion 1,0"))
    -- frame 6, in the second panel of the second row: its ball is at 15 to 17
    local function at(name, x) return pixel(name, 12 + 52 + x, 12 + 44 + 10) end
    local r, g = at("sheet.png", 13)
    assert.is_true(r > g + 0.1)
    assert.is_true(at("plain.png", 13) > 0.99)
    for _, x in ipairs { 2, 16, 30 } do
      assert.same({ at("plain.png", x) }, { at("sheet.png", x) })
    end
    assert.equal(2, (run "contact film.lua -o sheet.png --onion 2"))
  end)

  it("lays one cel over itself with --cel", function()
    bench:write("two.lua", (FILM:gsub("{ ground, ball }",
      "{ ground, ball:named 'ball', ball:translate(0, 1) }")))
    assert.equal(0, (run "render two.lua --frames 6 --onion 1,0 --cel ball -o one.png"))
    assert.equal(0, (run "render two.lua --frames 6 --cel ball -o alone.png"))
    local r, g = pixel("one.png", 3 * 4 + 1, 10)
    assert.is_true(r > g + 0.1)
    local _, _, _, alpha = pixel("one.png", 39, 10) -- the ground is not there
    assert.equal(0, alpha)
    assert.equal(2, (run "render two.lua --frames 6 --onion 1,0 --cel none -o one.png"))
  end)
end)

describe("compare -o", function()
  it("shows where two pictures differ", function()
    bench:write("film.lua", FILM)
    run "render film.lua --frames 1,3 -o f.#.png"
    local code, out = run "compare f.1.png f.3.png -o difference.png"
    assert.equal(1, code)
    assert.truthy(out:find("pixels_differing 120 ", 1, true), out)
    local r, g = pixel("difference.png", 1, 10)
    assert.is_true(r > 3 * g)
    local red, green = pixel("difference.png", 7, 10)
    assert.is_true(red > 3 * green)
    local pale, same = pixel("difference.png", 4, 10)
    assert.is_true(pale == same and pale > 0.9)
  end)

  it(
    "counts every pixel of a run, in span files too, and reports the position of the "
    .. "largest difference", function()
    bench:write("film.lua", FILM)
    bench:write("other.lua", (FILM:gsub('texture = "#fff" }', 'texture = "#fffff0" }')))
    run "render film.lua --frames 1,3 -o f.#.span"
    run "render other.lua --frames 1 -o g.span"
    local code, out = run "compare f.1.span f.3.span -o difference.png"
    assert.equal(1, code)
    assert.truthy(out:find("pixels_differing 120 pixels 800", 1, true), out)
    local r, g = pixel("difference.png", 8, 19)
    assert.is_true(r > 3 * g)
    code, out = run "compare f.1.span g.span"
    assert.equal(1, code)
    assert.truthy(out:find("x 3 y 0 channel b pixels_differing 740 pixels 800", 1, true), out)
    assert.equal(0, (run "compare f.1.span g.span --fail 0.06"))
  end)

  it("is redder where the difference is larger, whatever the channel", function()
    local function lines(a, b, c)
      bench:write("lines.lua", ([[
local celspan = require "celspan"
return celspan.rostrum { size = { 12, 4 }, celspan.cel { celspan.rect { 0, 0, 4, 4, texture = "%s"
  },
  celspan.rect { 4, 0, 4, 4, texture = "%s" }, celspan.rect { 8, 0, 4, 4, texture = "%s" } }
    }]]):format(a, b, c))
    end
    lines("#808080", "#808080", "#808080")
    run "render lines.lua --size 12x4 -o a.png"
    lines("#8080ff", "#ff8080", "#848080")
    run "render lines.lua --size 12x4 -o b.png"
    run "compare a.png b.png -o difference.png"
    local blue, red, weak = { pixel("difference.png", 2, 2) }, { pixel("difference.png", 6, 2) },
      { pixel("difference.png", 10, 2) }
    assert.are.same(blue, red)
    assert.is_true(red[2] < weak[2])
  end)

  it("is pale where nothing differs by more than --fail", function()
    bench:write("film.lua", FILM)
    run "render film.lua --frames 1,3 -o f.#.png"
    assert.equal(0, (run "compare f.1.png f.3.png -o difference.png --fail 1"))
    local r, g, b = pixel("difference.png", 1, 10)
    assert.is_true(r == g and g == b and r < 0.5)
    assert.equal(2, (run "compare f.1.png f.3.png -o difference.xyz"))
    assert.equal(5, (run "compare f.1.png f.3.png -o /dev/null/difference.png"))
  end)

  it("compares films frame by frame", function()
    bench:write("film.lua", FILM)
    bench:write("other.lua", (FILM:gsub("3 %* f.index", "f.number == 2 and 30 or 3 * f.index")))
    run "render film.lua --frames 1-4 -o a.##.png"
    run "render other.lua --frames 1-3 -o b/%d.png"
    local code, out, err = run "compare a.##.png b/%d.png -o difference.#.png"
    assert.equal(1, code, err)
    assert.truthy(out:find("^frame 1 largest_difference 0 pixels_differing 0 pixels 800\n"
      .. "frame 2 largest_difference 1 x 3 y 0 channel r pixels_differing 120 pixels 800\n"
      .. "frame 3 largest_difference 0 pixels_differing 0 pixels 800\nframe 4 only_in a.##.png\n$"),
      out)
    assert.is_truthy(bench:read "difference.2.png")
    assert.equal(0, (run "compare a.##.png a.##.png"))
    code, out = run "compare b/%d.png a.##.png"
    assert.equal(1, code)
    assert.truthy(out:find("frame 4 only_in a.##.png\n$"), out)
    os.remove(bench.folder .. "/a.04.png")
    code, out = run "compare b/%d.png a.##.png"
    assert.equal(1, code) -- because of frame 2
    assert.falsy(out:find("only_in", 1, true), out)
    os.remove(bench.folder .. "/a.02.png")
    code, out = run "compare a.##.png b/%d.png"
    assert.equal(1, code) -- because of frames that only the second one has
    assert.truthy(out:find("frame 2 only_in b/%d.png\n$", 1, false)
      or out:find("frame 2 only_in b/", 1, true), out)
    assert.equal(2, (run "compare a.##.png b/%d.png -o difference.png"))
    assert.equal(4, (run "compare a.##.png none.#.png"))
    assert.equal(4, (run "compare a.##.png none/#.png"))
  end)
end)
