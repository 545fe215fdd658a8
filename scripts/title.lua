-- A title whose letters arrive one by one: each leaps up from behind a hill, lands on it with a
-- squash, and throws a long shadow; a line of small letters is spelled out below. celspan.glyphs
-- returns the letters of a text in their places, so nothing has to be spaced by hand.
local mood = require("stage.moods").harvest

local FPS = 24
local FONT = "type/poster.ttf"

local title = glyphs { "LONG NIGHT", 480, 300, font = FONT, size = 178,
  align = "centre", tracking = 10, variations = { wdth = 104 }, fill = mood.ink }
local under = glyphs { "a film in forty drawings", 480, 486, font = FONT, size = 34,
  align = "centre", tracking = 90, fill = mood.light }

local leap = keys { { 0, 230 }, { 0.55, -120, "outQuad" }, { 1, 0, "inQuad" } }

--- The height of the hill at x.
local function crest(x) return 352 - 34 * (1 - ((x - 480) / 480) ^ 2) end

--- A letter on its way up and down to its place, and its shadow.
local function arriving(letter, i, time)
  local begin = 0.14 * i - 0.1
  local u = motion.span(time, begin, 0.8)
  if u == 0 then return end
  local landed = math.max(0, time - begin - 0.8)
  local wobble = u == 1 and 0.22 * math.exp(-7 * landed) * math.cos(22 * landed) or 0
  local x, foot = letter.middle, crest(letter.middle) + 4
  local side = i % 2 == 0 and 1 or -1
  local high = leap:at(u)
  local stood = letter.object:translate(0, foot - letter.y):scale(1 + wobble, 1 - wobble, x, foot)
    :rotate((x - 480) / 100, x, foot)
  local shadow = stood:paint(mood.ink):scale(1, -0.62, x, foot):skew(-38, 0, x, foot)
    :fade(0.5 * math.max(0, 1 - math.abs(high) / 240))
  return stood:rotate(side * 24 * (1 - u), x, foot - 70):translate(0, high), shadow
end

local sky = rect { 0, 0, 960, 540, fill = linear { from = { 0, 0 }, to = { 0, 360 },
  table.unpack(mood.sky) } }
local far = path { fill = mood.far,
  d = "M0 330C90 270 150 262 240 300C330 330 380 268 470 262C580 254 620 320 720 310"
    .. "C800 300 860 250 960 286V540H0Z" }
local hill = { { 0, 540 } }
for x = 0, 960, 20 do hill[#hill + 1] = { x, crest(x) } end
hill[#hill + 1] = { 960, 540 }
hill.fill = linear { from = { 0, 318 }, to = { 0, 540 }, { 0, mood.near }, { 1, mood.ground } }
local ground = polygon(hill)

local function frame(f)
  local letters, shadows, words = {}, {}, {}
  for i, letter in ipairs(title) do
    letters[i], shadows[i] = arriving(letter, i, f.time)
  end
  for i, letter in ipairs(under) do
    words[i] = letter.object:fade(motion.span(f.time, 0.3 + 0.05 * i, 0.15))
  end
  return cel { sky, far, union(letters), ground, clip(union(shadows), ground), union(words) }
end

return film { title = "Letter by letter", size = { 960, 540 }, fps = FPS, frames = 5 * FPS,
  frame = frame }
