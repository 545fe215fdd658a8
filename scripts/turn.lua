-- A head that turns: three drawings with the same names of parts, and morphs between them. A
-- butterfly flies past, and she looks after it.

local views = {}
for i, name in ipairs { "front", "quarter", "side" } do
  views[i] = assert(svg.read("drawings/head-" .. name .. ".svg"))
end

-- 0: she looks at us; 1 and 2: the drawings between and from the side. She blinks as she turns.
local turn = keys { { 0.7, 0 }, { 0.9, 0.08, "inOutSine" }, { 1.7, 2, "inOutCubic" }, { 2.7, 2 },
                    { 3.5, 0, "inOutCubic" } }
local dip = keys { { 0.7, 0 }, { 1.25, 9, "inOutSine" }, { 1.8, 0, "outBack" }, { 2.7, 0 },
                   { 3.1, 7, "inOutSine" }, { 3.6, 0, "outBack" } }
local lids = keys { { 0.95, 1 }, { 1.08, 0.06 }, { 1.25, 1 }, { 2.75, 1 }, { 2.9, 0.06 },
                    { 3.05, 1 } }
local glance = keys { { 0, 4 }, { 0.5, -2, "inOutSine" }, { 0.9, -5, "outQuad" }, { 1.7, -1 },
                      { 2.7, -1 }, { 2.9, 5, "outQuad" }, { 3.5, 0, "inOutSine" } }

--- A view with the eyes as they are at a time.
local function face(art, time)
  local changes = {}
  local function shut(part)
    local _, y, _, h = part:bounds()
    return part:scale(1, lids:at(time), 0, y + h / 2)
  end
  local function look(part) return shut(part):translate(glance:at(time), 0) end
  for _, side in ipairs { " far", " near" } do
    changes["white" .. side], changes["pupil" .. side], changes["glint" .. side] = shut, look, look
  end
  return art:with(changes).object
end

local function head(time)
  local u = turn:at(time)
  local i = math.min(math.floor(u), 1)
  return morph(face(views[i + 1], time), face(views[i + 2], time), u - i)
end

local way = motion.along "M700 60 C560 20 470 130 400 110 S260 60 180 130 S20 90 -90 40"
local function butterfly(time)
  local beat = math.abs(math.sin(9 * time)) * 0.85 + 0.15
  local wing = union { path { d = "M0 0C10 -34 44 -40 44 -16C44 4 16 6 0 0Z",
    fill = "#f2a33a" }, path { d = "M0 2C16 4 34 12 28 26C18 36 2 20 0 2Z",
    fill = "#e0703a" },
    circle { 30, -18, 5, fill = "#7a3320" } }
  local body = ellipse { 0, 2, 3, 15, fill = "#3a241c" }
  local x, y = way:at(math.max(0, math.min(1, time / 3)))
  return union { wing:scale(-beat, 1), wing:scale(beat, 1), body }:rotate(-24)
    :translate(x, y + 6 * math.sin(7 * time))
end

local wall = linear { from = { 0, 0 }, to = { 0, 400 }, { 0, "#cfe6df" }, { 1, "#a9cfc6" } }
local hills = path { d = "M0 330 Q150 250 330 318 T640 290 V400 H0 Z", fill = "#8bbcab" }

return film { size = { 640, 400 }, frames = 96, frame = function(f)
  local her = head(f.time):scale(1.12):translate(156, 24 + dip:at(f.time) * 0.6)
  return {
    cel { rect { 0, 0, 640, 400, fill = wall }, hills },
    cel { her:paint "#2c5a55":translate(14, 6), opacity = 0.22, defocus = 10 },
    her, butterfly(f.time) }
end }
