-- The times of all events, in seconds. The picture and the tune both use them.
return { length = 6, star = -0.25, crouch = 1.75, leap = 2.5, catch = 2.875, lights = 3,
  land = 3.25 }
