-- celspan.spec: each assertion passes and fails when it should, so does its negation, and its
-- message is enough to find the fault.
local celspan = require "celspan"
require "celspan.spec"
local system = require "tests.support.system"

local folder

local film = celspan.film { size = { 64, 32 }, frames = 8, first = 1, frame = function(f)
  local ball = celspan.cel { celspan.rect { 8 * f:on(2), 8, 8, 8,
    texture = "#ff8800" } }:named "ball"
  local ground = celspan.cel { celspan.rect { 0, 0, 64, 32, texture = "#204060" } }:named "ground"
  local hidden = celspan.cel { celspan.rect { 0, 0, 10, 10, texture = "#fff" } }:named "hidden"
  local ghost = celspan.cel { celspan.rect { 0, 0, 64, 32, texture = "#fff" },
    opacity = 0 }:named "ghost"
  local slope = celspan.cel { celspan.rect { 0, 28, 64, 4,
    texture = celspan.linear { from = { 0, 0 },
    to = { 64, 0 }, { 0, "#000" }, { 1, "#fff" } } } }:named "slope"
  return celspan.rostrum { hidden, ground, ball, ghost, slope }
end }

--- The message of an assertion that must fail.
local function message_of(call)
  local passed, message = pcall(call)
  if passed then error("it passed, and it should have failed", 2) end
  return tostring(message)
end

--- The message contains all of these texts.
local function told(message, ...)
  for _, part in ipairs { ... } do
    if not message:find(part, 1, true) then
      error(("%q does not say %q"):format(message, part), 2)
    end
  end
end

--- What a failure writes next to a picture.
local function beside(path, what) return (path:gsub("%.png$", "." .. what .. ".png")) end

setup(function()
  folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
end)

teardown(function() os.execute("rm -r " .. folder) end)

describe("looks_like", function()
  local picture
  local count = 0

  before_each(function()
    count = count + 1 -- a picture is cached once it is read: each test uses its own
    picture = ("%s/one%d.png"):format(folder, count)
    assert(celspan.pixels(film, { frame = 1 }):write(picture))
  end)

  it("passes for the picture of the frame, and leaves no files", function()
    assert.frame(film, 1).looks_like(picture)
    assert.frame(film, 2).looks_like(picture) -- on twos
    assert.is_false(system.exists(beside(picture, "actual")))
  end)

  it("fails for another frame, and says where it differs and how to accept it", function()
    local message = message_of(function() assert.frame(film, 3).looks_like(picture) end)
    told(message, "frame 3 does not look like " .. picture, "128 of 2048 pixels differ", "channel",
      beside(picture, "difference"),
      ("mv %s %s"):format(beside(picture, "actual"), picture))
    local accepted = folder .. "/accepted.png"
    assert(os.rename(beside(picture, "actual"), accepted))
    assert(os.rename(beside(picture, "difference"), beside(accepted, "difference")))
    assert.frame(film, 3).looks_like(accepted)
    assert.is_false(system.exists(beside(accepted, "difference")))
  end)

  it("makes a picture with the differences in red and the rest in grey", function()
    message_of(function() assert.frame(film, 3).looks_like(picture) end)
    local shown = celspan.rostrum { antialias = "none",
      celspan.cel { celspan.image { file = beside(picture, "difference"), x = 0, y = 0 } } }
    local r, g = celspan.probe(shown, 4.5, 10.5, { film = { 64, 32 } })
    assert.is_true(r > 3 * g)
    local grey_r, grey_g, grey_b = celspan.probe(shown, 50.5, 20.5, { film = { 64, 32 } })
    assert.is_true(grey_r == grey_g and grey_g == grey_b)
  end)

  it("accepts a tolerance, and without one a difference of one 8-bit code", function()
    local function still(colour)
      return celspan.rostrum { size = { 4, 4 },
        celspan.cel { celspan.rect { 0, 0, 4, 4, texture = colour } } }
    end
    picture = folder .. "/still.png"
    assert(celspan.pixels(still "#808080", { size = { 4, 4 } }):write(picture))
    assert.frame(still "#818080", 1).looks_like(picture)
    told(message_of(function() assert.frame(still "#828080", 1).looks_like(picture) end),
      "16 of 16 pixels", "most by 2 codes", "channel r")
    assert.frame(still "#8a8080", 1).looks_like(picture, { tolerance = 10 / 255 })
    message_of(function()
      assert.frame(still "#8b8080", 1).looks_like(picture, { tolerance = 10 / 255 })
    end)
  end)

  it("is negated", function()
    assert.frame(film, 3).is_not.looks_like(picture)
    assert.is_not.frame(film, 3).looks_like(picture)
    told(message_of(function() assert.frame(film, 1).is_not.looks_like(picture) end),
      "frame 1 looks like " .. picture .. ", and it should not")
    message_of(function() assert.is_not.frame(film, 1).looks_like(picture) end)
  end)

  it("fails both ways if there is no picture yet, and makes one to accept", function()
    local missing = folder .. "/it's new.png"
    for _, claim in ipairs { function() assert.frame(film, 1).looks_like(missing) end,
                             function() assert.frame(film, 1).is_not.looks_like(missing) end } do
      local message = message_of(claim)
      told(message, "there is no " .. missing .. " yet",
        "mv '" .. folder .. "/it'\\''s new.actual.png' ")
    end
    assert(os.execute(message_of(function() assert.frame(film, 1).looks_like(missing) end)
      :match "to accept it +(mv [^\n]+)"))
    assert.frame(film, 1).looks_like(missing)
  end)

  it("writes nothing if it passes, also negated", function()
    assert.frame(film, 3).is_not.looks_like(picture)
    assert.is_false(system.exists(beside(picture, "actual"))
      or system.exists(beside(picture, "difference")))
  end)

  it("fails for a picture of the same width and another height", function()
    local flat = folder .. "/flat.png"
    assert(celspan.pixels(film, { size = { 64, 16 } }):write(flat))
    told(message_of(function() assert.frame(film, 1).looks_like(flat) end),
      "it is 64 x 32 pixels, the picture is 64 x 16")
  end)

  it("fails for a picture of another size", function()
    local small = folder .. "/small.png"
    assert(celspan.pixels(film, { size = { 32, 16 } }):write(small))
    told(message_of(function() assert.frame(film, 1).looks_like(small) end),
      "it is 64 x 32 pixels, the picture is 32 x 16", "mv ")
    assert.frame(film, 1).is_not.looks_like(small)
  end)

  it("fails for a file that is not a picture", function()
    local broken = folder .. "/broken.png"
    local file = assert(io.open(broken, "wb"))
    file:write "nothing"
    file:close()
    told(message_of(function() assert.frame(film, 1).looks_like(broken) end), "broken.png")
  end)
end)

describe("shows", function()
  it("passes for the colour of the point, and fails for another with both", function()
    assert.point(film, 3, 20, 10).shows "#ff8800"
    assert.point(film, 3, 4, 10).shows(celspan.rgb "#204060")
    told(message_of(function() assert.point(film, 3, 20, 10).shows "#204060" end),
      "frame 3 shows #ff8800 at 20, 10, not #204060", "they differ by ")
  end)

  it("accepts a tolerance", function()
    assert.point(film, 3, 20, 10).shows("#f58800", 10 / 255)
    message_of(function() assert.point(film, 3, 20, 10).shows("#f48800", 10 / 255) end)
    message_of(function() assert.point(film, 3, 20, 10).shows "#fd8800" end)
    assert.point(film, 3, 20, 10).shows "#fe8800"
  end)

  it("is negated", function()
    assert.point(film, 3, 4, 10).is_not.shows "#ff8800"
    told(message_of(function() assert.point(film, 3, 20, 10).is_not.shows "#ff8800" end),
      "frame 3 shows #ff8800 at 20, 10, and it should not")
  end)

  it("recognises clear and translucent points", function()
    local bare = celspan.rostrum { size = { 10, 10 }, celspan.cel { celspan.rect { 5, 0, 5, 10,
      texture = "#ff880080" } } }
    assert.point(bare, 1, 2, 5).shows(celspan.clear)
    assert.point(bare, 1, 7, 5).shows "#ff880080"
    told(message_of(function() assert.point(bare, 1, 2, 5).shows "#000" end), "not #000000")
    message_of(function() assert.point(bare, 1, 7, 5).shows "#ff8800" end)
  end)
end)

it("shows accepts, with a tolerance, a faint colour as clear", function()
  local faint = celspan.rostrum { size = { 4, 4 },
    celspan.cel { celspan.rect { 0, 0, 4, 4, texture = "#ff000004" } } }
  assert.point(faint, 1, 2, 2).shows(celspan.clear, 0.05)
  assert.point(faint, 1, 2, 2).is_not.shows(celspan.clear)
end)

describe("is_visible", function()
  it("passes if the frame would be different without the cel", function()
    assert.cel(film, 1, "ball").is_visible()
    assert.cel(film, 1, "ground").is_visible()
    told(message_of(function() assert.cel(film, 1, "hidden").is_visible() end),
      'cel "hidden" is not visible in frame 1')
    told(message_of(function() assert.cel(film, 1, "ghost").is_visible() end), '"ghost"')
  end)

  it("is negated", function()
    assert.cel(film, 1, "hidden").is_not_visible()
    assert.cel(film, 1, "ghost").is_not.visible()
    told(message_of(function() assert.cel(film, 1, "ball").is_not.visible() end),
      'cel "ball" is visible in frame 1, and it should not be')
  end)

  it("fails both ways for a name that no cel has, and suggests the nearest", function()
    for _, claim in ipairs { function() assert.cel(film, 1, "bal").is_visible() end,
                             function() assert.cel(film, 1, "bal").is_not.visible() end } do
      told(message_of(claim), 'frame 1 has no cel named "bal"; did you mean "ball"?')
    end
  end)
end)

describe("covers", function()
  it("passes for the share of the frame that the cel covers, or less", function()
    assert.cel(film, 1, "ball").covers(64 / 2048)
    assert.cel(film, 1, "ball").covers(0.01)
    assert.cel(film, 1, "ground").covers(1)
    told(message_of(function() assert.cel(film, 1, "ball").covers(0.04) end),
      'cel "ball" covers 0.03125 of frame 1, not 0.04 of it or more')
  end)

  it("is negated", function()
    assert.cel(film, 1, "ball").is_not.covers(0.04)
    assert.cel(film, 1, "ghost").is_not.covers(0.001)
    told(message_of(function() assert.cel(film, 1, "ball").is_not.covers(0.03) end),
      "covers 0.03125 of frame 1, and it should cover less than 0.03")
  end)
end)

it(
  "a cel covers the area of its art, not of back lights, and exposures count by "
  .. "their weights", function()
  local function square(name, x)
    return celspan.cel { celspan.rect { x, 0, 4, 4, texture = "#fff" },
      back = { 1, 1, 1, 1 } }:named(name)
  end
  local bench = celspan.rostrum { back = "#fff", square("left", 0), square("right", 4) }
  local double = celspan.film { size = { 8, 8 }, frame = function()
    return { { bench, 1 }, { celspan.rostrum { square("ghost", 2), square("other", 0) }, 0 } }
  end }
  assert.cel(double, 1, "left").covers(0.25)
  assert.cel(double, 1, "left").is_not.covers(0.26)
  assert.cel(double, 1, "ghost").is_not.visible()
  message_of(function() assert.cel(double, 1, "ghost").is_visible() end)
end)

describe("look_alike", function()
  it("passes for frames that look the same", function()
    assert.frames(film, 1, 2).look_alike()
    told(message_of(function() assert.frames(film, 1, 2, 3).look_alike() end),
      "frames 1 and 3 do not look alike: 128 of 2048 pixels differ")
  end)

  it("is negated", function()
    assert.frames(film, 2, 3).is_not.look_alike()
    told(message_of(function() assert.frames(film, 1, 2).is_not.look_alike() end),
      "frames 1, 2 look alike, and they should not")
  end)
end)

describe("holds", function()
  it("passes for the spans of the row", function()
    assert.row(film, 3, 10).holds { single = 3, gradient = 0, array = 0 }
    assert.row(film, 3, 30).holds { gradient = 1 }
    told(message_of(function() assert.row(film, 3, 10).holds { single = 2 } end),
      "row 10 of frame 3 holds spans { single = 3, gradient = 0, array = 0 }, not { single = 2 }")
  end)

  it("is negated", function()
    assert.row(film, 3, 10).is_not.holds { single = 2 }
    told(message_of(function() assert.row(film, 3, 10).is_not.holds { single = 3 } end),
      "holds spans { single = 3, gradient = 0, array = 0 }, and it should not")
  end)
end)

it("holds compares each of its counts", function()
  told(message_of(function()
    assert.row(film, 3, 10).holds { single = 2, gradient = 0, array = 0 }
  end), "single = 3")
  told(message_of(function()
    assert.row(film, 3, 10).holds { single = 3, gradient = 1, array = 0 }
  end), "gradient = 0")
  assert.row(film, 3, 10).is_not.holds { single = 2, array = 0 }
end)

describe("an assertion's argument", function()
  it("is checked at the line of the spec", function()
    for expected, call in pairs {
      ["frame takes a film first, got number"] = function()
        assert.frame(3, 1).looks_like "x.png"
      end,
      ["frame: frame 9: the film has frames 1 to 8"] = function()
        assert.frame(film, 9).looks_like "x.png"
      end,
      ["frame takes the number of a frame, got nil"] = function()
        assert.frame(film).looks_like "x.png"
      end,
      ["point: x must be a finite number, got nil"] = function()
        assert.point(film, 1).shows "#fff"
      end,
      ["cel takes the name of a cel third, got nil"] = function()
        assert.cel(film, 1).is_visible()
      end,
      ["frames takes a film and two frames or more"] = function()
        assert.frames(film, 1).look_alike()
      end,
      ["row: y must be a whole number from 0 to 31, got 32"] = function()
        assert.row(film, 1, 32).holds {}
      end,
      ["looks_like takes the name of a picture, got nil"] = function()
        assert.frame(film, 1).looks_like()
      end,
      ["unknown field 'tolerence'; did you mean 'tolerance'?"] = function()
        assert.frame(film, 1).looks_like("x.png", { tolerence = 1 })
      end,
      ["looks_like: tolerance must be a number from 0 to 1, got 2"] = function()
        assert.frame(film, 1).looks_like("x.png", { tolerance = 2 })
      end,
      ["shows takes a colour or a paint, got \"blueish\""] = function()
        assert.point(film, 1, 1, 1).shows "blueish"
      end,
      ["covers takes a share of the frame, a number from 0 to 1, got nil"] = function()
        assert.cel(film, 1, "ball").covers()
      end,
      ["holds takes counts of spans"] = function() assert.row(film, 1, 1).holds {} end,
      ["shows applies to a point: assert.point(film, n, x, y).shows(...)"] = function()
        assert.frame(film, 1).shows "#fff"
      end,
    } do
      local message = message_of(call)
      told(message, expected, "assertions_spec.lua:")
    end
  end)

  it("cannot end in a word that passes for any argument", function()
    local namespace = require "luassert.namespaces"
    for _, word in ipairs { "looks_like", "shows", "visible", "covers", "look_alike", "holds" } do
      assert.is_nil(namespace.modifier[word], word)
    end
    assert.has_error(function() assert.frame(film, 1).looks_lik "x.png" end)
  end)

  it("may be a rostrum", function()
    assert.point(film:at(3), 1, 20, 10).shows "#ff8800"
  end)
end)
