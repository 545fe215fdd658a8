-- A small script: the time until its first row is the time that celspan takes to start.
local celspan = require "celspan"

return celspan.rostrum { back = "#fff",
  celspan.cel { celspan.circle { centre = { 960, 540 }, radius = 300, texture = "#c33" } } }
