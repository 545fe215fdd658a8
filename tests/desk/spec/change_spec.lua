-- Options of render that change a film's frames: --cel, --background, --dither.
local workbench = require "tests.support.workbench"

local SCRIPT = [[
local celspan = require "celspan"
local shade = celspan.linear { from = { 0, 0 }, to = { 64, 0 }, { 0, "#101010" }, { 1, "#181818" } }
return celspan.film { size = { 64, 32 }, frames = 3, frame = function(f)
  local cels = {
    celspan.cel { celspan.rect { 0, 0, 64, 32, texture = shade } }:named("back"),
    celspan.cel { back = { 0, 0, 1 }, celspan.rect { 8, 8, 16, 16, texture = "#ff0000" }
      }:named("hand"),
    celspan.cel { celspan.rect { 30, 8, 16, 16, texture = "#00ff00" } },
  }
  if f.number == 3 then table.remove(cels, 2) end
  cels.front, cels.back = { 0.5, 0.5, 0.5 }, { 1, 1, 1, 0.5 }
  return celspan.rostrum(cels)
end }
]]

describe("render", function()
  local bench, script

  setup(function()
    bench = workbench.new()
    script = bench:write("film.lua", SCRIPT)
  end)
  teardown(function() bench:remove() end)

  local function path(name) return bench.folder .. "/" .. name end

  --- Renders a frame raw: pixel(x, y) gives its bytes.
  local function raw(arguments, frame)
    local code, out, err = bench:celspan("render %s --frames %d -o - %s", script, frame or 1,
      arguments)
    assert.are.equal(0, code, err)
    return function(x, y) return { out:byte(4 * (64 * y + x) + 1, 4 * (64 * y + x) + 4) } end
  end

  local function render(arguments)
    local code, out, err = bench:celspan("render %s %s", script, arguments)
    return code, out .. err
  end

  local function same(a, b)
    return (bench:celspan("compare %s %s", path(a), path(b))) == 0
  end

  it("shows one cel alone, with its lights and without the others'", function()
    local pixel = raw("--cel hand --colour linear --alpha premultiplied")
    assert.are.same({ 128, 0, 0, 255 }, pixel(10, 10)) -- the rostrum's front, half as bright
    assert.are.same({ 0, 0, 255, 255 }, pixel(0, 0)) -- its own back light; not the rostrum's
    assert.are.same({ 0, 0, 255, 255 }, pixel(40, 10))
    assert.are.same({ 0, 0, 0, 0 }, raw("--cel hand", 3)(10, 10))
  end)

  it("refuses a cel that no frame has, and lists the existing ones, nearest first", function()
    local code, said = render("--cel bakc -o " .. path("x.####.png"))
    assert.are.equal(2, code)
    assert.is_truthy(said:find("--cel bakc: no cel of the film has this name; its names are "
      .. "back, hand\n",
      1, true), said)
    assert.are.equal(0, (render("--cel hand --frames 3 -o " .. path("x.png")))) -- empty
    local plain = bench:write("plain.lua", "return require 'celspan'.rostrum {}")
    code = bench:celspan("render %s --cel hand -o %s", plain, path("x.png"))
    assert.are.equal(2, code)
  end)

  it("puts a background behind everything", function()
    local pixel = raw("--cel back --background '#336699' --colour linear --alpha premultiplied")
    local empty = raw("--cel hand --background '#fff' --colour linear", 3)
    assert.are.same({ 255, 255, 255, 255 }, empty(10, 10))
    assert.are.equal(255, pixel(0, 0)[4])
    local plain = bench:write("half.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 4, 1 }, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 2, 1, texture = celspan.rgb(1, 0, 0,
    0.5) } } }
end }]])
    local code, out = bench:celspan("render %s --background '#0000ff' --colour linear -o -", plain)
    assert.are.equal(0, code)
    assert.are.same({ 128, 0, 128, 255, 128, 0, 128, 255, 0, 0, 255, 255 }, { out:byte(1, 12) })
    local lit = bench:write("lit.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 1, 1 }, frame = function()
  return celspan.rostrum { back = { 0, 1, 0, 0.75 } }
end }]])
    code, out = bench:celspan("render %s --background '#0000ff' --colour linear -o -", lit)
    assert.are.equal(0, code)
    assert.are.same({ 0, 255, 64, 255 }, { out:byte(1, 4) })
    local coded = bench:write("coded.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 2, 1 }, space = "srgb", frames = 3, frame = function(f)
  local back = ({ "#f6ead2", { 0.5, 0.5, 0.5, 1 } })[f.number]
  return celspan.rostrum { back = back, celspan.cel {
    celspan.rect { 0, 0, 1, 1, texture = "#20406080" } } }
end }]])
    local function pixels(arguments)
      local done, bytes = bench:celspan("render %s %s -o -", coded, arguments)
      assert.are.equal(0, done)
      return { bytes:byte(1, -1) }
    end
    for frame = 1, 2 do -- an opaque back light hides the background
      local one = "--frames " .. frame
      assert.are.same(pixels(one), pixels(one .. " --background '#123456'"))
    end
    assert.are.same(pixels "--frames 1", pixels "--frames 3 --background '#f6ead2'")
    local window = bench:write("window.lua", [[
local celspan = require "celspan"
local shade = celspan.linear { from = { 0, 0 }, to = { 2, 0 }, { 0, "#ff0000" }, { 1, "#ff000000" }
  }
return celspan.film { size = { 2, 1 }, frame = function()
  return celspan.rostrum { back = { texture = shade } }
end }]])
    code, out = bench:celspan("render %s --background '#0000ff' --colour linear -o -", window)
    assert.are.equal(0, code)
    assert.are.same({ 191, 0, 255, 255, 64, 0, 255, 255 }, { out:byte(1, 8) })
    local exposed = bench:write("exposed.lua", [[
local celspan = require "celspan"
local function shot(x, colour)
  return celspan.rostrum { celspan.cel { celspan.rect { x, 0, 1, 1, texture = colour } } }
end
local second = ...
return celspan.film { size = { 3, 1 }, frame = function()
  return { { shot(0, "#ff0000"), 0.25 }, { shot(1, "#00ff00"), tonumber(second) } }
end }]])
    code, out = bench:celspan("render %s --background '#0000ff' --colour linear -o - -- 0.25",
      exposed)
    assert.are.equal(0, code)
    assert.are.same({ 64, 0, 191, 255, 0, 64, 191, 255, 0, 0, 255, 255 }, { out:byte(1, 12) })
    local _, err
    code, _, err = bench:celspan("render %s --background '#0000ff' -o - -- 1", exposed)
    assert.are.equal(3, code)
    assert.truthy(err:find("--background: the weights of the frame's exposures add up to 1.25; a "
      .. "background can lie behind 1 at most", 1, true), err)
    local said
    code, said = render("--background '#0000ff80' -o " .. path("x.####.png"))
    assert.are.equal(2, code, said)
    assert.are.equal(2, (render("--background bluee -o " .. path("x.####.png"))))
  end)

  it("writes PNG without alpha if there is a background", function()
    assert.are.equal(0, (render("--background '#fff' --frames 1 -o " .. path("opaque.png"))))
    assert.are.equal(2, bench:read("opaque.png"):byte(26)) -- colour type RGB
  end)

  it("dithers equally in every format, with any workers and in any crop", function()
    for name, options in pairs { ["a.png"] = "", ["a.tga"] = "", ["b.png"] = "--workers 3",
                                 ["crop.png"] = "--crop 5,3,20,11", ["plain.png"] = "NO" } do
      local dither = options == "NO" and "" or "--dither " .. options
      local code, said = render("--frames 1 " .. dither .. " -o " .. path(name))
      assert.are.equal(0, code, said)
    end
    assert.is_true(same("a.png", "a.tga"))
    assert.are.equal(bench:read "a.png", bench:read "b.png")
    assert.is_false(same("a.png", "plain.png"))
    assert.are.equal(0,
      (bench:celspan("compare %s %s --fail 0.00393", path("a.png"), path("plain.png"))))
    bench:celspan("convert %s %s --crop 5,3,20,11", path("a.png"), path("cut.png"))
    assert.is_true(same("crop.png", "cut.png"))
    local _, out = bench:celspan("render %s --frames 1 --dither --hash", script)
    local _, tee = bench:celspan("render %s --frames 1 --dither --hash -o %s", script,
      path("t.png"))
    assert.are.equal(out, tee)
    assert.are.equal(bench:read "a.png", bench:read "t.png")
  end)

  it("gives the same dithered pixels raw, by image:bytes and by image:write", function()
    local celspan = require "celspan"
    local film = assert(load(SCRIPT))()
    local image = assert(celspan.pixels(film, { frame = 1, crop = { 5, 3, 20, 11 } }))
    local _, out = bench:celspan("render %s --frames 1 --dither --crop 5,3,20,11 -o -", script)
    assert.are.equal(out, image:bytes { dither = true })
    assert.is_true(image:write(path("written.png"), { dither = true }))
    assert.is_true(celspan.render(film, path("rendered.png"),
      { frames = 1, crop = { 5, 3, 20, 11 }, dither = true }))
    assert.is_true(same("written.png", "rendered.png"))
    local code = render("--frames 1 --dither --crop 5,3,20,11 -o " .. path("cli.png"))
    assert.are.equal(0, code)
    assert.are.equal(bench:read "cli.png", bench:read "rendered.png")
  end)

  it("refuses to dither anything but pixels of 8 bits", function()
    local code, said = render("--dither --depth 16 -o " .. path("x.####.png"))
    assert.are.equal(2, code)
    assert.is_truthy(said:find("--dither makes 8 bits", 1, true), said)
    code, said = render("--dither -o " .. path("x.####.span"))
    assert.are_not.equal(0, code)
    assert.is_truthy(said:find("span files hold the colours of spans", 1, true), said)
    local celspan = require "celspan"
    local image = assert(celspan.pixels(celspan.rostrum {}, { size = { 1, 1 } }))
    local raised = require "tests.support.raised"
    assert.are.equal("bytes: field 'dither' makes 8 bits; leave 'depth' out or give 8",
      (raised.sentence(function() image:bytes { dither = true, depth = 16 } end)))
    assert.are.equal("bytes: field 'dither' must be true or false, got number",
      (raised.sentence(function() image:bytes { dither = 1 } end)))
  end)

  it("makes frames again on --resume when the options changed", function()
    local out = path("resumed.####.png")
    assert.are.equal(0, (render("--resume -o " .. out)))
    local plain = { bench:read("resumed.0001.png"), bench:read("resumed.0003.png") }
    for options, i in pairs { ["--dither"] = 1, ["--cel hand"] = 1, ["--background '#fff'"] = 2 } do
      local name = i == 1 and "resumed.0001.png" or "resumed.0003.png"
      local code, said = render("--resume " .. options .. " -o " .. out)
      assert.are.equal(0, code, said)
      assert.is_true(plain[i] ~= bench:read(name), options)
      render("--resume -o " .. out)
      assert.is_true(plain[i] == bench:read(name), options)
    end
  end)
end)
