-- Falling snow: flakes that fall again and again, each on its own path and with its own sway.

local snow = {}

local FLAKE = "#e9ecff"

--- A flake of radius 1 about (0, 0): sharp, or out of focus.
local function flake(softness)
  if softness == 0 then
    return circle { 0, 0, 1, fill = FLAKE }
  end
  local clear = rgb(FLAKE, 0)
  return circle { 0, 0, 1, fill = radial {
    centre = { 0, 0 }, radius = 1, { 0, rgb(FLAKE, 0.62) },
    { 1 - softness, rgb(FLAKE, 0.5) }, { 1, clear } } }
end

--- A curtain of snow, a little larger than a frame of 1920 x 1080: a function of the time and of
--- the offset of the curtain.
---   count, size = {least, most}, fall (units per second), drift (to the side), sway, soft 0..1
function snow.curtain(seed, fields)
  local random = celspan.random(seed)
  local width, height, margin = 2300, 1300, 110
  local one, flakes = flake(fields.soft or 0), {}
  for i = 1, fields.count do
    local size = fields.size[1] + (fields.size[2] - fields.size[1]) * random("size" .. i) ^ 2
    flakes[i] = { x = random("x" .. i) * width, y = random("y" .. i) * height, size = size,
      fall = fields.fall * (0.75 + 0.5 * random("fall" .. i)), phase = 6.28 * random("phase" .. i),
      pace = 0.7 + 0.8 * random("pace" .. i), object = one:scale(size) }
  end
  return function(time, dx, dy)
    local list = {}
    for i, f in ipairs(flakes) do
      local sway = fields.sway * math.sin(time * f.pace * 1.7 + f.phase)
      local x = (f.x + fields.drift * time + sway + dx) % width - 190
      local y = (f.y + f.fall * time + 0.25 * sway + dy) % height - margin
      list[i] = f.object:translate(x, y)
    end
    return union(list)
  end
end

return snow
