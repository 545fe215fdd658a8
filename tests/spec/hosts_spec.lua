-- Hosts in four languages, and the interface that they are built with, which is kept in the tree.
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BUILD = workbench.build
local KEPT = "tests/face/0.1.h"
local LIBRARY = BUILD .. "/src/libcelspan.so.0"

local bench, folder

local function good(...)
  local text, ended_well = system.output("{ " .. (...):format(select(2, ...)) .. "; } 2>&1")
  assert.is_true(ended_well, text)
  return text
end

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

setup(function()
  bench = workbench.new()
  folder = bench.folder
end)

teardown(function() bench:remove() end)

describe("the interface", function()
  package.path = "tests/face/?.lua;" .. package.path
  local compare, header = require "compare", require "header"
  local now = header.plain ""

  it("is the one that is kept", function()
    local verdict, changes = compare.texts(read(KEPT), now)
    assert.equal("nothing", verdict, table.concat(changes, "\n")
      .. "\nthis is a " .. verdict .. " change: see CONTRIBUTING.md, \"Change the C interface\"")
  end)

  it("is what the library exports", function()
    local wanted, found = {}, {}
    for _, one in ipairs(header.parse(now).functions) do wanted[#wanted + 1] = one.name end
    for name in good("nm -D --defined-only %s", LIBRARY):gmatch " T ([%w_]+)" do
      found[#found + 1] = name
    end
    table.sort(wanted)
    table.sort(found)
    assert.same(wanted, found)
  end)

  it("has fields that the library knows", function()
    local function list(text)
      local all = {}
      for field in text:gmatch "FIELD(%([%w_]+,%s*[%w_]+%))" do
        all[#all + 1] = field:gsub("%s", "")
      end
      return all
    end
    assert.same(list(good "lua5.4 tests/face/main.lua fields"), list(read "src/base/fields.h"))
  end)

  --- The verdict on the kept interface with a part of it replaced.
  local function verdict(from, to)
    local kept = read(KEPT):gsub("%s+", " ")
    local first, last = assert(kept:find(from, 1, true))
    return (compare.texts(kept, kept:sub(1, first - 1) .. to .. kept:sub(last + 1)))
  end

  it("may grow where hosts do not see it", function()
    local glow = "double gain; } celspan_glow_desc"
    assert.equal("nothing", verdict(glow, glow))
    assert.equal("minor", verdict(glow, "double gain; double angle; } celspan_glow_desc"))
    assert.equal("minor", verdict("void celspan_glyphs_destroy",
      "void celspan_glyphs_forget(int a);\nvoid celspan_glyphs_destroy"))
    assert.equal("minor", verdict("CELSPAN_SPREAD_REFLECT",
      "CELSPAN_SPREAD_REFLECT, CELSPAN_SPREAD_MORE"))
  end)

  it("may not change under hosts", function()
    for from, to in pairs {
      ["double gain; } celspan_glow_desc"] = "float gain; } celspan_glow_desc",
      ["double radius; celspan_texture *colour; double gain; } celspan_glow_desc"] =
        "double angle; double radius; celspan_texture *colour; double gain; } celspan_glow_desc",
      ["bool is_alone; } celspan_shadow_desc"] = -- in its padding
        "bool is_alone; bool is_soft; } celspan_shadow_desc",
      ["double x, y; } celspan_point"] = "double x, y, z; } celspan_point",
      ["CELSPAN_RULE_NONZERO = 0"] = "CELSPAN_RULE_NONZERO = 5",
      ["celspan_matrix celspan_matrix_identity(void);"] = "",
      ["celspan_matrix_scaling(double sx, double sy)"] =
        "celspan_matrix_scaling(float sx, double sy)",
    } do
      assert.equal("major", verdict(from, to), from)
    end
  end)
end)

describe("a host", function()
  --- Has one host draw its picture, and compares it with that of the first.
  local function draws(name, command, ...)
    good(command, ...)
    if name ~= "c" then good("cmp %s/c.png %s/%s.png", folder, folder, name) end
  end

  local function compiled(name, compiler)
    good("%s -pedantic -Wall -Wextra -Werror -Isrc/include -o %s/%s examples/hello.c %s", compiler,
      folder, name, "-x none " .. LIBRARY)
    draws(name, "LD_LIBRARY_PATH=%s/src %s/%s %s/%s.png", BUILD, folder, name, folder, name)
  end

  it("in C draws a frame", function() compiled("c", "cc -std=c17") end)
  local in_cpp = present.program "c++" and it or pending
  in_cpp("in C++ draws the same", function() compiled("cpp", "c++ -std=c++17 -x c++") end)

  local in_python = present.program "python3" and it or pending
  in_python("in Python, with a binding made from the headers, draws the same", function()
    good("lua5.4 tests/face/main.lua python >%s/celspan.py", folder)
    draws("python", "python3 tests/face/host.py %s/celspan.py %s %s/python.png", folder, LIBRARY,
      folder)
  end)

  local in_luajit = present.program "luajit" and it or pending
  in_luajit("in LuaJIT, with the interface that is kept, draws the same", function()
    draws("luajit", "luajit tests/face/host.lua %s %s %s/luajit.png", KEPT, LIBRARY, folder)
  end)
end)
