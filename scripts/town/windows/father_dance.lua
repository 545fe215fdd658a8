-- A father sways with a child on his feet, who holds on to him, a little round and back.
local couple = require "town.couple"
local gouache = require "town.gouache"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(225, 300, 430, "#ffe6b0", "#eaa04e", "#a05426", "#5a2a15"),
  form("#6b3418", "M0 506 H450 V600 H0 Z"), ellipse { 225, 560, 190, 44, fill = "#a35a2a" },
  line("M40 160 C130 200 320 200 410 160", 4, "#6b3418"),
  form("#e0662b", "M70 172 L104 182 L80 208 Z M190 189 L226 190 L208 220 Z M316 184 L350 175 "
    .. "L342 206 Z"),
  form("#ffd27a", "M130 184 L164 188 L144 216 Z M254 190 L290 187 L274 218 Z"),
  form("#8a4420", "M346 470 H420 V560 H346 Z"), form("#c9853f", "M340 452 H426 V472 H340 Z"),
  form("#ffe2a0", "M356 452 V426 H410 V452 Z"), form("#e0662b", "M380 426 V404 H386 V426 Z"),
  circle { 383, 396, 7, fill = "#fff3c8" },
}

local SKIN = wash(150, 200, 320, 400, "#ffd3a0", "#b06a42")
local father = { fill = wash(0, 230, 0, 560, "#8f5a30", "#6b3c20", "#4a2614"), edge = "#f0b468",
  body = form(nil, "M-22 -312 C-54 -308 -66 -284 -68 -240 C-70 -190 -54 -160 -52 -120 L-48 -14 "
    .. "C-48 2 -12 2 -8 -10 L0 -30 L8 -10 C12 2 48 2 48 -14 L52 -120 C54 -160 70 -190 68 -240 "
    .. "C66 -284 54 -308 22 -312 Z"),
  sleeve = "#6b3c20", skin = SKIN, hair = "#3f1d0f", shade = "#3f1d0f", nose = "#d98f5c",
    size = 0.82,
  head = 350, shoulder = 276, broad = 50, hold = 196, eyes = "shut" }
local child = { fill = wash(0, 360, 0, 560, "#ffd98a", "#eab052", "#b87830"),
  body = form(nil, "M-12 -150 C-34 -148 -38 -130 -36 -112 C-36 -80 -50 -50 -54 -22 "
    .. "C-30 -10 30 -10 54 -22 C50 -50 36 -80 36 -112 C38 -130 34 -148 12 -150 Z")
    | form(nil, "M-28 -22 V0 C-28 10 -8 10 -8 0 V-18 H8 V0 C8 10 28 10 28 0 V-22 Z"),
  sleeve = "#eab052", skin = SKIN, hair = "#7a3b1c", shade = "#5a2a15", nose = "#d98f5c",
    size = 0.66,
  bun = true, head = 184, shoulder = 132, broad = 26, hold = 176, lift = 12 }

return window.film { title = "On his feet", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 3
  local step = n % 2 * 5
  father.lift, child.lift = step, 12 + step
  child.eyes = n % 5 == 0 and "shut" or "open"
  child.brow = n > 6 and n < 12 and 6 or 0
  local turn = 0.6 + 0.15 * math.sin(2 * math.pi * n / 16)
  return { room, (couple.draw(225, 560, turn, father, child)) }
end }
