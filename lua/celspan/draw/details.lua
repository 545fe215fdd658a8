--- Pictures with details at scales of their own: the field `details` of celspan.picture.
--
--   +------------------+     The texture is a pattern of the picture and of its details, later
--   |   +--+           |     ones over earlier ones; each reads its own pixels, of the level that
--   |   +--+   ++      |     a frame needs.
--   |          ++      |
--   +------------------+
local celspan = require "celspan"
local fields = require "celspan.fields"
local native = require "celspan.native"

local details = {}

local MOST = 10000 -- details of a picture
local AROUND = 1 << 20 -- boxes to each side that are clear, within
local FAR = 4e11 -- units, since places are below 1e12

--- A picture in its box, as an object. noun: for messages.
local function placed(given, noun)
  fields.expect_kind(type(given) == "table", given, "%s must be {box =, file =}", noun)
  if given.details then native.refuse(noun .. " has details: list them all in the picture") end
  local box = given.box
  fields.numbers(noun, "field 'box'[%d]", box, 4, "a box {x, y, width, height}")
  fields.must(box[3] > 0 and box[4] > 0, noun .. ": width and height of its box", "above 0",
    math.min(box[3], box[4]))
  return celspan.rect { box[1], box[2], box[3], box[4], texture = celspan.picture(given) }
end

--- Raises an error unless the list of details is one.
local function check(list)
  fields.expect_kind(type(list) == "table", list,
    "picture: field 'details' must be a list of {box =, file =}")
  fields.must(#list <= MOST, "picture: the number of details", "at most " .. MOST, #list)
  for key in next, list do
    fields.expect_kind(math.type(key) == "integer" and key >= 1 and key <= #list, key,
      "picture: field 'details' must be a list of {box =, file =}; it has the key '%s'", key)
  end
end

--- The texture of a picture with the field `details`.
---@param given table As for celspan.picture
---@return celspan.texture
function details.texture(given)
  check(given.details)
  if given.wrap == "clamp" then
    native.refuse "picture: one with details cannot have wrap = \"clamp\": \"clear\" or \"repeat\""
  end
  local base = {}
  for name, value in next, given do base[name] = value end
  base.details = nil
  if #given.details == 0 then return celspan.picture(base) end
  local parts = { placed(base, "picture") }
  for i, detail in ipairs(given.details) do
    parts[i + 1] = placed(detail, ("picture: detail %d"):format(i))
  end
  local x, y, w, h = table.unpack(given.box)
  local n = given.wrap == "repeat" and 0 or math.min(AROUND, FAR // math.max(w, h))
  return celspan.pattern { art = celspan.union(parts),
    box = { x - n * w, y - n * h, (2 * n + 1) * w, (2 * n + 1) * h } }
end

return fields.seal("details", details)
