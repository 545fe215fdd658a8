-- Which of its numbered random cases a test tries.
--
-- A plain run tries the numbers 1, 2, .. up to a limit of each test. CELSPAN_SCENES=n tries n for
-- every 300 of those: with more, the numbers continue; with fewer, as in slow builds, they are
-- drawn from all by CELSPAN_SEED, so that each seed tries different ones, all of which a plain run
-- tries too. A test can name cases that are always tried: those that failed once. CASE=n tries that
-- one alone.
local prng = require "tests.support.prng"

local cases = {}
local ONLY, SEED = tonumber(os.getenv "CASE"), tonumber(os.getenv "CELSPAN_SEED") or 1
local SCENES = tonumber(os.getenv "CELSPAN_SCENES") or 300

cases.only = ONLY -- the requested case, or nil

--- How many of the `plain` cases of a plain run are tried; at least one.
function cases.count(plain) return math.max(1, plain * SCENES // 300) end

--- Chooses `count` of the numbers 1 .. `plain`, by the seed.
local function draw(count, plain)
  local random, numbers = prng.new(SEED), {}
  for i = 1, plain do numbers[i] = i end
  for i = 1, count do
    local k = random:whole(i, plain)
    numbers[i], numbers[k] = numbers[k], numbers[i]
  end
  return table.move(numbers, 1, count, 1, {})
end

--- The numbers to try if a plain run tries 1 .. `plain`, for a loop: `for _, case in
--- cases.of(300)`. Those of the list `kept` are tried first, in every run.
function cases.of(plain, kept)
  local count, numbers, is_kept = cases.count(plain), { ONLY }, {}
  if ONLY then return ipairs(numbers) end
  for i, case in ipairs(kept or {}) do
    numbers[i], is_kept[case] = case, true
  end
  local drawn = count < plain and draw(count, plain)
  for i = 1, count do
    local case = drawn and drawn[i] or i
    if not is_kept[case] then numbers[#numbers + 1] = case end
  end
  return ipairs(numbers)
end

return cases
