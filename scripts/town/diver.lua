-- A diver of tin, cut out of paper; the middle of his breast is near 0, 0.
local cut = require "town.cutout"
local mood = require("stage.moods").noon

local TIN, COPPER = "#8d9aa0", "#c07a45"

return cut.laid(union { cut.strip("M-18 60 L-22 96", 20, TIN), cut.strip("M16 60 L22 96", 20,
  TIN), cut.piece("M-34 8 L34 8 L40 70 L-40 70 Z", TIN), cut.strip("M-30 20 L-58 52", 16, TIN),
  cut.strip("M30 20 L60 44", 16, TIN), cut.piece("M-40 92 L-8 92 L-8 106 L-46 106 Z", mood.ink),
  cut.piece("M8 92 L40 92 L46 106 L8 106 Z", mood.ink), cut.disc(0, -26, 37, COPPER),
  cut.disc(-6, -26, 22, mood.sky[2]), circle { -13, -28, 4, fill = mood.ink },
  circle { 3, -28, 4, fill = mood.ink }, cut.piece("M-30 2 L30 2 L34 16 L-34 16 Z", COPPER) })
