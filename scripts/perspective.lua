-- A gallery in one-point perspective: floor, walls and pictures are flat drawings, each carried to
-- its place by quad(), which maps four corners to four others. The camera walks in.
local shapes = require "demo.shapes"

local deep = 9 -- metres from the first picture to the far wall
local eye_height, half_width, tall, focal = 1.6, 2.4, 3.6, 820

--- A drawing on a rectangle of `w` by `h` units, set on four points of the room {x, y up, z}.
local function hang(art, w, h, corners, camera)
  local to = {}
  for i, p in ipairs(corners) do
    local z = math.max(0.05, p[3] - camera)
    to[i] = { 960 + focal * p[1] / z, 560 - focal * (p[2] - eye_height) / z }
  end
  return art:quad({ { 0, 0 }, { w, 0 }, { w, h }, { 0, h } }, to)
end

local function chequers(columns, rows, dark, light)
  local parts = { rect { 0, 0, columns, rows, fill = light } }
  for i = 0, columns * rows - 1 do
    local x, y = i % columns, i // columns
    if (x + y) % 2 == 0 then parts[#parts + 1] = rect { x, y, 1, 1, fill = dark } end
  end
  return union(parts)
end

--- An abstract in a frame, 100 by 130.
local function painting(n)
  local inks = { "#d1495b", "#edae49", "#00798c", "#30638e", "#f4e3c1", "#3d2645" }
  local function ink(k) return inks[(n * 2 + k) % #inks + 1] end
  local field = rect { 8, 8, 84, 114, fill = ink(0) }
  local art = union {
    circle { 30 + n * 17 % 40, 44, 26, fill = ink(1) },
    ellipse { 60 - n * 11 % 30, 122, 62, 44 - n * 7 % 20,
              fill = ink(2) },
    rect { 20 + n * 23 % 40, 8, 9, 114, fill = ink(3) },
  }
  return union { rect { 0, 0, 100, 130, fill = "#c8a25c" },
                 rect { 4, 4, 92, 122, fill = "#fbf4e4" },
                 field, clip(art, field) }
end

local room = {
  floor = chequers(6, 28, "#4b2e3a", "#e6cfae"),
  wall = rect { 0, 0, 100, 100, fill = shapes.across(0, 100, { "#f2d9b0", "#6f8f8c" }) },
  ceiling = rect { 0, 0, 100, 100,
                   fill = shapes.down(0, 100, { "#5b7f80", "#fbeccb" }) },
  far = rect { 0, 0, 100, 100, fill = "#3f6f73" },
}

--- Corners of an upright rectangle, from the upper left: from (x0, z0) to (x1, z1) on the plan.
local function upright(x0, z0, x1, z1, low, high)
  return { { x0, high, z0 }, { x1, high, z1 }, { x1, low, z1 }, { x0, low, z0 } }
end

--- Corners of a horizontal rectangle as wide as the room, the far edge first.
local function level(y, z0, z1)
  local w = half_width
  return { { -w, y, z0 }, { w, y, z0 }, { w, y, z1 }, { -w, y, z1 } }
end

return film { frames = 48, frame = function(f)
  local w = half_width
  local camera = -1.7 + 1.9 * f.progress
  local near, back = camera + 0.3, deep + 0.6
  local art = {
    hang(room.far, 100, 100, upright(-w, back, w, back, 0, tall), camera),
    hang(painting(4), 100, 130, upright(-0.8, back, 0.8, back, 0.7, 2.7), camera),
    hang(room.floor, 6, 28, level(0, back, back - 12.5), camera),
    hang(room.ceiling, 100, 100, level(tall, back, near), camera),
    hang(room.wall, 100, 100, upright(-w, near, -w, back, 0, tall), camera),
    hang(room.wall, 100, 100, upright(w, near, w, back, 0, tall), camera),
  }
  for i = 4, 0, -1 do
    local z = 0.8 + i * 1.8
    art[#art + 1] = hang(painting(i), 100, 130, upright(-w, z, -w, z + 1, 1.1, 2.6), camera)
    art[#art + 1] = hang(painting(i + 7), 100, 130, upright(w, z + 1, w, z, 1.1, 2.6), camera)
  end
  return cel(art)
end }
