-- Pictures are decoded by processes of their own: a fault of a picture in its decoder is an error
-- that names the picture, soon and within limits, and no process or file is left.
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local HOSTILE = workbench.build .. "/tests/hostile_module.so"

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local is_slow = present.sanitizer()
-- A leak check attaches to the process from another one, which --strict does not allow.
local OPTIONS = "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0"

--- Runs celspan with the hostile module, in the folder of the bench. environment: additional
--- variables.
local function with_hostile(arguments, environment)
  return bench:shell(("cd '%s' && %s %s DECODER_SPEC='%s' CELSPAN_PICTURE_MODULE='%s' '%s' %s")
    :format(bench.folder, OPTIONS, environment or "", bench.folder, HOSTILE, workbench.absolute,
      arguments))
end

--- The names, sorted.
local function sorted(...)
  local names = { ... }
  table.sort(names)
  return names
end

--- A file that a picture module accepts as a picture.
local function write_picture(name) bench:write(name, "\x89PNG\r\n\x1a\n" .. name) end

--- A film whose frames each show the picture of one of these names.
local function film(names)
  for _, name in ipairs(names) do write_picture(name) end
  bench:write("film.lua", ([[local celspan = require "celspan"
local names = { "%s" }
return celspan.film { size = { 8, 8 }, frames = #names, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.image { file = names[f.number] } } } end }]])
    :format(table.concat(names, '", "')))
end

local function fails(code, pattern, arguments, environment)
  local got, _, err = with_hostile(arguments, environment)
  assert.are.equal(code, got, err)
  assert.truthy(err:find(pattern), err)
  local _, left = bench:shell(("grep -l 'DECODER_SPEC=%s' /proc/[0-9]*/environ")
    :format(bench.folder))
  assert.are.equal("", left)
end

describe("a picture that", function()
  local ends = {
    { "crash", 4, "it ended its decoder" }, { "abort", 4, "it ended its decoder" },
    { "leave", 4, "it ended its decoder with exit code 3" },
    { "hang", 6, "more than 0.3 seconds.*picture%-time" },
  }
  if not is_slow then
    ends[#ends + 1] = { "eat", 33, "more than 64 MiB.*picture%-memory" }
    ends[#ends + 1] = { "choke", 33, "more than 64 MiB.*picture%-memory" }
  end
  for _, one in ipairs(ends) do
    for _, when in ipairs { "", "open-" } do
      it("does " .. when .. one[1] .. " is an error that names it", function()
        local name = when .. one[1] .. ".png"
        film { name }
        local limits = "--limit picture-memory=64M,picture-time="
          .. (one[1] == "hang" and "0.3" or "30")
        fails(one[2], name:gsub("%p", "%%%0") .. ": .*" .. one[3],
          "render film.lua --hash --progress none " .. limits)
        assert.are.same(sorted(name, "film.lua", "stderr", "stdout"),
          sorted(table.unpack(bench:files())))
      end)
    end
  end

  for _, what in ipairs { "width", "height", "channels", "bits", "alpha", "format", "colour",
    "beyond" } do
    it("has an impossible header is an error that names it: " .. what, function()
      local name = "lie-" .. what .. ".png"
      write_picture(name)
      fails(4, "lie%-" .. what .. "%.png: its decoder sent an invalid answer", "info " .. name)
    end)
  end

  for _, how in ipairs { "babble", "endless", "odd", "tell" } do
    for _, when in ipairs { "", "open-" } do
      it("has taken over its decoder is not trusted: " .. when .. how, function()
        local name = when .. how .. ".png"
        film { name }
        fails(4, name:gsub("%p", "%%%0") .. ": its decoder sent an invalid answer",
          "render film.lua --hash --progress none")
      end)
    end
  end

  it("changes between opening and reading is an error", function()
    film { "touch.png" }
    fails(4, "touch%.png: changed while it was in use", "render film.lua --hash --progress none")
  end)

  it("has a layer with a name that is too long is an error", function()
    write_picture "good.png"
    bench:write("film.lua", [[local celspan = require "celspan"
return celspan.rostrum { celspan.cel { celspan.image { file = "good.png", layer = ("x"):rep(33 <<
  20) } } }]])
    fails(3, "good%.png: the name of its layer is too long",
      "render film.lua --hash --progress none")
  end)

  it(
    "ended a decoder is refused afterwards without another try; others have a "
    .. "new decoder", function()
    film { "hang.png", "good.png", "hang.png", "better.png", "hang.png", "hang.png" }
    fails(1, "hang%.png: .*more than 1 seconds",
      "render film.lua -o out/#.png --progress none --keep-going --workers 1 --limit "
      .. "picture-time=1")
    assert.are.same({ "2.png", "4.png" }, bench:files "out")
  end)

  it("was open in a decoder that another one crashed is opened again", function()
    bench:write("both.lua", [[local celspan = require "celspan"
return celspan.film { size = { 64, 64 }, frames = 2, frame = function(f)
  if f.number == 2 then return celspan.rostrum { celspan.cel { celspan.image { file = "crash.png" }
    } } end
  return celspan.rostrum { celspan.cel { celspan.image { file = "good.png" } } } end }]])
    write_picture "good.png"
    write_picture "crash.png"
    fails(1, "frame 2.*crash%.png",
      "render both.lua -o out/#.png --progress none --keep-going --workers 1")
    assert.are.same({ "1.png" }, bench:files "out")
  end)

  if not is_slow then
    it("needs more memory than others left gets a decoder of its own", function()
      film { "keep-1.png", "keep-2.png", "keep-3.png" }
      assert.are.equal(0,
        (with_hostile("render film.lua --hash --workers 1 --progress none --limit "
        .. "picture-memory=64M")))
    end)
  end
end)

describe("a limit of processes", function()
  -- The limit does not count for root, so the program runs as a user who has no other processes.
  local is_possible = present.pictures() and present.program "setpriv" and present.program "prlimit"
    and system.lines("id -u")[1] == "0"
  local it_as_a_user = is_possible and it or pending

  it_as_a_user("is an error with exit code 33, whatever cannot be started", function()
    bench:shell(("chmod 755 '%s' && mkdir '%s/open' && chmod 777 '%s/open'")
      :format(bench.folder, bench.folder, bench.folder))
    bench:write("make.lua", 'return require "celspan".rostrum { size = { 8, 8 } }')
    assert.are.equal(0, (bench:shell(("cd '%s' && '%s' render make.lua --progress none -o in.tif")
      :format(bench.folder, workbench.absolute))))
    bench:write("film.lua", [[local celspan = require "celspan"
      return celspan.rostrum { size = { 8, 8 }, celspan.cel {
        celspan.image { file = "in.tif", w = 8, h = 8 } } }]])
    local seen, asked = {}, { "film.lua -o open/a.png", "make.lua -o open/a.tif" }
    if present.program "ffmpeg" then asked[3] = "make.lua -o open/a.mp4" end
    for most = 1, 14 do
      for _, arguments in ipairs(asked) do
        local code, _, err = bench:shell(("cd '%s' && %s setpriv --reuid=23457 --clear-groups "
          .. "prlimit --nproc=%d '%s' render %s --progress none")
          :format(bench.folder, OPTIONS, most, workbench.absolute, arguments))
        assert.is_true(code == 0 or code == 33, most .. ": " .. err)
        seen[code] = true
      end
    end
    assert.are.same({ [0] = true, [33] = true }, seen)
  end)
end)

describe("a decoder", function()
  it("is not started with --trust", function()
    film { "crash.png" }
    local code = with_hostile "render film.lua --hash --progress none --trust"
    assert.is_true(code == 139 or is_slow and code ~= 0 and code ~= 4, code)
  end)

  it("is confined with --strict, and reads below the script's folder", function()
    film { "good.png" }
    local code, _, err = with_hostile "render film.lua --hash --progress none --strict"
    if code == 6 and err:find "the kernel" then return pending(err) end
    assert.are.equal(0, code, err)
    film { "crash.png" }
    fails(4, "crash%.png: it ended its decoder", "render film.lua --hash --progress none --strict")
  end)

  it("that ends while writing leaves no file", function()
    film { "good.png" }
    for name, code in pairs { ["crash.tif"] = 5, ["abort.exr"] = 5 } do
      fails(code, name:gsub("%p", "%%%0") .. ": writing it ended its decoder",
        "render film.lua --progress none --frames 1 -o out/" .. name)
      assert.are.same({}, bench:files "out")
    end
  end)

  it("that sends wrong data for a file leaves no file", function()
    film { "good.png" }
    for _, name in ipairs { "greedy.tif", "confused.exr" } do
      fails(5, "not taken", "render film.lua --progress none --frames 1 -o out/" .. name)
      assert.are.same({}, bench:files "out")
    end
  end)

  it("that cannot be started is an error", function()
    film { "good.png" }
    local loading = {
      crash = { 4, "ended during its start %(signal 11%); %-%-trust runs without it" },
      leave = { 33, "out of memory or processes while starting the picture decoder" } }
    for how, expected in pairs(is_slow and {} or loading) do
      fails(expected[1], "good%.png: .*" .. expected[2], "render film.lua --hash --progress none",
        "HOSTILE_LOADING=" .. how)
    end
    fails(4, "good%.png: .*version", "render film.lua --hash --progress none", "HOSTILE_IS_OLD=1")
    bench:write("film.lua", 'return require "celspan".rostrum { size = { 8, 8 } }')
    fails(5, "x%.exr: .*version", "render film.lua --progress none -o x.exr", "HOSTILE_IS_OLD=1")
  end)

  it("that does not start in time is stopped", function()
    film { "good.png" }
    local options = "render film.lua --hash --progress none --limit picture-time=0.05"
    fails(6,
      "good%.png: loading OpenImageIO took more than 0%.5 seconds and was stopped %(ten times "
      .. "%-%-limit picture%-time",
      options, "HOSTILE_LOADING=hang")
    if is_slow then return end -- the sanitizers' handlers replace those of the program
    fails(33, "good%.png: out of memory or processes while starting the picture decoder", options,
      "HOSTILE_LOADING=stick")
  end)

  it("that does not start in time ends with the program", function()
    film { "good.png" }
    local code = bench:shell(([[cd '%s' && HOSTILE_LOADING=hang CELSPAN_PICTURE_MODULE='%s' '%s' \
        render film.lua --hash --progress none & pid=$!
      for i in $(seq 100); do zygote=$(pgrep -P $pid); [ -n "$zygote" ] && break; sleep 0.02; done
      sleep 0.2; kill -TERM $pid; (sleep 20; kill -KILL $pid) & late=$!
      wait $pid; code=$?; kill -KILL $late $zygote; exit $code]]):format(bench.folder, HOSTILE,
        workbench.absolute))
    assert.are.equal(143, code)
  end)

  it("ends with the program, however that ends", function()
    film { "hang.png" }
    for _, signal in ipairs { "TERM", "KILL" } do
      local code = bench:shell(([[cd '%s' && CELSPAN_PICTURE_MODULE='%s' '%s' \
          render film.lua --hash --progress none & pid=$!
        for i in $(seq 100); do
          zygote=$(pgrep -P $pid); [ -n "$zygote" ] && one=$(pgrep -P $zygote) && break
          sleep 0.05
        done; [ -n "$one" ] || exit 99; kill -%s $pid; wait $pid; sleep %g
        grep -q '^State:.[^Z]' /proc/$zygote/status 2>/dev/null && exit 98
        grep -q '^State:.[^Z]' /proc/$one/status 2>/dev/null && exit 97; exit 0]])
        :format(bench.folder, HOSTILE, workbench.absolute, signal, is_slow and 3 or 0.5))
      assert.are.equal(0, code, signal)
    end
  end)

  it("that is killed from outside is only an error", function()
    film { "hang.png" }
    local code = bench:shell(([[cd '%s' && CELSPAN_PICTURE_MODULE='%s' '%s' \
        render film.lua --hash --progress none & pid=$!
      for i in $(seq 100); do zygote=$(pgrep -P $pid); [ -n "$zygote" ] && break; sleep 0.05; done
      sleep 0.5; kill -KILL $zygote; wait $pid]]):format(bench.folder, HOSTILE, workbench.absolute))
    assert.are.equal(33, code)
    assert.truthy(bench:read("stderr"):find("hang.png: the picture decoder was killed", 1, true))
  end)

  it("does not change descriptors", function()
    film { "good.png", "better.png", "best.png" }
    local code, out, err = bench:shell(([[cd '%s' && CELSPAN_PICTURE_MODULE='%s' sh -c
      'exec "%s" render film.lua -o out/#.png --progress none <&- >&- 2>&-'; ls out | wc -l]])
      :gsub("\n%s*", " "):format(bench.folder, HOSTILE, workbench.absolute))
    assert.are.equal(0, code, err)
    assert.are.equal("3\n", out)
  end)
end)

describe("a file that is not a picture", function()
  it("is an error at once", function()
    if not present.pictures() then return pending "there is no picture module" end
    bench:shell(("mkfifo '%s/pipe.png'; mkdir '%s/folder.png'"):format(bench.folder, bench.folder))
    for _, name in ipairs { "pipe.png", "folder.png", "/dev/zero", "/dev/null" } do
      local code, _, err = bench:shell(("cd '%s' && timeout 120 '%s' convert %s x.png")
        :format(bench.folder, workbench.absolute, name))
      assert.are.equal(4, code, err)
      assert.truthy(err:find(name .. ": is not a file; a picture must be one", 1, true), err)
    end
    fails(4, "none%.png: cannot be opened: No such file", "convert none.png x.png")
  end)
end)

describe("the limits of decoding", function()
  it("are checked numbers", function()
    film { "good.png" }
    for _, bad in ipairs { "picture-memory=x", "picture-memory=-1", "picture-time=2e6",
      "picture-time=1K", "picture=1" } do
      fails(2, "%-%-limit: '" .. bad:gsub("%p", "%%%0") .. "' is not",
        "info film.lua --limit " .. bad)
      fails(2, "%-%-limit: '" .. bad:gsub("%p", "%%%0") .. "' is not",
        "convert good.png x.png --limit " .. bad)
    end
    fails(2, "%-%-limit: 'time=1' is not", "convert good.png x.png --limit time=1")
    fails(2, "leave %-%-limit picture%-time out",
      "convert good.png x.png --trust --limit picture-time=1")
    assert.are.equal(0, (with_hostile "info good.png --limit picture-memory=0,picture-time=0"))
  end)
end)

describe("a colour profile that", function()
  --- Arguments that read a painting with these bytes as its profile, and the environment.
  local function reading(bytes, limit)
    bench:write("a.psd", paintings.psd { w = 4, h = 4, profile = bytes, layers = {} })
    bench:write("film.lua", [[local celspan = require "celspan"
local tree = assert(require "celspan.layers".read "a.psd")
for _, one in ipairs(tree.skipped) do print(one.what) end
return celspan.rostrum(tree:cels())]])
    return "render film.lua --hash --progress none --limit picture-memory=64M,picture-time="
      .. (limit or 30), ("CELSPAN_COLOUR_MODULE='%s'"):format(HOSTILE)
  end

  local ends = {
    { "crash", 4, "it ended its decoder by signal" },
    { "leave", 4, "it ended its decoder with exit code 3" },
    { "hang", 6, "more than 0.3 seconds.*picture%-time", 0.3 },
    { "babble", 4, "its decoder sent an invalid answer" },
    { "odd", 4, "its decoder sent an invalid answer" },
    { "tell", 4, "its decoder sent an invalid answer" },
  }
  if not is_slow then
    ends[#ends + 1] = { "eat", 33, "out of memory" }
    ends[#ends + 1] = { "choke", 33, "out of memory" }
  end
  for _, one in ipairs(ends) do
    it("does " .. one[1] .. " is an error that names the file", function()
      if not present.colour() then return pending "it was built without Little CMS" end
      local names = one[2] == 33 and "" or "a%.psd: a colour profile: .*"
      fails(one[2], names .. one[3], reading(one[1], one[4]))
    end)
  end

  it("becomes a table of no form, or of no numbers, is not understood", function()
    if not present.colour() then return pending "it was built without Little CMS" end
    for _, lie in ipairs { "a form", "a number" } do
      local code, out, err = with_hostile(reading(lie))
      assert.are.equal(0, code, err)
      local note = 'the colour profile "' .. ("x"):rep(63) .. '": its colours'
      assert.truthy((out .. err):find(note, 1, true), out)
    end
  end)
end)
