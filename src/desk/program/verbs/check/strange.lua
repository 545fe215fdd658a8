--- Colours that are in no palette of the film: warnings with their frames and first place.
local script = ...
local native = require "celspan.native"

local strange = { list = {}, by_colour = {} }

local function recolouring()
  local bytes, lights, at = script:kept("celspan.ink_recolour", "kept", ""), {}, 1
  for i = 1, #bytes // 8 do lights[i], at = ("<d"):unpack(bytes, at) end
  return #lights > 0 and native.recolouring(lights, lights, false, true)
end

local function add(number, one)
  local known = strange.by_colour[one.colour]
  if known and number == known.last + 1 then known.last = number end
  if known and number <= known.last then return end
  local pixel = one.x and (", pixel %d, %d"):format(one.x, one.y) or ""
  local place = one.place == "" and " a value without a name" or one.place
  known = { first = number, last = number,
            message = ("%s is in no palette of the film:%s%s"):format(one.colour, place, pixel) }
  strange.by_colour[one.colour], strange.list[#strange.list + 1] = known, known
end

--- Looks at the frame that was built last.
function strange.see(number)
  if strange.seeker == nil then strange.seeker = recolouring() end
  for _, exposure in ipairs(strange.seeker and script:exposures() or {}) do
    native.recolour_see(strange.seeker, exposure[1])
    for _, one in ipairs(native.strange(strange.seeker)) do add(number, one) end
  end
end

return strange
