--- Artwork as a film of one frame: what `celspan render drawing.svg` shows.
--
--   artwork.film "hero.svg"       -- .svg, .ora, .kra, .psd: the whole file at its own size
local celspan = require "celspan"
local fields = require "celspan.fields"
local layers = require "celspan.layers"
local parameters = require "celspan.parameters"
local svg = require "celspan.svg"

local artwork = {}

--- The result of a reader. Raises an error with the reader's message, and without a line of this
--- file.
local function needed(value, message)
  return value or error((message:gsub("^celspan/artwork%.lua:%d+: ", "")), 0)
end

--- A drawing, its size, and sentences about what is left out. The parameter `font` of the film is a
--- file for all texts.
local function drawing(path)
  local font = parameters.declare { font = { "", about = "A font file for the texts" } }.font
  local art = needed(svg.read(path, { fonts = font ~= "" and { default = font } or nil }))
  local notes = {}
  for i, note in ipairs(art.skipped) do
    local lacks_font = note.what:find("no font is given", 1, true)
    notes[i] = ("line %d: %s%s"):format(note.line, note.what,
      lacks_font and ": 'celspan render --set font=FILE' gives one" or "")
  end
  return { celspan.cel { art.object } }, art.width, art.height, notes
end

local function painting(path)
  local tree = needed(layers.read(path))
  local notes = {}
  for i, note in ipairs(tree.skipped) do
    notes[i] = note.layer == "" and note.what or note.layer .. ": " .. note.what
  end
  local cels = tree:cels()
  cels.space = "srgb" -- as in painting programs, and as `tree.object` is
  return cels, tree.width, tree.height, notes
end

--- What is not shown of it is passed to `show`.
---@param path string Beside the script, else relative to the current folder
---@param is_drawing boolean SVG, and not a painting
---@param show fun(line: string)
---@return celspan.film film
function artwork.film(path, is_drawing, show)
  local cels, width, height, notes = (is_drawing and drawing or painting)(path)
  for _, note in ipairs(notes) do show(("%s: not shown: %s"):format(path, note)) end
  local rostrum = celspan.rostrum(cels)
  return celspan.film {
    size = { math.max(1, math.ceil(width)), math.max(1, math.ceil(height)) },
    title = path:match "[^/]*$", frame = function() return rostrum end,
  }
end

return fields.seal("artwork", artwork)
