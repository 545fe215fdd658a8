-- The sleeping astronaut: a hand puts out the light, and the stars on the rocket shine; but who
-- sleeps in it is not asleep.
local window = require "town.window"
local geometry = require "town.geometry"
local rocket = require "town.rocket"
local neon = require("stage.moods").neon

local CYAN, PINK, INK, PAPER = neon.light, neon.accent, neon.ink, "#fff1dc"
local lit = { wall = neon.sky[3], disc = "#4a2589", floor = neon.far, tones = { INK, "#cf9a62",
  "#83503f" }, fins = { PINK, "#a01c66" }, hole = CYAN, eye = INK, lamp = "#ffe7a0" }
local dark = { wall = neon.sky[1], disc = neon.near, floor = neon.ground, tones = { INK, "#241a4a",
  "#171136" }, fins = { "#34176b", "#241045" }, hole = INK, eye = CYAN, lamp = neon.near }

--- Stars where others are at each twinkle.
local function stars(points, fill)
  local parts = {}
  for i, at in ipairs(points) do
    parts[i] = star { at[1], at[2], at[3], at[3] * 0.4, points = 5, fill = fill }
  end
  return union(parts)
end

local function room(light)
  local tone = light and lit or dark
  return union { rect { 0, 0, 450, 600, fill = tone.wall },
    circle { 225, 210, 190, fill = tone.disc }, ellipse { 225, 505, 205, 84, fill = tone.floor } }
end

--- The small hand that comes out of the rocket.
local function small(y)
  return geometry.limb({ { 306, 306 }, { 376, y + 66 }, { 254, y } }, 26, PAPER)
    | circle { 252, y, 20, fill = CYAN }
end

--- The rocket: in the light or not, whether the eyes are open, how far the nose is up, which
--- stars are large, and how high the small hand is.
local function ship(light, is_awake, breath, twinkle, mitten)
  local tone = light and lit or dark
  local hole = circle { 0, 0, 46, fill = tone.fins[2] } | circle { 0, 0, 38, fill = tone.hole }
  for side = -1, 1, 2 do
    hole = hole | ellipse { 15 * side, 0, 8, is_awake and 9 or 2.5,
      fill = (light or is_awake) and tone.eye or tone.hole }
  end
  local glow = light and "#e0b680" or CYAN
  local art = stars({ { -36, -28, twinkle and 16 or 24 }, { 30, 12, twinkle and 24 or 18 },
    { -28, 48, 16 } }, glow)
  local nose = rocket.nose(tone.fins[1], tone.fins[2])
    | stars({ { -44, 2, twinkle and 20 or 14 }, { 40, -4, twinkle and 13 or 19 } },
      light and "#ff7fb6" or CYAN)
  return rocket.box { tones = tone.tones, fins = tone.fins, left = art, right = hole }
    :translate(95, 470) | (mitten and small(mitten) or union {}) | nose:translate(225, 290 - breath)
end

--- The lamp, with its string pulled by a number of units.
local function lamp(light, pulled)
  local tone = light and lit or dark
  return rect { 222, 0, 6, 60, fill = INK } | rect { 250, 92, 3, 46 + pulled, fill = PAPER }
    | circle { 251, 140 + pulled, 7, fill = PINK } | circle { 225, 96, 24, fill = tone.lamp }
    | geometry.sector(225, 98, 52, -90, 90, light and PINK or "#34176b")
end

--- The large hand of somebody at the right.
local function large(x, y)
  return geometry.limb({ { 470, y + 120 }, { x + 120, y + 30 }, { x, y } }, 46, "#149aa6")
    | circle { x - 6, y, 27, fill = "#f4c7a4" }
end

-- For how many drawings: light, eyes, breath, twinkle, string, the large hand, the small one.
local sheet = {
  { 9, { true, false, 0 } }, { 9, { true, false, 9 } }, { 9, { true, false, 0 } },
  { 2, { true, false, 0, false, 0, { 380, 190 } } },
  { 4, { true, false, 0, false, 0, { 258, 142 } } },
  { 2, { true, false, 0, false, 34, { 258, 176 } } },
  { 5, { false, false, 0, true, 34, { 258, 176 } } },
  { 10, { false, false, 0, true } }, { 10, { false, false, 0 } },
  { 8, { false, true, 0, true } }, { 8, { false, true, 0 } },
  { 4, { false, true, 16, true, 0, nil, 142 } }, { 2, { false, true, 12, true, 34, nil, 176 } },
  { 5, { true, true, 12, false, 34, nil, 176 } }, { 5, { true, true, 0 } },
  { 4, { true, false, 0 } } }

return window.film { title = "The sleeping astronaut", by = "ge", seconds = 8, pane = "plain",
  drawing = function(_, number)
    local light, is_awake, breath, twinkle, pulled, hand, mitten =
      table.unpack(geometry.held(sheet, number), 1, 7)
    return { room(light), ship(light, is_awake, breath, twinkle, mitten), lamp(light, pulled or 0),
      hand and large(hand[1], hand[2]) or nil }
  end }
