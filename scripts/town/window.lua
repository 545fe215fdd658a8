-- A window of the town: a loop of 12 drawings a second, and the wood and snow around its glass.
--
--   return window.film { title = "The kettle", by = "mk", seconds = 2, drawing = function(share)
--     return { rect { 0, 0, 450, 600, fill = "#33180f" }, kettle(share) }
--   end }
local moods = require "stage.moods"

local window = {}

local WOOD, LIT, SNOW, SHADE = "#231a17", "#3b2c25", "#dde8ee", "#9db6c8"

--- Snow that lies from x to x + w, h high in its middle, its foot at y; it hangs over a little.
local function snow(x, y, w, h)
  local function bank(top, fill)
    return path { fill = fill, d = ("M%g %g C%g %g %g %g %g %g S%g %g %g %g Z"):format(x, y,
      x + 0.04 * w, y - 1.1 * top, x + 0.3 * w, y - 0.9 * top, x + 0.45 * w, y - top,
      x + 0.94 * w, y - 1.2 * top, x + w, y) }
  end
  return bank(h, SHADE) | bank(0.8 * h, SNOW)
end

--- Bars of the glass of a frame w by h: { x, y, width, height } each.
local bars = {
  plain = function() return {} end,
  transom = function(w, h, b) return { { 0, 0.2 * h, w, b }, { (w - b) / 2, 0, b, 0.2 * h } } end,
  shop = function(w, h, b) return { { 0, 0.14 * h, w, b }, { w / 3, 0, b, 0.14 * h },
    { 2 * w / 3, 0, b, 0.14 * h } } end,
}

--- The wood of a window, w by h, and the snow on its sill. Kinds of panes: "plain",
--- "transom" (bars above alone), "shop" (a wide one), and "round".
function window.frame(w, h, kind)
  local edge = 0.028 * math.max(w, h)
  local parts = {}
  if kind == "round" then
    local radius = math.min(w, h) / 2
    local glass = circle { w / 2, h / 2, radius - 1.3 * edge }
    parts[1] = circle { w / 2, h / 2, radius, fill = WOOD } - glass
    parts[2] = circle { w / 2, h / 2, radius - edge, fill = LIT } - glass
  else
    for _, bar in ipairs(bars[kind](w, h, 0.4 * edge)) do
      parts[#parts + 1] = rect { bar[1], bar[2], bar[3], bar[4], fill = WOOD }
    end
    local hole = rect { edge, edge, w - 2 * edge, h - 2 * edge }
    parts[#parts + 1] = (rect { 0, 0, w, h } - hole):paint(WOOD)
    parts[#parts + 1] = rect { edge, h - 1.3 * edge, w - 2 * edge, 0.3 * edge, fill = LIT }
  end
  local inset = kind == "round" and 0.24 * w or 0
  parts[#parts + 1] = snow(inset, h, w - 2 * inset, 1.7 * edge)
  return union(parts)
end

--- Who drew it: two letters in the snow of the sill, for who comes near.
local function signature(by, w, h)
  local size = w / 60
  return text { by, at = { 0.7 * w, h - 0.35 * size }, size = size, font = window.font,
    fill = moods.snow.ink }
end

window.font = "../type/poster.ttf"

--- Stops where a field is not what window.film takes.
local function check(fields, kind)
  assert(type(fields.by) == "string", "window: 'by' must be the letters of who drew it")
  assert(({ [2] = 1, [4] = 1, [8] = 1 })[fields.seconds], "window: 'seconds' must be 2, 4 or 8")
  assert(kind == "round" or bars[kind], "window: 'pane' must be plain, transom, shop or round")
  assert(type(fields.drawing) == "function", "window: 'drawing' must be a function")
end

--- The film of a window. title; by: who drew it; seconds: 2, 4 or 8; size: 450 by 600 if not given;
--- pane: the kind of window.frame; drawing: a function of the share of the loop that has gone, 0 to
--- 1, and of the number of the drawing, from 0, which gives a list of objects, the first of which
--- fills the frame.
function window.film(fields)
  local w, h = table.unpack(fields.size or { 450, 600 })
  local kind = fields.pane or "transom"
  check(fields, kind)
  local is_round = kind == "round" -- around the glass one sees the wall
  local over = window.frame(w, h, kind) | signature(fields.by, w, h)
  local glass = circle { w / 2, h / 2, math.min(w, h) / 2 }
  return film { title = fields.title, size = { w, h }, fps = 12, duration = fields.seconds,
    background = not is_round and WOOD or nil,
    frame = function(f)
      local shown = union(fields.drawing(f.index / f.count, f.index))
      return cel { is_round and clip(shown, glass) or shown, over }
    end }
end

return window
