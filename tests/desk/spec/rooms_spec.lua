-- The checks of the structure of src/: doubled names of types, and circles of units by calls.
local house = require "tests.support.rooms.house"
local trees = require "tests.support.rooms.tree"
local workbench = require "tests.support.workbench"

describe("the structure of src", function()
  local bench

  setup(function()
    bench = workbench.new()
    assert(os.execute(("mkdir -p '%s/src/core/base'"):format(bench.folder)))
    bench:write("src/meson.build", "foreach layer : ['core/base']\n")
  end)
  teardown(function() bench:remove() end)

  --- The tree of these files of src/core/base, by their names.
  local function tree_of(files)
    assert(os.execute(("rm -f '%s'/src/core/base/*"):format(bench.folder)))
    for name, text in pairs(files) do bench:write("src/core/base/" .. name, text) end
    return trees.read(bench.folder)
  end

  it("reports a name that two types have", function()
    local doubled = house.doubled_types(tree_of {
      ["a.h"] = "typedef struct cs_thing { int a; } cs_thing;\n",
      ["b.c"] = "typedef struct cs_thing { int b; } cs_thing;\n",
    })
    assert.are.same({ "cs_thing: core/base/a.h:1, core/base/b.c:1" }, doubled)
  end)

  it("takes an opaque type for one, however many sources define it", function()
    local doubled = house.doubled_types(tree_of {
      ["reader.h"] = "typedef struct cs_reader cs_reader;\nvoid cs_read(cs_reader *reader);\n",
      ["file.c"] = "struct cs_reader { int file; };\n",
      ["memory.c"] = "struct cs_reader { char *bytes; };\n",
    })
    assert.are.same({}, doubled)
  end)

  it("finds roundings to single precision that a compiler may take away", function()
    local source = tree_of {
      ["a.c"] = "double a(float x) {\n  return (double)x +\n    (double)(float)1.1;\n}\n",
      ["b.c"] = "double b(double x) { return cs_number_single(x); }\n",
    }
    assert.are.same({ "core/base/a.c:3" }, house.roundings(source))
  end)

  local SELF_CHECK = "#include \"base/a.h\"\nint cs_a_is_sound(void) { return 1; }\n"

  it("finds units that call each other", function()
    local circles = house.circles(tree_of {
      ["a.h"] = "int cs_a(void);\n",
      ["a.c"] = "#include \"base/b.h\"\nint cs_a(void) { return cs_b(); }\n",
      ["b.h"] = "int cs_b(void);\n",
      ["b.c"] = "int cs_b(void) { return cs_a(); }\n",
    })
    assert.are.same({ { "core/base/a", "core/base/b" } }, circles)
  end)

  it("takes no source for a circle that includes the header of its own functions", function()
    local files = {
      ["a.h"] = "int cs_a(void);\nint cs_a_is_sound(void);\n",
      ["a.c"] = "#include \"base/a.h\"\nint cs_a(void) { return cs_a_is_sound(); }\n",
      ["check.c"] = SELF_CHECK,
    }
    assert.are.same({}, house.circles(tree_of(files)))
    files["check.c"] = SELF_CHECK:gsub("return 1", "return cs_a()")
    assert.are.same({ { "core/base/a", "core/base/check" } }, house.circles(tree_of(files)))
  end)
end)
