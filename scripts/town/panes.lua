-- The windows of the town as they are seen from afar: two colours that stand for the room, above
-- and below, in the frame of town/window.lua. A few go out and come on again, in a wave up the
-- hill.
local csv = require "celspan.csv"
local window = require "town.window"

local panes = {}

panes.types = { x = "number", y = "number", width = "number", height = "number" }
panes.boxes = assert(csv.read("boxes.csv", { types = panes.types }))

local DARK = { "#3a474b", "#2a3539" } -- a room whose light is out

--- A pane with its two tones.
local function pane(box, above, below)
  local x, y, w, h = box.x, box.y, box.width, box.height
  local glass = box.pane == "round" and circle { x + w / 2, y + h / 2, w / 2 }
    or rect { x, y, w, h }
  return clip(rect { x, y, w, 0.64 * h, fill = above }
    | rect { x, y + 0.64 * h, w, 0.36 * h, fill = below }, glass)
end

--- The frame of a pane, from the drawing of a window of 600 units in height.
local function frame(box)
  local scale = box.height / 600
  return window.frame(box.width / scale, 600, box.pane):scale(scale):translate(box.x, box.y)
end

local lit, dark, frames = {}, {}, {}
for i, box in ipairs(panes.boxes) do
  assert(box.box:find "^[A-EKS]", box.box .. ": boxes begin with the letter of a tier, K or S")
  lit[i] = pane(box, box.above, box.below)
  dark[i] = pane(box, DARK[1], DARK[2])
  frames[i] = frame(box)
end

--- When a room goes out, in seconds; nil for those that burn all night. It is dark for 1.5 s.
local function goes_out(i, box)
  if box.height > 40 or i % 3 ~= 0 then return end
  return (0.0093 * (box.x - 380) + (850 - box.y) / 110 + 3) % 12
end

--- All panes of boxes whose name begins with a letter of `tiers`, lit.
function panes.lit(tiers)
  local shown = {}
  for i, box in ipairs(panes.boxes) do
    if tiers:find(box.box:sub(1, 1), 1, true) then
      shown[#shown + 1], shown[#shown + 2] = lit[i], frames[i]
    end
  end
  return union(shown)
end

--- The panes that are dark at a time of the loop of 12 s.
function panes.dark(time)
  local shown = {}
  for i, box in ipairs(panes.boxes) do
    local out = goes_out(i, box)
    if out and (time - out) % 12 < 1.5 then
      shown[#shown + 1], shown[#shown + 2] = dark[i], frames[i]
    end
  end
  return union(shown)
end

return panes
