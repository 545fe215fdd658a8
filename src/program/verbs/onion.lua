--- Onion skin: a film whose frames show, tinted, the drawings of the frames before and after.
--
--   rear                                                            front
--   ground | before 2   before 1   after 1 ... | the drawing of the frame
--            red, 1/4   red, 1/2   green, 1/2
--
-- The frame's own drawing covers the skins, which cover the ground. The ground are the rearmost
-- cels that the other frames hold too, and whatever covers the frame opaquely; of an opaque cel in
-- front of which nothing lies, the rearmost objects that the other frames hold too. If the frame is
-- still one opaque drawing, the skins lie over it.
--
-- A skin is made of what the frame itself does not hold, and of its pixels only those that differ
-- from the frame's drawing (program/change.c). It is made at the size of the output, and tinted
-- twice: its colours under a light of the tint, and half over them its outline filled with the
-- tint, so that black lines show too.
--
-- A camera that moves shows nothing: the camera of the frame sees the other frames too, and where
-- the rearmost cel and another one are only shifted and scaled, as celspan.multiplane does it, cels
-- that are only shifted and scaled count as held. With the name of a cel, all others are left out.
--
-- For celspan watch each cel has its label (program/stage_tree.c) as its name, and `labels` chooses
-- the cels that skins are made of, and then those that are hidden: "\nnell\ncel 2\n" .. "\nsun\n".
-- "\n": none; then skins are made of all that are no ground. nil: a render.
local core, film, before, after, width, height, name, labels = ...
local celspan = require "celspan"

local RED, GREEN = { 1, 0.18, 0.12 }, { 0.1, 0.75, 0.2 }
local COARSE = 64 -- pixels a side, to find out whether a cel covers the frame
local NAME_MOST = 255 -- bytes
local SKIN = "\u{F0000}" -- the name of a skin among cels with labels: of no script's language

local skinned, hidden = "\n", "\n" -- the two parts of `labels`
if labels then
  local at = labels:find("\n\n", 1, true)
  skinned, hidden = labels:sub(1, at), labels:sub(at + 1)
end

local rostrum_metatable = getmetatable(celspan.rostrum {})

--- A rostrum with other cels, under a camera, without light from behind.
local function remade(rostrum, cels, camera)
  cels.front, cels.brightness, cels.size = rostrum.front, rostrum.brightness, rostrum.size
  cels.antialias, cels.camera, cels.space = rostrum.antialias, camera, rostrum.space
  return celspan.rostrum(cels)
end

--- The values of a list between two indices, as a list.
local function slice(list, from, to) return { table.unpack(list, from, to) } end

--- The rostrum with the label of each cel as its name. In a cut it has itself the name of its
--- shot.
local function labelled(rostrum)
  local cels, shot = {}, rostrum.name and rostrum.name .. "/" or ""
  for i = 1, #rostrum do
    local label = shot .. (rostrum[i].name or "cel " .. i)
    cels[i] = #label <= NAME_MOST and rostrum[i]:named(label) or rostrum[i]
  end
  return rostrum:with(cels)
end

--- Whether skins are made of a cel.
local function is_chosen(cel)
  local line = "\n" .. (cel.name or "") .. "\n"
  return (skinned == "\n" or skinned:find(line, 1, true)) and not hidden:find(line, 1, true)
end

--- The rostrum with only the cels of the chosen name, if there is a name.
local function chosen(rostrum)
  if labels then return labelled(rostrum) end
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

--- The pixels of exposures at a size, in the film's antialiasing.
local function pixels_of(exposures, size)
  local alone = celspan.film { size = film.size, space = film.space,
    frame = function() return exposures end }
  local pixels, message = celspan.pixels(alone, { size = size })
  if not pixels then error(message, 0) end
  return pixels:bytes { depth = 8, colour = "srgb", alpha = "straight" }
end

-- ---------------------------------------------------------------- what frames have in common

--- Whether a frame has a cel for which is_like(cel, value) holds; with `of`, whether a cel contains
--- such a value.
local function holds(frame, value, is_like, of)
  for _, exposure in ipairs(frame) do
    for i = 1, #exposure[1] do
      local cel = exposure[1][i]
      if not of and is_like(cel, value) then return true end
      for j = 1, of and #cel or 0 do
        if is_like(cel[j], value) then return true end
      end
    end
  end
  return false
end

local function all_hold(frames, ...)
  for _, frame in ipairs(frames) do
    if not holds(frame, ...) then return false end
  end
  return true
end

--- How cels of the frame are compared with those of the others. If the rearmost cel and some
--- others, but not all, are only shifted, their art is compared; otherwise the whole cels are.
local function likeness(frame, others)
  local rostrum, shifted = frame[1][1], 0
  for i = 1, #rostrum do
    local is_shifted = not all_hold(others, rostrum[i], core.same)
      and all_hold(others, rostrum[i], core.same_art)
    if i == 1 and not is_shifted then return core.same end
    if is_shifted then shifted = shifted + 1 end
  end
  return shifted > 1 and shifted < #rostrum and core.same_art or core.same
end

-- ---------------------------------------------------------------- ground and drawing

local function covers(rostrum, cel)
  local alone = { { remade(rostrum, { cel }, rostrum.camera), 1 } }
  local bytes = pixels_of(alone, { math.min(width, COARSE), math.min(height, COARSE) })
  return not bytes:gsub("...(.)", "%1"):find "[^\255]"
end

--- How many of the rearmost cels are ground.
local function ground_of(rostrum, others, is_like)
  local count = 0
  while count < #rostrum and all_hold(others, rostrum[count + 1], is_like) do count = count + 1 end
  for i = #rostrum, count + 1, -1 do
    if covers(rostrum, rostrum[i]) then return i end
  end
  return count
end

--- The rostrum with its foremost cel divided into two, if this cel covers the frame: one has its
--- rearmost objects, which the other frames also have, and one has the rest.
local function parted(rostrum, others)
  local cel, count = rostrum[#rostrum], 0
  if not cel or all_hold(others, cel, core.same) or not covers(rostrum, cel) then return rostrum end
  while count < #cel and all_hold(others, cel[count + 1], core.same, "objects") do
    count = count + 1
  end
  if count == 0 or count == #cel then return rostrum end
  local cels = slice(rostrum, 1, #rostrum - 1)
  cels[#cels + 1] = cel:with(slice(cel, 1, count))
  cels[#cels + 1] = cel:with(slice(cel, count + 1, #cel)):with { back = { 0, 0, 0, 0 } }
  return rostrum:with(cels)
end

local function parted_frame(frame, others)
  local list = {}
  for i, exposure in ipairs(frame) do list[i] = { parted(exposure[1], others), exposure[2] } end
  return list
end

--- The part of the frame in front of its ground, as exposures, and how many cels of each exposure
--- are ground.
local function drawing_of(frame, others, is_like)
  local list, grounds = {}, {}
  for i, exposure in ipairs(frame) do
    local rostrum = exposure[1]
    local count = ground_of(rostrum, others, is_like)
    local cels = slice(rostrum, count + 1, #rostrum)
    if #cels == 0 then cels, count = slice(rostrum, 1, #rostrum), #rostrum end
    list[i], grounds[i] = { remade(rostrum, cels, rostrum.camera), exposure[2] }, count
  end
  return list, grounds
end

--- The drawing of another frame, without everything that this frame has, too; nil: nothing is left.
local function rest_of(other, frame, is_like)
  local list, has_any, camera = drawing_of(other, { frame }, is_like), false, frame[1][1].camera
  if skinned ~= "\n" then list = slice(other, 1, #other) end
  for i, exposure in ipairs(list) do
    local cels = {}
    for j = 1, #exposure[1] do
      if is_chosen(exposure[1][j]) and not holds(frame, exposure[1][j], is_like) then
        cels[#cels + 1] = exposure[1][j]:with { back = { 0, 0, 0, 0 } }
      end
    end
    has_any = has_any or #cels > 0
    list[i] = { remade(exposure[1], cels, camera), exposure[2] }
  end
  return has_any and list or nil
end

-- ---------------------------------------------------------------- skins

local function image_of(bytes)
  return celspan.image { pixels = bytes, size = { width, height }, format = "rgba8", x = 0, y = 0,
                         w = film.size[1], h = film.size[2] }
end

--- A cel with the name that was asked for, if there is one: cels with other names are removed
--- later. Nor has a skin the label of another cel.
local function called(cel)
  local own = labels and SKIN or name
  return own and cel:named(own) or cel
end

--- A cel that shows the pixels of the rest of a frame, where they differ from the drawing of this
--- frame.
local function skin(rest, own, tint, opacity)
  local bytes = core.differing(pixels_of(rest, { width, height }), own)
  local filled = bytes:gsub("...(.)", "\255\255\255%1")
  return called(celspan.cel { opacity = opacity, front = { 1, 1, 1 },
    celspan.rostrum { size = film.size, celspan.cel { image_of(bytes), front = tint },
      celspan.cel { image_of(filled), front = tint, opacity = 0.5 } } })
end

--- Skins, the farthest frame first; the frames after this one lie over those before it.
local function skins_of(frame, drawing, others, is_like)
  local skins, own = {}, nil
  for _, other in ipairs(others) do
    local rest = rest_of(other, frame, is_like)
    own = own or rest and pixels_of(drawing, { width, height })
    if rest then skins[#skins + 1] = skin(rest, own, other.tint, other.opacity) end
  end
  return skins
end

--- A cel that was made for the frame, as the camera sees it there.
local function under(camera, cel)
  if not camera then return cel end
  local x, y = film.size[1] / 2, film.size[2] / 2
  local centre = camera.centre or { x, y }
  return cel:scale((camera.width or film.size[1]) / film.size[1], nil, x, y)
    :rotate(camera.rotate or 0, x, y):translate(centre[1] - x, centre[2] - y)
end

--- A rostrum with skins in front of its ground.
local function laid(rostrum, ground, skins)
  local cels = slice(rostrum, 1, ground)
  for _, one in ipairs(skins) do cels[#cels + 1] = under(rostrum.camera, one) end
  table.move(rostrum, ground + 1, #rostrum, #cels + 1, cels)
  return rostrum:with(cels)
end

-- ---------------------------------------------------------------- frames

--- The frames around a frame, as far as the film extends, in the order of their skins.
local function around(number)
  local others = {}
  local function add(distance, tint)
    local neighbour = number + distance
    if neighbour >= film.first and neighbour < film.first + film.frames then
      local other = exposures_of(neighbour)
      other.tint, other.opacity = tint, 0.5 ^ math.abs(distance)
      others[#others + 1] = other
    end
  end
  for distance = before, 1, -1 do add(-distance, RED) end
  for distance = after, 1, -1 do add(distance, GREEN) end
  return others
end

local function frame_at(number)
  local frame, others = exposures_of(number), around(number)
  if #others == 0 or not frame[1] then return frame end
  local opened = parted_frame(frame, others)
  for _, other in ipairs(others) do
    for i, exposure in ipairs(parted_frame(other, { frame })) do other[i] = exposure end
  end
  local is_like = likeness(opened, others)
  local drawing, grounds = drawing_of(opened, others, is_like)
  local skins, list = skins_of(opened, drawing, others, is_like), {}
  for i, exposure in ipairs(opened) do
    list[i] = { laid(exposure[1], grounds[i], skins), exposure[2] }
  end
  return list
end

return film:with {
  frame = function(f) return frame_at(f.number) end,
}
