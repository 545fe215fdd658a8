-- The plots of docs/bench.md. Arguments: the table of a run, the plot, the scene where it has one:
--   shapes SCENE   time against side
--   ratios         how many times as long as celspan the others take
--   figure13       the paper's shapes, beside its line
--   figure14       the paper's pair, beside its curves
--   defocus        time against radius
local celspan = require "celspan"
local chart = require "tests.bench.chart"
local published = require "tests.bench.published"
local results = require "tests.bench.results"

local path, plot, scene = ...
local run = results.read(path)
local sides = { 1024, 2048, 4096, 30000, 100000, 1000000 }
local peers = { { "blend2d", "Blend2D" }, table.unpack(results.peers) }

local colours = { celspan = "#c8102e", spans = "#e8743b", published = "#1b6ca8",
  blend2d = "#0d3552", skia = "#4c9f70", agg = "#8c6bb1", qt = "#6b7a3a", cairo = "#b08a2e",
  limit = "#7a8087", opencv = "#1b6ca8", vips = "#4c9f70" }

--- The seconds of the wanted rows against x; a point for each row that exists.
local function points(wanted, list, key)
  local out = {}
  for _, x in ipairs(list) do
    wanted[key or "side"] = x
    local seconds = results.seconds(run:one(wanted))
    if seconds then out[#out + 1] = { x, seconds } end
  end
  return out
end

local function add(series, name, colour, list, dash)
  if #list > 0 then
    series[#series + 1] = { name = name, colour = colour, points = list, dash = dash }
  end
end

local function published_points(seconds)
  local out = {}
  for _, side in ipairs(sides) do
    if seconds[side] then out[#out + 1] = { side, seconds[side] } end
  end
  return out
end

local function shapes()
  local series = {}
  local function wanted(renderer, output, antialias)
    return { part = "shapes", scene = scene, renderer = renderer, output = output,
             antialias = antialias }
  end
  local known = published_points(published.shapes[scene])
  add(series, "Blend2D, published", colours.published, known, true)
  for _, peer in ipairs(peers) do
    add(series, peer[2], colours[peer[1]], points(wanted(peer[1], "row", "area"), sides))
  end
  add(series, "celspan, pixels", colours.celspan, points(wanted("celspan", "row", "area"), sides))
  add(series, "celspan, spans", colours.spans, points(wanted("celspan", "spans", "area"), sides))
  add(series, "spans, no antialias", "#f0a878", points(wanted("celspan", "spans", "none"), sides))
  add(series, "fill of the runs", colours.limit, points(wanted("fill of runs", "row"), sides), true)
  return chart.lines { width = 960, height = 600, series = series, x = "pixels a side",
    ticks = { 1024, 4096, 30000, 100000, 1000000 },
    title = scene .. " shapes, one thread: time against side" }
end

local function ratios()
  local groups = {}
  for _, name in ipairs { "10", "100", "1000" } do
    for _, side in ipairs { 1024, 2048, 4096, 30000 } do
      local mine = run:one { part = "shapes", scene = name, side = side, output = "row",
                             antialias = "area", renderer = "celspan" }
      local bars = {}
      local function bar(label, colour, seconds)
        if mine and seconds then
          bars[#bars + 1] = { name = label, colour = colour,
                              value = seconds / results.seconds(mine) }
        end
      end
      bar("Blend2D, published", colours.published, published.shapes[name][side])
      for _, peer in ipairs(peers) do
        bar(peer[2], colours[peer[1]], results.seconds(run:one { part = "shapes", scene = name,
          side = side, output = "row", antialias = "area", renderer = peer[1] }))
      end
      if #bars > 0 then
        local short = side >= 30000 and "30k" or side // 1024 .. "k"
        local drawing = side == 4096 and name .. " shapes" or "" -- once, under the middle one
        groups[#groups + 1] = { names = { short, drawing }, bars = bars }
      end
    end
  end
  return chart.bars { width = 1100, height = 520, groups = groups,
    title = "how many times celspan's time (antialiased, to pixels, one thread)" }
end

local function figure13()
  local series, paper = {}, published.paper
  local function line(last)
    local out = {}
    for i, side in ipairs { 1024, paper.side } do out[i] = { side, last * side / paper.side } end
    return out
  end
  add(series, "paper: 100 shapes", colours.limit, line(paper.shapes), true)
  for _, one in ipairs { { "100", "area", colours.celspan }, { "100", "none", colours.spans },
                         { "10", "area", colours.published }, { "10", "none", colours.skia } } do
    add(series, ("%s shapes, %s"):format(one[1], one[2]), one[3],
      points({ part = "shapes", scene = one[1], renderer = "celspan", output = "spans",
               antialias = one[2] }, sides))
  end
  return chart.lines { width = 960, height = 600, series = series, x = "pixels a side",
    ticks = { 1024, 4096, 30000, 100000, 1000000 },
    title = "figure 13: 10 and 100 shapes, to spans" }
end

local function figure14()
  local series, list = {}, { 1000, 4000, 10000, 30000 }
  local paper = published.paper
  local function curve(last)
    local out = {}
    for i, side in ipairs(list) do out[i] = { side, last * (side / paper.side) ^ 2 } end
    return out
  end
  add(series, "paper: pictures", colours.limit, curve(paper.all_pictures), true)
  add(series, "paper: geometry", "#a9b0b8", curve(paper.geometry), true)
  local pairs_of_curves = {
    { "pictures bilinear", colours.published }, { "pictures nearest", colours.skia },
    { "geometry bilinear", colours.celspan }, { "geometry nearest", colours.spans },
  }
  for _, one in ipairs(pairs_of_curves) do
    local wanted = { part = "figure14", scene = one[1], output = "spans" }
    add(series, one[1], one[2], points(wanted, list))
  end
  return chart.lines { width = 960, height = 600, series = series, x = "pixels a side",
    ticks = list, title = "figure 14: all pictures, and geometry over one picture, to spans" }
end

local function defocus()
  local series = {}
  local function against(renderer, kernel, output)
    local out = {}
    for _, radius in ipairs { 5, 50, 500 } do
      local seconds = results.seconds(run:one { part = "defocus", scene = "100 radius " .. radius,
        renderer = renderer, antialias = kernel, output = output })
      if seconds then out[#out + 1] = { radius, seconds } end
    end
    return out
  end
  add(series, "libvips", colours.vips, against("vips", "gaussian", "whole"))
  add(series, "OpenCV", colours.opencv, against("opencv", "gaussian", "whole"))
  add(series, "celspan, Gaussian", colours.celspan, against("celspan", "gaussian", "row"))
  add(series, "celspan, box", colours.spans, against("celspan", "box", "row"))
  add(series, "celspan, disc", "#f0a878", against("celspan", "disc", "row"))
  return chart.lines { width = 960, height = 520, series = series, x = "radius in pixels",
    ticks = { 5, 50, 500 },
    title = "defocus of 100 shapes at 4096 x 4096, one thread" }
end

local plots = { shapes = shapes, ratios = ratios, figure13 = figure13, figure14 = figure14,
  defocus = defocus }
local sizes = { ratios = { 1100, 520 }, defocus = { 960, 520 } }

return celspan.film { size = sizes[plot] or { 960, 600 }, frames = 1, frame = plots[plot] }
