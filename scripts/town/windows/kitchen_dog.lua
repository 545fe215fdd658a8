-- Nobody in the kitchen but a dog: a blow on the handle, and the pancake flies to the ceiling. It
-- lets go, he snaps, and misses it once more.
local window = require "town.window"
local cut = require "town.cutout"
local mood = require("stage.moods").harvest
local kitchen = require "town.kitchen"(mood)

local FUR, PATCH = "#fff3cf", mood.ground

-- The dog sits behind the sill; his neck is pinned at (116, 344).
local BODY = cut.piece("M96 336 C130 330 158 350 164 400 C172 470 172 540 176 610 L44 610 "
  .. "C36 520 56 410 96 336 Z", FUR)
local HEAD = cut.piece("M74 342 C60 290 90 256 134 256 C156 258 168 272 176 284 L222 292 "
  .. "C236 302 232 322 216 326 L166 332 C150 354 100 364 74 342 Z", FUR)
  | cut.piece("M212 286 C228 284 238 294 232 306 C222 308 212 302 212 286 Z", mood.ink)
local EAR = cut.piece("M88 268 C56 276 44 330 60 372 C84 366 106 318 112 276 Z", PATCH)
local JAW = cut.piece("M148 326 L210 322 C212 338 172 352 146 342 Z", "#c8503a")
local COLLAR = cut.piece("M78 352 L148 350 L154 368 L72 370 Z", mood.accent)
local PAW = cut.strip("M0 0 L66 -4", 28, FUR)

--- The dog; up: degrees of his head, jaw: of his mouth, ear: of his ear, paw: of his paw.
local function dog(up, jaw, ear, paw)
  local eye = up < -24
    and circle { 141, 288, 7, fill = mood.ink } or circle { 142, 290, 6, fill = mood.ink }
  local head = union { JAW:rotate(jaw, 150, 326), HEAD, eye, EAR:rotate(ear, 96, 274) }
  return cut.laid(union { BODY, COLLAR, head:rotate(up, 116, 344) })
    | cut.pin(116, 350) | cut.laid(PAW:rotate(paw, 0, 0):translate(134, 440))
end

-- Two drawings each: the dog, the pan's degrees, and the pancake: on the ceiling, its drop from 1
-- to 3, or in the air, its height and degrees.
local REST, LIFT, BLOW, WAIT = { 4, 0, 0, 0 }, { 4, 0, 0, -44 }, { 0, 0, 30, 24 }, { -34, 0, 20, 0 }
local SNAP, SHUT, SAD = { -20, 26, 50, -40 }, { -6, 0, -20, -40 }, { 18, 0, -8, 0 }
local IN = { 430, 0 }
local ACTS = { { REST, 0, IN }, { LIFT, 0, IN }, { LIFT, 0, IN }, { BLOW, -14, { 300, 60 } },
  { BLOW, -14, { 150, 170 } }, { WAIT, 0, 1 }, { WAIT, 0, 1 }, { WAIT, 0, 1 }, { WAIT, 0, 2 },
  { WAIT, 0, 2 }, { WAIT, 0, 2 }, { WAIT, 0, 2 }, { WAIT, 0, 3 }, { WAIT, 0, 3 }, { WAIT, 0, 3 },
  { SNAP, 0, { 200, -8 } }, { SNAP, 0, { 310, 6 } }, { SHUT, 0, IN }, { SHUT, 0, IN },
  { SAD, 0, IN }, { SAD, 0, IN }, { SAD, 0, IN }, { REST, 0, IN }, { REST, 0, IN } }

return window.film { title = "A dog in the kitchen", by = "cp", seconds = 4, pane = "plain",
  drawing = function(_, number)
    local pose, tilt, cake = table.unpack(ACTS[number // 2 + 1])
    local pan = kitchen.pan(448, true):rotate(tilt, 330, 462)
    return { kitchen.room, pan, dog(table.unpack(pose)),
      type(cake) == "table" and kitchen.cake(330, cake[1], cake[2]) or kitchen.stuck(330, cake) }
  end }
