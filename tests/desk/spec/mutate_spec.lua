-- ./run mutate: which faults it makes in a source, and which places it skips.
local equal = require "tests.mutate.equal"
local mutants = require "tests.mutate.mutants"
local system = require "tests.support.system"

--- The mutants of a source, one per line.
local function told(text)
  local lines = {}
  for i, mutant in ipairs(mutants.of(text)) do
    lines[i] = ("%d %s"):format(mutant.line, mutants.tell(mutant))
  end
  return table.concat(lines, "\n")
end

--- The mutants of a function's body.
local function told_of(body) return told("void f(void) {\n" .. body .. "\n}\n") end

local function lines(...) return table.concat({ ... }, "\n") end

describe("mutants", function()
  it("change comparisons, bounds and conditions", function()
    assert.are.equal(lines("2 `a < b` to `!(a < b)`", "2 `<` to `<=`", "2 `<` to `>`",
      "2 drop `return;`"), told_of "if (a < b) return;")
  end)

  it("change operators between operands and signs, not pointers and casts", function()
    assert.are.equal(lines("2 drop `x = a * -b;`", "2 `*` to `/`", "2 `-` to `nothing`"),
      told_of "x = a * -b;")
    assert.are.equal("2 drop `x = (double)*p;`", told_of "x = (double)*p;")
    assert.are.equal("2 drop `g((const cs_row *)p);`", told_of "g((const cs_row *)p);")
    assert.are.equal("2 drop `*p = &a;`", told_of "*p = &a;")
  end)

  it("change constants", function()
    assert.are.equal(lines("2 `3u` to `2u`", "2 `3u` to `4u`"), told_of "return 3u;")
    assert.are.equal("2 `0` to `1`", told_of "return 0;")
    assert.are.equal("2 `1.5` to `3.0`", told_of "return 1.5;")
    assert.are.equal("2 `0x7fu` to `0x80u`", told_of "return 0x7fu;")
    assert.are.equal("2 `0.25f` to `0.5f`", told_of "return 0.25f;")
    assert.are.equal("2 `true` to `false`", told_of "return true;")
  end)

  it("swap arguments whose order matters", function()
    assert.are.equal(lines("2 drop `g(a, b);`", "2 `a, b` to `b, a`"), told_of "g(a, b);")
    assert.are.equal("2 drop `fmin(a, b);`", told_of "fmin(a, b);")
    assert.are.equal("2 drop `g(a, a);`", told_of "g(a, a);")
  end)

  it("do not change declarations, types, labels and assertions", function()
    assert.are.equal("", told "struct pair { double x[2 + 1]; };\nint f(int a, int b);\n")
    assert.are.equal("", told_of "double *p, a[4 * 2];")
    assert.are.equal("2 `1` to `0`\n2 `1` to `2`", told_of "const double *p = g(x[1]);")
    assert.are.equal("2 drop `break;`", told_of "switch (a) { case 3: break; }")
    assert.are.equal("", told_of "static_assert(A < B, \"\");\nCS_SELF_CHECK(a < b);")
    assert.are.equal("", told_of "/* a < b; */ // a + b;\n#define X (1 + 2)")
    assert.are.equal("2 drop `h();`", told_of "h();\n#ifdef CELSPAN_CHECKS\ng(1);\n#endif")
    assert.are.equal("2 drop `g(\"a < 1\", '+');`\n2 `\"a < 1\", '+'` to `'+', \"a < 1\"`",
      told_of "g(\"a < 1\", '+');")
    assert.are.equal("2 drop `n = sizeof(x[3]);`", told_of "n = sizeof(x[3]);")
  end)

  it("do not change the choice between equal values, which has no effect", function()
    assert.are.equal("2 `<` to `>`", told_of "return a->x < b ? a->x : b;")
    assert.are.equal("2 `>` to `<`", told_of "return a > b[i] ? b[i] : a;")
    assert.are.equal("2 `<` to `<=`\n2 `<` to `>`", told_of "return a < b ? b : c;")
  end)

  it("of one line are numbered if they are printed alike", function()
    local list = mutants.of "void f(void) {\n  x = a + 0 + b[0];\n}\n"
    local found = {}
    for _, mutant in ipairs(list) do
      if mutants.tell(mutant) == "`0` to `1`" then found[#found + 1] = mutant.nth end
    end
    assert.are.same({ 1, 2 }, found)
  end)

  it("have as many lines as the source, and differ at one place", function()
    local text = "void f(void) {\n  g(a,\n    b);\n  return;\n}\n"
    for _, mutant in ipairs(mutants.of(text)) do
      local changed = mutants.apply(text, mutant)
      assert.are.equal(select(2, text:gsub("\n", "")), select(2, changed:gsub("\n", "")))
      assert.are_not.equal(text, changed)
    end
  end)
end)

describe("the lists", function()
  it("of mutants that change nothing contain only possible ones, with reasons", function()
    for path, entries in pairs(equal) do
      local text, made = system.read(path), {}
      for _, mutant in ipairs(mutants.of(text)) do
        local name = mutants.line_of(text, mutant) .. ": " .. mutants.tell(mutant)
        made[name] = math.max(made[name] or 0, mutant.nth)
      end
      for _, entry in ipairs(entries) do
        local name = entry[1] .. ": " .. entry[2]
        assert.is_truthy(made[name], path .. ": " .. name)
        assert.is_true(made[name] == 1 or entry[4] ~= nil and entry[4] <= made[name], name)
        assert.is_true(#entry[3] > 20)
      end
    end
  end)
end)
