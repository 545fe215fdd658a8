-- Path operators: trims, corners, ridges, bloat, twist, copies, stars, offsets, merges, four radii.
local celspan = require "celspan"

local function square(texture) return celspan.rect { 4, 4, 24, 24, texture = texture } end

local function spark(fields)
  fields.centre, fields.outer = { 16, 16 }, 14
  return celspan.star(fields)
end

return celspan.film { size = { 160, 96 }, frame = function()
  local ring = celspan.circle { centre = { 16, 16 }, radius = 11 }:stroke { width = 4,
    texture = "#17bebb" }
  local cells = {
    celspan.trim(ring, 0.1, 0.6, { offset = 0.7 }),
    celspan.trim(square "#e4572e", 0, 0.6),
    celspan.round_corners(spark { inner = 6, texture = "#ffc914" }, 4),
    celspan.zigzag(ring, { size = 2, ridges = 3, smooth = true }),
    celspan.pucker(square "#76b041", 0.3),
    celspan.twist(square "#6c5ce7", 120),
    celspan.repeater(celspan.circle { centre = { 16, 6 }, radius = 3, texture = "#2e282a" },
      { count = 8, rotate = 45, centre = { 16, 16 }, opacity = { 1, 0.2 } }),
    spark { points = 7, inner = 8, outer_round = 0.8, texture = "#e4572e" },
    celspan.offset(spark { inner = 5, texture = celspan.rgb(0, 0.3, 0.6, 0.5) }, 2)
      | celspan.offset(spark { inner = 7, texture = "#fff" }, -2),
    celspan.offset(celspan.stroke { d = "M9 9L21 13L13 22", width = 1 }, 4, { join = "miter" }),
    celspan.merge({ square "#17bebb", celspan.circle { centre = { 26, 26 }, radius = 6 } },
      { mode = "exclude" }),
    celspan.rect { 3, 3, 26, 26, radius = { 0, 5, 10, 20 }, texture = celspan.conic {
      centre = { 14, 18 }, angle = 40, { 0, "#e4572e" }, { 0.5, "#ffc914" }, { 1, "#6c5ce7" } } },
  }
  local placed = {}
  for i, cell in ipairs(cells) do
    placed[i] = cell:translate(32 * ((i - 1) % 5), 32 * ((i - 1) // 5))
  end
  return celspan.rostrum { back = "#f4f1e8", celspan.cel(placed) }
end }
