--- Layered paintings as objects and cels, layer by layer.
--
--   local tree = assert(layers.read "forest.kra") -- .ora, .psd, an OCA folder, numbered pictures
--   tree:find("far/hills").object
--   celspan.rostrum(tree:cels { front = { 1, 0.9, 0.8 } })
--
-- A tree is a list of layers and groups, rearmost first. Pixels are read when they are first
-- visible. `skipped` lists everything that looks different in the program that made the painting.
local celspan = require "celspan"
local core = require "celspan.core"
local fields = require "celspan.fields"
local oca = require "celspan.oca"

local layers = {}

---@class celspan.layers.entry
---@field name string
---@field object celspan.object The picture at its place, without opacity; or a group's visible layers
---@field x number Of its left edge, in pixels of the painting
---@field y number Of its top edge
---@field opacity number 0..1
---@field visible boolean
---@field blend string "normal", "multiply", "add", "screen", ...; of a group also "pass-through"
---@field children? celspan.layers.entry[] Of a group: rearmost first
local Entry = { __name = "celspan.layers.entry" }
Entry.__index = fields.reads("a layer", {}, { children = true })

---@class celspan.layers.tree
---@field width? number
---@field height? number
---@field skipped { layer: string, what: string }[]
local Tree = { __name = "celspan.layers.tree" }
local methods = {}
Tree.__index = fields.reads("a tree of layers", methods, { width = true, height = true })

--- The data of layers that are not in their entries: used to make cels, and hidden from scripts.
local sources = setmetatable({}, { __mode = "k" })

--- Blend modes that need no note; "pass-through" is for groups.
local plain = { normal = true, ["pass-through"] = true }
local shown = { normal = true, multiply = true, add = true }

-- ---------------------------------------------------------------- entries

--- The object of a layer as it is painted with others on one cel.
local function painted(entry)
  local object = entry.object
  local source = sources[entry]
  if entry.blend == "multiply" and source.picture then
    object = celspan.image(source.image("gel")):named(source.name)
  end
  return entry.opacity < 1 and object:fade(entry.opacity) or object
end

local function visible_objects(children)
  local list = {}
  for _, child in ipairs(children) do
    if child.visible then list[#list + 1] = painted(child) end
  end
  return list
end

--- A valid name for a value: not empty.
local function name_of(text, kind) return text ~= "" and text or kind end

--- given: name, x, y, opacity, visible, blend; and children, or picture (the fields of an image,
--- with x and y), or neither for an empty layer. smooth: the picture's field of this name.
local function make_entry(given, smooth)
  local source = { name = name_of(given.name, given.children and "group" or "layer"),
                   picture = given.picture }
  if given.picture then given.picture.smooth = smooth end
  function source.image(use)
    local image = { as = use }
    for name, value in pairs(given.picture) do image[name] = value end
    return image
  end
  local object
  if given.children then
    object = celspan.union(visible_objects(given.children))
  elseif given.picture then
    object = celspan.image(source.image("paint"))
  else
    object = given.object or celspan.union {}
  end
  local entry = setmetatable({ name = given.name, object = object:named(source.name), x = given.x,
    y = given.y, opacity = given.opacity, visible = given.visible, blend = given.blend,
    children = given.children }, Entry)
  sources[entry] = source
  return entry
end

-- ---------------------------------------------------------------- what is skipped

--- Adds notes on blend modes that are shown as normal, for the layers of a list. path: of the
--- group; is_faded: they are in a group that is shown as one picture.
local function note_blends(list, path, is_faded, skipped)
  for _, entry in ipairs(list) do
    local here = path .. entry.name
    local blend = entry.blend
    local known = entry.children and plain or shown
    local what
    if not known[blend] then
      what = ('blend mode "%s": it is shown as normal'):format(blend)
    elseif is_faded and blend == "multiply" then
      what = 'blend mode "multiply" in a group with opacity: correct only where the group covers '
        .. "its background"
    elseif is_faded and blend == "add" then
      what = 'blend mode "add" in a group with opacity: it is shown as normal'
    end
    if what then skipped[#skipped + 1] = { layer = here, what = what } end
    if entry.children then
      note_blends(entry.children, here .. "/", is_faded or entry.opacity < 1, skipped)
    end
  end
end

--- The rearmost visible picture of a list, and its path; nil where a group with opacity comes
--- first.
local function rearmost(list, path)
  for _, entry in ipairs(list) do
    if entry.visible and entry.children then
      if entry.opacity < 1 then return nil end
      local found, where = rearmost(entry.children, path .. entry.name .. "/")
      if found then return found, where end
    elseif entry.visible then
      return entry, path .. entry.name
    end
  end
end

--- Light over nothing has no alpha, where painting programs show it as paint.
local function note_light(list, skipped)
  local entry, path = rearmost(list, "")
  if entry and entry.blend == "add" then
    skipped[#skipped + 1] = { layer = path,
      what = 'blend mode "add" with no layer behind it: it is light without alpha' }
  end
end

local function make_tree(list, width, height, skipped)
  local tree = { width = width, height = height, skipped = skipped }
  for i, entry in ipairs(list) do tree[i] = entry end
  note_blends(list, "", false, skipped)
  note_light(list, skipped)
  return setmetatable(tree, Tree)
end

-- ---------------------------------------------------------------- paintings

--- The path of each layer of a painting, "group/layer".
local function paths_of(flat)
  local paths = {}
  for i = #flat, 1, -1 do -- groups come after their layers
    local parent = flat[i].parent
    paths[i] = parent and paths[parent] .. "/" .. flat[i].name or flat[i].name
  end
  return paths
end

local function from_painting(path, smooth)
  local painting, message = core.painting(path)
  if not painting then return nil, message end
  local flat, children, list = painting.layers, {}, {}
  for i, layer in ipairs(flat) do
    local picture = layer.pixels and { pixels = layer.pixels, colour = layer.colour, x = layer.x,
                                       y = layer.y, w = layer.width, h = layer.height }
    local entry = make_entry({ name = layer.name, x = layer.x, y = layer.y, picture = picture,
      opacity = layer.opacity, visible = layer.visible, blend = layer.blend,
      children = layer.group and (children[i] or {}) or nil }, smooth)
    local siblings = list
    if layer.parent then
      siblings = children[layer.parent] or {}
      children[layer.parent] = siblings
    end
    siblings[#siblings + 1] = entry
  end
  local skipped, paths = {}, paths_of(flat)
  for i, note in ipairs(painting.notes) do
    skipped[i] = { layer = note.layer and paths[note.layer] or "", what = note.what }
  end
  return make_tree(list, painting.width, painting.height, skipped)
end

-- ---------------------------------------------------------------- folders

--- File extensions of pictures; other files in a folder are skipped.
local endings = {}
for ending in ("png jpg jpeg tif tiff exr tga dpx cin webp bmp gif jp2 hdr"):gmatch "%a+%d?" do
  endings[ending] = true
end

--- A key that sorts "b10" after "b9": digits count as numbers.
local function natural_key(name)
  return (name:lower():gsub("%d+", function(digits)
    local number = digits:gsub("^0+", "")
    return ("%03d"):format(#number) .. number
  end))
end

local function sort_naturally(names)
  local keys = {}
  for _, name in ipairs(names) do keys[name] = natural_key(name) end
  table.sort(names, function(a, b)
    if keys[a] ~= keys[b] then return keys[a] < keys[b] end
    return a < b
  end)
end

--- The result of a function, or nil and the message of the error that it raised, without its line.
local function caught(make)
  local good, value = pcall(make)
  if good then return value end
  return nil, (tostring(value):gsub("^[^\n]-:%d+: ", "", 1))
end

local function from_folder(path, names, smooth)
  local list, skipped = {}, {}
  sort_naturally(names)
  for _, name in ipairs(names) do
    local base, ending = name:match "^(.*)%.(%w+)$"
    local file = path .. "/" .. name
    if not base or not endings[ending:lower()] then
      skipped[#skipped + 1] = { layer = name, what = "not a picture: it is left out" }
    elseif not core.within(path, name) then
      return nil, ("%s: %s lies outside the folder"):format(path, name)
    else
      local entry, message = caught(function()
        return make_entry({ name = base, x = 0, y = 0, opacity = 1, visible = true,
          blend = "normal", picture = { file = file, x = 0, y = 0 } }, smooth)
      end)
      if not entry then return nil, message end
      list[#list + 1] = entry
    end
  end
  if #list == 0 then return nil, path .. ": the folder holds no pictures" end
  return make_tree(list, nil, nil, skipped)
end

--- The document among the files of an OCA folder.
local function find_document(names)
  table.sort(names)
  for _, name in ipairs(names) do
    if name:match "%.oca$" then return name end
  end
  for _, name in ipairs(names) do
    if name:match "%.json$" and not name:match "_meta%.json$" then return name end
  end
end

local function from_oca(folder, document, smooth)
  local read, message = oca.read(folder, document)
  if not read then return nil, message end
  local function build(list)
    local entries = {}
    for i, layer in ipairs(list) do
      if layer.children then layer.children = build(layer.children) end
      entries[i] = make_entry(layer, smooth)
    end
    return entries
  end
  local entries
  entries, message = caught(function() return build(read.layers) end)
  if not entries then return nil, message end
  return make_tree(entries, read.width, read.height, read.skipped)
end

-- ---------------------------------------------------------------- the module

local function is_there(path)
  local file = io.open(path, "rb")
  if file then file:close() end
  return file ~= nil
end

local function read_any(path, smooth)
  local names, message = core.folder(path)
  if names then
    local document = find_document(names)
    if document then return from_oca(path, document, smooth) end
    return from_folder(path, names, smooth)
  end
  if message:find "limit" then return nil, message end
  if path:match "%.oca$" then
    local folder, document = path:match "^(.*)/([^/]*)$"
    return from_oca(folder or ".", document or path, smooth)
  end
  return from_painting(path, smooth)
end

--- `smooth`: alpha of 8 bits has no steps, so painted glows show no rings.
---@param path string Relative to the caller's file, else to the script
---@param options? { smooth?: boolean }
---@return celspan.layers.tree? tree
---@return string? message
function layers.read(path, options)
  if type(path) ~= "string" then
    core.refuse("layers: read takes the name of a file or folder, got " .. fields.kind(path))
  end
  options = options or {}
  fields.check("layers: read", options, { smooth = "boolean" })
  local found_at, tried = core.find(path)
  local tree, message = read_any(found_at, options.smooth)
  if not tree and tried and not is_there(found_at) then
    message = ("%s; also looked for at %s"):format(message, tried)
  end
  return tree, message
end

--- layers.read, where a painting that cannot be read is an error.
---@param path string Relative to the caller's file, else to the script
---@param options? { smooth?: boolean }
---@return celspan.layers.tree tree
function layers.load(path, options)
  local tree, message = layers.read(path, options)
  return tree or core.refuse("layers: " .. message)
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
  if type(path) ~= "string" then
    core.refuse("layers: find takes a path like \"group/layer\", got " .. fields.kind(path))
  end
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

--- The same, where one that is not there is an error.
---@param path string
---@return celspan.layers.entry entry
function methods:get(path)
  local entry = self:find(path)
  if entry then return entry end
  local paths = add_paths(self, "", {})
  local hint = core.nearest(path, paths)
  core.refuse(("layers: there is no layer %q%s"):format(path,
    hint and ("; did you mean %q?"):format(hint) or #paths > 0 and "; there are "
      .. table.concat(paths, ", ", 1, math.min(12, #paths)) or ""))
end

-- ---------------------------------------------------------------- cels

local known = { only = "table", front = "any", back = "any", viewport = "table", defocus = "any",
                opacity = "number" }

--- A cel that adds the light of a picture to the cels behind it and leaves their alpha unchanged.
local function light_cel(entry, source, options)
  local picture = source.picture
  local x, y, w, h = entry.object:bounds()
  local texture = celspan.picture { file = picture.file, pixels = picture.pixels,
    colour = picture.colour, box = { x, y, w, h }, smooth = picture.smooth }
  return celspan.cel { back = { texture = texture, gain = entry.opacity * (options.opacity or 1),
    on = "cel", matte = 0 }, viewport = options.viewport }:named(source.name)
end

local function cel_of(entry, options)
  local source = sources[entry]
  if entry.blend == "add" and source.picture then return light_cel(entry, source, options) end
  local object = entry.object
  if entry.blend == "multiply" and source.picture then
    object = celspan.image(source.image("gel")):named(source.name)
  end
  return celspan.cel { object, front = options.front, back = options.back,
    viewport = options.viewport, defocus = options.defocus,
    opacity = entry.opacity * (options.opacity or 1) }:named(source.name)
end

--- Whether each layer of a group becomes a separate cel.
local function is_open(entry) return entry.children and entry.opacity == 1 end

--- chosen: the entries to make cels of, as keys; nil: all visible ones.
local function add_cels(list, chosen, options, cels)
  for _, entry in ipairs(list) do
    local is_chosen = chosen and chosen[entry]
    local is_wanted = is_chosen or not chosen and entry.visible
    if is_wanted and is_open(entry) then
      add_cels(entry.children, nil, options, cels)
    elseif is_wanted then
      cels[#cels + 1] = cel_of(entry, options)
    elseif chosen and entry.children then
      add_cels(entry.children, chosen, options, cels)
    end
  end
end

--- The entries that `only` names, as keys.
local function choose(tree, only)
  local chosen = {}
  for i, path in ipairs(only) do
    local entry = type(path) == "string" and find(tree, path) or nil
    if not entry then
      core.refuse(("layers: only[%d] must be the path of a layer, got %s"):format(i,
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
