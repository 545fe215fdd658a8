-- A puppet that walks in the rain: a drawing with bones, feet that do not slide, a scarf that
-- follows.
local celspan = require "celspan"
local motion = require "celspan.motion"
local particles = require "celspan.particles"
local puppet = require "celspan.puppet"
local svg = require "celspan.svg"

local bones = { { "coat", from = "hip", to = "neck" }, { "head", from = "neck", to = "crown" },
  { "scarf", from = "knot", to = "fold", parent = "coat" }, { "scarf end", from = "fold",
    to = "fringe" },
  { "umbrella", from = "hand near", to = "tip" } }
for _, side in ipairs { " near", " far" } do
  for name, of in pairs { thigh = { "hip", "knee" }, shin = { "knee", "ankle", { 0, 150 } },
                          foot = { "ankle", "toe" }, upper = { "shoulder", "elbow",
                            parent = "coat" },
                          fore = { "elbow", "hand", { -150, 0 } } } do
    local from, to = of[1], of[2]
    bones[#bones + 1] = { name .. side, limits = of[3], parent = of.parent,
      from = (from == "hip" or from == "shoulder") and from or from .. side,
      to = to == "toe" and to or to .. side }
  end
end
local child = puppet { art = assert(svg.read "drawings/child.svg"), bones = bones,
  switches = { "eye" } }
local walk = puppet.steps { stride = 128, period = 1, lift = 16, ground = 316, x = 146,
  share = 0.58 }

local function bob(time) return 8 + 4 * math.cos(4 * math.pi * time - 0.6) end
local tail = motion.spring(function(time) return -3 * bob(time) end, { frequency = 1.6,
  damping = 0.25 })
local fringe = motion.spring(function(time) return tail:at(time) * 2 end, { frequency = 2.2,
  damping = 0.3 })
local drops = particles { seed = "rain", rate = 260, life = 0.85, at = { 380, -40, 560, 20 },
                          velocity = { -90, 620, 6, 40 } }

--- The child after `time` seconds, with its feet where they were set down.
local function figure(time)
  local pose = { at = { walk:body(time), bob(time) }, coat = 4,
    head = -3 + math.sin(2 * math.pi * time),
    scarf = tail:at(time) + 12, ["scarf end"] = fringe:at(time) + 26, reach = {},
    umbrella = { absolute = 8 + 2 * math.sin(4 * math.pi * time) }, ["upper near"] = -24,
    ["fore near"] = -112, eye = time % 2 > 1.84 and "shut" or "open",
    under = { ["thigh near"] = "coat" } }
  for side, phase in pairs { near = 0, far = 0.5 } do
    local x, y, air = walk:foot(time, phase)
    pose.reach["ankle " .. side] = { x, y }
    pose["foot " .. side] = { absolute = air > 0 and 34 * math.sin(2 * math.pi * air) or 0 }
  end
  pose["upper far"], pose["fore far"] = 26 * math.sin(2 * math.pi * time), -18
  return child:pose(pose)
end

local sky = celspan.linear { from = { 0, 0 }, to = { 0, 380 }, { 0, "#8fa3b5" }, { 1, "#cfd8d8" } }
local street = celspan.linear { from = { 0, 380 }, to = { 0, 470 }, { 0, "#5c6672" }, { 1,
  "#3f4854" } }

--- Houses, repeated every 900 units.
local function houses(colour, lit, seed)
  local random, objects, x = celspan.random(seed), {}, 0
  while x < 900 do
    local width, height = 90 + 60 * random("width " .. x), 110 + 90 * random("height " .. x)
    objects[#objects + 1] = celspan.polygon { { x, 380 }, { x, 380 - height },
      { x + width / 2, 340 - height }, { x + width, 380 - height }, { x + width, 380 },
        texture = colour }
    for i = 0, 3 do
      objects[#objects + 1] = celspan.rect { x + width * (0.16 + 0.4 * (i % 2)),
        390 - height + 46 * (i // 2),
        width * 0.24, 30, radius = 3, texture = random(x .. " " .. i) < 0.4 and lit or "#56636f" }
    end
    x = x + width + 4
  end
  local row = celspan.union(objects)
  return celspan.union { row:translate(-900, 0), row, row:translate(900, 0) }
end
local far, near = houses("#a3b0b9", "#d9d2b0", 4), houses("#7d8b96", "#f5dc92", 9)

return celspan.film { size = { 760, 470 }, frames = 96, frame = function(f)
  local way, rain = walk:body(f.time), {}
  for i, p in ipairs(drops:at(f.time)) do
    rain[i] = celspan.stroke { points = { { p.x, p.y }, { p.x + 3, p.y - 22 } }, width = 1.3,
      cap = "round",
                               texture = celspan.rgb("#eef4f6", 0.2 + 0.35 * p.size) }
  end
  local walker = figure(f.time):translate(230 - way, 98)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 760, 470, texture = sky },
      far:translate(-0.25 * way % 900 - 120, -14),
      near:translate(-0.6 * way % 900 - 60, 0), celspan.rect { 0, 380, 760, 90,
        texture = street } },
    celspan.cel { walker:scale(1, -0.55, 0, 432):fade(0.22) },
    celspan.cel { walker },
    celspan.cel(rain) }
end }
