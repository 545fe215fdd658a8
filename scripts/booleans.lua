-- The four boolean operations on the same two objects, a ripple of rings and a flower: union,
-- intersection, difference and exclusive-or. The rings themselves are an exclusive-or of discs.

local grounds = { "#15233f", "#f3e7cf", "#f0a23b", "#b93a3f" }

--- Rings: an odd number of nested discs is painted, an even number is not.
local function ripple(count, radius, texture)
  local discs = {}
  for i = 1, count do
    discs[i] = circle { 0, 0, radius * i / count, fill = texture }
  end
  return xor(discs)
end

local function flower(petals, radius, texture)
  local petal = ellipse { 0, -radius * 0.56, radius * 0.27, radius * 0.46, fill = texture }
  local list = { circle { 0, 0, radius * 0.3, fill = texture } }
  for i = 1, petals do list[i + 1] = petal:rotate(360 * i / petals) end
  return union(list)
end

--- {colour of the rings, of the flower, the operation, its sign}
local operations = {
  { "#3fa7a3", "#f7d9a0", function(a, b) return a | b end, "M0 -34V34" },
  { "#1f4e79", "#d9483b", function(a, b) return a & b end,
    "M27 30L-16 -14C-26 -38 14 -42 10 -20C6 -4 -26 0 -24 16C-20 38 20 30 24 -2" },
  { "#5b1f3a", "#fff1d6", function(a, b) return a - b end, "M-26 0H26" },
  { "#f9dfae", "#1d1a38", function(a, b) return a ~ b end, "M-30 6C-16 -22 14 22 30 -6" },
}

return film { size = { 1920, 640 }, frames = 48, frame = function(f)
  local u = f.index / f.count
  local lift = 52 + 26 * math.sin(2 * math.pi * u)
  local art = {}
  for i, operation in ipairs(operations) do
    local rings = ripple(9, 204, operation[1]):translate(-18, lift)
    local petals = flower(8, 212, operation[2]):rotate(45 * u):translate(18, -lift)
    local object = operation[3](rings, petals)
    art[#art + 1] = rect { (i - 1) * 480, 0, 480, 640, fill = grounds[i] }
    art[#art + 1] = object:translate((i - 0.5) * 480, 320)
    art[#art + 1] = stroke { d = operation[4], width = 11, cap = "round",
      fill = operation[i == 4 and 1 or 2] }:translate(i * 480 - 52, 582)
  end
  return cel(art)
end }
