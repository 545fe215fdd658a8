-- Papers for collages: with fibres or printed, and torn out with a white edge.
local papers = {}

--- Paper with fibres, from a darker to a lighter colour.
function papers.fibres(dark, light, size)
  return noise { kind = "fractal", size = size or 60, octaves = 5, gain = 0.6,
    colours = { dark, light } }
end

--- Printed paper: lines of art on a ground, in pieces of w by h.
function papers.printed(ground, w, h, art, degrees)
  local a = math.rad(degrees or 0)
  local c, s = math.cos(a), math.sin(a)
  return pattern { art = rect { 0, 0, w, h, fill = ground } | art, box = { 0, 0, w, h },
    matrix = { c, -s, 0, s, c, 0, 0, 0, 1 } }
end

--- A shape, torn out of paper, with its white edge and its shadow on what lies below.
function papers.torn(shape, paper, seed)
  local edge = shape:outline { width = 5, fill = "#fdf8ec", only = true }
    :boil { amount = 2.4, grain = 30, frame = 0, seed = seed }
  local inner = shape:boil { amount = 1.6, grain = 24, frame = 0, seed = seed + 50 }
  return (edge | inner:paint(paper)):shadow { offset = { 5, 8 }, blur = 9, colour = "#1a0f14",
    opacity = 0.5 }
end

return papers
