--- What is the same thing in the frames of a film: tracks.
--
--   frame 1    sky  hill  hand            An item is the one before it of the same name or line, in
--   frame 2    sky  hill  bird  hand      the order of drawing. In each frame the items of tracks
--   tracks     sky  hill  bird  hand      lie in the order of the tracks.
--
-- An item: id, name, map, fade, data, front; placed: what it is in its group, without that group's
-- transform. A track: id, name, and items by frames.
local affine = require "celspan.affine"

local tracks = {}

local function id_of(placed, kind)
  return placed.name and "'" .. placed.name or ("%s %d"):format(kind, placed.line or 0)
end

local outlines = {} -- the kept ones, by their points from the first one on

local SAME = 2 ^ -20 -- how far places may be apart, as a share of an outline's size

local TURN = 0.3719 -- where between powers of two steps change: sides are often powers of two

--- A step that places of an outline are counted in; equal for outlines of nearly the same size.
local function step_of(contours)
  local size, first = 0, nil
  for _, contour in ipairs(contours) do
    first = first or contour[1] and contour
    for i, value in ipairs(contour) do size = math.max(size, math.abs(value - first[2 - i % 2])) end
  end
  return size > 0 and 2.0 ^ math.floor(math.log(size, 2) + TURN) * SAME or 1
end

--- A text that is equal for outlines that differ by their place alone.
local function key_of(data, x, y)
  local fill, step = data.fill, step_of(data.contours)
  local parts = { data.rule or "", fill.kind, ("%g"):format(step) }
  local function add(value) parts[#parts + 1] = ("%.0f"):format(value / step) end
  for _, contour in ipairs(data.contours) do
    parts[#parts + 1] = "M"
    for i = 1, #contour, 2 do
      add(contour[i] - x)
      add(contour[i + 1] - y)
    end
  end
  for _, stop in ipairs(fill.stops) do
    for _, value in ipairs(stop) do parts[#parts + 1] = ("%.9g"):format(value) end
  end
  for i, value in ipairs(fill.points or {}) do add(value - (i % 2 == 1 and x or y)) end
  add(fill.radius or 0)
  return (table.concat(parts, " "):gsub("%-0%f[ \0]", "0"))
end

--- The outline that is kept for all that differ from it by their place.
local function same(data)
  if not data.same then
    local first = data.contours[1]
    local x, y = first and first[1] or 0, first and first[2] or 0
    local key = key_of(data, x, y)
    local kept = outlines[key] or { data = data, x = x, y = y }
    outlines[key] = kept
    data.same, data.place = kept.data, affine.translation(x - kept.x, y - kept.y)
  end
  return data.same
end

--- A cel, or an object in the group `around`, as an item. fade: of that group.
function tracks.item(placed, around, fade)
  local data = placed.data or placed -- a cel is its own data
  local map = around and affine.compose(around.map, placed.matrix) or placed.matrix
  local kept = data
  if data.kind == "outline" then
    kept = same(data)
    map = affine.compose(map, data.place)
  end
  return { id = id_of(placed, data.kind or "cel"), name = placed.name or around and around.name,
           map = map,
           fade = placed.fade * fade, data = kept, placed = placed,
           front = around and around.front or placed.front }
end

--- lists: of frames, each a list of items or nil; count: of the frames.
function tracks.align(lists, count)
  local list = {}
  for frame = 1, count do
    local at = 0
    for _, item in ipairs(lists[frame] or {}) do
      local found
      for k = at + 1, #list do
        if list[k].id == item.id then
          found = k
          break
        end
      end
      if not found then
        found = at + 1
        table.insert(list, found, { id = item.id, name = item.name, items = {} })
      end
      list[found].items[frame], at = item, found
    end
  end
  return list
end

--- The first and the last frame of a track.
function tracks.range(track)
  local first, last = math.huge, 0
  for frame in pairs(track.items) do first, last = math.min(first, frame), math.max(last, frame) end
  return first, last
end

local function is_equal(a, b)
  for k = 1, #a do
    if a[k] ~= b[k] then return false end
  end
  return #a == #b
end

--- Whether two placed objects are the same in the same place.
function tracks.is_same(a, b)
  return a == b or a.data == b.data and a.fade == b.fade and is_equal(a.matrix, b.matrix)
end

--- The parts of a track in which `key` of an item is the same, in the order of their first frames.
function tracks.parted(track, key)
  local list, known = {}, {}
  local first, last = tracks.range(track)
  for frame = first, last do
    local item = track.items[frame]
    local value = item and key(item)
    if value and not known[value] then
      known[value] = { id = track.id, name = track.name, items = {} }
      list[#list + 1] = known[value]
    end
    if value then known[value].items[frame] = item end
  end
  return list
end

return tracks
