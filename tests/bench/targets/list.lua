--- The performance targets of celspan: each is a line with the target, the measured value, and
--- whether it is met. A target whose rows are missing from the table is listed as not measured.
local published = require "tests.bench.published"
local results = require "tests.bench.results"
local scenes = require "tests.bench.scenes"

local targets = {}
local seconds = results.seconds

local function time(value)
  if value < 1e-3 then return ("%.0f us"):format(1e6 * value) end
  if value < 1 then return ("%.3g ms"):format(1e3 * value) end
  return ("%.3g s"):format(value)
end

targets.time = time

--- lines: the list to extend; value: nil if the figure was not measured.
local function add(lines, what, value, text, is_met)
  lines[#lines + 1] = { what = what, text = value and text(value) or "not measured",
                        is_met = value and is_met(value) }
end

local function at_most(lines, what, value, limit, text)
  add(lines, what, value, text, function(v) return v <= limit end)
end

local function at_least(lines, what, value, limit, text)
  add(lines, what, value, text, function(v) return v >= limit end)
end

local function times(value) return ("%.3g times"):format(value) end
local function number(value) return ("%.2f"):format(value) end
local function mebibytes(value) return ("%.1f MiB"):format(value) end

local function over(a, b) return a and b and a / b end

local function shapes(run, scene, side, output, antialias, renderer)
  return run:one { part = "shapes", scene = scene, side = side, output = output,
                   antialias = antialias, renderer = renderer or "celspan" }
end

-- ---------------------------------------------------------------- spans

local function spans(run, lines)
  for _, scene in ipairs { "10", "100", "1000" } do
    for _, antialias in ipairs { "none", "area" } do
      local power = run:exponent({ part = "shapes", scene = scene, output = "spans",
        antialias = antialias, renderer = "celspan" }, { 4096, 30000, 100000, 1000000 })
      at_most(lines, ("%s shapes, `%s`, to spans: power of the side, 4k to 1M, at most 1.0")
        :format(scene, antialias), power, 1.0, number)
    end
  end
  local limits = { { "100", 30000, 0.005, 0.016 }, { "1000", 30000, 0.030, 0.065 },
                   { "100", 1000000, 0.06, 0.42 }, { "1000", 1000000, 0.2, 1.0 } }
  for _, limit in ipairs(limits) do
    local scene, side = limit[1], limit[2]
    for i, antialias in ipairs { "none", "area" } do
      at_most(lines, ("%s shapes at %s, `%s`, to spans: at most %s"):format(scene,
        side == 30000 and "30k" or "1M", antialias, time(limit[2 + i])),
        seconds(shapes(run, scene, side, "spans", antialias)), limit[2 + i], time)
    end
  end
  for _, scene in ipairs { "100", "1000" } do
    local large = shapes(run, scene, 1000000, "spans", "area")
    local small = shapes(run, scene, 4096, "spans", "area")
    at_most(lines, scene .. " shapes at 1M, `area`: peak memory under 64 MiB",
      large and large.peak_kib / 1024, 64, mebibytes)
    at_most(lines, scene .. " shapes, `area`: peak memory at 1M over that at 4k, flat",
      over(large and large.peak_kib, small and small.peak_kib), 2, times)
  end
  local area = seconds(shapes(run, "100", 30000, "spans", "area"))
  at_most(lines, "100 shapes at 30k, `area`: at most 15 ns per listed boundary (46 per row)",
    area and 1e9 * area / (46 * 30000), 15, function(v) return ("%.1f ns"):format(v) end)
end

-- ---------------------------------------------------------------- pixels

--- The published best time of Blend2D divided by celspan's best time.
local function ahead(run, scene, side)
  local mine = shapes(run, scene, side, "row", "area")
  return over((published.shapes[scene] or {})[side], mine and mine.best_processor)
end

local names = { [1024] = "1k", [2048] = "2k", [4096] = "4k", [30000] = "30k" }

local function pixels(run, lines)
  local bounds = {
    ["10"] = { 1.1, 1.6, 2.9 }, ["100"] = { 1.1, 2.5, 11 }, ["1000"] = { 1.7, 6, 40 },
    opaque = { 1, 1, 1 }, small = { false, 0.95, 1 }, faint = { 0.2, false, 1 },
  }
  for _, scene in ipairs { "10", "100", "1000", "opaque", "small", "faint" } do
    for i, side in ipairs { 1024, 4096, 30000 } do
      local bound = bounds[scene][i]
      local name = tonumber(scene) and scene .. " shapes" or "the scene `" .. scene .. "`"
      if bound then
        at_least(lines, ("%s at %s to pixels: Blend2D, published, takes at least %g times as long")
          :format(name, names[side], bound), ahead(run, scene, side), bound, times)
      end
    end
  end
end

--- A drawing in the first frame of a film that shows it.
local function artwork(run, lines)
  for _, scene in ipairs(scenes.artwork) do
    local bounds = scene == "clipart" and { 0.7, 1, 1.3 } or { 1, 1.2, 1.5 }
    for i, side in ipairs { 1024, 2048, 4096 } do
      at_least(lines, ("`%s` at %s, new in a film: the best of AGG, Qt, Skia and Cairo takes at "
        .. "least %g times as long"):format(scene, names[side], bounds[i]),
        over(run:best_peer(scene, side), seconds(shapes(run, scene, side, "row", "first"))),
        bounds[i], times)
    end
  end
end

--- A film's frame, and nine painted layers; least times, as films are compared.
local function films(run, lines)
  for _, bound in ipairs { { "clipart", 1024, 1.8, 1.1 }, { "clipart", 2048, 1.8, 1 },
      { "clipart", 4096, 1.8, 1 }, { "emoji", 1024, 1.6, 1 }, { "house", 1024, 2, 0.85 } } do
    local scene, side, of_agg, of_blend2d = table.unpack(bound)
    local mine = run:film_seconds(scene, side, "celspan", "again")
    local what = "a frame of the film `%s` at %s: %s takes at least %g times as long"
    at_least(lines, what:format(scene, names[side], "AGG", of_agg),
      over(run:film_seconds(scene, side, "agg", "area"), mine), of_agg, times)
    local blend2d = run:film_seconds(scene, side, "blend2d", "area")
    if blend2d then
      at_least(lines, what:format(scene, names[side], "Blend2D", of_blend2d),
        over(blend2d, mine), of_blend2d, times)
    end
  end
  local mine = run:one { part = "raw", scene = "painted", renderer = "celspan" }
  local other = run:one { part = "raw", scene = "painted", renderer = "opencv" }
  at_least(lines, "nine painted layers under a pan: not slower than OpenCV",
    over(other and other.best_processor, mine and mine.best_processor), 1, times)
end

--- A drawing in the later frames of a film, where it is drawn from its map. The other drawings have
--- too few shapes for that.
local function again(run, lines)
  for _, scene in ipairs(scenes.sheets) do
    for _, bound in ipairs { { 1024, 2.2, 1.1 }, { 2048, 2.4, 1.05 }, { 4096, 2.6, 1.05 } } do
      local side, least, of_blend2d = table.unpack(bound)
      local mine = seconds(shapes(run, scene, side, "row", "again"))
      local what = "`%s` at %s, in a later frame: %s takes at least %g times as long"
      at_least(lines, what:format(scene, names[side], "the best of AGG, Qt, Skia and Cairo", least),
        over(run:best_peer(scene, side), mine), least, times)
      local blend2d = seconds(shapes(run, scene, side, "row", "area", "blend2d"))
      if blend2d then
        at_least(lines, what:format(scene, names[side], "Blend2D", of_blend2d),
          over(blend2d, mine), of_blend2d, times)
      end
    end
  end
end

-- ---------------------------------------------------------------- the ways of a drawing

--- celspan's time for a drawing over that of a sweep of it.
local function over_sweep(run, scene, side, output, antialias)
  return over(seconds(shapes(run, scene, side, output, antialias)),
    seconds(shapes(run, scene, side, output, "swept")))
end

--- The mean and the greatest of the figures that were measured.
local function summary(figures)
  local sum, count, most = 0, 0, nil
  for _, value in pairs(figures) do
    sum, count, most = sum + value, count + 1, math.max(most or 0, value)
  end
  return count > 0 and sum / count or nil, most
end

--- over_sweep of several drawings, by their names.
local function all_over_sweep(run, list, side, output)
  local out = {}
  for _, scene in ipairs(list) do out[scene] = over_sweep(run, scene, side, output, "area") end
  return out
end

--- What the choice of a way gains, and that it hardly ever loses.
local function ways(run, lines)
  for _, bound in ipairs { { 1024, 0.72 }, { 2048, 0.85 } } do
    local side, most = table.unpack(bound)
    at_most(lines, ("artwork at %s, a still: at most %g times a sweep, on average"):format(
      names[side], most), summary(all_over_sweep(run, scenes.artwork, side, "row")), most, times)
  end
  for _, side in ipairs { 1024, 2048, 4096 } do
    local most = 0
    for _, list in ipairs { scenes.artwork, scenes.random, scenes.hard, scenes.gradients } do
      local _, worst = summary(all_over_sweep(run, list, side, "row"))
      most = math.max(most, worst or 0)
    end
    at_most(lines, ("every drawing at %s, a still: at most 1.05 times a sweep"):format(names[side]),
      most > 0 and most or nil, 1.05, times)
  end
  local _, strip = summary(all_over_sweep(run, scenes.artwork, 1024, "strip"))
  at_most(lines, "artwork at 1k, 16 rows of a still: at most 1.1 times a sweep of them", strip, 1.1,
    times)
  at_most(lines, "`gradients-100` at 1k, in a later frame: at most a sweep",
    over_sweep(run, "gradients-100", 1024, "row", "again"), 1, times)
  at_most(lines, "`faint` at 1k, of which a map is tried in vain: at most 1.08 times a sweep",
    over_sweep(run, "faint", 1024, "row", "mapped"), 1.08, times)
end

-- ---------------------------------------------------------------- the sizes of films

--- The targets for hard scenes, and for 10 to 1000 shapes, at the sizes of films.
local function film_sizes(run, lines)
  for _, bound in ipairs { { "small", 1024, 0.7 }, { "small", 4096, 0.95 },
                           { "faint", 1024, 0.55 }, { "faint", 4096, 1.2 } } do
    local scene, side, least = table.unpack(bound)
    at_least(lines, ("the scene `%s` at %s to pixels: AGG takes at least %g times as long"):format(
      scene, names[side], least), over(seconds(shapes(run, scene, side, "row", "area", "agg")),
      seconds(shapes(run, scene, side, "row", "area"))), least, times)
  end
  for _, bound in ipairs { { "10", 0.00025 }, { "100", 0.0036 }, { "1000", 0.022 },
                           { "gradients-100", 0.04 }, { "gradients-1000", 0.25 } } do
    local scene, most = table.unpack(bound)
    at_most(lines, ("%s at 1k to pixels: at most %s"):format(
      tonumber(scene) and scene .. " shapes" or "the scene `" .. scene .. "`", time(most)),
      seconds(shapes(run, scene, 1024, "row", "area")), most, time)
  end
end

-- ---------------------------------------------------------------- accuracy

--- The worst of a figure over all drawings of the run.
local function worst(run, key)
  local most
  for _, row in ipairs(run:all { part = "accuracy" }) do
    if row.rms and row[key] then most = math.max(most or 0, row[key]) end
  end
  return most
end

local function accuracy(run, lines)
  local function codes(value) return ("%.3g of 255"):format(value) end
  at_most(lines, "`area`, every pixel of every drawing: at most 2 of 255 off in linear light",
    worst(run, "worst"), 2, codes)
  at_most(lines, "`area`, every drawing: at most 0.1 of 255 rms", worst(run, "rms"), 0.1, codes)
  for _, cover in ipairs { "fans", "bars" } do
    local row = run:one { part = "accuracy", scene = "abutting " .. cover }
    at_most(lines, ("`area`, inside abutting %s: no light leaks"):format(cover), row and row.worst,
      0, codes)
  end
end

-- ---------------------------------------------------------------- pictures, softness

--- The time of a peer over celspan's in a raster job.
local function raster_ratio(run, job, renderer)
  local mine = run:one { part = "raster", scene = job, renderer = "celspan", output = "whole" }
  local other = run:one { part = "raster", scene = job, renderer = renderer }
  return over(seconds(other), seconds(mine))
end

local function pictures(run, lines)
  for _, job in ipairs { "affine", "perspective" } do
    for _, peer in ipairs { { "cairo", "Cairo" }, { "agg", "AGG" }, { "vips", "libvips" },
                            { "oiio", "OpenImageIO" }, { "qt", "Qt" } } do
      local is_asked = not (job == "affine" and peer[1] == "qt")
        and not (job == "perspective" and peer[1] == "cairo")
      if is_asked then
        at_least(lines, ("a picture over a picture, %s: ahead of %s"):format(job, peer[2]),
          raster_ratio(run, job, peer[1]), 1, times)
      end
    end
  end
  local affine = run:one { part = "raster", scene = "affine", renderer = "celspan",
                           output = "whole" }
  at_most(lines, "a picture over a picture, affine: at most twice Blend2D's published time",
    over(affine and affine.best_processor, published.pictures.affine), 2, times)
  for _, sampling in ipairs { "nearest", "bilinear" } do
    at_most(lines, ("figure 14, geometry over a picture, %s: power of the side, 10k to 30k, linear")
      :format(sampling), run:exponent({ part = "figure14", scene = "geometry " .. sampling,
      output = "spans" }, { 10000, 30000 }), 1.1, number)
  end
end

local function softness(run, lines)
  for _, art in ipairs { "100", "figure 11" } do
    for _, radius in ipairs { 50, 500 } do
      for _, peer in ipairs { { "opencv", "OpenCV" }, { "vips", "libvips" } } do
        local scene = ("%s radius %d"):format(art, radius)
        local mine = run:one { part = "defocus", scene = scene, renderer = "celspan",
                               antialias = "gaussian", output = "row" }
        local other = run:one { part = "defocus", scene = scene, renderer = peer[1] }
        at_least(lines, ("defocus of %s, radius %d at 4096: not slower than %s"):format(
          art == "100" and "100 shapes" or art, radius, peer[2]),
          over(seconds(other), seconds(mine)), 1, times)
      end
    end
  end
end

-- ---------------------------------------------------------------- files

local function span_files(run, lines)
  local limits = { none = 1, area = 3 }
  for _, antialias in ipairs { "none", "area" } do
    local row = run:one { part = "files", side = 1000000, output = "span", antialias = antialias }
    at_most(lines, ("100 shapes at 1M x 1M to a span file, `%s`: under %d s"):format(antialias,
      limits[antialias]), row and row.wall, limits[antialias], time)
    at_most(lines, ("the same, `%s`: peak memory under 64 MiB"):format(antialias),
      row and row.peak_kib / 1024, 64, mebibytes)
  end
  for _, scene in ipairs { "100", "terapixel" } do
    local cut = run:one { part = "cut", scene = scene, side = 1000000, output = "cut of 4096" }
    at_most(lines, ("4096 x 4096 out of a span file at 1M, %s: under 100 ms"):format(
      scene == "100" and "100 shapes" or scene), cut and cut.wall, 0.1, time)
  end
end

local function sameness(distance) return distance == 0 and "the same pixels" or "other pixels" end

local function png_files(run, lines)
  local png = run:one { part = "files", side = 30000, output = "png", antialias = "area",
                        renderer = "celspan", workers = 1 }
  local fast = run:one { part = "files", side = 30000, renderer = "OpenImageIO level 1" }
  local good = run:one { part = "files", side = 30000, renderer = "OpenImageIO level 6" }
  at_least(lines, "100 shapes at 30k, `area`, to PNG: 50 times faster than OpenImageIO at level 1",
    over(seconds(fast), seconds(png)), 50, times)
  at_most(lines, "the same: no larger than OpenImageIO's file at level 6",
    over(png and png.bytes, good and good.bytes), 1, times)
  for _, reader in ipairs { { "oiio", "OpenImageIO" }, { "vips", "libvips" } } do
    local read = run:one { part = "readers", side = 30000, renderer = reader[1] }
    at_most(lines, ("the same: %s reads the same pixels"):format(reader[2]),
      read and read.rms, 0, sameness)
  end
end

--- With OpenImageIO, a frame of the film costs the rendering of the pixels and then the writing.
local function film_frame(run, lines)
  local frame = run:one { part = "film png", renderer = "celspan", output = "png" }
  local pixels_alone = run:one { part = "film png", renderer = "celspan", output = "row" }
  local writing = run:one { part = "film png", renderer = "OpenImageIO default" }
  local both = pixels_alone and writing and seconds(pixels_alone) + seconds(writing)
  at_least(lines, "a frame of the demo film, rendered and written as PNG: 5 times faster than "
    .. "rendered and written by OpenImageIO at its default", over(both, seconds(frame)), 5, times)
  at_most(lines, "the same: no larger", over(frame and frame.bytes, writing and writing.bytes), 1,
    times)
end

-- ---------------------------------------------------------------- compositing

--- Of the best times: frames of a few milliseconds vary with what else the machine does.
local function composited(run, lines)
  local function best(scene, side, renderer)
    local row = run:one { part = "compositing", scene = scene, side = side or 1920,
                          renderer = renderer or "celspan" }
    return row and row.best_wall
  end
  for _, limit in ipairs { { "group", "an isolated group at half opacity", "flat", 1.2 },
      { "multiply", "a blend mode", "flat", 1.5 },
      { "matte circle", "a matte, a soft circle", "under circle", 1.6 },
      { "matte gradient", "a matte, a gradient", "under gradient", 1.6 },
      { "srgb", 'a film in `"srgb"`', "flat", 1.1 } } do
    at_most(lines, ("%s: at most %g times the same drawing, `%s`"):format(limit[2], limit[4],
      limit[3]), over(best(limit[1]), best(limit[3])), limit[4], times)
  end
  at_most(lines, "a frame with a soft shadow of radius 16 at 1920 x 1080: under 15 ms",
    best "shadow", 0.015, time)
  for _, side in ipairs { 1920, 3840 } do
    at_least(lines, ("60 groups with modes and blurs, %d pixels wide: ahead of Skia"):format(side),
      over(best("groups", side, "skia"), best("groups", side)), 1, times)
  end
end

-- ---------------------------------------------------------------- sequences

--- Frames per second of a row of the film.
local function rate(run, renderer, workers)
  local row = run:one { part = "demo", renderer = renderer, workers = workers }
  return row and tonumber(row.scene:match "%d+") / row.wall
end

targets.rate = rate

local function sequences(run, lines)
  for _, side in ipairs { 4096, 30000 } do
    for _, scene in ipairs { "100", "1000" } do
      local one = run:one { part = "workers", scene = scene, side = side, workers = 1 }
      local two = run:one { part = "workers", scene = scene, side = side, workers = 2 }
      at_least(lines, ("%s shapes at %s to pixels: two workers at least 1.85 times one")
        :format(scene, names[side]), over(one and one.wall, two and two.wall), 1.85, times)
    end
  end
  at_least(lines, "the demo film to PNG: two workers at least 1.85 times one",
    over(rate(run, "celspan", 2), rate(run, "celspan", 1)), 1.85, times)
  at_least(lines, "the demo film to PNG: ahead of ffmpeg over the same layers",
    over(rate(run, "celspan", 2), rate(run, "ffmpeg", 2)), 1, times)
  at_least(lines, "the demo film to PNG: ahead of celspan without its caches",
    over(rate(run, "celspan", 2), rate(run, "celspan keeping nothing", 2)), 1, times)
  local start = run:one { part = "start", scene = "small" }
  at_most(lines, "a small script: under 5 ms from exec to the first row", start and start.wall,
    0.005, time)
end

--- { { what, text, is_met }, ... }; is_met is nil if nothing was measured.
function targets.lines(run)
  local lines = {}
  local parts = { films, artwork, again, ways, film_sizes, accuracy, spans, pixels, pictures,
                  softness, span_files, png_files, film_frame, composited, sequences }
  for _, part in ipairs(parts) do part(run, lines) end
  return lines
end

return targets
