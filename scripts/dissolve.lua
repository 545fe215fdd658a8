-- A dissolve: one frame, two exposures. Light adds on film, so weights that sum to one pass from
-- the desert at sunset to the sea at night; halfway, both are visible at once.
local shapes = require "demo.shapes"

local bottom = 1120

local down, across = shapes.down, shapes.across

local function disc(x, y, r, texture)
  return circle { x, y, r, fill = texture }
end

local desert = cel {
  rect { 0, 0, 1920, 1080, fill = down(0, 800, { "#e9724c", "#f7a95c", "#ffe1a0" }) },
  disc(960, 470, 205, "#fff0c9"),
  shapes.ridge({ { -40, 800 }, { 300, 690 }, { 620, 640 }, { 900, 700 }, { 1300, 640 },
                 { 1700, 560 }, { 1960, 610 } }, bottom, across(0, 1920, { "#e2935a", "#c25b4a" })),
  shapes.ridge({ { -40, 790 }, { 380, 880 }, { 820, 800 }, { 1180, 780 }, { 1560, 880 },
                 { 1960, 840 } }, bottom, across(0, 1920, { "#d9703f", "#9c3a3f" })),
  shapes.ridge({ { -40, 1000 }, { 420, 960 }, { 900, 1010 }, { 1420, 940 }, { 1960, 1000 } },
               bottom, across(0, 1920, { "#a63f3c", "#5e2436" })),
}

local function waves(n, y, colour)
  local crest = {}
  for i = 0, 16 do
    crest[i + 1] = { -60 + i * 130, y + (i % 2 * 2 - 1) * (8 + 6 * n) + 8 * math.sin(i + n) }
  end
  return shapes.ridge(crest, bottom, colour)
end

local function sea(time)
  local glitter = {}
  for i = 0, 16 do
    local w = (60 + i * 17) * (0.75 + 0.25 * math.sin(i * 2.4 + time * 5))
    local x = 960 - w / 2 + 22 * math.sin(i * 3.1)
    glitter[i + 1] = rect { x, 716 + i * 21, w, 7, radius = 3.5, fill = "#cfe6e6a0" }
  end
  return cel {
    rect { 0, 0, 1920, 1080, fill = down(0, 760, { "#0b1030", "#1d2f5f", "#4f6f97" }) },
    disc(960, 470, 205, "#e9f1ec"),
    disc(900, 420, 38, "#cfdcdc"), disc(1030, 530, 56, "#cfdcdc"), disc(1010, 390, 22, "#cfdcdc"),
    rect { 0, 700, 1920, 400, fill = down(700, 1080, { "#31557f", "#0d1c3c" }) },
    union(glitter),
    waves(1, 900, "#12305c8c"):translate(20 * math.sin(time * 2), 0),
    waves(2, 1000, "#0a1a3cc8"):translate(-30 * math.sin(time * 2), 0),
  }
end

local fade = ease "inOutSine"

return film { frames = 48, frame = function(f)
  local u = fade(math.max(0, math.min(1, (f.progress - 0.15) / 0.7)))
  return { { rostrum { desert }, 1 - u }, { rostrum { sea(f.time) }, u } }
end }
