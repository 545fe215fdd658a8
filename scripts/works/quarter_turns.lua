-- Quarter turns: sixty-four quarters of discs turn, and circles become pinwheels, leaves, and
-- circles again. Every tile makes four quarter turns, each a little later than its neighbour
-- nearer the middle, so the last frame leads into the first one without a seam.

local SIZE, COUNT = 1080, 8
local TILE = 116
local MARGIN = (SIZE - COUNT * TILE) / 2
local PAPER = "#f4e8d3"
local CORAL, PINK, GREEN, GOLD, INK = "#f2542d", "#f5a6b4", "#0e7c5b", "#f2b134", "#2b1b2e"

--- A quarter of a disc about the corner 0, 0 of a tile, with radius r.
local function quarter(r, fill)
  return path { d = ("M0 0 H%g A%g %g 0 0 1 0 %g Z"):format(r, r, r, r), fill = fill }
end

--- Four prints of a quarter: whole, striped, with a rim, and with a seed.
local prints = {
  function(colour) return quarter(TILE, colour) end,
  function(colour)
    local rings = {}
    for i = 4, 1, -1 do
      rings[#rings + 1] = quarter(TILE * i / 4, colour)
      rings[#rings + 1] = quarter(TILE * (i / 4 - 1 / 8), PAPER)
    end
    return union(rings)
  end,
  function(colour)
    return quarter(TILE, colour) | quarter(TILE * 0.62, PAPER) | quarter(TILE * 0.36, colour)
  end,
  function(colour, other)
    return quarter(TILE, colour) | circle { TILE * 0.43, TILE * 0.43, TILE * 0.2, fill = other }
  end,
}

local colours = { { CORAL, GOLD }, { GREEN, PINK }, { PINK, INK }, { INK, CORAL }, { GOLD, GREEN } }

--- Which print and colours a tile has: blocks of two by two are alike, so that they can be discs.
local function art_of(column, row)
  local a, b = column // 2, row // 2
  local pair = colours[1 + (2 * a + 3 * b + (a * b) // 3) % #colours]
  return prints[1 + (a + 2 * b + a // 2) % #prints](pair[1], pair[2])
end

--- The quarter turns that a tile has made: four in the whole film, with rests between them.
local function turns(share, late)
  local u = (4 * share - late) % 4
  local whole = u // 1
  return whole + ease "inOutBack"(math.min(1, (u - whole) / 0.7))
end

--- A tile, its quarter in the middle of the block of two by two when it is at rest.
local tiles = {}
for row = 0, COUNT - 1 do
  for column = 0, COUNT - 1 do
    local across, down = column % 2, row % 2
    local start = 90 * (down == 0 and 2 + across or 1 - across)
    local is_pinwheel = (column // 2 + row // 2) % 2 == 0 -- others open like a book
    local from_middle = math.max(math.abs(column - 3.5), math.abs(row - 3.5)) - 0.5
    tiles[#tiles + 1] = { start = start, late = 0.085 * from_middle,
      way = (is_pinwheel or across == down) and 1 or -1,
      x = MARGIN + (column + 0.5) * TILE, y = MARGIN + (row + 0.5) * TILE,
      art = art_of(column, row):translate(-TILE / 2, -TILE / 2) }
  end
end

local function frame(f)
  local share = f.index / f.count -- of the loop: after the last frame it would be 1, which is 0
  local shown = { rect { 0, 0, SIZE, SIZE, fill = PAPER } }
  for _, tile in ipairs(tiles) do
    local u = turns(share, tile.late)
    local lifted = 1 - 0.16 * math.sin(math.pi * (u % 1)) ^ 2
    shown[#shown + 1] = tile.art:rotate(tile.start + tile.way * 90 * u):scale(lifted)
      :translate(tile.x, tile.y)
  end
  return cel(shown)
end

return film { title = "Quarter turns", size = { SIZE, SIZE }, fps = 24, duration = 6,
  frame = frame }
