-- A table that crosses what films have with all ways out: the frames of tests/support/crossed.lua,
-- written in each format and read again, beside the pixels of the frame.
--
-- A cell is the largest difference of a channel in codes, colours multiplied by alpha. Of vectors
-- a pixel may have any colour of the pixels around it: programs mix edges in another way.
local celspan = require "celspan"
local crossed = require "tests.support.crossed"
local layers = require "celspan.layers"
local lottie = require "celspan.lottie"
local present = require "tests.support.present"
local svg = require "celspan.svg"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local W, H = 48, 32
local VERBOSE = os.getenv "CELSPAN_VERBOSE"

local benches = {} -- a folder for each film, because pictures are kept by the names of their files
local bench
teardown(function()
  for _, one in pairs(benches) do one:remove() end
end)

local has_pictures, has_type = present.pictures(), present.type()
local has_cairo = present.pdf() and present.program "pdftocairo"
local has_librsvg = present.program "rsvg-convert"

-- ---------------------------------------------------------------- pixels

local function pixels_of(film, number)
  return assert(celspan.pixels(film, { frame = number })):bytes()
end

--- Objects as a frame; in codes, which 8 bits keep.
local function shown(space, ...)
  local objects = { ... }
  return pixels_of(celspan.film { size = { W, H }, space = space, frame = function()
    local cels = {}
    for i, object in ipairs(objects) do cels[i] = celspan.cel { object } end
    return celspan.rostrum(cels)
  end })
end

local function image(path, layer)
  return celspan.image { file = path, layer = layer, w = W, h = H, sampling = "nearest" }
end

--- A list of the channels, colours multiplied by alpha.
local function numbers(bytes)
  local list = { bytes:byte(1, -1) }
  for i = 1, #list, 4 do
    local part = list[i + 3] / 255
    for k = i, i + 2 do list[k] = list[k] * part end
  end
  return list
end

--- The least and the greatest of a channel in the pixels around one, those of the frame's sides
--- included.
local function range(list, x, y, channel)
  local low, high = math.huge, -math.huge
  for v = math.max(y - 1, 0), math.min(y + 1, H - 1) do
    for u = math.max(x - 1, 0), math.min(x + 1, W - 1) do
      local value = list[4 * (v * W + u) + channel]
      low, high = math.min(low, value), math.max(high, value)
    end
  end
  return low, high
end

local EDGE = 8 -- codes: what lies beside an edge differs by more

--- How far a channel of a pixel is from the colours of the pixels around it in the frame. edges:
--- how many codes that may be beside an edge.
local function distance(list, place, channel, value, edges)
  local x, y, low, high = place % W, place // W, range(list, place % W, place // W, channel)
  local off = math.max(low - value, value - high, 0)
  for k = 1, off > 0 and edges and 4 or 0 do
    low, high = range(list, x, y, k)
    if high - low > EDGE then return off - edges end
  end
  return off
end

--- The largest difference of a picture from that of the reference, as the column judges the row.
local function difference(own, other, column, row)
  if own.bytes == other then return 0 end
  local most, a, b = 0, own.numbers, numbers(other)
  assert(#a == #b, "the pictures have different sizes")
  for i = 1, #a do
    local off = math.abs(a[i] - b[i])
    if off > most and column.is_near and not row.is_small then
      off = distance(a, (i - 1) // 4, (i - 1) % 4 + 1, b[i], column.edges)
    end
    most = math.max(most, off)
  end
  return most
end

-- ---------------------------------------------------------------- the ways out

local space, grain = nil, nil -- of the film that is written

local function begin(film)
  local name = film[1] .. tostring(film[2])
  space, grain = film[1], film[2]
  bench = benches[name] or workbench.new()
  benches[name] = bench
  bench:write("crossed.lua", assert(system.read "tests/support/crossed.lua"))
  bench:write("film.lua", ("return require 'crossed'.film(%q, %s)"):format(space, grain))
end

local function path_of(pattern, number) return bench.folder .. "/" .. pattern:format(number) end

--- A reader of files that have a number, of which some may be missing.
local function files(pattern, read)
  return function()
    return function(number)
      local path = path_of(pattern, number)
      return system.exists(path) and read(path) or nil
    end
  end
end

local function pictures(pattern)
  return files(pattern, function(path) return shown("srgb", image(path)) end)
end

--- A reader of raw frames, one after the other in a file.
local function raw(name)
  return function()
    local bytes = assert(bench:read(name))
    return function(number)
      local first = 4 * W * H * (number - 1)
      return bytes:sub(first + 1, first + 4 * W * H)
    end
  end
end

local function paintings(pattern)
  return files(pattern, function(path) return shown("srgb", assert(layers.read(path)).object) end)
end

--- A reader of files that a command makes.
local function after(command, reader)
  return function()
    local code, _, said = bench:inside(command)
    assert(code == 0, said)
    return reader()
  end
end

local function read_lottie()
  local film = assert(lottie.read(bench.folder .. "/l.json")):film()
  return function(number) return pixels_of(film, number - 1) end
end

--- The layers of OpenEXR over each other.
local function read_exr_layers()
  return function(number)
    local path, rostrum = path_of("p.%04d.exr", number), crossed.rows[number][2]()
    if type(rostrum) == "table" then rostrum = rostrum[1][1] end -- cels of one name are one layer
    local list = { rostrum.back and image(path, "backlight") or nil }
    for i = 1, #rostrum do list[#list + 1] = image(path, "cel_" .. i) end
    return shown("linear", table.unpack(list))
  end
end

--- The pages of a document; their numbers have as many digits as the last one's.
local function pages() return pictures(grain and "k-%d.png" or "k-%02d.png")() end

--- Why a plane cannot keep a row.
local function plane_refuses(row)
  return grain and row.has_gradients and "lie under a grade, a mode"
    or (row.has_noise or grain) and "noise is in view"
    or row.has_picture and space == "srgb" and "a picture is visible that is composited in sRGB"
    or row.is_mixed and "lie under a grade, a mode"
end

--- Why layers over each other are not the frame.
local function layers_differ(row)
  return row.is_sum and "several exposures" or (row.has_grain or grain) and "grain"
    or row.is_signed and "negative"
end

local function light_differs(row) return layers_differ(row) or row.is_multiplied and "mode" end

local function codes_differ(row)
  return layers_differ(row) or row.is_bright and "brighter than its matte"
end

--- name; -o and options; the reader; how many codes the page of the format allows; and:
--- is_near: vectors; edges: how many more beside an edge, where areas are mixed one over the other;
--- has: what is needed; refuses(row): a part of the reason; differs(row): where the layers are not
--- the frame, a part of what must be said; space: in which alone they are; every: one in that many
--- rows is compared, because each takes a process.
local COLUMNS = {
  -- lua-rendering.md, celspan.pixels: coded from light, also where the film mixes codes
  { "pixels", "- > q.rgba", function()
    return function(number) return pixels_of(crossed.film(space, grain), number) end
  end, 1 },
  -- formats.md, writing: coded, then rounded to the nearest value
  { "png", "a.####.png", pictures "a.%04d.png", 0.01 },
  { "png 16", "b.####.png --depth 16", pictures "b.%04d.png", 1 },
  { "targa", "c.####.tga", pictures "c.%04d.tga", 0.01, has = has_pictures },
  { "tiff", "d.####.tif --depth 16", pictures "d.%04d.tif", 1, has = has_pictures },
  { "exr", "e.####.exr", pictures "e.%04d.exr", 1, has = has_pictures },
  { "span", "f.####.span", after("for f in f.*[05].span; do '" .. workbench.absolute
    .. "' convert $f ${f%.span}.png || exit 1; done", pictures "f.%04d.png"), 0.01, every = 5 },
  -- command-line.md, videos: lossless
  { "ffv1", "g.mkv --codec ffv1 --no-dither",
    after("ffmpeg -y -v error -i g.mkv -f rawvideo -pix_fmt rgba g.rgba", raw "g.rgba"), 0.01,
    has = present.program "ffmpeg" },
  -- lua-rendering.md, celspan.plane: up to three codes
  { "plane", "h.####.plane", files("h.%04d.plane", function(path)
    return assert(assert(celspan.plane_read(path)):pixels {}):bytes()
  end), 3, is_near = true, refuses = plane_refuses },
  -- command-line.md, drawings: a plane, and within about a code of it
  { "svg", "i.####.svg --scale 1", files("i.%04d.svg", function(path)
    return shown("srgb", assert(svg.read(path)).object)
  end), 4, is_near = true },
  { "librsvg", "j.####.svg --scale 1", after("for f in j.*.svg; do "
    .. "rsvg-convert $f -o ${f%.svg}.png || exit 1; done", pictures "j.%04d.png"), 4,
    is_near = true, edges = 24, has = has_librsvg },
  { "pdf", "k.pdf --scale 1", after("rm -f k-*.png && pdftocairo -png -transp -r 72 k.pdf k",
    pages), 4, is_near = true, edges = 24, has = has_cairo },
  -- lottie.md: layers, areas of a plane and pictures
  { "lottie", "l.json", read_lottie, 4, is_near = true },
  -- command-line.md, layers: within one code where one cel has an edge in a pixel
  { "ora", "m.####.ora --layers cels", paintings "m.%04d.ora", 1, space = "srgb", has = has_type,
    differs = codes_differ },
  { "psd", "n.####.psd --layers cels", paintings "n.%04d.psd", 1, space = "srgb", has = has_type,
    differs = codes_differ },
  { "psd 16", "o.####.psd --layers cels --depth 16", paintings "o.%04d.psd", 1, space = "srgb",
    has = has_type, differs = codes_differ },
  { "psd 16, merged", "s.####.psd --layers cels --depth 16", pictures "s.%04d.psd", 1,
    has = has_pictures },
  { "exr layers", "p.####.exr --layers cels --depth float", read_exr_layers, 1, space = "linear",
    has = has_pictures, differs = light_differs },
}

-- ---------------------------------------------------------------- the table

local FEW = 5 -- rows of a film with grain

--- Renders rows, "1-4". Returns what was said.
local function render(frames, output)
  local several = output:find "#" and "--keep-going" or ""
  local _, _, said = bench:celspan_inside("render film.lua --progress none --frames %s %s -o %s",
    frames, several, output)
  return said
end

local references = {} -- by folders: the frames of a film, as bytes and as numbers

local function reference()
  if not references[bench] then
    local said, list = render("1-" .. (grain and FEW or #crossed.rows), "- > r.rgba"), {}
    assert(said == "", said)
    local read = raw "r.rgba" ()
    for number = 1, grain and FEW or #crossed.rows do
      local bytes = read(number)
      list[number] = { bytes = bytes, numbers = numbers(bytes) }
    end
    references[bench] = list
  end
  return references[bench]
end

--- A cell: how far the frame is from that of the reference, or "refused" or "said"; nil: neither,
--- where it must be.
local function cell(column, number, read, said)
  local row = crossed.rows[number]
  local why = column.refuses and column.refuses(row)
  if why then
    local found = said:match(("frame %d: ([^\n]+)"):format(number))
    return found and found:find(why, 1, true) and "refused"
  end
  local got = read(number)
  local off = got and difference(reference()[number], got, column, row)
  why = off and off > column[4] and column.differs and column.differs(row)
  if not why then return off end
  said = render(("%d-%d"):format(number, number), column[2])
  return said:find("layers over each other are not the frame: [^\n]*" .. why) and "said"
end

local function check(column)
  local count, faults, worst, shown_cells = #reference(), {}, 0, {}
  local said = render("1-" .. count, column[2])
  local read = column[3]()
  for number = column.every or 1, count, column.every or 1 do
    local is_well, found = pcall(cell, column, number, read, said)
    local is_number = is_well and type(found) == "number"
    worst = is_number and math.max(worst, found) or worst
    if not is_well or not found or is_number and found > column[4] then
      faults[#faults + 1] = ("%s: %s"):format(crossed.rows[number][1], found or said)
    end
    shown_cells[#shown_cells + 1] = is_number and ("%.1f"):format(found) or is_well and found or "!"
  end
  if VERBOSE then
    print(("# %s, %s%s: worst %.2f of %g: %s"):format(column[1], space, grain and ", grain" or "",
      worst, column[4], table.concat(shown_cells, " ")))
  end
  assert.same({}, faults)
end

describe("What a film has looks the same", function()
  for _, column in ipairs(COLUMNS) do
    for _, film in ipairs { { "linear", false }, { "srgb", false }, { "linear", true } } do
      if not column.space or column.space == film[1] then
        local name = ("in %s of a film in %s%s"):format(column[1], film[1],
          film[2] and " with grain" or "");
        (column.has ~= false and it or pending)(name, function()
          begin(film)
          check(column)
        end)
      end
    end
  end
end)
