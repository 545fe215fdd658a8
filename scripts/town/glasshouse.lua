-- A greenhouse of cut paper in winter, and a pot whose foot is at 0, 0.
local cut = require "town.cutout"
local mood = require("stage.moods").noon

local room = rect { 0, 0, 450, 600, fill = mood.sky[2] }
  | cut.laid(cut.piece("M-10 330 C90 250 150 330 240 300 C320 270 400 320 470 290 L470 480 "
    .. "L-10 480 Z", mood.sky[3]))
for i = 0, 1 do room = room | rect { 60 + 352 * i, 0, 8, 480, fill = mood.light } end

return {
  room = room | cut.laid(cut.piece("M-10 448 L460 450 L460 610 L-10 610 Z", mood.far))
    | rect { 0, 548, 450, 60, fill = mood.ground },
  pot = cut.piece("M-44 -84 L44 -84 L32 0 L-32 0 Z", "#b8613b")
    | cut.piece("M-52 -100 L52 -100 L52 -76 L-52 -76 Z", "#d07a4d") }
