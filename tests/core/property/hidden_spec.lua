-- Stacks of pictures with alpha, gradients, faded groups and defocused cels: compared with the
-- oracle at pixel centres; and parts hidden behind opaque ones are neither read nor made.
--
-- CASE=n runs one random scene alone.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local rows = require "tests.support.rows"

local COUNT, ONLY = 50, cases.only
local WIDTH, HEIGHT = 300, 200
local SIZE = { WIDTH, HEIGHT }
local file, folder

--- A picture that is opaque in the middle and in a corner, translucent in places, clear elsewhere;
--- its parts are larger than its blocks.
local function draw(path)
  local cel = celspan.cel {
    celspan.rect { 60, 50, 200, 150, texture = celspan.linear { from = { 60, 0 }, to = { 260, 90 },
      { 0, "#c04020" }, { 1, "#2050e0" } } },
    celspan.rect { 0, 0, 70, 70, texture = "#20a060" },
    celspan.circle { centre = { 270, 40 }, radius = 40, texture = "#ffffff80" } }
  assert(celspan.render(celspan.rostrum { cel }, path, { size = SIZE }))
end

setup(function()
  folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
  file = folder .. "/parts.png"
  draw(file)
end)

teardown(function() os.execute("rm -rf " .. folder) end)

-- ---------------------------------------------------------------- random stacks

local function colour(random, alpha)
  return celspan.rgb(random:between(0, 1), random:between(0, 1), random:between(0, 1), alpha)
end

local function alpha(random) return random:pick { 1, 0.9, random:between(0, 1) } end

local function image(random)
  local placed = celspan.image { file = file, sampling = "bilinear",
    x = random:whole(-150, 150), y = random:whole(-100, 100) }
  if random:once(3) then placed = placed:scale(random:between(1, 2)) end
  if random:once(4) then placed = placed:rotate(random:between(-40, 40), 150, 100) end
  return placed
end

local function shape(random)
  local x, y = random:whole(-50, 200), random:whole(-50, 120)
  local texture = random:once(2) and colour(random, alpha(random))
    or celspan.linear { from = { x, y }, to = { x + 120, y + 80 },
                        { 0, colour(random, alpha(random)) }, { 1, colour(random, alpha(random)) } }
  return celspan.rect { x, y, random:whole(60, 250), random:whole(60, 200), texture = texture }
end

local function drawn(random)
  local object = random:once(2) and image(random) or shape(random)
  return random:once(4) and object:fade(random:between(0, 1)) or object
end

--- Two separate flat rectangles out of focus; `rims` receives the areas in which they differ from
--- the sharp ones.
local function soft(random, rims)
  local x, y, h = random:whole(-60, 100), random:whole(-60, 100), random:whole(80, 200)
  local radius, pair = random:pick { 2, 5, 12 }, {}
  local texture = colour(random, random:pick { 1, 1, 0.5 })
  for i = 1, 2 do
    local w = random:whole(60, 160)
    rims[#rims + 1] = { x, y, x + w, y + h, 2 * radius + 3 }
    pair[i] = celspan.rect { x, y, w, h, texture = texture }
    x = x + w + random:whole(20, 80)
  end
  pair.defocus = radius
  pair.opacity = random:pick { 1, 1, 0.8 }
  return celspan.cel(pair)
end

local function lit(random)
  return celspan.linear { from = { 0, 0 }, to = { WIDTH, 0 }, { 0, colour(random, 1) },
    { 1, "#fff" } }
end

local function cel(random, rims)
  local kind = random:whole(0, 8)
  if kind < 2 then return soft(random, rims) end
  if kind == 2 then
    return celspan.cel { (drawn(random) | drawn(random)):fade(random:between(0.3, 1)) }
  end
  if kind == 3 then return celspan.cel { drawn(random), drawn(random), front = lit(random) } end
  return celspan.cel { drawn(random), drawn(random), opacity = random:pick { 1, 1, 1, 0.9, 0.4 },
                       front = random:once(3) and { 0.8, 1, 0.7 } or nil }
end

local function stack(seed)
  local random, rims, cels = prng.new(seed), {}, {}
  for i = 1, random:whole(3, 12) do cels[i] = cel(random, rims) end
  cels.back = random:once(2) and { 0.3, 0.2, 0.1, 0.5 } or nil
  return celspan.rostrum(cels), random, rims
end

local function is_on_rim(rims, x, y)
  for _, r in ipairs(rims) do
    local near = x > r[1] - r[5] and x < r[3] + r[5] and y > r[2] - r[5] and y < r[4] + r[5]
    local inside = x > r[1] + r[5] and x < r[3] - r[5] and y > r[2] + r[5] and y < r[4] - r[5]
    if near and not inside then return true end
  end
  return false
end

local function spans(rostrum, fields)
  local options = { size = SIZE, film = SIZE, antialias = "none", workers = 1 }
  for name, value in pairs(fields or {}) do options[name] = value end
  return assert(celspan.spans(rostrum, options))
end

describe("a deep stack of pictures, gradients, groups and soft cels", function()
  it("agrees with the oracle at pixel centres", function()
    local compared = 0
    for _, case in cases.of(COUNT) do
      local rostrum, random, rims = stack(case)
      local list = spans(rostrum)
      for _ = 1, 300 do
        local x, y = random:whole(0, WIDTH - 1), random:whole(0, HEIGHT - 1)
        if not is_on_rim(rims, x, y) then
          compared = compared + 1
          local seen = rows.colour(list[y], x)
          local truth = { celspan.probe(rostrum, x + 0.5, y + 0.5, { film = SIZE }) }
          for c = 1, 4 do
            if math.abs(seen[c] - truth[c]) > 2 / 1023 then
              error(("CASE=%d: pixel %d, %d is %s, the oracle says %s"):format(
                case, x, y, table.concat(seen, " "), table.concat(truth, " ")))
            end
          end
        end
      end
    end
    assert.is_true(compared > 100 * (ONLY and 0 or cases.count(COUNT)))
  end)

  it("is the same with several workers, and for each row alone", function()
    for _, case in cases.of(COUNT // 5) do
      local rostrum, random = stack(case)
      local list = spans(rostrum)
      local again = spans(rostrum, { workers = 3 })
      assert.are.equal(rows.text(list, 0, HEIGHT - 1), rows.text(again, 0, HEIGHT - 1))
      for _ = 1, 3 do
        local y = random:whole(0, HEIGHT - 1)
        local alone = spans(rostrum, { crop = { 0, y, WIDTH, 1 } })
        assert.are.equal(rows.text(list, y, y), rows.text({ [y] = alone[0] }, y, y))
      end
    end
  end)
end)

-- ---------------------------------------------------------------- what is hidden

--- A picture of a file that does not exist, so that it cannot be read without a failure.
local function missing(x, y, w, h)
  return celspan.image { file = folder .. "/none.png", x = x, y = y, w = w, h = h }
end

--- Whether a rostrum renders completely under every kind of antialiasing.
local function is_made(...)
  for _, antialias in ipairs { "none", "area", { kernel = "gaussian" } } do
    local rostrum = celspan.rostrum { ... }
    local list, message = celspan.spans(rostrum,
      { size = SIZE, film = SIZE, antialias = antialias })
    if not list then
      assert.is_truthy(message:find("none.png", 1, true), message)
      return false
    end
  end
  return true
end

describe("a picture that cannot be read", function()
  -- Columns 128 to 191 and rows 64 to 127 of the picture are a block that is opaque.
  local behind = function() return celspan.cel { missing(140, 80, 40, 30) } end
  local beside = function() return celspan.cel { missing(20, 80, 160, 30) } end
  local function front(fields)
    table.insert(fields, celspan.image { file = file })
    return celspan.cel(fields)
  end

  it("is not read behind an opaque part of a picture with alpha", function()
    assert.is_true(is_made(behind(), front {}))
    assert.is_false(is_made(beside(), front {}))
  end)

  it("is not read if that is lit, or in a group lit by a shape", function()
    assert.is_true(is_made(behind(), front { front = { 0.5, 1, 0.5 } }))
    local light = celspan.linear { from = { 0, 0 }, to = { WIDTH, 0 }, { 0, "#fff" },
      { 1, "#f80" } }
    assert.is_true(is_made(behind(), front { front = light }))
    assert.is_false(is_made(beside(), front { front = light }))
  end)

  it("is not read behind several faded shapes that are opaque together", function()
    assert.is_true(is_made(behind(), front { opacity = 0.99 }, front { opacity = 0.999 }))
    assert.is_false(is_made(behind(), front { opacity = 0.99 }, front { opacity = 0.9 }))
    assert.is_false(is_made(beside(), front { opacity = 0.99 }, front { opacity = 0.999 }))
    local function faded(k) return celspan.cel { celspan.image { file = file }:fade(k) } end
    assert.is_true(is_made(behind(), faded(0.99), faded(0.999)))
    assert.is_false(is_made(behind(), faded(0.99), faded(0.9)))
  end)

  it("is not read inside a faded group behind an opaque part of the group", function()
    local function group(hidden)
      return celspan.cel { (hidden | celspan.image { file = file }):fade(0.5) }
    end
    assert.is_true(is_made(group(missing(140, 80, 40, 30))))
    assert.is_false(is_made(group(missing(20, 80, 160, 30))))
  end)

  it("is not read behind the core of a defocused cel", function()
    local function blurred(opacity)
      return celspan.cel { celspan.rect { 90, 40, 150, 120,
        texture = celspan.rgb(0.2, 0.5, 1, opacity) },
                           defocus = 8 }
    end
    assert.is_true(is_made(behind(), blurred(1)))
    assert.is_false(is_made(beside(), blurred(1)))
    assert.is_false(is_made(behind(), blurred(0.99)))
    -- With a gap among the columns in which the core ends.
    local apart = celspan.cel { celspan.rect { 50, 40, 100, 120, texture = "#345" },
                                celspan.rect { 210, 40, 60, 120, texture = "#345" }, defocus = 3 }
    assert.is_false(is_made(celspan.cel { missing(165, 80, 15, 20) }, apart))
    assert.is_true(is_made(celspan.cel { missing(110, 80, 15, 20) }, apart))
  end)
end)

describe("a defocused cel", function()
  --- Must not be made where it is hidden: its picture cannot be read.
  local function lost(radius) return celspan.cel { missing(140, 80, 40, 20), defocus = radius } end

  it("is not made behind an opaque part of a picture, nor behind another one", function()
    local ground = celspan.cel { celspan.rect { 90, 40, 150, 120, texture = "#345" }, defocus = 6 }
    assert.is_true(is_made(lost(3), celspan.cel { celspan.image { file = file } }))
    assert.is_true(is_made(lost(3), ground))
    assert.is_false(is_made(ground, lost(3)))
  end)
end)
