-- The pond of pencil.lua, in the colours of a palette: lists of objects by depth, for `multiplane`.
local function cloud(x, y, w, fill)
  return rect { x, y, w, 22, radius = 11, fill = fill } | rect { x + 0.2 * w, y - 15, 0.5 * w, 30,
    radius = 15, fill = fill }
end

--- Rounded tops of trees in a row; `seed` is another row.
local function wood(base, size, step, seed, fill)
  local chance, trees = random(seed), { rect { -400, base, 2080, 120, fill = fill } }
  for x = -380, 1660, step do
    local r = size * (0.6 + 0.6 * chance(x))
    trees[#trees + 1] = ellipse { x, base + 8, r * 0.8, r, fill = fill }
  end
  return union(trees)
end

local function gleams(count, fill)
  local chance, list = random "gleams", {}
  for i = 1, count do
    local y = 452 + 190 * chance("y" .. i) ^ 1.6
    local w = 20 + 0.5 * (y - 420) * chance("w" .. i)
    list[i] = rect { -150 + 1580 * chance("x" .. i), y, w, 3 + (y - 440) / 60, radius = 2,
      fill = fill }
  end
  return union(list)
end

--- A leaf of a lily, seen from the side, with its veins.
local function leaf(x, y, rx, ry, p)
  local veins = {}
  for i = -3, 3 do
    veins[#veins + 1] = stroke { points = { { x, y }, { x + i * 0.3 * rx,
      y + ry * (0.86 - 0.05 * i * i) } },
      width = ry / 26, fill = p.pad }
  end
  return ellipse { x, y + 0.22 * ry, rx * 1.02, ry, fill = p.reed }:fade(0.3)
    | ellipse { x, y + 0.1 * ry, rx, ry, fill = p.pad } | ellipse { x, y, rx * 0.985, ry * 0.94,
      fill = p.rim }
    | union(veins)
end

local function lily(x, y, s, p)
  local petals = {}
  for i, turn in ipairs { -62, 62, -32, 32, 0 } do
    petals[i] = path { d = "M0 0 C-17 -16 -14 -40 0 -56 C14 -40 17 -16 0 0 Z",
      fill = i > 2 and p.petal or p.flower }:rotate(turn)
  end
  return union(petals):scale(s, 0.8 * s):translate(x, y)
end

--- Reeds from below: stems that lean, some with a cat's tail.
local function reeds(x, count, seed, p)
  local chance, list = random(seed), {}
  for i = 1, count do
    local at, lean = x + 170 * chance("x" .. i), 90 * chance("l" .. i) - 45
    local top = 190 + 260 * chance("t" .. i)
    list[#list + 1] = path { fill = p.reed,
      d = ("M%g 800 Q%g %g %g %g Q%g %g %g 800 Z"):format(at - 9, at - 4,
      top + 200, at + lean, top, at + 8, top + 220, at + 10) }
    if i % 3 == 1 then
      list[#list + 1] = rect { at + lean - 9, top - 6, 18, 84, radius = 9, fill = p.mouth }
        :rotate(-0.1 * lean, at + lean, top + 40)
    end
  end
  return union(list)
end

--- Planes behind the leaf on which he sits, that leaf, and a plane in front of it.
return function(p)
  local sky = linear { from = { 0, 0 }, to = { 0, 470 }, { 0, p.sky }, { 1, p.haze } }
  local water = linear { from = { 0, 430 }, to = { 0, 700 }, { 0, p.far }, { 1, p.water } }
  return {
    { rect { -400, -400, 2080, 900, fill = sky }, circle { 270, 150, 84, fill = p.sun },
      cloud(70, 196, 240, p.cloud), cloud(690, 232, 210, p.cloud), cloud(1130, 90, 180, p.cloud),
      z = 3000 },
    { path { fill = p.hill, d = "M-400 480 V390 C-150 300 60 300 250 370 C420 300 640 280 820 372 "
      .. "C1010 290 1260 300 1680 400 V480 Z" }, z = 1800 },
    { wood(412, 74, 62, "wood", p.wood), z = 1100 },
    { rect { -400, 432, 2080, 700, fill = water }, gleams(46, p.gleam),
      leaf(150, 520, 92, 13, p), leaf(1060, 548, 120, 18, p), lily(1090, 545, 1, p), z = 500 },
  }, leaf(610, 622, 430, 52, p) | lily(1004, 602, 0.95, p),
    { reeds(-40, 9, "left", p), reeds(1150, 9, "right", p), z = -180 }
end
