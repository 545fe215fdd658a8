-- The annotations for editors, and what `celspan help lua` prints from them: all names, and no
-- others.
local celspan = require "celspan"
local own = require "tests.support.own"
local native, manual = own "celspan.native", own "celspan.manual"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local text = manual.annotations()

--- Classes by name: { parents = {names}, fields = { [name] = is_certain } }.
local function read_classes()
  local classes, class = {}, nil
  for line in (text .. "\n"):gmatch "(.-)\n" do
    local name, parents = line:match "^%-%-%-@class ([%w_.]+):?%s*(.*)$"
    local field, mark = line:match "^%-%-%-@field ([%w_]+)(%??) "
    if name then
      class = { parents = {}, fields = {} }
      for parent in parents:gmatch "[%w_.]+" do table.insert(class.parents, parent) end
      classes[name] = class
    elseif field and class then
      class.fields[field] = mark == ""
    elseif line:find "^%-%-%-@field %[integer%]" and class then
      class.fields[1] = true
    elseif not line:find "^%-%-%-@operator" then
      class = nil
    end
  end
  return classes
end

local classes = read_classes()

--- What a class says of a field, itself or through its parents: true, false (it may be nil), nil.
local function declared(name, field)
  local class = assert(classes[name], name)
  local found = class.fields[field]
  for _, parent in ipairs(class.parents) do
    if found == nil then found = declared(parent, field) end
  end
  return found
end

--- The class that a constructor is said to return.
local function returned(constructor)
  local at = assert(text:find("\nfunction celspan." .. constructor .. "(", 1, true), constructor)
  return text:sub(1, at):match ".*%-%-%-@return ([%w_.]+)"
end

local dot = celspan.circle { centre = { 0, 0 }, radius = 1 }
local cel = celspan.cel { dot }
--- The least that each constructor takes.
local samples = {
  paint = {}, linear = { from = { 0, 0 }, to = { 1, 1 }, { 0, "#fff" } },
  gradient = { { 0, 0, "#fff" }, { 1, 0, "#fff" }, { 0, 1, "#fff" } },
  radial = { centre = { 0, 0 }, radius = 1, { 0, "#fff" } },
  conic = { centre = { 0, 0 }, { 0, "#fff" } }, noise = {}, picture = { file = "x.png" },
  pattern = { art = dot, box = { 0, 0, 1, 1 } },
  rect = { 0, 0, 1, 1 }, triangle = { { 0, 0 }, { 1, 0 }, { 0, 1 } },
  circle = { centre = { 0, 0 }, radius = 1 }, ellipse = { centre = { 0, 0 }, radii = { 1, 2 } },
  polygon = { { 0, 0 }, { 1, 0 }, { 0, 1 } }, path = { d = "M0 0L1 0L0 1" },
  nurbs = { points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } },
  image = { file = "x.png", w = 1, h = 1 },
  scanline = { bounds = { 0, 0, 1, 1 }, spans = function() end },
  group = { dot, isolate = true }, key = { dot, spill = 0.5 },
  union = { dot }, intersection = { dot }, difference = { dot }, xor = { dot },
  stroke = { d = "M0 0H9" }, cel = { dot }, rostrum = { cel },
  film = { frame = function() return celspan.rostrum {} end },
}

-- Built without the libraries for type, there is no text to look at.
samples.text = present.type() and { "x", font = "../../../scripts/type/block.ttf" } or nil

--- The fields that a constructor says it has, when it is given one that cannot be.
local function fields_of(constructor)
  local _, message = pcall(celspan[constructor], { ["@@@@@@@@@@"] = true })
  return (tostring(message):match "the fields are (.*)" or ""):gmatch "[%w_]+"
end

describe("the annotations", function()
  it("are in the file that is installed, as the build prints it", function()
    assert.is_true(system.read(workbench.build .. "/lua/celspan.d.lua") == text)
  end)

  for constructor, sample in pairs(samples) do
    it("declare what can be read of a value: " .. constructor, function()
      local class, value = returned(constructor), celspan[constructor](sample)
      for field in fields_of(constructor) do
        local is_method = type(value[field]) == "function" and type(sample[field]) ~= "function"
        local certain = declared(class, field)
        assert.is_true(is_method or certain ~= nil, class .. "." .. field)
        if value[field] ~= nil and sample[field] == nil and not is_method then
          local word = " can be read though it was not given: it should have no '?'"
          assert.is_true(certain, class .. "." .. field .. word)
        end
      end
      assert.are.equal(value[1] ~= nil, declared(class, 1) or false, class .. "[1]")
    end)
  end

  it("have a sample of every constructor of a value", function()
    for name in pairs(celspan) do
      local is_value = name ~= "render" and name ~= "pixels" and name ~= "spans"
        and name ~= "glyphs" and name ~= "plane"
      if is_value and fields_of(name)() then
        assert.is_truthy(samples[name] or name == "text" and not present.type(), name)
      end
    end
  end)

  it("name every function and value of the module", function()
    for name in pairs(celspan) do
      local is_told = text:find("function celspan." .. name .. "(", 1, true)
        or text:find("---@field " .. name .. " ", 1, true)
      assert.is_truthy(is_told, name)
    end
  end)

  it("name nothing that is not there", function()
    for name in text:gmatch "\nfunction celspan%.(%w+)%(" do
      assert.are.equal("function", type(celspan[name]), name)
    end
  end)

  it("name every method", function()
    local union = celspan.union {}
    for name in text:gmatch "\nfunction placed:(%w+)%(" do
      assert.are.equal("function", type(union[name]), name)
    end
    for _, name in ipairs { "translate", "scale", "rotate", "skew", "transform", "quad", "fade",
                            "bounds", "contains", "with" } do
      assert.is_truthy(text:find("function placed:" .. name .. "(", 1, true), name)
    end
    assert.is_truthy(text:find("function nameable:named(", 1, true))
  end)
end)

--- The message of a constructor for its sample with one field changed; "" where it is accepted.
local function refusal(constructor, field, value)
  local fields = { [field] = value }
  for name, given in pairs(samples[constructor]) do fields[name] = fields[name] or given end
  local good, message = pcall(celspan[constructor], fields)
  return good and "" or message
end

describe("the range of a field", function()
  for constructor in pairs(samples) do
    for _, field in ipairs(native.nouns()[constructor] or {}) do
      local step = field.type == "integer" and 1 or 1e-3
      local below = field.least and field.least - step
      local beyond = { field.above, below, field.most and field.most * 2 }
      if field.type == "number" or field.type == "integer" then
        for _, value in pairs(beyond) do
          it(("is enforced: %s { %s = %g }"):format(constructor, field.name, value), function()
            assert.matches(("%s: %s is .*; it must be "):format(constructor, field.name),
              refusal(constructor, field.name, value))
          end)
        end
        for _, value in pairs { field.least, field.most } do
          local name = ("includes its ends: %s { %s = %g }"):format(constructor, field.name, value)
          it(name, function()
            local message = refusal(constructor, field.name, value)
            assert.is_nil(message:find(field.name .. " is ", 1, true))
          end)
        end
      end
    end
  end
end)

describe("the manual", function()
  it("has a page about every function, method, module and type that it lists", function()
    local list, count = manual.page(), 0
    for name in list:gmatch "\n  (%l[%l_]+)  +%u" do
      count = count + 1
      assert.is_truthy(manual.page(name), name)
    end
    local others = list:match("\nMethods:\n(.*)\nModules"):gsub("\nTypes:\n", "")
    for name in others:gmatch "%l[%l_:]+" do
      count = count + 1
      assert.is_truthy(manual.page(name), name)
    end
    assert.is_true(count > 80)
  end)

  it("says of a field its type, its range, its default and a sentence", function()
    assert.is_truthy(manual.page("stroke"):find(
      "\n  miter?        number: The longest miter, in widths; 1 to 1000000; default 4\n", 1, true))
  end)

  it("knows names with celspan before them, and methods with what they belong to", function()
    assert.are.equal(manual.page "circle", manual.page "celspan.circle")
    assert.is_truthy(manual.page("object:stroke"):find("object:stroke(style?)", 1, true))
    assert.is_truthy(manual.page("motion.along"):find("motion.along(outline)", 1, true))
    assert.is_truthy(manual.page("keys"):find("The value at a time", 1, true))
  end)

  it("refuses an unknown name with the nearest, or with where to look", function()
    assert.are.same({ nil, "there is no page about 'strok'; did you mean 'stroke'?" },
      { manual.page "strok" })
    local _, message = manual.page "xyzzyxyzzy"
    assert.equal("there is no page about 'xyzzyxyzzy'; celspan help lua lists the names", message)
  end)

  it("lists every function of celspan and every module of the reference", function()
    local list = manual.page()
    for name, value in pairs(celspan) do
      assert.is_truthy(type(value) ~= "function" or list:find("\n  " .. name .. " ", 1, true), name)
    end
    for name in system.output("cat docs/lua*.md"):gmatch "\n### Module celspan%.(%l+)" do
      assert.is_truthy(list:find("\n  " .. name .. " ", 1, true), name)
    end
  end)
end)

describe("a module in Lua", function()
  local is_public = {}
  for _, name in ipairs(manual.MODULES) do is_public[name] = true end
  local names = system.lines "find lua/celspan -name '*.lua' | sed 's|.*/||; s|[.]lua$||'"
  names[#names + 1] = "native"

  it("is for scripts if the manual has it, else refused to them, though celspan uses it", function()
    own "celspan.puppet_sheet"
    for _, name in ipairs(names) do
      local good, result = pcall(require, "celspan." .. name)
      assert.are.equal(is_public[name] or false, good, name)
      if not good then
        assert.is_truthy(result:find(("tests/kit/spec/meta_spec.lua:%%d+: module 'celspan.%s' is "
          .. "private: only celspan's own modules can require it"):format(name)), result)
      end
    end
    assert.is_true(#names > 50)
  end)

  it("that is private is suggested to nobody", function()
    local _, message = pcall(function() return celspan.fields end)
    assert.is_nil(message:find("require", 1, true))
  end)
end)
