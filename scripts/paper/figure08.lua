-- Figure 8: the light that goes back to front through the cels to the camera. Each cel scatters its
-- own front light and filters the light from behind; its own back light is added before. Every
-- light in the drawing is computed by celspan.probe for the stack up to that cel.
local diagram = require "diagram"

--- Rearmost first: the paint, its front light and the back light behind it.
local cels = {
  { paint = paint { pigment = "#2c7a86", beta = 1 },
    front = { 0.9, 0.75, 0.5 }, back = { 0, 0, 0 } },
  { paint = paint { pigment = "#e8b04a", medium = { 1, 0.75, 0.35 }, beta = 0.35 },
    front = { 0.55, 0.6, 0.8 }, back = { 0.35, 0.1, 0.1 } },
  { paint = paint { pigment = "#b8324a", medium = { 0.95, 0.5, 0.75 }, beta = 0.3 },
    front = { 0.9, 0.85, 0.8 }, back = { 0, 0.06, 0.22 } },
}

--- The light that leaves the first `count` cels, optionally plus the back light of the next cel.
local function light(count, with_next)
  local stack = {}
  for i = 1, count do
    local cel = cels[i]
    stack[i] = celspan.cel { rect { 0, 0, 1, 1, fill = cel.paint },
      front = cel.front, back = cel.back }
  end
  if with_next then stack[#stack + 1] = celspan.cel { back = cels[count + 1].back } end
  if #stack == 0 then return { 0, 0, 0 } end
  local r, g, b = probe(rostrum(stack), 0.5, 0.5, { film = { 1, 1 } })
  return { r, g, b }
end

--- A colour of light as an opaque paint.
local function shown(colour)
  local r, g, b = table.unpack(colour)
  return rgb(math.min(1, r), math.min(1, g), math.min(1, b))
end

local function disc(x, y, r, texture)
  local circle = celspan.circle { x, y, r, fill = texture }
  return circle | circle:stroke { width = 2, fill = diagram.ink }
end

--- A sign in a circle: "x" where a cel filters and scatters, "+" where light is added.
local function sign(x, y, kind)
  local turn = kind == "x" and 45 or 0
  local level = diagram.line({ { x - 11, y }, { x + 11, y } }, 3)
  local upright = diagram.line({ { x, y - 11 }, { x, y + 11 } }, 3)
  return disc(x, y, 17, diagram.paper) | (level | upright):rotate(turn, x, y)
end

local LINE = 250 -- the row along which the light is drawn

--- One cel with its incoming and outgoing light; `x` is where the light from behind arrives.
local function stage(i, x)
  local cel = cels[i]
  local from, add, cross, to = x, x + 76, x + 168, x + 262
  return union {
    disc(from, LINE, 26, shown(light(i - 1))),
    diagram.arrow(from + 27, LINE, add - 20, LINE), sign(add, LINE, "+"),
    disc(add, LINE + 120, 26, shown(cel.back)), diagram.arrow(add, LINE + 93, add, LINE + 20),
    diagram.arrow(add + 18, LINE, cross - 20, LINE), sign(cross, LINE, "x"),
    rect { cross - 27, LINE - 178, 54, 54, fill = "#ffffff" },
    rect { cross - 27, LINE - 178, 27, 54, fill = diagram.ink },
    rect { cross - 27, LINE - 178, 54, 54, fill = cel.paint },
    diagram.box(cross - 27, LINE - 178, 54, 54), diagram.arrow(cross, LINE - 123, cross, LINE - 20),
    disc(cross, LINE + 120, 26, shown(cel.front)),
      diagram.arrow(cross, LINE + 93, cross, LINE + 20),
    diagram.arrow(cross + 18, LINE, to - (i == #cels and 36 or 28), LINE),
    diagram.label("back", add, LINE + 172, 17, "centre", diagram.grey),
    diagram.label("front", cross, LINE + 172, 17, "centre", diagram.grey),
    diagram.label("cel " .. i, cross, LINE - 192, 20, "centre"),
  }
end

local art = {}
for i = 1, #cels do art[i] = stage(i, 56 + (i - 1) * 262) end
art[#art + 1] = disc(56 + #cels * 262, LINE, 34, shown(light(#cels)))
art[#art + 1] = diagram.label("to the camera", 56 + #cels * 262 - 8, LINE + 66, 17, "centre",
  diagram.grey)

return diagram.film("Figure 8", 960, 480, art)
