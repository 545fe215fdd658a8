--- Labels that do not collide: measured, thinned out and moved apart.
--
--      wanted           placed          Along a line each label is as near to its place as it can
--       A                A              be while the ones beside it have room; labels that touch
--       B  C             B              are moved by as little as possible.
--                        C
local celspan = require "celspan"
local fields = require "celspan.fields"

local labels = {}

--- A text, and the width of it. style: font, size, texture.
function labels.text(words, style, at, align, valign)
  return celspan.text { words, font = style.font, size = style.size, texture = style.texture,
                        at = at, align = align, valign = valign }
end

--- How wide a text is.
function labels.width(words, style)
  return labels.text(words, style, { 0, 0 }):metrics().width
end

--- Every how many labels one must be kept so that none touches the next. gap: the least distance
--- between two; distance: between the middles of neighbours.
function labels.every(widths, distance, gap)
  local most = 0
  for _, width in ipairs(widths) do most = math.max(most, width) end
  if distance <= 0 then return math.max(1, #widths) end
  return math.max(1, math.ceil((most + gap) / distance - 1e-9))
end

--- Places that are `gap` apart and nearest to the wanted ones, which ascend, within low..high; nil
--- if there is no room. Places less the gaps before them must not descend. The list that is nearest
--- by squares has the mean of each run that would.
---@param wanted number[]
---@param gap number
---@param low number
---@param high number
---@return number[]? places
function labels.spread(wanted, gap, low, high)
  if (#wanted - 1) * gap > high - low then return nil end
  local runs, places = {}, {}
  for i, at in ipairs(wanted) do
    local run = { sum = at - gap * (i - 1), count = 1 }
    while runs[1] and runs[#runs].sum / runs[#runs].count >= run.sum / run.count do
      local last = table.remove(runs)
      run = { sum = last.sum + run.sum, count = last.count + run.count }
    end
    runs[#runs + 1] = run
  end
  for _, run in ipairs(runs) do
    local at = math.max(low, math.min(high - gap * (#wanted - 1), run.sum / run.count))
    for _ = 1, run.count do places[#places + 1] = at + gap * #places end
  end
  return places
end

return fields.seal("labels", labels)
