-- Escapes and hangs: no script escapes, and every one ends in time with its exit code.

local workbench = require "tests.support.workbench"

local CODES = { [0] = "it is harmless", [3] = "it is refused", [6] = "a limit ends it" }
local LIMITS = "--limit steps=3e6,time=0.4,memory=48M,print=16K"
local MORE = 60 -- seconds after the limit of time: more than any busy machine needs to end a script

local HEAD = [[
local celspan = require "celspan"
local SECRET, LINK, OUT, BESIDE = %q, %q, %q, %q
local ROSTRUM = celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 1, 1 } } }
local FILM = celspan.film{ size = {2, 2}, frames = 1, frame = function() return ROSTRUM end }
]]
local ESCAPE = [[
local good, answer = pcall(function()
%s
end)
print((good and answer == true and "ESCAPED " or "HELD ") .. tostring(answer))
return FILM
]]
local HANG = "local function hang()\n%s\nend\nhang()\nreturn FILM\n"

--- Whether one of the patterns, with | between them, is found.
local function is_found(text, patterns)
  for pattern in (patterns .. "|"):gmatch("([^|]*)|") do
    if text:find(pattern) then return true end
  end
  return false
end

--- The limits of options, as the example takes them: seconds, steps, memory, printed bytes.
local function limits_of(options)
  local function value(name, default)
    local number, unit = options:match(name .. "=([%d.e]+)([KM]?)")
    local times = unit == "K" and 1024 or unit == "M" and 1024 ^ 2 or 1
    return ("%.9g"):format((tonumber(number) or default) * times)
  end
  return table.concat({ value("time", 60), value("steps", 2e9), value("memory", 512 * 1024 ^ 2),
    value("print", 1024 ^ 2) }, " ")
end

--- Two ways into the same sandbox: the command, and the example of a host.
local WAYS = {
  { name = "the program", command = function(options)
    return ("'%s' info scripts/one.lua %s"):format(workbench.absolute, options)
  end },
  { name = "the library", is_host = true, command = function(options)
    return ("'%s/examples/example_sandbox' scripts/one.lua %s")
      :format(workbench.build, limits_of(options))
  end },
}

--- Runs a script of a bench in one of the ways: its exit code and standard error.
local function run(bench, way, text, options)
  local seconds = (tonumber(options:match "time=([%d.]+)") or 60) + MORE
  bench:write("scripts/one.lua", text)
  local code, _, err = bench:inside(("timeout %g %s"):format(seconds, way.command(options)))
  return code, err
end

describe("the sandbox", function()
  local bench

  setup(function()
    bench = workbench.new()
    bench:shell(([[cd '%s' && mkdir scripts scriptsother && echo secret >secret.txt &&
      echo 'return "escaped"' >beside.lua && ln -s ../secret.txt scripts/link.txt &&
      ln -s ../beside.lua scripts/linked.lua && ln -s .. scripts/around &&
      mkfifo scripts/pipe.lua && printf '\033Lua' >scripts/compiled.lua &&
      echo 'return io' >scripts/inner.lua && echo 'given = 1' >scripts/silent.lua &&
      echo >scripts/native.so && truncate -s 17M scripts/huge.lua]]):format(bench.folder))
  end)

  teardown(function() bench:remove() end)

  local function head()
    return HEAD:format(bench.folder .. "/secret.txt", "link.txt", bench.folder .. "/out.png",
      bench.folder)
  end

  describe("agrees with Lua", function()
    for seed = 1, 2 do
      it("in the functions that it replaces, with random arguments " .. seed, function()
        local command = ("'%s' info tests/kit/sandbox/agree.lua --limit print=0 %%s -- %d")
          :format(workbench.absolute, seed)
        local code, _, own = bench:shell(command:format(""))
        assert.equal(0, code, own:sub(-400))
        local _, _, lua = bench:shell(command:format("--trust"))
        local line = 0
        local others = lua:gmatch "[^\n]*"
        for one in own:gmatch "[^\n]*" do
          line = line + 1
          assert.equal(others(), one, "line " .. line)
        end
        assert.is_true(line > 30000)
        assert.equal(#lua, #own)
      end)
    end
  end)

  describe("answers alike for files outside that exist and that do not:", function()
    -- Each returns what a script learns of the file NAME in the folder above its own, which the
    -- link LINK and the module MODULE lead to. A file of the name TWIN is beside the script, too.
    local ASKED = {
      ["a picture beside a made-up chunk"] = [[return load("return celspan.picture{ file = '"
        .. TWIN .. "' }", "@" .. ABOVE .. "/x.lua", "t", { celspan = celspan })()]],
      ["a picture named from a folder below"] = [[return load("return celspan.picture{ file = '../"
        .. NAME .. "' }", "@" .. ABOVE .. "/scripts/below/x.lua", "t", { celspan = celspan })()]],
      ["a picture"] = [[return celspan.picture{ file = "../" .. NAME }]],
      ["a picture through a linked folder"] = [[
        return celspan.picture{ file = "around/" .. NAME }]],
      ["a picture through a link"] = [[return celspan.picture{ file = LINK }]],
      ["lips through a link"] = [[return select(2, require("celspan.lips").read(LINK))]],
      ["an image of a drawing through a link"] = [[
        return require("celspan.svg").read(LINK .. ".svg").skipped[1].what]],
      ["a module through a link"] = [[return require(LINK)]],
      ["a module through a linked folder"] = [[return require("around." .. MODULE)]],
    }

    for what, text in pairs(ASKED) do
      it(what, function()
        local answers = {}
        bench:shell(([[cd '%s' && mkdir -p scripts/below && touch twin_beside.lua
          for name in beside absent; do
          touch scripts/twin_$name.lua
          ln -sf ../$name.lua scripts/to_$name
          ln -sf ../$name.lua scripts/to_$name.lua
          echo '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><image width="9"
            height="9" href="to_'$name'"/></svg>' >scripts/to_$name.svg; done]])
          :format(bench.folder))
        for _, name in ipairs { "beside", "absent" } do
          bench:write("scripts/asks.lua", ([[
            local celspan = require "celspan"
            local ABOVE, MODULE, NAME, LINK = %q, "NAMED", "NAMED.lua", "to_NAMED"
            local TWIN = "twin_" .. NAME
            local _, answer = pcall(function() %s end)
            print(answer, TWIN)
            return celspan.rostrum{}]]):gsub("NAMED", name):format(bench.folder, text))
          local _, out, err = bench:shell(("cd '%s' && '%s' info scripts/asks.lua")
            :format(bench.folder, workbench.absolute))
          answers[name] = (out .. err):gsub(name, "NAMED")
        end
        assert.truthy(answers.beside:find "NAMED", answers.beside)
        assert.equal(answers.absent, answers.beside)
      end)
    end
  end)

  -- Lua's own length of `t` differs from process to process: after keys were removed, when the
  -- table grows depends on which keys collide.
  local HOLED = [[
    local celspan = require "celspan"
    local function holed(n)
      local t = {}
      for i = 1, n do t["key" .. i] = i end
      for i = 1, n, 2 do t["key" .. i] = nil end
      for i = 1, n do if i % 5 ~= 2 then t[i] = i end end
      return t
    end
  ]]

  describe("a list with holes", function()
    local function printed(text)
      bench:write("scripts/holed.lua", HOLED .. text .. "\nreturn celspan.rostrum{}")
      local code, _, err = bench:shell(("cd '%s' && '%s' info scripts/holed.lua")
        :format(bench.folder, workbench.absolute))
      assert.equal(0, code, err)
      return (err:match "^[^\n]*")
    end

    it("ends at its first hole for the functions of table", function()
      assert.equal("1,2\t2\t4\ttrue\t2\ttrue\t2", printed [[
        local function list() return { 1, 2, nil, 4 } end
        local t, u, v = list(), list(), list()
        table.insert(t, "new")
        local removed = table.remove(u)
        table.sort(v, function(a, b) return a > b end)
        print(table.concat(list(), ","), select("#", table.unpack(list())), t[4], t[3] == "new",
          removed, u[2] == nil and u[4] == 4, v[1])]])
    end)

    it("is as long as Lua's where it has no holes", function()
      assert.equal("70", printed [[
        local good = 0
        for n = 1, 70 do
          local t = {}
          for i = 1, n do t[i] = i end
          table.insert(t, "new")
          if t[n + 1] == "new" and table.remove(t) == "new" and t[n] == n then good = good + 1 end
        end
        print(good)]])
    end)

    it("gives the same in every run", function()
      local seen, count = {}, 0
      for _ = 1, 20 do
        local answer = printed [[
          local all = {}
          for n = 3, 100 do
            local t, u, v = holed(n), holed(n), holed(n)
            for _, list in ipairs { t, u, v } do list[1], list[n + 5] = n, n end
            table.insert(t, 2, -1)
            table.insert(t, -2)
            all[#all + 1] = table.concat({ table.concat(t, "."), select("#", table.unpack(u)),
              table.remove(u), tostring(u[1]), #celspan.cel { celspan.rect { 0, 0, 1, 1 } } }, ":")
          end
          print(table.concat(all, " "))]]
        if not seen[answer] then seen[answer], count = true, count + 1 end
      end
      assert.equal(1, count)
    end)

    it("is drawn to its greatest place, without nil and false", function()
      assert.equal("3\t2\t2\t1\t3\t40", printed [[
        local a, b = celspan.rect { 0, 0, 1, 1 }, celspan.rect { 2, 0, 1, 1 }
        local cel = celspan.cel { nil, a, false, b, nil, a, opacity = 0.5 }
        local far = { a, key = nil }
        far[40] = b
        local many = {}
        for i = 1, 80, 2 do many[i] = a end
        print(#cel, #celspan.union { false, a, b }, #(a ~ b), #celspan.rostrum { nil, cel, nil },
          #celspan.cel{}:with { false, a, b, nil, a }, #celspan.cel(many))]])
    end)

    it("is refused where each place has a meaning", function()
      assert.truthy(printed [[
        print(select(2, pcall(celspan.polygon, { { 0, 0 }, { 1, 0 }, nil, { 1, 1 } })))]]
        :find("there is a value at place 4 of the list, but none at place 3", 1, true))
    end)

    it("that # measures is found by check", function()
      bench:write("scripts/measured.lua", HOLED .. [[
        return celspan.film { size = { 9, 9 }, frames = 3, frame = function()
          local list = {}
          for n = 3, 100 do list[n - 2] = celspan.rect { #holed(n), n, 1, 1 } end
          return celspan.rostrum { celspan.cel(list) }
        end }]])
      for _ = 1, 3 do
        local code, _, err = bench:shell(("cd '%s' && '%s' check scripts/measured.lua")
          :format(bench.folder, workbench.absolute))
        assert.equal(3, code)
        assert.truthy(err:find("called again, it returned another scene", 1, true), err)
      end
    end)
  end)

  it("refuses the order of keys that differs from run to run", function()
    bench:write("scripts/keys.lua", [[
      local keys = { [{}] = 1, [print] = 2 }
      print(pcall(pairs, keys))
      print(pcall(next, keys))
      return require("celspan").rostrum{}]])
    local _, _, err = bench:shell(("cd '%s' && '%s' info scripts/keys.lua")
      :format(bench.folder, workbench.absolute))
    assert.equal(2, select(2, err:gsub("false\t", "")), err)
  end)

  describe("with its options", function()
    -- A leak check attaches to the process from another one, which --strict does not allow.
    local function celspan(arguments)
      return bench:shell(("cd '%s' && ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 '%s' %s")
        :format(bench.folder, workbench.absolute, arguments))
    end

    local function refused(arguments, pattern, code)
      local got, _, err = celspan(arguments)
      assert.equal(code or 2, got, err)
      assert.truthy(err:find(pattern, 1, true), err)
    end

    setup(function()
      bench:write("scripts/still.lua", head() .. "return FILM")
      bench:write("scripts/outside.lua", head() .. "return celspan.picture{ file = SECRET }")
      bench:write("scripts/fonts.lua",
        head() .. 'return celspan.rostrum{ celspan.cel{ celspan.text{ "x", font = ... } } }')
      bench:write("scripts/needs.lua",
        'assert(require "beside" == "escaped")\n' .. head() .. "return FILM")
      bench:write("scripts/loops.lua", head() .. [[return FILM:with{ frames = 3, frame = function(f)
        while f.number == 2 do end return ROSTRUM end }]])
      bench:write("scripts/counts.lua", head() .. [[return FILM:with{ frame = function(f)
        for i = 1, 3e5 do end return ROSTRUM end }]])
      bench:write("scripts/sound.lua",
        head() .. 'return FILM:with{ frames = 2, sound = "../secret.txt" }')
      bench:write("scripts/writes.lua", head() .. 'assert(celspan.render(FILM, OUT)) return FILM')
    end)

    it("allows folders to read below", function()
      refused("info scripts/needs.lua", "module 'beside' not found", 3)
      assert.equal(0, (celspan("info scripts/needs.lua --allow .")))
      assert.equal(0, (bench:shell(("cd '%s' && CELSPAN_PATH='./?.lua' '%s' info scripts/needs.lua")
        :format(bench.folder, workbench.absolute))))
      refused("info scripts/outside.lua", "(--allow DIR adds a folder)", 3)
      refused("info scripts/needs.lua --allow none", "there is no such folder")
      refused("info scripts/still.lua --trust --allow .", "leave --allow out")
      refused("info scripts/still.lua --trust --strict", "leave --strict out")
      refused("info scripts/still.lua --trust --strict --allow .", "leave --strict out")
      refused("info scripts/still.lua" .. (" --allow ."):rep(49),
        "--allow: '.' is not the name of a folder; at most 48 can be given")
      local search = ("./?.lua;"):rep(64)
      local code, _, err = bench:shell(("cd '%s' && CELSPAN_PATH='%s' '%s' info scripts/still.lua")
        :format(bench.folder, search, workbench.absolute))
      assert.equal(2, code)
      assert.truthy(err:find("--allow and CELSPAN_PATH name too many folders", 1, true), err)
    end)

    it("accepts limits by their names", function()
      for _, bad in ipairs { "x=1", "memory", "memory=", "memory=1X", "memory=-1", "steps=1K",
        "time=1e9", "time=nan",
        "memory=1M,", ",memory=1M", "memory=1M,x=2", "steps= 1" } do
        refused(("info scripts/still.lua --limit '%s'"):format(bad),
          "--limit: '" .. bad .. "' is not")
      end
      assert.equal(0,
        (celspan("info scripts/still.lua --limit memory=64M,steps=1e6 --limit time=0.5,print=0")))
      assert.equal(0, (celspan("info scripts/counts.lua --limit steps=0,memory=0,print=0")))
      assert.equal(0, (celspan("info scripts/counts.lua --limit steps=0,time=0")))
      assert.equal(0, (celspan("info scripts/counts.lua --trust --limit time=9")))
      refused("info scripts/counts.lua --limit steps=1", "more than 1 step in a frame", 6)
      refused("info scripts/still.lua --trust --limit picture-memory=1M",
        "leave --limit picture-memory out")
      refused("info scripts/still.lua --trust --limit picture-time=1",
        "leave --limit picture-time out")
      refused("info scripts/still.lua --limit memory=20K",
        "needs more than 20 KiB (--limit memory=", 6)
      refused("info scripts/counts.lua --limit steps=1000",
        "scripts/counts.lua:6: frame 1: more than 1000 steps", 6)
    end)

    it("applies only to scripts", function()
      for _, option in ipairs { "--strict", "--allow .", "--limit time=1",
        "--limit picture-time=1,steps=9" } do
        refused(("info '%s/scripts/pictures/canal.png' %s"):format(os.getenv "PWD", option),
          "are for scripts")
      end
    end)

    it("is off with --trust, except for limits that are named", function()
      assert.equal(0, (celspan("info scripts/writes.lua --trust")))
      assert.truthy(bench:read("out.png"))
      os.remove(bench.folder .. "/out.png")
      refused("info scripts/writes.lua", "cannot write files", 3)
      refused("render scripts/loops.lua --hash --trust --limit steps=1e6",
        "scripts/loops.lua:6: frame 2: more than 1000000", 6)
    end)

    it("limits each frame: --keep-going continues after a limit", function()
      local code, out, err =
        celspan("render scripts/loops.lua --hash --keep-going --limit steps=1e6 --progress none")
      assert.equal(1, code, err)
      assert.truthy(out:find("^1 %x+\n3 %x+\n$"), out)
      assert.truthy(err:find("scripts/loops.lua:6: frame 2: more than 1000000 steps", 1, true), err)
    end)

    it("counts steps that do not depend on the run", function()
      local least, most = 1e5, 1e6
      while most - least > 1000 do
        local middle = math.floor((least + most) / 2)
        local code = celspan(("info scripts/counts.lua --limit steps=%d"):format(middle))
        if code == 0 then most = middle else least = middle end
      end
      for _ = 1, 3 do
        assert.equal(6, (celspan(("info scripts/counts.lua --limit steps=%d"):format(least))))
        assert.equal(0, (celspan(("info scripts/counts.lua --limit steps=%d"):format(most))))
      end
    end)

    it("applies to the sound of a film too", function()
      local code, _, err = celspan("render scripts/sound.lua -o out.mp4")
      assert.equal(3, code, err)
      assert.truthy(err:find("can read only files in", 1, true), err)
    end)

    it("is enforced by the kernel with --strict, with the same pixels", function()
      local code, out, err = celspan("render scripts/still.lua --hash --strict --progress none")
      if code == 6 and err:find("--strict: ", 1, true) then
        return pending "the kernel cannot confine a process"
      end
      assert.equal(0, code, err)
      assert.equal(out, (select(2, celspan("render scripts/still.lua --hash --progress none"))))
      assert.equal(0,
        (celspan("render scripts/still.lua -o new/folder/still.png --strict --progress none")))
      assert.truthy(bench:read("new/folder/still.png"))
      bench:write("alone.lua", head() .. "return FILM")
      -- without a folder's name
      assert.equal(0, (celspan("render alone.lua -o beside.png --strict --progress none")))
      assert.truthy(bench:read("beside.png"))
      code, out, err =
        bench:shell(("cd '%s' && CELSPAN_PATH='%s' '%s' render scripts/still.lua --hash --strict%s")
        :format(bench.folder, ("./?.lua;"):rep(15), workbench.absolute, (" --allow ."):rep(48)))
      assert.equal(6, code, out)
      assert.truthy(err:find("--strict: there are too many folders to read", 1, true), err)
      refused("render scripts/still.lua -o film.mp4 --strict", "--strict starts no programs")
    end)
  end)

  for _, way in ipairs(WAYS) do
    describe("of " .. way.name .. " withstands", function()
      local escapes = require "tests.kit.sandbox.escapes"

      for _, one in ipairs(escapes) do
        it(one[1], function()
          local code, text = run(bench, way, head() .. ESCAPE:format(one[2]), one[4] or "")
          local answer = text:match("^HELD ([^\n]*)")
          assert.equal(0, code, text)
          assert.truthy(answer, text)
          assert.truthy(is_found(answer, one[3]), answer)
          assert.is_nil(bench:read("out.png"))
        end)
      end
    end)

    describe("of " .. way.name .. " ends", function()
      local hangs = require "tests.kit.sandbox.hangs"

      for _, one in ipairs(hangs) do
        it(one[1] .. ": " .. CODES[one[3]], function()
          local code, text = run(bench, way, head() .. HANG:format(one[2]), one[4] or LIMITS)
          assert.equal(one[3], code, text:sub(-400))
          if one[3] == 6 then
            assert.equal(not way.is_host, text:find("%-%-limit %a+=") ~= nil, text:sub(-400))
          end
        end)
      end
    end)
  end

  describe("of a host", function()
    local function host(text)
      bench:write("scripts/hosted.lua", head() .. text)
      return bench:shell(("cd '%s' && '%s/examples/example_sandbox' scripts/hosted.lua")
        :format(bench.folder, workbench.build))
    end

    it("has the functions that the host registers, and no others", function()
      local code, out, err =
        host "print(player(), rawget(_G, 'os'), rawget(_G, 'package')) return FILM"
      assert.equal(0, code, err)
      assert.equal("1 frames\n", out)
      assert.equal("Ada\tnil\tnil\n", err)
    end)

    it("names no options, which a host has not", function()
      for _, text in ipairs { "return io", "return celspan.picture{ file = SECRET }",
        "assert(celspan.render(FILM, OUT))", "setmetatable({}, { __gc = print })" } do
        local code, _, err = host(text)
        assert.equal(3, code, err)
        assert.is_nil(err:find("--", 1, true), err)
      end
    end)
  end)
end)
