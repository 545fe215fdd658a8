-- Hosts in four languages, and the interface that they are built with, which is kept in the tree.
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"
package.path = "tests/face/?.lua;" .. package.path
local compare, header = require "compare", require "header"

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
  local now = header.whole ""

  it("is the one that is kept", function()
    local verdict, changes = compare.texts(read(KEPT), now)
    assert.equal("nothing", verdict, table.concat(changes, "\n")
      .. "\nthis is a " .. verdict .. " change: see CONTRIBUTING.md, \"Change the C interface\"")
  end)

  --- Compares the functions of headers with the symbols that nm lists, as far as they are public.
  local function exports(declarations, command, ...)
    local wanted, found = {}, {}
    for _, one in ipairs(header.parse(declarations).functions) do wanted[#wanted + 1] = one.name end
    for name in good(command, ...):gmatch " T ([%w_]+)" do
      if not (name:find "^cs_" or name:find "^luaopen_celspan_") then found[#found + 1] = name end
    end
    table.sort(wanted)
    table.sort(found)
    assert.same(wanted, found)
  end

  it("is what the library exports", function()
    exports(header.plain "", "nm -D --defined-only '%s'", LIBRARY)
    assert.is_nil(good("nm -D --defined-only '%s'", LIBRARY):find " T cs_")
    exports(header.plain("", { header.LUA }),
      "nm -g --defined-only '%s/src/kit/lua/module/libcelspan_lua.a'", BUILD)
  end)

  it("settles for every structure how it may grow", function()
    assert.same({}, compare.unsettled(header.parse(now)))
    local function fault(from, to)
      local text = now:gsub("%s+", " ")
      local first, last = assert(text:find(from, 1, true))
      return compare.unsettled(header.parse(text:sub(1, first - 1) .. to .. text:sub(last + 1)))[1]
    end
    assert.equal("celspan_more has no struct_size, and is no value that never changes",
      fault("typedef struct celspan_trace ",
        "typedef struct celspan_more { int a; } celspan_more;\ntypedef struct celspan_trace "))
    assert.equal("celspan_film.limits lies in a structure, where it cannot grow",
      fault("} celspan_film;", "celspan_lua_limits limits; } celspan_film;"))
    assert.equal("celspan_glyphs_count fills a celspan_glyph, which hosts know in another size",
      fault("celspan_glyphs_count(", "celspan_glyphs_count(celspan_glyph *out, "))
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
    assert.equal("minor", verdict("uint64_t rows_held; }", "uint64_t rows_held, more; }"))
    assert.equal("minor", verdict("int32_t line; } celspan_glyph;",
      "int32_t line; int32_t column; } celspan_glyph;"))
    assert.equal("minor", verdict("void *user; } celspan_lua_limits;",
      "void *user; size_t files; } celspan_lua_limits;"))
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
      ["double matte; } celspan_light_texture"] = "double matte, hue; } celspan_light_texture",
      ["celspan_lua_film(lua_State *L, int index"] = "celspan_lua_film(lua_State *L",
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
    good("%s -pedantic -Wall -Wextra -Werror %s -o %s/%s examples/hello.c %s", compiler,
      header.INCLUDE, folder, name, "-x none '" .. LIBRARY .. "'")
    draws(name, "LD_LIBRARY_PATH='%s/src' %s/%s %s/%s.png", BUILD, folder, name, folder, name)
  end

  it("in C draws a frame #plain", function() compiled("c", "cc -std=c17") end)
  local in_cpp = present.program "c++" and it or pending
  in_cpp("in C++ draws the same #plain", function() compiled("cpp", "c++ -std=c++17 -x c++") end)

  local with_config = present.program "pkg-config" and it or pending
  with_config("is built against the build folder by pkg-config alone #plain", function()
    local function finds(library, source, arguments, head)
      -- pkg-config prints words for a shell: a space in a path has a backslash before it.
      good("eval cc examples/%s.c -o %s/found \"$(PKG_CONFIG_PATH='%s/meson-uninstalled' "
        .. "pkg-config --cflags --libs %s)\"", source, folder, BUILD, library)
      good("cd %s && ./found %s && head -c 4 found.png | grep -q %s", folder, arguments, head)
    end
    local script = bench:write("dot.lua", "local celspan = require 'celspan'\n"
      .. "return celspan.rostrum { back = '#fff' }")
    finds("celspan", "hello", "found.png", "PNG")
    finds("celspan-lua", "host", script .. " 32 18 >found.png", "P6")
  end)

  local in_clang = present.program "clang" and it or pending
  in_clang("of Microsoft's compiler reads the headers: no attributes of GNU's", function()
    for _, language in ipairs { "c -std=c17", "c++ -std=c++17" } do
      good("for name in %s; do echo '#include <celspan/'$name'>'; done | clang -x %s - -Wall "
        .. "-Werror -fsyntax-only --target=x86_64-pc-windows-msvc -ffreestanding %s "
        .. "'-D__attribute__(x)=@'", table.concat(header.FILES, " "), language, header.INCLUDE)
    end
  end)

  --- The interface that is kept, with the structures that the host in C uses changed.
  local function write_changed(name, change)
    local text = read(KEPT):gsub("%s+", " "):gsub("%f[%w]typedef ", "\ntypedef ")
    for _, struct in ipairs { "context_desc", "ellipse_desc", "cel_desc", "rostrum_desc",
      "frame_desc", "sink", "statistics" } do
      local count
      text, count = text:gsub("(struct celspan_" .. struct .. " %{ size_t struct_size; )([^}]*)",
        function(head, fields) return head .. change(fields) end)
      assert.equal(1, count, struct)
    end
    bench:write(name .. ".h", text)
  end

  --- Builds the host with these declarations; it draws the same picture.
  local function draws_changed(name)
    good("cc -std=c17 -o %s/%s -DFACE='\"%s/%s.h\"' tests/face/host.c '%s'", folder, name, folder,
      name, LIBRARY)
    draws(name, "LD_LIBRARY_PATH='%s/src' %s/%s %s/%s.png", BUILD, folder, name, folder, name)
  end

  it("that is built with the interface that is kept draws the same #plain", function()
    write_changed("kept", function(fields) return fields end)
    draws_changed "kept"
  end)

  it("of an earlier header draws the same: the library's structures are longer #plain", function()
    write_changed("earlier", function(fields)
      return (fields:gsub("[^;]*; $", ""))
    end)
    draws_changed "earlier"
  end)

  it("of a later header draws the same: the library's structures are shorter #plain", function()
    write_changed("later", function(fields)
      return fields .. "double later; void *latest; "
    end)
    draws_changed "later"
  end)

  local in_python = present.program "python3" and it or pending
  in_python("in Python, with a binding made from the headers, draws the same #plain", function()
    good("lua5.4 tests/face/main.lua python >%s/celspan.py", folder)
    draws("python", "python3 tests/face/host.py %s/celspan.py '%s' %s/python.png", folder, LIBRARY,
      folder)
  end)

  local in_luajit = present.program "luajit" and it or pending
  in_luajit("in LuaJIT, with the interface that is kept, draws the same #plain", function()
    draws("luajit", "luajit tests/face/host.lua %s '%s' %s/luajit.png", KEPT, LIBRARY, folder)
  end)
end)
