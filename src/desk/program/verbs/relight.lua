--- celspan relight IN -o OUT: the light taken off a picture, and the picture in another light.
--
--   IN --light--> texture of its own S, T, beta --> OUT.exr, of seven channels
--   IN.exr, of seven channels --> texture --> in the light --to --> OUT, any picture
local program, request = ...
local celspan = require "celspan"
local relight = require "celspan.relight"

local input, output, light, to = request[1], request.output, request.light, request.to

--- A light in the form in which the core stores it: three floats. Other values of the option are
--- refused.
local function light_of(option, text, may_be_dark)
  local rgb = program.colour(text)
  if not rgb then
    rgb = program.split(text)
    if #rgb ~= 3 or text:find "%s" then program.refuse(option) end
  end
  for i = 1, 3 do
    local channel = tonumber(rgb[i])
    local is_right = channel and channel >= 0 and channel <= 1e6 and (channel > 0 or may_be_dark)
    if not is_right then program.refuse(option) end
    rgb[i] = channel
  end
  return { string.unpack("fff", string.pack("fff", table.unpack(rgb))) }
end

local known = light and light ~= "grey" and light_of("--light", light, false) or nil
local shown = to and light_of("--to", to, true)

--- The texture in a light, as a scene of the picture's size. If the picture has no alpha, the scene
--- is opaque.
local function scene_of(texture, picture)
  local size = { picture.width, picture.height }
  return celspan.rostrum { size = size, antialias = "none",
    back = { 0, 0, 0, picture.alpha and 0 or 1 }, celspan.cel { front = shown,
      celspan.rect { 0, 0, picture.width, picture.height, texture = texture } } }
end

local taken_off = relight.read(input)

if not output then program.usage "-o is missing: give -o and the file to make" end
if not light and not taken_off then
  program.usage("--light is missing: give the light in which '%s' was taken, a colour such as "
    .. "#ffe0b0, r,g,b, or grey", input)
elseif light and taken_off then
  program.usage("--light: the light of '%s' has been taken off already: leave the option out",
    input)
elseif to then
  program.refuse_target(output)
elseif taken_off then
  program.usage("--to is missing: give the light in which to show '%s'", input)
end

local picture, facts = program.pictured(input)
local texture = taken_off or program.check(relight.from { picture = picture, light = known,
  estimate = not known and "grey" or nil })
if to then
  program.write(scene_of(texture, facts or program.picture(input)), output)
else
  program.check(relight.write(texture, output))
end
