-- The village: houses for the first exposure, and for the second a black card with the windows cut
-- out and coloured gels behind the cuts, lit from the back as on a real rostrum.
local palette = require "demo.palette"
local shapes = require "demo.shapes"

local village = {}

--- {x, ground, width, height of the wall, windows}; the gable is as wide as the wall.
local houses = {
  { 236, 690, 70, 62, 2 }, { 322, 682, 92, 74, 3 }, { 520, 684, 84, 66, 2 },
  { 622, 694, 66, 84, 2 }, { 702, 706, 78, 60, 2 }, { 286, 716, 84, 56, 2 },
  { 470, 722, 100, 60, 3 }, { 596, 730, 82, 60, 2 },
}

--- The painted houses; the windows, and the house of each; the middle and radius of each house's
--- glow.
local art, panes, homes, glows = {}, {}, {}, {}

local function rect(x, y, w, h, texture)
  return celspan.rect { x, y, w, h, fill = texture }
end

local function window(x, y, w, h)
  homes[#homes + 1] = #glows
  panes[#panes + 1] = path { fill = palette.pane,
    d = ("M%g %gv%ga%g %g 0 0 1 %g 0v%gz"):format(x, y + h, w / 2 - h, w / 2, w / 2, w, h - w / 2) }
end

local function house(i, x, y, w, h, windows)
  local wall = palette.walls[i % #palette.walls + 1]
  local roof = palette.roofs[i % #palette.roofs + 1]
  local lit = shapes.across(x, x + w, { wall, palette.wall_shade })
  art[#art + 1] = rect(x + w * 0.68, y - h - w * 0.62, w * 0.12, w * 0.4, palette.roofs[2])
  art[#art + 1] = rect(x, y - h, w, h + 10, lit)
  art[#art + 1] = polygon { { x - w * 0.1, y - h + 3 }, { x + w * 0.5, y - h - w * 0.52 },
                            { x + w * 1.1, y - h + 3 }, fill = roof }
  glows[#glows + 1] = { x + w / 2, y - h * 0.5, w * 0.78 }
  local step = w / windows
  for k = 1, windows do window(x + (k - 0.5) * step - 7, y - h * 0.68, 14, 24) end
end

local function church(x, y)
  local lit = shapes.across(x, x + 52, { palette.walls[1], palette.wall_shade })
  art[#art + 1] = rect(x, y - 150, 52, 160, lit)
  art[#art + 1] = polygon { { x - 7, y - 148 }, { x + 26, y - 262 }, { x + 59, y - 148 },
                            fill = palette.roofs[2] }
  glows[#glows + 1] = { x + 26, y - 98, 80 }
  window(x + 18, y - 132, 16, 36)
  window(x + 18, y - 70, 16, 30)
end

church(434, 682)
for i, h in ipairs(houses) do house(i, table.unpack(h)) end

village.houses = union(art)
village.panes = union(panes)

local card = celspan.rect { -200, 0, 2600, 1080 } - village.panes

local brighten = ease "outQuad"

--- The brightness of window i: they light up one after another from `cue` on, and flicker.
local function level_of(i, time, cue)
  local u = (time - cue - (i * 5 % #panes) * 0.11) / 0.35
  return brighten(math.max(0, math.min(1, u))) * (0.94 + 0.06 * math.sin(time * 9 + i * 2))
end

--- The light box: gels on their light, the black card over them, and the glow in the air in front.
function village.light_box(time, cue, viewport)
  local gels, halos, levels = {}, {}, {}
  for i, pane in ipairs(panes) do
    local level, home = level_of(i, time, cue), homes[i]
    local r, g, b = table.unpack(palette.gels[i % #palette.gels + 1])
    gels[i] = pane:with { fill = gel(r * level, g * level, b * level) }
    levels[home] = math.max(levels[home] or 0, level)
  end
  for home, at in ipairs(glows) do
    if levels[home] > 0 then
      halos[#halos + 1] = shapes.glow(at[1], at[2], at[3], 1, 0.5, 0.16, 0.075 * levels[home])
    end
  end
  return cel { union(gels), back = { 1.5, 1.5, 1.5 }, viewport = viewport },
    cel { card, front = { 0, 0, 0 }, viewport = viewport },
    cel { union(halos), front = { 7, 7, 7 }, viewport = viewport }
end

return village
