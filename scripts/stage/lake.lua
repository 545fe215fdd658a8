--- The shore of a lake in the fog: firs, a jetty with a lantern, a heron. The water begins at 150.
local mood = require("stage.moods").fog
local mist, ink = "#dcdfd6", mood.ink

--- A hill with firs on it, from the left edge to the right one.
local function wood(seed, y, height, tint)
  local random, points = celspan.random(seed), { { -20, 150 }, { -20, y } }
  for x = -14, 488, 17 do
    local foot = y - 9 * math.sin(x / 70 + #seed)
    local tall = height * (0.35 + 0.65 * random("tall" .. x) * (0.6 + 0.4 * math.sin(x / 40)))
    for _, at in ipairs { { -6, 0 }, { -2.6, 0.46 }, { -4, 0.42 }, { 0, 1 }, { 4, 0.42 },
      { 2.6, 0.46 }, { 6, 0 } } do
      points[#points + 1] = { x + 1.4 * at[1], foot - tall * at[2] }
    end
  end
  points[#points + 1] = { 500, 150 }
  points.fill = linear { from = { 0, y - height }, to = { 0, 150 }, { 0, tint }, { 1, mist } }
  return polygon(points)
end

local function line(d, width, tint)
  return stroke { d = d, width = width, cap = "round", join = "round", fill = tint or ink }
end

local heron = union {
  line("M-3 0V-30M5 0L4 -16L7 -32", 1.7),
  path { d = "M-31 -28C-20 -36 -8 -54 14 -52C20 -50 20 -42 14 -36C4 -28 -14 -28 -31 -28Z",
    fill = mood.near },
  path { d = "M-31 -27C-22 -33 -12 -42 2 -43C2 -34 -8 -28 -31 -27Z", fill = ink },
  line("M13 -46C24 -54 6 -64 10 -76C12 -83 18 -85 22 -84", 4.6, mood.ground),
  line("M12 -44C16 -40 14 -34 12 -32", 2.4, mood.light),
  path { d = "M17 -87Q24 -89 27 -84L44 -81L26 -80Q19 -79 17 -87Z", fill = mood.ground },
  path { d = "M27 -84L44 -81L26 -80.5Z", fill = "#d99a3c" },
  line("M24 -86Q14 -89 4 -80", 1.8), circle { 23, -84.4, 1.2, fill = mood.light } }

local jetty = union {
  rect { 262, 118, 240, 5, fill = ink }, rect { 262, 123, 240, 3, fill = mood.ground },
  stroke { d = "M274 112V150M332 114V150M398 114V150M462 114V150", width = 5, fill = ink },
  line("M290 119V54Q290 46 298 46H309M290 62L299 47", 3.4), line("M309 46V54", 1.6) }
local glass = path { d = "M302 60H316L314 80H304Z", fill = "#ffd27a" }
local glow = radial { centre = { 309, 70 }, radius = 30, { 0, rgb("#ffb347", 0.7) },
  { 0.5, rgb("#ffb347", 0.2) }, { 1, rgb("#ffb347", 0) } }
local lantern = circle { 309, 70, 30, fill = glow } | glass
  | path { d = "M299 61L309 51L319 61ZM302 80H316V84H302Z", fill = mood.accent }

local reeds = union {}
for i = 1, 26 do
  local random = celspan.random("reed" .. i)
  local x, tall, lean = 66 * random "x" ^ 1.5 - 6, 24 + 46 * random "y", 14 * (random "lean" - 0.3)
  reeds = reeds | path { fill = i % 3 == 0 and mood.near or mood.ground,
    d = ("M%g 152Q%g %g %g %gQ%g %g %g 152Z"):format(x - 1.4, x - 1, 150 - tall / 2, x + lean,
      150 - tall, x + 1.6, 150 - tall / 2, x + 1.4) }
end

return union {
  rect { -20, -20, 520, 170, fill = linear { from = { 0, 0 }, to = { 0, 150 },
    { 0, mood.sky[1] }, { 0.6, mood.sky[2] }, { 1, mood.sky[3] } } },
  circle { 398, 58, 25, fill = mood.light },
  wood("far wood", 122, 62, "#b3bfba"), wood("wood", 142, 84, "#879997"),
  jetty, lantern, reeds, heron:scale(1.12):translate(166, 150) }
