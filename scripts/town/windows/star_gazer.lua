-- A telescope in a dormer turns from the star to us, and one enormous eye blinks.
local window = require "town.window"
local telescope = require "town.telescope"
local mood = require("stage.moods").storm

--- In 24 drawings: the tube's degrees, how far it is turned to us; how far the eye is open, where
--- it looks, and how wide its pupil is.
local acting = keys { { 0, { -125, 0, 0, 0, 1 } }, { 4, { -125, 0, 0, 0, 1 } },
  { 5, { -134, 0, 0, 0, 1 } }, { 6, { -110, 0.14, 0, 0, 1 } }, { 7, { -80, 0.5, 0, 0, 1 } },
  { 8, { -60, 0.94, 0, 0, 1 } }, { 9, { -60, 1, 0.05, 0, 1 } }, { 10, { -60, 1, 1.2, 0, 0.7 } },
  { 11, { -60, 1, 1, 0, 1 } }, { 12, { -60, 1, 0.9, -1, 1 } }, { 13, { -60, 1, 0.9, -1, 1 } },
  { 14, { -60, 1, 0.9, 1, 1 } }, { 15, { -60, 1, 0.9, 1, 1 } }, { 16, { -60, 1, 1, 0, 1.2 } },
  { 17, { -60, 1, 0.05, 0, 1 } }, { 18, { -60, 1, 1.25, 0, 1.5 } },
  { 20, { -60, 1, 1.25, 0, 1.5 } }, { 21, { -70, 0.7, 0, 0, 1 } }, { 22, { -100, 0.2, 0, 0, 1 } },
  { 23, { -130, 0, 0, 0, 1 } } }

local NIGHT = rect { 0, 0, 600, 600, fill = mood.ink }
--- Who looks: a hat with a star, a nose at the glass, a beard.
local GAZER = (path { d = "M404 452 C396 468 384 484 392 490 C400 496 412 490 416 492 "
    .. "C400 540 420 590 460 640 H600 V540 C560 520 532 500 530 460 L536 420 Z" }
  | path { d = "M382 424 C420 440 510 430 562 396 L524 396 C520 330 540 270 560 220 "
    .. "C490 260 430 330 418 404 Z" }) - (star { 470, 356, 24, 10 }
  | stroke { d = "M426 466 q12 9 26 0", width = 6, cap = "round" })
local TRIPOD = path { d = "M300 340 L200 640 H216 L310 360 L320 640 H336 L324 340 Z" }

return window.film { title = "The star gazer", by = "in", seconds = 4, size = { 600, 600 },
  pane = "round", drawing = function(_, number)
    local step = number // 2
    local degrees, toward, open, look, wide = table.unpack(acting:at(step))
    local tube, glass = telescope.tube(276, 308, degrees, toward)
    local shown = { NIGHT }
    if toward < 1 then
      shown[2] = (GAZER | TRIPOD):translate(-36, -22):paint(mood.light)
        | star { 146, 98, 40 - 14 * (step % 2), 9, points = 4, fill = mood.accent }
    end
    shown[#shown + 1] = tube:paint(mood.light)
    shown[#shown + 1] = glass:paint(mood.ink)
    if open > 0 then
      local white, iris, pupil = telescope.eye(open, look, wide)
      shown[#shown + 1] = white:paint(mood.light) | iris:paint(mood.accent)
        | pupil:paint(mood.ink)
    end
    return shown
  end }
