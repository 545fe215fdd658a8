-- A town at dusk for a frame of a million pixels per side.
--
--   celspan render scripts/terapixel.lua --size 1000000x1000000 --crop X,Y,W,H -o part.png
--
-- From afar it is a hill with houses. Ten times closer every house has windows; a hundred times
-- closer every lit window shows a room, and every room has a picture on its wall. One of these
-- pictures is a whole frame of scripts/demo.lua.
local landscape = require "demo.landscape"
local palette = require "demo.palette"
local Dice = require "terapixel.dice"
local draw = require "terapixel.draw"
local house = require "terapixel.house"
local land = require "terapixel.land"

local light = palette.lights
local time = 6.3

--- Appends the parts of a house, or of a lamp, each to the cel that lights it.
local function add(cels, ...)
  for i, parts in ipairs { ... } do table.move(parts, 1, #parts, #cels[i] + 1, cels[i]) end
end

--- Lamps on both sides of the lane, in turn.
local function lamp(cels, row, y, width)
  local x, half = land.lane(y)
  local post, glass, halo = land.lamp(x + (row % 2 * 2 - 1) * half * 1.15, y, width * 0.7)
  add(cels, { post }, { glass }, { halo })
end

--- One terrace: houses side by side along the hill, at the fraction `down` of the way to its foot.
--- One house of the fourth terrace has the film on its wall.
local function terrace(row, down, width)
  local dice = Dice.new("terrace " .. row)
  local cels = { {}, {}, {} } -- shells, rooms, halos
  local is_hung = row ~= 4
  local x = dice:between(-40, 10)
  while x < 1000 do
    local w = width * dice:between(0.85, 1.2)
    local top = land.crest(x + w / 2)
    local y = top + (950 - top) * down + dice:between(-3, 3)
    local lane, half = land.lane(y)
    local is_free = not lane or x - w * 0.15 > lane + half or x + w * 1.15 < lane - half
    if top > 690 - row * 4 or (dice:once(6) and is_free) then
      add(cels, { land.tree(x + w / 2, y, w * dice:between(1, 1.5), dice) })
    elseif is_free then
      local is_gallery = not is_hung and x > 400
      add(cels, house.draw(x, y, w, dice, is_gallery))
      is_hung = is_hung or is_gallery
    end
    x = x + w * (is_free and dice:between(1.22, 1.45) or 0.3)
  end
  lamp(cels, row, 470 + row * row * 18, width)
  return cel { union(cels[1]), front = light.near:at(time - 2.4) },
    cel { union(cels[3]), front = { 7, 7, 7 } },
    cel { union(cels[2]), front = { 0.96, 0.9, 0.82 } }
end

--- The church on the crest, with a clock and a bell.
local function church(x, y)
  return union {
    draw.rect(x, y - 92, 34, 110, palette.walls[2]),
    draw.rect(x + 22, y - 92, 12, 110, "#00000028"),
    draw.path(palette.roofs[2], "M%g %gL%g %gL%g %gZ", x - 5, y - 90, x + 17, y - 168,
      x + 39, y - 90),
    draw.disc(x + 17, y - 70, 9, "#f6e3b8"), draw.disc(x + 17, y - 70, 0.8, palette.ink),
    draw.path(palette.ink, "M%g %gl0.6 -7l0.6 7l5 3l-0.6 1Z", x + 16.4, y - 70),
    draw.rects(palette.ink, { { x + 16.6, y - 78, 0.8, 2 }, { x + 16.6, y - 64, 0.8, 2 },
                              { x + 9, y - 70.4, 2, 0.8 }, { x + 23, y - 70.4, 2, 0.8 } }),
    draw.rect(x + 10, y - 44, 14, 24, "#ffd58f", 6),
    draw.rects("#2b1b2c", { { x + 16.7, y - 44, 0.6, 24 }, { x + 10, y - 33, 14, 0.6 } }),
  }
end

local function picture()
  local rings, disc = land.sun()
  local cels = {
    cel { land.air() },
    cel { land.stars() },
    cel { rings, front = { 6, 6, 6 } },
    cel { disc, front = { 1.1, 1.05, 1 } },
    cel { land.clouds() },
    cel { land.mountains, front = light.far:at(time) },
    cel { land.lake, land.glints, front = light.far:at(time) },
    cel { church(598, 458), front = light.middle:at(time - 2.4) },
    cel { land.hill, land.slope(), front = light.middle:at(time - 1) },
  }
  local rows = { { 0.06, 20 }, { 0.2, 26 }, { 0.37, 34 }, { 0.56, 44 }, { 0.78, 56 } }
  for row, at in ipairs(rows) do
    table.move({ terrace(row, at[1], at[2]) }, 1, 3, #cels + 1, cels)
  end
  cels[#cels + 1] = cel { land.ground, front = light.near:at(time) }
  cels[#cels + 1] = cel {
    landscape.meadow:scale(0.42):translate(0, 545), landscape.branch:scale(0.5):translate(-130, 0),
    front = { 0, 0, 0 } }
  return rostrum(cels)
end

return film {
  title = "A town of a million million pixels", size = { 1000, 1000 }, frames = 1, frame = picture }
