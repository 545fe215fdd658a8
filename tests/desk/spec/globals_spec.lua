--- Names without a prefix in scripts that the program runs.
local golden = require "tests.support.golden"
local json = require "celspan.json"
local markdown = require "tests.support.markdown"
local own = require "tests.support.own"
local shipped = require "tests.support.shipped"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local bench

--- Two forms of one film, which use a module beside them.
local SHORT = [[
local dots = require "dots"
return film { size = { 32, 18 }, duration = 0.125, background = "midnightblue", frame = function(f)
  return dots(ease "outQuad"(f.progress))
end }
]]
local LONG = [[
local celspan = require "celspan"
local ease = require "celspan.ease"
local dots = require "dots"
return celspan.film { size = { 32, 18 }, duration = 0.125, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { -9, -9, 99, 99, texture = "#191970" } },
    celspan.cel { dots(ease "outQuad"(f.progress)) } }
end }
]]
local DOTS = "return function(u) return circle { 4 + 20 * u, 9, 4, fill = 'tomato' } end\n"

local END = "\nreturn film { size = { 2, 2 }, frame = function() return {} end }"

--- The long form of a text: all names are locals of its first line.
local function long(text)
  local list, module_of = own "celspan.native".names()
  local values = {}
  for i, name in ipairs(list) do
    values[i] = module_of[name] and ("require %q"):format(module_of[name]) or "celspan." .. name
  end
  return ("local celspan = require 'celspan' local %s = %s "):format(table.concat(list, ", "),
    table.concat(values, ", ")) .. text:gsub("([{,]%s*)fill = ", "%1texture = ")
end

--- The short form of a text that has a prefix everywhere.
local function short(text)
  return (text:gsub('local celspan = require "celspan"', ""):gsub("celspan%.(%l)", "%1")
    :gsub("texture = ", "fill = "))
end

--- The digest of the first frame of a text that lies in a folder of the tree.
local function digests(folder, text)
  bench:write("piped.lua", text)
  local out, ended_well = system.output(("root=$PWD && cd %s && '%s' render - --hash --frames 1 "
    .. "--size 48x27 --fit stretch --allow \"$root\" --allow \"$root/scripts\" --progress none "
    .. "< %s/piped.lua"):format(folder, workbench.absolute, bench.folder))
  assert.is_true(ended_well, folder)
  return out
end

--- What a script prints before it returns a film.
local function printed(text, options)
  bench:write("film.lua", text .. END)
  local code, out, err = bench:celspan_inside("render film.lua --hash --progress none %s",
    options or "")
  assert.are.equal(0, code, err)
  return (err:gsub("\n$", "")), out
end

--- The message of a script that fails.
local function refused(text)
  bench:write("film.lua", text)
  local code, _, err = bench:celspan_inside "check film.lua"
  assert.are_not.equal(0, code)
  return err
end

describe("a name without a prefix", function()
  setup(function() bench = workbench.new() end)
  teardown(function() bench:remove() end)

  it("is known in a script and beside it, in every way that runs one", function()
    bench:write("dots.lua", DOTS)
    bench:write("short.lua", SHORT)
    bench:write("long.lua", LONG)
    local _, wanted = bench:celspan_inside "render long.lua --hash --progress none"
    assert.are_not.equal("", wanted)
    for _, way in ipairs { "short.lua", "short.lua --trust", "- < short.lua" } do
      local code, out, err = bench:celspan_inside("render --hash --progress none %s", way)
      assert.are.equal(0, code, err)
      assert.are.equal(wanted, out, way)
    end
  end)

  it("is a local's, then a global's, then celspan's", function()
    for _, options in ipairs { "", "--trust" } do
      assert.are.equal("5 7 function table nil",
        printed([[
local circle = 5
star = 7
print(circle, star, type(rect), type(ease), jit)]], options):gsub("\t", " "), options)
    end
  end)

  it("that a file assigns is the file's from its beginning, and only there", function()
    bench:write("counter.lua", "local before = type(count)\ncount = (count or 0) + 1\n"
      .. "return before")
    for _, options in ipairs { "", "--trust" } do
      assert.are.equal("function nil 1 nil", printed([[
local first = type(count)
local before = require "counter"
local function set() text = 1 end
print(first, before, count, text)]], options):gsub("\t", " "), options)
    end
  end)

  it("is no global that pairs finds", function()
    assert.are.equal("nil", printed [[
local seen
for name in pairs(_G) do if name == "circle" then seen = name end end
print(circle and seen)]])
  end)

  it("that nobody has is nil, and its call names the nearest", function()
    assert.matches("film.lua:1: attempt to call a nil value (global 'circl'); did you mean "
      .. "'circle'?", refused "circl { 1, 2, 3 }", 1, true)
    assert.matches("attempt to index a nil value (global 'motoin'); did you mean 'motion'?",
      refused "return motoin.along()", 1, true)
    assert.matches("arithmetic on a nil value (global 'circl'); did you mean 'circle'?",
      refused "return 2 * circl", 1, true)
    assert.matches("(global 'f'); a frame function gets f: write frame = function(f) ...",
      refused "return f.time", 1, true)
    assert.matches("(global 'track'); it is a module: require \"celspan.track\"",
      refused "track.follow()", 1, true)
    assert.matches("film.lua:3: attempt to call a nil value (global 'my_dots'); did you mean "
      .. "'my_dot'?", refused "function my_dot() end\n\nmy_dots()", 1, true)
    assert.matches("film.lua:1: io is not in the sandbox", refused "io.open 'x'", 1, true)
  end)

  it("that a global hides is a warning", function()
    bench:write("film.lua", "text = 'a'\nlocal fit = 1\nown = fit" .. END)
    local code, out, err = bench:celspan_inside "check film.lua --json"
    assert.are.equal(0, code, err)
    local list = json.decode(out)
    assert.are.equal(1, #list, out)
    assert.matches("the global 'text' hides celspan's text in this file", list[1].message, 1, true)
    assert.are.same({ "warning", "film.lua", 1 }, { list[1].level, list[1].file, list[1].line })
  end)

  it("that is a colour without quotes is a warning", function()
    bench:write("film.lua", "local blue, t = 'blue', { red = 1 }\nlocal c = circle { 1, 1, 1, "
      .. "fill = red }\nlocal d = { blue, t.red, tan = 2, gold and 1 }" .. END)
    local _, out, err = bench:celspan_inside "check film.lua --json"
    local list = json.decode(out)
    assert.are.equal(1, #list, out .. err)
    assert.matches("nothing has the name 'red' here; did you mean \"red\", in quotes?",
      list[1].message, 1, true)
    assert.are.equal(2, list[1].line)
    bench:write("hues.lua", "red = '#f00'\nreturn {}")
    bench:write("film.lua", "require 'hues'\nlocal c = circle { 1, 1, 1, fill = red }" .. END)
    _, out, err = bench:celspan_inside "check film.lua --json"
    assert.are.same({}, json.decode(out), err)
  end)

  it("makes a value that check finds to be thrown away", function()
    bench:write("film.lua", "return film { size = { 2, 2 }, frame = function()\n"
      .. "  circle { 1, 1, 1 }:scale(2)\n  return {}\nend }")
    local code, out, err = bench:celspan_inside "check film.lua --json"
    assert.are.equal(0, code, err)
    assert.matches("circle {...}:scale(...) makes a value that nothing uses", out, 1, true)
  end)

  for tag, part in pairs { [""] = { 1, 8 }, [" #full"] = { 9, math.huge } } do
    it("is celspan's in scripts of both forms, frame by frame" .. tag, function()
      local scripts, cases = shipped.scripts(), golden.cases()
      assert.is_true(#scripts + #cases >= 60)
      for i, path in ipairs(table.move(cases, 1, #cases, #scripts + 1, scripts)) do
        local is_case = i > #scripts - #cases
        local text = markdown.read(is_case and path .. ".lua" or path)
        local other = (is_case and short or long)(text)
        assert.are_not.equal(text, other, path)
        if i >= part[1] and i <= part[2] then
          local folder = path:match "^(.*)/"
          assert.are.equal(digests(folder, text), digests(folder, other), path)
        end
      end
    end)
  end

  it("is known to luacheck in a new project", function()
    assert.are.equal(0, (bench:celspan_inside "init walk"))
    local settings = bench:read "walk/.luacheckrc"
    for _, name in ipairs { "circle", "ease", "star", "film" } do
      assert.is_truthy(settings:find(("\n  %q,\n"):format(name), 1, true), name)
    end
  end)
end)
