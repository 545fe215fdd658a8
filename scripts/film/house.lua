-- Houses with snow on them, a little crooked: for the street, and small ones for the painted town.
local shapes = require "demo.shapes"

local house = {}

local SNOW, SHADE = "#e4e8fc", "#9aa4dc"

--- A window: its frame, its pane and the snow on its sill; the pane is kept so it can be lit.
local function window(parts, panes, x, y, w, h, frame)
  local arch = ("M%g %gv%ga%g %g 0 0 1 %g 0v%gz")
  local function opening(grow, texture)
    local gw, gh = w + 2 * grow, h + 2 * grow
    return path { fill = texture, d = arch:format(x - grow, y + h + grow, gw / 2 - gh,
      gw / 2, gw / 2, gw, gh - gw / 2) }
  end
  local pane = opening(0, shapes.down(y, y + h, { "#39437f", "#252c62" }))
  parts[#parts + 1] = opening(w * 0.12, frame)
  parts[#parts + 1] = pane
  parts[#parts + 1] = rect { x + w * 0.46, y, w * 0.08, h, fill = frame }
  parts[#parts + 1] = rect { x, y + h * 0.52, w, w * 0.08, fill = frame }
  parts[#parts + 1] = rect { x - w * 0.2, y + h, w * 1.4, w * 0.2, radius = w * 0.1,
    fill = SNOW }
  panes[#panes + 1] = pane
end

--- Snow on a roof: a thick line from eave to eave over the ridge, thicker in places.
local function roof_snow(parts, x, y, w, rise, random)
  local deep, points = w * 0.1, {}
  for i = 0, 8 do
    local u = i / 8
    local edge = 1 - math.abs(2 * u - 1)
    points[#points + 1] = { x - 0.1 * w + 1.2 * w * u, y - rise * edge - deep * 0.3,
      deep * (0.8 + 0.5 * random("snow" .. i)) }
  end
  parts[#parts + 1] = stroke { points = points, degree = 2, cap = "round", fill = SHADE }
    :translate(0, deep * 0.3)
  parts[#parts + 1] = stroke { points = points, degree = 2, cap = "round", fill = SNOW }
end

local function chimney(parts, x, y, w, colour)
  parts[#parts + 1] = rect { x, y - w * 1.7, w, w * 2.4, fill = colour }
  parts[#parts + 1] = rect { x - w * 0.16, y - w * 1.95, w * 1.32, w * 0.5,
    radius = w * 0.25,
    fill = SNOW }
end

--- Brush marks across a wall, cut to it, so that it looks painted.
local function brushed(wall, x, y, w, h, random)
  local marks = {}
  for i = 1, 9 do
    local mx, my = x + w * (random("mx" .. i) * 0.9), y - h * (0.06 + 0.9 * random("my" .. i))
    local bright = random("mb" .. i) < 0.5
    marks[i] = stroke { width = w * (0.03 + 0.04 * random("mw" .. i)),
      taper = { w * 0.1, w * 0.2 },
      points = { { mx, my }, { mx + w * (0.16 + 0.2 * random("ml" .. i)), my + h * 0.015 } },
      fill = rgb(bright and "#c9c4f2" or "#1c1f52", 0.13) }
  end
  return clip(union(marks), wall)
end

--- A house whose wall stands on (x, y), w wide and h high, its gable `rise` higher; `rows` of
--- windows are lists of positions 0..1 along the wall. Returns its object, and its panes.
function house.draw(seed, x, y, w, h, fields)
  local random = celspan.random(seed)
  local parts, panes = {}, {}
  local rise = fields.rise or w * 0.5
  local wall = polygon { { x, y + 4 }, { x, y - h }, { x + w / 2, y - h - rise },
    { x + w, y - h },
    { x + w, y + 4 }, fill = linear { from = { x, y - h - rise },
      to = { x + w * 0.4, y },
      { 0, fields.wall[1] }, { 1, fields.wall[2] } } }
  if fields.chimney then
    chimney(parts, x + w * fields.chimney, y - h - rise * 0.62, w * 0.13, fields.wall[2])
  end
  parts[#parts + 1] = wall
  parts[#parts + 1] = brushed(wall, x, y, w, h + rise * 0.6, random)
  local ww = w * (fields.window or 0.15)
  for _, row in ipairs(fields.rows) do
    for _, place in ipairs(row) do
      window(parts, panes, x + w * place - ww / 2, y - h * row.at, ww, ww * 1.55,
        fields.frame or "#2b2a5c")
    end
  end
  if fields.door then
    local dx, dw = x + w * fields.door, w * 0.2
    parts[#parts + 1] = path { fill = shapes.down(y - dw * 1.7, y,
      { "#6a4a72", "#43305c" }),
      d = ("M%g %gv%ga%g %g 0 0 1 %g 0v%gz"):format(dx, y + 4, -dw * 1.2, dw / 2, dw / 2, dw,
        dw * 1.2) }
  end
  roof_snow(parts, x, y - h, w, rise, random)
  local lean = fields.lean or 0
  local function place(object) return object:skew(lean, 0, x, y) end
  for i, pane in ipairs(panes) do panes[i] = place(pane) end
  return place(union(parts)), panes
end

return house
