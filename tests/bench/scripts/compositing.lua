-- Scenes that are composited, 1920 x 1080: the same drawing flat, in an isolated group, with a
-- blend mode, in soft mattes and in "srgb"; a soft shadow; and 60 groups, which skia_groups.js
-- draws with the same numbers. The argument is the scene's name.
local celspan = require "celspan"

local W, H = 1920, 1080
local name = ...

--- Numbers from 0 to 1, the same in every language.
local function numbers(seed)
  local state = seed
  return function()
    state = state * 16807 % 2147483647
    return state / 2147483647
  end
end

-- ---------------------------------------------------------------- one drawing

local function drawing(count, next)
  local list = {}
  for i = 1, count do
    local x, y, s = W * next(), H * next(), 20 + 90 * next()
    local texture = celspan.rgb(next(), next(), next(), 1)
    list[i] = i % 2 == 0 and celspan.circle { centre = { x, y }, radius = s, texture = texture }
      or celspan.polygon { { x, y - s }, { x + s, y + s / 2 }, { x - s / 2, y + s },
                           texture = texture }
  end
  return celspan.union(list)
end

local function gradient()
  return celspan.rect { 0, 0, W, H, texture = celspan.linear { from = { 0, 0 }, to = { W, 0 },
                                                               { 0, "#fff0" }, { 1, "#fff" } } }
end

local function soft_circle()
  return celspan.circle { centre = { W / 2, H / 2 }, radius = H / 2,
    texture = celspan.radial { centre = { W / 2, H / 2 }, radius = H / 2, { 0, "#fff" },
                               { 0.8, "#fff" }, { 1, "#fff0" } } }
end

local function disc()
  return celspan.circle { centre = { W / 2, H / 2 }, radius = 300, texture = "#e4572e" }
end

local pieces = {
  flat = function(art) return art end,
  group = function(art) return celspan.group { art, opacity = 0.5 } end,
  multiply = function(art) return art:blend "multiply" end,
  ["under gradient"] = function(art) return celspan.union { art, gradient() } end,
  ["under circle"] = function(art) return celspan.union { art, soft_circle() } end,
  ["matte gradient"] = function(art) return celspan.matte(art, gradient()) end,
  ["matte circle"] = function(art) return celspan.matte(art, soft_circle()) end,
  srgb = function(art) return art end,
  disc = function() return disc() end,
  shadow = function()
    return disc():shadow { offset = { 9, 9 }, blur = 16, opacity = 0.6 }
  end,
}

-- ---------------------------------------------------------------- sixty groups

local modes = { "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
  "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue", "saturation",
  "color", "luminosity" }

--- Twelve translucent squares and circles within 160 of the origin.
local function members(next)
  local list = {}
  for i = 1, 12 do
    local x, y, s = 220 * next() - 110, 220 * next() - 110, 15 + 35 * next()
    local texture = celspan.rgb(("#%02x%02x%02x"):format(math.floor(256 * next()),
      math.floor(256 * next()), math.floor(256 * next())), 0.4 + 0.6 * next())
    list[i] = i % 2 == 0 and celspan.circle { centre = { x, y }, radius = s, texture = texture }
      or celspan.rect { x - s, y - s, 2 * s, 2 * s, texture = texture }
  end
  return list
end

--- Every mode in turn; each third group is blurred. They turn and move, so that no frame is the
--- one before.
local function groups(frame)
  local list, next = {}, numbers(28)
  for i = 1, 60 do
    local x, y, turn, opacity = W * next(), H * next(), 360 * next(), 0.5 + 0.5 * next()
    local group = members(next)
    group.opacity = opacity
    group = celspan.group(group)
    if i % 3 == 0 then group = group:blur(4 + 20 * next()) end
    group = group:rotate(turn + frame * 1.5):translate(x + frame * 0.7, y)
    list[i] = group:blend(modes[i % #modes + 1])
  end
  return list
end

local function cel(frame)
  if name == "groups" then return celspan.cel(groups(frame)) end
  local next = numbers(1)
  local back, art = drawing(60, next), drawing(200, next)
  return celspan.cel { back:translate(frame * 0.37, 0),
                       pieces[name](art):translate(frame * 0.71, 0) }
end

return celspan.film { size = { W, H }, frames = 40,
  space = (name == "groups" or name == "srgb") and "srgb" or nil,
  frame = function(f) return celspan.rostrum { back = "#345", cel(f.index) } end }
