--- A frog, its feet at 0, 0: its lines, what is painted, and both; and the names of its colours.
local palette = { skin = "#a3c94a", belly = "#fbf0c4", eye = "#fffaf0", line = "#3b3a2c" }

local body = "M-84 -4C-108 -12 -102 -52 -96 -84C-92 -112 -90 -130 -82 -148C-74 -176 -36 -176"
  .. " -28 -152C-22 -138 -14 -132 0 -132C14 -132 22 -138 28 -152C36 -176 74 -176 82 -148"
  .. "C90 -130 92 -112 96 -84C102 -52 108 -12 84 -4C40 2 -40 2 -84 -4Z"
local belly = "M-58 -6C-62 -44 -40 -66 0 -66C40 -66 62 -44 58 -6C30 0 -30 0 -58 -6Z"
local mouth = "M-60 -100C-40 -78 40 -78 60 -100M-66 -104L-56 -97M66 -104L56 -97"
local feet = "M-62 1C-64 -16 -26 -18 -24 1C-34 5 -52 5 -62 1Z"
  .. "M62 1C64 -16 26 -18 24 1C34 5 52 5 62 1Z"

local eyes = ellipse { -54, -142, 22, 24 } | ellipse { 54, -142, 22, 24 }
local painted = union { path { d = body, fill = palette.skin }, path { d = belly,
  fill = palette.belly }, eyes:paint(palette.eye), path { d = feet, fill = palette.skin } }
local function line(d, width)
  return stroke { d = d, width = width, cap = "round", join = "round" }
end
local lines = union { line(body, 4), line(mouth, 4), line(belly, 3), line(feet, 3.4),
  ellipse { -54, -142, 22, 24 }:stroke { width = 3.4 },
  ellipse { 54, -142, 22, 24 }:stroke { width = 3.4 },
  circle { -49, -138, 9 }, circle { 49, -138, 9 },
  circle { -6, -112, 2 }, circle { 6, -112, 2 } }:paint(palette.line)

return { lines = lines, painted = painted, all = painted | lines, palette = palette }
