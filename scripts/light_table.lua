-- An animator's light table: six sheets of paper on a peg bar, lit from below. Paper scatters a
-- little and lets the rest through, so older drawings fade beneath the newest, sheet by sheet.
local shapes = require "demo.shapes"

local paper = paint { pigment = { 0.95, 0.92, 0.86 }, medium = { 0.98, 0.93, 0.84 },
                      beta = 0.3 }
local graphite, blue = "#33303a", "#6f9bd2"

local pegs = union {
  circle { 960, 972, 17 },
  rect { 636, 960, 66, 24, radius = 12 }, rect { 1218, 960, 66, 24, radius = 12 },
}
local sheet = rect { 300, 110, 1320, 920, radius = 10, fill = paper } - pegs

--- A shape in one colour.
local function flood(colour, shape)
  return clip(rect { 0, 0, 1920, 1080, fill = colour }, shape)
end

--- The field guide printed on every sheet.
local function fields()
  local parts = {}
  for i = 0, 3 do
    local w, h = 1180 - i * 236, 700 - i * 140
    parts[#parts + 1] = rect { 960 - w / 2, 540 - h / 2, w, h }
    parts[#parts + 1] = rect { 962 - w / 2, 542 - h / 2, w - 4, h - 4 }
  end
  return flood(blue, xor(parts)):fade(0.16)
end

local guide = fields()

--- A ball in pencil: an outline of two discs, a shadow of hatching, stretched along its path.
local function ball(x, y, stretch, turn)
  local body = circle { 0, 0, 78, fill = "#f3cf72" }
  local inner = circle { 0, 0, 72 }
  local hatch = {}
  for i = 0, 7 do
    hatch[i + 1] = shapes.ribbon({ { -70 + i * 22, 84, 2 }, { 10 + i * 14, 40 - i * 4, 5 },
                                   { 84 + i * 4, -30 - i * 10, 2 } }, graphite)
  end
  return union {
    body:fade(0.55), clip(union(hatch), inner - inner:translate(-26, -22)),
    clip(rect { -99, -99, 198, 198, fill = graphite }, body - inner),
  }:rotate(-turn):scale(stretch, 1 / stretch):rotate(turn):translate(x, y)
end

--- Drawing n: two hops, the second lower; flat on the ground, stretched in the air.
local function drawing(n)
  local u = n % 16 / 15
  local hop = u < 0.55 and u / 0.55 or (u - 0.55) / 0.45
  local tall = u < 0.55 and 430 or 260
  local lands = hop < 0.02 or hop > 0.98
  local turn = math.deg(math.atan(-tall * 4 * (1 - 2 * hop), 620))
  local fast = math.abs(1 - 2 * hop)
  local x, y = 480 + 960 * u, 768 - tall * 4 * hop * (1 - hop) + (lands and 16 or 0)
  local stretch = lands and 1.28 or 1 + 0.22 * fast ^ 3
  return cel { sheet, guide, ball(x, y, stretch, lands and 0 or turn) }
end

local wood = shapes.down(0, 1080, { "#5d4331", "#38271e" })
local table_top = rect { 0, 0, 1920, 1080, fill = wood }
  - rect { 210, 60, 1500, 1000, radius = 30 }
local pegs_up = flood("#2c2d33", pegs)
local bar = rect { 560, 946, 800, 52, radius = 26, fill = "#8e9299" }

return film { frames = 48, frame = function(f)
  local newest = f:on(3) // 3 + 6
  local cels = { cel { bar, pegs_up, back = { 1.25, 1.16, 1.0 } } }
  for n = newest - 5, newest do cels[#cels + 1] = drawing(n) end
  cels[#cels + 1] = cel { table_top }
  return rostrum(cels)
end }
