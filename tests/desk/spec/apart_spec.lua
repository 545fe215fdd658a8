-- The cels of a frame as layers of an OpenEXR file, read back by OpenImageIO.
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local it_reads = present.pictures() and present.program "oiiotool" and it or pending

local HEAD = [[
local celspan = require "celspan"
local function box(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end
local function still(width, height, cels)
  return celspan.film { size = { width, height },
    frame = function() return celspan.rostrum(cels) end }
end
]]

--- Every way in which a layer is lit and faded that adds up; edges of cels do not share pixels.
local SUMS = HEAD .. [[
local ramp = celspan.linear { from = { 8, 8 }, to = { 80, 50 },
  { 0, "#f26419" }, { 1, "#33658a80" } }
local lamp = celspan.radial { centre = { 60, 30 }, radius = 40, { 0, "#fff" }, { 1, "#000" } }
return celspan.film { size = { 96, 64 }, frames = 2, frame = function(f)
  return celspan.rostrum { back = { 0.1, 0.2, 0.3, 0.6 }, front = { 1, 0.9, 0.8 }, brightness = 1.1,
    celspan.cel { box(4, 4, 88, 56, ramp) }:named "wall",
    celspan.cel { box(8.5, 8.5, 40, 40, "#3a6c"), opacity = 0.7 }:named "hand",
    celspan.cel { box(20.3, 12.3, 60, 20, "#e22c"), front = { 0.5, 2, 1 } }:named "hand",
    celspan.cel { box(30.5, 20.5, 30, 30, "#fff8"), front = lamp }:named "a.b/c,d",
    celspan.cel { box(50.7, 5.7, 20, 50, "#fff3"), back = { 0.2, 0.1, 0, 0 } },
    celspan.cel { celspan.circle { centre = { 70, 45 }, radius = 9, texture = "#fffa" } } } end }
]]
local EXACT = "--depth float --antialias none"
local NAMES = { "backlight", "wall", "hand", "hand_2", "a_b_c_d", "cel_5", "cel_6" }

--- A frame of rectangles with colours by chance, in cels by chance.
local function chance(seed)
  local random = prng.new(seed)
  local function numbers(count, least, most)
    local list = {}
    for i = 1, count do list[i] = ("%.2f"):format(random:between(least, most)) end
    return table.concat(list, ", ")
  end
  local lines = { HEAD, "return still(48, 48, {" }
  for _ = 1, random:whole(2, 9) do
    lines[#lines + 1] = ("celspan.cel { opacity = %s, front = { %s }, "
      .. "box(%s, %s, celspan.rgb(%s)) },"):format(
        numbers(1, 0.2, 1), numbers(3, 0, 2), numbers(2, -5, 40), numbers(2, 3, 40),
        numbers(4, 0, 1))
  end
  lines[#lines + 1] = "})"
  return table.concat(lines, "\n")
end

describe("--layers cels", function()
  local bench

  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  local function run(arguments) return bench:ran(arguments) end
  local function render(script, arguments) return bench:rendered(script, arguments) end
  local function refused(arguments, words)
    local code, err = run("render film.lua --progress none " .. arguments)
    assert.equal(2, code, err)
    assert.truthy(err:find(words, 1, true), err)
    assert.is_nil(bench:read "x.1.exr")
    assert.is_nil(bench:read "x.exr")
  end
  local function oiiotool(arguments)
    local code, out, err = bench:inside("oiiotool " .. arguments)
    assert.equal(0, code, out .. err)
    return out
  end
  local function names(file)
    local list = oiiotool("--info -v " .. file):match 'celspan:layers: "([^"]*)"'
    local out = {}
    for name in list:gmatch "[^,]+" do out[#out + 1] = name end
    return out
  end
  --- A layer of a file, as OpenImageIO's picture of R G B A.
  local function layer(file, name)
    return ("%s --ch R=%s.R,G=%s.G,B=%s.B,A=%s.A"):format(file, name, name, name, name)
  end
  --- Whether the layers over each other are the frame, within 1e-5.
  local function sums(file)
    local words, list = {}, names(file)
    for i = #list, 1, -1 do
      words[#words + 1] = layer(file, list[i]) .. (i < #list and " --over" or "")
    end
    local code = bench:inside(("oiiotool --fail 1e-5 --warn 1e-5 %s %s --ch R,G,B,A --diff")
      :format(table.concat(words, " "), file))
    return code == 0
  end

  it_reads("writes the frame, and each cel as --cel shows it, in their order", function()
    render(SUMS, "--frames 1 --depth float --layers cels -o x.exr")
    assert.same(NAMES, names "x.exr")
    render(SUMS, "--frames 1 --depth float -o frame.exr")
    oiiotool "--fail 1e-3 --warn 1e-3 x.exr --ch R,G,B,A frame.exr --diff"
    for _, pair in ipairs { { "wall", "wall" }, { "a.b/c,d", "a_b_c_d" } } do
      render(SUMS, "--frames 1 --depth float --cel " .. pair[1] .. " -o cel.exr")
      oiiotool(("--fail 1e-3 --warn 1e-3 %s cel.exr --diff"):format(layer("x.exr", pair[2])))
    end
  end)

  it_reads("writes layers that add up to the frame, also at edges of one cel", function()
    assert.equal("", render(SUMS, "--frames 1 --layers cels -o x.exr " .. EXACT))
    assert.is_true(sums "x.exr")
    for seed = 1, 12 do
      render(chance(seed), "--layers cels -o y.exr " .. EXACT)
      assert.is_true(sums "y.exr", "seed " .. seed)
    end
    local one = HEAD .. [[
      return still(32, 32, { back = "#456",
        celspan.cel { box(2.5, 2.5, 12.25, 20.75, "#f84c") }:named "left",
        celspan.cel { celspan.circle { centre = { 24, 16 }, radius = 7, texture = "#8f4c" } } })]]
    render(one, "--depth float --layers cels -o z.exr")
    assert.is_true(sums "z.exr")
  end)

  it_reads("says what keeps layers from adding up", function()
    local function cels(what)
      return HEAD .. [[return celspan.film { size = { 32, 32 }, frames = 3, frame = function()
        local under = celspan.cel { box(0, 0, 32, 16, "#842") }
        local function over(t) return celspan.cel(t):named "top" end
        local red = box(8, 8, 16, 16, "#f008")
        return ]] .. what .. " end }"
    end
    local gel = "over { box(8, 8, 16, 16, celspan.gel '#f00') }"
    local fan = "celspan.radial { centre = { 9, 9 }, radius = 9, { 0, '#fff' }, { 1, '#0000' } }"
    for what, words in pairs {
      ["celspan.rostrum { under, " .. gel .. " }"] = "cel 2 'top' (film.lua:9) has a gel",
      ["celspan.rostrum { under, over { back = { 0.2, 0.3, 0.1, 0.5 }, red } }"] =
        "has a back light with a matte",
      ["celspan.rostrum { under, over { back = " .. fan .. ", red } }"] =
        "has a back light with a matte",
      ["celspan.rostrum { under, over { blend = 'multiply', red } }"] = "has a blend mode",
      ["celspan.rostrum { under, over { red:blend 'multiply' } }"] =
        "has an object with a blend mode",
      ["celspan.rostrum { space = 'srgb', under, over { red } }"] = 'mixes codes (space "srgb")',
      ["{ { celspan.rostrum { under }, 0.5 }, { celspan.rostrum { under, over { red } }, 0.5 } }"] =
        "has several exposures",
    } do
      local err = render(cels(what), "--frames 1-3 --layers cels -o 'x.#.exr' " .. EXACT)
      assert.truthy(err:find("frame 1: its layers over each other are not the frame: ", 1, true),
        what .. err)
      assert.truthy(err:find(words, 1, true), err)
      assert.equal(1, select(2, err:gsub("over each other", "")))
      if what:sub(1, 1) ~= "{" then assert.is_false(sums "x.1.exr", what) end
    end
    for field, words in pairs { ["grade = { saturation = 0.5 }"] = "a grade",
      ["grain = {}"] = "grain" } do
      local err = render(cels(("celspan.rostrum { %s, under, over { red } }"):format(field)),
        "--frames 1 --layers cels -o x.exr")
      assert.truthy(err:find("its rostrum has " .. words, 1, true), err)
    end
  end)

  it("says where light is cut that is brighter than white alone", function()
    local function film(back, front, top)
      return HEAD .. ([[return celspan.film { size = { 2, 1 }, space = "srgb", frame = function()
        return celspan.rostrum { back = %s,
          celspan.cel { box(0, 0, 1, 1, "#fa4"), opacity = 0.5, front = %s }:named "low",
          %s } end }]]):format(back, front, top or "")
    end
    local top = 'celspan.cel { box(0, 0, 2, 1, "#2228") }'
    local bright = "its back light is brighter than its matte"
    local lit = "cel 1 'low' (film.lua:9) is lit"
    for _, one in ipairs { { film("'#77bbf680'", "'#fff'"), bright }, { film("'#222'", "'#fff'") },
      { film("'#222'", "{ 1, 1.5, 1 }", top), lit }, { film("'#222'", "{ 1, 1.5, 1 }") } } do
      for _, ending in ipairs { "ora", "psd", "png" } do
        local err = render(one[1], "--frames 1 --layers cels -o x." .. ending)
        if one[2] then
          assert.matches("its layers over each other are not the frame: " .. one[2], err, 1, true)
        else
          assert.equal("", err)
        end
      end
    end
  end)

  it_reads("has the cels of a film with grain, each with that grain", function()
    local grainy = SUMS:gsub("frames = 2", "frames = 2, grain = { amount = 0.1 }")
    render(grainy, "--frames 1 --depth float --layers cels --cryptomatte cels -o x.exr")
    assert.same(NAMES, names "x.exr")
    render(grainy, "--frames 1 --depth float --cel wall -o cel.exr")
    oiiotool(("--fail 1e-6 %s --ch R,G,B,A cel.exr --diff"):format(layer("x.exr", "wall")))
  end)

  it_reads("makes names safe, equal names different, and long names fit", function()
    local long, wide = ("n"):rep(255), ("\u{e4}"):rep(127)
    render(HEAD .. ([[local cels = { back = "#123" }
      for name in ("%s,%s,%s,a.b,a/b,a_b,a_b_2,hand 1,backlight"):gmatch "[^,]+" do
        cels[#cels + 1] = celspan.cel { box(0, 0, #cels + 1, 8, "#fff") }:named(name)
      end
      return still(8, 8, cels)]]):format(long, long, wide), "--layers cels -o x.exr")
    local list = names "x.exr"
    assert.same({ "backlight", ("n"):rep(253), ("n"):rep(251) .. "_2", ("\u{e4}"):rep(126), "a_b",
      "a_b_2", "a_b_3", "a_b_2_2", "hand 1", "backlight_2" }, list)
    oiiotool(layer("x.exr", list[3]) .. " -o y.exr")
    assert.truthy(oiiotool("--stats y.exr"):find "Stats Max: 1")
  end)

  it_reads("writes a row in a chunk where rows are wide, and a crop as a part", function()
    render(HEAD .. [[return still(30000, 4, {
      celspan.cel { box(10, 1, 20000, 2, "#fff") }:named "band",
      celspan.cel { box(5, 2, 7, 2, "#f008") } })]],
      "--depth float --layers cels -o x.exr")
    assert.truthy(oiiotool("--info -v x.exr"):find 'compression: "zips"')
    assert.is_true(sums "x.exr")
    render(SUMS, "--frames 1 --layers cels -o whole.exr")
    render(SUMS, "--frames 1 --layers cels --crop 30,10,40,33 -o part.exr")
    oiiotool "whole.exr --cut 40x33+30+10 part.exr --diff"
  end)

  it_reads("is read by celspan, layer by layer", function()
    render(SUMS, "--frames 1 --layers cels -o x.exr")
    local _, _, out = run "info x.exr"
    for _, name in ipairs(NAMES) do
      assert.truthy(out:find("layer " .. name .. " channels 4", 1, true), out)
    end
    render(HEAD .. [[return still(96, 64, {
      celspan.cel { celspan.image { file = "x.exr", layer = "hand_2" } } })]],
      "--depth half -o hand.exr")
    oiiotool(layer("x.exr", "hand_2") .. " hand.exr --diff")
  end)

  it_reads("is a different file for --resume", function()
    render(SUMS, "--layers cels --colour linear --resume -o 'x.#.exr'")
    local made = bench:read "x.1.exr"
    render(SUMS, "--resume -o 'x.#.exr'")
    assert.not_equal(made, bench:read "x.1.exr")
    local code, err = run "render film.lua --layers cels --resume --progress lines -o 'x.#.exr'"
    assert.equal(0, code, err)
    assert.is_nil(err:find "kept")
    assert.equal(made, bench:read "x.1.exr")
    code, err = run "render film.lua --layers cels --resume --progress lines -o 'x.#.exr'"
    assert.equal(0, code, err)
    assert.truthy(err:find "2 kept")
  end)

  it_reads("keeps no layers of cels that have other names now", function()
    local function ways(name)
      bench:write("film.lua", (SUMS:gsub('"wall"', ("%q"):format(name))))
      local code, err = run "render film.lua --layers cels --resume --progress lines -o 'x.#.exr'"
      assert.equal(0, code, err)
      return err:match "(%d) kept"
    end
    assert.is_nil(ways "wall")
    assert.equal("2", ways "wall")
    assert.is_nil(ways "brick")
    assert.equal("brick", names("x.1.exr")[2])
  end)

  it_reads("has the rate and the number that files without layers have", function()
    local function timing(file)
      local text = oiiotool("--info -v " .. file)
      return text:match "[Ff]ramesPerSecond: ([^\n]*)", text:match "celspan:frame: ([^\n]*)"
    end
    local rates = { ["24"] = "24/1", ["30000 / 1001"] = "30000/1001", ["12.5"] = "12500/1000" }
    for rate, words in pairs(rates) do
      local script = SUMS:gsub("frames = 2,", "frames = 2, fps = " .. rate .. ",")
      render(script, "--frames 2 --layers cels -o x.exr")
      render(script, "--frames 2 -o y.exr")
      local fps, number = timing "x.exr"
      assert.same({ timing "y.exr" }, { fps, number })
      assert.equal(words, fps:match "^%S+")
      assert.equal("2", number)
    end
  end)

  it_reads("says where a picture is that cannot be read, as without layers", function()
    render(HEAD .. "return still(40, 40, { celspan.cel { box(1, 1, 30, 30, '#f80') } })",
      "-o whole.png")
    bench:write("half.png", bench:read("whole.png"):sub(1, -30))
    bench:write("film.lua", HEAD .. [[return still(40, 40, { celspan.cel {}, celspan.cel {
      celspan.image { file = "half.png" } }:named "photo" })]])
    local code, err = run "render film.lua --progress none -o y.exr"
    local code_apart, err_apart = run "render film.lua --progress none --layers cels -o x.exr"
    assert.truthy(err:find("cel 2 'photo'", 1, true), err)
    assert.equal(err, err_apart)
    assert.equal(code, code_apart)
  end)

  it_reads("adds up where other exposures have no weight, or all", function()
    local function exposures(list)
      return HEAD .. ([[
        local a = celspan.rostrum { celspan.cel { box(0, 0, 4, 8, "#fff8") }:named "a" }
        local b = celspan.rostrum { celspan.cel { box(4, 0, 4, 8, "#fff8") }:named "b" }
        return celspan.film { size = { 8, 8 }, frame = function()
          return { %s } end }]]):format(list)
    end
    assert.equal("", render(exposures "{ a, 1 }, { b, 0 }", "--layers cels -o x.exr " .. EXACT))
    assert.same({ "a" }, names "x.exr")
    assert.equal("", render(exposures "{ a, 0 }, { b, 0 }", "--layers cels -o x.exr " .. EXACT))
    assert.truthy(render(exposures "{ a, 0.5 }, { b, 0 }", "--layers cels -o x.exr")
      :find "several exposures")
  end)

  it_reads("does not depend on the number of workers", function()
    for workers = 1, 3 do
      render(SUMS, ("--frames 1 --layers cels --workers %d -o w%d.exr"):format(workers, workers))
    end
    assert.equal(bench:read "w1.exr", bench:read "w2.exr")
    assert.equal(bench:read "w1.exr", bench:read "w3.exr")
  end)

  it("refuses a row of 2^31 bytes, whose size would have a sign", function()
    bench:write("film.lua", HEAD .. [[local cels = {}
      for i = 1, 127 do cels[i] = celspan.cel {}:named "n" end
      return still(1048576, 1, cels)]])
    local code, err = run "render film.lua --progress none --depth float --layers cels -o x.exr"
    assert.not_equal(0, code)
    assert.truthy(err:find("128 layers of 1048576 pixels are more than a row of OpenEXR can have",
      1, true), err)
    assert.is_nil(bench:read "x.exr")
  end)

  it("is refused where no layers can be written", function()
    local only = "it is only for files with layers (exr, openexr, png, ora, psd)"
    bench:write("film.lua", SUMS)
    refused("--layers cels -o 'x.#.tif'", only)
    refused("--layers cels -o x.mp4", only)
    refused("--layers cels --hash", only)
    refused("--layers cels --hash -o 'x.#.exr'", "exr with layers takes no --hash")
    refused("--layers cels --colour srgb -o 'x.#.exr'",
      "exr with layers takes --colour linear, and not srgb")
    refused("--layers cels --depth 8 -o 'x.#.exr'", "EXR files hold depth half, float, not 8")
    refused("--layers cels --strip 1/1 -o 'x.#.exr'", "exr with layers takes no --strip")
    refused("--layers parts -o 'x.#.exr'", "cels")
    bench:write("film.lua", HEAD .. [[local cels = {}
      for i = 1, 256 do cels[i] = celspan.cel {} end
      return still(8, 8, cels)]])
    local code, err = run "render film.lua --layers cels --progress none -o x.exr"
    assert.not_equal(0, code)
    assert.truthy(err:find("more than 255 cels", 1, true), err)
    assert.is_nil(bench:read "x.1.exr")
    assert.is_nil(bench:read "x.exr")
  end)
end)
