-- Figure 15(b): three pictures of pixels, two people and a page of text and logo; the people stand
-- in perspective, the page behind is out of focus, and the ground has a gradient.
--   celspan render scripts/paper/figure15b.lua --allow scripts -o b.png -- woman.png man.png
-- Pictures of people that you supply should have an alpha channel.
local cast = require "cast"
local diagram = require "diagram"
local pixels = require "pixels"

local woman_file, man_file = ...

local function person(file, draw)
  return pixels.given(file, function()
    return pixels.of(draw():scale(0.9):translate(190, 180), 380, 500)
  end)
end

--- The page behind: a logo of three spans, and words.
local function page()
  local art = { rect { 0, 0, 640, 260, fill = clear } }
  for i, colour in ipairs { diagram.teal, diagram.gold, diagram.red } do
    art[#art + 1] = rect { 30, 10 + 44 * i, 60 + 60 * i, 26, radius = 13, fill = colour }
  end
  art[#art + 1] = diagram.label("colour spans", 300, 96, 50, "left", "#f6ead2")
  for i, words in ipairs { "no frame buffer", "lights for each cel" } do
    art[#art + 1] = diagram.label(words, 300, 108 + 40 * i, 27, "left", "#f6ead2")
  end
  return pixels.of(union(art), 640, 260)
end

local function image(fields, x, y, w, h)
  return rect { x, y, w, h, fill = pixels.texture(fields) }
end

local woman = image(person(woman_file, cast.woman), 0, 0, 380, 500)
  :quad({ { 0, 0 }, { 380, 0 }, { 380, 500 }, { 0, 500 } },
        { { 60, 350 }, { 420, 270 }, { 430, 750 }, { 40, 750 } })
local man = image(person(man_file, cast.man), 0, 0, 380, 500)
  :quad({ { 0, 0 }, { 380, 0 }, { 380, 500 }, { 0, 500 } },
        { { 520, 262 }, { 900, 350 }, { 930, 770 }, { 500, 750 } })

return film { title = "Figure 15(b)", size = { 960, 720 }, frames = 1, frame = function()
  local ground = rect { 0, 0, 960, 720, fill = gradient {
    { 0, 0, "#22456b" }, { 960, 0, "#4b3a70" }, { 480, 1400, "#e0986a" } } }
  return {
    ground,
    cel { image(page(), 80, 0, 860, 349), defocus = 7, front = { 0.9, 0.9, 0.95 } },
    cel { woman, front = { 1.02, 0.95, 0.9 } },
    cel { man, front = { 0.95, 0.95, 1 } },
  }
end }
