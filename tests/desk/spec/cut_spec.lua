-- Films made of films: which frames of which shots are seen, built and drawn, and where. One list
-- of cases, as long as the options of a cut and its transitions.
local celspan = require "celspan"
local cut = require "celspan.cut"
local workbench = require "tests.support.workbench"

local W, H = 16, 8

--- A shot whose frames are all of one colour, and which counts how often each is built.
local function shot(colour, frames, fields)
  local counts = { all = 0 }
  local film = { size = { W, H }, fps = 4, frames = frames, frame = function(f)
    counts[f.number], counts.all = (counts[f.number] or 0) + 1, counts.all + 1
    local art = type(colour) == "function" and colour(f) or
      celspan.rect { 0, 0, W, H, texture = colour }
    return celspan.rostrum { celspan.cel { art } }
  end }
  for name, value in pairs(fields or {}) do film[name] = value end
  return celspan.film(film), counts
end

--- A shot whose frames have their number as a grey.
local function numbered(frames, fields)
  return shot(function(f)
    local grey = f.number / 100
    return celspan.rect { 0, 0, W, H, texture = celspan.rgb(grey, grey, grey) }
  end, frames, fields)
end

local function pixels(film, number, size)
  return assert(celspan.pixels(film, { frame = number, size = size or { W, H } }))
end

local function colour(film, number, x, y)
  return table.pack(pixels(film, number):get(x or W // 2, y or H // 2))
end

local function is_near(wanted, found, where, most)
  for i = 1, #wanted do
    assert.is_true(math.abs(wanted[i] - found[i]) < (most or 1e-3),
      ("%s: value %d is %g, not %g"):format(where or "colour", i, found[i], wanted[i]))
  end
end

--- The numbers of the frames of numbered shots that the frames of a film show.
local function shown(film)
  local list = {}
  for number = film.first, film.first + film.frames - 1 do
    list[#list + 1] = math.floor(colour(film, number)[1] * 100 + 0.5)
  end
  return list
end

local function bytes(film, number) return pixels(film, number):bytes() end

local function fails(message, ...)
  local good, found = pcall(...)
  assert.is_false(good)
  assert.truthy(tostring(found):find(message, 1, true), found)
end

local red, green = { 1, 0, 0, 1 }, { 0, 1, 0, 1 }

describe("a cut", function()
  it("shows its shots one after another, in part or in whole", function()
    local a = numbered(4)
    local b = numbered(20, { first = 11 })
    local film = cut { a, { film = b, from = 13, to = 15 }, false, { film = a, from = 4 } }
    assert.are.same({ 1, 2, 3, 4, 13, 14, 15, 4 }, shown(film))
    assert.are.same({ W, H }, film.size)
    assert.are.equal(4, film.fps)
  end)

  it("plays shots at other speeds, whose frame is the floor", function()
    local a = numbered(6)
    assert.are.same({ 1, 3, 5 }, shown(cut { { film = a, speed = 2 } }))
    assert.are.same({ 1, 5 }, shown(cut { { film = a, speed = 4 } }))
    assert.are.same({ 1, 1, 2, 2, 3, 3 }, shown(cut { { film = a, to = 3, speed = 0.5 } }))
    assert.are.same({ 1, 2, 4, 5 }, shown(cut { { film = a, speed = 1.5 } }))
    local slow = shown(cut { { film = a, to = 2, speed = 0.1 } })
    assert.are.equal(20, #slow)
    assert.are.same({ 1, 2 }, { slow[10], slow[11] })
  end)

  it("has frames with the bytes of the shot's own, whose f is the shot's", function()
    local function noisy(f)
      return celspan.circle { centre = { W * f:random "x", H * f:random "y" }, radius = f.time + 1,
        texture = celspan.rgb(f.progress, f:random "r", 1 / f.count) }
    end
    local a, b = shot(noisy, 5, { title = "a" }), shot(noisy, 6, { title = "b", first = 3 })
    local film = cut { a, cut.dissolve(0.5), b }
    for number, other in pairs { [1] = { a, 1 }, [3] = { a, 3 }, [6] = { b, 5 }, [9] = { b, 8 } } do
      assert.are.equal(bytes(other[1], other[2]), bytes(film, number))
    end
  end)

  it("has the same digests whole and frame by frame, on any number of workers", function()
    local bench = workbench.new()
    bench:write("film.lua", [[
local celspan, cut = require "celspan", require "celspan.cut"
local function shot(colour)
  return celspan.film { size = { 32, 18 }, frames = 8, frame = function(f)
    return celspan.rostrum { back = colour, celspan.cel { celspan.circle {
      centre = { 3 * f.number, 9.3 }, radius = 4 + f:random "r", texture = "#f80c" } } }
  end }
end
return cut { shot "#123", cut.iris { softness = 0.3 }(0.1), shot "#642",
  cut.wipe { angle = 33 }(0.1),
  shot "#123", cut.dissolve(0.1), { film = shot "#9ab", to = 4, speed = 0.5 } }]])
    local code, whole = bench:celspan_inside "render film.lua --hash --workers 2 --progress none"
    assert.are.equal(0, code, whole)
    local list = {}
    for number in whole:gmatch "(%d+) %x+\n" do
      local _, alone = bench:celspan_inside("render film.lua --hash --progress none --frames %s",
        number)
      list[#list + 1] = alone
    end
    assert.are.equal(26, #list)
    assert.are.equal(whole, table.concat(list))
    bench:remove()
  end)

  it("can be a shot of another one", function()
    local a, b = numbered(4), numbered(20, { first = 11 })
    local inner = cut { { film = b, to = 12 }, a }
    assert.are.same({ 4, 12, 1, 2, 3 },
      shown(cut { { film = a, from = 4 }, { film = inner, from = 2, to = 5 } }))
  end)

  it("builds the frames that it shows, once each, and no others", function()
    local shots, counts, parts = {}, {}, {}
    for i = 1, 10 do
      shots[i], counts[i] = numbered(100)
      parts[#parts + 1] = { film = shots[i], from = 9 * i, to = 9 * i + 4 }
      if i < 10 then parts[#parts + 1] = cut.dissolve(0.25) end
    end
    local film = cut(parts)
    assert.are.equal(50 - 9, film.frames)
    pixels(film, 7)
    local built = 0
    for i = 1, 10 do built = built + counts[i].all end
    assert.are.equal(1, built)
    for number = 1, film.frames do film:at(number) end
    for i = 1, 10 do
      assert.are.equal(i == 2 and 6 or 5, counts[i].all)
      for number = 9 * i, 9 * i + 4 do assert.is_truthy(counts[i][number]) end
    end
  end)

  it("moves marks, and has the names of its parts", function()
    local a = numbered(8, { marks = { wave = 3, late = 8 } })
    local b = numbered(9, { first = 11, marks = { wave = 12, early = 11, ["end"] = 19 } })
    local film = cut { marks = { own = 2, late = 1 }, { film = a, to = 6, name = "one" },
      cut.wipe {}(0.5), { film = b, from = 12, speed = 2, name = "two" } }
    -- the second part shows 12, 14, 16, 18 of its film from frame 5 on, and never 19
    assert.are.same({ one = { 1, 6 }, two = { 5, 8 }, wave = 3, own = 2, late = 1 }, film.marks)
    local outer = cut { { film = film, from = 3, to = 6 }, film }
    assert.are.same({ two = { 3, 4 }, wave = 1, one = { 5, 10 }, own = 6, late = 5 }, outer.marks)
    local slow = cut { { film = film, speed = 0.5 } }
    assert.are.same({ 9, 16 }, slow.marks.two)
    assert.equal(8, cut.retime(film, { { 0, 8 }, { 2, 1 } }).frames)
  end)

  it("is refused where its parts do not fit", function()
    local a, b = numbered(8), numbered(4)
    fails("part 3: the shot has 4 frames, and its transitions need 5: give it more frames, or make "
      .. "part 4 shorter", cut, { a, cut.dissolve(0.5), b, cut.fade(0.75), a })
    fails("part 1: the shot has 8 frames, and its transitions need 4e+300: ", cut,
      { a, cut.dissolve(1e300), a })
    fails("part 3: the shot has 4 frames, and its transitions need 8: give it more frames, or make "
      .. "part 2 shorter", cut, { a, cut.dissolve(2), b })
    fails("part 3: is a transition after a transition", function()
      return cut { a, cut.dissolve(1), cut.dissolve(1), b }
    end)
    fails("cut: needs at least one film", cut, { cut.dissolve(1) })
    fails("part 2: its fps is 5, and that of the first film 4: film:with { fps = 4 }", cut,
      { a, a:with { fps = 5 } })
    fails("part 2: its size is 9x9, and that of the first film 16x8", cut,
      { a, a:with { size = { 9, 9 } } })
    fails("part 1: field 'from' must be a frame of the film, 1 to 8, got 9", cut,
      { { film = a, from = 9 } })
    fails("part 1: 'from' is 5, which is after 'to', 2", cut, { { film = a, from = 5, to = 2 } })
    fails("part 1: field 'speed' must be 0.01..100, got -1", cut, { { film = a, speed = -1 } })
    fails("part 1: unknown field 'form'; did you mean 'from'?", cut, { { film = a, form = 1 } })
    fails("part 1: field 'film' must be a film, got nil", cut, { { from = 1 } })
    fails("part 1: must be a film, { film = ... } or a transition, got string", cut, { "a" })
    fails("part 2: has the name of part 1, \"x\"", cut,
      { { film = a, name = "x" }, { film = b, name = "x" } })
    fails("mark \"2nd\": a name has 1 to 255 bytes, begins with a letter", cut,
      { { film = a, name = "2nd" } })
    fails("dissolve takes seconds, a number above 0, got 0", cut.dissolve, 0)
    fails("wipe: field 'softness' must be 0..1, got 2", cut.wipe, { softness = 2 })
    fails("push: field 'from' must be \"right\", \"left\", \"top\" or \"bottom\", got \"up\"",
      cut.push, { from = "up" })
    fails("iris: centre[2] must be a number, got nil", cut.iris, { centre = { 1 } })
    fails("fade: the colour: ", cut.fade, 1, "blu")
    fails("with takes a function(a, b, u), got nil", cut.with)
    fails("cut: part 1: its film is the field 'film': { film = ..., from = ... }", cut,
      { { a, from = 2 } })
    fails("celspan.cut has no 'disolve'; did you mean 'dissolve'?", function()
      return cut.disolve(1)
    end)
  end)
end)

describe("a transition", function()
  local a, b = shot("#ff0000", 8), shot("#00ff00", 8)

  --- The frames of a transition of four between red and green.
  local function between(transition) return cut { a, transition(1), b } end

  it("takes its length from both shots, and shows each of its frames in the middle", function()
    local film = between(cut.dissolve)
    assert.are.equal(12, film.frames)
    is_near(red, colour(film, 4))
    for k = 0, 3 do
      local u = (k + 0.5) / 4
      is_near({ 1 - u, u, 0, 1 }, colour(film, 5 + k), "frame " .. 5 + k)
    end
    is_near(green, colour(film, 9))
    assert.are.equal(15, cut({ a, cut.dissolve(0.01), b }).frames)
  end)

  it("is made of each pair of exposures", function()
    local double = celspan.film { size = { W, H }, fps = 4, frames = 8, frame = function()
      local function plain(texture)
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, W, H, texture = texture } } }
      end
      return { { plain "#ff0000", 0.25 }, { plain "#0000ff", 0.75 } }
    end }
    local ways = {
      cut.dissolve,
      function(seconds)
        return cut.with(function(one, other, u)
          return { { one, 1 - u }, { other, u } }
        end)(seconds)
      end,
    }
    for _, way in ipairs(ways) do
      local film = cut { double, way(1), b }
      is_near({ 0.25 * 0.625, 0.375, 0.75 * 0.625, 1 }, colour(film, 6))
      film = cut { b, way(1), double }
      is_near({ 0.25 * 0.375, 0.625, 0.75 * 0.375, 1 }, colour(film, 6))
    end
  end)

  --- A code as light.
  local function coded(code)
    return code <= 0.04045 and code / 12.92 or ((code + 0.055) / 1.055) ^ 2.4
  end

  it("fades to a colour and from it, evenly to the eye, and shows it alone", function()
    local film, half = cut { a, cut.fade(1, "#0000ff"), b }, coded(0.5)
    is_near({ half, 0, half, 1 }, colour(film, 5))
    is_near({ 0, 0, 1, 1 }, colour(film, 6))
    is_near({ 0, 0, 1, 1 }, colour(film, 7))
    is_near({ 0, half, half, 1 }, colour(film, 8))
    local odd = cut { a, cut.fade(0.75, "#0000ff"), b }
    is_near({ coded(1 / 3), 0, coded(2 / 3), 1 }, colour(odd, 6))
    is_near({ 0, 0, 1, 1 }, colour(odd, 7))
    is_near({ 0, 0, 0, 1 }, colour(cut { a, cut.fade(1), b }, 6))
  end)

  it("fades by even steps of codes to every colour, in both working spaces", function()
    for _, space in ipairs { "linear", "srgb" } do
      for to, name in pairs { [0] = "#000", [1] = "#fff", [0.8] = "#cccccc" } do
        local grey = shot("#808080", 16, { space = space })
        local film = cut { grey, cut.fade(2, name) }
        for i = 1, 8 do
          local code = 128 / 255 + i / 8 * (to - 128 / 255)
          local found = pixels(film, 8 + i):get(8, 4)
          is_near({ coded(code) }, { found }, ("%s, %s, frame %d"):format(space, name, 8 + i))
        end
      end
    end
  end)

  it("fades in and out at the ends", function()
    local film, share = cut { cut.fade(1), a, cut.fade(1, "#fff") }, 0.75
    assert.are.equal(8, film.frames)
    is_near({ 0, 0, 0, 1 }, colour(film, 1))
    is_near({ coded(share), 0, 0, 1 }, colour(film, 4))
    is_near({ 1, coded(1 - share), coded(1 - share), 1 }, colour(film, 5))
    is_near({ 1, 1, 1, 1 }, colour(film, 8))
    is_near({ 0, 0, 0, 0.125 }, { 0, 0, 0, colour(cut { cut.dissolve(1), a }, 1)[4] })
  end)

  it("refuses a weight and an ease that are no use, wherever they come from", function()
    for weight, number in pairs { [-1] = "-1", [math.huge] = "inf", [-math.huge] = "-inf" } do
      local own = cut.with(function(one, other) return { { one, 1 }, { other, weight } } end)
      fails("cut: exposure 2: its weight must be a finite number of 0 or more, got " .. number,
        colour, cut { a, own(1), b }, 6)
    end
    local function of(result) return cut { a, cut.with(function() return result end)(1), b } end
    fails("weight must be a finite number of 0 or more, got nan", colour,
      of { { celspan.rostrum {}, 0 / 0 } }, 6)
    local wanted = " must be a rostrum, an object, a cel or a list of them, got "
    fails("rostrum: size is missing", colour, of { celspan.rostrum {} }, 6)
    fails("cut: what a transition shows" .. wanted .. "nil", colour, of(nil), 6)
    fails("shows: exposure 1" .. wanted .. "number", colour, of { { 5, 1 } }, 6)
    local negative = celspan.film { size = { W, H }, fps = 4, frames = 8,
      frame = function() return { { celspan.rostrum {}, -1 } } end }
    fails("got -1", colour, cut { a, cut.dissolve(1), negative }, 6)
    for wrong, kind in pairs { [math.huge] = "inf", [-math.huge] = "-inf", x = "string" } do
      for _, way in ipairs { cut.dissolve, cut.push {}, cut.wipe { softness = 0.3 } } do
        fails("its ease must return a finite number, but at 0.375 it returned " .. kind,
          colour, cut { a, way(1, function() return wrong end), b }, 6)
      end
    end
    fails("cut: fade: its ease must return a finite number, but at 0.375 it returned nan",
      colour, cut { a, cut.fade(1, "#fff", function() return 0 / 0 end), b }, 6)
  end)

  it("names the shot whose frame fails", function()
    local empty = celspan.film { size = { W, H }, fps = 4, frames = 3, frame = function() end }
    local film = cut { a, { film = empty, name = "gone 100%" } }
    fails("frame 1 of 'gone 100%': the frame function's result must be a rostrum", colour, film, 9)
  end)

  it("has an ease", function()
    is_near({ 1 - 0.375 ^ 2, 0.375 ^ 2, 0, 1 }, colour(between(function(seconds)
      return cut.dissolve(seconds, "inQuad")
    end), 6))
    is_near(red, colour(between(function(seconds) return cut.wipe {}(seconds, "hold") end), 8, 0))
    is_near({ 0, 1, 0, 1 }, colour(between(function(seconds)
      return cut.wipe {}(seconds, function() return 2 end)
    end), 5))
    fails('cut: dissolve: ease: there is no curve "inQaud"', cut.dissolve, 1, "inQaud")
  end)

  it("wipes with an edge that moves in any direction", function()
    local film = between(cut.wipe {})
    is_near(green, colour(film, 6, 5))
    is_near(red, colour(film, 6, 6))
    is_near(green, colour(between(cut.wipe { angle = 180 }), 6, 10))
    is_near(red, colour(between(cut.wipe { angle = 180 }), 6, 9))
    is_near(green, colour(between(cut.wipe { angle = 90 }), 6, 8, 2))
    is_near(red, colour(between(cut.wipe { angle = 90 }), 6, 8, 3))
    local sum = 0 -- of an edge that crosses pixels: the exact areas of both shots
    local image = pixels(between(cut.wipe { angle = 30 }), 7)
    for y = 0, H - 1 do
      for x = 0, W - 1 do
        local r, g, _, alpha = image:get(x, y)
        assert.is_true(math.abs(r + g - 1) < 1e-3 and math.abs(alpha - 1) < 1e-3)
        sum = sum + g
      end
    end
    assert.is_true(sum > 0.5 * W * H and sum < 0.8 * W * H, sum)
  end)

  it("wipes and opens with a soft edge", function()
    local film = between(cut.wipe { softness = 0.5 })
    for x = 0, W - 1 do -- the edge lies from 1 to 9
      local share = math.max(0, math.min(1, (9 - (x + 0.5)) / 8))
      is_near({ 1 - share, share, 0, 1 }, colour(film, 6, x), "x " .. x, 2e-3)
    end
    film = between(cut.iris { softness = 0.5, centre = { 0, 0 } })
    local far = math.sqrt(W * W + H * H)
    for x = 0, W - 1 do
      local radius = math.sqrt((x + 0.5) ^ 2 + 0.25)
      local share = math.max(0, math.min(1, (0.375 * 1.5 * far - radius) / (0.5 * far)))
      is_near({ 1 - share, share, 0, 1 }, colour(film, 6, x, 0), "x " .. x, 2e-2)
    end
    is_near({ 1, 0, 0, 1 }, colour(between(cut.iris { softness = 1 }), 5, 0, 0), "corner", 2e-3)
  end)

  it("opens an iris", function()
    local film = between(cut.iris {})
    is_near(green, colour(film, 6, 8, 4))
    is_near(red, colour(film, 6, 0, 0))
    film = between(cut.iris { centre = { 0, 0 } })
    is_near(green, colour(film, 5, 0, 0))
    is_near(red, colour(film, 8, 15, 7))
  end)

  it("pushes one shot out by the other", function()
    local half = shot(function() return celspan.rect { 0, 0, W / 2, H, texture = "#0000ff" } end, 8)
    local film = cut { half, cut.push {}(1), b }
    is_near({ 0, 0, 1, 1 }, colour(film, 6, 1))
    is_near({ 0, 0, 0, 0 }, colour(film, 6, 2))
    is_near(green, colour(film, 6, 10))
    is_near({ 0, 0, 0, 0 }, colour(film, 6, 9))
    is_near(green, colour(cut { half, cut.push { from = "left" }(1), b }, 6, 5))
    is_near(green, colour(cut { half, cut.push { from = "top" }(1), b }, 6, 8, 2))
    is_near({ 0, 0, 0, 0 }, colour(cut { half, cut.push { from = "bottom" }(1), b }, 6, 9, 4))
  end)

  it("keeps the clear parts of its shots clear", function()
    local hole = shot(function() return celspan.rect { 0, 0, 4, H, texture = "#ffffff" } end, 8)
    for _, transition in ipairs { cut.dissolve, cut.wipe {}, cut.wipe { softness = 0.3 },
                                  cut.iris {}, cut.iris { softness = 0.3 } } do
      for number = 5, 8 do
        is_near({ 0, 0, 0, 0 }, colour(cut { hole, transition(1), hole }, number, 10))
      end
    end
    for _, transition in ipairs { cut.dissolve, cut.wipe { angle = 45 }, cut.iris {} } do
      is_near({ 1, 1, 1, 1 }, colour(cut { hole, transition(1), hole }, 6, 2))
    end
    local empty = shot(function() return celspan.union {} end, 8)
    for _, transition in ipairs { cut.wipe { softness = 0.5 }, cut.iris { softness = 0.5 } } do
      local r, _, _, alpha = pixels(cut { a, transition(1), empty }, 6):get(4, 4)
      assert.is_true(alpha > 0.01 and alpha < 0.99)
      assert.near(alpha, r, 1e-6)
    end
  end)

  it("keeps the antialiasing of each shot", function()
    local function diagonal(antialias)
      return celspan.film { size = { W, H }, fps = 4, frames = 8, frame = function()
        return celspan.rostrum { antialias = antialias, back = "#000",
          celspan.cel { celspan.polygon { { 0, 0 }, { W, 0 }, { 0, H }, texture = "#fff" } } }
      end }
    end
    local film = cut { diagonal "none", cut.push {}(1), diagonal "area" }
    for x = 0, 9 do
      local value = colour(film, 6, x, 3)[1]
      assert.is_true(value == 0 or value == 1, value)
    end
    local soft = 0
    for x = 10, 15 do
      local value = colour(film, 6, x, 7)[1]
      soft = soft + (value > 0.01 and value < 0.99 and 1 or 0)
    end
    assert.is_true(soft > 0)
  end)

  it("has the space of its shots", function()
    local veil = function() return celspan.rect { 0, 0, W, H, texture = "#00000080" } end
    local one = shot(veil, 8, { space = "srgb" })
    for _, film in ipairs { cut { one }, cut.retime(one, { { 0, 1 }, { 2, 8 } }) } do
      assert.are.equal("srgb", film.space)
      assert.are.equal(bytes(one, 1), bytes(film, 1))
    end
    fails('cut: part 2: its space is "linear", and that of the first film "srgb": '
      .. 'film:with { space = "srgb" }', cut, { one, a })
  end)

  it("has one exposure for a background to lie behind", function()
    local bench = workbench.new()
    local script = bench:write("wipes.lua", [[
local celspan, cut = require "celspan", require "celspan.cut"
local function shot(colour)
  return celspan.film { size = { 16, 8 }, fps = 4, frames = 8, frame = function()
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 16, 8, texture = colour } } }
  end }
end
local a, b = shot "#880000", shot "#008800"
return cut { a, cut.wipe { softness = 0.4 }(1), b, cut.iris {}(1), a, cut.push {}(1), b }
]])
    for _, options in ipairs { "", "--background '#fff'" } do
      assert.are.same({ 0, "", "" }, { bench:celspan("render %s -o %s/%s.#.png --progress none %s",
        script, bench.folder, options == "" and "plain" or "ground", options) })
    end
    for number = 1, 20 do
      local code, out = bench:celspan("compare %s/plain.%d.png %s/ground.%d.png", bench.folder,
        number, bench.folder, number)
      assert.are.equal(0, code, out)
      assert.truthy(out:find "pixels_differing 0", out)
    end
    bench:remove()
  end)

  it("has cels over it, in every frame alike", function()
    local plate = celspan.cel { celspan.rect { 4, 2, 8, 4, texture = "#0000ff80" } }
    local film = cut { a, cut.wipe { softness = 0.4 }(1), b, cut.dissolve(1), a, cut.fade(1), b,
      over = function(f) return f.number ~= 2 and { plate } or nil end }
    is_near(red, colour(film, 2))
    for number = 1, film.frames do
      local _, _, blue, alpha = table.unpack(colour(film, number))
      if number ~= 2 then is_near({ 0.50196 }, { blue }, "frame " .. number) end
      is_near({ 1 }, { alpha })
    end
    local one = cut { a, over = function() return plate end }
    is_near({ 0.498, 0, 0.502, 1 }, colour(one, 1))
    fails("cut: field 'over' must be a function", cut, { a, over = plate })
    local twice = celspan.film { size = { W, H }, fps = 4, frames = 8, frame = function()
      return { { celspan.rostrum {}, 1 }, { celspan.rostrum {}, 1 } }
    end }
    fails("cut: over: frame 1 is exposed with a weight of 2 in all; it must be 1", pixels,
      cut { twice, over = function() return plate end }, 1)
  end)

  it("may be one's own", function()
    local sizes = {}
    local film = cut { a, cut.with(function(one, other, u)
      sizes[#sizes + 1] = one.size
      return celspan.rostrum { celspan.cel { one }, celspan.cel { other:scale(u, 1) } }
    end)(1), b }
    is_near(green, colour(film, 6, 5))
    is_near(red, colour(film, 6, 6))
    assert.are.same({ W, H }, sizes[1])
  end)
end)

describe("a film at other times", function()
  it("is held, reversed and eased", function()
    local a = numbered(12, { marks = { three = 3, nine = 9 } })
    local film = cut.retime(a, { { 0, 1 }, { 1, 5 }, { 1.5, 5 }, { 2.5, 1 } })
    assert.are.same({ 1, 2, 3, 4, 5, 5, 5, 4, 3, 2 }, shown(film))
    assert.are.same({ three = 3 }, film.marks)
    assert.are.same({ 1, 3, 5, 7, 9, 11 }, shown(cut.retime(a, { { 0, 1 }, { 1.5, 13 } })))
    assert.are.same({ 1, 1, 2, 4 }, shown(cut.retime(a, { { 0, 1 }, { 1, 7, "inQuad" } })))
  end)

  it("loops", function()
    local a = numbered(12)
    local loop = { { 0, 2 }, { 0.75, 5 }, loop = "repeat" }
    assert.are.same({ 2, 3, 4, 2, 3, 4, 2, 3 }, shown(cut.retime(a, loop, 2)))
    loop.loop = "mirror"
    assert.are.same({ 2, 3, 4, 5, 4, 3, 2, 3 }, shown(cut.retime(a, loop, 2)))
    local track = require "celspan.keys" { { 0, 3 }, { 0.5, 5 }, loop = "repeat" }
    assert.are.same({ 3, 4, 3, 4 }, shown(cut.retime(a, track, 1)))
  end)

  it("has its sound where it goes forwards", function()
    local a = numbered(12, { sound = "voice.wav" })
    local film = cut.retime(a, { { 0, 1 }, { 0.5, 5 }, { 1, 5 }, { 2, 1 }, { 3, 5, "inQuad" },
      { 4, 9 } })
    local found = {}
    for i, sound in ipairs(film.sound) do
      found[i] = { sound.at, sound.from, sound.to, sound.speed }
    end
    assert.are.same({ { 0, 0, 1, 2 }, { 3, 1, 2, 1 } }, found)
    film = cut.retime(a, { { 0, 1 }, { 1, 5 }, loop = "mirror" }, 4)
    assert.are.same({ 0, 2 }, { film.sound[1].at, film.sound[2].at })
  end)

  it("is refused without a duration or with frames that are not there", function()
    local a = numbered(12)
    fails("retime: key 2 must be a frame of the film, 1 to 13, got 14", cut.retime, a,
      { { 0, 1 }, { 1, 14 } })
    fails("retime: keys with a loop need a duration, cut.retime(film, keys, 10)", cut.retime, a,
      { { 0, 1 }, { 1, 4 }, loop = "repeat" })
    fails("retime: the duration must be above 0 seconds, got 0", cut.retime, a, { { 0, 1 } })
    fails("retime takes a film, got table", cut.retime, {}, {})
  end)
end)

describe("captions", function()
  local bench
  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  local said = { { from = 0, to = 2, text = "a" }, { from = 1, to = 2.5, text = "b" } }
  local function rounded(list)
    local texts = {}
    for i, one in ipairs(list or {}) do
      texts[i] = ("%.3f %.3f %s"):format(one.from, one.to, one.text)
    end
    return table.concat(texts, ", ")
  end

  it("move with their shots, are cut with them, and come before those of the cut", function()
    local film, black = (shot("#fff", 12, { captions = said, first = 10 })), (shot("#000", 4))
    local whole = cut { black, { film = film, from = 16, to = 19 },
      cut.dissolve(0.5), { film = film, speed = 2 },
      captions = { { from = 0, to = 9, text = "c" } } }
    assert.equal("1.000 1.500 a, 1.000 2.000 b, 1.500 2.500 a, 2.000 2.750 b, 0.000 9.000 c",
      rounded(whole.captions))
    assert.equal(2, #said)
    assert.is_nil(cut { black }.captions)
    assert.equal("none.srt", cut { black, captions = "none.srt" }.captions)
    fails("field 'captions' must be the name of a file", cut, { film, captions = 7 })
    fails("cut: captions: ", cut, { film, captions = "none.srt" })
    fails("caption 1 must be", cut, { (shot("#fff", 4, { captions = { 7 } })) })
  end)

  it("of other times are shown where the film goes forwards evenly", function()
    local film = (shot("#fff", 12, { captions = said }))
    local slow = cut.retime(film, { { 0, 1 }, { 2, 5 }, { 3, 5 }, { 5, 13 } })
    assert.equal("0.000 2.000 a, 3.000 4.000 a, 3.000 4.500 b", rounded(slow.captions))
    assert.is_nil(cut.retime(film, { { 0, 9 }, { 2, 1 } }).captions)
    assert.is_nil(cut.retime((shot("#fff", 12)), { { 0, 1 }, { 2, 9 } }).captions)
  end)

  it("are read from files of the shots' scripts", function()
    bench:write("said.srt", "1\n00:00:00,500 --> 00:00:01,000\nhello\n")
    bench:write("film.lua", [[
local celspan, cut = require "celspan", require "celspan.cut"
local shot = celspan.film { size = { 8, 8 }, fps = 4, frames = 4, captions = "said.srt",
  frame = function() return celspan.rostrum {} end }
local list = cut { shot, shot, captions = "said.srt" }.captions
for _, one in ipairs(list) do print(one.from, one.to, one.text) end
return shot]])
    local code, out, err = bench:celspan_inside "check film.lua"
    assert.equal(0, code, err)
    assert.truthy((out .. err):find("0.5\t1.0\thello\n1.5\t2.0\thello\n0.5\t1.0\thello", 1, true),
      out .. err)
  end)
end)

describe("a mark", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, fps = 4, frames = 12, marks = { title = 1, chase = 5,
  ["the end"] = 11 }, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, f.number / 2, 8 } } } end }]])
  end)
  after_each(function() bench:remove() end)

  --- The frames that a verb takes.
  local function frames(list)
    local code, out, err = bench:celspan_inside("render film.lua --hash --frames '%s'", list)
    assert.are.equal(0, code, err)
    return (out:gsub(" %x+\n", " "):gsub(" $", ""))
  end

  it("names frames for every verb that takes some", function()
    assert.are.equal("1 2 3 4", frames "title")
    assert.are.equal("5 7 9", frames "chase:2")
    assert.are.equal("11 12 1", frames "the end, 1")
    assert.are.equal("5 6 7 8", frames "1s-2s")
    for command, pattern in pairs {
      ["check film.lua --frames chase"] = "6 frames checked",
      ["sheet film.lua --frames chase"] = "5",
      ["contact film.lua --frames title -o sheet.png"] = "",
      ["farm film.lua --slurm -o a.####.png --frames chase --chunk 3"] = "6 frames of film",
    } do
      local code, out, err = bench:celspan_inside(command)
      assert.are.equal(0, code, err)
      assert.truthy((out .. err):find(pattern), out .. err)
    end
    local film = dofile(bench.folder .. "/film.lua")
    assert(celspan.render(film, bench.folder .. "/out.#.png", { frames = "the end" }))
    assert.is_truthy(bench:read "out.11.png")
    assert.is_truthy(bench:read "out.12.png")
    assert.are.same({ title = 1, chase = 5, ["the end"] = 11 }, film.marks)
  end)

  it("is in the figures of its film", function()
    local _, out = bench:celspan_inside "info film.lua"
    assert.truthy(out:find("\nmark 1 title\nmark 5 chase\nmark 11 the end\n", 1, true), out)
  end)

  it("is refused if no mark has that name, or if its frame is not in the film", function()
    local code, _, err = bench:celspan_inside "render film.lua --hash --frames titel"
    assert.are.equal(2, code)
    assert.truthy(err:find('frames "titel": the film has no mark "titel"; its marks are title, '
      .. "chase, the end", 1, true), err)
    code, _, err = bench:celspan_inside "render film.lua --hash --frames 2s-4s"
    assert.are.equal(2, code)
    assert.truthy(err:find("frame 13 is outside the film", 1, true), err)
    local function film(marks)
      return celspan.film { frames = 12, marks = marks, frame = function() end }
    end
    fails('mark "late" must be a frame of the film, 1 to 12, got 13', film, { late = 13 })
    fails('mark "late" must be a frame of the film, 1 to 12, got 1.5', film, { late = 1.5 })
    fails('mark "late" must be a frame of the film, 1 to 12, got string', film, { late = "1" })
    fails("marks must be { title = 1, chase = 49 }, got number as a name", film, { 1 })
    fails("field 'marks' must be a table { title = 1, chase = 49 }, got number", film, 1)
    for _, name in ipairs { "", "a,b", "a:b", "-a", "7a", " a", "a ", "a\nb", ("x"):rep(256) } do
      fails("a name has 1 to 255 bytes, begins with a letter", film, { [name] = 1 })
    end
  end)
end)
