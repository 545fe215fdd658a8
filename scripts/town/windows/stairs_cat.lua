-- The cat on the stairs: it goes down the endless house by night, sits down on each landing, and
-- thinks about it.
local window = require "town.window"
local geometry = require "town.geometry"
local stairs = require "town.stairs"
local harvest = require("stage.moods").harvest

local INK, GOLD, RED = "#1b0c07", harvest.sky[2], "#d0232f"
local limb = geometry.limb

local function face(x, y, look)
  local head = circle { x, y, 27, fill = INK }
  for side = -1, 1, 2 do
    head = head | polygon { { x + 5 * side, y - 22 }, { x + 27 * side, y - 10 },
      { x + 24 * side, y - 48 }, fill = INK }
      | circle { x + 10 * side + look, y - 2, 5, fill = GOLD }
  end
  return head
end

--- The cat sits, its feet at 0, 0, with its tail so high.
local function sits(tail)
  return limb({ { 20, -8 }, { 60, 4 }, { 66, -20 - tail } }, 13, INK)
    | path { fill = INK, d = "M-14 -104 C-34 -60 -46 -30 -34 0 H34 C46 -30 34 -60 14 -104 Z" }
    | rect { -24, -92, 48, 10, radius = 5, fill = RED } | face(0, -112, 0)
end

--- The cat in the air, long, its head before and below; and on a step, where it only lands.
local leaps = limb({ { 60, -96 }, { 14, -96 }, { -30, -54 } }, 44, INK)
  | limb({ { 66, -100 }, { 100, -120 }, { 108, -160 } }, 13, INK)
  | limb({ { -30, -50 }, { -52, -14 } }, 17, INK) | limb({ { 60, -96 }, { 78, -58 } }, 17, INK)
  | face(-52, -66, -6)
local lands = limb({ { 30, -40 }, { 0, -56 }, { -26, -36 } }, 46, INK)
  | limb({ { 42, -50 }, { 66, -90 }, { 50, -126 } }, 13, INK)
  | limb({ { -26, -30 }, { -30, -7 } }, 17, INK) | limb({ { 30, -30 }, { 32, -7 } }, 17, INK)
  | face(-44, -58, -6)

local sky = rect { 0, 0, 450, 600, fill = "#1a5a63" }
local moon = circle { 262, 268, 120, fill = GOLD }
local house = stairs.house({ harvest.sky[1], harvest.far, "#8a4526" }, harvest.ink)

-- The way down: for how many drawings, at which step, and how. Steps 8 and 0 are one.
local sheet = { { 9, { 8, sits(0) } } }
for _, move in ipairs { { 7 }, { 6 }, { 5, 6 }, { 4, 6 }, { 3, 6 }, { 2 }, { 1 }, { 0, 3 } } do
  sheet[#sheet + 1] = { 1, { move[1] + 0.5, leaps } }
  if move[2] then
    sheet[#sheet + 1] = { move[2], { move[1], sits(0) } }
  else
    sheet[#sheet + 1] = { 1, { move[1], lands } }
  end
end

return window.film { title = "The cat on the stairs", by = "ge", seconds = 4,
  drawing = function(_, number)
    local step, cat = table.unpack((geometry.held(sheet, number)))
    local x, y = stairs.place(step)
    if not stairs.way(step // 1) then return { sky, moon, house, cat:translate(x, y) } end
    return { sky, moon, house, cat:scale(-1, 1):translate(x, y) }
  end }
