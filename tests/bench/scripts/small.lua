-- A small script: how soon its first row is there is how long celspan takes to start.
local celspan = require "celspan"

return celspan.rostrum { back = "#fff",
  celspan.cel { celspan.circle { centre = { 960, 540 }, radius = 300, texture = "#c33" } } }
