local function animal(body, back, texture, shade)
  -- parts with the same names find each other
  return union {
    path { d = body, fill = texture }:named "body",
    path { d = back, fill = shade }:named "back" }
end
local fish = animal("M-110 0 C-80 -70 20 -80 70 -10 L120 -50 C108 -20 108 20 120 50 L70 10"
    .. " C20 80 -80 70 -110 0 Z", "M-50 -10 C-30 -34 0 -34 20 -8 C0 10 -30 12 -50 -10 Z",
  "#e8743b", "#c4501f")
local bird = animal("M-120 -20 L-86 -34 C-70 -62 -36 -58 -22 -34 C20 -30 60 -10 124 -24 C100"
    .. " 30 30 62 -30 46 C-70 34 -86 10 -90 -10 Z",
  "M-34 -6 C10 -40 30 -104 84 -118 C80 -50 40 10 -14 22 C-34 18 -42 6 -34" .. " -6 Z",
  "#3d8fb0", "#256a88")
local leaf = animal("M-120 60 C-90 -40 -10 -100 110 -90 C112 20 30 90 -80 60 Z",
  "M-104 52 C-50 20 20 -40 84 -72 C30 -20 -40 36 -104 52 Z", "#6f9c3d", "#4c7626")

return { fish = fish, bird = bird, leaf = leaf }
