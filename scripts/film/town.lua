-- The town on its hill: the painting, plane by plane, under a sky that turns from dusk to night,
-- with windows and lamps that light up.
local layers = require "celspan.layers"
local lamp = require "film.lamp"
local lens = require "film.lens"
local light = require "film.light"
local plan = require "film.plan"
local shapes = require "demo.shapes"

local town = {}

local tree = assert(layers.read "town.ora")
local FINE = plan.WIDTH / tree.width

--- Depths of the planes: those of the painting, and those that the film adds.
town.depths = { sky = 5200, clouds = 4200, peaks = 3000, wood = 1900, town = 900, near = 0 }

local painted = {}
for _, name in ipairs { "clouds", "peaks", "wood", "town", "near" } do
  painted[name] = tree:cels { only = { name } }[1]:scale(FINE):translate(plan.LEFT, plan.TOP)
end

-- ---------------------------------------------------------------- the sky

local function turning(dusk, night)
  return keys { { 0, mix(dusk, dusk, 0) }, { 6, mix(dusk, night, 0.25) },
    { 19.9, mix(dusk, night, 0.85) }, { 26, mix(night, night, 0), "inOutSine" } }
end

local air = { { 0, turning("#0f1547", "#060820") }, { 0.3, turning("#262c74", "#0b0f33") },
  { 0.55, turning("#514c9c", "#161a4c") }, { 0.75, turning("#8d78b8", "#272a68") },
  { 0.88, turning("#d29cb4", "#3f3c80") }, { 1, turning("#f2bd9e", "#4d4890") } }

local function sky(time)
  local texture = { from = { 0, -560 }, to = { 0, 660 } }
  for i, stop in ipairs(air) do texture[i] = { stop[1], stop[2]:at(time) } end
  return rect { plan.LEFT - 200, plan.TOP, plan.WIDTH + 400, 1500,
    fill = linear(texture) }
end

local strewn = {}
do
  local random = celspan.random "stars of the town"
  for i = 1, 150 do
    strewn[i] = { x = plan.LEFT + plan.WIDTH * random("x" .. i),
      y = -540 + 900 * random("y" .. i) ^ 1.3,
      r = 1 + 1.7 * random("r" .. i) ^ 3, from = 3 + 20 * random("t" .. i),
        phase = 6 * random("p" .. i) }
  end
end

--- Stars come out one by one during the evening, and twinkle.
local function stars(time)
  local parts = {}
  for _, s in ipairs(strewn) do
    local out = motion.span(time, s.from, 2)
    if out > 0 then
      local twinkle = 0.75 + 0.25 * math.sin(time * 3 + s.phase)
      parts[#parts + 1] = circle { s.x, s.y, s.r,
        fill = rgb("#f6efff", out * twinkle) }
    end
  end
  return union(parts)
end

-- ---------------------------------------------------------------- windows and lamps

local SOURCE = { 1236, 880 }

--- The house whose light goes out last.
local keeper

do
  local best
  for i, home in ipairs(plan.houses) do
    local off = math.abs(home.x - 1130) + math.abs(home.y - 640)
    if i > 1 and (not best or off < best) then keeper, best = home, off end
  end
end
town.keeper = keeper

for i, home in ipairs(plan.houses) do
  local random = celspan.random("light" .. i)
  local dx, dy = home.x - SOURCE[1], (home.y - SOURCE[2]) * 1.6
  home.delay = math.sqrt(dx * dx + dy * dy) / 330 + 0.5 * random "delay"
  home.sleep = 2.1 * random "sleep"
  home.hue = random "hue"
end

--- The brightness of a house: it lights up suddenly, `delay` after `from`, and goes dark for the
--- night.
local function level_of(home, time, from, sleep)
  local age = time - from - home.delay
  if age <= 0 then return 0 end
  local level = math.min(1, age / 0.12) * (1 + 0.5 * math.exp(-age * 5) * math.cos(age * 26))
  if home ~= keeper then level = level * (1 - math.max(0,
    math.min(1, (time - sleep - home.sleep) / 0.35))) end
  return level * (0.95 + 0.05 * math.sin(time * 8 + home.hue * 20))
end

--- The lit panes and the glow about them: two objects.
local function windows(time, from, sleep)
  local panes, glows = {}, {}
  for _, home in ipairs(plan.houses) do
    local level = level_of(home, time, from, sleep)
    if level > 0.01 then
      local colour = mix("#ffb54d", "#ffdc8f", home.hue)
      for _, pane in ipairs(home.panes) do
        panes[#panes + 1] = pane:with { fill = colour }:fade(math.min(1, level))
      end
      glows[#glows + 1] = shapes.glow(home.x, home.y + home.width * 0.1, home.width * 1.25, 1, 0.5,
        0.16, 0.036 * level)
    end
  end
  return union(panes), union(glows)
end

--- The brightness of lamp i of the plan; the first is the one of the story.
local function lamp_level(i, time, from)
  if i == 1 then return time < from - 1 and 0 or 1 end
  local at = plan.lamps[i]
  local age = time - from - math.abs(at[1] - SOURCE[1]) / 420 - 0.2
  return motion.span(age, 0, 0.25)
end

local function lamps(time, from, ambient)
  local posts, lit, glows = {}, {}, {}
  for i, at in ipairs(plan.lamps) do
    local x, y = at[1], at[2] - 590 * at[3]
    local level = lamp_level(i, time, from) * light.flicker(time + i)
    local function put(object) return lamp.place(object, x, y, at[3]) end
    posts[#posts + 1] = put(union { lamp.post, lamp.frame })
    lit[#lit + 1] = put((lamp.glass(level, ambient)))
    if level > 0 then
      glows[#glows + 1] = shapes.glow(x, y, 900 * at[3], 1, 0.52, 0.17, 0.06 * level)
      glows[#glows + 1] = shapes.glow(0, 0, 820 * at[3], 1, 0.52, 0.17, 0.034 * level):scale(1,
        0.26):translate(x, at[2])
    end
  end
  return union(posts), union(lit), union(glows)
end

-- ---------------------------------------------------------------- the set

--- The rostrum at a time: at `windows` and `sleep` the town lights up and goes dark, `camera` is
--- that of the multiplane; `added` is a cel on the plane of the town, `snow` its three curtains,
--- and `over` lies over everything.
function town.shoot(time, fields)
  local near, depths = light.at("near", time), town.depths
  local set = lens.stack(fields.camera, { over = fields.over })
  local function painting(name, distance)
    set:add(depths[name], painted[name]:with { front = light.at(distance, time) }:named(name))
  end
  set:plane("sky", depths.sky, light.dusk.sky, sky(time), stars(time))
  painting("clouds", "far")
  painting("peaks", "far")
  painting("wood", "far")
  painting("town", "middle")
  local panes, halos = windows(time, fields.windows, fields.sleep)
  local posts, glasses, glows = lamps(time, fields.windows, near)
  set:plane("windows", depths.town, { 1.5, 1.3, 1 }, panes)
  set:plane("glows", depths.town, { 9, 9, 9 }, halos, glows)
  set:add(depths.town, fields.added)
  set:plane("posts", depths.town, near, posts)
  set:plane("glasses", depths.town, { 1.4, 1.3, 1.1 }, glasses)
  set:plane("far snow", 2400, light.at("far", time), fields.snow.far(time, 0, 0))
  set:plane("snow", 400, light.at("middle", time), fields.snow.middle(time, 0, 0))
  painting("near", "near")
  set:plane("near snow", -300, near, fields.snow.near(time, 0, 0))
  return set:shoot()
end

return town
