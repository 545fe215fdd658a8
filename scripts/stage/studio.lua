--- A presenter before a green cloth: what was filmed.
local cloth = rect { 0, 0, 480, 270, fill = radial { centre = { 300, 120 }, radius = 330,
  { 0, "#3ec45c" }, { 1, "#27963f" } } }

local jacket = path { fill = "#d8573f", d = [[M256 280 C258 226 276 208 322 198 L352 226 L382 198
  C428 208 448 226 452 280 Z]] }
local shirt = path { d = "M322 198 L352 250 L382 198 L372 190 H332 Z", fill = "#f7efe2" }
local lapels = path { fill = "#b8432f", d = [[M322 198 L314 212 L344 262 L352 240 Z M382 198
  L390 212 L360 262 L352 240 Z]] }
local neck = path { d = "M334 164 H370 V196 Q352 214 334 196 Z", fill = "#b9764f" }
local face = path { fill = "#d7946a", d = [[M312 116 C310 78 394 78 392 116 C392 150 376 182 352 182
  C328 182 312 150 312 116 Z]] }
local blush = ellipse { 324, 144, 9, 6, fill = "#d9795a90" } | ellipse { 378, 144, 9, 6,
  fill = "#d9795a90" }

--- Eyes, brows, nose and mouth; `open` is how far she speaks, `lid` how far her eyes are closed.
local function features(open, lid)
  local shape = ellipse { 0, 0, 7, 4.4 * (1 - lid) + 0.6 }
  local eye = clip(shape:paint "#fdf8ee" | circle { -1.2, 0, 4.4, fill = "#3a2a22" }
    | circle { -2.4, -1.4, 1.3, fill = "#fff" }, shape)
    | stroke { d = "M-8 -1 Q0 -7 8 -2", width = 2, cap = "round", fill = "#3a2219" }
  local lines = stroke { width = 3, cap = "round", fill = "#3a2219",
    d = "M326 113 Q334 107 343 111 M361 111 Q370 107 378 113" }
  local nose = stroke { d = "M351 128 Q346 142 347 146 Q350 149 355 147", width = 2.4,
    cap = "round", fill = "#a8663f" }
  local mouth = path { fill = "#7e2a2c", d = ("M336 156 Q351 %g 368 155 Q352 %g 336 156 Z")
    :format(161 - open, 168 + 8 * open) }
  return union { lines, eye:translate(335, 124), eye:translate(369, 124), nose, mouth }
end

--- Curls that hang from the crown and sway: thin strands, which show what a key is worth.
local function hair(time, from, to)
  local strands, chance = {}, random "hair"
  for i = from, to do
    local angle = math.rad(200 + 140 * (i % 43) / 42)
    local length = 62 + 46 * chance(i)
    local x, y = 352 + 41 * math.cos(angle), 112 + 38 * math.sin(angle)
    local out = math.cos(angle) * (20 + 26 * chance(2 * i))
    local sway = 4 * math.sin(2 * math.pi * time + 5 * chance(3 * i))
    local curl = 9 * (chance(4 * i) < 0.5 and 1 or -1)
    strands[#strands + 1] = stroke { degree = 3, cap = "round", taper = { 0, 30 },
      fill = ({ "#2e1c17", "#47291d", "#5e3623" })[i % 3 + 1],
      width = 2 + 3.5 * chance(5 * i), points = { { 352 + 8 * math.cos(angle), 84 }, { x, y - 8 },
        { x + out + curl, y + length * 0.4 }, { x + out - curl + sway, y + length * 0.75 },
        { x + 1.3 * out + curl + 1.6 * sway, y + length } } }
  end
  return union(strands)
end

--- Her arm, which points at the map.
local function arm(lift)
  local x, y = 214, 132 + lift
  local sleeve = stroke { points = { { 286, 232 }, { 244, 214 + lift / 3 }, { x + 14, y + 26 } },
    degree = 2, width = 30, cap = "round", fill = "#c94e38" }
  local hand = circle { x + 6, y + 10, 12, fill = "#d7946a" }
    | stroke { d = ("M%g %g l-24 -17"):format(x + 2, y + 7), width = 7, cap = "round",
      fill = "#d7946a" }
  return sleeve | hand
end

--- What was filmed. Of a real take: image { file = "take.####.png", frame = f.number }.
local function take(f)
  local u = f:on(4) / f.count
  local open = 0.5 + 0.5 * math.sin(2 * math.pi * 4 * u) * math.cos(2 * math.pi * u)
  local lid = math.max(0, 1 - math.abs(u - 0.7) / 0.05)
  local nod = 2 * math.sin(4 * math.pi * u)
  local head = union { face, blush, features(open, lid) }
  local front = union { neck, jacket, shirt, lapels }
  local her = union { hair(u, 1, 70), front, head:rotate(nod, 352, 180),
    hair(u, 71, 84):rotate(nod, 352, 180), arm(10 * math.sin(2 * math.pi * u)) }
  local spill = her:paint(rgb("#3ec45c", 0.03)) -- the green light that the cloth throws on her
  return group { cloth, her, spill }:blur(0.6)
end

return take
