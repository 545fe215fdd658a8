--- Whether a document is a Lottie animation that can be drawn: its size, its times, and how much it
--- holds when all of its compositions are unfolded.
local native = require "celspan.native"
local values = require "celspan.lottie_values"

local check = {}

check.most_layers = 200000 -- with all compositions unfolded
local MOST_DEPTH = 200 -- compositions in compositions
local MOST_SIZE = 1048576 -- units, as for films
local MOST_FRAMES = 10000000

local function is_number(value) return type(value) == "number" and value == value end

--- A number of the document within a range; raises a table with the message.
local function number(document, name, least, most)
  local value = document[name]
  if not is_number(value) then
    error({ message = ("%s must be a number, got %s"):format(name, type(value)) }, 0)
  end
  if value < least or value > most then
    error({ message = ("%s is %.14g; it must be from %.14g to %.14g"):format(name, value, least,
      most) },
      0)
  end
  return value
end

--- The layers of a list, and of the compositions that they show.
local function count(list, assets, counted, depth)
  local total = 0
  for _, one in ipairs(values.items(list)) do
    total = total + 1
    local id = one[2].ty == 0 and one[2].refId
    if id and assets[id] then
      if counted[id] == nil then
        counted[id] = 0 -- of a composition in itself, which is left out
        counted[id] = count(assets[id].item.layers, assets, counted, depth + 1)
      end
      total = total + counted[id]
    end
    if depth > MOST_DEPTH then
      error({ message = ("layers: compositions are nested more than %d deep; that is the limit")
        :format(MOST_DEPTH), is_excess = true }, 0)
    end
    if total > check.most_layers then
      error({ message = ("layers: with all compositions unfolded there are more than %d; that is "
        .. "the limit"):format(check.most_layers), is_excess = true }, 0)
    end
  end
  return total
end

local function examine(document, assets)
  if not values.table(document) or document[1] ~= nil then
    error({ message = "it is no Lottie animation: the JSON is no object" }, 0)
  end
  if not values.table(document.layers) then
    error({ message = "it is no Lottie animation: it has no list 'layers'" }, 0)
  end
  local facts = { width = number(document, "w", 1, MOST_SIZE),
                  height = number(document, "h", 1, MOST_SIZE),
                  fps = number(document, "fr", 1e-3, 1000) }
  local first, last = number(document, "ip", -MOST_FRAMES, MOST_FRAMES),
    number(document, "op", -MOST_FRAMES, MOST_FRAMES)
  facts.first, facts.last = values.frame(first, first), values.frame(last, last)
  if facts.last <= facts.first then
    error({ message = ("op is %.14g; it must be after ip, %.14g"):format(last, first) }, 0)
  end
  facts.layers = count(document.layers, assets, {}, 1)
  return facts
end

--- The size, the times and the number of layers of a document.
---@param document any
---@param assets table<any, table>
---@return table? facts
---@return string? message
function check.examine(document, assets)
  local good, result = pcall(examine, document, assets)
  if good then return result end
  if type(result) ~= "table" then error(result, 0) end
  if result.is_excess then return native.excess(result.message) end
  return nil, result.message
end

return require "celspan.fields".seal("lottie_check", check)
