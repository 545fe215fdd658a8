-- A title whose letters arrive one by one: each falls into its place, turning, and changes its
-- colour there; then a line of small letters is spelled out below. celspan.glyphs returns the
-- letters of a text in their places, so nothing has to be spaced by hand.
local celspan = require "celspan"
local ease = require "celspan.ease"

local FPS = 24
local FONT = "type/block.ttf"
local CREAM, NIGHT = "#f6ead2", "#16202e"

--- 0 before `from`, 1 after `from + length`, in seconds.
local function share(time, from, length)
  return math.max(0, math.min(1, (time - from) / length))
end

local title = celspan.glyphs { "Long Night", font = FONT, size = 150, at = { 480, 280 },
  align = "centre", tracking = 20, variations = { wght = 800 },
  texture = celspan.linear { from = { 0, 170 }, to = { 0, 280 }, { 0, "#ffd98a" },
    { 1, "#ff7d4a" } } }
local under = celspan.glyphs { "a film in forty drawings", font = FONT, size = 40,
  at = { 480, 360 },
  align = "centre", tracking = 140, texture = CREAM }

--- A letter on its way from above, turning, to its place.
local function arriving(letter, i, time)
  local u = share(time, 0.12 * i - 0.08, 0.6)
  if u == 0 then return end
  local k = ease "outBack"(u)
  local x = letter.x + letter.advance / 2
  local side = i % 2 == 0 and 1 or -1
  return letter.object:rotate(side * 70 * (1 - k), x, letter.y):translate(0, -260 * (1 - k))
    :fade(math.min(1, 3 * u))
end

local sky = celspan.rect { 0, 0, 960, 540,
  texture = celspan.linear { from = { 0, 0 }, to = { 0, 540 }, { 0, NIGHT }, { 1, "#3a3450" } } }
local hill = celspan.path { d = "M0 470 C200 400 380 500 560 455 S820 420 960 470 V540 H0 Z",
  texture = "#0d1420" }

local function frame(f)
  local art = { sky, hill }
  for i, letter in ipairs(title) do art[#art + 1] = arriving(letter, i, f.time) end
  for i, letter in ipairs(under) do
    art[#art + 1] = letter.object:fade(share(f.time, 1.9 + 0.05 * i, 0.15))
  end
  return celspan.rostrum { celspan.cel(art) }
end

return celspan.film { title = "Letter by letter", size = { 960, 540 }, fps = FPS, frames = 5 * FPS,
  frame = frame }
