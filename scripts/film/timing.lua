-- When everything happens, in seconds of the film. The pictures and the sound share these times, so
-- they stay in sync; it is plain Lua, because sound.lua runs in a Lua without celspan.
local timing = {
  fps = 24,
  seconds = 29.5,
  -- A shot is shown from `from` on; if the next one begins before it ends, they dissolve.
  shots = {
    { name = "opening", from = 0, to = 6.25 },
    { name = "street", from = 5.75, to = 13.5 },
    { name = "close", from = 13.5, to = 20.75 },
    { name = "town", from = 19.9, to = 29.5 },
  },
  title = { from = 0.9, written = 3.9, leaves = 4.5 },
  -- The street: he reaches up, the spark goes in and out again, and lands in his mitten.
  reach = 9.9, spark_in = 10.55, puff = 10.85, caught = 12.35,
  -- What he says, and the two tries of the spark.
  coaxing = 14.3, rises = 16.45, enters = 17.6, catches = 18.15, thanks = 18.95,
  -- The town: windows from here on, the sparks that rise, the star, the credits, the end.
  windows = 20.5, star_rises = 22.3, star = 24.2, credits = 23.8, sleep = 25.4, fade = 28.3,
}

return timing
