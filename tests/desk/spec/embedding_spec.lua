-- Other people's programs: hosts in C and C++, and Lua's package manager.
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"
local header = dofile "tests/face/header.lua"

local BINARY, BUILD = workbench.binary, workbench.build

local bench, folder

--- Runs a command: whether it succeeded, and its output.
local function run(command, ...)
  local text, ended_well = system.output("{ " .. command:format(...) .. "; } 2>&1")
  return ended_well, text
end

local function good(...)
  local ended_well, text = run(...)
  assert.is_true(ended_well, text)
  return text
end

local function write(name, text) return bench:write(name, text) end

setup(function()
  bench = workbench.new()
  folder = bench.folder
end)

teardown(function() bench:remove() end)

describe("the headers", function()
  local source = [[
#include <celspan/lua.h>
int main(void) {
  celspan_context_desc context = CELSPAN_CONTEXT_DESC;
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  celspan_rostrum_desc rostrum = CELSPAN_ROSTRUM_DESC;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_span span = CELSPAN_ZERO;
  float colour[4];
  celspan_span_colour(&span, 0, colour);
  return context.struct_size == sizeof context && cel.opacity == 1 && rostrum.brightness == 1 &&
         frame.struct_size == sizeof frame && file.struct_size == sizeof file ? 0 : 1;
}
]]
  for compiler, mode in pairs {
    gcc = "-x c -std=c17 -Wstrict-prototypes", ["g++"] = "-x c++ -std=c++17",
    clang = "-x c -std=c17 -Wstrict-prototypes", ["clang++"] = "-x c++ -std=c++17",
  } do
    local test = present.program(compiler) and it or pending
    test("give no warning under " .. compiler .. " " .. mode, function()
      write("header.c", source)
      good("%s %s -pedantic -Wall -Wextra -Wshadow -Werror -fsyntax-only %s %s "
        .. "%s/header.c",
        compiler, mode, header.INCLUDE, "$(pkg-config --cflags lua5.4)", folder)
    end)
  end
end)

describe("a host in C", function()
  local film = [[
local celspan = require "celspan"
return celspan.film { size = { 160, 90 }, frames = 2, frame = function(f)
  local dot = celspan.circle { centre = { 40 * f.number, 45 }, radius = 30, texture = "#d06030" }
  return celspan.rostrum { celspan.cel { dot }, back = "#fbe9c6" }
end }
]]

  it("takes under 80 lines to play a film", function()
    local count = 0
    for _ in io.lines "examples/host.c" do count = count + 1 end
    assert.is_true(count < 80)
  end)

  for _, program in ipairs { "example_host", "example_host_cpp" } do
    local path = ("%s/examples/%s"):format(BUILD, program)
    local test = present.program(path) and it or pending
    test("shows what the program celspan renders: " .. program, function()
      write("film.lua", film)
      good("'%s' %s/film.lua 80 45 >%s/film.ppm", path, folder, folder)
      good("'%s' render %s/film.lua --size 80x45 --progress none -o %s/film.#.png", BINARY, folder,
        folder)
      for frame = 1, 2 do -- pictures one after the other, of 13 bytes and the pixels each
        good("tail -c +%d %s/film.ppm | head -c %d >%s/one.ppm",
          1 + (frame - 1) * (13 + 80 * 45 * 3),
          folder, 13 + 80 * 45 * 3, folder)
        good("'%s' compare %s/one.ppm %s/film.%d.png", BINARY, folder, folder, frame)
      end
    end)

    test("finds the modules of a film beside it, from any folder: " .. program, function()
      good("mkdir -p %s/films/demo %s/elsewhere/demo", folder, folder)
      write("films/demo/colours.lua", 'return { dot = "#d06030" }')
      write("films/demo/drawing.lua", [[
local celspan, colours = require "celspan", require "demo.colours"
return function(n)
  return celspan.circle { centre = { 40 * n, 45 }, radius = 30, texture = colours.dot }
end]])
      write("films/late.lua", "return '#fbe9c6'")
      write("films/demo.lua", [[
local celspan, drawing = require "celspan", require "demo.drawing"
return celspan.film { size = { 160, 90 }, frames = 2, frame = function(f)
  return celspan.rostrum { celspan.cel { drawing(f.number) }, back = require "late" }
end }]])
      write("film.lua", film)
      good("cd %s/elsewhere && '%s' ../films/demo.lua 80 45 >../beside.ppm", folder, path)
      good("'%s' %s/film.lua 80 45 | cmp - %s/beside.ppm", path, folder, folder)
      good("rm %s/films/late.lua", folder)
      local ended_well, text = run("'%s' %s/films/demo.lua 80 45 >/dev/null", path, folder)
      assert.is_false(ended_well)
      assert.is_truthy(text:find("no file '" .. folder .. "/films/late.lua'", 1, true), text)
    end)

    test("says what is wrong with a film: " .. program, function()
      write("wrong.lua", film:gsub("radius = 30", "raduis = 30"))
      local ended_well, text = run("'%s' %s/wrong.lua 80 45", path, folder)
      assert.is_false(ended_well)
      assert.is_truthy(text:find "wrong.lua:3: frame 1: circle: .*raduis", text)
    end)
  end
end)

describe("a host that asks what a film says", function()
  local path = BUILD .. "/examples/example_facts"
  local test = present.program(path) and it or pending
  local film = [[
local celspan = require "celspan"
local p = celspan.parameters { speed = { 1, min = 0, max = 4 }, side = { "left", "right" } }
return celspan.film { fps = 10, frames = 20, marks = { title = 1, chase = 1 + p.speed * 4 },
  sound = { { "voice.wav", at = p.speed, gain = 0.5 } }, frame = function() end }
]]

  test("lists parameters, marks and sounds, with the values that it gives", function()
    write("film.lua", film)
    local parameters = "parameter side left of left, right\nparameter speed 1 (0 to 4)\n"
    assert.equal(parameters .. "mark title 1-4\nmark chase 5-20\n"
      .. "sound " .. folder .. "/voice.wav from 1 s on, 0.5 times as loud\n",
      good("'%s' %s/film.lua", path, folder))
    assert.equal(parameters .. "mark title 1-12\nmark chase 13-20\n"
      .. "sound " .. folder .. "/voice.wav from 3 s on, 0.5 times as loud\n",
      good("'%s' %s/film.lua side=right speed=3", path, folder))
  end)

  test("says which value is wrong", function()
    write("film.lua", film)
    for given, message in pairs {
      ["speed=9"] = "set: speed is '9'; it must be a number from 0 to 4",
      ["sped=1"] = "set: the script has no parameter 'sped'; did you mean 'speed'?",
      speed = "'speed' is not NAME=VALUE",
    } do
      local ended_well, text = run("'%s' %s/film.lua %s", path, folder, given)
      assert.is_false(ended_well)
      assert.equal("facts: " .. message .. "\n", text)
    end
  end)
end)

describe("the module", function()
  local module = BUILD .. "/celspan.so"

  local reads = present.program "readelf" and it or pending
  reads("is not linked with Lua, which the interpreter has", function()
    local text = good("readelf -d '%s'", module)
    assert.is_truthy(text:find("NEEDED", 1, true))
    assert.is_nil(text:find "NEEDED[^\n]*lua")
  end)

  for interpreter, sentence in pairs {
    ["lua5.1"] = "this celspan.so is a module for Lua 5.4",
    luajit = "this celspan.so is a module for Lua 5.4",
    ["lua5.3"] = "version mismatch",
  } do
    local loads = present.program(interpreter) and it or pending
    loads("says in " .. interpreter .. " which Lua it is for #plain", function()
      local ended_well, text = run("LUA_CPATH='%s/?.so' %s -e 'require \"celspan\"'", BUILD,
        interpreter)
      assert.is_false(ended_well)
      assert.is_truthy(text:find(sentence, 1, true), text)
    end)
  end
end)

describe("an installation that was moved", function()
  -- The folders of an installation, in a place that no build knows.
  local function install()
    local libraries = folder .. "/moved/lib/any"
    good("mkdir -p %s/lua/5.4 %s/celspan && cp '%s/celspan.so' %s/lua/5.4", libraries, libraries,
      BUILD, libraries)
    good("find '%s/src' -name 'celspan-*.so' -exec cp {} %s/celspan ';'", BUILD, libraries)
    return libraries .. "/lua/5.4"
  end

  local sets = present.type() and it or pending
  sets("has modules that Lua finds", function()
    write("letters.lua", [[
local celspan = require "celspan"
celspan.text { "A", font = ..., size = 9 }
]])
    good("cd %s && LUA_PATH= LUA_CPATH='%s/?.so' '%s/tests/lua_host' letters.lua "
      .. "\"$OLDPWD/scripts/type/block.ttf\"", folder, install(), BUILD)
  end)
end)

describe("the rockspec", function()
  local test = present.program "luarocks" and it or pending
  test("is well-formed, and makes a rock of what is built", function()
    local luarocks = "luarocks --lua-version 5.4"
    good("%s lint celspan-scm-1.rockspec", luarocks)
    good("CELSPAN_BUILD='%s' %s make --deps-mode none --tree %s/rocks celspan-scm-1.rockspec",
      BUILD, luarocks, folder)
    good("test -s %s/rocks/lib/luarocks/rocks-5.4/celspan/scm-1/annotations/celspan.d.lua", folder)
    write("rock.lua", 'assert(require "celspan"._VERSION and require "celspan.ease" "inOutSine")')
    good("LUA_PATH= LUA_CPATH='%s/rocks/lib/lua/5.4/?.so' '%s/tests/lua_host' %s/rock.lua", folder,
      BUILD,
      folder)
  end)
end)
