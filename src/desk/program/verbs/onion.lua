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
-- Skins count drawings: the first skin before a frame has the nearest drawing of each cel that the
-- frame does not hold, the second one the nearest that is in neither, and so on.
--
--   frames   35  36  37  38  39  40
--   bird      a   a   b   b   c   c    first skins at 37 and at 38: a, c
--   cloud     1   2   3   4   5   6                       at 37: 2, 4
--
-- Only pixels that differ from the frame's drawing are shown (program/film/change.c). A skin is
-- made at the size of the output, and tinted twice: its colours under a light of the tint, and half
-- over them its outline filled with the tint, so that black lines show too.
--
-- A camera that moves shows nothing: the camera of the frame sees the other frames too, also the
-- camera of celspan.multiplane. Where a script itself shifts and scales the rearmost cel and some
-- others, cels that are only shifted and scaled count as held. With the name of a cel, all others
-- are left out.
--
-- For celspan watch each cel has its label (program/stage/stage_tree.c) as its name, and `labels`
-- chooses the cels that skins are made of, and then those that are hidden: "\nnell\ncel 2\n" ..
-- "\nsun\n". "\n": none; then skins are made of all that are no ground. nil: a render.
local native, film, before, after, width, height, name, labels = ...
local celspan = require "celspan"
local scenes = require "celspan.scenes"

local RED, GREEN = { 1, 0.18, 0.12 }, { 0.1, 0.75, 0.2 }
local COARSE = 64 -- pixels a side, to find out whether a cel covers the frame
local NAME_MOST = 255 -- bytes
local FAR, FARTHER = 120, 12 -- frames to the nearest drawing, and from it to drawings of other cels
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

--- The exposures of a frame, each { rostrum, weight, the rostrum of the script }. like: those of a
--- frame whose multiplane cameras see it; nil: its own do.
local function exposures_of(number, like)
  local made, list = film:at(number), {}
  if getmetatable(made) == rostrum_metatable then made = { made } end
  for i, exposure in ipairs(made) do
    local is_bare = getmetatable(exposure) == rostrum_metatable
    local own, by = is_bare and exposure or exposure[1], like and (like[i] or like[1])[3]
    local seen = by and scenes.under(own, by) or own
    list[i] = { chosen(seen), not is_bare and exposure[2] or 1, own }
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

--- How cels of the frame are compared with cels of the others. If the rearmost cel and some
--- others, but not all, are only shifted, their art is compared; otherwise the whole cels are.
local function likeness(frame, others)
  local rostrum, shifted = frame[1][1], 0
  for i = 1, #rostrum do
    local is_shifted = not all_hold(others, rostrum[i], native.same)
      and all_hold(others, rostrum[i], native.same_art)
    if i == 1 and not is_shifted then return native.same end
    if is_shifted then shifted = shifted + 1 end
  end
  return shifted > 1 and shifted < #rostrum and native.same_art or native.same
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
  if not cel or all_hold(others, cel, native.same) or not covers(rostrum, cel) then
    return rostrum
  end
  while count < #cel and all_hold(others, cel[count + 1], native.same, "objects") do
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

-- ---------------------------------------------------------------- drawings of other frames

--- What each cel of a rostrum is called in all frames: by its exposure, its name, and which one of
--- this name it is.
local function keys_of(rostrum, exposure)
  local keys, counts = {}, {}
  for i = 1, #rostrum do
    local own = ("%d %s\n"):format(exposure, rostrum[i].name or "")
    counts[own] = (counts[own] or 0) + 1
    keys[i] = own .. counts[own]
  end
  return keys
end

--- Calls visit(cel, key, exposure) for the cels of a frame of which skins may be made.
local function each_drawn(frame, other, is_like, visit)
  local list = skinned == "\n" and drawing_of(frame, { other }, is_like) or frame
  for i, exposure in ipairs(frame) do
    local keys = keys_of(exposure[1], i)
    for j = #keys - #list[i][1] + 1, #keys do
      if is_chosen(exposure[1][j]) then visit(exposure[1][j], keys[j], i) end
    end
  end
end

--- The rank of a drawing among the `side.count` nearest of its cel; nil: it is known, or too far.
local function rank_of(side, key, cel, is_like)
  local known = side.known[key] or {}
  if #known == side.count then return nil end
  for _, drawing in ipairs(known) do
    if is_like(drawing, cel) then return nil end
  end
  known[#known + 1], side.known[key] = cel, known
  return #known
end

--- Adds the drawings of a frame that are new on a side: { rank =, raw =, other =, and the cels of
--- each exposure }. Returns whether there are any.
local function add_drawings(side, raw)
  local frame, other = parted_frame(side.frame, { raw }), parted_frame(raw, { side.frame })
  local is_like, by_rank, before_it = likeness(frame, { other }), {}, #side
  each_drawn(other, frame, is_like, function(cel, key, i)
    local rank = not holds(frame, cel, is_like) and rank_of(side, key, cel, is_like)
    if not rank then return end
    local one = by_rank[rank] or { rank = rank, raw = raw, other = other }
    one[i] = one[i] or {}
    table.insert(one[i], cel:with { back = { 0, 0, 0, 0 } })
    by_rank[rank] = one
  end)
  for rank = 1, side.count do side[#side + 1] = by_rank[rank] end
  if #side == before_it then return false end
  each_drawn(frame, {}, is_like, function(_, key) side.known[key] = side.known[key] or {} end)
  return true
end

--- Whether all cels of the frame's drawing have as many drawings as are wanted.
local function is_full(side)
  for _, drawings in pairs(side.known) do
    if #drawings < side.count then return false end
  end
  return next(side.known) ~= nil
end

--- The drawings on one side of a frame, the nearest first. step: -1 or 1.
local function side_of(frame, number, step, count, tint)
  local side, distance, last = { frame = frame, known = {}, count = count, tint = tint }, 1, FAR
  while distance <= last and count > 0 and not is_full(side) do
    local other = number + step * distance
    if other < film.first or other >= film.first + film.frames then break end
    if add_drawings(side, exposures_of(other, frame)) then last = distance + FARTHER end
    distance = distance + 1
  end
  return side
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
  local bytes = native.differing(pixels_of(rest, { width, height }), own)
  local filled = bytes:gsub("...(.)", "\255\255\255%1")
  return called(celspan.cel { opacity = opacity, front = { 1, 1, 1 },
    celspan.rostrum { size = film.size, celspan.cel { image_of(bytes), front = tint },
      celspan.cel { image_of(filled), front = tint, opacity = 0.5 } } })
end

--- Skins, the farthest first; later frames lie over earlier ones.
local function skins_of(frame, drawing, sides)
  local skins, own, camera = {}, pixels_of(drawing, { width, height }), frame[1][1].camera
  for _, side in ipairs(sides) do
    for place = #side, 1, -1 do
      local one, rest = side[place], {}
      for i, exposure in ipairs(one.other) do
        rest[i] = { remade(exposure[1], one[i] or {}, camera), exposure[2] }
      end
      skins[#skins + 1] = skin(rest, own, side.tint, 0.5 ^ one.rank)
    end
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

local function frame_at(number)
  local frame, raws, others = exposures_of(number), {}, {}
  if not frame[1] then return frame end
  local sides = { side_of(frame, number, -1, before, RED), side_of(frame, number, 1, after, GREEN) }
  for _, side in ipairs(sides) do
    for _, one in ipairs(side) do raws[#raws + 1], others[#others + 1] = one.raw, one.other end
  end
  if #others == 0 then return frame end
  local opened = parted_frame(frame, raws)
  local drawing, grounds = drawing_of(opened, others, likeness(opened, others))
  local skins, list = skins_of(opened, drawing, sides), {}
  for i, exposure in ipairs(opened) do
    list[i] = { laid(exposure[1], grounds[i], skins), exposure[2] }
  end
  return list
end

return film:with {
  frame = function(f) return frame_at(f.number) end,
}
