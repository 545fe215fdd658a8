-- The pictures on the walls: small landscapes, 96 by 64, and one large one, 192 by 108: a frame of
-- the film in scripts/demo.lua, which is visible pixel by pixel at the last level.
local character = require "demo.character"
local landscape = require "demo.landscape"
local palette = require "demo.palette"
local shapes = require "demo.shapes"
local village = require "demo.village"
local draw = require "terapixel.draw"

local canvas = {}

local moods = {
  { "#4d7896", "#f7b267", "#fff3c9", "#8d6f78", "#55683f" },
  { "#242656", "#96506f", "#ff9a5e", "#4c3569", "#27362b" },
  { "#8fa9a8", "#fbdcae", "#fff3c9", "#c99880", "#7d8248" },
  { "#0e1533", "#4c3569", "#ffeccb", "#242656", "#15201f" },
  { "#dcb98d", "#f79d5c", "#e9573f", "#9c7f86", "#4b5a33" },
}

--- The smallest house: on the last level its window is five pixels wide.
local function cottage(x, y, size, dice)
  return union {
    draw.rect(x, y - size * 0.7, size, size * 0.7, dice:one(palette.walls)),
    draw.path(dice:one(palette.roofs), "M%g %gL%g %gL%g %gZ", x - size * 0.15, y - size * 0.68,
      x + size / 2, y - size * 1.3, x + size * 1.15, y - size * 0.68),
    draw.rects("#ffd98a", { { x + size * 0.2, y - size * 0.5, size * 0.2, size * 0.25 },
                            { x + size * 0.6, y - size * 0.5, size * 0.2, size * 0.25 } }),
  }
end

local function crest(dice, y, swing, texture)
  local points = {}
  for i = 0, 6 do points[i + 1] = { i * 16, y + dice:between(-swing, swing) } end
  return shapes.ridge(points, 64, texture)
end

--- A landscape of hills with cottages, with its own colours.
function canvas.small(dice)
  local mood = dice:one(moods)
  local x = dice:between(20, 76)
  local parts = {
    draw.rect(0, 0, 96, 64, shapes.down(0, 50, { mood[1], mood[2] })),
    draw.disc(x, dice:between(16, 30), dice:between(4, 8), mood[3]),
    crest(dice, 34, 7, mood[4]),
    crest(dice, 46, 4, mood[5]),
  }
  for i = 0, 3 do
    parts[#parts + 1] = cottage(10 + i * 20 + dice:between(0, 8), 52 + dice:between(0, 6), 6, dice)
  end
  return union(parts)
end

--- A mount and a moulding around a picture of w by h.
function canvas.frame(art, w, h)
  local d = "M%g %gH%gV%gH%gZ"
  local function ring(texture, reach, width)
    return draw.path(texture, d .. d, -reach, -reach, w + reach, h + reach, -reach,
      width - reach, width - reach, w + reach - width, h + reach - width, width - reach)
      :with { rule = "evenodd" }
  end
  return union { draw.rect(-7, -7, w + 14, h + 14, "#efe3cc"), art, ring("#6b4226", 12, 6),
                 ring("#a8743c", 11, 2) }
end

--- Golden hour in the valley, 1920 by 1080, cut to its canvas.
local function golden_hour()
  local time = 2.25
  local gradient = { from = { 0, 0 }, to = { 0, 1080 } }
  for i, stop in ipairs(palette.sky) do gradient[i] = { stop[1], stop[2]:at(0) } end
  local rings = {}
  for i, radius in ipairs { 430, 318, 216, 132 } do
    rings[i] = draw.disc(690, 560, radius, rgb(1, 0.86, 0.62, 0.06 + 0.03 * i))
  end
  local figure, glass, frame = character.draw(time, "D")
  local scene = union {
    draw.rect(0, 0, 1920, 1080, linear(gradient)),
    union(rings), draw.disc(690, 560, 74, palette.sun:at(0)),
    landscape.mountains, landscape.hills, landscape.lake, landscape.poplars, landscape.slope,
    village.houses, village.panes, landscape.oaks, landscape.near, landscape.ground,
    union { figure, glass, frame }:translate(1500, 946), landscape.meadow,
    landscape.branch:translate(-300, 0),
  }
  return clip(scene, rect { 0, 0, 1920, 1080 })
end

canvas.large = golden_hour():scale(0.1)

return canvas
