-- The title of a film in a round typeface: letters rise one by one, and the moon with them.
--
--   celspan watch opening.lua
--   celspan render opening.lua -o opening.mp4 --set title="Your film"

local set = parameters {
  title = { "Night Bakery", about = "the words" },
  sky = { colour = "#1d2347", about = "the sky, above" },
}
local FONT, FPS = "fonts/Quicksand-Bold.ttf", 24
local outBack, inOut = ease "outBack", ease "inOutSine"

local letters = glyphs { set.title, 480, 390, font = FONT, size = 120,
  align = "centre", fill = "#fff1d6" }
local sky = rect { 0, 0, 960, 540, fill = linear { from = { 0, 0 },
  to = { 0, 540 }, { 0, set.sky }, { 1, "#a4506a" } } }
local moon = circle { 480, 160, 105, fill = "#ffd98f" }
local roofs = path { fill = "#171a33", d = [[M0 540 V480 H120 V450 L170 420 L220 450 V480
  H340 V460 H470 V490 H600 V440 L660 410 L720 440 V480 H840 V450 H960 V540 Z]] }

return film { title = set.title, size = { 960, 540 }, fps = FPS, frames = 4 * FPS,
  frame = function(f)
    local art = { sky, moon:translate(0, 380 - 380 * inOut(motion.span(f.time, 0, 1.6))), roofs }
    for i, letter in ipairs(letters) do
      local risen = outBack(motion.span(f.time, 0.6 + 0.06 * i, 0.6))
      art[#art + 1] = letter.object:translate(0, 240 - 240 * risen)
        :fade(motion.span(f.time, 0.6 + 0.06 * i, 0.2))
    end
    return cel(art)
  end }
