-- Films as Lottie animations: how they look when celspan.lottie reads them again and in players,
-- how few keys they have, and what is refused.
local celspan = require "celspan"
local json = require "celspan.json"
local lottie = require "celspan.lottie"
local players = require "tests.support.players"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local MODULES = "out/npm/node_modules"
local CODES = 8 -- how far a pixel may be in each channel

local bench = workbench.new()
teardown(function() bench:remove() end)

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 160, 90 }, fps = 24, frames = %d, space = %q, title = 'a "film"',
  frame = function(f)
    local i, t = f.number - 1, (f.number - 1) / math.max(f.count - 1, 1)
    %s
  end }
]]

--- Writes a film, of whose frames the code returns the cels. Returns its path.
local function film(count, space, code)
  return bench:write("film.lua", FILM:format(count, space, code))
end

--- Renders the film; returns the path, what was said, and the document.
local function out(name, options)
  local path = bench.folder .. "/" .. name
  local code, said, err = bench:celspan("render '%s/film.lua' -o '%s' --progress none %s",
    bench.folder, path, options or "")
  assert(code == 0, said .. err)
  return path, err, name:find "json$" and assert(json.read(path))
end

local function own_pixels(number)
  return assert(celspan.pixels(dofile(bench.folder .. "/film.lua"), { frame = number })):bytes()
end

local function share(path, number)
  local art = assert(lottie.read(path)):film()
  return players.share(own_pixels(number),
    assert(celspan.pixels(art, { frame = number - 1 })):bytes(), CODES, true)
end

local function is_film(path, count, least)
  for number = 1, count do
    local found = share(path, number)
    assert.is_true(found >= (least or 0.99), ("frame %d: %.4f"):format(number, found))
  end
end

--- The layers of a document by their names.
local function by_name(document)
  local list = {}
  for _, layer in ipairs(document.layers) do list[layer.nm] = layer end
  return list
end

local function keys_of(property) return property.a == 1 and #property.k or 0 end

describe("a film as Lottie", function()
  it("moves, turns, scales, mirrors and fades layers by keys", function()
    film(20, "srgb", [[
      local box = celspan.rect { -10, -10, 20, 20, texture = "#c03010" }
      local bar = celspan.rect { -20, -3, 40, 6, texture = "#1030c0" }
      return celspan.rostrum { back = "#eeddcc", celspan.cel {
        box:translate(20 + 100 * t, 20):named "slides",
        bar:rotate(300 * t):translate(40, 60):named "turns",
        (box | bar):scale(1 - 2 * t, 1):translate(110, 60):named "flips",
        box:fade(1 - t):translate(140, 20):named 'fades "away"' } }]])
    local path, said, document = out "moves.json"
    local layers = by_name(document)
    assert.equal("", said)
    assert.same({ 2, 0, 0 }, { keys_of(layers.slides.ks.p), keys_of(layers.slides.ks.r),
      keys_of(layers.slides.ks.s) })
    assert.same({ 0, 2 }, { keys_of(layers.turns.ks.p), keys_of(layers.turns.ks.r) })
    assert.same({ 0, 2 }, { keys_of(layers.flips.ks.r), keys_of(layers.flips.ks.s) })
    assert.equal(2, keys_of(layers['fades "away"'].ks.o))
    assert.same({ t = 19, s = { 120, 20 } }, layers.slides.ks.p.k[2]) -- without handles
    assert.same({ 0, 20, 160, 90, 24, 'a "film"' }, { document.ip, document.op, document.w,
      document.h, document.fr, document.nm })
    is_film(path, 20)
  end)

  it("has keys where a motion leaves a line by more than a twentieth of a unit", function()
    film(96, "srgb", [[
      return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 20, 20, texture = "#803020" }
        :translate(120 * t, 40 + 30 * math.sin(3 * t)):named "wave" } }]])
    local _, _, document = out "wave.json"
    local list, at = by_name(document).wave.ks.p.k, 1
    assert.is_true(#list > 4 and #list < 40, ("%d keys"):format(#list))
    -- The anchor is the middle of the square, or its corner.
    local start = list[1].s[1]
    for i = 0, 95 do
      if list[at + 1] and list[at + 1].t <= i then at = at + 1 end
      local a, b = list[at], list[at + 1] or list[at]
      local u = b.t > a.t and (i - a.t) / (b.t - a.t) or 0
      local x, y = a.s[1] + u * (b.s[1] - a.s[1]), a.s[2] + u * (b.s[2] - a.s[2])
      local off = math.max(math.abs(x - start - 120 * i / 95),
        math.abs(y - start - 40 - 30 * math.sin(3 * i / 95)))
      assert.is_true(off < 0.05, ("frame %d: %.4f"):format(i, off))
    end
  end)

  it("holds drawings as long as the film does", function()
    film(12, "srgb", [[
      local size = 10 + 5 * (i // 3 % 2)
      return celspan.rostrum { celspan.cel { celspan.rect { 20, 20, size, 40, texture = "#803020" }
        :named "drawing" } }]])
    local path, _, document = out "held.json"
    assert.equal(2, #document.layers) -- two drawings, each shown twice
    assert.same({ { 0, 100 }, { 3, 0 }, { 6, 100 } }, (function()
      local list = {}
      for k, key in ipairs(document.layers[2].ks.o.k) do
        assert.equal(1, key.h)
        list[k] = { key.t, key.s[1] }
      end
      return list
    end)())
    is_film(path, 12)
  end)

  it("shows strokes, holes, gradients, skewed shapes, groups and lights", function()
    film(6, "srgb", [[
      local round = celspan.radial { centre = { 0, 0 }, radius = 15, focus = { 5, 0 },
        { 0, "#ffffff" }, { 1, "#20a05080" } }
      local along = celspan.linear { from = { 0, 0 }, to = { 30, 10 }, { 0, "#ff0000" },
        { 0.4, "#ffff00" }, { 1, "#0000ff00" } }
      local pair = celspan.group { opacity = 1 - t / 2,
        celspan.rect { 0, 0, 20, 20, texture = "#f00" },
        celspan.rect { 10, 10, 20, 20, texture = "#00f" } }
      return celspan.rostrum { back = "#d0d0d0", celspan.cel {
          celspan.polygon { { 0, 0 }, { 20, 20 }, { 40, 0 } }:stroke { width = 5 }
            :translate(5, 5 + i),
          celspan.path { d = "M0 0H30V30H0ZM10 10H20V20H10Z", rule = "evenodd" }:translate(60, 5),
          celspan.circle { centre = { 0, 0 }, radius = 15, texture = round }:scale(2, 1)
            :rotate(20 + i):translate(120, 25),
          celspan.rect { 0, 0, 30, 20, texture = along }:skew(20, 0):translate(10 + 2 * i, 60),
          pair:translate(70, 50) },
        celspan.cel { front = { 0.5, 4, 1 - t },
          celspan.rect { 120, 55, 30, 30, texture = "#808080" } } }]])
    local path, said, document = out "all.json"
    assert.equal("", said)
    assert.equal(1, #document.assets) -- the group that fades as a whole
    is_film(path, 6, 0.985)
  end)

  it("goes into an archive, deflated", function()
    film(3, "srgb", [[local list = {}
      for k = 1, 50 do
        list[k] = celspan.circle { centre = { 3 * k, 20 + i * k }, radius = k / 5 }
      end
      return celspan.rostrum { celspan.cel(list) }]])
    local path = out "film.lottie"
    is_film(path, 3)
    local size, plain = #bench:read "film.lottie", #bench:read(out "film.json":match "[^/]*$")
    assert.is_true(size < plain / 5, ("%d bytes of %d"):format(size, plain))
    if present.program "python3" then
      local _, said = bench:inside "python3 -m zipfile -t film.lottie"
      assert.equal("Done testing\n", said)
    end
  end)

  it("has areas where players would mix other colours", function()
    film(3, "linear", [[return celspan.rostrum { back = "#204060",
      celspan.cel { celspan.rect { 10, 10, 60, 60, texture = "#f0e0c0" } },
      celspan.cel { celspan.rect { 40, 30 + i, 60, 50, texture = "#ff2000" }:fade(0.5) },
      celspan.cel { celspan.rect { 120, 30 + i, 20, 20, texture = "#ffffff" }:named "above" } }]])
    local path, said, document = out "mixed.json"
    assert.matches("3 frames from frame 1 on, in part as areas: cel 2: light that is mixed", said)
    for _, layer in ipairs(document.layers) do
      for _, key in ipairs(layer.ks.o.a == 1 and layer.ks.o.k or {}) do
        assert.is_true(key.s[1] == 0 or key.s[1] == 100)
      end
    end
    assert.equal(2, keys_of(by_name(document).above.ks.p))
    is_film(path, 3)
  end)

  it("has areas that stay once, and shows them in their frames", function()
    film(8, "linear", [[
      local sun = celspan.star { centre = { 30, 30 }, points = 20, outer = 20, inner = 18,
        texture = "#f0c020" }
      return celspan.rostrum { back = "#204060",
        celspan.cel { sun, celspan.star { centre = { 120, 60 }, points = 20, outer = 20,
          inner = 18 + i % 2, texture = "#c0e0f0" } },
        celspan.cel { celspan.rect { 70, 5 + 5 * i, 20, 20, texture = "#ff2000" }:fade(0.5) } }]])
    local path, _, document = out "shared.json"
    local counts = {}
    for _, layer in ipairs(document.layers) do
      for _, group in ipairs(layer.nm == "areas" and layer.shapes or {}) do
        local red = group.it[#group.it - 1].c.k[1]
        counts[red] = counts[red] or {}
        table.insert(counts[red], keys_of(layer.ks.o))
      end
    end
    assert.same({ 0 }, counts[0.94118]) -- the star that stays
    assert.same({ 7, 7 }, counts[0.75294]) -- two that take turns
    is_film(path, 8, 0.97) -- edges are mixed in codes
  end)

  it("fades over nothing in any space", function()
    film(3, "linear", [[return celspan.rostrum {
      celspan.cel { celspan.rect { 10, 10, 60, 60, texture = "#f0e0c0" }:fade(1 - t / 2) } }]])
    local path, said = out "nothing.json"
    assert.equal("", said)
    is_film(path, 3)
  end)

  it("has pictures of what has no outline", function()
    film(3, "srgb", [[return celspan.rostrum { back = "#ffffff",
      celspan.cel { defocus = 4, celspan.rect { 10, 10, 60, 60, texture = "#402010" } },
      celspan.cel { celspan.rect { 80, 30 + i, 20, 20, texture = "#ff0000" } } }]])
    bench:write("blurred.json.picture.png", "of the user")
    local path, said, document = out "blurred.json"
    assert.equal("of the user", bench:read "blurred.json.picture.png")
    assert.equal("2\n", (select(2, bench:inside "ls -A | grep -c ^[.]*blurred")))
    assert.matches("3 frames from frame 1 on, in part as a picture %(.+%): cel 1: a blur", said)
    assert.equal(1, #document.assets) -- the same in all frames
    assert.matches("^data:image/png;base64,", document.assets[1].p)
    is_film(path, 3)
    is_film(out "blurred.lottie", 3)
    -- Pictures are packed already, and stand in the archive as they are.
    assert.matches("\137PNG\r\n\26\n", bench:read "blurred.lottie", 1, true)
    assert.same({ 320, 180 }, (function(asset) return { asset.w, asset.h } end)(
      select(3, out("large.json", "--scale 2")).assets[1]))
  end)

  it("has the marks, and says that the sound is missing", function()
    bench:write("film.lua", [[local celspan = require "celspan"
      return celspan.film { size = { 16, 9 }, frames = 9, marks = { go = 4 },
        frame = function() return celspan.rostrum {} end }]])
    local _, _, document = out("marks.json", "--frames 3-6")
    assert.same({ { tm = 1, cm = "go", dr = 0 } }, document.markers)
    assert.same({ 4, {} }, { document.op, document.layers })
  end)

  it("keeps the places of radial gradients, and of their focuses", function()
    film(2, "srgb", [[
      local function ball(x, focus)
        return celspan.circle { centre = { x, 45 }, radius = 30, texture = celspan.radial {
          centre = { x, 45 }, radius = 30, focus = focus, { 0, "#ffffff" }, { 1, "#203060" } } }
      end
      return celspan.rostrum { back = "#eeddcc",
        celspan.cel { ball(35), ball(115, { 125, 35 }) } }]])
    is_film(out "balls.json", 2)
  end)

  it("keeps art in small and in large units apart, and exact", function()
    film(4, "srgb", [[
      local along = celspan.linear { from = { 0.0025, 0 }, to = { 0.0075, 0 },
        { 0, "#000000" }, { 1, "#ffffff" } }
      return celspan.rostrum { back = "#eeddcc", celspan.cel {
        celspan.rect { 0, 0, 1e-5, 1e-5 }:scale(1e6):translate(10, 10 + i),
        celspan.rect { 0, 0, 4e-5, 4e-5 }:scale(1e6):translate(30, 10 + i),
        celspan.rect { 4e6, 2e6, 3e6, 3e6, texture = "#a02020" }:scale(1.53e-5)
          :translate(30, i),
        celspan.rect { 0, 0, .01, .01, texture = along }:scale(5000)
          :translate(20, 55 - i / 2) } }]])
    is_film(out "units.json", 4)
  end)

  it("keeps the opacity of cels, also of those that blink", function()
    film(6, "srgb", [[local dot = celspan.circle { centre = { 110, 45 }, radius = 20 }
      return celspan.rostrum { back = "#ffffff",
        celspan.cel { opacity = 0.5, celspan.rect { 10, 10, 40, 40 } },
        celspan.cel { opacity = i % 2, dot } }]])
    is_film(out "opacity.json", 6)
  end)

  it("writes names with quotes, and says when there are many layers", function()
    film(2, "srgb", [[
      local list = {}
      for k = 1, 1001 do
        list[k] = celspan.rect { 0, 0, 2, 2 }:translate(k % 50 + i * (k % 7), k // 50)
          :named(k == 1 and 'it\'s "one" \\' or "n" .. k)
      end
      return celspan.rostrum { celspan.cel(list) }]])
    local _, said, document = out "many.json"
    assert.matches("many.json: 1001 layers, more than many players draw smoothly: put", said)
    assert.equal('it\'s "one" \\', document.layers[1001].nm)
  end)

  it("is one layer where a square of 64 moves, whatever its place rounds to", function()
    film(24, "srgb", [[local x = 2005 + 1.1 * i
      return celspan.rostrum { celspan.cel { celspan.polygon { { x, 10 }, { x + 64, 10 },
        { x + 64, 50 }, { x, 50 }, texture = "#c03010" }:translate(-2000, 0) } }]])
    local path, said, document = out "square.json"
    assert.equal("", said)
    assert.equal(1, #document.layers)
    is_film(path, 24)
  end)

  it("leans a layer that is turned and then scaled by unequal factors", function()
    film(24, "srgb", [[local star = celspan.star { centre = { 0, 0 }, points = 5, outer = 40,
        inner = 18, texture = "#c03010" }
      return celspan.rostrum { celspan.cel { (i == 3 and star:scale(0) or star):rotate(15 * i)
        :scale(0.5 + t, i > 20 and -0.8 or 0.8):translate(80, 45):named "star" } }]])
    local path, said, document = out "leans.json"
    assert.same({ "", 1 }, { said, #document.layers })
    assert.is_true(keys_of(document.layers[1].ks.sk) > 10)
    is_film(path, 24)
  end)

  it("has one layer and one picture of an image that only moves", function()
    film(12, "srgb", [[local photo = celspan.image { x = 0, y = 0, w = 32, h = 16,
        size = { 2, 1 }, pixels = "\xff\x20\x10\xff\x20\x40\xc0\x80", sampling = "nearest" }
      return celspan.rostrum { back = "#d0e0d0",
        celspan.cel { celspan.rect { 60, 0, 30, 90, texture = "#103010" },
          photo:translate(8 * i, 10):named "photo" },
        celspan.cel { celspan.group { photo:scale(1, 1 + t), celspan.rect { 4, 4, 8, 60 } }
          :translate(4 * i, 40) } }]])
    local path, said, document = out "photo.json"
    local layers = by_name(document)
    assert.equal("", said)
    assert.same({ 5, 2, 2 }, { #document.layers, #document.assets, layers.photo.ty })
    assert.same({ 32, 16 }, { document.assets[1].w, document.assets[1].h })
    assert.same({ 2, 0 }, { keys_of(layers.photo.ks.p), keys_of(layers.photo.ks.s) })
    is_film(path, 12)
    is_film(out "photo.lottie", 12)
  end)

  it("has an image in its frames where players would mix other colours", function()
    local code = [[return celspan.rostrum { back = "#ffffff", celspan.cel { front = %s,
      celspan.image { x = 0, y = 0, w = 32, h = 16, size = { 1, 1 }, pixels = "\xff\x20\x10%s" }
        :translate(8 * i, 10) } }]]
    film(2, "linear", code:format("{ 1, 1, 1 }", "\\x80"))
    assert.matches("cel 1: light that is mixed", select(2, out "clear.json"))
    film(2, "linear", code:format("{ 0.5, 0.5, 0.5 }", "\\xff"))
    assert.matches("cel 1: a picture in another light than white", select(2, out "lit.json"))
    film(2, "linear", code:format("{ 1, 1, 1 }", "\\xff"))
    local path, said = out "opaque.json"
    assert.equal("", said)
    is_film(path, 2)
  end)

  it("has areas of an outline of more curves than a layer may have", function()
    local code = [[return celspan.rostrum { celspan.cel { celspan.path {
      d = "M0 0" .. ("l1 1 0 1"):rep(%d) .. "z" } } }]]
    film(1, "srgb", code:format(99000))
    local _, said = out "curves.json"
    assert.equal("", said)
    film(1, "srgb", code:format(100001))
    _, said = out "curves.json"
    assert.matches("in part as areas: cel 1: an outline of too many curves", said)
  end)

  it("leaves out what is empty, and appears and disappears", function()
    film(8, "srgb", [[local dot = celspan.circle { centre = { 80, 45 }, radius = 10 * (i % 2) }
      local box = i > 2 and i ~= 5 and celspan.rect { 5, 5, 20, 20 }
      return celspan.rostrum { celspan.cel { box, dot } }]])
    is_film(out "gaps.json", 8)
  end)
end)

describe("Lottie is refused", function()
  local function refused(words, pattern)
    local code, _, err = bench:celspan("render '%s/film.lua' %s", bench.folder, words)
    assert.not_equal(0, code)
    assert.matches(pattern, err)
  end

  it("for options of pixels, numbers in names, and films without end", function()
    film(1000000, "srgb", "return celspan.rostrum {}")
    local name = "'" .. bench.folder .. "/no.json' "
    refused("-o " .. name .. "--size 20x20", "json takes no %-%-size")
    refused("-o " .. name .. "--hash", "takes no %-%-hash")
    refused("-o '" .. bench.folder .. "/no.####.lottie'", "leave the frame's number out of its")
    refused("-o " .. name, "1000000 frames; a Lottie file of at most 100000 is written")
    assert.is_nil(bench:read "no.json")
  end)

  it("for pictures that no player holds", function()
    film(1, "srgb", [[return celspan.rostrum { celspan.cel { defocus = 4,
      celspan.rect { 10, 10, 60, 60 } } }]])
    refused("-o '" .. bench.folder .. "/no.json' --scale 1000",
      "no.json: pictures of 160000 x 90000 pixels; the limit is 16384: give a smaller %-%-scale")
    assert.is_nil(bench:read "no.json")
  end)
end)

describe("Lottie in other players", function()
  for _, player in ipairs { "skottie", "thorvg" } do
    local is_there = present.program "node" and players.are_in(MODULES);
    (is_there and it or pending)("looks the same in " .. player, function()
      film(10, "srgb", [[
        local round = celspan.radial { centre = { 0, 0 }, radius = 15,
          { 0, "#ffffff" }, { 1, "#20a050" } }
        return celspan.rostrum { back = "#eeddcc", celspan.cel {
          celspan.rect { -10, -10, 20, 20, texture = "#c03010" }:rotate(200 * t)
            :translate(20 + 100 * t, 40),
          celspan.circle { centre = { 0, 0 }, radius = 15, texture = round }:scale(2, 1)
            :rotate(20 + i):translate(110, 25),
          celspan.rect { 10, 60, 20 + 10 * (i // 3), 20, texture = "#000000" },
          celspan.rect { 90, 60, 40, 20, texture = "#0030a0" }:fade(1 - t) } }]])
      local frames = { 0, 3, 6, 9 }
      local shown = assert(players.draw(players.command(MODULES, player), out "players.json",
        bench.folder .. "/" .. player, { 160, 90 }, frames))
      for i, frame in ipairs(frames) do
        local found = players.share(own_pixels(frame + 1), shown[i], CODES)
        assert.is_true(found >= 0.97, ("frame %d: %.4f"):format(frame, found))
      end
    end)
  end
end)

describe("Areas of gradients in other players", function()
  for _, player in ipairs { "skottie", "thorvg" } do
    local is_there = present.program "node" and players.are_in(MODULES);
    (is_there and it or pending)("have no seams in " .. player, function()
      film(1, "linear", [[
        local function dark(x, y, radius)
          return celspan.radial { centre = { x, y }, radius = radius, { 0, "#302010" },
            { 1, "#100804" } }
        end
        return celspan.rostrum { back = "#201008",
          celspan.cel { celspan.rect { -10, -10, 200, 200, texture = dark(80, 45, 100) },
            celspan.circle { centre = { 0, 0 }, radius = 30, texture = dark(0, 0, 30) }
              :scale(1.5, 1):translate(70, 45) },
          celspan.cel { celspan.rect { 0, 0, 5, 5, texture = "#000000" }:fade(0.5) } }]])
      local path, said = out "seams.json"
      assert.matches("areas", said)
      local shown = assert(players.draw(players.command(MODULES, player), path,
        bench.folder .. "/seams", { 160, 90 }, { 0 }))[1]
      local most = 0
      for i = 1, #shown, 4 do most = math.max(most, shown:byte(i)) end
      assert.is_true(most <= 0x38, ("the canvas, which is white, shines through: %d"):format(most))
    end)
  end
end)

describe("Lottie by its schema", function()
  local VALIDATOR = MODULES .. "/.bin/lottie-specs"
  local it_checks = present.program "node" and system.exists(VALIDATOR) and it or pending

  --- What the schema says against a file, as JSON.
  local function faults(path)
    local pipe = assert(io.popen(("node %s -q '%s' 2>&1"):format(VALIDATOR, path)))
    local text = pipe:read "a"
    pipe:close()
    return (text:gsub("%s+$", ""))
  end

  it_checks("has keys, gradients, groups, areas and pictures", function()
    film(6, "srgb", [[
      local round = celspan.radial { centre = { 0, 0 }, radius = 15, focus = { 5, 0 },
        { 0, "#ffffff" }, { 1, "#20a05080" } }
      local pair = celspan.group { opacity = 1 - t / 2, celspan.rect { 0, 0, 20, 20 },
        celspan.rect { 10, 10, 20, 20, texture = celspan.linear { from = { 10, 0 },
          to = { 30, 0 }, { 0, "#f00" }, { 1, "#0000ff80" } } } }
      return celspan.rostrum { back = "#d0d0d0",
        celspan.cel { blend = i < 3 and "multiply" or nil, defocus = i > 4 and 3 or 0,
          celspan.rect { 5, 60 + i, 50, 20, texture = "#d08020" } },
        celspan.cel { celspan.circle { centre = { 0, 0 }, radius = 15, texture = round }
            :scale(2, 1 + t):rotate(20 + 40 * t):translate(120, 25 + i * i),
          pair:translate(70, 50 + i // 2) } }]])
    local path, said = out "schema.json"
    assert.matches("areas", said)
    assert.matches("a picture", said)
    assert.equal("[]", faults(path))
    local document = assert(json.read(path))
    document.layers[1].ks.p = { a = 0 }
    assert.matches('"error"', faults(bench:write("broken.json", json.encode(document))))
  end)
end)
