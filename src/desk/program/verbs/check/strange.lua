--- Colours that are in no palette of the film: warnings with their frames and first place.
local script = ...
local native = require "celspan.native"

local MOST = 256 -- further colours are not listed, as by ink.recolour

local strange, list, by_colour = {}, {}, {}

local function recolouring()
  local bytes, lights, at = script:kept("celspan.ink_recolour", "kept", ""), {}, 1
  for i = 1, #bytes // 8 do lights[i], at = ("<d"):unpack(bytes, at) end
  return #lights > 0 and native.recolouring(lights, lights, false, true)
end

local function add(number, one)
  local known = by_colour[one.colour]
  if not known and #list < MOST then
    known = { first = number, last = number, count = 0, one = one }
    by_colour[one.colour], list[#list + 1] = known, known
  end
  if not known or known.seen == number then return end
  known.seen, known.count = number, known.count + 1
  known.first, known.last = math.min(known.first, number), math.max(known.last, number)
end

--- Looks at the frame that was built last.
function strange.see(number)
  if strange.seeker == nil then strange.seeker = recolouring() end
  for _, exposure in ipairs(strange.seeker and script:exposures() or {}) do
    native.recolour_see(strange.seeker, exposure[1])
    for _, one in ipairs(native.strange(strange.seeker)) do add(number, one) end
  end
end

--- The warnings, one for each colour: its frames, and its first place.
function strange.warnings()
  for _, known in ipairs(list) do
    local one, count = known.one, known.count
    local some = count <= known.last - known.first and (", in %d of these frames"):format(count)
    local pixel = one.x and (", pixel %d, %d"):format(one.x, one.y) or ""
    local place = one.place == "" and " a value without a name" or one.place
    known.message = ("%s is in no palette of the film%s:%s%s"):format(one.colour, some or "",
      place, pixel)
  end
  return list
end

return strange
