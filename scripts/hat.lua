-- A hat, drawn once for the first frame, that stays on a moving head. The track was made by
-- `celspan track` from pictures of the head (see scripts/hat/head.lua).
local track = require "celspan.track"
local head = require "hat.head"

local t = assert(track.read "hat/track.json")

local felt = linear { from = { -80, 0 }, to = { 90, 0 }, { 0, "#c0392f" },
  { 1, "#6f1d22" } }

--- The hat on the head of frame 1, drawn about the middle of that head.
local hat = union {
  path { fill = felt, d = "M-80 -62C-84 -150 -50 -190 0 -170C50 -190 84 -150 80 -62Z" },
  path { fill = "#f0c987",
    d = "M-82 -84C-30 -62 30 -62 82 -84L81 -60C30 -40 -30 -40 -81 -60Z" },
  path { fill = felt,
    d = "M-140 -66C-70 -36 70 -36 140 -66C130 -36 70 -18 0 -18S-130 -36 -140 -66Z" },
  stroke { points = { { 66, -76 }, { 96, -130 }, { 88, -196 } }, width = 17, degree = 2,
    cap = "round",
    taper = { 4, 60 }, fill = "#2f7f72" },
}
local worn = cel { head.pose(hat, 0) }:named "hat"

return film { title = "A hat that stays on", size = head.size, frames = head.frames,
  fps = head.fps, frame = function(f)
    local cels = head.cels(f.index)
    cels[#cels + 1] = t:place(worn, f)
    return rostrum(cels)
  end }
