-- From pencil to screen: a frog has a plan, in a cut of four seconds from scans of pencil drawings.
-- A script drew the scans; `--set time=night` has the colours of the night.
local ink, sheet = require "celspan.ink", require "celspan.sheet"
local trace = require "celspan.trace"
local palettes = require "pencil.palettes"
local paint, pond = require "pencil.paint", require "pencil.pond"

local p = parameters { time = { "day", "night" } }
local cut = assert(sheet.read "pencil/cut12.txt")
local track = assert(lips.read("pencil/line.tsv", { fps = 24 }))
local day, now = palettes.day, palettes[p.time]

-- ---------------------------------------------------------------- lines and paint

local function lines(level, number)
  local file = ("pencil/clean/%s.%04d.png"):format(level, number)
  return assert(trace.picture(file, { lines = true, smooth = 3 })).object:paint(day.line)
end

--- The areas around the places of paint.lua, in the colours of the day.
local function fill(drawing, places)
  local colours = {}
  for i, at in ipairs(places) do colours[i] = { at[1], at[2], day[at[3]] } end
  return ink.areas { drawing, gap = 12, colours = colours }
end

--- The light in the eyes.
local function glints(places)
  local list = {}
  for _, at in ipairs(places) do
    if at[3] == "pupil" then
      local glint = circle { at[1] + 3, at[2] - 4, 3.2, fill = now.eye }
      list[#list + 1] = glint:named("glint " .. #list)
    end
  end
  return union(list)
end

local function key(number)
  local legs, body = lines("legs", math.min(number, 8)), lines("body.black", number)
  local places = paint[number]
  local function dressed(object, name) return ink.recolour(object, day, now):named(name) end
  return union {
    dressed(fill(legs, places.legs), "paint of legs"), dressed(legs, "legs"),
    dressed(fill(body, places.body), "paint"), dressed(body, "lines"), glints(places.body) }
end

local drawings, mouths = {}, {}
for i = 1, #paint do drawings["A" .. i] = key(i) end
for i, shape in ipairs { "B", "D", "F" } do
  local mouth, places = lines("mouth", i), { { 391, 353, "mouth" } }
  if shape == "D" then places[2] = { 391, 376, "tongue" } end
  mouths[shape] = ink.recolour(fill(mouth, places) | mouth, day, now)
end
local between = { charts = { ["A1-A2"] = "slow in", ["A2-A3"] = "slow in", ["A6-A7"] = "slow in" } }

-- ---------------------------------------------------------------- the cut

--- How far a held drawing is moved on its pegs: the leap, and what settles.
local lift = keys { { 0, 0 }, { 31.9, 0, "hold" }, { 32, -8 }, { 35, -46, "outQuad" },
  { 35.9, -46, "hold" }, { 36, 10 }, { 38.5, -6, "outQuad" }, { 43, 120, "inQuad" },
  { 43.9, 120, "hold" }, { 44, 0 }, { 72.9, 0, "hold" }, { 73, -12 }, { 76, 0, "outBack" } }

local function halo(x, y, radius, alpha)
  local light = radial { centre = { x, y }, radius = radius,
    { 0, now.fly .. alpha }, { 0.4, now.fly .. "48" }, { 1, now.fly .. "00" } }
  return circle { x, y, radius, fill = light }:fade(p.time == "night" and 1 or 0.45)
end

--- The firefly and its light, in pixels of the scans; nil: it is in the frog.
local way = motion.along("M780 190 C700 130 650 230 590 190 S530 150 500 185 S540 230 560 195 "
  .. "S530 175 522 205")
local out = motion.along "M391 356 C430 330 470 300 500 260 S440 190 520 170 S560 215 505 180"
local TIP = { 522, 205 } -- where the tongue gets it
local tongue = keys { { 32, 0 }, { 34, 1, "outQuad" }, { 35, 0.4 }, { 36, 0 } }

local function firefly(index)
  local x, y
  if index < 34 then
    x, y = way:at(ease "outSine"(index / 34))
  elseif index < 36 then
    x, y = TIP[1] - (index - 34) * 94, TIP[2] + (index - 34) * 12
  elseif index >= 67 then
    x, y = out:at(ease "outCubic"((index - 67) / 29))
  else
    return nil
  end
  local spread = index % 2 == 0 and 1 or 0.45
  local wing = ellipse { 0, -11, 5 * spread, 10, fill = now.eye }:fade(0.85)
  return union { wing:rotate(-38), wing:rotate(30), ellipse { 3, 5, 6, 7, fill = now.fly },
    ellipse { 0, -2, 5, 5, fill = day.pupil } }:translate(x, y), halo(x, y, 46, "b0")
end

--- The tongue, from the mouth of the fourth drawing.
local function lick(index, moved)
  local u = tongue:at(index)
  if u <= 0 then return nil end
  local x, y = 366, 266 + moved
  local dx, dy = u * (TIP[1] - x), u * (TIP[2] - y)
  return stroke { degree = 2, cap = "round", fill = now.tongue, points = {
    { x, y, 16 }, { x + 0.5 * dx, y + 0.6 * dy, 11 }, { x + dx, y + dy, 19 } } }
end

--- The light of what was swallowed, through the belly.
local belly = keys { { 36, { 389, 248 } }, { 43.9, { 389, 248 }, "hold" }, { 44, { 396, 414 } },
  { 52, { 393, 392 }, "outQuad" } }
local function glow(index, moved)
  if index < 36 or index >= 67 then return nil end
  local x, y = table.unpack(belly:at(index))
  return halo(x, y + moved, 70 + 8 * math.sin(index * 0.9), "e0")
end

local planes, near = pond(now)
local camera = { x = keys { { 0, -24 }, { 95, 26, "inOutSine" } },
  y = keys { { 0, 14 }, { 28, 22, "inOutSine" }, { 38, -26, "outCubic" }, { 52, 16, "inOutSine" },
    { 95, 8 } },
  z = keys { { 0, 0 }, { 30, 90, "inOutSine" }, { 38, 40, "outCubic" }, { 95, 150, "inOutSine" } } }

--- Objects, or nil, in pixels of the scans, as the camera's field has them.
local function field(...)
  local list = {}
  for i = 1, select("#", ...) do list[#list + 1] = (select(i, ...)) end
  return union(list):translate(-30, -95):scale(1.75)
end

--- The shadow on the leaf: smaller and paler, the higher he is.
local function shadow(drawing)
  local left, top, width, height = drawing:bounds()
  local high = math.max(0, 440 - top - height)
  return ellipse { left + width / 2, 446, width * (0.46 - high / 1000), 9, fill = now.water }
    :fade(0.6 - high / 500)
end

return film { size = { 1280, 720 }, fps = 24, frames = 96, palettes = { now },
  frame = function(f)
    local moved = lift:at(f.index)
    local drawing = cut:drawing("frog", f, drawings, between):translate(0, moved)
    local mouth = mouths[track:at(f.number)]
    local scene = { film = { 1280, 720 }, fit = true, focus_on = 0, aperture = 5,
      camera = { x = camera.x:at(f.index), y = camera.y:at(f.index), z = camera.z:at(f.index) } }
    for i, plane in ipairs(planes) do scene[i] = plane end
    local bug, light = firefly(f.index)
    scene[#scene + 1] = { cel { field(shadow(drawing)) }, cel { field(drawing) }:named "frog",
      cel { field(glow(f.index, moved)), blend = "screen" },
      cel { field(mouth, lick(f.index, moved), bug) }:named "mouth and firefly",
      cel { field(light), blend = "screen" }, z = 0 }
    scene[#scene + 1] = near
    return multiplane(scene)
  end }
