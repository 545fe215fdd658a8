-- The cat: its key drawings, and the times at which one follows another.
local when = require "timing"

-- A part of a drawing is a line through points { x, y, width }; the paws are on 0, 0. The head has
-- a place and a tilt. Parts that a drawing does not have are taken from the first drawing.
local drawings = {
  sit = {
    back = { { -30, -34, 74 }, { -30, -82, 66 }, { -2, -122, 50 }, { 12, -142, 40 } },
    fore = { { -2, -100, 36 }, { 14, -50, 22 }, { 18, -8, 17 } },
    hind = { { -28, -34, 62 }, { 2, -14, 34 }, { 22, -8, 17 } },
    tail = { { -52, -18, 20 }, { -98, -6, 19 }, { -128, -34, 17 }, { -112, -72, 14 },
      { -136, -92, 11 } },
    head = { { 26, -164, -8 } },
  },
  look = {
    back = { { -30, -34, 74 }, { -34, -82, 66 }, { -8, -124, 50 }, { 4, -146, 40 } },
    head = { { 16, -172, -34 } },
  },
  crouch = {
    back = { { -56, -56, 76 }, { -26, -68, 66 }, { 14, -50, 54 }, { 34, -52, 44 } },
    fore = { { 14, -44, 36 }, { 30, -26, 24 }, { 48, -8, 17 } },
    hind = { { -58, -48, 68 }, { -22, -20, 36 }, { -32, -8, 17 } },
    tail = { { -84, -50, 20 }, { -124, -64, 19 }, { -150, -98, 17 }, { -140, -130, 14 },
      { -156, -150, 11 } },
    head = { { 60, -74, -34 } },
  },
  leap = {
    back = { { -56, -34, 60 }, { -20, -66, 56 }, { 20, -98, 52 }, { 34, -118, 42 } },
    fore = { { 26, -92, 36 }, { 84, -98, 23 }, { 126, -128, 17 } },
    hind = { { -58, -30, 54 }, { -78, 16, 32 }, { -122, 26, 16 } },
    tail = { { -84, -40, 19 }, { -122, -58, 18 }, { -156, -42, 16 }, { -186, -54, 13 },
      { -216, -44, 10 } },
    head = { { 52, -148, -30 } },
  },
  dive = {
    back = { { -58, -96, 62 }, { -22, -96, 58 }, { 18, -74, 52 }, { 36, -70, 42 } },
    fore = { { 24, -70, 34 }, { 54, -40, 23 }, { 72, -10, 17 } },
    hind = { { -60, -92, 56 }, { -84, -56, 32 }, { -122, -66, 16 } },
    tail = { { -88, -108, 20 }, { -122, -134, 19 }, { -140, -172, 17 }, { -124, -206, 14 },
      { -136, -234, 11 } },
    head = { { 64, -86, 8 } },
  },
  land = {
    back = { { -44, -74, 66 }, { -24, -66, 62 }, { 12, -42, 54 }, { 30, -44, 44 } },
    fore = { { 16, -40, 36 }, { 36, -22, 24 }, { 48, -8, 17 } },
    hind = { { -44, -66, 60 }, { -34, -28, 34 }, { -22, -8, 17 } },
    tail = { { -74, -84, 20 }, { -104, -116, 19 }, { -108, -156, 17 }, { -84, -184, 14 },
      { -92, -212, 11 } },
    head = { { 58, -58, 16 } },
  },
}

-- The acting: the second at which a drawing is reached, and the ease on the way to it.
local acting = {
  { 0.4, "sit" }, { 0.8, "look", "inOutQuad" }, { when.crouch, "look" },
  { when.crouch + 0.3, "crouch", "inOutCubic" }, { when.leap - 0.05, "crouch" },
  { when.leap + 0.12, "leap", "outQuad" }, { when.catch + 0.1, "leap" },
  { when.land - 0.05, "dive", "inOutQuad" }, { when.land + 0.08, "land", "outQuad" },
  { when.land + 0.2, "land" }, { when.land + 0.75, "sit", "outBack" },
}
local pose = {} -- pose[part]: the points of a part at a time
for part, points in pairs(drawings.sit) do
  local track = {}
  for i, key in ipairs(acting) do
    track[i] = { key[1], drawings[key[2]][part] or points, key[3] }
  end
  pose[part] = keys(track)
end

local FROM, TO, HEIGHT = 230, 730, 165 -- where the leap begins and ends, and how high it goes

--- The place of the paws during the leap, from the ridge of the roof: a parabola.
local function place(time)
  local u = motion.span(time, when.leap, when.land - when.leap)
  return FROM + (TO - FROM) * u, -4 * HEIGHT * u * (1 - u)
end

local function line(points)
  return stroke { points = points, degree = 3, cap = "round", join = "round" }
end

local face = ellipse { 0, 0, 37, 32 }
  | path { d = "M-31 -14 L-27 -58 L-2 -30 Z M4 -30 L24 -58 L32 -14 Z" }
  | ellipse { 25, 12, 17, 13 }
local eye = ellipse { 16, -4, 5, 7, fill = "#ffe7a3" }

local cat = { reach = { (FROM + TO) / 2 + 136, -HEIGHT - 142 } } -- just in front of the paws

--- The place of the star that hangs at its neck.
function cat.neck(time)
  local x, y = place(time)
  local neck = pose.back:at(time)[4]
  return x + neck[1] + 10, y + neck[2] + 22
end

--- The cat in its coat, by the moon and by `lamps`, the paint of their light.
function cat.draw(time, coat, lamps)
  local tail = {}
  for i, p in ipairs(pose.tail:at(time)) do -- the tail sways, most at its tip
    tail[i] = { p[1] + 3 * i * math.sin(3 * time - 0.6 * i), p[2], p[3] }
  end
  local is_tense = time > when.crouch + 0.3 and time < when.leap - 0.05
  local wiggle = is_tense and 5 * math.sin(26 * time) or 0
  local fore, hind = pose.fore:at(time), pose.hind:at(time)
  local x, y, tilt = table.unpack(pose.head:at(time)[1])

  local rear = line(tail) | line(pose.back:at(time)) | line(hind)
    | line(hind):rotate(-13, hind[1][1], hind[1][2])
  local body = rear:translate(wiggle, 0) | line(fore) | line(fore):rotate(9, fore[1][1], fore[1][2])
    | face:rotate(tilt):translate(x, y)
  -- Light from one side: the part of a shape that the same shape, moved to the other side, does not
  -- cover.
  local moonlit, lamplit = body - body:translate(5, 4), body - body:translate(-4, 2)
  return (body:paint(coat) | moonlit:paint "#d88fae" | lamplit:paint(lamps)
    | eye:rotate(tilt):translate(x, y)):translate(place(time))
end

return cat
