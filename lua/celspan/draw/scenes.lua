--- The planes of celspan.multiplane: for the onion skin, which shows the planes of other frames as
--- the camera of the frame sees them, and for sheets, whose drawings a camera does not move.
local fields = require "celspan.fields"

local scenes = {}
local known = setmetatable({}, { __mode = "k" }) -- by rostrum
local is_resting = false

--- Whether cameras rest from now on: "on" or "off".
function scenes.rest(how)
  is_resting = how == "on"
  return ""
end

--- The rostrum as a lens at rest sees it, all sharp.
local function at_rest(rostrum, planes, lens, see)
  return rostrum:with(see(planes, { x = 0, y = 0, z = 0, focal = lens.focal, focus = lens.focal,
    aperture = 0, cx = lens.cx, cy = lens.cy }))
end

--- Keeps what a rostrum shows. see(planes, lens): its cels. Returns the rostrum, or as it is with
--- its lens at rest.
function scenes.keep(rostrum, planes, lens, see)
  known[rostrum] = { planes = planes, lens = lens, see = see }
  return is_resting and at_rest(rostrum, planes, lens, see) or rostrum
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
