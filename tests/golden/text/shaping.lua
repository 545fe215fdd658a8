-- Kerning, a letter with its accent, a ligature and the same two letters without it, two weights
-- between the drawn ones, and letters each placed individually.
local celspan = require "celspan"
local FONT = "../../../scripts/type/block.ttf"
local function set(phrase, x, y, more)
  local fields = { phrase, font = FONT, size = 14, at = { x, y }, texture = "#fff" }
  for name, value in pairs(more or {}) do fields[name] = value end
  return celspan.text(fields)
end
local letters = celspan.glyphs { "Toss", font = FONT, size = 14, at = { 3, 44 },
  variations = { wght = 650 } }
return celspan.film { size = { 56, 48 }, frame = function()
  local art = { set("AVATO", 2, 12), set("e\u{301}", 46, 12), set("->", 2, 26),
                set("->", 22, 26, { features = { liga = false } }),
                set("w", 44, 26, { variations = { wght = 900 } }) }
  for i, letter in ipairs(letters) do
    art[#art + 1] = letter.object:with { texture = i % 2 == 0 and "#f00" or "#0f0" }:translate(0,
      i - 3)
  end
  return celspan.rostrum { antialias = "none", back = { 0, 0, 0, 1 }, celspan.cel(art) }
end }
