-- The title of a film in a round typeface: letters rise one by one, and the moon with them.
--
--   celspan watch opening.lua
--   celspan render opening.lua -o opening.mp4 --set title="Your film"
local celspan = require "celspan"
local ease = require "celspan.ease"

local set = celspan.parameters {
  title = { "Night Bakery", about = "the words" },
  sky = { colour = "#1d2347", about = "the sky, above" },
}
local FONT, FPS = "fonts/Quicksand-Bold.ttf", 24
local outBack, inOut = ease "outBack", ease "inOutSine"

--- 0 before `from`, 1 after `from + length`, in seconds.
local function share(time, from, length)
  return math.max(0, math.min(1, (time - from) / length))
end

local letters = celspan.glyphs { set.title, font = FONT, size = 120, at = { 480, 390 },
  align = "centre", texture = "#fff1d6" }
local sky = celspan.rect { 0, 0, 960, 540, texture = celspan.linear { from = { 0, 0 },
  to = { 0, 540 }, { 0, set.sky }, { 1, "#a4506a" } } }
local moon = celspan.circle { centre = { 480, 160 }, radius = 105, texture = "#ffd98f" }
local roofs = celspan.path { texture = "#171a33", d = [[M0 540 V480 H120 V450 L170 420 L220 450 V480
  H340 V460 H470 V490 H600 V440 L660 410 L720 440 V480 H840 V450 H960 V540 Z]] }

return celspan.film { title = set.title, size = { 960, 540 }, fps = FPS, frames = 4 * FPS,
  frame = function(f)
    local art = { sky, moon:translate(0, 380 - 380 * inOut(share(f.time, 0, 1.6))), roofs }
    for i, letter in ipairs(letters) do
      local risen = outBack(share(f.time, 0.6 + 0.06 * i, 0.6))
      art[#art + 1] = letter.object:translate(0, 240 - 240 * risen)
        :fade(share(f.time, 0.6 + 0.06 * i, 0.2))
    end
    return celspan.rostrum { celspan.cel(art) }
  end }
