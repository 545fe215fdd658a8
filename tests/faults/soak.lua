-- Random films for tests/faults/soak.c. The chunk is called with the folder of the tree; it returns
-- a function make(seed, has_modules) -> film, with pictures in memory and, if the build has the
-- modules for them, pictures from files, text and defocus. A film's frame is the same whenever it
-- is made.
local root = ...
local celspan = require "celspan"
local prng = require "tests.support.prng"
local scenes = require "tests.support.scenes"

local pictures = { "wood", "canal", "village" }

--- A cel with a picture file, sharp or out of focus.
local function picture(random, traits)
  local file = ("%s/scripts/pictures/%s.png"):format(root, random:pick(pictures))
  local image = celspan.image { file = file, w = random:between(5, traits.width) }
  return celspan.cel { image:rotate(random:between(-30, 30)), opacity = random:between(0.2, 1),
    defocus = random:once(2) and { radius = random:between(0.2, 3) } or nil }
end

local function text(random, traits)
  local letters = celspan.text { random:pick { "soak", "day -> night", "8" }, texture = "#f80",
    font = root .. "/scripts/type/block.ttf", size = random:between(4, 20),
    at = { 2, traits.height / 2 } }
  return celspan.cel { letters }
end

return function(seed, has_modules)
  local script, traits = scenes.script(seed, { has_shifts = true })
  local inner = scenes.load(script)
  return celspan.film { size = { traits.width, traits.height }, frame = function(f)
    local random = prng.new(seed)
    local exposures = inner:at(f.number)
    if not has_modules or random:once(2) then return exposures end
    return celspan.rostrum { picture(random, traits),
                             random:once(2) and text(random, traits) or nil }
  end }
end
