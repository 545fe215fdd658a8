-- The lamplighter: coat, scarf in the wind, one arm to tell the story and one to hold the lantern.
-- Drawn around the point between the boots, negative y is up, about 640 units tall.
local celspan = require "celspan"
local keys = require "celspan.keys"
local face = require "demo.face"
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local character = {}

local function disc(x, y, r, texture)
  return celspan.circle { centre = { x, y }, radius = r, texture = texture }
end

local cloth = shapes.across(-110, 140, palette.coat)
local trim = shapes.across(-130, 140, palette.trim)

local function coat()
  local outline = celspan.path { texture = cloth, d =
    "M-58 -300C-104 -280 -132 -120 -158 -34Q0 14 158 -34C132 -120 104 -280 58 -300Z" }
  local hem = shapes.ribbon({ { -164, -46, 26 }, { -80, -24, 26 }, { 0, -18, 26 }, { 80, -24, 26 },
                              { 164, -46, 26 } }, trim)
  local front = shapes.ribbon({ { -6, -300, 5 }, { -12, -160, 5 }, { -16, -20, 5 } },
                              palette.coat[2])
  local parts = { outline, celspan.clip(celspan.union { hem, front }, outline) }
  for i = 0, 2 do parts[#parts + 1] = disc(-34, -230 + i * 62, 9, palette.button) end
  return celspan.union(parts)
end

local boots = celspan.union {
  celspan.rect { -92, -40, 70, 44, radius = 20, texture = palette.boot },
  celspan.rect { 16, -40, 70, 44, radius = 20, texture = palette.boot },
}
local body = celspan.union { boots, coat() }
local collar = shapes.ribbon({ { -86, -306, 30 }, { -40, -284, 46 }, { 10, -278, 50 },
                               { 56, -286, 44 }, { 88, -308, 28 } },
                             shapes.across(-80, 110, palette.scarf))

--- One end of the scarf: a wave that runs along the cloth and grows.
local function tail(time, phase, length, drop)
  local points = {}
  for i = 0, 6 do
    local u = i / 6
    local wave = math.sin(time * 4.2 + phase - u * 4.4) * 26 * u
    points[i + 1] = { 40 + length * u, -290 + drop * u + wave, 40 + 8 * u }
  end
  return shapes.ribbon(points, shapes.across(40, 60 + length, palette.scarf))
end

--- Two bones from the shoulder; angles in degrees from straight down, outwards positive.
local function arm(side, upper, lower)
  local x, y = side * 76, -262
  local a, b = math.rad(upper), math.rad(upper + lower)
  local ex, ey = x + side * 92 * math.sin(a), y + 92 * math.cos(a)
  local hx, hy = ex + side * 84 * math.sin(b), ey + 84 * math.cos(b)
  local gx, gy = hx + side * 22 * math.sin(b), hy + 22 * math.cos(b)
  local wool = shapes.across(x - 60 + side * 30, x + 90 + side * 30, palette.coat)
  local sleeve = disc(x, y, 25, wool)
    | shapes.ribbon({ { x, y, 50 }, { ex, ey, 55 }, { hx, hy, 58 } }, wool)
  local cuff = shapes.ribbon({ { hx - side * 9 * math.sin(b), hy - 9 * math.cos(b), 62 },
                               { hx + side * 9 * math.sin(b), hy + 9 * math.cos(b), 64 } }, trim)
  local hand = celspan.union { disc(gx, gy, 23, palette.skin),
    disc(gx + side * 14 * math.cos(b), gy - 16 * math.sin(math.abs(b)) - 4, 10, palette.skin) }
  return celspan.union { hand, sleeve, cuff }, gx, gy
end

--- upper and lower arm: rest, offer the hills, the houses, the stars.
local telling = keys {
  { 0.9, { 16, 12 } }, { 1.5, { 34, 70 }, "outBack" }, { 2.6, { 28, 62 }, "inOutSine" },
  { 3.3, { 72, 30 }, "outBack" }, { 4.2, { 66, 24 }, "inOutSine" },
  { 4.9, { 50, 18 }, "inOutQuad" }, { 5.6, { 46, 26 }, "inOutSine" },
  { 6.4, { 40, 60 }, "inOutSine" }, { 7.4, { 138, 10 }, "outBack" },
  { 9.0, { 132, 14 }, "inOutSine" }, { 10, { 130, 12 } },
}

local function lantern(x, y, swing)
  local glass = celspan.path { d = "M-24 34L24 34L30 94L-30 94Z", texture = "#ffdf9c" }
  local frame = celspan.union {
    shapes.ribbon({ { -20, 30, 5 }, { 0, -2, 5 }, { 20, 30, 5 } }, palette.brass),
    celspan.polygon { { -34, 36 }, { 0, 16 }, { 34, 36 }, texture = palette.brass },
    celspan.rect { -36, 92, 72, 12, radius = 5, texture = palette.brass },
    celspan.rect { -3, 34, 6, 60, texture = palette.brass },
  }
  local function place(v) return v:rotate(swing):translate(x, y) end
  local turn = math.rad(swing)
  return place(glass), place(frame), { x - 66 * math.sin(turn), y + 66 * math.cos(turn) }
end

--- figure, lantern's glass, lantern's frame, position of its flame; all in the figure's units.
function character.draw(time, shape)
  local sway = math.sin(time * 1.7)
  local story = arm(-1, table.unpack(telling:at(time)))
  local holding, gx, gy = arm(1, 30 + sway * 1.5, 44 + sway * 2)
  local glass, frame, flame = lantern(gx, gy, 5 * math.sin(time * 2.6))
  local head = face.draw(time, shape)
    :rotate(2.4 * math.sin(time * 2.3) - 2):translate(sway * 2, -392 + sway):named "head"
  local figure = celspan.union {
    tail(time, 0, 250, 40), tail(time, 1.3, 200, 96), holding:named "lantern arm", body,
    story:named "telling arm", head, collar }
  return figure, glass, frame, flame
end

return character
