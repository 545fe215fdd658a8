-- The way into the town, upright, with sound, for places where nobody can zoom: from the street to
-- the animator's paper, to the paper on that paper, and to the town that lies on the last one.
--
-- With --set sheet=town.dzi the last sheet is a picture in tiles, cut by `celspan tiles` from the
-- town; without it, a drawing.
local csv = require "celspan.csv"
local panes = require "town.panes"
local scene = require "town.scene"
local score = require "works.sound.score"

local set = parameters { sheet = "" }

local W, H, SECONDS = 1080, 1920, 20
local FIRST = 96 -- he is at the lamp of the story
local TALL = { 450, 600 } -- of a room of the chain

-- ---------------------------------------------------------------- the places

--- A room: its film, and its box in the frame around it.
local function room_of(name, x, y, w, h)
  local film = require("town.windows." .. name)
  return { film = film, x = x, y = y, scale = w / film.size[1], height = h }
end

-- The chain of rooms in each other, from the one in the town.
local chain, others = {}, {}
for _, box in ipairs(panes.boxes) do
  local is_chain = box.room == "animator"
  if box.room ~= "" then
    local list = is_chain and chain or others
    list[#list + 1] = room_of(box.room, box.x, box.y, box.width, box.height)
  end
end
for _, name in ipairs { "animator", "animator_drawn" } do -- each has one window
  local box = assert(csv.read("windows/" .. name .. ".csv", { types = panes.types }))[1]
  chain[#chain + 1] = room_of(box.room, box.x, box.y, box.width, box.height)
end

--- Where a place of the frame of level k, 0 for the town, is in units of the town; and the size
--- there of a unit of the level.
local function outward(k, x, y)
  local scale = 1
  for i = k, 1, -1 do
    x, y = chain[i].x + x * chain[i].scale, chain[i].y + y * chain[i].scale
    scale = scale * chain[i].scale
  end
  return x, y, scale
end

-- ---------------------------------------------------------------- the way

-- Seconds, level, and the middle and the height of what is seen there.
local SHEET = { 45, 300, 360, 202.5 }
local stops = {
  { 0, 0, 1203, 540, 1080 }, { 1.8, 0, 1203, 540, 1080 }, { 7.6, 1, 225, 300, 588 },
  { 9.8, 1, 225, 320, 520 }, { 13.4, 2, 225, 300, 588 }, { 14.6, 2, 225, 320, 540 },
  { 17.4, 3, 225, 300, 588 }, { 18, 3, 225, 320, 560 },
  { 19.6, 3, SHEET[1] + SHEET[3] * 1203 / 1920, SHEET[2] + SHEET[4] / 2, SHEET[4] },
  { 20, 3, SHEET[1] + SHEET[3] * 1203 / 1920, SHEET[2] + SHEET[4] / 2, SHEET[4] },
}
for i, stop in ipairs(stops) do
  local x, y, scale = outward(stop[2], stop[3], stop[4])
  stops[i] = { time = stop[1], x = x, y = y, height = stop[5] * scale }
end

--- What is seen at a time: its middle and its height, in units of the town. Between two stops the
--- height shrinks by equal factors in equal times, and the place that is aimed at goes straight.
local function view(time)
  local i = 1
  while stops[i + 2] and time >= stops[i + 1].time do i = i + 1 end
  local a, b = stops[i], stops[i + 1]
  local u = ease "inOutSine"(math.min(1, (time - a.time) / (b.time - a.time)))
  local height = a.height * (b.height / a.height) ^ u
  local v = a.height == b.height and u or (a.height - height) / (a.height - b.height)
  return a.x + (b.x - a.x) * v, a.y + (b.y - a.y) * v, height
end

-- ---------------------------------------------------------------- the picture

--- The frame of a film at a time, which plays again and again.
local function frame_of(film, time)
  local number = math.floor(time * film.fps + 1e-6) % film.frames + 1
  return film:at(number):with { size = film.size }
end

--- Art of a level in the picture, where its unit is `scale` pixels and its corner is at x, y.
local function put(art, x, y, scale) return art:scale(scale):translate(x, y) end

--- Rooms of the town that are large enough to be seen.
local function put_others(shown, time, cx, cy, zoom)
  for _, room in ipairs(others) do
    local x, y = W / 2 + (room.x - cx) * zoom, H / 2 + (room.y - cy) * zoom
    local high = room.height * zoom
    local wide = high * room.film.size[1] / room.film.size[2]
    if high > 40 and x < W and x + wide > 0 and y < H and y + high > 0 then
      shown[#shown + 1] = put(frame_of(room.film, time), x, y, room.scale * zoom)
        :fade(math.min(1, high / 40 - 1))
    end
  end
end

local picture = set.sheet ~= "" and rect { SHEET[1], SHEET[2], SHEET[3], SHEET[4],
  fill = celspan.picture { file = set.sheet, box = SHEET } }

local function frame(f)
  local cx, cy, height = view(f.time)
  local shown, zoom = {}, H / height
  if zoom * chain[1].height < 1.7 * H then
    local drawing = (FIRST + math.floor(f.time * 12)) % 144
    local art = scene.all { index = drawing, count = 144, time = drawing / 12 }
    shown[1] = put(union(art), W / 2 - cx * zoom, H / 2 - cy * zoom, zoom)
    put_others(shown, f.time, cx, cy, zoom)
  end
  local left, top, unit = W / 2 - cx * zoom, H / 2 - cy * zoom, zoom
  for k, room in ipairs(chain) do
    left, top = left + room.x * unit, top + room.y * unit
    unit = unit * room.scale
    local next_high = chain[k + 1] and chain[k + 1].height * unit or 0
    if TALL[2] * unit > 24 and next_high < 1.7 * H then
      shown[#shown + 1] = put(frame_of(room.film, f.time), left, top, unit)
        :fade(math.min(1, TALL[2] * unit / 24 - 1))
      if k == #chain and picture then shown[#shown + 1] = put(picture, left, top, unit) end
    end
  end
  return cel(shown)
end

-- ---------------------------------------------------------------- what is heard

local TAU = 2 * math.pi

--- A bowed string: it swells, and its tone trembles.
local function bow(hertz, length)
  return { length = length, at = function(t)
    local turn = TAU * hertz * t + 0.06 * hertz / 5.5 * math.sin(TAU * 5.5 * t) * math.min(1, t)
    return (math.sin(turn) + 0.5 * math.sin(2 * turn) + 0.28 * math.sin(3 * turn)
      + 0.12 * math.sin(5 * turn)) * math.min(1, 2.5 * t) * math.min(1, 2 * (length - t))
  end }
end

-- A cello under the street, which goes higher and thinner with each sheet of paper, and comes home
-- with the last one; a bell as one goes past the tower; a pencil where she draws.
local notes = {
  { 0, score.wind(0.04, 9, 0.3), 0.5 }, { 0.2, bow(98, 2.6), 0.16 }, { 2.6, bow(110, 2.4), 0.17 },
  { 4.8, bow(130.8, 2), 0.17 }, { 6.6, bow(146.8, 1.6), 0.16 }, { 8, bow(196, 2.6), 0.12 },
  { 1.2, score.bell("D5", 2), 0.05, 0.4 }, { 4.6, score.bell("G4", 3), 0.2, 0.3 },
  { 6.1, score.bell("G4", 3), 0.12, 0.5 }, { 10.6, bow(293.7, 2.8), 0.06 },
  { 14.4, bow(587.3, 2.8), 0.025 }, { 17.3, bow(98, 2.6), 0.15 }, { 17.3, bow(196, 2.6), 0.07 },
  { 17.5, bow(246.9, 2.4), 0.06 }, { 17.7, bow(293.7, 2.2), 0.06 },
  { 13.6, score.bell("B6", 1.6), 0.05 }, { 17.3, score.bell("D7", 2), 0.04 },
  { 18.9, score.bell("G6", 1.1), 0.05 },
}
for i = 0, 11 do
  local quiet = i < 6 and 0.32 or 0.1
  local time = (i < 6 and 8.2 or 10.7) + 0.31 * (i % 6)
  notes[#notes + 1] = { time, score.click(0.55, 0.2), quiet, 0.2 }
end

return film { title = "A hundred windows", size = { W, H }, fps = 24, duration = SECONDS,
  sound = score.play(SECONDS, notes), frame = frame }
