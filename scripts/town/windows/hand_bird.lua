-- Hands make a bird on the blind; it flies away, and the hands look for it.
local window = require "town.window"
local ink = require "town.silhouette"
local mood = require("stage.moods").candle

--- A bird of two hands that are linked by their thumbs; its wings by degrees, 0 spread wide.
local function feather(degrees, x, y, long)
  return ink.limb({ x, y, 30 }, { x + 4, y - long / 2, 30 }, { x, y - long, 22 })
    :rotate(degrees, x, y)
end
local WING = path { d = "M-4 26 C-30 6 -44 -60 -30 -104 L40 -96 C50 -50 36 10 14 34 Z" }
  | feather(-20, -20, -96, 66) | feather(-6, 0, -100, 84) | feather(8, 16, -98, 76)
  | feather(24, 32, -88, 54)
local function bird(flap)
  return (WING:rotate(-66 + flap) | WING:scale(-1, 1):rotate(66 - flap)
    | path { d = "M-26 40 C-34 -4 -40 -60 -26 -84 C-14 -104 18 -102 24 -82 L54 -70 L24 -62 "
      .. "C30 -30 28 20 26 40 C18 72 10 94 0 114 C-10 94 -18 72 -26 40 Z" }) - circle { 4, -78, 6 }
end

--- In 24 drawings, the shadow: right, down, degrees, wings; nil where it is away.
local FLIGHT = { [0] = { 0, 0, 0, 0 }, { 0, 14, 0, 26 }, { 0, 0, 0, 0 }, { 0, 14, 0, 26 },
  { 0, 0, 0, 0 }, { 0, 14, 0, 26 }, { 20, -40, 14, -16 }, { 90, -110, 26, 26 },
  { 190, -220, 30, 0 }, [19] = { -190, -90, 14, 26 }, [20] = { -60, -40, 8, -10 },
  [21] = { 0, 14, 0, 26 }, [22] = { 0, 0, 0, 0 }, [23] = { 0, 14, 0, 26 } }
--- The hands after it has gone: degrees of both, and how low they are.
local LEFT, RIGHT, SAD = { -54, -38, 4 }, { 38, 54, 4 }, { -30, 30, 46 }
local SEARCH = { [12] = { -14, 14, 0 }, [13] = RIGHT, [14] = RIGHT, [15] = LEFT, [16] = LEFT,
  [17] = SAD, [18] = SAD, [19] = LEFT, [20] = { -14, 14, -10 } }

return window.film { title = "Bird of two hands", by = "in", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local n = number // 2
    local shown, flight, search = { ink.blind() }, FLIGHT[n], SEARCH[n]
    if flight then
      shown[2] = bird(flight[4]):rotate(flight[3]):translate(225 + flight[1], 270 + flight[2])
        :paint(ink.shadow)
    end
    local hands
    if search then
      hands = ink.hand():rotate(search[1]):translate(176, 520 + search[3])
        | ink.hand():scale(-1, 1):rotate(search[2]):translate(274, 520 + search[3])
    else
      local flap = flight and flight[4] or n == 9 and 26 or 0
      hands = bird(flap):scale(0.42):translate(225, 490)
        | path { d = "M205 600 L218 500 H232 L245 600 Z" }
    end
    shown[#shown + 1] = hands:paint(mood.ink)
    return shown
  end }
