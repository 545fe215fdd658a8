-- A boy reads with a torch under his blanket, and his rabbit of cloth goes to see the story.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").storm
local wash, form, limb, line = gouache.wash, gouache.form, gouache.limb, gouache.line

local SHADOW = wash(200, 330, 250, 600, "#a46c22", "#6b4520")
local HILL = "M104 600 C112 540 106 470 118 400 C128 320 150 250 200 230 "
  .. "C240 212 280 230 304 282 C330 338 374 384 396 456 C410 500 418 560 440 600 Z"

--- Where the shadow hops, by drawings from the fifth; it lands on every second one.
local hops = gouache.track({ 4, { 116, 420 } }, { 8, { 210, 318 } }, { 12, { 330, 404 } },
  { 13, { 330, 404 } }, { 17, { 220, 318 } }, { 20, { 108, 420 } })

local room = union {
  gouache.wall(250, 430, 560, "#75705a", "#45534f", "#2b373b", "#1f292d"),
  form("#8d9183", "M318 150 L404 158 L396 262 L310 254 Z"),
  form(mood.near, "M356 168 C372 184 374 206 368 232 L338 230 C336 204 340 184 356 168 Z"),
  line("M340 236 L330 248 M366 238 L372 252", 6, "#a3674c"), circle { 355, 200, 7,
    fill = "#c9b45a" },
  form(mood.far, "M0 0 H450 V30 H0 Z"),
  form(wash(17, 0, 90, 0, "#3a2f28", "#6b4a2e"), "M0 330 C30 314 70 318 88 346 V600 H0 Z"),
  form(wash(40, 0, 180, 0, "#8d9183", "#dcd3a8"), "M30 560 C20 500 40 484 90 484 "
    .. "C150 484 170 500 168 560 Z"),
  rect { 0, 552, 450, 48, fill = wash(0, 0, 450, 0, "#59655f", "#a08a4d", "#59655f") },
}

local function cloth(level)
  return path { d = HILL, fill = radial { centre = { 262, 452 }, radius = 350,
    { 0, mix("#f6cf52", "#fff3b4", level) }, { 0.3, mix("#d99e2c", "#f4c430", level) },
    { 0.6, "#b07a2c" }, { 0.85, "#5f5a3e" }, { 1, "#46544f" } } }
end

local folds = union {
  form(rgb("#4c4a36", 0.5), "M214 236 C168 280 150 430 146 600 H124 C132 440 150 280 214 236 Z"),
  form(rgb("#4c4a36", 0.45), "M278 250 C300 330 352 400 372 480 C384 530 388 570 392 600 H414 "
    .. "C404 540 398 500 380 452 C352 386 306 330 278 250 Z"),
  form(rgb("#ffe58a", 0.6), "M150 300 C160 262 176 238 200 230 C240 212 280 230 304 282 "
    .. "C272 236 232 230 206 242 C182 252 164 272 150 300 Z"),
  star { 176, 300, 13, 6, rotate = 12, fill = "#8a6a33" },
  star { 316, 352, 13, 6, rotate = -8, fill = "#8a6a33" },
  star { 250, 272, 11, 5, rotate = 30, fill = "#a07c38" },
}

local boy = (form(nil, "M118 600 C112 520 130 462 178 440 C214 428 244 452 250 500 "
  .. "C256 530 330 540 352 572 C360 590 352 600 340 600 Z")
  | form(nil, "M158 392 C156 350 184 336 208 338 C240 340 256 362 254 388 "
  .. "C266 402 262 412 250 412 C250 438 226 448 202 444 C172 440 158 420 158 392 Z")
  | form(nil, "M160 384 C150 350 178 326 196 332 C196 318 216 316 220 328 "
  .. "C244 324 260 346 254 362 C226 356 190 360 160 384 Z")):translate(18, 6):paint(SHADOW)

local function arm(sway)
  return form(rgb("#fffbe0", 0.5), "M286 %g L304 %g L384 512 L296 502 Z", 458 + sway, 450 + sway)
    | limb("#6b4520", { 206, 474, 36 }, { 238, 524 + sway, 32 }, { 276, 446 + sway, 24 })
    | line(("M274 %g L290 %g"):format(436 + sway, 450 + sway), 15, "#4a3420")
    | form("#4a3420", "M280 %g L302 %g L308 %g L288 %g Z", 454 + sway, 438 + sway, 450 + sway,
      464 + sway)
end

--- The open book; a page of it stands up, from 0 on the right to 1 on the left.
local function book(turn)
  local x, y = 326 + 46 * math.cos(math.pi * turn), 522 - 50 * math.sin(math.pi * turn)
  return form(rgb("#fffbe0", 0.75), "M286 484 L292 500 L330 524 L382 510 Z")
    | line("M280 510 Q306 508 326 532 Q348 508 376 514", 9, "#5a3c1e")
    | (turn > 0 and turn < 1 and line(("M326 530 Q%g %g %g %g"):format((326 + x) / 2 - 8, y + 4, x,
      y), 6, "#5a3c1e") or union {})
end

local leap = form("#6b4520", "M-44 2 C-40 -16 -16 -26 8 -22 C20 -20 26 -24 30 -30 "
  .. "C20 -46 0 -54 -12 -52 C-6 -60 22 -56 36 -38 C50 -38 58 -28 56 -20 C50 -12 40 -12 36 -8 "
  .. "L58 8 L50 14 L26 0 C8 6 -12 4 -22 4 L-52 24 L-58 16 Z")
local land = form("#6b4520", "M-34 22 C-42 4 -30 -20 -6 -20 C6 -20 12 -22 14 -28 "
  .. "C6 -44 4 -62 10 -70 C18 -66 22 -52 24 -40 C26 -54 32 -66 40 -68 C44 -56 38 -44 34 -34 "
  .. "C44 -28 46 -18 42 -10 C36 -4 28 -4 28 4 L34 22 Z")

local toy = union {
  gouache.edged(form(wash(60, 0, 130, 0, "#8d9183", mood.light), "M60 560 C48 520 66 494 92 494 "
    .. "C118 494 136 520 124 560 Z"), "#6e766c", mood.accent, 4, 2),
  gouache.edged(form(wash(60, 0, 130, 0, "#8d9183", mood.light), "M58 478 C58 452 74 444 84 442 "
    .. "C64 408 66 376 78 372 C90 376 94 410 94 440 C98 408 110 380 122 380 "
    .. "C130 396 120 426 106 446 C124 456 128 470 126 482 C120 510 64 508 58 478 Z"), "#6e766c",
    mood.accent, 4, 2),
  circle { 82, 474, 4.5, fill = mood.ink }, circle { 108, 474, 4.5, fill = mood.ink },
  line("M90 486 L96 491 L102 486", 3, "#a3674c"),
}

local function foot(wiggle)
  local toes = union {}
  for i = 0, 4 do
    toes = toes | circle { 384 + 9 * i, 541 + 2.4 * i - (i == 0 and wiggle or 0), 8 - i,
      fill = "#e9b27c" }
  end
  return form(wash(370, 0, 430, 0, "#e9b27c", "#9a6b4a"), "M376 600 C374 560 372 544 390 542 "
    .. "C412 544 430 556 430 572 L432 600 Z") | toes
end

return window.film { title = "A torch under the blanket", by = "ga", seconds = 4,
  drawing = function(_, number)
    local n = number // 2
    local x, y = table.unpack(hops:at(n))
    local up = n % 2 == 1 and n ~= 13
    local shadow = (up and leap:translate(0, -26) or land):scale(n > 12 and -1 or 1, 1)
    local hill = path { d = HILL }
    local gone = gouache.exposed(n, { 3, 0 }, { 1, 54 }, { 17, nil }, { 1, 54 }, { 2, 0 })
    local turn = gouache.exposed(n, { 10, 0 }, { 1, 0.25 }, { 1, 0.6 }, { 1, 0.85 }, { 11, 1 })
    return { room, gone and toy:translate(gone - 36, 0) or union {},
      cloth(n % 6 < 3 and 1 or 0.8), boy, book(turn), arm(turn > 0 and turn < 1 and -4 or 0),
      n >= 4 and n <= 20 and clip(shadow:translate(x, y), hill) or union {}, folds,
      foot((n == 6 or n == 8 or n == 15 or n == 17) and 5 or 0) }
  end }
