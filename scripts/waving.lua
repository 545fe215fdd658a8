-- A drawing that waves: an owl from an SVG file whose parts turn about their joints.

local owl = assert(svg.read "drawings/owl.svg")

-- It crouches, swings the wing up past its final position, waves, and lets it fall past its rest
-- position. The head follows a little later than the wing, and the eyes move first.
local wing = keys { { 0, 0 }, { 0.2, -14, "outSine" }, { 0.55, 122, "outBack" },
  { 0.75, 88, "inOutSine" },
                    { 0.95, 116, "inOutSine" }, { 1.15, 88, "inOutSine" },
                    { 1.35, 116, "inOutSine" },
                    { 1.75, -9, "inOutQuad" }, { 1.96, 0, "inOutSine" } }
local tilt = keys { { 0.05, 0 }, { 0.25, 3, "outSine" }, { 0.65, -8, "inOutSine" }, { 1.45, -8 },
                    { 1.8, 2, "inOutSine" }, { 1.96, 0, "inOutSine" } }
local glance = keys { { 0, 0 }, { 0.15, -8, "outQuad" }, { 1.4, -8 }, { 1.6, 0, "inOutQuad" } }
local height = keys { { 0, 1 }, { 0.2, 0.955, "outSine" }, { 0.5, 1.035, "inOutQuad" },
  { 0.8, 1, "inOutSine" },
                      { 1.5, 1 }, { 1.75, 0.97, "inQuad" }, { 1.96, 1, "outBack" } }

local night = cel {
  rect { 0, 0, 640, 400,
    fill = linear { from = { 0, 0 }, to = { 0, 400 }, { 0, "#16203f" },
    { 1, "#4a5d8f" } } },
  circle { 520, 90, 46, fill = "#f6ecc9" },
  path { d = "M0 356 C180 340 420 372 640 350 V386 C430 396 200 372 0 388 Z",
    fill = "#3a2a22" } }

return film { size = { 640, 400 }, frames = 48, frame = function(f)
  local tall = height:at(f.time)
  local sunk = 160 * (1 - tall) -- of the shoulders, which are 160 above the feet
  local look = function(pupil) return pupil:translate(glance:at(f.time), 0) end
  local art = owl:with {
    body = function(body) return body:scale(2 - tall, tall, 160, 330) end,
    ["left wing"] = function(arm)
      return arm:rotate(wing:at(f.time), 90, 172):translate(0, sunk)
    end,
    ["right wing"] = function(arm)
      return arm:rotate(-0.12 * wing:at(f.time), 230, 172):translate(0, sunk)
    end,
    head = function(head) return head:rotate(tilt:at(f.time), 160, 170):translate(0, sunk) end,
    ["left-pupil"] = look, ["right-pupil"] = look }
  return { night, art.object:translate(150, 12) }
end }
