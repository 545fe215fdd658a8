-- The credits: a few lines that come letter by letter, and go.
local timing = require "film.timing"

local credits = {}

local FONT = "../type/block.ttf"

local function line(text, size, y, weight, colour)
  return glyphs { text, 960, y, font = FONT, size = size, align = "centre",
    tracking = 120,
    variations = { wght = weight }, fill = colour }
end

local cards = {
  { from = timing.credits, to = timing.credits + 2.35,
    line("the lamplighter · a spark · one lamp", 40, 300, 500, "#ffdfa6"),
    line("drawn, lit and spoken by scripts", 30, 366, 400, "#c9c6ee") },
  { from = timing.credits + 2.4, to = timing.fade + 0.7,
    line("Little One", 74, 300, 600, "#ffdfa6"),
      line("made with celspan", 36, 372, 400, "#c9c6ee") },
}

--- A letter rises to its place and fades out there.
local function letter_at(letter, i, time, card)
  local u = motion.span(time, card.from + 0.009 * i, 0.4)
  local gone = motion.span(time, card.to - 0.25, 0.25)
  if u == 0 or gone == 1 then return nil end
  local k = ease "outCubic"(u)
  return letter.object:translate(0, 18 * (1 - k)):fade(u * (1 - gone))
end

--- The cels of the credits at a time of the film.
function credits.draw(time)
  local parts = {}
  for _, card in ipairs(cards) do
    local i = 0
    for _, text in ipairs(card) do
      for _, letter in ipairs(text) do
        i = i + 1
        parts[#parts + 1] = letter_at(letter, i, time, card)
      end
    end
  end
  if #parts == 0 then return {} end
  return { cel { union(parts) }:named "credits" }
end

return credits
