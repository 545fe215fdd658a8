-- The belfry of the town: an arch before the fog, the bell on its beam, and the rope of the bell.
local mood = require("stage.moods").fog

local belfry = { ink = "#141b1d", accent = mood.accent, light = mood.light, floor = 566 }

--- The sky, and the walls about it. The bell hangs from (166, 74), its rope at x = 326.
belfry.sky = rect { 0, 0, 450, 600, fill = linear { from = { 0, 60 }, to = { 0, 560 },
  { 0, mood.sky[1] }, { 0.5, mood.sky[2] }, { 1, mood.light } } }
belfry.arch = path { rule = "evenodd", d = "M0 0 H450 V600 H0 Z M44 566 V190 "
  .. "C44 80 130 34 225 34 C320 34 406 80 406 190 V566 Z" }
belfry.beam = rect { 30, 64, 390, 18 }

local BELL = path { d = "M-24 12 C-58 30 -62 90 -74 136 C-80 158 -96 168 -108 184 H108 "
    .. "C96 168 80 158 74 136 C62 90 58 30 24 12 Z" } - rect { -90, 140, 180, 6 }
  | rect { -34, -16, 68, 32 }

--- A pigeon that looks to the right, its feet at (0, 0).
belfry.pigeon = path { d = "M-4 0 L-6 -10 C-22 -12 -36 -10 -52 -2 C-46 -22 -28 -34 -8 -36 "
  .. "C-4 -56 22 -58 24 -42 L36 -37 L24 -34 C24 -20 14 -10 4 -9 L6 0 Z" }
  - circle { 14, -44, 3.5 }

--- The bell, turned by degrees, its clapper a little late.
function belfry.bell(degrees, clapper)
  local hammer = path { d = "M-4 150 H4 L18 204 C18 226 -18 226 -18 204 Z" }:rotate(clapper)
  return (BELL | hammer):rotate(degrees):translate(166, 74)
end

--- Rings of sound at one side of the bell, -1 left or 1 right; far: 0 near, 1 farther away.
function belfry.sound(side, far)
  local arcs = {}
  for i = 1, 2 do
    local r = 20 + 26 * i + 22 * far
    arcs[i] = stroke { d = ("M%g %g Q%g 0 %g %g"):format(0.6 * r, -r, 1.5 * r, 0.6 * r, r),
      width = 9 - 4 * far, cap = "round" }
  end
  return union(arcs):scale(side, 1):translate(206 + side * 120, 210 - side * 30)
end

--- The rope with its woollen grip, whose middle is at y.
function belfry.rope(y)
  return rect { 323, 74, 6, y - 74 + 60 }:paint(belfry.ink)
    | rect { 318, y - 46, 16, 92, radius = 8, fill = belfry.accent }
end

return belfry
