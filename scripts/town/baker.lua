-- The baker of two windows, and his bread. The light comes from the right.
local gouache = require "town.gouache"
local mood = require("stage.moods").candle
local wash, form, line = gouache.wash, gouache.form, gouache.line

local baker = {}

baker.loaf = form(wash(0, -30, 0, 24, "#f2b35c", "#a3521d"), "M-50 22 C-62 -8 -34 -30 0 -30 "
  .. "C34 -30 62 -8 50 22 Z") | line("M-26 -14 L-14 4 M-4 -18 L8 2 M18 -16 L28 0", 5, "#ffe0a0")

local hat = form("#fff3d6", "M-42 -28 C-46 -50 -44 -60 -50 -72 C-84 -96 -60 -136 -30 -126 "
  .. "C-18 -152 26 -150 32 -126 C64 -134 84 -98 52 -72 C46 -60 46 -48 42 -28 "
  .. "C20 -38 -20 -38 -42 -28 Z")
  | form("#d9a878", "M-42 -28 C-46 -50 -44 -60 -50 -72 C-84 -96 -60 -136 -30 -126 "
  .. "C-44 -104 -36 -84 -24 -72 C-20 -58 -20 -46 -20 -34 Z")
local moustache = form("#6b3418", "M0 20 C14 14 30 20 38 34 C24 40 8 38 0 30 "
  .. "C-8 38 -24 40 -38 34 C-30 20 -14 14 0 20 Z")

--- The baker about x, behind something from y = 420 down. fields: x; y: of his neck; left, right:
--- where his hands are; face, eyes, brow: as of gouache.head. Hands are drawn by baker.hand, later.
function baker.draw(fields)
  local x, y = fields.x, fields.y
  local white = wash(x - 134, 0, x + 136, 0, "#9a6242", "#e3b98a", "#fff3d6")
  local body = form(nil, "M-124 420 C-134 350 -122 %g -54 %g C-24 %g 26 %g 56 %g "
    .. "C122 %g 132 350 122 420 Z",
    y + 60, y + 30, y + 20, y + 20, y + 30, y + 60):translate(x, 0):paint(white)
  local function sleeve(from, to, side)
    return gouache.arm { from = { from, y + 70 }, to = to, parts = { 84, 84 }, side = side,
      widths = { 62, 52, 34 }, fill = white }
  end
  local left, right = sleeve(x - 88, fields.left, -1), sleeve(x + 88, fields.right, 1)
  return union { gouache.edged(body, "#fff8e4", "#7a4a30", -6, 3),
    form(mood.accent, "M-48 34 C-24 50 26 50 50 34 L36 60 L2 86 L-34 60 Z"):translate(x, y),
    gouache.head { x = x, y = y - 6, face = fields.face, skin = baker.skin(x), scale = 0.98,
      eyes = fields.eyes, brow = fields.brow, front = hat | moustache, brows = "#6b3418",
      mouth = fields.mouth or "M-6 40 Q0 44 6 40" },
    left:translate(6, 2):paint("#7a4a30"), left, right:translate(-6, 2):paint("#8a5538"), right }
end

--- The wash of his skin about x.
function baker.skin(x) return wash(x - 64, 0, x + 66, 0, "#b06a42", "#ffcf9c") end

--- One of his hands, of a baker about x.
function baker.hand(x, at)
  return circle { 0, 0, 21 }:translate(at[1], at[2]):paint(baker.skin(x))
end

return baker
