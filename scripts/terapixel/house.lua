-- Houses: each a wall with a gable, a door, a chimney, and windows with rooms in them. Units are
-- those of the frame, whose side is a thousand units; y is the ground of the house.
local palette = require "demo.palette"
local shapes = require "demo.shapes"
local draw = require "terapixel.draw"
local room = require "terapixel.room"
local Dice = require "terapixel.dice"

local house = {}

--- Two dozen rooms, each of which is behind many windows.
local rooms = {}
for i = 1, 24 do rooms[i] = room.any(Dice.new("room " .. i)) end

local dark_pane = union {
  draw.rect(0, 0, 600, 700, shapes.down(0, 700, { "#4a5a78", "#2b3350" })),
  draw.path("#ffffff18", "M60 700L330 0H470L200 700Z"),
  draw.rects("#c9b79a40", { { 0, 0, 90, 700 }, { 510, 0, 90, 700 } }),
  room.bars,
}

--- A box of flowers under a window, with a bee now and then: as wide as the window, 640.
local function flower_box(dice)
  local parts = { draw.rect(-10, 742, 620, 96, "#7a4b2a", 10),
                  draw.rects("#54301f", { { -10, 770, 620, 8 }, { -10, 806, 620, 6 } }) }
  local leaves, stems, blossoms = {}, {}, {}
  local colours = { "#e9573f", "#e8a33d", "#fbdcae", "#c0527a" }
  for i = 0, 11 do
    local x, tall = 24 + i * 50, dice:between(40, 110)
    stems[#stems + 1] = { x - 2, 742 - tall, 4, tall }
    leaves[#leaves + 1] = ("M%g 742q-22 -12 -26 -34q20 4 26 34q2 -30 24 -40q0 26 -24 40Z")
      :format(x)
    blossoms[#blossoms + 1] = { x, 742 - tall, dice:one(colours) }
  end
  parts[#parts + 1] = draw.rects("#55683f", stems)
  parts[#parts + 1] = draw.path("#6d7f4a", table.concat(leaves))
  for _, b in ipairs(blossoms) do
    for k = 0, 4 do
      local a = math.rad(k * 72 + b[1])
      parts[#parts + 1] = draw.disc(b[1] + 11 * math.cos(a), b[2] + 11 * math.sin(a), 8.5, b[3])
    end
    parts[#parts + 1] = draw.disc(b[1], b[2], 6, "#fff0b8")
  end
  local b = dice:one(blossoms)
  local bee = union {
    draw.oval(-3, -6, 5, 3, "#ffffffa0"), draw.oval(4, -6, 5, 3, "#ffffffa0"),
    draw.oval(0, 0, 8, 5, "#e8a33d"),
    draw.rects("#2b1b2c", { { -4, -4.4, 2, 8.8 }, { 0, -5, 2, 10 }, { 4, -4, 1.6, 8 } }),
    draw.disc(-6, -1.4, 1.1, "#2b1b2c"), draw.disc(-6.3, -1.7, 0.35, "#fff4dc"),
    draw.path("#2b1b2c", "M-6 -4q-1 -4 -4 -4.6l0 0.6q2 1 3 4.4Z"
      .. "M-4.4 -4.6q0 -4 -2 -5.6l-0.4 0.5q1.4 2 1.4 5.3Z"),
  }
  parts[#parts + 1] = bee:translate(b[1] + 6, b[2] - 16)
  return union(parts)
end

local boxes = {}
for i = 1, 6 do boxes[i] = flower_box(Dice.new("flowers " .. i)) end

--- Courses of tiles on a gable: every other one set off by half a tile.
local function tiles(x, y, w, peak, texture)
  local list, rows = {}, 9
  for row = 0, rows - 1 do
    local u0 = row / rows
    local half = (w * 1.2) / 2 * (1 - u0) - w * 0.03
    local step, height = w * 0.085, peak / rows
    local shift = row % 2 * step / 2
    for k = -math.floor(half / step), math.floor(half / step) - 1 do
      list[#list + 1] = { x + w / 2 + k * step + shift, y - (row + 1) * height + height * 0.72,
                          step * 0.9, height * 0.2 }
    end
  end
  return draw.rects(texture, list)
end

local function door(x, y, w, dice)
  local h = w * 1.9
  return union {
    draw.rect(x - w * 0.08, y - h - w * 0.08, w * 1.16, h + w * 0.08, "#c99f74"),
    draw.rect(x, y - h, w, h, dice:one { "#2f7f86", "#8e4a48", "#4c3569", "#35492f" }),
    draw.rects("#00000038", { { x + w * 0.12, y - h * 0.9, w * 0.32, h * 0.36 },
                              { x + w * 0.56, y - h * 0.9, w * 0.32, h * 0.36 },
                              { x + w * 0.12, y - h * 0.44, w * 0.32, h * 0.36 },
                              { x + w * 0.56, y - h * 0.44, w * 0.32, h * 0.36 } }),
    draw.disc(x + w * 0.88, y - h * 0.46, w * 0.05, "#f0d9a8"),
    draw.rect(x - w * 0.2, y, w * 1.4, w * 0.14, "#8d7b78"),
  }
end

--- Bricks that are visible where the plaster is gone.
local function bricks(x, y, w, h, dice)
  local list = {}
  for _ = 1, 5 do
    local bx, by = x + dice:between(0.04, 0.8) * w, y - dice:between(0.08, 0.92) * h
    for k = 0, dice:one(5) do
      list[#list + 1] = { bx + k % 3 * w * 0.042 + k // 3 % 2 * w * 0.02, by + k // 3 * w * 0.021,
                          w * 0.038, w * 0.017 }
    end
  end
  return draw.rects("#a9796a", list)
end

--- Rounded to a thousandth, which is a pixel of the largest frame.
local function on_grid(v) return math.floor(v * 1000 + 0.5) / 1000 end

--- Wall, gable and chimney.
local function shell(x, y, w, h, peak, dice)
  local wall = shapes.across(x, x + w, { dice:one(palette.walls), palette.wall_shade })
  return {
    draw.rect(x + w * 0.68, y - h - peak * 0.95, w * 0.11, peak * 0.8, palette.roofs[2]),
    draw.rect(x + w * 0.66, y - h - peak * 0.99, w * 0.15, w * 0.03, "#6b3a3c"),
    draw.rect(x, y - h, w, h, wall), bricks(x, y, w, h, dice),
    draw.rect(x, y - w * 0.08, w, w * 0.08, "#8d7b78"),
    draw.path(dice:one(palette.roofs), "M%g %gL%g %gL%g %gZ", x - w * 0.1, y - h + w * 0.04,
      x + w / 2, y - h - peak, x + w * 1.1, y - h + w * 0.04),
    tiles(x, y - h + w * 0.03, w, peak * 0.96, "#00000030"),
    draw.rect(x - w * 0.1, y - h + w * 0.02, w * 1.2, w * 0.035, "#6b3a3c"),
    draw.disc(x + w / 2, y - h - peak * 0.38, w * 0.055, "#2b2440"),
  }
end

local gallery = room.gallery(Dice.new "gallery")

--- Shell, rooms and halos of a house. has_gallery: its first window is the one with the film.
function house.draw(x, y, w, dice, has_gallery)
  local h, peak = w * dice:between(0.95, 1.35), w * dice:between(0.5, 0.66)
  local front, inside, halos = shell(x, y, w, h, peak, dice), {}, {}
  local columns = w > 40 and 3 or 2
  local side = on_grid(has_gallery and 6 or w * 0.5 / columns)

  local function window(wx, wy, view, is_lit)
    local function place(art) return art:scale(side / 600):translate(wx, wy) end
    inside[#inside + 1] = place(view)
    if view == gallery then
      inside[#inside + 1] = place(boxes[1])
    elseif dice:once(2) then
      inside[#inside + 1] = place(dice:one(boxes))
    end
    if is_lit then
      halos[#halos + 1] = draw.halo(wx + side / 2, wy + side * 0.6, side * 2, 1, 0.5, 0.16, 0.009)
    end
  end

  for i = 0, 2 * columns - 1 do
    local row, column = i // columns, i % columns
    local wx = on_grid(x + w * (column + 0.5) / columns - side / 2)
    local wy = on_grid(y - h * (0.9 - row * 0.46))
    if i == 2 * columns - 1 then
      front[#front + 1] = door(wx + side * 0.1, y - w * 0.01, side * 0.85, dice)
    elseif i == 0 and has_gallery then
      window(wx, wy, gallery, true)
    elseif dice:once(3) then
      window(wx, wy, dark_pane, false)
    else
      window(wx, wy, dice:one(rooms), true)
    end
  end
  return front, inside, halos
end

return house
