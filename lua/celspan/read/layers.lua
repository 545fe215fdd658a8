--- Layered paintings as objects and cels, layer by layer. One file, because readers, searches and
-- cels share what is known of each layer beyond its fields, which no script may see.
--
--   local tree = assert(layers.read "forest.kra") -- .ora, .psd, an OCA folder, numbered pictures
--   tree:find("far/hills").object
--   celspan.rostrum(tree:cels { front = { 1, 0.9, 0.8 } })
--
-- A tree is a list of layers and groups, rearmost first. Pixels are read when they are first
-- visible. `skipped` lists everything that looks different in the program that made the painting.
local celspan = require "celspan"
local columns = require "celspan.columns"
local native = require "celspan.native"
local dissolve = require "celspan.dissolve"
local fields = require "celspan.fields"
local files = require "celspan.files"
local folder_names = require "celspan.folder_names"
local oca = require "celspan.oca"
local sets = require "celspan.sets"
local sheet_krita = require "celspan.sheet_krita"
local sheet_oca = require "celspan.sheet_oca"

local layers = {}

---@class celspan.layers.entry
---@field name string
---@field object celspan.object The picture at its place, without opacity; or a group's visible layers
---@field x number Of its left edge, in pixels of the painting
---@field y number Of its top edge
---@field opacity number 0..1
---@field visible boolean
---@field blend string "normal", "multiply", "linear-dodge", "screen", ...; of a group also "pass-through"
---@field children? celspan.layers.entry[] Of a group: rearmost first
local Entry = { __name = "celspan.layers.entry" }
Entry.__index = fields.reads("a layer", {}, { children = true })

---@class celspan.layers.tree
---@field width? number
---@field height? number
---@field object celspan.object All visible layers, composited by themselves
---@field skipped { layer: string, what: string }[]
---@field fps? number If it moves
---@field from? integer Its first frame, as the file counts, and the last one
---@field to? integer
local Tree = { __name = "celspan.layers.tree" }
local methods = {}
Tree.__index = fields.reads("a tree of layers", methods,
  { width = true, height = true, fps = true, from = true, to = true })

--- The data of layers that are not in their entries, hidden from scripts; cels are made from them.
local sources = setmetatable({}, { __mode = "k" })

--- Blend modes that can be shown; "pass-through" is for groups.
local shown = {}
for mode in ("normal multiply screen overlay darken lighten color-dodge color-burn hard-light "
  .. "soft-light difference exclusion hue saturation color luminosity add linear-dodge "
  .. "soft-light-photoshop linear-burn vivid-light linear-light pin-light hard-mix subtract divide "
  .. "darker-color lighter-color"):gmatch "%S+" do
  shown[mode] = true
end

-- ---------------------------------------------------------------- entries

local function mode_of(entry) return shown[entry.blend] and entry.blend or "normal" end

--- The object of a layer with an opacity, before its blend mode; a layer that dissolves has none.
local function faded(entry, object, opacity)
  object = opacity < 1 and object:fade(opacity) or object
  return entry.blend == "dissolve" and dissolve.by_chance(object) or object
end

--- The object of a layer with the layers clipped to it, before its opacity and blend mode.
local function whole(entry, clipped)
  local object = entry.object
  if #clipped > 0 then
    local list = { object }
    for i, other in ipairs(clipped) do
      list[i + 1] = native.blend_within(faded(other, other.object, other.opacity), mode_of(other))
    end
    list.isolate, list.space = true, sources[entry].space
    object = celspan.group(list)
  end
  return object
end

local function painted(entry, clipped)
  local object, mode = faded(entry, whole(entry, clipped), entry.opacity), mode_of(entry)
  if sources[entry].within then return native.blend_within(object, mode) end
  return mode == "normal" and object or object:blend(mode)
end

--- The visible layers that are clipped to the layer at `place` of a list, and the index after them.
local function clipped_to(list, place)
  local clipped, next_place = {}, place + 1
  while list[next_place] and sources[list[next_place]].clipped do
    if list[next_place].visible then clipped[#clipped + 1] = list[next_place] end
    next_place = next_place + 1
  end
  return clipped, next_place
end

--- The objects of a list of layers; layers that are clipped to a hidden layer are hidden, too.
local function visible_objects(list)
  local objects, place = {}, 1
  while list[place] do
    local clipped, next_place = clipped_to(list, place)
    if list[place].visible then objects[#objects + 1] = painted(list[place], clipped) end
    place = next_place
  end
  return objects
end

--- The object of a group. A group that is not passed through isolates, if this makes a difference.
local function composed(given, space)
  local objects = visible_objects(given.children)
  objects.isolate, objects.space = given.blend ~= "pass-through" or nil, space
  local group = celspan.group(objects)
  return given.mask and celspan.matte(group, given.mask) or group
end

--- A valid name for a value: not empty.
local function name_of(text, kind) return text ~= "" and text or kind end

--- given: name, x, y, opacity, visible, blend; children, or picture (the fields of an image, with x
--- and y), or neither for an empty layer; clipped, within: how the layers below cut it; mask: for a
--- group, an object through which it is visible; pivot: of the object; exposures: the column of a
--- sheet, of a group of drawings; opacities: its keys. options: those of `read`.
local function make_entry(given, options)
  local source = { name = name_of(given.name, given.children and "group" or "layer"),
                   clipped = given.clipped, within = given.within, mask = given.mask,
                   space = options.space, exposures = given.exposures,
                   opacities = given.opacities }
  if given.picture then given.picture.smooth = options.smooth end
  local object
  if given.children then
    object = composed(given, options.space)
  elseif given.picture then
    object = celspan.image(given.picture)
  else
    object = given.object or celspan.union {}
  end
  object = object:named(source.name)
  if given.pivot then object = object:with { pivot = given.pivot } end
  local entry = setmetatable({ name = given.name, object = object, x = given.x,
    y = given.y, opacity = given.opacity, visible = given.visible, blend = given.blend,
    children = given.children }, Entry)
  sources[entry] = source
  return entry
end

-- ---------------------------------------------------------------- what is skipped

--- Whether a layer of a list has a mode that would pass through a group.
local function blends(list)
  for _, entry in ipairs(list) do
    local is_passed = entry.blend == "pass-through" and blends(entry.children)
    if mode_of(entry) ~= "normal" or sources[entry].within or is_passed then return true end
  end
  return false
end

--- Adds notes on differences in appearance, for the layers of a list. path: of the group.
local function note_blends(list, path, skipped)
  for _, entry in ipairs(list) do
    local here, blend, what = path .. entry.name, entry.blend, nil
    local is_known = shown[blend] or blend == "dissolve"
    if not is_known and not (entry.children and blend == "pass-through") then
      what = ('blend mode "%s": it is shown as normal'):format(blend)
    elseif blend == "pass-through" and blends(entry.children)
      and (entry.opacity < 1 or sources[entry].mask) then
      what = ("a group that passes modes through, with %s: it isolates them"):format(
        sources[entry].mask and "a mask" or "an opacity")
    end
    if what then skipped[#skipped + 1] = { layer = here, what = what } end
    if entry.children then note_blends(entry.children, here .. "/", skipped) end
  end
end

--- The space of each tree, which is hidden from scripts.
local spaces = setmetatable({}, { __mode = "k" })

--- Makes the tree of a list of layers. skipped: notes about all layers.
local function complete_tree(list, width, height, skipped, space)
  local tree = { width = width, height = height, skipped = skipped }
  for i, entry in ipairs(list) do tree[i] = entry end
  tree.object = composed({ children = list }, space)
  spaces[tree] = space
  return setmetatable(tree, Tree)
end

--- The same tree, with the frames of a clip.
local function moving(tree, clip)
  tree.fps, tree.from, tree.to = clip.fps, clip.from, clip.to
  return tree
end

local function make_tree(list, width, height, skipped, options)
  note_blends(list, "", skipped)
  return complete_tree(list, width, height, skipped, options.space)
end

--- The tree with another list; itself without one.
local function with_list(tree, list)
  return list and moving(complete_tree(list, tree.width, tree.height, tree.skipped, spaces[tree]),
    tree) or tree
end

--- A copy of a layer whose objects were changed by a function.
local function changed(entry, change)
  local copy, source = setmetatable({}, Entry), {}
  for name, value in next, entry do copy[name] = value end
  for name, value in next, sources[entry] do source[name] = value end
  sources[copy] = source
  if entry.children then
    copy.children = {}
    for i, child in ipairs(entry.children) do copy.children[i] = changed(child, change) end
    copy.object = composed({ children = copy.children, blend = entry.blend, mask = source.mask },
      source.space):named(source.name)
  else
    copy.object = change(entry.object)
  end
  return copy
end

--- For ink.recolour: the tree with other layers.
function Tree.__recolour(tree, change)
  local list = {}
  for i, entry in ipairs(tree) do list[i] = changed(entry, change) end
  return with_list(tree, list)
end

-- ---------------------------------------------------------------- paintings

--- The mask of a group of a painting, in the size of the painting.
local function mask_of(layer, painting)
  return layer.mask and celspan.image { pixels = layer.mask, colour = layer.colour, x = 0, y = 0,
                                        w = painting.width, h = painting.height }
end

local function from_painting(path, options)
  local painting, message = native.painting(path)
  if not painting then return nil, message end
  local flat, children, list = painting.layers, {}, {}
  local exposures, opacities = sheet_krita.exposures(painting), sheet_krita.opacities(painting)
  for i, layer in ipairs(flat) do
    local picture = layer.pixels and { pixels = layer.pixels, colour = layer.colour, x = layer.x,
                                       y = layer.y, w = layer.width, h = layer.height }
    local siblings = list
    if layer.parent then
      siblings = children[layer.parent] or {}
      children[layer.parent] = siblings
    end
    siblings[#siblings + 1] = make_entry({ name = layer.name, x = layer.x, y = layer.y,
      picture = picture, opacity = layer.opacity, visible = layer.visible, blend = layer.blend,
      children = layer.group and (children[i] or {}) or nil, clipped = layer.clipped,
      within = layer.within, mask = mask_of(layer, painting), exposures = exposures[i],
      opacities = opacities[i] }, options)
  end
  local skipped = {}
  for i, note in ipairs(painting.notes) do
    skipped[i] = { layer = note.layer and flat[note.layer].path or "", what = note.what }
  end
  return moving(make_tree(list, painting.width, painting.height, skipped, options), painting)
end

-- ---------------------------------------------------------------- folders

--- The result of a function, or nil and the message of its error, without the line.
local function caught(make)
  local good, value = pcall(make)
  if good then return value end
  return nil, (tostring(value):gsub("^[^\n]-:%d+: ", "", 1))
end

local function from_folder(path, names, options)
  local list, skipped = {}, {}
  folder_names.sort(names)
  for _, name in ipairs(names) do
    local base, file = folder_names.picture(name), path .. "/" .. name
    if not base then
      skipped[#skipped + 1] = { layer = name, what = "not a picture: it is left out" }
    elseif not native.within(path, name) then
      return nil, ("%s: %s lies outside the folder"):format(path, name)
    else
      local entry, message = caught(function()
        return make_entry({ name = base, x = 0, y = 0, opacity = 1, visible = true,
          blend = "normal", picture = { file = file, x = 0, y = 0 } }, options)
      end)
      if not entry then return nil, message end
      list[#list + 1] = entry
    end
  end
  if #list == 0 then return nil, path .. ": the folder holds no pictures" end
  return make_tree(list, nil, nil, skipped, options)
end

local function from_oca(folder, document, options)
  local read, message = oca.read(folder, document)
  if not read then return nil, message end
  local function build(list)
    local entries = {}
    for i, layer in ipairs(list) do
      if layer.children then layer.children = build(layer.children) end
      entries[i] = make_entry(layer, options)
    end
    return entries
  end
  local entries
  entries, message = caught(function() return build(read.layers) end)
  if not entries then return nil, message end
  return moving(make_tree(entries, read.width, read.height, read.skipped, options), read.clip)
end

-- ---------------------------------------------------------------- the module

local function read_any(path, options)
  local names, message = native.folder(path)
  if names then
    local document = sheet_oca.file(names)
    if document then return from_oca(path, document, options) end
    return from_folder(path, names, options)
  end
  if message:find "limit" then return nil, message end
  if path:match "%.oca$" then
    local folder, document = path:match "^(.*)/([^/]*)$"
    return from_oca(folder or ".", document or path, options)
  end
  return from_painting(path, options)
end

--- smooth: alpha of 8 bits is made smooth, so that painted glows have no rings. space: the space in
--- which colours mix: by default "srgb", as in painting programs.
---@param path string Relative to the caller's file, else to the script
---@param options? { smooth?: boolean, space?: "srgb"|"linear" }
---@return celspan.layers.tree? tree
---@return string? message
function layers.read(path, options)
  fields.takes("layers: read", "string", "the name of a file or folder", path)
  options = options or {}
  fields.check("layers: read", options, { smooth = "boolean", space = "any" })
  fields.space("layers", options.space)
  return files.found(path, read_any, { smooth = options.smooth, space = options.space or "srgb" })
end

--- layers.read for a painting that must be readable: raises an error if it is not.
---@param path string Relative to the caller's file, else to the script
---@param options? { smooth?: boolean, space?: "srgb"|"linear" }
---@return celspan.layers.tree tree
function layers.load(path, options)
  local tree, message = layers.read(path, options)
  return tree or native.refuse("layers: " .. message)
end

-- ---------------------------------------------------------------- finding

local function find(list, path)
  for _, entry in ipairs(list) do
    if entry.name == path then return entry end
  end
  for _, entry in ipairs(list) do
    local inside = entry.name .. "/"
    if entry.children and path:sub(1, #inside) == inside then
      local found = find(entry.children, path:sub(#inside + 1))
      if found then return found end
    end
  end
  return nil
end

--- The layer or group of a path, "group/layer"; the rearmost if several have it.
---@param path string
---@return celspan.layers.entry? entry
function methods:find(path)
  fields.self("layers", Tree, self, "find")
  fields.takes("layers: find", "string", "a path like \"group/layer\"", path)
  return find(self, path)
end

--- Adds the paths of all layers and groups of a list.
local function add_paths(list, path, paths)
  for _, entry in ipairs(list) do
    paths[#paths + 1] = path .. entry.name
    if entry.children then add_paths(entry.children, path .. entry.name .. "/", paths) end
  end
  return paths
end

--- The same, but raises an error if there is no such layer or group.
---@param path string
---@return celspan.layers.entry entry
function methods:get(path)
  local entry = self:find(path)
  if entry then return entry end
  local paths = add_paths(self, "", {})
  local hint = native.nearest(path, paths)
  native.refuse(("layers: there is no layer %q%s"):format(path,
    hint and ("; did you mean %q?"):format(hint) or #paths > 0 and "; there are "
      .. table.concat(paths, ", ", 1, math.min(12, #paths)) or ""))
end

-- ---------------------------------------------------------------- changes

--- A copy of an entry with new contents: children, or an object; or with another pivot. shown: what
--- differs of visible and opacity.
local function remade(entry, children, object, pivot, shown_as)
  local source = sources[entry]
  shown_as = shown_as or entry
  if not pivot and getmetatable(object or entry.object) == "celspan.object" then
    pivot = (object or entry.object).pivot
  end
  return make_entry({ name = entry.name, x = entry.x, y = entry.y, opacity = shown_as.opacity,
    visible = shown_as.visible, blend = entry.blend, children = children, object = object,
    clipped = source.clipped, within = source.within, mask = source.mask, pivot = pivot,
    exposures = source.exposures, opacities = source.opacities },
    { space = source.space })
end

--- Copies a list, with those layers changed that have a function, inner ones first; nil if none has
--- one. done: the paths that were visited; if several layers have one path, only the rearmost is
--- changed.
local function changed_list(list, path, changes, done)
  local copy, is_changed = {}, false
  for i, entry in ipairs(list) do
    local here = path .. entry.name
    local change = not done[here] and changes[here]
    done[here] = true
    local children = entry.children and changed_list(entry.children, here .. "/", changes, done)
    if children then entry = remade(entry, children) end
    if type(change) == "table" then
      entry = remade(entry, entry.children, entry.object, change.pivot)
    elseif change then
      local object = change(entry.object)
      fields.expect_kind(object and pcall(celspan.union, { object }), object,
        "layers: the function of layer '%s' must return an object", here)
      entry = remade(entry, nil, object)
    end
    copy[i] = entry
    is_changed = is_changed or children ~= nil or change ~= nil and change ~= false
  end
  return is_changed and copy or nil
end

--- The painting with layers replaced, inner ones first. Each function gets the object of the layer
--- at its path, without opacity and blend mode, and returns another object. Opacities, modes,
--- clipping and the order of the layers are kept. A table { pivot = } gives a layer the point that
--- "pivot" means in later changes: { x, y }, or a place such as "top".
---@param changes table<string, (fun(object: celspan.object): celspan.object)|{ pivot: celspan.point|string }>
---@return celspan.layers.tree
function methods:with(changes)
  fields.self("layers", Tree, self, "with")
  fields.takes("layers: with", "table", "a table of functions by path", changes)
  for path, change in next, changes do
    self:get(path)
    if type(change) == "table" then
      fields.check(("layers: layer '%s'"):format(path), change, { pivot = "any" })
    else
      fields.expect_kind(type(change) == "function", change,
        "layers: layer '%s' must have a function", path)
    end
  end
  return with_list(self, changed_list(self, "", changes, {}))
end

-- ---------------------------------------------------------------- frames

--- The drawings of a layer, of which only the one of a name is visible.
local function exposed(drawings, name)
  local copy, is_found = {}, false
  for i, drawing in ipairs(drawings) do
    local visible = drawing.name == name and not is_found
    is_found = is_found or visible
    copy[i] = drawing.visible == visible and drawing
      or remade(drawing, drawing.children, drawing.object, nil, { visible = visible,
        opacity = drawing.opacity })
  end
  return copy
end

--- Copies a list as it is at a frame, as the sheet counts; nil if nothing in it moves.
local function list_at(list, frame)
  local copy, moves = {}, false
  for i, entry in ipairs(list) do
    local source, children = sources[entry], entry.children
    if source.exposures then
      children = exposed(children, source.exposures.names[columns.find(source.exposures, frame)])
    else
      children = children and list_at(children, frame)
    end
    local opacity = source.opacities and sheet_krita.opacity(source.opacities, frame)
    local is_changed = children or opacity
    copy[i] = is_changed and remade(entry, children or entry.children, not entry.children
      and entry.object or nil, nil, { visible = entry.visible, opacity = opacity or entry.opacity })
      or entry
    moves = moves or is_changed
  end
  return moves and copy or nil
end

--- The painting as it is at a frame, as the file counts: its layers show their drawings of this
--- frame, and have its opacities. Before its first drawing a layer is empty.
---@param frame number
---@return celspan.layers.tree
function methods:at(frame)
  fields.self("layers", Tree, self, "at")
  fields.expect_kind(fields.is_finite(frame), frame, "layers: at takes the number of a frame")
  return with_list(self, list_at(self, math.floor(frame) - (self.from or 0) + 1))
end

local function nothing() return celspan.union {} end

--- The painting with one layer of each set: for { mouth = "C" }, of "mouth A", "mouth B" and "mouth
--- C" only the last one. false: none of them.
---@param choices table<string, string|false>
---@return celspan.layers.tree
function methods:show(choices)
  fields.self("layers", Tree, self, "show")
  fields.takes("layers: show", "table", "a table of names by set", choices)
  local paths, changes = {}, {}
  for _, path in ipairs(add_paths(self, "", {})) do paths[path] = true end
  for _, path in ipairs(sets.hidden("layers: show", "the painting", paths, choices)) do
    changes[path] = nothing
  end
  return self:with(changes)
end

-- ---------------------------------------------------------------- cels

local known = { only = "table", front = "any", back = "any", viewport = "table", defocus = "any",
                opacity = "number" }

--- The cel of an entry with the layers clipped to it.
local function cel_of(entry, clipped, options)
  local object, opacity = whole(entry, clipped), entry.opacity * (options.opacity or 1)
  if entry.blend == "dissolve" then object, opacity = faded(entry, object, opacity), 1 end
  return celspan.cel { object, front = options.front, back = options.back,
    viewport = options.viewport, defocus = options.defocus, blend = mode_of(entry),
    opacity = opacity }:named(sources[entry].name)
end

--- Whether each layer of a group may become a separate cel, because the group is not composited as
--- a whole.
local function is_open(entry)
  if not entry.children or entry.opacity < 1 or sources[entry].mask then return false end
  return entry.blend == "pass-through" or mode_of(entry) == "normal" and not blends(entry.children)
end

--- chosen: the entries that become cels, as keys; nil: all visible ones.
local function add_cels(list, chosen, options, cels)
  local place = 1
  while list[place] do
    local entry = list[place]
    local clipped, next_place = {}, place + 1
    if not chosen then clipped, next_place = clipped_to(list, place) end
    local is_wanted = chosen and chosen[entry] or not chosen and entry.visible
    if is_wanted and is_open(entry) and #clipped == 0 then
      add_cels(entry.children, nil, options, cels)
    elseif is_wanted then
      cels[#cels + 1] = cel_of(entry, clipped, options)
    elseif chosen and entry.children then
      add_cels(entry.children, chosen, options, cels)
    end
    place = next_place
  end
end

--- The entries that `only` names, as keys.
local function choose(tree, only)
  local chosen = {}
  for i, path in ipairs(only) do
    local entry = type(path) == "string" and find(tree, path) or nil
    if not entry then
      native.refuse(("layers: only[%d] must be the path of a layer, got %s"):format(i,
        type(path) == "string" and ("%q"):format(path) or fields.kind(path)))
    end
    chosen[entry] = true
  end
  return chosen
end

--- A cel for each visible layer, rearmost first. A group with opacity is one cel. `only` selects
--- layers and groups, whether they are visible or not; the other fields are passed to each cel.
---@param options? { only?: string[], front?: any, back?: any, viewport?: number[], defocus?: any, opacity?: number }
---@return celspan.cel[] cels
function methods:cels(options)
  fields.self("layers", Tree, self, "cels")
  options = options or {}
  fields.check("layers: cels", options, known)
  local cels = {}
  add_cels(self, options.only and choose(self, options.only), options, cels)
  return cels
end

return fields.publish("layers", layers, methods)
