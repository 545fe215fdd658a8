--- The contents of a painting or a drawing, for `celspan info`.
--
--   inform.painting "forest.kra"     -> { canvas =, layers =, groups =, ... } | nil, message
--   inform.drawing "hero.svg"        -> { size =, parts =, ... } | nil, message
local layers = require "celspan.layers"
local svg = require "celspan.svg"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"

local inform = {}

-- ---------------------------------------------------------------- paintings

--- The size and the place of an object that has bounds; nothing for an empty one.
local function place_of(object, x0, y0)
  local x, y, w, h = object:bounds()
  return { w or 0, h or 0 }, { x or x0 or 0, y or y0 or 0 }
end

--- Adds layers and groups with their contents, rearmost first.
local function add_entries(found, list, path)
  for _, entry in ipairs(list) do
    local one = { kind = entry.children and "group" or "layer", name = path .. entry.name,
                  blend = entry.blend, opacity = entry.opacity, visible = entry.visible }
    if entry.children then
      found.groups = found.groups + 1
      add_entries(found, entry.children, one.name .. "/")
    else
      found.layers = found.layers + 1
      one.size, one.at = place_of(entry.object, entry.x, entry.y)
    end
    table.insert(found.entries, one)
  end
end

local function skipped_of(notes, place)
  local list = {}
  for i, note in ipairs(notes) do list[i] = { [place] = note[place], what = note.what } end
  return list
end

local function of_painting(tree)
  local found = { canvas = tree.width and { tree.width, tree.height }, layers = 0, groups = 0,
                  entries = {}, skipped = skipped_of(tree.skipped, "layer") }
  add_entries(found, tree, "")
  return found
end

--- The size of a picture comes from its file, which may be missing or damaged.
local function described(read, describe)
  return function(path)
    local value, message = read(path)
    if not value then return nil, message end
    local good, found = pcall(describe, value)
    if good then return found end
    return nil, tostring(found)
  end
end

inform.painting = described(layers.read, of_painting)

-- ---------------------------------------------------------------- drawings

local function of_drawing(art)
  local names, entries = ordered.names(art.parts), {}
  for i, name in ipairs(names) do
    local size, at = place_of(art.parts[name])
    entries[i] = { kind = "part", name = name, size = size, at = at }
  end
  return { size = { art.width, art.height }, seconds = art.seconds, parts = #names,
           entries = entries,
           skipped = skipped_of(art.skipped, "line") }
end

inform.drawing = described(svg.read, of_drawing)

return fields.seal("inform", inform)
