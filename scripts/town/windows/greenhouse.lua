-- A greenhouse in winter: a girl waters a pot, leaves unroll, a flower opens, and she goes on to
-- the next one.
local window = require "town.window"
local cut = require "town.cutout"
local glasshouse = require "town.glasshouse"
local mood = require("stage.moods").noon

local SKIN, STRAW, SPACE = "#eec39a", "#f1c84b", 330

local LEAF = cut.piece("M0 0 C20 -50 80 -64 122 -30 C90 -2 40 10 0 0 Z", mood.near)
local BUD = cut.piece("M-16 0 C-22 -28 -8 -44 0 -52 C8 -44 22 -28 16 0 Z", "#e44a7c")
local PETAL = cut.piece("M0 0 C-34 -30 -30 -78 0 -84 C30 -78 34 -30 0 0 Z", "#e44a7c")

--- The flower's head, from a bud, 0, to all petals open, 1.
local function blossom(open)
  if open == 0 then return BUD end
  local petals = {}
  for _, i in ipairs { -4, 4, -3, 3, -2, 2, -1, 1, 0 } do
    if open == 1 or math.abs(i) < 3 then
      petals[#petals + 1] = PETAL:scale(0.5 + 0.5 * open):rotate(40 * i * open, 0, 0)
    end
  end
  return union(petals) | cut.disc(0, 0, 26 * open, STRAW)
end

--- A plant in its pot: its height, how far its three leaves are unrolled, its blossom and its bow.
local function plant(height, leaves, open, bow)
  local parts = {}
  if height > 0 then
    parts[1] = cut.strip(("M0 -90 C-14 %g 12 %g 0 %g"):format(-90 - height / 3, -90 - height / 1.5,
      -90 - height), 9, mood.near)
    for i, unrolled in ipairs(leaves) do
      local side = i % 2 == 0 and -1 or 1
      parts[#parts + 1] = LEAF:scale(0.9 - 0.1 * i, 0.24 + 0.7 * unrolled)
        :rotate(40 * unrolled - 62, 0, 0):scale(side, 1):translate(0, -44 - 58 * i)
    end
    if open then
      parts[#parts + 1] = cut.laid(blossom(open):rotate(bow or 0, 0, 0):translate(0, -90 - height))
    end
  end
  parts[#parts + 1] = cut.laid(glasshouse.pot)
  return union(parts)
end
local STAGES = { plant(0, {}), plant(24, {}), plant(70, { 0 }), plant(120, { 0.5 }),
  plant(180, { 1, 0 }), plant(220, { 1, 0.6, 0 }), plant(250, { 1, 1, 0.6 }, 0),
  plant(256, { 1, 1, 1 }, 0.4), plant(256, { 1, 1, 1 }, 1), plant(256, { 1, 1, 1 }, 1, -50) }

local DRESS = cut.piece("M88 344 C104 334 124 334 136 344 C144 390 160 440 176 492 L44 492 "
  .. "C60 440 76 390 88 344 Z", mood.accent)
local HEAD = cut.piece("M74 300 C72 262 140 254 146 292 L156 308 L144 314 C142 336 124 346 108 344 "
  .. "C86 342 74 326 74 300 Z", SKIN)
local HAIR = cut.piece("M70 280 C60 300 64 330 56 362 C72 372 88 360 92 340 L100 300 L130 284 "
  .. "L120 264 Z", "#6b3a22")
local HAT = cut.piece("M44 286 L74 274 C76 230 134 226 138 264 L172 266 C170 276 140 280 110 284 "
  .. "C84 288 60 294 44 286 Z", STRAW)
local LEG = cut.strip("M0 0 L0 52", 16, SKIN) | cut.piece("M-11 40 L11 40 L12 60 L34 64 L34 78 "
  .. "L-11 78 Z", mood.ink)
local CAN = cut.piece("M-30 10 L28 10 L32 66 L-34 66 Z", mood.sky[1])
  | cut.piece("M26 44 L70 2 L62 -8 L88 -10 L92 14 L78 12 L32 62 Z", mood.sky[1])
  | cut.strip("M-20 12 C-16 -10 16 -10 20 12", 7, mood.sky[1])

local function girl(stride, tilt, nod)
  local hand_x, hand_y = tilt > 0 and 214 or 176, tilt > 0 and 366 or 424
  local arm = cut.strip(("M112 366 L%g %g"):format(hand_x, hand_y), 20, mood.accent)
    | cut.disc(hand_x + 4, hand_y + 2, 13, SKIN)
  local face = union { HEAD, HAIR, HAT, circle { 134, 300, 4.5, fill = mood.ink } }
  return cut.laid(union { LEG:rotate(-stride, 0, 0):translate(98, 484),
    LEG:rotate(stride, 0, 0):translate(124, 484), DRESS, face:rotate(nod, 108, 340),
    CAN:rotate(tilt, 0, 0):translate(hand_x, hand_y), arm })
end

local function water(n)
  local drops = {}
  for i = 0, 2 do
    local y = 430 + (i * 16 + 8 * n) % 44
    drops[i + 1] = stroke { points = { { 286 + i * 8, y }, { 288 + i * 8, y + 14 } }, width = 5,
      cap = "round", fill = mood.light }
  end
  return union(drops)
end

return window.film { title = "The greenhouse", by = "cp", seconds = 8, drawing = function(_, number)
  local stage = math.min(math.max(1, (number - 2) // 6), 7)
  local tilt, nod, stride, gone = 38, 0, 4, 0
  if number >= 48 then tilt, nod = 0, -20 end
  if number >= 56 then stage = math.min(8 + (number - 56) // 3, 9) end
  if number >= 66 then stage = 10 end
  if number < 4 or number >= 70 then tilt, nod = 0, 0 end
  if number >= 72 then
    local step = (number - 72) // 4
    stride, gone = step % 2 == 0 and 22 or -22, SPACE * (step + 0.5) / 6
  end
  local list = { glasshouse.room }
  for i = -1, 1 do
    local shown = i < 0 and STAGES[10] or i > 0 and STAGES[1] or STAGES[stage]
    list[#list + 1] = shown:translate(306 + SPACE * i - gone, 560)
  end
  if tilt > 0 then list[#list + 1] = water(stage % 2) end
  list[#list + 1] = girl(stride, tilt, nod)
  return list
end }
