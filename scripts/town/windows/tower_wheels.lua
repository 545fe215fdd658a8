-- The wheels of the clock in the tower; a pigeon goes round on one, tooth by tooth.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

--- A wheel of `teeth` teeth; half a tooth on, if moved.
local function wheel(teeth, outer, moved, fill, edge)
  local parts = {}
  local inner = outer - 26
  for i = 0, 2 * teeth - 1 do
    local a = math.pi * (i + (moved and 0.5 or 0)) / teeth
    local r, w = i % 2 == 0 and outer or inner, 0.4 * math.pi / teeth
    for side = -1, 1, 2 do
      parts[#parts + 1] = { r * math.sin(a + side * w), -r * math.cos(a + side * w) }
    end
  end
  parts.fill = fill
  local ring = polygon(parts) - circle { 0, 0, inner - 34 }
  local spokes = line(("M%g 0 H%g M0 %g V%g"):format(34 - inner, inner - 34, 34 - inner,
    inner - 34), 22,
    fill):rotate(moved and 90 / teeth or 0)
  return union { spokes, ring, circle { 0, 0, 34, fill = fill }, circle { 0, 0, 14, fill = edge } }
end

local gold, dark = wash(-120, -100, 110, 120, "#c9752f", mood.near, mood.ground), "#d98f42"
local big = { wheel(12, 132, false, gold, mood.light), wheel(12, 132, true, gold, mood.light) }
local small = { wheel(12, 150, false, dark, mood.near), wheel(12, 150, true, dark, mood.near) }

local room = union {
  gouache.wall(90, 170, 620, mood.light, mood.sky[2], mood.sky[3], "#b9662f", mood.ground),
  form("#5f2f1b", "M0 552 H450 V600 H0 Z"),
}

--- A pigeon whose feet are at 0, 0; its wing is up or down, its head bobs.
local function pigeon(up, bob)
  return union { line("M-8 0 V-16 M10 0 V-16", 5, "#c8553d"),
    form("#5f8486", "M-58 -26 L-86 -8 L-46 -14 C-30 -6 10 -4 30 -20 C46 -34 40 -58 34 -66 "
      .. "C20 -70 4 -62 -10 -56 C-30 -50 -46 -42 -58 -26 Z"),
    form(mood.accent, "M24 -38 C26 -52 22 -64 20 -72 L48 -72 C50 -56 46 -44 38 -34 "
      .. "Z"):translate(bob, 0),
    form(nil, "M16 -72 C16 -92 48 -94 50 -74 L64 -66 L48 -62 C40 -54 20 -56 16 -72 Z")
      :translate(bob, 0):paint("#56767a"), circle { 37, -76, 4.5,
        fill = mood.light }:translate(bob, 0),
    up and form("#345257", "M-30 -40 C-50 -70 -60 -100 -52 -120 C-20 -104 10 -70 12 -44 Z")
      or form("#345257", "M-50 -24 C-36 -50 -6 -52 14 -44 C6 -24 -24 -18 -50 -24 Z") }
end

return window.film { title = "The wheels of the clock", by = "ga", seconds = 4,
  drawing = function(_, number)
  local n = number // 4
  local pose = n % 2 + 1
  local angle = 30 * n
  local flies = angle > 100 and angle < 270
  local a = math.rad(angle)
  return { room, small[pose]:scale(-1, 1):translate(420, 540),
    pigeon(flies and n % 2 == 0,
      n % 2 * 6):scale(1.05):rotate(angle):translate(225 + 128 * math.sin(a),
      356 - 128 * math.cos(a)), big[pose]:translate(225, 356) }
end }
