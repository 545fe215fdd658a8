-- The ball of mirrors: it makes eight quarter turns in two seconds, each of three drawings, and one
-- in a white suit knows just two poses.
local window = require "town.window"
local geometry = require "town.geometry"
local neon = require("stage.moods").neon

local CYAN, PINK, PAPER, INK = neon.light, neon.accent, "#fff1dc", neon.ink
local SKIN = "#f4c7a4"
local limb, sector = geometry.limb, geometry.sector
local X, Y, R = 225, 134, 88

local room = union { rect { 0, 0, 450, 600, fill = neon.sky[2] },
  polygon { { 0, 0 }, { 225, 110 }, { 225, 420 }, { 0, 560 }, fill = neon.sky[3] },
  polygon { { 0, 560 }, { 225, 420 }, { 450, 560 }, { 450, 600 }, { 0, 600 }, fill = neon.far },
  rect { 222, 0, 6, 50, fill = PAPER } }

--- A facet between two heights, -1 to 1, and two angles round the ball.
local function facet(up, down, from, to, fill)
  local function at(height, angle)
    return { X + R * math.sqrt(1 - height * height) * math.sin(angle), Y + R * height }
  end
  return polygon { at(up, from), at(up, to), at(down, to), at(down, from), fill = fill }
end

--- The ball in one of the three drawings of a quarter turn: its facets are 30 degrees wide, so that
--- each drawing has the same ones, in the colours of their neighbours.
local function ball(phase)
  local parts = { circle { X, Y, R, fill = neon.near } }
  local heights, fills = { -0.92, -0.5, 0, 0.5, 0.92 }, { PAPER, CYAN, PINK }
  for row = 1, 4 do
    for column = -3, 2 do
      local from = (column + 0.06) * math.pi / 6
      parts[#parts + 1] = facet(heights[row] + 0.04, heights[row + 1] - 0.04, from,
        from + 0.88 * math.pi / 6, fills[(column + row + row // 3 - phase) % 3 + 1])
    end
  end
  return union(parts)
end

--- Light on the two walls, which goes to the right.
local function spots(phase)
  local parts = {}
  for row = 0, 2 do
    for i = -1, 4 do
      local x = 110 * (i + phase / 3) + 40 * (row % 2)
      local y = 130 + 130 * row + (x < 225 and -0.1 or 0.1) * (x - 225)
      parts[#parts + 1] = ellipse { x, y, 13, 17, fill = (i + row) % 2 == 0 and CYAN or "#6a4fd0" }
    end
  end
  return union(parts)
end

--- The dancer, pointing up to the right; down: how far the knees give.
local function dancer(down)
  return polygon { { 196, 424 }, { 236, 424 }, { 206, 482 }, { 194, 558 }, { 130, 558 },
      { 160, 482 }, fill = PAPER }
    | polygon { { 214, 424 }, { 252, 424 }, { 298, 466 + down }, { 322, 558 }, { 254, 558 },
      { 254, 480 + down }, fill = PAPER }
    | sector(158, 570, 30, -90, 90, INK) | sector(290, 570, 30, -90, 90, INK)
    | (path { fill = PAPER, d = "M182 306 Q222 292 268 306 L250 440 H200 Z" }
      | polygon { { 212, 304 }, { 240, 304 }, { 226, 362 }, fill = PINK }
      | limb({ { 258, 316 }, { 300, 280 }, { 336, 204 } }, 28, PAPER)
      | circle { 340, 196, 15, fill = SKIN } | limb({ { 340, 192 }, { 350, 166 } }, 9, SKIN)
      | limb({ { 192, 318 }, { 138, 360 }, { 186, 404 } }, 28, PAPER)
      | rect { 214, 280, 22, 30, fill = SKIN } | circle { 228, 258, 33, fill = SKIN }
      | sector(224, 252, 38, 200, 420, INK) | circle { 236, 262, 4.5, fill = INK }
      | circle { 250, 259, 4.5, fill = INK }):translate(0, down)
end

local poses = { dancer(0), dancer(14) }

return window.film { title = "The ball of mirrors", by = "ge", seconds = 2, pane = "plain",
  drawing = function(_, number)
    local phase = number % 3
    local who = poses[number % 6 < 3 and 2 or 1]
    if number % 24 >= 12 then who = who:scale(-1, 1):translate(450, 0) end
    return { room, spots(phase), ball(phase), who }
  end }
