--- Layers of Lottie from tracks.
--
--   data that stay, in a track      a shape layer; its transform and its opacity have keys
--   data that change: an outline    a layer for each drawing, which opacity shows and hides
--                     a group       its objects as tracks; those that stay in place are one layer
--   a group that is faded           a composition of its own
local affine = require "celspan.affine"

local program, text, keys, shapes, tracks = ...

local IDENTITY = affine.translation(0, 0)
local OPACITY = 0.15 -- how far an opacity in 0..100 may be from the frame's

local Layers = {}
Layers.__index = Layers

local MOST = 256 << 20 -- bytes of shapes and pictures: players read a file at once

--- film: size { w, h }, the count of frames, and draw(data, scale), which returns the asset of an
--- image; path: of the output.
local function new(film, path)
  return setmetatable({ film = film, path = path, bytes = 0, assets = {},
                        main = { layers = {} } }, Layers)
end

--- Counts bytes of shapes and pictures, as they are in the file.
function Layers:weigh(bytes)
  self.bytes = self.bytes + bytes
  if self.bytes > MOST then
    program.fail("limit", "%s: more than %d MiB of shapes and pictures: choose some frames with "
      .. "--frames, or a smaller --scale", self.path, MOST >> 20)
  end
end

--- Shapes as text at once, which is far smaller than their tables.
function Layers:written(value)
  local raw = text.encode(value)
  self:weigh(#raw)
  return { raw = raw }
end

local function add(comp, layer)
  layer.ind, layer.ddd, layer.st, layer.sr, layer.bm = #comp.layers + 1, 0, 0, 1, 0
  comp.layers[#comp.layers + 1] = layer
end

--- The opacity of a track from its first frame on: 0 where it is not there.
local function opacity_of(track, first, last)
  local values, one, is_faded = {}, nil, false
  for frame = first, last do
    local item = track.items[frame]
    if item then
      is_faded = is_faded or one and item.fade ~= one
      one = item.fade
    end
    values[#values + 1] = item and 100 * item.fade or 0
  end
  if not is_faded then return keys.held(values, first - 1) end
  for i, value in ipairs(values) do values[i] = { value } end
  return keys.property(values, first - 1, { OPACITY })
end

--- The transform of what stays in place, with the opacity of a track. map: where, if it is moved.
local function in_place(track, first, last, map)
  local ks = keys.placed(map or IDENTITY)
  ks.o = opacity_of(track, first, last)
  return ks
end

--- The maps of a track; where it is not there, the one before.
local function maps_of(track, first, last)
  local maps = {}
  for frame = first, last do
    maps[#maps + 1] = track.items[frame] and track.items[frame].map or maps[#maps]
  end
  return maps
end

--- A composition for a track that is faded as a whole. Returns it.
function Layers:inside(comp, track)
  local first, last = tracks.range(track)
  local inner = { id = "comp" .. #self.assets + 1, layers = {} }
  self.assets[#self.assets + 1] = inner
  add(comp, { ty = 0, nm = track.name or "group", refId = inner.id, w = self.film.size[1],
              h = self.film.size[2], ip = first - 1, op = last,
              ks = in_place(track, first, last) })
  return inner
end

--- The same track, without its fades.
local function unfaded(track)
  local whole = { id = track.id, name = track.name, items = {} }
  for frame, item in pairs(track.items) do
    whole.items[frame] = setmetatable({ fade = 1 }, { __index = item })
  end
  return whole
end

local function is_faded(track)
  for _, item in pairs(track.items) do
    if item.fade > 0 and item.fade < 1 then return true end
  end
  return false
end

local LARGEST = 64 -- scale of a layer: art in far smaller or larger units is scaled in the shapes

--- Maps whose greatest scale is near 1, and the scale that is left for what lies before them.
local function near_one(maps)
  local size = keys.scale(maps)
  if size == 0 or size >= 1 / LARGEST and size <= LARGEST then return maps, IDENTITY end
  local list = {}
  for i, map in ipairs(maps) do list[i] = affine.compose(map, keys.zoom(1 / size)) end
  return list, keys.zoom(size)
end

--- A shape layer of data that stay. bend: the part of its maps that is in the shapes.
function Layers:add_shapes(comp, track, bend)
  local first, last = tracks.range(track)
  local item = track.items[first]
  if not shapes.box(item.data) then return end
  local maps, zoom = near_one(maps_of(track, first, last))
  bend = affine.compose(zoom, bend)
  local within = { kind = "group", { data = item.data, matrix = bend, fade = 1 } }
  local ks = keys.transform(maps, first - 1, shapes.box(within))
  ks.o = opacity_of(track, first, last)
  add(comp, { ty = 4, nm = track.name or "shape", ip = first - 1, op = last, ks = ks,
              shapes = self:written(shapes.items(item.data, bend, item.front, keys.scale(maps))) })
end

--- An image layer of a picture that stays, in pixels of its asset.
function Layers:add_image(comp, track)
  local first, last = tracks.range(track)
  local data = track.items[first].data
  local box, maps = shapes.box(data), maps_of(track, first, last)
  if shapes.is_flat(data) or keys.scale(maps) == 0 then return end
  local asset = self.film.draw(data, keys.scale(maps))
  local fit = { (box[3] - box[1]) / asset.w, 0, box[1], 0, (box[4] - box[2]) / asset.h, box[2] }
  for i, map in ipairs(maps) do maps[i] = affine.compose(map, fit) end
  local ks = keys.transform(maps, first - 1, { 0, 0, asset.w, asset.h })
  ks.o = opacity_of(track, first, last)
  add(comp, { ty = 2, nm = track.name or "picture", refId = asset.id, ip = first - 1, op = last,
              ks = ks })
end

local function bend_of(map)
  if keys.is_upright(map) then return "" end
  return ("%.9g %.9g %.9g %.9g"):format(map[1], map[2], map[4], map[5])
end

--- Data that stay, whose axes may be turned against each other: that is bent in the shapes where
--- it stays, too.
function Layers:add_still(comp, track)
  local _, any = next(track.items)
  if any.data.kind == "image" then return self:add_image(comp, track) end
  local parts = tracks.parted(track, function(item) return bend_of(item.map) end)
  if parts[2] and keys.can_lean(maps_of(track, tracks.range(track))) then
    return self:add_shapes(comp, track, IDENTITY)
  end
  for _, part in ipairs(parts) do
    local map = part.items[tracks.range(part)].map
    local bend = IDENTITY
    if bend_of(map) ~= "" then
      bend = { map[1], map[2], 0, map[4], map[5], 0 }
      for frame, item in pairs(part.items) do
        local moved = affine.translation(item.map[3], item.map[6])
        part.items[frame] = setmetatable({ map = moved }, { __index = item })
      end
    end
    self:add_shapes(comp, part, bend)
  end
end

--- The same data in one light, or in several.
function Layers:add_lit(comp, track)
  for _, part in ipairs(tracks.parted(track, function(item) return item.front end)) do
    self:add_still(comp, part)
  end
end

--- Whether a track is in the same place of its group in all frames in which that is there.
local function stays(track, around)
  local before
  for frame in pairs(around.items) do
    local item = track.items[frame]
    if not item or before and not tracks.is_same(before.placed, item.placed) then return false end
    before = before or item
  end
  return not shapes.need_layers { kind = "group", before.placed }
end

--- Tracks that stay in their group as one.
local function join(list, around)
  local group = { kind = "group", is_joined = true }
  local _, first = next(list[1].items)
  for i, track in ipairs(list) do
    local _, item = next(track.items)
    group[i] = item.placed
  end
  local joined = { id = first.id, name = list[2] and around.name or list[1].name or around.name,
                   items = {} }
  for frame, item in pairs(around.items) do
    joined.items[frame] = setmetatable({ data = group }, { __index = item })
  end
  return joined
end

--- The objects of a group whose data change.
function Layers:add_group(comp, track)
  local lists, waiting = {}, {}
  for frame, item in pairs(track.items) do
    local list = {}
    for i, placed in ipairs(item.data) do list[i] = tracks.item(placed, item, item.fade) end
    lists[frame] = list
  end
  local function flush()
    if waiting[1] then self:add(comp, join(waiting, track)) end
    waiting = {}
  end
  for _, child in ipairs(tracks.align(lists, self.film.count)) do
    if stays(child, track) then
      waiting[#waiting + 1] = child
    else
      flush()
      self:add(comp, child)
    end
  end
  flush()
end

--- Whether a track shows more than one outline at a time.
local function has_several(track)
  for _, item in pairs(track.items) do
    if shapes.count(item.data) > 1 then return true end
  end
  return false
end

local function changes(track)
  local _, before = next(track.items)
  for _, item in pairs(track.items) do
    if item.data ~= before.data or item.front ~= before.front then return true end
  end
  return false
end

--- Adds the layers of a track.
function Layers:add(comp, track)
  if is_faded(track) and has_several(track) then
    comp, track = self:inside(comp, track), unfaded(track)
  end
  local _, item = next(track.items)
  if item.data.kind == "outline" or item.data.kind == "image" then
    for _, part in ipairs(tracks.parted(track, function(one) return one.data end)) do
      self:add_lit(comp, part)
    end
  elseif not item.data.is_joined
      and (item.data.kind ~= "group" or changes(track) or shapes.need_layers(item.data)) then
    self:add_group(comp, track)
  else
    self:add_lit(comp, track)
  end
end

--- A picture that fills the frame where it is there. asset: with its size in pixels, w and h.
function Layers:add_picture(asset, track)
  local first, last = tracks.range(track)
  local w, h = table.unpack(self.film.size)
  local scaled = { w / asset.w, 0, 0, 0, h / asset.h, 0 }
  add(self.main, { ty = 2, nm = "picture", refId = asset.id, ip = first - 1, op = last,
                   ks = in_place(track, first, last, scaled) })
end

--- Shapes, as a text, in the frames of a track.
function Layers:add_shown(name, written, track)
  local first, last = tracks.range(track)
  self:weigh(#written)
  add(self.main, { ty = 4, nm = name, ip = first - 1, op = last, shapes = { raw = written },
                   ks = in_place(track, first, last) })
end

--- How many layers there are in all compositions.
function Layers:count()
  local count = #self.main.layers
  for _, asset in ipairs(self.assets) do count = count + #(asset.layers or {}) end
  return count
end

--- The document. facts: its rate and its title; markers: a list { frame from 0, name }.
function Layers:document(facts, markers)
  local list = {}
  for i, mark in ipairs(markers) do list[i] = { tm = mark[1], cm = mark[2], dr = 0 } end
  for _, asset in ipairs(self.assets) do
    if asset.layers then asset.layers = shapes.reversed(asset.layers) end
  end
  return { v = "5.9.0", fr = { raw = text.number(facts.fps, 6) }, ip = 0, op = self.film.count,
           w = self.film.size[1], h = self.film.size[2], nm = facts.title, ddd = 0,
           assets = self.assets, markers = list, layers = shapes.reversed(self.main.layers) }
end

return new
