--- Onion skin: a film whose frames lie under tinted ones of before and after.
--
--   before 2   before 1   the frame   after 1       red, red,        green
--      1/4        1/2         1         1/2         of each what it holds that the frame does not
--
-- A neighbour is laid over the frame without the cels that both frames hold alike, so that a still
-- background stays clear. It is made at the size of the output, and tinted twice: its colours under
-- a light of the tint, and half over them its outline filled with the tint, so that black lines
-- show too.
--
-- Neighbours are seen by the camera of the frame, so that its movement shows nothing. With the name
-- of a cel, all others are left out of every frame.
local film, before, after, width, height, same, name = ...
local celspan = require "celspan"

local RED, GREEN = { 1, 0.18, 0.12 }, { 0.1, 0.75, 0.2 }

local rostrum_metatable = getmetatable(celspan.rostrum {})

--- A rostrum with other cels, under a camera, without light from behind.
local function remade(rostrum, cels, camera)
  cels.front, cels.brightness, cels.size = rostrum.front, rostrum.brightness, rostrum.size
  cels.antialias, cels.camera = rostrum.antialias, camera
  return celspan.rostrum(cels)
end

--- The rostrum with the cels of that name alone, if there is one.
local function chosen(rostrum)
  if not name then return rostrum end
  local cels = {}
  for i = 1, #rostrum do
    if rostrum[i].name == name then cels[#cels + 1] = rostrum[i] end
  end
  return remade(rostrum, cels, rostrum.camera)
end

--- The exposures of a frame, each {rostrum, weight}.
local function exposures_of(number)
  local made = film:at(number)
  if getmetatable(made) == rostrum_metatable then return { { chosen(made), 1 } } end
  local list = {}
  for i, exposure in ipairs(made) do
    local is_bare = getmetatable(exposure) == rostrum_metatable
    list[i] = is_bare and { chosen(exposure), 1 } or { chosen(exposure[1]), exposure[2] or 1 }
  end
  return list
end

local function holds(exposures, cel)
  for _, exposure in ipairs(exposures) do
    for i = 1, #exposure[1] do
      if same(exposure[1][i], cel) then return true end
    end
  end
  return false
end

--- What a neighbour holds that the frame does not, without light from behind; nil: nothing.
local function rest_of(exposures, current)
  local list, has_any, camera = {}, false, current[1] and current[1][1].camera
  for i, exposure in ipairs(exposures) do
    local rostrum, cels = exposure[1], {}
    for j = 1, #rostrum do
      if not holds(current, rostrum[j]) then
        cels[#cels + 1] = rostrum[j]:with { back = { 0, 0, 0, 0 } }
      end
    end
    has_any = has_any or #cels > 0
    list[i] = { remade(rostrum, cels, camera), exposure[2] }
  end
  return has_any and list or nil
end

local function image_of(bytes)
  return celspan.image { pixels = bytes, size = { width, height }, format = "rgba8", x = 0, y = 0,
                         w = film.size[1], h = film.size[2] }
end

--- A cel with the name that is asked for, if there is one: all others are left out later.
local function called(cel) return name and cel:named(name) or cel end

--- A neighbour as a cel that lies over the frame; nil: it holds nothing else than the frame does.
local function skin(number, current, tint, opacity)
  local rest = rest_of(exposures_of(number), current)
  if not rest then return nil end
  local pixels, message = celspan.pixels(rest, { size = { width, height }, film = film.size })
  if not pixels then error(message, 0) end
  local bytes = pixels:bytes { depth = 8, colour = "srgb", alpha = "straight" }
  local filled = bytes:gsub("...(.)", "\255\255\255%1")
  return called(celspan.cel { opacity = opacity, front = { 1, 1, 1 },
    celspan.rostrum { size = film.size, celspan.cel { image_of(bytes), front = tint },
      celspan.cel { image_of(filled), front = tint, opacity = 0.5 } } })
end

--- Skins, the farthest first; those after the frame lie over those before it.
local function skins_of(number, current)
  local skins = {}
  local function add(distance, tint)
    local neighbour = number + distance
    if neighbour >= film.first and neighbour < film.first + film.frames then
      skins[#skins + 1] = skin(neighbour, current, tint, 0.5 ^ math.abs(distance))
    end
  end
  for distance = before, 1, -1 do add(-distance, RED) end
  for distance = after, 1, -1 do add(distance, GREEN) end
  return skins
end

--- A rostrum with skins over it. Under a camera it is put into another one, which has none, because
--- skins are made for the frame.
local function covered(rostrum, skins)
  local cels = {}
  if rostrum.camera then
    cels[1] = called(celspan.cel { rostrum:with { size = film.size }, front = { 1, 1, 1 } })
  else
    for i = 1, #rostrum do cels[i] = rostrum[i] end
  end
  table.move(skins, 1, #skins, #cels + 1, cels)
  if not rostrum.camera then return rostrum:with(cels) end
  cels.antialias = rostrum.antialias
  return celspan.rostrum(cels)
end

return celspan.film {
  size = film.size, fps = film.fps, first = film.first, frames = film.frames, title = film.title,
  frame = function(f)
    local current = exposures_of(f.number)
    local skins, list = skins_of(f.number, current), {}
    for i, exposure in ipairs(current) do list[i] = { covered(exposure[1], skins), exposure[2] } end
    return list
  end,
}
