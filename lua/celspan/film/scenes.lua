--- The planes of celspan.multiplane, for the onion skin, which shows the planes of other frames as
--- the camera of the frame sees them.
local fields = require "celspan.fields"

local scenes = {}
local known = setmetatable({}, { __mode = "k" }) -- by rostrum

--- Keeps what a rostrum shows. see(planes, lens): its cels. Returns the rostrum.
function scenes.keep(rostrum, planes, lens, see)
  known[rostrum] = { planes = planes, lens = lens, see = see }
  return rostrum
end

--- rostrum:named(name), with its planes.
function scenes.named(rostrum, name)
  local made = rostrum:named(name)
  known[made] = known[rostrum]
  return made
end

--- The rostrum as the lens of another one sees it; as it is, if one of them shows no planes.
function scenes.under(rostrum, other)
  local own, seen = known[rostrum], known[other]
  return own and seen and rostrum:with(own.see(own.planes, seen.lens)) or rostrum
end

return fields.seal("scenes", scenes)
