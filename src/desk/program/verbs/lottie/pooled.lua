--- Areas of all frames as layers: what is the same in several frames is one layer, which is shown
--- in these.
--
--   frame 1    sky  letters  ball at A         the sky and the letters    a layer, frames 1 to 3
--   frame 2    sky  letters  ball at B         the ball at A              a layer, frames 1 and 3
--   frame 3    sky  letters  ball at A         the ball at B              a layer, frame 2
--
-- Areas of a frame do not overlap, so that their order does not matter. The lines lie below them,
-- and are seen only where edges of areas let them shine through: they keep their order where they
-- have the same paint and are in the same frames; of others those of most frames lie behind.
local layers = ...

local SAVED = 1000 -- bytes that a layer of several frames has to save: about twice its own

local Pool = {}
Pool.__index = Pool

--- name: of the layers.
local function new(name)
  return setmetatable({ name = name, pieces = {}, known = {}, frames = {}, bytes = 0 }, Pool)
end

--- The piece of this paint and text, with the places of self.frames where it is.
function Pool:piece(paint, text)
  local known = self.known[paint] or {}
  self.known[paint] = known
  if not known[text] then
    known[text] = { paint = paint, text = text }
    layers:weigh(#text)
    self.bytes = self.bytes + #text
    self.pieces[#self.pieces + 1] = known[text]
  end
  return known[text]
end

--- Adds paints with their pieces, all as texts, that are shown together, the rearmost first.
--- items: of a track, by frames.
function Pool:add(paints, items)
  self.frames[#self.frames + 1] = items
  for _, painted in ipairs(paints) do
    for _, text in ipairs(painted.pieces) do
      local piece = self:piece(painted.paint, text)
      if piece[#piece] ~= #self.frames then piece[#piece + 1] = #self.frames end
    end
  end
end

--- Puts pieces into the group of these places, which is made where it is new.
local function put(groups, places, pieces)
  local name = table.concat(places, " ")
  local group = groups[name]
  if not group then
    group = { places = places, size = 0 }
    groups[name], groups[#groups + 1] = group, group
  end
  for _, piece in ipairs(pieces) do
    group[#group + 1], group.size = piece, group.size + #piece.text
  end
end

--- Groups of pieces with the same places, those with most of them first; what is too small for a
--- layer is in that of each place.
function Pool:groups()
  local shared, groups = {}, {}
  for _, piece in ipairs(self.pieces) do put(shared, { table.unpack(piece) }, { piece }) end
  for i, group in ipairs(shared) do group.order = i - #group.places * #self.pieces end
  table.sort(shared, function(a, b) return a.order < b.order end)
  for _, group in ipairs(shared) do
    if group.size * (#group.places - 1) < SAVED then
      for _, place in ipairs(group.places) do put(groups, { place }, group) end
    else
      put(groups, group.places, group)
    end
  end
  return groups
end

--- The shapes of a layer with these pieces, the last one on top: those of one paint are filled
--- together.
local function shapes_of(pieces)
  local lists, parts = {}, {}
  for _, piece in ipairs(pieces) do
    local list = lists[piece.paint]
    if not list then
      list = { paint = piece.paint }
      lists[piece.paint], lists[#lists + 1] = list, list
    end
    list[#list + 1] = piece.text
  end
  for i, list in ipairs(lists) do
    list[#list + 1] = list.paint
    parts[#lists + 1 - i] = '{"ty":"gr","it":[' .. table.concat(list, ",") .. "]}"
  end
  return "[" .. table.concat(parts, ",") .. "]"
end

--- Adds the layers, behind those that are added later.
function Pool:add_layers()
  layers:weigh(-self.bytes) -- from here on each is counted as often as it is written
  for _, group in ipairs(self:groups()) do
    local items = {}
    for _, place in ipairs(group.places) do
      for frame, item in pairs(self.frames[place]) do items[frame] = item end
    end
    layers:add_shown(self.name, shapes_of(group), { items = items })
  end
end

return new
