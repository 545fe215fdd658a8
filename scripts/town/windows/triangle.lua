-- The triangle of the quartet: he waits, counts, strikes once in eight seconds, and is proud.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local SKIN = wash(160, 0, 300, 0, "#ffd3a0", "#dd9462", "#a8623f")
local COAT = wash(110, 0, 340, 0, "#8a4722", "#5a2a15", "#3a190d")

local room = union {
  gouache.wall(90, 230, 500, "#ffe2a0", "#e79a45", "#a8551f", "#6b3418"),
  form("#8a4420", "M0 552 H450 V600 H0 Z"),
  form("#7a3217", "M17 100 C60 220 60 380 20 600 H0 V100 Z M440 100 C392 220 396 380 432 600 "
    .. "H450 V100 Z"),
}
local body = gouache.edged(form(COAT, "M124 640 C120 520 116 440 140 404 "
  .. "C160 380 196 376 206 362 H244 C254 376 290 380 310 404 C334 440 330 520 326 640 Z"),
  "#f0a25c", "#2f120c", 5, 3)
  | form("#fff0c4", "M200 372 L225 420 L250 372 L272 384 L236 520 H214 L178 384 Z")
  | form(mood.accent, "M190 392 L222 404 L190 420 Z M260 392 L228 404 L260 420 Z")
local triangle = line("M-12 60 H-52 L0 -28 L52 60 H16", 9, "#fff0c4") | line("M0 -28 V-58", 3,
  "#54270f")
local hair = form("#43200f", "M-53 4 C-62 -44 -36 -66 -4 -64 C40 -66 62 -44 53 4 "
  .. "C46 -28 34 -44 -6 -48 C-30 -40 -46 -28 -53 4 Z") | form("#2f120c", "M-22 28 "
  .. "C-12 22 -4 24 0 28 C4 24 12 22 22 28 C14 36 4 34 0 31 C-4 34 -14 36 -22 28 Z")

--- Rays about the triangle, which ring for a while.
local function ringing(x, y, age)
  local rays, r = union {}, 70 + 14 * age
  for i = -3, 2 do
    local a = math.pi * (i + 0.5) / 4
    rays = rays | gouache.taper("#fff0c4", { x + r * math.cos(a), y + r * math.sin(a) },
      { x + (r + 26 - 5 * age) * math.cos(a), y + (r + 26 - 5 * age) * math.sin(a) }, 7 - age, 2)
  end
  return rays
end

return window.film { title = "The triangle", by = "ga", seconds = 8, drawing = function(_, number)
  local n = number // 4
  local stage = gouache.exposed(n, { 13, "wait" }, { 2, "lift" }, { 1, "strike" }, { 7, "proud" },
    { 1, "wait" })
  local counting = stage == "wait" and n % 4 < 2
  local sx, sy = table.unpack(({ wait = { 168, counting and 512 or 506 }, lift = { 120, 300 },
    strike = { 278, 356 }, proud = { 150, 478 } })[stage])
  local function arm(from, to, side)
    return gouache.arm { from = from, to = to, parts = { 82, 84 }, side = side, widths = { 54, 46,
      30 },
      fill = COAT }
  end
  local look = ({ wait = { counting and -8 or 6, 8 }, lift = { 12, -6 }, strike = { 14, 0 },
    proud = { 0, -12 } })[stage]
  local down = stage == "strike" and 6 or 0
  return { room, body, form(nil, "M204 330 H246 L248 384 L225 400 L202 384 Z"):paint(SKIN),
    gouache.head { x = 225 + 0.3 * look[1], y = 280 + 0.5 * look[2], skin = SKIN, face = look,
      front = hair,
      eyes = stage == "proud" and "happy" or "open", brow = stage == "wait" and 2 or 9,
      mouth = stage == "proud" and "M-16 40 Q0 54 16 40" or counting
        and "M-4 44 Q0 40 4 44 Q0 50 -4 44" or "M-6 44 H6" },
    arm({ 300, 424 }, { 336, 250 }, -1), triangle:translate(336, 320 + down),
    circle { 0, 0, 19 }:translate(336, 250 + down):paint(SKIN),
    stage == "proud" and n < 20 and ringing(336, 342, n - 16) or union {},
    line("M0 0 L44 -30", 7, "#fff0c4"):rotate(stage == "wait" and 60 or 0):translate(sx, sy),
    arm({ 152, 424 }, { sx, sy }, stage == "strike" and 1 or -1),
    circle { 0, 0, 19 }:translate(sx, sy):paint(SKIN) }
end }
