-- Makes valley.ora, the layered painting of scripts/layers.lua:
--
--   LUA_CPATH=build/?.so lua5.4 scripts/paintings/make.lua      from the root of the tree
--
-- Each layer is drawn with celspan and cropped to its contents; then all are put into an archive.
package.path = "./?.lua;" .. package.path
setmetatable(_G, { __index = require("celspan").names {} })
local draw = require "scripts.paintings.draw"
local paintings = require "tests.support.paintings"

local W, H = 1200, 540

--- A hill line from left to right, down to the ground: the sum of two waves and some roughness.
local function ridge(base, height, pitch, rough, seed)
  local random = celspan.random(seed)
  local points = {}
  for i = 0, 120 do
    local x = W * i / 120
    local y = base
      - height * (0.6 * math.sin(pitch * i / 19 + seed) + 0.4 * math.sin(pitch * i / 7 + 2 * seed))
    points[#points + 1] = { x, y - rough * (random(i) - 0.5) }
  end
  points[#points + 1] = { W, H }
  points[#points + 1] = { 0, H }
  return points
end

local function hill(base, height, pitch, rough, seed, top, foot)
  local points = ridge(base, height, pitch, rough, seed)
  points.texture = linear { from = { 0, base - height }, to = { 0, H }, { 0, top },
    { 1, foot } }
  return polygon(points)
end

--- A fir: boughs from the crown down.
local function fir(x, foot, height, colour)
  local parts = { rect { x - height / 60, foot - height / 8, height / 30, height / 8,
    fill = colour } }
  for i = 0, 6 do
    local y, w = foot - height + height * 0.13 * i, height * (0.045 + 0.028 * i)
    parts[#parts + 1] = polygon { { x, y }, { x + w, y + height * 0.2 },
      { x + w * 0.3, y + height * 0.17 },
      { x - w * 0.4, y + height * 0.185 }, { x - w, y + height * 0.21 }, fill = colour }
  end
  return union(parts)
end

local function firs(count, foot, height, colour, seed)
  local random, parts = celspan.random(seed), {}
  for i = 1, count do
    local x = W * (i - 0.5 + 0.7 * (random(i) - 0.5)) / count
    parts[i] = fir(x, foot + 18 * random("foot" .. i), height * (0.7 + 0.6 * random("height" .. i)),
      colour)
  end
  return parts
end

local function disc(x, y, r, ...)
  return circle { x, y, r,
    fill = radial { centre = { x, y }, radius = r, ... } }
end

--- A bank of mist: long soft lobes.
local function mist(y, colour)
  local clear, parts = rgb(colour, 0), {}
  for i = 0, 6 do
    local lobe = disc(0, 0, 100, { 0, rgb(colour, 0.55) },
      { 0.5, rgb(colour, 0.25) }, { 1, clear })
    parts[i + 1] = lobe:scale(2.2, 0.22):translate(W * i / 6, y + 16 * math.sin(i * 2.2))
  end
  return union(parts)
end

local layers = {
  { name = "sky",
    rect { 0, 0, W, H, fill = linear { from = { 0, 0 }, to = { 0, 430 },
    { 0, "#20365f" }, { 0.45, "#7a6f9a" }, { 0.75, "#e8a184" }, { 1, "#ffdfa8" } } } },
  { name = "sun", circle { 760, 262, 30, fill = "#fff3d0" } },
  { name = "glow", blend = "svg:plus", opacity = 0.8,
    disc(760, 262, 330, { 0, rgb("#ffb060", 0.8) },
    { 0.3, rgb("#f08040", 0.3) }, { 1, rgb("#f08040", 0) }) },
  { name = "far", layers = {
    { name = "peaks", hill(300, 58, 1.3, 22, 3, "#6a5f8c", "#c88f8f") },
    { name = "mist", opacity = 0.9, mist(356, "#ffd9b8") },
  } },
  { name = "hills", hill(380, 34, 0.9, 6, 8, "#3d4a6e", "#7d6478") },
  { name = "wood", layers = {
    { name = "firs", table.unpack(firs(34, 425, 92, "#1f3048", 5)) },
    { name = "slope", hill(428, 14, 0.7, 3, 11, "#1f3048", "#182238") },
    { name = "shade", blend = "svg:multiply", opacity = 0.7, rect { 0, 330, W, 210,
      fill = linear { from = { 0, 330 }, to = { 0, 540 }, { 0, "#ffffff00" },
        { 1, "#40508c" } } } },
  } },
  { name = "near", layers = {
    { name = "firs", table.unpack(firs(9, 560, 330, "#0a1220", 7)) },
    { name = "notes", visible = false, rect { 20, 20, 200, 60, fill = "#ff3b30" } },
  } },
}

local function draw_all(list)
  for _, layer in ipairs(list) do
    if layer.layers then
      draw_all(layer.layers)
    else
      local picture = draw(union { table.unpack(layer) }, W, H, 1)
      layer.x, layer.y, layer.png = picture.x, picture.y, picture.png
    end
  end
end

draw_all(layers)
local file = assert(io.open(arg[1] or "scripts/paintings/valley.ora", "wb"))
assert(file:write(paintings.openraster { w = W, h = H, layers = layers }))
file:close()
