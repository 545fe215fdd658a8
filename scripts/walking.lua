-- A puppet that walks in the rain: a drawing with bones, feet that do not slide, a scarf that
-- follows.

local child = puppet.person { art = svg.load "drawings/child.svg", switches = { "eye" },
  bones = { { "scarf", from = "knot", to = "fold", parent = "body" },
    { "scarf end", from = "fold", to = "fringe" },
    { "umbrella", from = "hand near", to = "tip" } } }
local gait = { stride = 128, pace = 2, bounce = 4 }

local function bob(time) return 8 + 4 * math.cos(4 * math.pi * time - 0.6) end
local tail = motion.spring(function(time) return -3 * bob(time) end, { frequency = 1.6,
  damping = 0.25 })
local fringe = motion.spring(function(time) return tail:at(time) * 2 end, { frequency = 2.2,
  damping = 0.3 })
local drops = particles { seed = "rain", rate = 260, life = 0.85, at = { 380, -40, 560, 20 },
                          velocity = { -90, 620, 6, 40 } }

--- The child after `time` seconds, in place.
local function figure(time)
  local pose = puppet.walk(child, time, gait)
  pose.scarf, pose["scarf end"] = tail:at(time) + 12, fringe:at(time) + 26
  pose.umbrella = { absolute = 8 + 2 * math.sin(4 * math.pi * time) }
  pose["upper arm near"], pose["lower arm near"] = -24, -112
  pose.eye = time % 2 > 1.84 and "shut" or "open"
  pose.under = { ["thigh near"] = "coat" }
  return child:pose(pose)
end

local sky = linear { from = { 0, 0 }, to = { 0, 380 }, { 0, "#8fa3b5" }, { 1, "#cfd8d8" } }
local street = linear { from = { 0, 380 }, to = { 0, 470 }, { 0, "#5c6672" }, { 1,
  "#3f4854" } }

--- Houses, repeated every 900 units.
local function houses(colour, lit, seed)
  local random, objects, x = celspan.random(seed), {}, 0
  while x < 900 do
    local width, height = 90 + 60 * random("width " .. x), 110 + 90 * random("height " .. x)
    objects[#objects + 1] = polygon { { x, 380 }, { x, 380 - height },
      { x + width / 2, 340 - height }, { x + width, 380 - height }, { x + width, 380 },
        fill = colour }
    for i = 0, 3 do
      objects[#objects + 1] = rect { x + width * (0.16 + 0.4 * (i % 2)),
        390 - height + 46 * (i // 2),
        width * 0.24, 30, radius = 3, fill = random(x .. " " .. i) < 0.4 and lit or "#56636f" }
    end
    x = x + width + 4
  end
  local row = union(objects)
  return union { row:translate(-900, 0), row, row:translate(900, 0) }
end
local far, near = houses("#a3b0b9", "#d9d2b0", 4), houses("#7d8b96", "#f5dc92", 9)

return film { size = { 760, 470 }, frames = 96, frame = function(f)
  local way, rain = child:walked(f.time, gait), {}
  for i, p in ipairs(drops:at(f.time)) do
    rain[i] = stroke { points = { { p.x, p.y }, { p.x + 3, p.y - 22 } }, width = 1.3,
      cap = "round",
                       fill = rgb("#eef4f6", 0.2 + 0.35 * p.size) }
  end
  local walker = figure(f.time):translate(230, 98)
  return {
    cel { rect { 0, 0, 760, 470, fill = sky },
      far:translate(-0.25 * way % 900 - 120, -14),
      near:translate(-0.6 * way % 900 - 60, 0), rect { 0, 380, 760, 90,
        fill = street } },
    walker:scale(1, -0.55, 0, 432):fade(0.22),
    walker,
    cel(rain) }
end }
