-- The same scene gives the same bits: with any number of workers, in any order of rows, in crops,
-- in any order of frames, and when rendered again.
--
-- Strips and rows on demand are tested from C: tests/core/unit/test_render.c.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local rows = require "tests.support.rows"
local scenes = require "tests.support.scenes"

local COUNT, ONLY = 50, cases.only

--- Calls test(exposures, options, random, case) with random scenes.
local function each_scene(test)
  for _, case in cases.of(COUNT) do
    local script, traits = scenes.script(case, { has_shifts = true })
    if ONLY then print(script) end
    local film = scenes.load(script)
    local options = { size = traits.size, film = { traits.width, traits.height }, workers = 1 }
    test(film:at(1), options, prng.new(case), case)
  end
end

local function with(options, fields)
  local copy = {}
  for name, value in pairs(options) do copy[name] = value end
  for name, value in pairs(fields) do copy[name] = value end
  return copy
end

local function spans(exposures, options) return assert(celspan.spans(exposures, options)) end

local function text(exposures, options)
  local height = (options.crop or { 0, 0, options.size[1], options.size[2] })[4]
  return rows.text(spans(exposures, options), 0, height - 1)
end

--- Float pixels as text, to the bit.
local function pixels(exposures, options)
  local image, words = assert(celspan.pixels(exposures, options)), {}
  for y = 0, image.height - 1 do
    for x = 0, image.width - 1 do words[#words + 1] = ("%a %a %a %a"):format(image:get(x, y)) end
  end
  return table.concat(words, "\n")
end

--- A part of the frame, which may reach beyond each of its sides.
local function random_crop(random, size)
  local x, y = random:whole(-6, size[1] - 1), random:whole(-6, size[2] - 1)
  return { x, y, random:whole(1, size[1] - x + 6) + math.max(0, -x),
    random:whole(1, size[2] - y + 6) + math.max(0, -y) }
end

--- The colour of a pixel, which is clear beyond the frame.
local function pixel(image, x, y)
  local is_inside = x >= 0 and y >= 0 and x < image.width and y < image.height
  if is_inside then return { image:get(x, y) } end
  return { 0, 0, 0, 0 }
end

describe("two runs", function()
  for _, antialias in ipairs { "none", "area" } do
    it("of one scene, built twice, are equal to the bit under " .. antialias, function()
      each_scene(function(exposures, options, _, case)
        options.antialias = antialias
        local again = scenes.load((scenes.script(case, { has_shifts = true }))):at(1)
        assert(text(exposures, options) == text(again, options), "CASE=" .. case)
      end)
    end)
  end
end)

describe("any number of workers", function()
  for _, antialias in ipairs { "none", "area" } do
    it("gives the same pixels under " .. antialias .. " #workers", function()
      each_scene(function(exposures, options, _, case)
        options.antialias = antialias
        local alone = pixels(exposures, options)
        for _, workers in ipairs { 2, 3, 7 } do
          assert(alone == pixels(exposures, with(options, { workers = workers })),
                 ("CASE=%d: %d workers"):format(case, workers))
        end
      end)
    end)
  end
end)

describe("a crop", function()
  local function compare(antialias, tolerance)
    each_scene(function(exposures, options, random, case)
      options.antialias = antialias
      local whole = assert(celspan.pixels(exposures, options))
      local crop = random_crop(random, options.size)
      local part = assert(celspan.pixels(exposures, with(options, { crop = crop })))
      for y = 0, crop[4] - 1 do
        for x = 0, crop[3] - 1 do
          local p, q = pixel(part, x, y), pixel(whole, crop[1] + x, crop[2] + y)
          for c = 1, 4 do
            if math.abs(p[c] - q[c]) > tolerance then
              error(("CASE=%d: crop %s: pixel %d, %d is %s, of the whole %s"):format(
                case, table.concat(crop, ","), x, y, table.concat(p, " "), table.concat(q, " ")))
            end
          end
        end
      end
    end)
  end

  it("equals that part of the whole exactly under none", function() compare("none", 0) end)
  it("equals that part of the whole within 1/65535 under area", function()
    compare("area", 1 / 65535)
  end)
end)

describe("rows", function()
  for _, antialias in ipairs { "none", "area" } do
    it("requested alone equal those of the whole under " .. antialias, function()
      each_scene(function(exposures, options, random, case)
        options.antialias = antialias
        local whole = spans(exposures, options)
        for _ = 1, 3 do
          local y = random:whole(0, options.size[2] - 1)
          local alone = spans(exposures, with(options, { rows = { y, y } }))
          assert(rows.text(whole, y, y) == rows.text(alone, y, y),
            ("CASE=%d: row %d"):format(case, y))
        end
      end)
    end)
  end
end)

describe("frames", function()
  local function film()
    local ground = celspan.rect { 0, 0, 30, 20, texture = "#456" }
    return celspan.film { size = { 30, 20 }, frames = 12, frame = function(f)
      local x = f:random("x", 0, 20)
      local ball = celspan.circle { centre = { x, f.number }, radius = 5 }
      return celspan.rostrum { celspan.cel { ground, ball } }
    end }
  end

  it("rendered in any order are the same", function()
    local options, forwards = { size = { 30, 20 } }, {}
    local one, other = film(), film()
    for number = 1, 12 do forwards[number] = text(one:at(number), options) end
    for number = 12, 1, -1 do
      assert.are.equal(forwards[number], text(other:at(number), options))
    end
    for number = 1, 12 do assert.are.equal(forwards[number], text(one:at(number), options)) end
  end)
end)
