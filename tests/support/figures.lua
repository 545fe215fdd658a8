--- Made characters of twelve areas that move and turn, for tests of ink.follow.
--
--        .--.        parts from back to front: legs and an arm, the trunk and its belt, the face
--       ( oo )       with two eyes and hair, and another arm; a part hides the lines of those
--     o-[    ]-o     behind it. All turn about their joints, and the whole about its middle.
--        |  |
local celspan = require "celspan"
local prng = require "tests.support.prng"

local figures = { width = 480, height = 480, count = 12 }

local LINE = 3
local STEPS = 32

--- An ellipse about a middle, a little dented.
local function oval(random, x, y, w, h)
  local list, one, other = {}, random:between(0, 6), random:between(0.02, 0.08)
  for i = 1, STEPS do
    local a = 2 * math.pi * i / STEPS
    local r = 1 + other * math.sin(3 * a + one)
    list[i] = { x + w * r * math.cos(a), y + h * r * math.sin(a) }
  end
  return list
end

--- Parts: name, outline, joint { x, y }, swing in radians. The parts of a head or an arm share
--- their joint and their phase.
local function parts_of(random)
  local trunk, head = random:between(40, 55), random:between(34, 46)
  local leg, arm = random:between(60, 80), random:between(45, 60)
  local list = {}
  local function add(name, outline, joint, swing, phase)
    list[#list + 1] = { name = name, outline = outline, joint = joint, swing = swing,
      phase = phase }
  end
  local swing, neck = random:between(0.15, 0.35), { 0, -70 }
  local phases = { random:between(0, 6), random:between(0, 6), random:between(0, 6) }
  local left, right = { -trunk * 0.55, 55 }, { trunk * 0.55, 55 }
  local shoulder, other = { -trunk - 12, -40 }, { trunk + 12, -40 }
  add("leg_l", oval(random, left[1], left[2] + leg * 0.7, 18, leg), left, swing, phases[1])
  add("leg_r", oval(random, right[1], right[2] + leg * 0.7, 19, leg), right, -swing, phases[1])
  local x, y = shoulder[1] - 8, shoulder[2] + arm
  add("hand_l", oval(random, x, y + arm, 14, 15), shoulder, swing, phases[2])
  add("arm_l", oval(random, x, y, 15, arm), shoulder, swing, phases[2])
  add("trunk", oval(random, 0, 0, trunk, 72), { 0, 0 }, 0, 0)
  add("belt", oval(random, 0, 52, trunk * 0.95, 17), { 0, 0 }, 0, 0)
  add("face", oval(random, 0, -70 - head, head, head * 1.1), neck, swing / 2, phases[3])
  add("eye_l", oval(random, -head * 0.4, -66 - head, 8, 9), neck, swing / 2, phases[3])
  add("eye_r", oval(random, head * 0.4, -66 - head, 9, 9), neck, swing / 2, phases[3])
  add("hair", oval(random, 0, -74 - 1.8 * head, head * 1.1, head * 0.5), neck, swing / 2, phases[3])
  add("hand_r", oval(random, other[1] + 8, other[2] + 2 * arm, 15, 14), other, -swing, phases[2])
  add("arm_r", oval(random, other[1] + 8, other[2] + arm, 15, arm), other, -swing, phases[2])
  return list
end

local function turned(points, middle, angle, scale, to)
  local list, a, b = {}, scale * math.cos(angle), scale * math.sin(angle)
  for i, p in ipairs(points) do
    local x, y = p[1] - middle[1], p[2] - middle[2]
    list[i] = { a * x - b * y + to[1], b * x + a * y + to[2] }
  end
  return list
end

local function is_in(outline, x, y)
  local result, before = false, outline[#outline]
  for _, p in ipairs(outline) do
    if (p[2] > y) ~= (before[2] > y)
      and x < p[1] + (y - p[2]) / (before[2] - p[2]) * (before[1] - p[1]) then
      result = not result
    end
    before = p
  end
  return result
end

--- The part that is seen at a point; nil: none.
function figures.part_at(drawing, x, y)
  for i = #drawing.parts, 1, -1 do
    if is_in(drawing.parts[i].outline, x, y) then return drawing.parts[i].name end
  end
end

local function lines_of(parts)
  local list = {}
  for i, part in ipairs(parts) do
    local line = celspan.stroke { points = part.outline, closed = true, width = LINE,
      join = "round" }
    for k = i + 1, #parts do
      line = celspan.difference { line, celspan.polygon(parts[k].outline) }
    end
    list[i] = line
  end
  return celspan.union(list)
end

--- A point of each part that is seen, as far from all lines as can be; nil if one has none.
local function seeds_of(drawing)
  local seeds, best = {}, {}
  for y = 3, figures.height, 6 do
    for x = 3, figures.width, 6 do
      local name = figures.part_at(drawing, x, y)
      local far = math.huge
      for _, part in ipairs(name and drawing.parts or {}) do
        for _, p in ipairs(part.outline) do
          far = math.min(far, (p[1] - x) ^ 2 + (p[2] - y) ^ 2)
        end
      end
      if name and far > (best[name] or 16) then best[name], seeds[name] = far, { x, y } end
    end
  end
  for _, part in ipairs(drawing.parts) do
    if not seeds[part.name] then return nil end
  end
  return seeds
end

--- A character: drawings = a list of { object = lines, parts = { { name, outline } } }, and seeds
--- of the first by name.
function figures.make(seed, count)
  local random = prng.new(seed)
  local parts, figure = parts_of(random), { drawings = {} }
  local turn, way = random:between(0.3, 0.8), random:between(20, 60)
  local beat = random:between(10, 16)
  local phase, drift = random:between(0, 6), random:between(-3, 3)
  for k = 1, count do
    local t = 2 * math.pi * k / beat
    local drawing = { parts = {} }
    local to = { 240 + drift * (k - count / 2) + way * math.sin(t / 2 + phase),
      240 + way / 2 * math.cos(t + phase) }
    for i, part in ipairs(parts) do
      local outline = turned(part.outline, part.joint, part.swing * math.sin(t + part.phase), 1,
        part.joint)
      drawing.parts[i] = { name = part.name, outline = turned(outline, { 0, 0 },
        turn * math.sin(t / 2 + phase), 1 + 0.15 * math.sin(t / 3), to) }
    end
    drawing.object = lines_of(drawing.parts)
    figure.drawings[k] = drawing
  end
  figure.seeds = seeds_of(figure.drawings[1])
  return figure.seeds and figure or figures.make(seed + 1000, count)
end

return figures
