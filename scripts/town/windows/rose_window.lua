-- The rose window: three rings of glass turn by quarters, and warm and cold change places; where
-- two petals lie over one another, their colours multiply. A pigeon walks so as to stay.
local window = require "town.window"
local geometry = require "town.geometry"
local harvest = require("stage.moods").harvest

local LEAD, LIGHT = "#1d0f0a", "#ffe9b8"
local WARM = { "#d5362f", "#ee9f3b", "#ffd45e" }
local COLD = { "#1f6f78", "#2b9bb0", "#17476b" }

--- Warm glass in two quarters and cold glass in the two between them, as one angle says.
local function glass(degrees, shade) return (degrees % 180 < 90 and WARM or COLD)[shade] end

--- A petal from the radius a to the radius b, so wide, about the middle.
local function petal(a, b, wide, fill)
  local m = (a + b) / 2
  return path { fill = fill, d = ("M0 %g C%g %g %g %g 0 %g C%g %g %g %g 0 %g Z"):format(-a,
    wide, -a - 30, wide, -m - 20, -b, -wide, -m - 20, -wide, -a - 30, -a) }
end

--- Round panes at the rim, turned by some degrees: they go round, each stays upright.
local function rim(turn)
  local parts = {}
  for i = 0, 11 do
    local a = math.rad(30 * i + 15 + turn)
    local x, y = 300 + 236 * math.sin(a), 300 - 236 * math.cos(a)
    parts[#parts + 1] = circle { x, y, 35, fill = glass(30 * i + 15, 1 + i % 2) }
    parts[#parts + 1] = circle { x, y, 18, fill = glass(30 * i + 15, 3) }
  end
  return union(parts)
end

--- Eight petals, every other one, in gels: two rings of them turn against each other.
local gels = { [22.5] = { "#ea4f3d", "#3e97a3" }, [67.5] = { "#f6b455", "#5cb7c6" } }
local function petals(first)
  local parts = {}
  for i = 0, 3 do
    local degrees = 90 * i + first
    parts[#parts + 1] = petal(64, 184, first > 30 and 66 or 78, gel(gels[first][degrees % 180 < 90
      and 1 or 2])):rotate(degrees)
  end
  return union(parts)
end
local broad, narrow = petals(22.5), petals(67.5)

--- The heart: four lobes, and a disc that is half sun and half moon.
local heart = circle { 0, 0, 62, fill = LEAD }
for i = 0, 3 do
  heart = heart | circle { 0, -26, 27, fill = glass(90 * i + 45, 3) }:rotate(90 * i + 45)
end
heart = heart | circle { 0, 0, 24, fill = LEAD } | circle { 0, 0, 19, fill = harvest.light }
  | geometry.sector(0, 0, 19, 0, 180, COLD[3])

local still = rect { 0, 0, 600, 600, fill = LEAD }
local behind = circle { 300, 300, 186, fill = LIGHT }
local tracery = union { circle { 300, 300, 190 }:stroke { width = 12, fill = LEAD },
  circle { 300, 300, 278 }:stroke { width = 10, fill = LEAD } }

--- The pigeon on the inner ring, in one of its steps.
local function pigeon(step)
  local reach = step == 0 and 0 or (step % 2 * 2 - 1) * 9
  local bob = step == 0 and 0 or step % 2 * 9
  return geometry.limb({ { -4, -20 }, { -4 + reach, 0 } }, 5, WARM[1])
    | geometry.limb({ { 6, -20 }, { 6 - reach, 0 } }, 5, WARM[1])
    | path { fill = LEAD, d = "M-62 -26 Q-30 -62 8 -58 Q40 -52 34 -30 Q20 -8 -10 -14 Z" }
    | path { fill = harvest.near, d = "M-46 -30 Q-10 -50 14 -36 Q0 -18 -46 -30 Z" }
    | (geometry.limb({ { 20, -44 }, { 30, -74 } }, 22, LEAD) | circle { 32, -78, 16, fill = LEAD }
      | polygon { { 44, -84 }, { 64, -76 }, { 44, -72 }, fill = WARM[1] }
      | circle { 36, -81, 4, fill = LIGHT }):translate(bob, 0)
end

-- The heart turns first, the petals follow, the rim is last: a quarter takes five drawings.
local quarter = { [0] = 0, -6, 14, 58, 96, 90 }

return window.film { title = "The rose window", by = "ge", seconds = 8, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local half, step = number // 48, math.max(0, math.min(9, (number % 48 - 26) // 2))
    local function turned(from)
      return 90 * half + quarter[math.max(0, math.min(5, step - from))]
    end
    local function ring(art, angle) return art:rotate(angle):translate(300, 300) end
    local walks = step > 4 and step < 9 and step or 0
    return { still, behind, ring(broad, turned(2)), ring(narrow, -turned(2)), rim(-turned(4)),
      tracery, ring(heart, turned(0)), pigeon(walks):translate(296, 486) }
  end }
