--- The exposures of a painting of Krita: which drawing each animated layer shows at each frame.
--
-- Layers are named by their paths, "group/layer", and drawings as in layers.read: "1", "2", ... in
-- the order in which they are first shown. A layer that does not move shows "1" throughout.
local columns = require "celspan.columns"
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"

local sheet_krita = {}

--- The first frame, as Krita counts, of a painting that native.painting read; it is frame 1 here.
function sheet_krita.start(painting) return painting.from or 0 end

--- The columns of the layers that move, by the places of these layers.
function sheet_krita.exposures(painting)
  local found, start = {}, sheet_krita.start(painting)
  for _, key in ipairs(painting.keys) do
    local layer = painting.layers[key.layer]
    if key.drawing then
      local column = found[key.layer] or columns.new(layer.path)
      found[key.layer] = column
      columns.add(column, math.max(1, key.frame - start + 1), painting.layers[key.drawing].name)
    end
  end
  return found
end

--- The keys of opacities by the places of their layers: { frame (as the sheet counts), ... }.
function sheet_krita.opacities(painting)
  local found, start = {}, sheet_krita.start(painting)
  for _, key in ipairs(painting.keys) do
    if key.opacity then
      local list = found[key.layer] or {}
      found[key.layer], list[#list + 1], key.at = list, key, key.frame - start + 1
    end
  end
  return found
end

--- A handle from a key, no longer than the time to the next key in either direction.
local function handle_within(handle, time)
  local x, y = math.abs(handle[1]), handle[2]
  if handle[1] * time <= 0 then return 0, 0 end
  local share = math.min(1, math.abs(time) / x)
  return share * x / math.abs(time), share * y
end

--- The curve of Krita from one key to the next, at a share of the time between.
local function along(key, following, u)
  local time, change = following.at - key.at, following.opacity - key.opacity
  local x1, y1 = handle_within(key.out, time)
  local x2, y2 = handle_within(following["in"], -time)
  local function curve(a, b)
    return ease(("bezier:%.17g,%.17g,%.17g,%.17g"):format(x1, a, 1 - x2, b))(u)
  end
  -- an ease ends at 1, the change does not
  return key.opacity + curve(y1, change + y2) + (change - 1) * curve(0, 0)
end

--- The opacity that a list of keys gives to a frame, 0..1.
function sheet_krita.opacity(list, frame)
  local place = ordered.last(list, frame, "at")
  local key, following = list[math.max(1, place)], list[place + 1]
  if place == 0 or not following or key.between == "constant" then return key.opacity end
  local u = (frame - key.at) / (following.at - key.at)
  local value = key.between == "linear" and key.opacity + u * (following.opacity - key.opacity)
    or along(key, following, u)
  return math.min(1, math.max(0, value))
end

--- Raises { message = }.
function sheet_krita.decode(painting)
  local list, moving = {}, sheet_krita.exposures(painting)
  for i, layer in ipairs(painting.layers) do
    local is_drawing = layer.parent and moving[layer.parent]
    if moving[i] or not layer.group and not is_drawing then
      local column = moving[i] or columns.new(layer.path)
      if not moving[i] then columns.add(column, 1, "1") end
      column.look = { opacity = layer.opacity, blend = layer.blend, visible = layer.visible }
      list[#list + 1] = column
    end
  end
  local frames = painting.fps and painting.to - painting.from + 1 or 1
  return { name = "", layers = list, notes = {}, fps = painting.fps or 24, width = painting.width,
           height = painting.height, frames = columns.length(frames, list, {}) }
end

return fields.seal("sheet_krita", sheet_krita)
