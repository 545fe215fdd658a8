-- Lottie animations that are damaged: those of the fuzzer, changed at random places. Each is read,
-- or refused with a sentence, and what is read is drawn, in all builds, also those with sanitizers.
local celspan = require "celspan"
local cases = require "tests.support.cases"
local prng = require "tests.support.prng"
local target = require "tests.fuzz.lottie"

local CASES = 40 -- of each file
local SECONDS = 10 -- the most that a case may take; 0.01 is usual, and sanitizers are slow
local names = { "layers", "operators", "shapes", "slots", "sounds", "text" }

local function corpus(name)
  local file = assert(io.open(("tests/fuzz/corpus/lottie/%s.json"):format(name), "rb"))
  local text = file:read "a"
  file:close()
  return text
end

--- The bytes of a case: a file of the corpus, and choices of what is changed in it.
local function bytes_of(name, case)
  local random, choices = prng.new(case), {}
  for i = 1, 3 * random:whole(1, 8) do choices[i] = string.char(random:whole(0, 255)) end
  return corpus(name) .. "\0" .. table.concat(choices)
end

--- Draws the middle of an animation, small.
local function draw(art)
  if art.size[1] < 1 or art.size[2] < 1 then return end -- no scale
  local object = art:at((art.first + art.last) / 2):scale(16 / art.size[1], 16 / art.size[2])
  local film = celspan.film { size = { 16, 16 }, frames = 1, frame = function()
    return celspan.rostrum { celspan.cel { object } }
  end }
  celspan.pixels(film)
end

--- Whether a message is a sentence for users, and not that of a mistake in the reader.
local function is_sentence(message)
  return #message < 1000 and not message:find "attempt to" and not message:find "celspan/lottie/"
    and not message:find "bad argument"
end

describe("damaged animations are read and drawn, or refused with a sentence:", function()
  for _, name in ipairs(names) do
    it(name, function()
      for _, case in cases.of(CASES) do
        local start = os.clock()
        local good, art = pcall(target.try_bytes, bytes_of(name, case))
        assert.is_true(good, ("case %d: %s"):format(case, tostring(art)))
        local drawn, message = true, nil
        if art then drawn, message = pcall(draw, art) end
        assert.is_true(drawn or is_sentence(tostring(message)),
          ("case %d: %s"):format(case, tostring(message)))
        assert.is_true(os.clock() - start < SECONDS, ("case %d is slow"):format(case))
      end
    end)
  end
end)
