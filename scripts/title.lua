-- A title whose letters arrive one by one: each falls into its place, turning, and changes its
-- colour there; then a line of small letters is spelled out below. celspan.glyphs returns the
-- letters of a text in their places, so nothing has to be spaced by hand.

local FPS = 24
local FONT = "type/block.ttf"
local CREAM, NIGHT = "#f6ead2", "#16202e"

local title = glyphs { "Long Night", 480, 280, font = FONT, size = 150,
  align = "centre", tracking = 20, variations = { wght = 800 },
  fill = linear { from = { 0, 170 }, to = { 0, 280 }, { 0, "#ffd98a" },
    { 1, "#ff7d4a" } } }
local under = glyphs { "a film in forty drawings", 480, 360, font = FONT, size = 40,
  align = "centre", tracking = 140, fill = CREAM }

--- A letter on its way from above, turning, to its place.
local function arriving(letter, i, time)
  local u = motion.span(time, 0.12 * i - 0.08, 0.6)
  if u == 0 then return end
  local k = ease "outBack"(u)
  local x = letter.middle
  local side = i % 2 == 0 and 1 or -1
  return letter.object:rotate(side * 70 * (1 - k), x, letter.y):translate(0, -260 * (1 - k))
    :fade(math.min(1, 3 * u))
end

local sky = rect { 0, 0, 960, 540,
  fill = linear { from = { 0, 0 }, to = { 0, 540 }, { 0, NIGHT }, { 1, "#3a3450" } } }
local hill = path { d = "M0 470 C200 400 380 500 560 455 S820 420 960 470 V540 H0 Z",
  fill = "#0d1420" }

local function frame(f)
  local art = { sky, hill }
  for i, letter in ipairs(title) do art[#art + 1] = arriving(letter, i, f.time) end
  for i, letter in ipairs(under) do
    art[#art + 1] = letter.object:fade(motion.span(f.time, 1.9 + 0.05 * i, 0.15))
  end
  return cel(art)
end

return film { title = "Letter by letter", size = { 960, 540 }, fps = FPS, frames = 5 * FPS,
  frame = frame }
