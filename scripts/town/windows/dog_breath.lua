-- A dog waits at the pane; its breath grows on the glass, and fades.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").snow
local wash, form, line = gouache.wash, gouache.form, gouache.line

local FUR, CREAM = wash(90, 0, 370, 0, "#f0c48a", "#c98a4e", "#8a5230"), "#fdf0dc"

local room = union {
  gouache.wall(84, 200, 480, "#ffe9b4", "#e3a961", "#a8673f", "#6f4030"),
  form("#7a4531", "M330 160 H433 V560 H330 Z"), form("#8f5638", "M342 172 H433 V560 H342 Z"),
  line("M356 372 V384", 10, "#ffdf9a"), line("M400 172 V210", 5, "#5a3323"),
  form(mood.accent, "M384 206 C380 260 376 300 370 340 H432 V206 Z"),
  rect { 0, 568, 450, 32, fill = "#c98f5c" },
}
local body = gouache.edged(form(FUR, "M112 600 C104 520 130 450 170 420 H270 "
  .. "C318 450 350 520 342 600 Z"), "#ffe2ae",
  "#6b3c22", 6, 3) | form(CREAM, "M186 430 C180 500 200 540 222 548 C246 540 264 500 256 430 Z")
local paws = form(CREAM, "M118 578 C112 540 190 540 186 578 Z") | form("#e3c39a", "M254 578 "
  .. "C250 540 330 540 324 578 Z")
  | line("M140 556 V572 M162 556 V572 M278 556 V572 M300 556 V572", 4, "#a86f4a")
local skull = form(nil, "M-84 0 C-88 -62 -50 -92 0 -92 C50 -92 88 -62 84 0 C84 60 52 92 0 92 "
  .. "C-52 92 -84 60 -84 0 Z")
local flap = form(nil, "M-62 -66 C-104 -72 -124 -20 -112 40 C-106 66 -82 62 -78 34 "
  .. "C-74 0 -70 -30 -62 -66 Z")
local muzzle = form(CREAM, "M0 -70 C14 -30 62 0 58 42 C52 78 -52 78 -58 42 C-62 0 -14 -30 0 -70 Z")
local nose = form("#3a2a2a", "M-22 4 C-20 -10 20 -10 22 4 C20 18 6 24 0 24 C-6 24 -20 18 -22 4 Z")

local cloud = union { circle { 225, 372, 62 }, circle { 176, 384, 46 }, circle { 276, 384, 46 },
  circle { 202, 344, 44 },
  circle { 252, 344, 44 } }
local sizes = { 0.3, 0.62, 0.86, 1, 1, 1, 1, 1, 1, 1, 1, 1 }

return window.film { title = "Waiting at the pane", by = "ga", seconds = 4, drawing = function(_,
  number)
  local n = number // 2
  local age = (n + 10) % 12
  local pants = age == 0 or age == 1
  local look = gouache.exposed(n, { 8, { 0, 0 } }, { 4, { 8, 2 } }, { 6, { -9, 2 } },
    { 6, { 0, 0 } })
  local up = n % 12 == 2 and -5 or 0
  local x, y = 225 + look[1], 318 + look[2] + up
  local function put(object, u) return object:translate(x + (u or 0) * look[1], y + (u
    or 0) * look[2]) end
  local left, right = flap:translate(0, -up * 2), flap:scale(-1, 1)
  local open = pants and form("#d9705f", "M-22 56 C-22 92 22 92 22 56 Z") or union {}
  return { room, body, paws, gouache.edged(put(skull):paint(FUR), "#ffe2ae", "#6b3c22", 6, 3),
    put(open | muzzle, 1),
    put(nose | line("M0 24 V40 M-28 46 Q-14 56 0 42 Q14 56 28 46", 4.5, "#6b4a3c"), 1.4),
    put(union { ellipse { -38, -26, 10, 13, fill = "#2e2224" },
      ellipse { 38, -26, 10, 13, fill = "#2e2224" },
      circle { -34, -31, 4, fill = "#ffffff" }, circle { 42, -31, 4, fill = "#ffffff" },
      line("M-54 -52 Q-40 -64 -26 -56 M54 -52 Q40 -64 26 -56", 5, "#8a5230") }, 1),
    put(left):paint("#a8683c"), put(right):paint("#7a4528"),
    line("M168 412 Q225 440 284 412", 16, mood.accent),
    cloud:scale(sizes[age + 1], sizes[age + 1], 225, 360):paint(rgb("#f3f6f6", age < 4 and 0.72
      or 0.72 * (12 - age)
      / 9)) }
end }
