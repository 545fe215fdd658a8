-- A piano seen from behind its player, in pencil and wash, and a cat that walks on its keys.
local pencil = require "town.pencil"

local piano = {}
local still = pencil.hand()

--- Wall, piano with its music, and keys.
local parts = { rect { 0, 0, 450, 600, fill = "#e9d8ae" },
  path { fill = "#f7ebc8", d = "M-10 600L-10 130L150 130L60 600Z" },
  still.form({ 36, 470, 36, 470, 38, 176, 38, 176, 414, 176, 414, 176, 416, 470, 416, 470 },
    "#a8743f", 6), still.line({ 26, 174, 220, 170, 426, 174 }, 9),
  still.wash({ 128, 292, 128, 292, 126, 196, 126, 196, 224, 200, 322, 196, 322, 196, 324, 292, 324,
    292, 224, 296 }, "#fffaf0"), still.line({ 224, 200, 225, 250, 224, 294 }, 3) }
for i = 0, 3 do
  parts[#parts + 1] = rect { 140, 214 + 20 * i, 70, 3, fill = pencil.ink }
  parts[#parts + 1] = rect { 238, 214 + 20 * i, 70, 3, fill = pencil.ink }
end
parts[#parts + 1] = rect { 26, 372, 400, 24, fill = "#fffaf0" }
for i = 0, 13 do
  if i % 7 ~= 2 and i % 7 ~= 6 then
    parts[#parts + 1] = rect { 46 + 27 * i, 372, 12, 13, fill = pencil.ink }
  end
end
parts[#parts + 1] = still.form({ 22, 396, 22, 396, 428, 396, 428, 396, 424, 418, 424, 418, 26, 418,
  26, 418 }, "#8a5a30", 5)
parts[#parts + 1] = rect { 26, 470, 400, 140, fill = "#6f4a2c" }
parts[#parts + 1] = rect { 44, 424, 364, 50, fill = "#7d5230" }
piano.room = union(parts)

--- Legs of the cat in four drawings: from hip to foot, x and y of each.
local steps = { { { -44, -58, 0 }, { -30, -40, 1 }, { 44, 62, 0 }, { 58, 46, 1 } },
  { { -44, -48, 0 }, { -30, -50, 3 }, { 44, 52, 0 }, { 58, 56, 3 } },
  { { -44, -38, 1 }, { -30, -46, 0 }, { 44, 46, 1 }, { 58, 62, 0 } },
  { { -44, -50, 3 }, { -30, -34, 0 }, { 44, 56, 3 }, { 58, 48, 0 } } }

--- The cat, its feet at 0, 0, that walks to the left; n: which drawing.
function piano.cat(n)
  local list, tail, fur = {}, n % 4 // 2 * 12, pencil.ink
  for i, leg in ipairs(steps[n % 4 + 1]) do
    list[i] = still.line({ leg[1], -44, (leg[1] + leg[2]) / 2 + 3, -22, leg[2], -4 * leg[3] }, 15,
      fur, true)
  end
  list[5] = still.line({ 62, -60, 92, -78, 96 - tail, -112, 112 - 2 * tail, -132 }, 15, fur)
  list[6] = still.wash({ -56, -46, -58, -72, -20, -78, 30, -76, 66, -74, 74, -52, 60, -34, 10, -30,
    -40, -32 }, fur)
  list[7] = union { still.wash({ -58, -62, -90, -60, -108, -76, -104, -100, -100, -124, -100, -124,
    -84, -110, -68, -110, -68, -110, -52, -124, -52, -124, -46, -90, -46, -70 }, fur),
    circle { -86, -86, 5, fill = "#f2c84b" }, circle { -66, -86, 5, fill = "#f2c84b" },
    still.line({ -56, -64, -48, -58, -38, -64 }, 7, pencil.red) }:translate(0, n % 2 * 2.34375)
  return union(list)
end

return piano
