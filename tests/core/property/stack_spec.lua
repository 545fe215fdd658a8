-- Frames taken apart by their lights: for random scenes, in the scene's own lights and in others,
-- they equal the scene rendered as a whole.
local celspan = require "celspan"
local prng = require "tests.support.prng"
local relight = require "celspan.relight"
local scenes = require "tests.support.scenes"

local COUNT = (tonumber(os.getenv "CELSPAN_SCENES") or 300) // 3
local ONLY = tonumber(os.getenv "CASE")
local TOLERANCE = 2 ^ -18 -- of gradients: that of a stack

--- Lights for some cels, by their index, and the scene in them. The lights of compositions inside
--- stay, and so do lights of cels that have a shape: such scenes are not used.
local function change(random, rostrum)
  local function light(last)
    return { random:between(0, 2), random:between(0, 1.5), random:between(0, 1), last }
  end
  local changes, cels = {}, {}
  for i = 1, #rostrum do
    cels[i] = rostrum[i]
    if random:once(2) then
      changes[i] = { front = light(), back = light(random:between(0, 1)) }
      cels[i] = cels[i]:with(changes[i])
    end
  end
  local whole = rostrum:with(cels)
  if random:once(2) then
    changes[0] = { front = light(), back = light(random:between(0, 1)) }
    whole = whole:with(changes[0])
  end
  return changes, whole
end

--- The greatest difference between two images, and its position.
local function difference(a, b)
  local worst, place = 0, ""
  for y = 0, a.height - 1 do
    for x = 0, a.width - 1 do
      local p, q = { a:get(x, y) }, { b:get(x, y) }
      for c = 1, 4 do
        local off = math.abs(p[c] - q[c])
        if off > worst then
          worst, place = off, ("%d,%d: %s, but %s"):format(x, y, table.concat(p, " "),
            table.concat(q, " "))
        end
      end
    end
  end
  return worst, place
end

--- Whether a scene has lights that a stack refuses.
local function has_shape(message)
  return message:find("is a texture; a stack takes flat lights", 1, true)
end

describe("relight.stack", function()
  for _, antialias in ipairs { "area", "none" } do
    it("equals the whole, in its own lights and in others, under " .. antialias, function()
      local compared, failures = 0, {} -- at a finer tolerance, since both stand for curves by lines
      for case = ONLY or 1, ONLY or COUNT do
        local script, traits = scenes.script(case, { is_single = true, has_modes = false })
        if ONLY then print(script) end
        local rostrum, random = scenes.load(script):at(1), prng.new(case + 1000)
        local options = { size = traits.size, film = { traits.width, traits.height },
          antialias = antialias }
        local stack, message = relight.stack(rostrum, options)
        if stack then
          compared = compared + 1
          local changes, whole = change(random, rostrum)
          local fine = { size = options.size, film = options.film, antialias = antialias,
            tolerance = TOLERANCE }
          for name, pair in pairs { own = { {}, rostrum }, other = { changes, whole } } do
            local worst, place = difference(assert(celspan.pixels(pair[2], fine)),
              assert(stack:light(pair[1])))
            if worst > 1 / 65535 then
              failures[#failures + 1] = ("CASE=%d %s lights, %.3g / 65535 at %s"):format(case, name,
                worst * 65535, place)
            end
            -- The usual tolerance: products of gradients are approximated by lines within 1/1023.
            assert.is_true(difference(assert(celspan.pixels(pair[2], options)),
              assert(stack:light(pair[1]))) < 1 / 1023, "CASE=" .. case)
          end
        else
          assert.is_truthy(has_shape(message), message)
        end
      end
      assert.are.equal("", table.concat(failures, "\n"))
      assert.is_true(ONLY or compared > COUNT / 3, compared .. " were compared")
    end)
  end
end)
