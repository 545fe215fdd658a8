--- The contents of a painting or a drawing, as the lines that `celspan info` prints.
--
--   inform.painting "forest.kra"     -> text | nil, message
--   inform.drawing "hero.svg"
local layers = require "celspan.layers"
local svg = require "celspan.svg"
local fields = require "celspan.fields"

local inform = {}

--- Names and sentences come from files: control characters, such as line ends, become spaces.
local function plain(text) return (text:gsub("[%c\127]", " ")) end

local function add(lines, format, ...) lines[#lines + 1] = format:format(...) end

local function whole(text, lines) return text .. table.concat(lines, "\n") .. "\n" end

-- ---------------------------------------------------------------- paintings

--- Layers and groups with their contents, rearmost first. counts: the numbers of layers and groups.
local function add_entries(lines, counts, list, path)
  for _, entry in ipairs(list) do
    local here = path .. entry.name
    local kind, place = "group", ""
    if entry.children then
      counts.groups = counts.groups + 1
      add_entries(lines, counts, entry.children, here .. "/")
    else
      local x, y, w, h = entry.object:bounds()
      kind = "layer"
      counts.layers = counts.layers + 1
      place = (" size %.9gx%.9g at %.9g,%.9g"):format(w or 0, h or 0, x or entry.x, y or entry.y)
    end
    add(lines, "%s%s blend %s opacity %.9g visible %s name %s", kind, place, plain(entry.blend),
      entry.opacity, entry.visible and "yes" or "no", plain(here))
  end
end

local function describe_painting(tree)
  local lines, counts = {}, { layers = 0, groups = 0 }
  add_entries(lines, counts, tree, "")
  for _, note in ipairs(tree.skipped) do
    add(lines, "skipped %s: %s", plain(note.layer), plain(note.what))
  end
  local size = tree.width and ("canvas %.9gx%.9g\n"):format(tree.width, tree.height) or ""
  return whole(("%slayers %d\ngroups %d\n"):format(size, counts.layers, counts.groups), lines)
end

--- The size of a picture comes from its file, which may be missing or damaged.
local function described(read, describe)
  return function(path)
    local value, message = read(path)
    if not value then return nil, message end
    local good, text = pcall(describe, value)
    if good then return text end
    return nil, tostring(text)
  end
end

---@type fun(path: string): (string?, string?) lines, or nil and a message
inform.painting = described(layers.read, describe_painting)

-- ---------------------------------------------------------------- drawings

local function describe_drawing(art)
  local names, lines = {}, {}
  for name in pairs(art.parts) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    local x, y, w, h = art.parts[name]:bounds()
    add(lines, "part size %.9gx%.9g at %.9g,%.9g name %s", w or 0, h or 0, x or 0, y or 0,
      plain(name))
  end
  for _, note in ipairs(art.skipped) do
    add(lines, "skipped line %d: %s", note.line, plain(note.what))
  end
  return whole(("format svg\nsize %.9gx%.9g\nparts %d\n"):format(art.width, art.height, #names),
    lines)
end

---@type fun(path: string): (string?, string?) lines, or nil and a message
inform.drawing = described(svg.read, describe_drawing)

return fields.seal("inform", inform)
