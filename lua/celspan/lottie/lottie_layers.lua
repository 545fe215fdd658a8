--- Layers and compositions: functions of the frame that return an object.
--
--   layers = { the first in front, ... }     one above, hidden, may be the matte of the next
local affine = require "celspan.affine"
local celspan = require "celspan"
local effects = require "celspan.lottie_effects"
local fields = require "celspan.fields"
local masks = require "celspan.lottie_masks"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local shapes = require "celspan.lottie_shapes"
local text = require "celspan.lottie_text"
local transform = require "celspan.lottie_transform"
local values = require "celspan.lottie_values"

local layers = {}

local MOST_PARENTS = 100
local MOST_MATTES = 20 -- of mattes of mattes
local modes = { [0] = "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
                "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue",
                "saturation", "color", "luminosity", "add", "hard-mix" }

-- ---------------------------------------------------------------- contents

local contents = {}

--- A function that cuts a composition to a frame, for all layers that show it.
local function cutter(asset, w, h)
  local key = ("%.9g %.9g"):format(w, h)
  asset.cutters = asset.cutters or {}
  if not asset.cutters[key] then
    local frame = celspan.rect { 0, 0, math.max(0, w), math.max(0, h) }
    asset.cutters[key] = paint.keep(function(object) return celspan.clip(object, frame) end)
  end
  return asset.cutters[key]
end

--- A composition inside: its frame, its speed and its own clock.
contents[0] = function(scope, item)
  local comp, message = layers.asset(scope.root, item.refId)
  if not comp then
    scope.note(message)
    return nil
  end
  local start, stretch = values.frame(item.st, 0), values.number(item.sr, 1)
  local remap = values.table(item.tm) and property.number(scope, item.tm, "the time", 0)
  local cut = cutter(scope.root.assets[item.refId], values.number(item.w, 0),
    values.number(item.h, 0))
  if stretch == 0 then stretch = 1 end
  return function(t)
    local object = comp(remap and remap(t) * scope.root.fps or (t - start) / stretch)
    return object and cut(object)
  end, true
end

--- A solid.
contents[1] = function(scope, item)
  local w, h = values.number(item.sw, 0), values.number(item.sh, 0)
  local colour = values.text(item.sc, "#000000")
  local good, texture = pcall(celspan.rgb, colour)
  if not good then scope.note(("its colour '%s' is not known; it is black"):format(colour)) end
  local object = celspan.rect { 0, 0, math.max(0, w), math.max(0, h),
                                texture = good and texture or "#000" }
  return function() return object end, false
end

--- A picture.
contents[2] = function(scope, item)
  local object, message = scope.root.pictures(item.refId)
  if not object then
    scope.note(message)
    return nil
  end
  return function() return object end, false
end

--- A sound has no picture; lottie_sounds.lua collects all.
contents[6] = function() end

contents[4] = function(scope, item) return shapes.compile(scope, item.shapes) end
contents[5] = function(scope, item) return text.compile(scope, item) end

local others = { [13] = "cameras are left out", [15] = "data layers are left out" }

local function content_of(scope, item)
  local read = contents[item.ty]
  if read then return read(scope, item) end
  if item.ty ~= 3 then
    scope.note(others[item.ty] or ("layers of the kind %s are left out"):format(
      fields.key(item.ty)))
  end
end

-- ---------------------------------------------------------------- one layer

--- The map of a layer through all its parents.
local function placing(layer, by_index, seen)
  if layer.map then return layer.map, layer.map_moves end
  local item, scope = layer.item, layer.scope
  local own, moves = transform.read(scope, item.ks, values.flag(item.ao))
  local parent = item.parent ~= nil and by_index[item.parent]
  seen = seen or {}
  seen[#seen + 1], seen[layer] = layer, true
  if parent and not seen[parent] and #seen < MOST_PARENTS then placing(parent, by_index, seen) end
  layer.depth = parent and (parent.depth or MOST_PARENTS) + 1 or 1
  if layer.depth > MOST_PARENTS then
    scope.note "its parents form a circle, or are too many; it has none"
    parent, layer.depth = nil, 1
  end
  if parent then
    local outer, moves_outer = placing(parent, by_index, seen)
    local inner = own
    moves = moves or moves_outer
    local both = paint.keep(affine.compose)
    own = paint.memo(moves, function(t) return both(outer(t), inner(t)) end)
  end
  layer.map, layer.map_moves = own, moves
  return own, moves
end

--- Fills a layer: what it shows, without its matte and its mode.
local function compile(layer, by_index)
  local item, scope = layer.item, layer.scope
  local get, moves = content_of(scope, item)
  if not get then return end
  local map, moves_map = placing(layer, by_index)
  local mask, moves_mask = masks.compile(scope, item.masksProperties)
  local change, moves_effects = effects.compile(scope, item)
  local opacity, moves_opacity = property.number(scope, values.table(item.ks) and item.ks.o,
    "the opacity", 100)
  local name = values.name(item.nm, "layer")
  local place = paint.keep(function(object, at, share)
    object = transform.apply(object, at)
    return (share < 1 and celspan.group { object, opacity = share } or object):named(name)
  end)
  local all = moves or moves_map or moves_mask or moves_effects or moves_opacity
  layer.get = paint.memo(all, function(t)
    local share = math.min(100, opacity(t)) / 100
    local object = share > 0 and get(t) or nil
    layer.content = item.ty == 0 and object
    if object and mask then object = mask(t, object) end
    if object and change then object = change(t, object) end
    return object and place(object, map(t), share)
  end)
end

--- The picture of a layer with its matte and its mode, at a frame; nil where it has none.
local function picture(layer, t)
  if not layer.get or t < layer.first or t >= layer.last then return nil end
  local object = layer.get(t)
  if not object then return nil end
  if layer.matte then object = layer.cover(object, layer.matte.show(t), layer.matte_mode) end
  if object and layer.mode ~= "normal" then object = layer.blend(object, layer.mode) end
  return object
end

--- The same as a function, which keeps its last value: many layers may have the same matte.
local function shower(layer)
  return paint.memo(true, function(t)
    local good, object = pcall(picture, layer, t)
    if good then return object end
    layer.scope.note(("it cannot be drawn at frame %g: %s"):format(t, tostring(object)))
  end)
end

-- ---------------------------------------------------------------- a composition

local function open(scope, list)
  local opened, by_index = {}, {}
  for _, one in ipairs(values.items(list)) do
    local item = one[2]
    local own = scope.within(("[%d]"):format(one[1] - 1), item.nm)
    local layer = { item = item, scope = own, first = values.frame(item.ip, 0),
                    last = values.frame(item.op, 1e7), is_hidden = values.flag(item.hd) }
    local mode = values.number(item.bm, 0)
    layer.mode = modes[mode] or "normal"
    layer.cover = paint.keep(masks.matte)
    layer.blend = paint.keep(function(object, by) return object:blend(by) end)
    if not modes[mode] then own.note(("the mode %g is shown as normal"):format(mode)) end
    opened[#opened + 1] = layer
    if item.ind ~= nil and by_index[item.ind] == nil then by_index[item.ind] = layer end
  end
  return opened, by_index
end

--- Counts the mattes of mattes behind each layer, and cuts circles and what is too deep.
--- `mattes` of a layer is nil before the first visit, and false during it.
local function count_mattes(layer)
  local way = {}
  while layer and layer.mattes == nil do
    layer.mattes, way[#way + 1] = false, layer
    layer = layer.matte
  end
  if layer and layer.mattes == false then
    way[#way].scope.note "its mattes form a circle; it has none"
    way[#way].matte, layer = nil, nil
  end
  local count = layer and layer.mattes + 1 or 0
  for i = #way, 1, -1 do
    if count > MOST_MATTES then
      way[i].scope.note(("more than %d mattes of mattes; it has none"):format(MOST_MATTES))
      way[i].matte, count = nil, 0
    end
    way[i].mattes, count = count, count + 1
  end
end

--- Finds the matte of each layer.
local function pair(opened, by_index)
  for i, layer in ipairs(opened) do
    local item = layer.item
    local mode = values.number(item.tt, 0)
    if mode >= 1 and mode <= 4 then
      layer.matte = item.tp ~= nil and by_index[item.tp] or opened[i - 1]
      layer.matte_mode = mode
    end
  end
  for _, layer in ipairs(opened) do count_mattes(layer) end
  for _, layer in ipairs(opened) do
    if layer.matte then layer.matte.is_matte = true end
  end
end

--- Whether two layers show the same composition, at the same time, in the same place.
local function coincide(one, other, t)
  if one.content ~= other.content then return false end
  local a, b = one.map(t), other.map(t)
  for i = 1, #a do
    if a[i] ~= b[i] then return false end
  end
  return true
end

--- The mean of each pixel, so that what lies behind shines through the edges.
local function average(layer)
  local item = layer.item
  local margin = math.max(1, values.number(item.w, 0), values.number(item.h, 0)) / 64
  return paint.keep(function(object)
    return celspan.group { object:blur(margin, { kernel = "pixel" }), space = "srgb" }
  end)
end

--- Compositions that are shown twice in the same place have both edges, as in all players; without
--- this the one in front hides the other. shown: layers, whose objects are replaced.
local function add_edges(shown, objects, t)
  local known = {}
  for i, layer in ipairs(shown) do
    local other = layer.content and known[layer.content]
    if other and coincide(layer, shown[other], t) then
      for _, n in ipairs { other, i } do
        shown[n].average = shown[n].average or average(shown[n])
        objects[n] = shown[n].average(shown[n].show(t))
      end
    end
    if layer.content then known[layer.content] = i end
  end
end

--- A list of layers as a function of the frame.
local function composition(scope, list)
  local opened, by_index = open(scope, list)
  pair(opened, by_index)
  local has_modes = false
  for _, layer in ipairs(opened) do
    layer.show = shower(layer)
    if not layer.is_hidden or layer.is_matte then compile(layer, by_index) end
    layer.is_drawn = layer.get and not layer.is_hidden and not layer.is_matte
      and not values.flag(layer.item.td)
    has_modes = has_modes or layer.is_drawn and layer.mode ~= "normal"
  end
  local join = paint.keep_list(function(objects)
    if #objects == 1 and not has_modes then return objects[1] end
    objects.isolate = has_modes or nil
    return celspan.group(objects)
  end)
  return function(t)
    local objects, shown = {}, {}
    for i = #opened, 1, -1 do
      local object = opened[i].is_drawn and opened[i].show(t)
      if object then objects[#objects + 1], shown[#shown + 1] = object, opened[i] end
    end
    add_edges(shown, objects, t)
    return #objects > 0 and join(objects) or nil
  end
end

--- A composition of the file's assets. It keeps its last two pictures, because several layers may
--- show it.
---@return (fun(t: number): any)? get
---@return string? message
function layers.asset(root, id)
  local asset = root.assets[id]
  if not asset or not values.table(asset.item.layers) then
    return nil, ("the composition '%s' is not in the file"):format(fields.key(id))
  end
  if asset.is_open then return nil, "the composition contains itself; it is left out" end
  if asset.get then return asset.get end
  asset.is_open = true
  local get = composition(asset.scope.within ".layers", asset.item.layers)
  asset.is_open = nil
  local times, objects, turn = {}, {}, 1
  asset.get = function(t)
    for i = 1, 2 do
      if times[i] == t then return objects[i] or nil end
    end
    turn = 3 - turn
    times[turn], objects[turn] = t, get(t) or false
    return objects[turn] or nil
  end
  return asset.get
end

--- The whole animation.
function layers.compile(scope, list) return composition(scope.within "layers", list) end

return fields.seal("lottie_layers", layers)
