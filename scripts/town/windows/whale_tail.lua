-- Next door to the whale in the bath: only its tail, which came through the wall, and waves. There
-- is a hat on it.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").fog

local SKIN, WOOD = "#3f6273", "#8a5a3a"

local ROOM = rect { 0, 0, 450, 600, fill = mood.sky[1] }
  | rect { 0, 430, 450, 170, fill = mood.near } | rect { 0, 424, 450, 8, fill = mood.light }
  | rect { 0, 544, 450, 60, fill = mood.ground }
for i = 0, 1 do ROOM = ROOM | rect { 100 + 280 * i, 0, 10, 424, fill = mood.sky[2] } end
ROOM = ROOM | cut.laid(cut.piece("M284 478 L424 478 L420 492 L366 494 L372 600 L338 600 L342 494 "
  .. "L288 492 Z", WOOD))
  | cut.laid(union { cut.strip("M300 448 C282 440 284 424 276 416", 9, mood.light), -- tea for one
    cut.strip("M346 430 C374 424 374 462 344 460", 8, mood.light),
    cut.piece("M302 426 C310 412 338 412 346 426 C356 446 352 470 344 478 L304 478 "
      .. "C296 470 292 446 302 426 Z", mood.light),
    cut.piece("M376 452 L412 452 C412 470 404 478 394 478 C384 478 376 470 376 452 Z",
      mood.light) })
-- The wall of the whale, with a hole.
local WALL = cut.laid(cut.piece("M-10 0 L46 0 L46 300 L30 318 L50 340 L34 366 L52 392 L30 410 "
  .. "L44 430 L46 610 L-10 610 Z", mood.ground))
local TAIL = cut.piece("M-20 336 C70 340 150 316 178 240 C150 214 100 212 70 176 C58 150 66 132 "
  .. "84 122 C104 150 180 140 206 198 C226 140 300 140 330 104 C352 122 350 150 334 170 C306 206 "
  .. "262 214 230 246 C214 346 130 430 -20 420 Z", SKIN):scale(0.9, 0.9, 0, 380)
local HAT = cut.piece("M-50 0 C-30 -8 -32 -14 -30 -52 C-26 -66 26 -66 30 -52 C32 -14 30 -8 50 0 "
  .. "C20 12 -20 12 -50 0 Z", mood.ink)
  | cut.piece("M-31 -26 L31 -26 L31 -10 L-31 -10 Z", mood.accent)

-- Two drawings each, together with the whale: the degrees of the tail, how high the hat is above
-- it, and the hat's degrees.
local ACTS = { { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 }, { 5, 0, 8 }, { 8, 0, 8 }, { 8, 0, 8 },
  { -10, 10, -10 }, { 8, 90, 30 }, { -10, 26, 70 }, { 8, 90, 120 }, { -10, 26, 180 },
  { 8, 90, 240 }, { -10, 26, 290 }, { 8, 90, 330 }, { -10, 10, 350 }, { 5, 30, -4 }, { 8, -4, 14 },
  { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 }, { 0, 0, 8 } }

return window.film { title = "The tail next door", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local wave, up, degrees = table.unpack(ACTS[number // 2 + 1])
    local hat = HAT:rotate(degrees, 0, -30):translate(290, 146):rotate(wave, 20, 380)
    return { ROOM, cut.laid(TAIL:rotate(wave, 20, 380)), WALL, cut.laid(hat:translate(0, -up)) }
  end }
