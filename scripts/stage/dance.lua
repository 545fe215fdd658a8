--- A dancer who leaps, in eight drawings: as filmed, in greys, or in ink with one flat red.
local INK, RED = "#20243d", "#d8432f"

-- Of each drawing: the height of the hip, the lean of the body, and angles from straight down,
-- forwards: both bones of the near leg, the far leg, the near arm and the far arm, and the hair.
local poses = {
  { 92, 5, 25, 5, -25, -42, -32, -12, 38, 60, -40 },
  { 70, 20, 58, -30, -5, -75, -70, -62, -48, -38, -110 },
  { 102, 8, -14, -20, 80, 18, 42, 72, 74, 104, -15 },
  { 122, 2, -50, -66, 92, 62, 92, 106, 140, 166, -22 },
  { 136, -8, -86, -82, 90, 92, -84, -104, 124, 108, -62 },
  { 118, 0, -76, -104, 72, 46, -74, -92, 98, 92, -112 },
  { 78, 16, -62, -96, 50, -25, -46, -30, 64, 44, -138 },
  { 94, 6, -8, -62, 22, -8, -22, 0, 22, 42, -24 } }
local MIDDLE, GROUND = 0, 240

local function ahead(point, degrees, length)
  local angle = math.rad(degrees)
  return { point[1] + length * math.sin(angle), point[2] + length * math.cos(angle) }
end

--- A limb through points, which gets thinner.
local function limb(a, b, c, widths)
  return stroke { cap = "round", join = "round", points = { { a[1], a[2], widths[1] },
    { b[1], b[2], widths[2] }, { c[1], c[2], widths[3] } } }
end

local function leg(hip, thigh, shin)
  local knee = ahead(hip, thigh, 46)
  local ankle = ahead(knee, shin, 44)
  local toe = ahead(ankle, shin + (math.abs(shin) > 40 and 14 or 74), 15)
  return limb(hip, knee, ankle, { 21, 15, 9 }) | limb(ankle, ankle, toe, { 9, 9, 4 })
end

local function arm(shoulder, upper, fore)
  local elbow = ahead(shoulder, upper, 30)
  local wrist = ahead(elbow, fore, 27)
  return limb(shoulder, elbow, wrist, { 11, 9, 6 })
    | limb(wrist, wrist, ahead(wrist, fore - 20, 9), { 7, 7, 3 })
end

--- The dancer in drawing i: `skin`, `dress` and `hair` are its colours, and `line` that of a line.
local function dancer(i, skin, dress, hair, line)
  local p = poses[i]
  local hip = { MIDDLE, GROUND - p[1] }
  local neck = ahead(hip, 180 - p[2], 56)
  local head = ahead(neck, 180 - p[2] * 0.4, 22)
  local front = ahead(hip, math.max(p[3], p[5]) + 16, 38)
  local back = ahead(hip, math.min(p[3], p[5]) - 16, 38)
  local low = ahead(hip, (p[3] + p[5]) / 2, 30)
  local body = stroke { cap = "round", points = { { hip[1], hip[2], 24 },
    { (hip[1] + neck[1]) / 2, (hip[2] + neck[2]) / 2, 17 }, { neck[1], neck[2] + 8, 25 } } }
  local skirt = path { d = ("M%g %gQ%g %g %g %gQ%g %g %g %gQ%g %g %g %gZ"):format(
    hip[1] - 11, hip[2] - 14, back[1] / 2 - 14, (back[2] + hip[2]) / 2 - 14, back[1], back[2],
    low[1] - 8, low[2] + 10, front[1], front[2],
    front[1] / 2 + 14, (front[2] + hip[2]) / 2 - 14, hip[1] + 11, hip[2] - 14) }
  local tail = ahead({ head[1] - 10, head[2] - 6 }, p[11], 20)
  local tip = ahead(tail, p[11] * 1.25, 20)
  local art = {}
  local function put(shape, fill)
    art[#art + 1] = line and shape:paint(line):outline { width = 2.6, fill = line } or union {}
    art[#art + 1] = shape:paint(fill)
  end
  put(arm({ neck[1] + 4, neck[2] + 6 }, p[9], p[10]), skin)
  put(leg({ hip[1] + 3, hip[2] }, p[5], p[6]), skin)
  put(leg({ hip[1] - 3, hip[2] }, p[3], p[4]), skin)
  put(limb(neck, neck, head, { 10, 10, 9 }), skin)
  put(body | skirt, dress)
  put(limb({ head[1] - 8, head[2] - 6 }, tail, tip, { 9, 12, 2 }), hair)
  put(ellipse { head[1], head[2], 13, 15 }:rotate(p[2] * 0.6, head[1], head[2]), skin)
  put(path { d = "M10 -13C2 -21 -16 -17 -15 0Q-14 8 -9 11C-6 0 0 -7 10 -13Z" }
    :translate(head[1], head[2]), hair)
  put(arm({ neck[1] - 4, neck[2] + 8 }, p[7], p[8]), skin)
  return union(art)
end

local filmed, drawn = {}, {}
for i = 1, #poses do
  filmed[i] = dancer(i, "#b7aea2", "#6f675f", "#2c2926")
  drawn[i] = dancer(i, "#fff8ea", RED, INK, INK)
end

return { filmed = filmed, drawn = drawn }
