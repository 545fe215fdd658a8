--- Pictures with details at scales of their own: the field `details` of celspan.picture.
--
--   +------------------+     The texture is a pattern of the picture and of its details, later
--   |   +--+           |     ones over earlier ones; each reads its own pixels, of the level that
--   |   +--+   ++      |     a frame needs.
--   |          ++      |
--   +------------------+
local celspan = require "celspan"
local fields = require "celspan.fields"

local details = {}

local AROUND = 512 -- boxes to each side that are clear

--- A picture in its box, as an object. noun: for messages.
local function placed(given, noun)
  fields.expect_kind(type(given) == "table", given, "%s must be {box =, file =}", noun)
  local box = given.box
  fields.numbers(noun, "field 'box'[%d]", box, 4, "a box {x, y, width, height}")
  return celspan.rect { box[1], box[2], box[3], box[4], texture = celspan.picture(given) }
end

--- The texture of a picture with the field `details`.
---@param given table As for celspan.picture
---@return celspan.texture
function details.texture(given)
  fields.expect_kind(type(given.details) == "table", given.details,
    "picture: field 'details' must be a list of {box =, file =}")
  fields.must(given.wrap ~= "clamp", "picture: with details, field 'wrap'",
    '"clear" or "repeat"', given.wrap)
  local base = {}
  for name, value in next, given do base[name] = value end
  base.details = nil
  local parts = { placed(base, "picture") }
  for i, detail in ipairs(given.details) do
    parts[i + 1] = placed(detail, ("picture: detail %d"):format(i))
  end
  local x, y, w, h = table.unpack(given.box)
  local n = given.wrap == "repeat" and 0 or AROUND
  return celspan.pattern { art = celspan.union(parts),
    box = { x - n * w, y - n * h, (2 * n + 1) * w, (2 * n + 1) * h } }
end

return fields.seal("details", details)
