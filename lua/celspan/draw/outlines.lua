--- Two outlines point by point, for celspan.morph.
--
-- A contour is a list of numbers: x, y, and six for each of its cubics. Both are measured by their
-- length; nodes are set on them in equal steps and at their corners; and the best way through the
-- pairs of nodes is found, in which places, directions and corners agree:
--
--     nodes of b               A way goes from the first pair of nodes to the last one, in steps
--       |          ___o        of 1 to REACH nodes on either. Corners that it leaves out cost most.
--       |     o---'            Between the nodes of the way length goes with length. All joints of
--       |   .'                 either are joints of both in the end, and their control points move
--       o--'______ nodes of a  on straight lines.
local curves = require "celspan.curves"
local lengths = require "celspan.outline_lengths"
local ordered = require "celspan.ordered"

local distance, measure, nearest = lengths.distance, lengths.measure, lengths.nearest
local parameter, piece_at = lengths.parameter, lengths.piece_at
local place_at, point_on = lengths.place_at, lengths.point_on

local outlines = { distance = lengths.from_contour }

local NODES = 32
local REACH = 3
-- the greatest difference between the lengths of a pair of nodes, as a share of the length
local BAND = 0.2
local NEVER = 1e9  -- the cost of a pair that is not allowed
local CORNER = 0.2 -- radians
local SAME = 1e-7  -- a share of the whole length
local TRIED = 0.1  -- a share of the length, on both sides of the turn that fits best

-- ---------------------------------------------------------------- nodes

local function direction(way, s)
  local step = 1e-3
  local function at(share)
    return place_at(way, way.open and math.max(0, math.min(1, share)) or share % 1)
  end
  local x0, y0 = at(s - step)
  local x1, y1 = at(s)
  local x2, y2 = at(s + step)
  local before, after = math.atan(y1 - y0, x1 - x0), math.atan(y2 - y1, x2 - x1)
  local turn = (after - before + math.pi) % (2 * math.pi) - math.pi
  if x0 == x1 and y0 == y1 or x1 == x2 and y1 == y2 then turn = 0 end
  return math.atan(y2 - y0, x2 - x0), math.abs(turn) > CORNER and turn or 0
end

local function add_node(way, nodes, s, anchor)
  local x, y = place_at(way, s)
  local angle, turn = direction(way, s)
  nodes[#nodes + 1] = { s = s, angle = angle, turn = turn, anchor = anchor,
                        x = (x - way.x) / way.size, y = (y - way.y) / way.size }
end

--- The nodes of a way, ascending: at anchors, at corners, and in equal steps between them. anchors:
--- shares of the length.
local function nodes_of(way, anchors)
  local nodes, list = {}, {}
  for i, s in ipairs(anchors) do add_node(way, nodes, s, i) end
  for _, piece in ipairs(way) do
    local s = piece.start / way.length
    local _, turn = direction(way, s)
    if turn ~= 0 or s == 0 then add_node(way, nodes, s) end
  end
  for i = 1, NODES - 1 do add_node(way, nodes, i / NODES) end
  if way.open then add_node(way, nodes, 1) end
  table.sort(nodes, function(p, q)
    if p.s ~= q.s then return p.s < q.s end
    return (p.anchor or math.huge) < (q.anchor or math.huge)
  end)
  for _, node in ipairs(nodes) do
    local last = list[#list]
    local is_near = last and node.s - last.s < 0.3 / NODES
    if is_near and not last.anchor and (node.anchor or node.turn ~= 0 and last.turn == 0) then
      list[#list] = node
    elseif not is_near or node.anchor or node.turn ~= 0 and last.s < node.s - SAME then
      list[#list + 1] = node
    end
  end
  return list
end

--- The nodes in their order, beginning with one of them, once around.
local function from_node(nodes, first, is_open)
  if is_open then return nodes end
  local list = {}
  for i = 0, #nodes do
    local at = (first + i - 1) % #nodes + 1
    local copy = { s = nodes[at].s + (first + i > #nodes and 1 or 0) }
    list[i + 1] = setmetatable(copy, { __index = nodes[at] })
  end
  return list
end

-- ---------------------------------------------------------------- the best way

--- The cost of a pair of nodes for each share of the length around it, and a cost that is counted
--- once.
local function misfit(p, q)
  local x, y, turn = p.x - q.x, p.y - q.y, p.turn - q.turn
  return x * x + y * y + 0.3 * (1 - math.cos(p.angle - q.angle)), turn * turn / 10
end

--- The shares of the nodes, and for each node the total cost of omitting all nodes before it.
local function columns(nodes)
  local shares, sums, sum = {}, {}, 0
  for i, node in ipairs(nodes) do
    shares[i], sums[i] = node.s, sum
    sum = sum + (node.anchor and NEVER or node.turn ^ 2 / 10)
  end
  sums[#nodes + 1] = sum
  return shares, sums
end

--- The cheapest step to the pair i, j: its cost, and how many nodes it goes back on each side.
--- There is a row of costs for each node of p.
local function best_step(p, q, costs, i, j)
  local best, back, over = NEVER, nil, nil
  local s, t = p.shares[i], q.shares[j]
  for di = 1, i > REACH and REACH or i - 1 do
    local row, ds = costs[i - di], s - p.shares[i - di]
    local left_out = p.sums[i] - p.sums[i - di + 1]
    for dj = 1, j > REACH and REACH or j - 1 do
      local before = row[j - dj]
      if before then
        local dt = t - q.shares[j - dj]
        local cost = before + left_out + q.sums[j] - q.sums[j - dj + 1] + (ds + dt) * p.smooth
          + (ds - dt) * (ds - dt) * (NODES / 4)
        if cost < best then best, back, over = cost, di, dj end
      end
    end
  end
  return best, back, over
end

local function trace_back(from, p, q, i, j)
  local back, way = {}, {}
  while true do
    back[#back + 1] = { p[i], q[j] }
    local step = from[i][j]
    if not step then break end
    i, j = i - step // (REACH + 1), j - step % (REACH + 1)
  end
  for k = #back, 1, -1 do way[#way + 1] = back[k] end
  return way
end

--- The best way from the first to the last nodes of both: a list of { share of p, share of q }, and
--- its cost; nil if there is no way, or no way with a cost below `limit`. is_free: pairs that are
--- far apart by length are not tried.
local function find_way(p, q, is_free, limit)
  local one, other, costs, from = {}, {}, { { 0 } }, { {} }
  one.shares, one.sums = columns(p)
  other.shares, other.sums = columns(q)
  local least = { 0 } -- the least cost in each row
  for i = 2, #p do
    costs[i], from[i], least[i] = {}, {}, NEVER
    local far = p[i].s - p[1].s + q[1].s
    for j = 2, #q do
      local node = q[j]
      if p[i].anchor == node.anchor and not (is_free and math.abs(far - node.s) > BAND) then
        local smooth, sharp = misfit(p[i], node)
        one.smooth = smooth
        local cost, di, dj = best_step(one, other, costs, i, j)
        if di then
          cost = cost + sharp
          costs[i][j], from[i][j] = cost, di * (REACH + 1) + dj
          if cost < least[i] then least[i] = cost end
        end
      end
    end
    -- Every way passes one of REACH consecutive rows, and costs only grow.
    if i >= REACH and math.min(table.unpack(least, i - REACH + 1, i)) >= limit then
      return nil, math.huge
    end
  end
  local cost = costs[#p][#q]
  if not cost or cost >= NEVER then return nil, math.huge end
  return trace_back(from, one.shares, other.shares, #p, #q), cost
end

--- The share by which q is turned so that it fits p best as a whole.
local function best_turn(p, q)
  local function places(way)
    local list = {}
    for k = 0, NODES - 1 do
      local x, y = place_at(way, k / NODES)
      list[k] = { (x - way.x) / way.size, (y - way.y) / way.size }
    end
    return list
  end
  local one, other, best, turn = places(p), places(q), math.huge, 0
  for shift = 0, NODES - 1 do
    local sum = 0
    for k = 0, NODES - 1 do
      local m, n = one[k], other[(k + shift) % NODES]
      sum = sum + (m[1] - n[1]) ^ 2 + (m[2] - n[2]) ^ 2
    end
    if sum < best - 1e-9 then best, turn = sum, shift / NODES end
  end
  return turn
end

--- The best way around two closed contours: it begins at the sharpest corner of the first.
local function find_round(p, q, one, other)
  local turn, first = best_turn(p, q), 1
  for i, node in ipairs(one) do
    if math.abs(node.turn) > math.abs(one[first].turn) then first = i end
  end
  local start, found, best = from_node(one, first), nil, math.huge
  for j, node in ipairs(other) do
    local off = math.abs((node.s - one[first].s - turn + 0.5) % 1 - 0.5)
    if off <= TRIED then
      local way, cost = find_way(start, from_node(other, j), true, best)
      local _, sharp = misfit(one[first], node)
      if way and cost + sharp < best then found, best = way, cost + sharp end
    end
  end
  return found
end

local function find_best(p, q, anchors, refuse)
  local mine, yours = {}, {}
  for i, anchor in ipairs(anchors) do mine[i], yours[i] = anchor[1], anchor[2] end
  local one, other = nodes_of(p, mine), nodes_of(q, yours)
  local is_open = p.open or q.open
  local way
  if #anchors > 1 then -- the script gives the places; between them, lengths decide
    for _, nodes in ipairs { one, other } do
      for _, node in ipairs(nodes) do node.x, node.y = 0, 0 end
    end
  end
  if #anchors > 0 and not is_open then
    local function first(nodes)
      for i, node in ipairs(nodes) do if node.anchor == 1 then return i end end
    end
    way = find_way(from_node(one, first(one)), from_node(other, first(other)), false, NEVER)
  elseif not is_open then
    way = find_round(p, q, one, other)
  else
    if not p.open then one = from_node(one, 1) end
    if not q.open then other = from_node(other, 1) end
    way = find_way(one, other, false, NEVER)
  end
  return way or refuse "the pairs cross: their places must follow each other in one order on both"
end

local WAYS_MOST = 1000 -- the most ways that are kept
local kept = { count = 0 }

--- A contour as a string: equal only for equal numbers.
local function digits_of(contour)
  local parts = { contour.closed and "closed" or "open" }
  for i = 1, #contour, 2 do
    parts[#parts + 1] = ("dd"):pack(contour[i], contour[i + 1])
  end
  return table.concat(parts)
end

--- The best way. It is kept for parts that are the same in the next frame.
local function best_way(p, q, anchors, refuse)
  if #anchors > 0 then return find_best(p, q, anchors, refuse) end
  local key = digits_of(p.contour) .. "|" .. digits_of(q.contour)
  if not kept[key] then
    if kept.count == WAYS_MOST then kept = { count = 0 } end
    kept[key], kept.count = find_best(p, q, anchors, refuse), kept.count + 1
  end
  return kept[key]
end

-- ---------------------------------------------------------------- cuts

--- The share on the other side that corresponds to a share on side k of a way.
local function carried(way, k, s)
  for i = 2, #way do
    local p, q = way[i - 1], way[i]
    if s <= q[k] or i == #way then
      local u = q[k] > p[k] and (s - p[k]) / (q[k] - p[k]) or 0
      return p[3 - k] + u * (q[3 - k] - p[3 - k])
    end
  end
end

--- An order in which only equal cuts are alike: table.sort takes long lists apart by the clock.
local function is_before(m, n)
  local one, other = m[1] + m[2], n[1] + n[2]
  if one ~= other then return one < other end
  return m[1] < n[1] or m[1] == n[1] and m[2] < n[2]
end

--- The places at which both contours are cut: the joints of both, ascending.
local function cuts_of(way, p, q)
  local first, last, list, cuts = way[1], way[#way], {}, {}
  for k, side in ipairs { p, q } do
    for _, piece in ipairs(side) do
      for round = 0, 1 do
        local s = piece.start / side.length + round
        if s > first[k] + SAME and s < last[k] - SAME then
          local cut = { carried(way, k, s), nil }
          cut = k == 1 and { s, cut[1] } or { cut[1], s }
          list[#list + 1] = cut
        end
      end
    end
  end
  for i = 2, #way - 1 do list[#list + 1] = way[i] end
  table.sort(list, is_before)
  cuts[1] = first
  for _, cut in ipairs(list) do
    local before = cuts[#cuts]
    if cut[1] - before[1] > SAME or cut[2] - before[2] > SAME then cuts[#cuts + 1] = cut end
  end
  cuts[#cuts + 1] = last
  return cuts
end

--- Appends the control points of the part of a piece between two parameters, after its first one.
local function append_part(list, c, i, from, to)
  local x0, y0 = point_on(c, i, from)
  local x3, y3 = point_on(c, i, to)
  local function slope(t)
    local s = 1 - t
    local p, q, r = s * s, 2 * s * t, t * t
    return p * (c[i + 2] - c[i]) + q * (c[i + 4] - c[i + 2]) + r * (c[i + 6] - c[i + 4]),
      p * (c[i + 3] - c[i + 1]) + q * (c[i + 5] - c[i + 3]) + r * (c[i + 7] - c[i + 5])
  end
  local ax, ay = slope(from)
  local bx, by = slope(to)
  local h = to - from
  local part = { x0 + h * ax, y0 + h * ay, x3 - h * bx, y3 - h * by, x3, y3 }
  table.move(part, 1, 6, #list + 1, list)
end

--- Cuts one side.
local function cut_side(side, cuts, k)
  local list = { place_at(side, cuts[1][k] % 1) }
  if side.open then list = { place_at(side, cuts[1][k]) } end
  for i = 2, #cuts do
    local from, to = cuts[i - 1][k], cuts[i][k]
    local turns = side.open and 0 or math.floor((from + to) / 2)
    from, to = from - turns, to - turns
    local piece = piece_at(side, (from + to) / 2)
    append_part(list, side.contour, piece.at, parameter(side, piece, from),
      parameter(side, piece, to))
  end
  return list
end

-- ---------------------------------------------------------------- contours

--- The numbers of a contour that has no partner, all at one point: the point in `other`, the other
--- outline's largest contour, that corresponds to the contour's middle in `own`, its own outline's
--- largest contour.
local function shrunk(way, own, other)
  local x, y, list = way.x, way.y, {}
  if other then
    local scale = own.size > 0 and other.size / own.size or 1
    x, y = other.x + (x - own.x) * scale, other.y + (y - own.y) * scale
  end
  for i = 1, #way.contour, 2 do list[i], list[i + 1] = x, y end
  return list
end

local function measure_all(contours)
  local ways, largest = {}, nil
  for _, contour in ipairs(contours) do
    local way = measure(contour)
    if way.length > 0 then
      ways[#ways + 1] = way
      if not largest or math.abs(way.area) > math.abs(largest.area) then largest = way end
    end
  end
  return ways, largest
end

--- How different two contours of two outlines are; first, second: the largest contours of the
--- outlines.
local function unlikeness(p, q, first, second)
  local x = (p.x - first.x) / first.size - (q.x - second.x) / second.size
  local y = (p.y - first.y) / first.size - (q.y - second.y) / second.size
  local is_other = (p.area > 0) ~= (q.area > 0) and not p.open and not q.open
  return x * x + y * y + math.log(p.size / first.size / (q.size / second.size)) ^ 2 / 4
    + (is_other and 100 or 0)
end

--- The pairs of places for these contours, given to the ways to which they are nearest:
--- anchors[p][q] is a list of shares.
local function anchors_of(ones, others, contours, places)
  local function find(ways, x, y)
    local best, way, share = math.huge, nil, nil
    for _, candidate in ipairs(ways) do
      local s, far = nearest(candidate, x, y)
      if far < best then best, way, share = far, candidate, s end
    end
    return way, share
  end
  local anchors = {}
  for _, place in ipairs(places) do
    if place.contours == contours and #others > 0 then
      local p, s = find(ones, place[1], place[2])
      local q, t = find(others, place[3], place[4])
      anchors[p] = anchors[p] or {}
      anchors[p][q] = anchors[p][q] or {}
      table.insert(anchors[p][q], { s, t })
    end
  end
  return anchors
end

--- The pairs of contours that are most similar, and the remaining contours.
local function pair_up(ones, others, first, second, anchors)
  local list, taken, found = {}, {}, {}
  for _, p in ipairs(ones) do
    for _, q in ipairs(others) do
      local is_given = anchors[p] and anchors[p][q]
      list[#list + 1] = { p, q, cost = is_given and -1 or unlikeness(p, q, first, second) }
    end
  end
  for _, pair in ipairs(ordered.sort(list, "cost")) do
    if not taken[pair[1]] and not taken[pair[2]] then
      taken[pair[1]], taken[pair[2]] = true, true
      found[#found + 1] = pair
    end
  end
  return found, taken
end

--- Makes open lines begin at the ends that are nearer to each other, and closed ones turn in the
--- same direction.
local function turn_lines(ones, others)
  for i, q in ipairs(others) do
    local p = ones[math.min(i, #ones)]
    local a, b = p and p.contour, q.contour
    if p and p.open and q.open then
      local n, m = #a, #b
      local same = distance(a[1], a[2], b[1], b[2]) + distance(a[n - 1], a[n], b[m - 1], b[m])
      local other = distance(a[1], a[2], b[m - 1], b[m]) + distance(a[n - 1], a[n], b[1], b[2])
      if other < same then others[i] = measure(curves.reversed(b)) end
    end
  end
end

--- Makes the argument of outlines.between. steering.places: { x, y, x, y, contours = the contours
--- of `a` that it is for }.
function outlines.match(a, b, steering, refuse)
  local ones, first = measure_all(a)
  local others, second = measure_all(b)
  if first and second and (first.area > 0) ~= (second.area > 0) then
    local all = {}
    for i, way in ipairs(others) do
      all[i] = way.open and way.contour or curves.reversed(way.contour)
    end
    others, second = measure_all(all)
  end
  turn_lines(ones, others)
  local anchors = anchors_of(ones, others, a, steering.places)
  local found, taken = pair_up(ones, others, first, second, anchors)
  local match = {}
  for _, pair in ipairs(found) do
    local p, q = pair[1], pair[2]
    local way = best_way(p, q, anchors[p] and anchors[p][q] or {}, refuse)
    local cuts = cuts_of(way, p, q)
    match[#match + 1] = { cut_side(p, cuts, 1), cut_side(q, cuts, 2), open = p.open or q.open }
  end
  for k, ways in ipairs { ones, others } do
    for _, way in ipairs(ways) do
      if not taken[way] then
        local own = way.contour
        local none = shrunk(way, k == 1 and first or second, k == 1 and second or first)
        match[#match + 1] = { k == 1 and own or none, k == 1 and none or own, open = way.open }
      end
    end
  end
  return match
end

--- The contours between the sides of a match. way: a field of arcs.lua.
function outlines.between(match, way)
  local contours = {}
  for n, pair in ipairs(match) do
    local p, q, contour = pair[1], pair[2], { closed = not pair.open }
    for i = 1, #p, 2 do
      local x, y = q[i] - p[i], q[i + 1] - p[i + 1]
      local along, across = way(p[i], p[i + 1])
      contour[i] = p[i] + x * along - y * across
      contour[i + 1] = p[i + 1] + y * along + x * across
    end
    contours[n] = contour
  end
  return contours
end

return outlines
