-- Quarter turns: sixty-four quarters of discs turn, and circles become pinwheels, leaves, and
-- circles again. Every tile makes four quarter turns, each a little later than its neighbour
-- nearer the middle, so the last frame leads into the first one without a seam. One of them has a
-- mind of its own.
local score = require "sound.score"

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
local function art_of(column, row, is_voice)
  local a, b = column // 2, row // 2
  local pair = colours[1 + (2 * a + 3 * b + (a * b) // 3) % #colours]
  return prints[1 + (a + 2 * b + a // 2) % #prints](pair[1], is_voice and PAPER or pair[2])
end

-- A quarter turn: a moment's wait, over the goal, and home. A turn back before it would open
-- slivers in the discs.
local quarter_turn = keys { { 0, 0 }, { 0.09, 0 }, { 0.6, 1.02, "inOutCubic" },
  { 0.7, 1, "inOutSine" } }

-- The one voice against the choir: two turns with the others, then one the other way and too late,
-- when all the others rest, and then a whirl of three quarters, and it is home with them.
local own_way = keys { { 2, 2 }, { 2.55, 2 }, { 2.64, 2.05, "outSine" },
  { 2.95, 0.95, "inOutCubic" }, { 3.02, 1, "inOutSine" }, { 3.16, 1 }, { 3.26, 0.9, "outSine" },
  { 3.8, 4.06, "inOutCubic" }, { 3.92, 4, "inOutSine" } }

--- The quarter turns that a tile has made, four in the whole film with rests between them; and how
--- large it is while it turns: the voice comes forward.
local function turns(share, late, is_voice)
  local u = (4 * share - late) % 4
  local is_alone = is_voice and u >= 2
  local made = is_alone and own_way:at(u) or u // 1 + quarter_turn:at(u % 1)
  return made, 1 + (is_alone and 0.34 or -0.16) * math.sin(math.pi * (made % 1)) ^ 2
end

--- A tile, its quarter in the middle of the block of two by two when it is at rest.
local tiles = {} -- the voice is the last one, above its neighbours
for row = 0, COUNT - 1 do
  for column = 0, COUNT - 1 do
    local across, down = column % 2, row % 2
    local start = 90 * (down == 0 and 2 + across or 1 - across)
    local is_pinwheel = (column // 2 + row // 2) % 2 == 0 -- others open like a book
    local is_voice = column == 3 and row == 3
    local from_middle = math.max(math.abs(column - 3.5), math.abs(row - 3.5)) - 0.5
    table.insert(tiles, is_voice and #tiles + 1 or 1, { start = start, late = 0.085 * from_middle,
      is_voice = is_voice,
      way = (is_pinwheel or across == down) and 1 or -1,
      x = MARGIN + (column + 0.5) * TILE, y = MARGIN + (row + 0.5) * TILE,
      art = art_of(column, row, is_voice):translate(-TILE / 2, -TILE / 2) })
  end
end

local function frame(f)
  local share = f.index / f.count -- of the loop: after the last frame it would be 1, which is 0
  local shown = { rect { 0, 0, SIZE, SIZE, fill = PAPER } }
  for _, tile in ipairs(tiles) do
    local made, size = turns(share, tile.late, tile.is_voice)
    shown[#shown + 1] = tile.art:rotate(tile.start + tile.way * 90 * made):scale(size)
      :translate(tile.x, tile.y)
  end
  return cel(shown)
end

--- Four brushed clicks of wood for each turn, from the middle outwards, and a bell for the voice.
local function wood()
  local sound, step = score(6), 1.5
  for turn = 0, 3 do
    for ring = 0, 3 do
      local time = step * (turn + 0.5 + 0.085 * ring)
      for _, side in ipairs { -1, 1 } do
        sound:add(time, score.click(0.3 + 0.1 * ring, 0.14), 0.3, 0.3 * ring * side)
      end
      sound:add(time, score.thump(({ 262, 330, 294, 392 })[turn + 1] + 40 * ring, 0.07), 0.22)
    end
  end
  sound:add(step * 2.85, score.bell("G5", 0.7), 0.2)
  for i, tone in ipairs { "D5", "E5", "G5", "C6" } do
    sound:add(step * (3.2 + 0.13 * i), score.bell(tone, 0.18 + 0.06 * i), 0.16)
  end
  return sound:address()
end

return film { title = "Quarter turns", size = { SIZE, SIZE }, fps = 24, duration = 6,
  sound = wood(), frame = frame }
