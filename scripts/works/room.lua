-- Room: a sentence that says no is pushed aside by its own last word. Bold type on a grid: each
-- letter fills a cell, and when one cell grows its neighbours give way. The letters have an axis of
-- widths, so they become narrow and broad and keep their stems.
local score = require "sound.score"

local FONT, BEAT = "../type/poster.ttf", 0.5
local W, H, EDGE, GAP = 1280, 720, 24, 10
local INK, PAPER, RED, YELLOW = "#17130f", "#f3ecdd", "#e63312", "#ffc400"

--- A key that moves a share to a value at a beat, within a length in beats.
local function at(beat, value, length, curve)
  return { from = beat, value = value, length = length or 0.5, ease = curve or "outBack" }
end

--- How much room a letter or a row wants, by the beats.
local function share(moves, beat)
  local value = 0
  for _, move in ipairs(moves) do
    local u = motion.span(beat, move.from, move.length, move.ease)
    value = value + (move.value - value) * u
  end
  return math.max(value, 0)
end

-- The rows: what each wants of the height, and its letters, with what they want of the width.
-- "ROOM" takes a breath at 9, is pushed back at 10, and takes all at 11.
local rows = {
  { height = { at(-1, 1), at(12, 0.62, 1) },
    { "T", at(-1, 1) }, { "H", at(0.5, 1) }, { "E", at(1, 1) }, { "R", at(1.5, 1) },
    { "E", at(1.75, 1) } },
  { height = { at(3, 1), at(12, 0.62, 1) },
    { "I", at(3.5, 0.085) }, { "S", at(3, 1) } },
  { height = { at(4, 1), at(12, 1.9, 1) },
    { "N", at(4, 1), at(9, 0.8), at(10, 1.2), at(11, 0, 0.6, "inOutCubic"), is_no = true },
    { "O", at(4.2, 1), at(9, 0.8), at(10, 1.3), at(11.2, 0, 0.6, "inOutCubic"), is_no = true },
    { "R", at(5.5, 0.3), at(11, 1, 1) },
    { "O", at(5.75, 0.3), at(9, 0.65), at(10, 0.2), at(11, 1.3, 1), at(13.5, 2, 0.7),
      at(14.25, 1.1, 0.7), at(15.5, 1.3, 0.7) },
    { "O", at(6, 0.3), at(9, 0.65), at(10, 0.2), at(11, 1.3, 1), at(13.5, 1.1, 0.7),
      at(14.25, 1.5, 0.7), at(15.5, 1.3, 0.7) },
    { "M", at(6.25, 0.3), at(11, 1.1, 1) } },
}

local AXIS = { 70, 100, 225 }
local widths = {}

--- A letter at a size of 1000, as broad as the axis says: its outline from 0, 0.
local function drawn(letter, wdth)
  return text { letter, 0, 700, font = FONT, size = 1000, variations = { wdth = wdth } }
end

--- A letter that fills a box: the width on the axis that comes nearest, and the rest by scaling.
local function fitted(letter, x, y, w, h, fill)
  if w < 2 or h < 4 then return end
  local known = widths[letter]
  if not known then
    known = {}
    for i, wdth in ipairs(AXIS) do known[i] = select(3, drawn(letter, wdth):bounds()) end
    widths[letter] = known
  end
  local wanted = w / h * 700
  local wdth = keys { { known[1], AXIS[1] }, { known[2] + 0.01, AXIS[2] },
    { known[3] + 0.02, AXIS[3] } }:at(wanted)
  local shape = drawn(letter, wdth)
  local left, top, wide, high = shape:bounds()
  return shape:translate(-left, -top):scale(w / wide, h / high):translate(x, y):paint(fill)
end

--- One row of letters, side by side over the whole width.
local function set_row(art, row, beat, y, height, ink)
  local sum, wants = 0, {}
  for i, letter in ipairs(row) do
    wants[i] = share(table.move(letter, 2, #letter, 1, {}), beat)
    sum = sum + wants[i]
  end
  if sum == 0 then return end
  local x, room = EDGE, W - 2 * EDGE + GAP
  for i, letter in ipairs(row) do
    local w = room * wants[i] / sum
    if letter.is_no and w > GAP then
      art[#art + 1] = rect { x - GAP / 2, y - GAP / 2, w, height + GAP, fill = INK }
    end
    local inset = letter.is_no and math.min(12, w / 8) or 0
    art[#art + 1] = fitted(letter[1], x + inset, y + inset, w - GAP - 2 * inset,
      height - 2 * inset, letter.is_no and PAPER or ink)
    x = x + w
  end
end

--- The sound of each letter that arrives, and of the pushes.
local function music()
  local sound = score(8.5)
  local function beat(n, voice, volume, pan) sound:add(n * BEAT, voice, volume, pan) end
  for i, n in ipairs { 0, 0.5, 1, 1.5, 1.75, 3, 3.5, 4, 4.2 } do
    beat(n, score.thump(i > 7 and 52 or 78, 0.4), 0.7)
    beat(n, score.click(0.5, 0.05), 0.25, i % 2 * 0.6 - 0.3)
  end
  for i = 0, 3 do beat(5.5 + i / 4, score.click(0.9, 0.04), 0.3, 0.2 * i) end
  beat(9, score.slide(180, 300, 0.3), 0.35)
  beat(10, score.slide(260, 90, 0.35), 0.4)
  beat(11, score.slide(90, 700, 0.5), 0.3)
  for i, hertz in ipairs { 65.4, 130.8, 196, 261.6, 329.6 } do
    beat(12, score.bass(hertz, 2), 0.34 / i ^ 0.5, 0.15 * (i - 3))
  end
  beat(12, score.thump(46, 0.6), 0.8)
  beat(13.5, score.bass(98, 0.4), 0.3, -0.4)
  beat(14.25, score.bass(130.8, 0.6), 0.3, 0.4)
  beat(15.5, score.bass(65.4, 0.7), 0.3)
  return sound:address()
end

local function frame(f)
  local beat = f.time / BEAT
  local art, heights, sum = { rect { 0, 0, W, H, fill = PAPER } }, {}, 0
  for i, row in ipairs(rows) do
    heights[i] = share(row.height, beat)
    sum = sum + heights[i]
  end
  local y, room = EDGE, H - 2 * EDGE + GAP
  for i, row in ipairs(rows) do
    local height = room * heights[i] / sum
    if i == 3 then -- light opens out of the middle of ROOM, up and down, behind all rows
      local u, middle = motion.span(beat, 11.8, 0.8, "inOutCubic"), y + height / 2
      table.insert(art, 2, rect { 0, middle * (1 - u), W, H * u, fill = YELLOW })
    end
    set_row(art, row, beat, y, height - GAP, i == 3 and RED or INK)
    y = y + height
  end
  return cel(art)
end

return film { title = "Room", size = { W, H }, fps = 24, duration = 8.5, sound = music(),
  frame = frame }
