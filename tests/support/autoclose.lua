--- A second opinion of closed gaps: the method that the manual of OpenToonz describes for its
--- Autoclose, of a distance and an angle. From each end of a line it looks ahead, within half of
--- the angle to both sides: the nearest end of another line that looks back in the same way is
--- joined to it; from an end that is left, the nearest point of another line ahead. The ends are
--- known here, as no reader of pixels can know them.
local ANGLE = 60 -- degrees

local function ends_of(lines)
  local list = {}
  local function add(line, at, from)
    local x, y = at[1] - from[1], at[2] - from[2]
    local length = (x * x + y * y) ^ 0.5
    if length > 0 then
      list[#list + 1] = { line = line, at = at, along = { x / length, y / length } }
    end
  end
  for _, line in ipairs(lines) do
    local count = #line
    if count > 1 then
      add(line, line[1], line[math.min(count, 5)])
      add(line, line[count], line[math.max(1, count - 4)])
    end
  end
  return list
end

--- How far a point is ahead of an end; nil if it is not, or farther than a distance.
local function ahead(one, to, distance)
  local x, y = to[1] - one.at[1], to[2] - one.at[2]
  local length = (x * x + y * y) ^ 0.5
  local along = x * one.along[1] + y * one.along[2]
  if length > 0 and length <= distance and along >= length * math.cos(math.rad(ANGLE / 2)) then
    return length
  end
end

local function join_ends(ends, distance, segments)
  local pairs_found = {}
  for i, one in ipairs(ends) do
    for k = i + 1, #ends do
      local other = ends[k]
      local length = ahead(one, other.at, distance)
      if length and ahead(other, one.at, distance) then
        pairs_found[#pairs_found + 1] = { length = length, one = one, other = other }
      end
    end
  end
  table.sort(pairs_found, function(a, b) return a.length < b.length end)
  for _, found in ipairs(pairs_found) do
    local one, other = found.one, found.other
    if not one.is_closed and not other.is_closed then
      one.is_closed, other.is_closed = true, true
      segments[#segments + 1] = { one.at, other.at }
    end
  end
end

local function join_line(one, lines, distance, segments)
  local best, to = distance, nil
  for _, line in ipairs(lines) do
    for _, point in ipairs(line ~= one.line and line or {}) do
      local length = ahead(one, point, best)
      if length then best, to = length, point end
    end
  end
  if to then segments[#segments + 1] = { one.at, to } end
end

--- The segments that close the gaps of lines, which are lists of points a pixel or less apart.
return function(lines, distance)
  local ends, segments = ends_of(lines), {}
  join_ends(ends, distance, segments)
  for _, one in ipairs(ends) do
    if not one.is_closed then join_line(one, lines, distance, segments) end
  end
  return segments
end
