-- Three cuckoos out of step; a fourth door opens, and a mouse cries cuckoo.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").harvest
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = gouache.wall(225, 330, 480, mood.light, mood.sky[2], mood.sky[3], "#c9752f", mood.near)
local ROOF = wash(0, -150, 0, 0, "#a9572b", "#5f2f1b")

--- A clock like a house, its door at 0, 0; it swings by one of its two poses.
local house = union {
  form(wash(-90, 0, 90, 0, "#b9662f", "#7a3b22"), "M-70 120 V-28 L0 -94 L70 -28 V120 Z"),
  form(ROOF, "M-94 -22 L0 -104 L94 -22 L84 -4 L0 -74 L-84 -4 Z"),
  circle { 0, 76, 34, fill = mood.light }, line("M0 76 V52 M0 76 L16 84", 4.5, "#5f2f1b"),
  form("#33180f", "M-26 26 V-16 C-26 -44 26 -44 26 -16 V26 Z"),
}
local leaf = form("#b9772f", "M-26 26 V-16 C-26 -26 -20 -32 -14 -35 V26 Z")
local door = form("#e0a050", "M-26 26 V-16 C-26 -44 26 -44 26 -16 V26 Z") | circle { 14, 2, 3.5,
  fill = "#7a3b22" }

local bird = union {
  form(wash(0, -30, 0, 30, "#3b9499", mood.accent), "M-24 22 C-30 -8 -18 -36 2 -36 "
    .. "C22 -36 28 -14 24 6 C22 20 14 26 0 26 C-10 26 -20 26 -24 22 Z"),
    circle { -6, -16, 4.5, fill = "#33180f" },
  form(mood.light, "M-16 22 C-18 0 -4 -4 6 6 C8 18 0 26 -10 26 Z"),
}
local beaks = { form("#f5c56b", "M-16 -16 L-40 -8 L-14 -4 Z"),
  form("#f5c56b", "M-16 -18 L-42 -24 L-16 -10 Z") | form("#e08a2c", "M-16 -10 L-38 2 L-12 -2 Z") }

local mouse = union {
  circle { -24, -30, 19, fill = "#8a6a58" }, circle { 24, -30, 19, fill = "#8a6a58" },
  circle { -24, -29, 11, fill = "#e0a48c" }, circle { 24, -29, 11, fill = "#e0a48c" },
  form("#a3806c", "M-30 -2 C-30 -32 30 -32 30 -2 C28 16 14 28 0 28 C-14 28 -28 16 -30 -2 Z"),
  circle { -11, -6, 5, fill = "#33180f" }, circle { 11, -6, 5, fill = "#33180f" },
  circle { 0, 7, 5, fill = "#c9553d" },
}

--- A clock at x, y whose door is shut, or from which "bird", "staring" or "mouse" looks out.
local function clock(x, y, who, cry)
  local shown = house | (who and leaf or door)
  if who == "mouse" then
    shown = shown | (mouse | (cry and ellipse { 0, 19, 6, 7, fill = "#7a2c22" } or union {}))
      :scale(1.5):translate(0, cry and -6 or 4)
  elseif who then
    local flip = who == "staring" and x < 200 and -1 or 1
    shown = shown | (bird | beaks[cry and 2 or 1]):scale(1.3 * flip, 1.3)
      :translate(cry and -12 or -4 * flip, cry and 4 or 0)
  end
  return shown:translate(x, y)
end

local function pendulum(x, y, swing)
  return line(("M%g %g L%g %g"):format(x, y, x + 18 * swing, y + 46), 4, "#5f2f1b")
    | circle { 0, 0, 12, fill = "#f7cf78" }:translate(x + 18 * swing, y + 46)
end

return window.film { title = "Cuckoo", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  --- Who is out of clock i, and whether it cries.
  local function out(i)
    if i == 4 then return n >= 12 and n < 21 and "mouse", n == 14 or n == 16 end
    local at = n - 3 * (i - 1)
    if at >= 0 and at < 5 then return "bird", at % 2 == 0 end
    return n > 15 and n < 21 and "staring", false
  end
  local shown = { room }
  for i, place in ipairs { { 122, 240 }, { 330, 230 }, { 118, 450 }, { 332, 440 } } do
    local swing = (n + i) % 4 < 2 and 1 or -1
    shown[#shown + 1] = i < 3 and pendulum(place[1], place[2] + 112, swing) or union {}
    shown[#shown + 1] = clock(place[1], place[2], out(i))
  end
  return shown
end }
