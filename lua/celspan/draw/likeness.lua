--- Which pieces of two drawings (nodes of morph.lua without names) belong together, by place,
--- length and direction: the pairs of which no exchange of two partners lessens the sum of costs.
local lengths = require "celspan.outline_lengths"

local likeness = {}

local APART = 2   -- a cost from which two pieces make no pair
local LOOSE = 0.5 -- a cost from which a pair is not sure
local CLEAR = 0.5 -- an exchange that adds less than this share of the costs makes pairs unsure
local MOST_LONGER = math.log(5) -- the one shrinks and the other grows where lengths differ more
local GIVEN = -200 -- the cost of a pair of the script

--- Appends the outlines of a node and of all nodes in it: lists of contours.
local function outlines_of(node, list)
  list[#list + 1] = node.contours
  for _, child in ipairs(node) do outlines_of(child, list) end
  return list
end

--- The place halfway along the longest of the contours. Where pairs are read, it is on this piece,
--- and on no other one.
local function place_on(outlines)
  local longest
  for _, outline in ipairs(outlines) do
    for _, contour in ipairs(outline) do
      local way = lengths.measure(contour)
      if way.length > (longest and longest.length or 0) then longest = way end
    end
  end
  return longest and { lengths.place_at(longest, 0.5) }
end

--- The measures of a node. A direction is a vector at twice its angle, so that a line has the same
--- one from both ends; it is short for what is as wide as it is high.
local function measured(node)
  local left, top, w, h = node.object:bounds()
  local x, y = (left or 0) + (w or 0) / 2, (top or 0) + (h or 0) / 2
  local length, along, across, spread = 1e-9, 0, 0, 1e-9
  local outlines = outlines_of(node, {})
  for _, outline in ipairs(outlines) do
    for _, contour in ipairs(outline) do
      length = length + lengths.measure(contour).length
      for i = 1, #contour, 2 do
        local dx, dy = contour[i] - x, contour[i + 1] - y
        along, across = along + dx * dx - dy * dy, across + 2 * dx * dy
        spread = spread + dx * dx + dy * dy
      end
    end
  end
  return { node = node, x = x, y = y, length = length, outlines = outlines,
           along = along / spread, across = across / spread }
end

--- The measures of the nodes without names.
local function all_measured(nodes)
  local list = {}
  for _, node in ipairs(nodes) do
    list[#list + 1] = node.name == "" and measured(node) or nil
  end
  return list
end

--- The indices of the partners that the script gives, by those of the first pieces. given: outlines
--- by their partners.
local function given_partners(first, second, given)
  local owners, partners = {}, {}
  for j, piece in ipairs(second) do
    for _, outline in ipairs(piece.outlines) do owners[outline] = j end
  end
  for i, piece in ipairs(first) do
    for _, outline in ipairs(piece.outlines) do
      partners[i] = partners[i] or owners[given[outline]]
    end
  end
  return partners
end

--- A function of the indices of two pieces: their cost.
local function coster(first, second, given, size)
  local partners = given_partners(first, second, given)
  return function(i, j)
    local p, q = first[i], second[j]
    if not p or not q then return 0 end
    if partners[i] == j then return GIVEN end
    local x, y = (p.x - q.x) / size, (p.y - q.y) / size
    local turned = (p.along - q.along) ^ 2 + (p.across - q.across) ^ 2
    local longer = math.log(p.length / q.length)
    if math.abs(longer) > MOST_LONGER then return APART end
    return math.min(APART, 2 * (x * x + y * y) + longer * longer / 4 + turned / 8)
  end
end

--- What the exchange of two partners adds to their costs, and these.
local function exchanged(cost, match, i, j)
  local now = cost(i, match[i]) + cost(j, match[j])
  return cost(i, match[j]) + cost(j, match[i]) - now, now
end

local function is_sure(cost, match, i)
  for j = 1, #match do
    local more, now = exchanged(cost, match, i, j)
    if j ~= i and now > 1e-9 and more < CLEAR * now then return false end
  end
  return cost(i, match[i]) < LOOSE
end

local function best_match(cost, count)
  local match, is_better = {}, true
  for i = 1, count do match[i] = i end
  while is_better do
    is_better = false
    for i = 1, count do
      for j = i + 1, count do
        if exchanged(cost, match, i, j) < -1e-9 then
          match[i], match[j], is_better = match[j], match[i], true
        end
      end
    end
  end
  return match
end

--- The partners of the nodes of p without names, among `others`. Pairs that are not sure are added
--- to steering.unsure as pairs of places on both, which steering.places may have.
function likeness.partners(p, others, steering)
  local first, second, found = all_measured(p), all_measured(others), {}
  local _, _, w, h = p.object:bounds()
  local cost = coster(first, second, steering.given, math.max(w or 0, h or 0, 1e-9))
  local match = best_match(cost, math.max(#first, #second))
  for i, one in ipairs(first) do
    local other = second[match[i]]
    if other and cost(i, match[i]) < APART then
      found[one.node] = other.node
      if not is_sure(cost, match, i) then
        table.insert(steering.unsure, { place_on(one.outlines) or { one.x, one.y },
                                        place_on(other.outlines) or { other.x, other.y } })
      end
    end
  end
  return found
end

return likeness
