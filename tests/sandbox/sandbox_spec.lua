-- Escapes and hangs: none gets out, and every one ends in time with its exit code.

local workbench = require "tests.support.workbench"

local CODES = { [0] = "it is harmless", [3] = "it is refused", [6] = "a limit ends it" }
local LIMITS = "--limit steps=3e6,time=0.4,memory=48M,print=16K"
local MORE = 2 -- seconds after the limit of time, by which all has ended

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

--- Seconds that four programs side by side take to begin and end: a machine may be busy.
local function seconds_to_start(bench)
  local _, out = bench:shell(("cd '%s' && date +%%s.%%N && seq 8 | xargs -P 4 -I N %s --version >starts && date +%%s.%%N")
    :format(bench.folder, workbench.absolute))
  local before, after = out:match "(%S+)%s+(%S+)"
  return tonumber(after) - tonumber(before)
end

--- Runs the scripts of a bench, several at a time; leaves NAME.code and NAME.err beside each.
local function run_all(bench, list, options)
  local more = MORE + seconds_to_start(bench)
  for i, one in ipairs(list) do
    local given = one[4] or options
    bench:write(i .. ".options", given)
    bench:write(i .. ".seconds", tostring((tonumber(given:match "time=([%d.]+)") or 60) + more))
  end
  bench:shell(([[cd '%s' && seq %d | xargs -P 4 -I N sh -c
    'timeout $(cat N.seconds) %s info scripts/N.lua $(cat N.options) >N.out 2>N.err; echo $? >N.code']])
    :gsub("\n%s*", " "):format(bench.folder, #list, workbench.absolute))
end

describe("the sandbox", function()
  local bench

  setup(function()
    bench = workbench.new()
    bench:shell(([[cd '%s' && mkdir scripts scriptsother && echo secret >secret.txt &&
      echo 'return "escaped"' >beside.lua && ln -s ../secret.txt scripts/link.txt &&
      ln -s ../beside.lua scripts/linked.lua && ln -s .. scripts/around && mkfifo scripts/pipe.lua &&
      printf '\033Lua' >scripts/compiled.lua && echo 'return io' >scripts/inner.lua &&
      echo >scripts/native.so && truncate -s 17M scripts/huge.lua]]):format(bench.folder))
  end)

  teardown(function() bench:remove() end)

  local function head()
    return HEAD:format(bench.folder .. "/secret.txt", "link.txt", bench.folder .. "/out.png", bench.folder)
  end

  describe("holds", function()
    local escapes = require "tests.sandbox.escapes"

    setup(function()
      for i, one in ipairs(escapes) do bench:write(("scripts/%d.lua"):format(i), head() .. ESCAPE:format(one[2])) end
      run_all(bench, escapes, "")
    end)

    for i, one in ipairs(escapes) do
      it(one[1], function()
        local text, code = bench:read(i .. ".err"), tonumber(bench:read(i .. ".code"))
        local answer = text:match("^HELD ([^\n]*)")
        assert.equal(0, code, text)
        assert.truthy(answer, text)
        assert.truthy(is_found(answer, one[3]), answer)
        assert.is_nil(bench:read("out.png"))
      end)
    end
  end)

  describe("ends", function()
    local hangs = require "tests.sandbox.hangs"

    setup(function()
      for i, one in ipairs(hangs) do bench:write(("scripts/%d.lua"):format(i), head() .. HANG:format(one[2])) end
      run_all(bench, hangs, LIMITS)
    end)

    for i, one in ipairs(hangs) do
      it(one[1] .. ": " .. CODES[one[3]], function()
        local text = bench:read(i .. ".err")
        assert.equal(one[3], tonumber(bench:read(i .. ".code")), text:sub(-400))
        if one[3] == 6 then
          assert.truthy(text:find("%-%-limit %a+="), text:sub(-400))
        end
      end)
    end
  end)
end)
