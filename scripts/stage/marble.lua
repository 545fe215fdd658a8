--- A sky, and the ruin of a temple of marble on a hill in front, whose veins are noise.
local W, H = 480, 270
local sky = rect { 0, 0, W, H, fill = linear { from = { 0, 0 }, to = { 0, H }, { 0, "#4f97b5" },
  { 0.6, "#b9d8d6" }, { 1, "#f0e6cf" } } }

local marble = noise {
  kind = "turbulence", size = 46, octaves = 6, seed = 5,
  colours = { "#8d8478", "#d8cdbd", "#f5efe4", "#fffdf6", "#fffdf6" } }

--- The shape of a column and of what carries it, its foot at x, y.
local function column(x, y, tall)
  return path { d = ("M%g %gL%g %gH%gL%g %gZ"):format(x - 12, y - 8, x - 9, y - tall, x + 9, x + 12,
    y - 8) } | rect { x - 16, y - 9, 32, 9, radius = 2 }
end

local function capital(x, y)
  return path { d = ("M%g %gC%g %g %g %g %g %gZ"):format(x - 9, y, x - 16, y - 10, x + 16, y - 10,
    x + 9, y) } | rect { x - 17, y - 15, 34, 7, radius = 1.5 }
end

local shafts, grooves = {}, {}
for i, at in ipairs { { 316, 232, 112 }, { 362, 232, 112 }, { 408, 232, 112 }, { 454, 236, 54 } } do
  local x, y, tall = at[1], at[2], at[3]
  shafts[i] = column(x, y, tall)
  if i < 4 then shafts[i] = shafts[i] | capital(x, y - tall) end
  for k = -1, 1 do
    grooves[#grooves + 1] = stroke { points = { { x + 6 * k, y - 10 }, { x + 5 * k, y - tall } },
      width = 1.4, fill = "#6b5f5080" }
  end
  grooves[#grooves + 1] = rect { x - 12, y - tall, 24, tall - 8, fill = linear {
    from = { x - 12, 0 }, to = { x + 12, 0 }, { 0, "#fff6e000" }, { 0.45, "#3a2f2400" },
    { 1, "#2a2a2ca0" } } }
end
local beam = path { d = "M298 104H430L424 96L432 84H296Z" } | path { d = "M302 84L372 56L388 64"
  .. "L396 60L410 84Z" }
local steps = rect { 288, 232, 192, 10 } | rect { 278, 242, 202, 10 } | rect { 268, 252, 212, 18 }
local stone = union { union(shafts), beam, steps }

local temple = union { stone:paint(marble), clip(union(grooves), union(shafts)),
  rect { 298, 100, 132, 4, fill = "#4a443c70" }, rect { 288, 241, 192, 2, fill = "#4a443c60" },
  rect { 278, 251, 202, 2, fill = "#4a443c60" } }

return { sky = sky, temple = temple }
