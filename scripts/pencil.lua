-- From pencil to screen: a frog has a plan, in a cut of 108 frames from pencil drawings and scans
-- of them that a script made. `--set time=night` has the colours of the night.
local ink, sheet = require "celspan.ink", require "celspan.sheet"
local trace = require "celspan.trace"
local palettes, eyes = require "pencil.palettes", require "pencil.eyes"
local paint, pond = require "pencil.paint", require "pencil.pond"

local p = parameters { time = { "day", "night" } }
local cut = assert(sheet.read "pencil/cut12.txt")
local track = assert(lips.read("pencil/line.tsv", { fps = 24 }))
local day, now = palettes.day, palettes[p.time]
local is_night = p.time == "night"

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

local function dressed(object, name) return ink.recolour(object, day, now):named(name) end

--- A drawing as two levels, between which light can fall: what is painted, and its lines.
local painted, lined = {}, {}
for i, places in ipairs(paint) do
  local number = places.limbs or i
  local legs, body = lines("legs", number), lines("body.black", i)
  painted["A" .. i] = union { dressed(fill(legs, paint[number].legs), "paint of legs"),
    dressed(legs, "legs"), dressed(fill(body, places.body), "paint") }
  lined["A" .. i] = dressed(body, "lines")
end

local mouths = {}
for i, shape in ipairs { "B", "D", "F" } do
  local mouth, places = lines("mouth", i), { { 391, 348, "mouth" } }
  if shape == "D" then places[2] = { 391, 369, "tongue" } end
  mouths[shape] = ink.recolour(fill(mouth, places) | mouth, day, now)
end

local between = { charts = { ["A1-A2"] = "slow in", ["A2-A3"] = "slow in",
  ["A10-A11"] = "slow in" } }

-- ---------------------------------------------------------------- how drawings are held

--- How a drawing lies on its pegs, { right, down, height }: the leap, the landing and a breath, his
--- surprise, and a hiccup.
local pegs = keys { { 31, { 0, 0, 1 } }, { 32, { 0, -4, 1.04 } }, { 36, { 14, -46, 1 }, "outQuad" },
  { 37, { 16, -47, 1 } }, { 38, { -8, -6, 1 } }, { 41, { 0, 6, 1 }, "inQuad" },
  { 42, { -1, -40, 1 } }, { 43, { 0, 4, 1.03 } }, { 44, { 0, 0, 0.96 } }, { 45, { 0, 0, 0.9 } },
  { 48, { 0, 0, 1 } }, { 52, { 0, 0, 1 } }, { 55, { 0, 0, 1.05 }, "outQuad" }, { 59, { 0, 0, 1 } },
  { 62, { 0, 0, 1.025 } }, { 65, { 0, 0, 1 } }, { 68, { 0, 0, 1.03 }, "outQuad" },
  { 72, { 0, 0, 0.95 }, "inQuad" }, { 74, { 0, 0, 0.97 } }, { 77, { 0, 0, 1.09 }, "outQuad" },
  { 80, { 0, 0, 0.985 }, "inOutSine" }, { 83, { 0, 0, 1 } }, { 100, { 0, 0, 1.01 } },
  { 101, { 0, 0, 0.94 } }, { 102, { 0, 0, 1.08 } }, { 104, { 0, 0, 0.98 } },
  { 107, { 0, 0, 1 } } }

--- How far his lids are closed.
local lids = keys { { 4, 0.5 }, { 7, 0, "outQuad" }, { 20, 0 }, { 28, 0.3 }, { 30, 0.3 }, { 31, 0 },
  { 72, 0 }, { 73, 0.8 }, { 75, 0.5 }, { 77, 0 }, { 84, 0 }, { 85, 0.55 }, { 86, 1 }, { 87, 1 },
  { 88, 0.4 }, { 89, 0 }, { 95, 0 }, { 99, 0.5, "inOutSine" }, { 101, 0.5 }, { 102, 0 },
  { 103, 0 }, { 107, 0.5, "inOutSine" } }

--- How far the leaf lies deeper: it gives way to the crouch, the leap and the landing.
local dip = keys { { 18, 0 }, { 28, 4, "inOutSine" }, { 31, 8 }, { 33, -6, "outQuad" },
  { 37, 3, "inOutSine" }, { 41, -1, "inOutSine" }, { 43, 0 }, { 44, 7 }, { 46, 16, "outQuad" },
  { 50, -5, "inOutSine" }, { 54, 3, "inOutSine" }, { 58, 0, "inOutSine" } }

-- ---------------------------------------------------------------- the firefly

--- A light; `inner` and `outer` are its alpha in the middle and around it.
local SOFT = is_night and "48" or "30"
local function halo(x, y, radius, inner, outer)
  local light = radial { centre = { x, y }, radius = radius,
    { 0, now.fly .. inner }, { 0.4, now.fly .. outer }, { 1, now.fly .. "00" } }
  return circle { x, y, radius, fill = light }
end

--- The ways of the firefly, in pixels of the scans; between them it is in the frog. The tongue
--- swings out of the mouth to TIP, and a little farther with its prey.
local way = motion.along("M780 190 C700 130 650 230 590 190 S530 150 500 185 S540 230 560 195 "
  .. "S530 175 522 205")
local out = motion.along "M391 356 C430 330 470 300 500 260 S440 190 520 170 S560 215 505 180"
local ROOT, TIP = { 358, 238 }, { 522, 205 }
local reach = keys { { 31, 0 }, { 32, 0.35 }, { 34, 1 }, { 35, 1.12 }, { 36, 0.45 }, { 37, 0 } }
local bend = keys { { 32, 0.1 }, { 33, 0.24 }, { 34, -0.06 }, { 35, -0.22 }, { 36, 0.34 } }

--- The place at a share of the tongue's way, and `aside` it.
local function along(index, u, aside)
  local at = pegs:at(index)
  local x, y = ROOT[1] + at[1], ROOT[2] + at[2]
  local dx, dy = TIP[1] - x, TIP[2] - y
  return x + u * dx + aside * dy, y + u * dy - aside * dx
end

local function lick(index)
  local u, b = reach:at(index), bend:at(index)
  if u <= 0 then return nil end
  local list = {}
  for i, more in ipairs { 4, 0 } do
    local points = {}
    for k, at in ipairs { { 0, 0, 15 }, { 0.3, b, 11 }, { 0.72, -0.7 * b, 9 }, { 1, 0, 20 } } do
      local x, y = along(index, u * at[1], u * at[2])
      points[k] = { x, y, at[3] + more }
    end
    list[i] = stroke { degree = 3, cap = "round", points = points,
      fill = i == 1 and now.line or now.tongue }
  end
  return union(list)
end

--- Where the firefly is; nil: in the frog.
local function flight(index)
  if index < 34 then return way:at(ease "outSine"(index / 34)) end
  if index < 37 then return along(index, reach:at(index), 0) end
  if index < 67 then return nil end
  local x, y = out:at(ease "outCubic"(math.min(1, (index - 67) / 29)))
  return x, y + 4 * math.sin(index * 0.4)
end

local function firefly(index)
  local x, y = flight(index)
  if not x then return nil end
  local spread = index % 2 == 0 and 1 or 0.45
  local wing = ellipse { 0, -11, 5 * spread, 10, fill = now.eye }:fade(0.85)
  return union { ellipse { 3, 5, 7.6, 8.6, fill = now.line }, wing:rotate(-38), wing:rotate(30),
    ellipse { 3, 5, 6, 7, fill = now.fly }, ellipse { 0, -2, 5, 5, fill = now.pupil } }
    :scale(1.15):translate(x, y), halo(x, y, 46, is_night and "b0" or "70", SOFT)
end

--- The light of what was swallowed, from the mouth into the belly, under the lines; and how bright
--- it is. He has swallowed two.
local belly = keys { { 37, { 358, 240 } }, { 38, { 388, 220 } }, { 41, { 389, 254 } },
  { 42, { 394, 322 } }, { 43, { 394, 322 } }, { 44, { 396, 414 } },
  { 52, { 393, 402 }, "outQuad" } }
local power = keys { { 36, 0 }, { 37, 0.5 }, { 39, 1 }, { 66, 1 }, { 67, 0 }, { 93, 0 },
  { 98, 0.7 }, { 101, 0.5 }, { 102, 1.6 }, { 104, 0.4 }, { 107, 0.8 } }
local function glow(index)
  local x, y = table.unpack(belly:at(index))
  local bright = power:at(index)
  if bright <= 0 then return nil end
  local radius = (58 + 6 * math.sin(index * 0.9)) * (0.6 + 0.4 * bright)
  return halo(x, y, radius, "f0", is_night and SOFT or "90"):fade(math.min(1, bright))
end

-- ---------------------------------------------------------------- the cut

local planes, leaf, near = pond(now)
local camera = { x = keys { { 0, -24 }, { 95, 26, "inOutSine" } },
  y = keys { { 0, 14 }, { 28, 22, "inOutSine" }, { 37, -46, "outCubic" }, { 52, 16, "inOutSine" } },
  z = keys { { 0, 0 }, { 30, 90, "inOutSine" }, { 37, 0, "outCubic" }, { 95, 150, "inOutSine" } } }

--- Objects, or nil, in pixels of the scans, as the camera's field has them; `down` in its pixels.
local function field(down, ...)
  local list = {}
  for i = 1, select("#", ...) do list[#list + 1] = (select(i, ...)) end
  return union(list):translate(-30, -95):scale(1.75):translate(0, down)
end

--- The shadow on the leaf: smaller and paler, the higher he is.
local function shadow(drawing)
  local left, top, width, height = drawing:bounds()
  local high = math.max(0, 444 - top - height)
  local dark = radial { centre = { 0, 0 }, radius = 100,
    { 0, now.reed .. "98" }, { 0.7, now.reed .. "80" }, { 1, now.reed .. "00" } }
  return circle { 0, 0, 100, fill = dark }:scale(width / 190 - high / 200, 0.1 - high / 1600)
    :translate(left + width / 2, 446):fade(math.max(0, 1 - high / 160))
end

--- Rings on the water, from the leaf outwards, after he has left it, and after he has landed.
local function rings(index)
  local list = {}
  for i, start in ipairs { 33, 45, 49 } do
    local age = (index - start) / 18
    if age > 0 and age < 1 then
      local rx, ry = 420 + 170 * age, 50 + 34 * age
      list[i] = stroke { d = ("M%g 632a%g %g 0 1 0 %g 0a%g %g 0 1 0 %g 0"):format(610 - rx, rx, ry,
        2 * rx, rx, ry, -2 * rx), width = 4 - 3 * age, fill = now.gleam }:fade(0.8 - 0.8 * age)
    end
  end
  return union(list)
end

return film { size = { 1280, 720 }, fps = 24, frames = 108, palettes = { now },
  frame = function(f)
    local i, at = f.index, pegs:at(f.index)
    local function held(object)
      return object and object:scale(at[3] ^ -0.5, at[3], 394, 446):translate(at[1], at[2])
    end
    local x, y = flight(i)
    local look = (not x or i > 100) and { 394, 470 } or { x - at[1], y - at[2] }
    local function gaze(name)
      return eyes(paint[tonumber(name:match "%d+")].body, now, look, lids:at(i))
    end
    local function level(drawings) return held(cut:drawing("frog", f, drawings, between)) end

    local scene = { film = { 1280, 720 }, fit = true, focus_on = 0, aperture = 5,
      camera = { x = camera.x:at(i), y = camera.y:at(i), z = camera.z:at(i) } }
    for k, plane in ipairs(planes) do scene[k] = plane end
    local down = 1.75 * dip:at(i)
    local frog, under, bug, light = level(painted), (i < 32 or i > 43) and down or 0, firefly(i)
    scene[#scene + 1] = { cel { rings(i) }, cel { leaf:translate(0, down) },
      cel { field(down, shadow(frog)) }, cel { field(under, frog) }:named "paint",
      cel { field(under, held(glow(i))), blend = is_night and "screen" or nil },
      cel { field(under, level(lined), level(gaze)) }:named "lines",
      cel { field(under, held(mouths[track:at(f.number)]), lick(i), bug) }
        :named "mouth and firefly",
      cel { field(0, light), blend = "screen" }, z = 0 }
    scene[#scene + 1] = near
    return multiplane(scene)
  end }
