-- Names of values, and the lines where they were made.
local celspan = require "celspan"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local function line() return debug.getinfo(2, "l").currentline end

local function disc()
  return celspan.circle { centre = { 10, 20 }, radius = 5, texture = "#f80" }
end

local function values()
  return {
    object = disc(),
    union = disc() | disc(),
    paint = celspan.rgb(1, 0, 0),
    texture = celspan.linear { from = { 0, 0 }, to = { 9, 0 }, { 0, "#000" }, { 1, "#fff" } },
    cel = celspan.cel { disc() },
    rostrum = celspan.rostrum { celspan.cel { disc() }, antialias = { kernel = "gaussian" } },
  }
end

describe("a name", function()
  it("can be given to every value, and read back", function()
    for kind, value in pairs(values()) do
      assert.is_nil(value.name, kind)
      local named = value:named("hand")
      assert.are.equal("hand", named.name, kind)
      assert.is_nil(value.name, kind)
      assert.are.equal(value.origin, named.origin, kind)
      assert.are.equal("foot", named:named("foot").name, kind)
      assert.is_truthy(tostring(named):find('"hand"', 1, true), tostring(named))
    end
  end)

  it("is kept by transforms, fades and with, not by values made from the named one", function()
    local named = disc():named("hand")
    for _, value in ipairs { named:translate(1, 2), named:rotate(30), named:fade(0.5),
                             named:with { radius = 9 },
                               named:scale(2):fade(0.5):with { radius = 1 } } do
      assert.are.equal("hand", value.name)
      assert.are.equal(named.origin, value.origin)
    end
    local cel = celspan.cel { named }:named("front")
    assert.are.equal("front", cel:fade(0.5):translate(1, 1).name)
    assert.are.equal("front", cel:with { opacity = 0.5 }.name)
    assert.is_nil((named | disc()).name)
    assert.are.equal("r", celspan.rostrum {}:named("r"):with { brightness = 2 }.name)
    assert.are.equal("warm", celspan.rgb(1, 0, 0):named("warm"):with { beta = 0.5 }.name)
  end)

  it("prevents a union from being flattened", function()
    local pair = (disc() | disc()):named("pair")
    local more = pair | disc()
    assert.is_truthy(tostring(more):find("2 objects", 1, true))
  end)

  it("changes no pixel, and equal frames stay equal", function()
    local function rostrum(object) return celspan.rostrum { celspan.cel { object } } end
    local options = { size = { 20, 30 } }
    local plain = assert(celspan.pixels(rostrum(disc()), options))
    local named = assert(celspan.pixels(rostrum(disc():named("a")):named("b"), options))
    for y = 0, 29 do
      for x = 0, 19 do assert.are.same({ plain:get(x, y) }, { named:get(x, y) }) end
    end
  end)

  it("is refused if it is not a string of reasonable length", function()
    local function refusal(name)
      return (raised.sentence(function() disc():named(name) end))
    end
    assert.are.equal("named: the name must be a string, got nil", refusal(nil))
    assert.are.equal("named: the name must be a string, got number", refusal(7))
    assert.are.equal("named: the name has 0 bytes; it must have 1 to 255", refusal(""))
    assert.are.equal("named: the name has 256 bytes; it must have 1 to 255",
      refusal(("x"):rep(256)))
    assert.are.equal("named: the name must not hold a zero byte", refusal("a\0b"))
    for bytes, at in pairs { ["a\nb"] = 2, ["\127"] = 1, ["\xc2\x85"] = 1, ["ab\xff"] = 3,
      ["\xc0\xaf"] = 1,
                             ["\xed\xa0\x80"] = 1, ["\xf4\x90\x80\x80"] = 1, ["\xe2\x82"] = 1 } do
      assert.are.equal("named: byte " .. at .. " of the name is not text; it must be UTF-8 without "
        .. "control characters", refusal(bytes))
    end
    for _, name in ipairs { ("x"):rep(255), "main gauche – 手 🖐", " " } do
      assert.are.equal(name, disc():named(name).name)
    end
  end)
end)

describe("the line of a value", function()
  it("is that of the constructor's caller", function()
    local here = line() + 1
    for kind, value in pairs(values()) do
      assert.is_truthy(value.origin:find("names_spec.lua:%d+$"), kind .. ": " .. value.origin)
    end
    local paint = celspan.rgb(1, 1, 1)
    assert.are.equal(here + 3, tonumber(paint.origin:match ":(%d+)$"))
    local function helper() return celspan.rect { 0, 0, 1, 1 } end
    assert.are.equal(here + 5, tonumber(helper().origin:match ":(%d+)$"))
    local both = disc() | disc()
    assert.are.equal(here + 7, tonumber(both.origin:match ":(%d+)$"))
  end)

  it("is the script's, not one of celspan's own modules", function()
    local multiplane = require "celspan.multiplane"
    local rostrum = multiplane { film = { 10, 10 }, { celspan.cel {} } }
    assert.is_truthy(rostrum.origin:find("names_spec.lua:%d+$"), rostrum.origin)
  end)

  it("survives a constructor that raises", function()
    pcall(celspan.circle, { centre = { 0, 0 }, radius = -1 })
    local here = line() + 1
    assert.are.equal(here, tonumber(disc():with { radius = 2 } and line()))
    assert.is_truthy(disc().origin)
  end)
end)

describe("names in messages", function()
  local bench

  local SCRIPT = [[
local celspan = require "celspan"
local sky = celspan.image { file = "nothing.png", w = 9, h = 9 }:named("sky")
return celspan.film { size = { 10, 10 }, frames = 3, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 1, 1 } },
    celspan.cel { celspan.rect { 0, 0, 5, 5 } | sky }:named("back"),
  }:named("easel")
end }
]]
  local TINY = [[
local celspan = require "celspan"
return celspan.rostrum { camera = { centre = { 0, 0 }, width = 5 },
  celspan.cel { viewport = { 0, 0, 1e-12, 1e-12 } }:named("far") }
]]

  setup(function() bench = workbench.new() end)
  teardown(function() bench:remove() end)

  local function celspan_says(arguments)
    local code, out, err = bench:shell("'" .. workbench.binary .. "' " .. arguments)
    return code, out .. err
  end

  it("identify cel and picture", function()
    local script = bench:write("missing.lua", SCRIPT)
    local _, said = celspan_says("render " .. script .. " --frames 1 -o " .. script .. ".png")
    assert.is_truthy(said:find("cel 2 'back' (" .. script .. ":6), primitive 'sky' (" .. script
      .. ":2): ", 1, true), said)
  end)

  it("identify the cel of a view that is refused", function()
    local script = bench:write("tiny.lua", TINY)
    local _, said = celspan_says("render " .. script .. " --frames 1 -o " .. script .. ".png")
    assert.is_truthy(said:find("cel 1 'far' (" .. script .. ":3): its viewport", 1, true), said)
  end)

  it("are printed by check", function()
    local script = bench:write("checked.lua", SCRIPT)
    local _, said = celspan_says("check " .. script)
    assert.is_truthy(said:find(("cel 2 'back' (%s:6), primitive 2 'sky' (%s:2): ")
      :format(script, script),
                               1, true), said)
  end)

  it("are found in compositions inside others", function()
    local script = bench:write("nested.lua", [[
local celspan = require "celspan"
local sky = celspan.image { file = "nothing.png", w = 9, h = 9 }:named("sky")
local window = celspan.rostrum { size = {9, 9}, celspan.cel { sky }:named("pane") }:named("window")
return celspan.rostrum { celspan.cel { window:translate(3, 4):fade(0.5) }:named("wall") }]])
    local code, said = celspan_says("info " .. script)
    assert.are.equal(0, code)
    for _, wanted in ipairs { "named cel 1 wall (%s:4)\n", "named object 1 window (%s:3)\n",
                            "named rostrum 1 window (%s:3)\n", "named cel 1 pane (%s:3)\n",
                            "named object 1 sky (%s:2)\n" } do
      assert.is_truthy(said:find(wanted:format(script), 1, true), said)
    end
    said = select(2, celspan_says("render " .. script .. " -o " .. script .. ".png"))
    assert.is_truthy(said:find("cel 1 'wall' (" .. script .. ":4), primitive 'sky' (" .. script
      .. ":2): ", 1, true), said)
  end)

  it("are listed by info, with the frames that contain them", function()
    local script = bench:write("named.lua", SCRIPT)
    local code, said = celspan_says("info " .. script)
    assert.are.equal(0, code)
    assert.is_truthy(said:find("named rostrum 3 easel (" .. script .. ":4)\n", 1, true), said)
    assert.is_truthy(said:find("named cel 3 back (" .. script .. ":6)\n", 1, true), said)
    assert.is_truthy(said:find("named object 3 sky (" .. script .. ":2)\n", 1, true), said)
  end)
end)
