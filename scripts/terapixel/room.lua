-- Rooms behind windows, each 600 by 700 with its floor at 590; at the last level a unit of a room
-- in the large windows is ten pixels.
local palette = require "demo.palette"
local shapes = require "demo.shapes"
local canvas = require "terapixel.canvas"
local draw = require "terapixel.draw"
local print = require "terapixel.print"

local room = {}

local papers = { { "#ffd58f", "#f2b866" }, { "#ffc47d", "#ef9f5c" }, { "#f6dca6", "#e3bd7e" },
                 { "#ffb98a", "#e88f68" }, { "#e9d9a8", "#cdb67c" } }
local spines = { "#b1543f", "#2f7f86", "#e8a33d", "#8e4a48", "#17404f", "#7d8248", "#d99f7d",
                 "#4c3569", "#e9573f", "#35492f" }
local furs = { "#2b1b2c", "#b5672d", "#efd7b4" }
local wood = "#7a4b2a"

--- Wallpaper: stripes, and a sprig between them.
local function walls(dice)
  local paper = dice:one(papers)
  local stripes, sprigs = {}, {}
  for i = 0, 9 do
    stripes[i + 1] = { i * 60 + 20, 0, 12, 470 }
    for k = 0, 6 do
      local x, y = i * 60 + 51, 30 + k * 64 + i % 2 * 32
      sprigs[#sprigs + 1] = ("M%g %gq5 3 0 9q-5 -6 0 -9m0 9q4 0 6 -5q-5 0 -6 5q-4 0 -6 -5q5 0 6 5"
        .. "l1 6h-2Z"):format(x, y)
    end
  end
  return union {
    draw.rect(0, 0, 600, 590, shapes.down(0, 590, { paper[1], paper[2] })),
    draw.rects(rgb(1, 1, 1, 0.16), stripes), draw.path("#c9743f", table.concat(sprigs)),
    draw.rect(0, 470, 600, 120, "#a5683f"), draw.rect(0, 466, 600, 8, "#d09a62"),
    draw.rect(0, 590, 600, 110, "#6d4030"),
    draw.rects("#5a3328", { { 0, 612, 600, 3 }, { 0, 640, 600, 4 }, { 0, 674, 600, 5 } }),
  }
end

--- A shelf of books: each spine has its bands.
local function shelf(x, y, w, dice)
  local parts, bands = { draw.rect(x, y, w, 8, wood) }, {}
  local at = x + 4
  while at < x + w - 22 do
    local wide, tall = dice:between(9, 20), dice:between(44, 70)
    parts[#parts + 1] = draw.rect(at, y - tall, wide, tall, dice:one(spines), 1)
    bands[#bands + 1] = { at + 1.5, y - tall * 0.86, wide - 3, 2 }
    bands[#bands + 1] = { at + 1.5, y - tall * 0.8, wide - 3, 0.8 }
    bands[#bands + 1] = { at + wide / 2 - 1, y - tall * 0.66, 2, tall * 0.34 }
    at = at + wide + dice:between(0.4, 3)
  end
  parts[#parts + 1] = draw.rects("#f0d9a8", bands)
  return union(parts)
end

local function bookcase(x, dice)
  local parts = { draw.rect(x, 190, 170, 400, wood), draw.rect(x + 8, 198, 154, 384, "#54301f") }
  for i = 0, 3 do parts[#parts + 1] = shelf(x + 8, 280 + i * 96, 154, dice) end
  return union(parts)
end

local function lamp(x)
  return union {
    draw.rect(x - 1.5, 0, 3, 60, palette.ink),
    draw.disc(x, 100, 110, "#fff3c926"), draw.disc(x, 100, 64, "#fff3c940"),
    draw.path("#e9573f", "M%g 56H%gL%g 104H%gZ", x - 14, x + 14, x + 52, x - 52),
    draw.oval(x, 104, 50, 7, "#fff6d8"),
  }
end

local function curtains(dice)
  local cloth = dice:one { "#b5343f", "#2f7f86", "#b5672d", "#6d4672" }
  local left = "M0 0H118C112 150 96 330 30 420C20 520 24 620 30 700H0Z"
  local folds = { draw.path(cloth, left) }
  for i = 1, 3 do
    folds[#folds + 1] = draw.path("#00000030",
      "M%g 0h6C%g 150 %g 330 %g 420l-4 0C%g 330 %g 150 %g 0Z",
      i * 28, i * 27 + 6, i * 20 + 4, i * 8 + 4, i * 20, i * 27, i * 28)
  end
  local side = union(folds)
  return union { side, side:scale(-1, 1):translate(600, 0),
                 draw.rect(0, 0, 600, 26, cloth),
                 draw.rects("#f0d9a8", { { 0, 24, 600, 4 } }) }
end

local function table_set(x, dice)
  local parts = {
    draw.rects("#54301f", { { x + 16, 500, 10, 92 }, { x + 184, 500, 10, 92 } }),
    draw.path(dice:one { "#fbe9c6", "#d9e0d2", "#f6c9a8" },
      "M%g 486h210l8 44q-26 12 -52 0t-58 0t-58 0t-58 0Z", x),
    draw.path("#2f7f86", "M%g 486v-26h34v26Z", x + 30), draw.oval(x + 47, 460, 17, 4, "#17404f"),
    draw.path("#e8a33d", "M%g 486q-2 -28 6 -34h18q8 6 6 34Z", x + 140),
  }
  for i = -2, 2 do
    parts[#parts + 1] = draw.path("#55683f", "M%g 452q%g -20 %g -38q4 20 %g 38Z", x + 154, i * 5,
      i * 11, -i * 11 + 2)
    parts[#parts + 1] = draw.disc(x + 154 + i * 11, 412 + math.abs(i) * 3, 7,
      dice:one { "#e9573f", "#fff3c9", "#e8a33d" })
  end
  return union(parts)
end

local function cat(x, y, fur)
  return union {
    draw.path(fur, "M%g %gc-34 0 -40 -40 -16 -66c-4 -20 -2 -34 2 -42l14 12h14l14 -12"
      .. "c4 10 6 24 2 42c24 26 16 66 -16 66Z", x, y),
    shapes.ribbon({ { x + 20, y - 8, 9 }, { x + 52, y - 10, 9 }, { x + 64, y - 34, 7 },
                    { x + 54, y - 48, 4 } }, fur),
    draw.rects("#ffe6b3", { { x - 9, y - 84, 5, 6 }, { x + 4, y - 84, 5, 6 } }),
    draw.path("#e9573f", "M%g %gh16l-8 5Z", x - 8, y - 68),
  }
end

local function clock(x, y)
  return union {
    draw.disc(x, y, 30, wood), draw.disc(x, y, 25, "#fff6e0"),
    draw.rects(palette.ink, { { x - 1, y - 23, 2, 6 }, { x - 1, y + 17, 2, 6 },
                              { x - 23, y - 1, 6, 2 }, { x + 17, y - 1, 6, 2 } }),
    draw.path(palette.ink, "M%g %gl2 -18l2 18l12 6l-2 3Z", x - 2, y),
  }
end

--- The bars of the window, and its sill, as seen from outside.
room.bars = draw.rects(palette.ink, {
  { -18, -18, 636, 18 }, { -18, 0, 18, 700 }, { 600, 0, 18, 700 }, { 294, 0, 12, 700 },
  { 0, 228, 600, 12 }, { -40, 700, 680, 34 } })

--- An ordinary room, with random contents.
function room.any(dice)
  local parts = { walls(dice) }
  local is_left = dice:once(2)
  parts[#parts + 1] = bookcase(is_left and 40 or 390, dice)
  local x = is_left and 400 or 150
  parts[#parts + 1] = canvas.frame(canvas.small(dice), 96, 64):scale(1.5):translate(x - 60, 270)
  parts[#parts + 1] = table_set(is_left and 290 or 110, dice)
  parts[#parts + 1] = lamp(x)
  if dice:once(3) then parts[#parts + 1] = cat(is_left and 250 or 360, 622, dice:one(furs)) end
  if dice:once(2) then parts[#parts + 1] = clock(x + 96, 200) end
  parts[#parts + 1] = curtains(dice)
  parts[#parts + 1] = room.bars
  return union(parts)
end

--- The text of a note that is nailed to a wall, one pixel per square.
local function note(x, y, lines)
  return union {
    draw.rect(x, y, 21, 13, "#fffaf0"), draw.disc(x + 10.5, y + 0.8, 0.7, "#e9573f"),
    print.text(x + 1, y + 2, 0.1, "#2b1b2c", lines),
  }
end

--- The room with the film on its wall: at the last level the canvas is 1920 by 1080 pixels.
function room.gallery(dice)
  return union {
    walls(dice), bookcase(28, dice), clock(250, 150),
    canvas.frame(canvas.large, 192, 108):translate(324, 268),
    note(326, 396, { "THE LAMPLIGHTER,", "FRAME 54, HUNG AT", "ONE PIXEL A PIXEL.", "",
                     "AROUND IT A MILLION", "BY A MILLION OTHERS." }),
    table_set(300, dice), lamp(420), cat(236, 628, "#b5672d"), curtains(dice), room.bars,
  }
end

return room
