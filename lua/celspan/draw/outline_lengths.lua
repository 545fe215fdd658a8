--- Contours by their lengths: a way is a contour with the length of each of its pieces, and a place
-- on it is a share of the whole length.
local ordered = require "celspan.ordered"

local lengths = {}

local CHORDS = 8 -- of a piece

function lengths.point_on(c, i, t)
  local s = 1 - t
  local p, q, r, v = s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t
  return p * c[i] + q * c[i + 2] + r * c[i + 4] + v * c[i + 6],
    p * c[i + 1] + q * c[i + 3] + r * c[i + 5] + v * c[i + 7]
end

function lengths.distance(x, y, u, v) return math.sqrt((x - u) ^ 2 + (y - v) ^ 2) end

--- The contour with the control points of its straight pieces at their thirds, so that even steps
--- of the parameter are even on them, too.
local function evened(contour)
  local list = table.move(contour, 1, #contour, 1, { closed = contour.closed })
  for i = 1, #list - 6, 6 do
    local x, y, u, v = list[i], list[i + 1], list[i + 6], list[i + 7]
    if x == list[i + 2] and y == list[i + 3] and u == list[i + 4] and v == list[i + 5] then
      list[i + 2], list[i + 3] = x + (u - x) / 3, y + (v - y) / 3
      list[i + 4], list[i + 5] = x + 2 * (u - x) / 3, y + 2 * (v - y) / 3
    end
  end
  return list
end

--- The contour as pieces with their positions, as shares of its length. Each piece has its own
--- lengths at even parameters.
function lengths.measure(given)
  local contour = evened(given)
  local way = { contour = contour, open = not contour.closed, length = 0, area = 0 }
  local left, top, right, bottom = math.huge, math.huge, -math.huge, -math.huge
  for i = 1, #contour - 6, 6 do
    local piece, x, y = { at = i, start = way.length, [0] = 0 }, contour[i], contour[i + 1]
    for k = 1, CHORDS do
      local nx, ny = lengths.point_on(contour, i, k / CHORDS)
      piece[k] = piece[k - 1] + lengths.distance(x, y, nx, ny)
      way.area = way.area + (x * ny - y * nx) / 2
      left, right = math.min(left, x, nx), math.max(right, x, nx)
      top, bottom = math.min(top, y, ny), math.max(bottom, y, ny)
      x, y = nx, ny
    end
    if piece[CHORDS] > 0 then
      way[#way + 1] = piece
      way.length = way.length + piece[CHORDS]
    end
  end
  way.x, way.y = (left + right) / 2, (top + bottom) / 2
  way.size = math.max(right - left, bottom - top)
  return way
end

--- The piece at a share of the length.
function lengths.piece_at(way, s)
  return way[math.max(1, ordered.last(way, s * way.length, "start"))]
end

--- The parameter of a piece at a share of the whole length, between 0 and 1.
function lengths.parameter(way, piece, s)
  local rest = s * way.length - piece.start
  if rest <= 0 then return 0 end
  for k = 1, CHORDS do
    if rest < piece[k] then
      return (k - 1 + (rest - piece[k - 1]) / (piece[k] - piece[k - 1])) / CHORDS
    end
  end
  return 1
end

function lengths.place_at(way, s)
  local piece = lengths.piece_at(way, s)
  return lengths.point_on(way.contour, piece.at, lengths.parameter(way, piece, s))
end

--- The share of the length at the point that is nearest to a place, and the distance of this point.
function lengths.nearest(way, x, y)
  local best, at = math.huge, 0
  for _, piece in ipairs(way) do
    for k = 0, CHORDS do
      local d = lengths.distance(x, y, lengths.point_on(way.contour, piece.at, k / CHORDS))
      if d < best then best, at = d, (piece.start + piece[k]) / way.length end
    end
  end
  return at, best
end

--- The distance of a place from a contour.
function lengths.from_contour(contour, x, y)
  local _, far = lengths.nearest(lengths.measure(contour), x, y)
  return far
end

return lengths
