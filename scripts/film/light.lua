-- Light: the light of the dusk, and the light that a flame adds around it.

local light = {}

function light.scaled(colour, k)
  return { colour[1] * k, colour[2] * k, colour[3] * k }
end

--- Front lights of the blue hour by the distance of a plane: the farther, the hazier and bluer.
light.dusk = { sky = { 1, 1, 1 }, far = { 0.62, 0.66, 0.96 }, middle = { 0.50, 0.54, 0.92 },
               near = { 0.46, 0.49, 0.86 } }

-- It gets darker during the film.
local evening = keys { { 0, 1.1 }, { 6, 0.86 }, { 13.5, 0.6 }, { 18, 0.48 }, { 21, 0.5 },
  { 29, 0.42 } }

--- The dusk on a plane at a time of the film.
function light.at(distance, time) return light.scaled(light.dusk[distance], evening:at(time)) end

light.FLAME = { 3, 1.5, 0.5 }

-- The falloff of a flame's light, from the flame to its radius: steep at the flame, level at the
-- rim, where a step would be visible as a ring.
local falloff = { { 0, 1 }, { 0.08, 0.82 }, { 0.18, 0.58 }, { 0.3, 0.37 }, { 0.45, 0.2 },
                  { 0.6, 0.095 }, { 0.78, 0.03 }, { 1, 0 } }

--- A front light that is `ambient` everywhere plus the light of a flame at (x, y) of the frame.
function light.about(x, y, reach, strength, ambient)
  if strength <= 0 then return ambient end
  local gain = 0
  for i = 1, 3 do gain = math.max(gain, ambient[i] + strength * light.FLAME[i]) end
  local texture = { centre = { x, y }, radius = reach }
  for i, stop in ipairs(falloff) do
    local k = strength * stop[2]
    texture[i] = { stop[1], rgb((ambient[1] + k * light.FLAME[1]) / gain,
      (ambient[2] + k * light.FLAME[2]) / gain, (ambient[3] + k * light.FLAME[3]) / gain) }
  end
  return { texture = radial(texture), gain = gain }
end

--- A flicker that never goes out; its mean is 1.
function light.flicker(time)
  return 1 + 0.05 * math.sin(time * 17) + 0.04 * math.sin(time * 29.3 + 1) + 0.03
    * math.sin(time * 7.1)
end

return light
