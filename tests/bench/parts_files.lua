--- Files: PNG and span files beside OpenImageIO's PNG, and a cut of a million by a million pixels.
local Command = require("tests.bench.runner").command

local parts = {}

local function written(runner, drawing, side, antialias, file, workers)
  return { command = Command(runner:program "celspan", "shapes", drawing, side, antialias, "file",
             workers, file), part = "files", scene = "100", side = side,
           output = file:match "%.(%w+)$", antialias = antialias, renderer = "celspan",
           workers = workers }
end

local function by_openimageio(runner, drawing, side, level, file)
  return { command = Command(runner:program "oiio", "png", drawing, side, level, file),
           part = "files", scene = "100", side = side, output = "png", antialias = "area",
           renderer = "OpenImageIO level " .. level, workers = 1 }
end

--- Whether two independent readers decode exactly the same pixels: a distance of 0.
local function compare_readers(runner, drawing, side, file)
  local truth = runner:ask(Command(runner:program "celspan", "digest", drawing, side))
  for _, reader in ipairs { "oiio", "vips" } do
    local told = runner:has(reader) and runner:ask(Command(runner:program(reader), "read", file))
    if told then
      local is_same = told[1].digest == truth[1].digest
      runner.rows[#runner.rows + 1] = { part = "readers", scene = "100", side = side,
        output = "png", antialias = "area", renderer = reader, rms = is_same and 0.0 or 255.0 }
      print(("   the PNG of %d decoded by %s: %s"):format(side, reader,
        is_same and "the very pixels" or "OTHER PIXELS"))
    end
  end
end

function parts.png(runner, folder, is_quick)
  local drawing, file = folder .. "/100.txt", folder .. "/100.png"
  for _, side in ipairs(is_quick and { 4096 } or { 4096, 30000 }) do
    runner:measure(3, { written(runner, drawing, side, "area", file, 2),
                        written(runner, drawing, side, "none", file, 1),
                        written(runner, drawing, side, "area", file, 1) })
    compare_readers(runner, drawing, side, file)
    if runner:has "oiio" then
      runner:measure(1, { by_openimageio(runner, drawing, side, 1, folder .. "/oiio.png"),
                          by_openimageio(runner, drawing, side, 6, folder .. "/oiio.png") })
    end
  end
  os.remove(file)
  os.remove(folder .. "/oiio.png")
end

--- A cut of 4096 x 4096 pixels out of a span file to PNG, the whole process: of the terapixel
--- frame, a house with its windows.
local function cut(runner, scene, side, file, out)
  local corner = ("%d,%d,4096,4096"):format(side * 441 // 1000, side * 698 // 1000)
  return { command = Command(runner:program "launch", "all", runner.celspan, "convert", file, out,
             "--crop", corner), part = "cut", scene = scene, side = side, output = "cut of 4096",
           renderer = "celspan", workers = 2 }
end

function parts.span_file(runner, folder)
  local drawing, file, out = folder .. "/100.txt", folder .. "/100.span", folder .. "/cut.png"
  for _, antialias in ipairs { "none", "area" } do
    runner:measure(3, { written(runner, drawing, 1000000, antialias, file, 1) })
  end
  runner:measure(3, { cut(runner, "100", 1000000, file, out) })
  os.remove(file)
  os.remove(out)
end

--- The terapixel frame as a span file, which takes minutes, and a cut out of it.
function parts.cut(runner, folder, is_quick)
  local side = is_quick and 30000 or 1000000
  local file, out = folder .. "/terapixel.span", folder .. "/cut.png"
  runner:measure(1, { { command = Command(runner:program "launch", "all", runner.celspan, "render",
    "scripts/terapixel.lua", "--size", ("%dx%d"):format(side, side), "--antialias", "none",
    "--progress", "none", "-o", file), part = "cut", scene = "terapixel", side = side,
    output = "span", renderer = "celspan", workers = 2, limit = 300 } })
  runner:measure(3, { cut(runner, "terapixel", side, file, out) })
  os.remove(file)
  os.remove(out)
end

return parts
