--- Which pieces of two drawings (nodes of morph.lua without names) belong together, by place,
--- length and direction: the pairs of which no exchange of two partners lessens the sum of costs.
local lengths = require "celspan.outline_lengths"

local likeness = {}

local APART = 2   -- a cost from which two pieces make no pair
local LOOSE = 0.5 -- a cost from which a pair is not sure
local CLEAR = 0.5 -- an exchange that adds less than this share of the costs makes pairs unsure
local GIVEN = -200 -- the cost of a pair of the script

--- The measures of nodes without names. A direction is a vector at twice its angle, so that a line
--- has the same one from both ends; it is short for what is as wide as it is high.
local function measured(nodes)
  local list = {}
  for _, node in ipairs(nodes) do
    local left, top, w, h = node.object:bounds()
    local x, y = (left or 0) + (w or 0) / 2, (top or 0) + (h or 0) / 2
    local length, along, across, spread = 1e-9, 0, 0, 1e-9
    for _, contour in ipairs(left and node.contours or {}) do
      length = length + lengths.measure(contour).length
      for i = 1, #contour, 2 do
        local dx, dy = contour[i] - x, contour[i + 1] - y
        along, across = along + dx * dx - dy * dy, across + 2 * dx * dy
        spread = spread + dx * dx + dy * dy
      end
    end
    list[#list + 1] = node.name == "" and { node = node, x = x, y = y, length = length,
      along = along / spread, across = across / spread } or nil
  end
  return list
end

--- A function of the indices of two pieces: their cost. given: contours by their partners.
local function coster(first, second, given, size)
  return function(i, j)
    local p, q = first[i], second[j]
    if not p or not q then return 0 end
    local target = q.node.contours
    if target and given[p.node.contours or p] == target then return GIVEN end
    local x, y = (p.x - q.x) / size, (p.y - q.y) / size
    local turned = (p.along - q.along) ^ 2 + (p.across - q.across) ^ 2
    local longer = math.log(p.length / q.length)
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
--- to steering.unsure as pairs of places: the middles of both.
function likeness.partners(p, others, steering)
  local first, second, found = measured(p), measured(others), {}
  local _, _, w, h = p.object:bounds()
  local cost = coster(first, second, steering.given, math.max(w or 0, h or 0, 1e-9))
  local match = best_match(cost, math.max(#first, #second))
  for i, one in ipairs(first) do
    local other = second[match[i]]
    if other and cost(i, match[i]) < APART then
      found[one.node] = other.node
      if not is_sure(cost, match, i) then
        table.insert(steering.unsure, { { one.x, one.y }, { other.x, other.y } })
      end
    end
  end
  return found
end

return likeness
