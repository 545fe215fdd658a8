-- The head: hair, hat, eyes that blink, brows that help, and one of the nine mouths.
local mouths = require "demo.mouths"
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local face = {}

local function disc(x, y, rx, ry, texture)
  return ellipse { x, y, rx, ry, fill = texture }
end

local back_hair = shapes.blob({ { -128, 10 }, { -118, -120 }, { 0, -160 }, { 118, -120 },
                                { 132, 10 }, { 128, 92 }, { 60, 84 }, { 0, 60 }, { -60, 84 },
                                { -124, 92 } }, palette.hair)
local skull = disc(0, 0, 104, 97, shapes.across(-70, 130, palette.face))
local cheeks = union { disc(-68, 26, 20, 15, palette.cheek),
                       disc(50, 26, 20, 15, palette.cheek) }
local nose = disc(-10, 12, 10, 8, palette.nose)
local fringe = clip(
  union { disc(-64, -92, 82, 64, palette.hair), disc(58, -92, 92, 58, palette.hair) },
  disc(0, -2, 106, 100))
local band = shapes.ribbon({ { -118, -34, 40 }, { -70, -70, 46 }, { 0, -84, 48 }, { 70, -70, 46 },
                             { 118, -34, 40 } }, shapes.across(-90, 120, palette.wool))

--- The seconds at which the eyes are shut.
local blinks = { 0.7, 2.9, 4.3, 5.6, 8.3, 9.4 }

local function lids(time)
  local openness = 1
  for _, at in ipairs(blinks) do openness = math.min(openness, math.abs(time - at) / 0.11) end
  return math.max(0.1, openness)
end

local gaze = keys { { 1, { 0, 0 } }, { 1.3, { -3, -2 } }, { 3, { -7, -1 }, "outQuad" },
                    { 4.6, { -8, 3 }, "outQuad" }, { 6, { 0, 0 }, "outQuad" },
                    { 7.2, { -5, -7 }, "outQuad" }, { 9, { -5, -7 } } }
local brows = keys { { 1, 0 }, { 1.2, -6, "outQuad" }, { 2.6, 0, "inOutQuad" }, { 3.2, -5 },
                     { 4.2, 0 }, { 4.8, -8, "outQuad" }, { 5.6, 0, "inOutQuad" }, { 6.2, -4 },
                     { 7.5, -11, "outQuad" }, { 9.6, -5 } }

local function eye(x, dx, dy, openness)
  return union {
    disc(x + dx, -10 + dy, 11, 15 * openness, palette.ink),
    disc(x + dx - 4, -15 + dy, 3.6, 4.4 * openness, "#fff6e6"),
  }
end

local function brow(x, lift, tilt)
  return shapes.ribbon({ { x - 17, -38 + lift + tilt, 3 }, { x, -43 + lift, 7 },
                         { x + 17, -38 + lift - tilt, 3 } }, palette.hair)
end

--- A soft cone whose tip follows the wind with a delay, with a pompom.
local function hat(time)
  local swing = 12 * math.sin(time * 2.1) + 6 * math.sin(time * 3.7)
  local x, y = 92 + swing, -228 + swing * 0.4
  local cone = path { fill = shapes.across(-90, 130, palette.hat), d =
    ("M-112 -44C-104 -150 -30 -236 %g %gC%g %g 104 -140 112 -44Q0 -104 -112 -44Z"):format(
      x, y, x - 8, y + 46) }
  local pompom = disc(x + 4, y + 4, 27, 27, shapes.across(x - 20, x + 30, palette.wool))
  return union { cone, band, pompom }
end

--- The head around its own middle, with the mouth `shape`.
function face.draw(time, shape)
  local dx, dy = table.unpack(gaze:at(time))
  local openness, lift = lids(time), brows:at(time)
  return union {
    back_hair, skull, cheeks,
    nose:translate(dx, dy):named "nose",
    eye(-47, dx, dy, openness):named "left eye", eye(29, dx, dy, openness):named "right eye",
    mouths[shape]:translate(-9 + dx * 0.7, 42 + dy * 0.5):named "mouth",
    fringe, brow(-47 + dx, lift, 3):named "left brow", brow(29 + dx, lift, -3):named "right brow",
    hat(time):named "hat",
  }
end

return face
