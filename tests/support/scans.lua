-- Scans whose truth is known: a sheet of paper with peg holes and a drawing, turned and shifted on
-- the glass, with grain, dust, the shadow of a binding, and black or white behind it.
--
--   scans.write(path, { seed =, dpi =, turn =, shift = {x, y}, ... })   -- small: the paper, scaled
--   scans.error_of(drawing, scan)   -- millimetres: how far a place of the page is from where it
--                                   -- must lie, at most
--
-- Lengths are millimetres; the paper is 297 x 210, and so is the glass.
local celspan = require "celspan"

local scans = {}

local WIDTH, HEIGHT, PEGS, EDGE = 297, 210, 24, 12 -- PEGS: from the upper edge to the holes
local hole = { { 0, 6.35, 6.35 }, { -101.6, 12.7, 3.2 }, { 101.6, 12.7, 3.2 } }

--- The holes, but those whose numbers are in `missing`.
local function holes_of(texture, missing)
  local list = {}
  for i, h in ipairs(hole) do
    local x, y = WIDTH / 2 + h[1] - h[2] / 2, PEGS - h[3] / 2
    if not missing[i] then
      list[#list + 1] = i == 1 and celspan.circle { centre = { WIDTH / 2, PEGS }, radius = h[2] / 2,
        texture = texture } or celspan.rect { x, y, h[2], h[3], texture = texture }
    end
  end
  return list
end

--- What is drawn: curves in black, and one of each colour, with pressure from 0.2 to 0.7 mm.
local function lines_of(random, colours)
  local list = {}
  for i = 1, 14 do
    local points = {}
    for j = 1, 7 do
      points[j] = { 30 + 237 * random(i .. "x" .. j), 55 + 140 * random(i .. "y" .. j),
        0.25 + 0.45 * random(i .. "w" .. j) }
    end
    list[i] = celspan.stroke { points = points, width = 0.5, cap = "round",
      texture = colours[1 + i % #colours] }
  end
  return list
end

local function dust_of(random, count)
  local list = {}
  for i = 1, count do
    list[i] = celspan.circle { centre = { WIDTH * random("dx" .. i), HEIGHT * random("dy" .. i) },
      radius = 0.05 + 0.06 * random("dr" .. i), texture = "#555" }
  end
  return list
end

--- The scan as a rostrum, in pixels.
function scans.rostrum(scan)
  local random, unit = celspan.random("scan " .. scan.seed), scan.dpi / 25.4
  local bed, tint = scan.bed or "#141414", scan.paper or "#efece4"
  local parts = { celspan.rect { 0, 0, WIDTH, HEIGHT, texture = tint } }
  local function add(list) table.move(list, 1, #list, #parts + 1, parts) end
  add(lines_of(celspan.random("drawing " .. (scan.drawing or scan.seed)),
    scan.colours or { "#262624" }))
  if scan.blank or scan.drawn then parts = { parts[1] } end
  add(scan.drawn or {})
  add(holes_of(bed, scan.missing or {}))
  local sheet = celspan.union(parts)
  if scan.small then sheet = sheet:scale(scan.small, nil, WIDTH / 2, HEIGHT / 2) end
  local paper = sheet:rotate(scan.turn, WIDTH / 2, HEIGHT / 2)
    :translate(scan.shift[1], scan.shift[2])
  if scan.upside then paper = paper:rotate(180, WIDTH / 2, HEIGHT / 2) end
  local over = dust_of(random, scan.dust or 0)
  if scan.shadow then
    over[#over + 1] = celspan.rect { 0, 0, WIDTH, HEIGHT, texture = celspan.linear {
      from = { 0, 0 }, to = { 40, 4 }, { 0, "#000000" .. ("%02x"):format(scan.shadow * 255 // 1) },
      { 1, "#00000000" } } }
  end
  local ground = celspan.rect { -WIDTH, -HEIGHT, 3 * WIDTH, 3 * HEIGHT, texture = bed }
  local all = celspan.union { ground, paper, table.unpack(over) }:scale(unit)
  return celspan.rostrum { celspan.cel { all }, space = "srgb",
    grain = scan.grain and { amount = scan.grain, size = 1.3, seed = scan.seed } or nil }
end

local function packed_tag(id, kind, count, value)
  return ("<I2I2I4I4"):pack(id, kind, count, value)
end

--- An uncompressed TIFF of bytes, `channels` of them with `bits` each, which says its dpi.
local function tiff_of(bytes, w, h, channels, bits, dpi)
  local first = 8 + #bytes + #bytes % 2
  local after = first + 2 + 12 * 12 + 4
  local tags = { packed_tag(256, 4, 1, w), packed_tag(257, 4, 1, h),
    channels == 1 and packed_tag(258, 3, 1, bits) or packed_tag(258, 3, 3, after + 8),
    packed_tag(259, 3, 1, 1), packed_tag(262, 3, 1, channels == 1 and 1 or 2),
    packed_tag(273, 4, 1, 8), packed_tag(277, 3, 1, channels), packed_tag(278, 4, 1, h),
    packed_tag(279, 4, 1, #bytes), packed_tag(282, 5, 1, after), packed_tag(283, 5, 1, after),
    packed_tag(296, 3, 1, 2) }
  return "II*\0" .. ("<I4"):pack(first) .. bytes .. ("\0"):rep(#bytes % 2) .. ("<I2"):pack(#tags)
    .. table.concat(tags) .. ("<I4"):pack(0) .. ("<I4I4I2I2I2"):pack(dpi, 1, bits, bits, bits)
end

--- Writes a scan: PNG, or TIFF by the name's end; grey = true, bits = 8 or 16.
function scans.write(path, scan)
  local w, h = math.floor(WIDTH * scan.dpi / 25.4 + 0.5), math.floor(HEIGHT * scan.dpi / 25.4 + 0.5)
  local image = assert(celspan.pixels(scans.rostrum(scan), { size = { w, h }, film = { w, h } }))
  local bits = scan.bits or 8
  if path:find "png$" then return assert(image:write(path, { depth = bits })) end
  local bytes = image:bytes { depth = bits, colour = "srgb" }
  local one, colour = ("."):rep(bits // 8), ("."):rep(3 * bits // 8)
  bytes = scan.grey and bytes:gsub("(" .. one .. ")" .. colour, "%1")
    or bytes:gsub("(" .. colour .. ")" .. one, "%1")
  local file <close> = assert(io.open(path, "wb"))
  assert(file:write(tiff_of(bytes, w, h, scan.grey and 1 or 3, bits, scan.dpi)))
end

local function turned(x, y, degrees)
  local cosine, sine = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
  return cosine * x - sine * y, sine * x + cosine * y
end

--- to: where the middle of the paper's holes must lie, in pixels; default: that of ACME.
function scans.error_of(drawing, scan, to)
  local unit, most = scan.dpi / 25.4, 0
  local w, h = drawing.width, drawing.height
  to = to or { w / 2, EDGE * unit }
  for _, place in ipairs { { -130, 0 }, { 130, 0 }, { -130, 180 }, { 130, 180 } } do
    local x, y = turned(place[1], place[2] + PEGS - HEIGHT / 2, scan.turn)
    x, y = (x + WIDTH / 2 + scan.shift[1]) * unit, (y + HEIGHT / 2 + scan.shift[2]) * unit
    x, y = turned(x - w / 2, y - h / 2, drawing.turned)
    x, y = x + w / 2 + drawing.offset[1], y + h / 2 + drawing.offset[2]
    local dx, dy = x - to[1] - place[1] * unit, y - to[2] - place[2] * unit
    most = math.max(most, (dx * dx + dy * dy) ^ 0.5 / unit)
  end
  return most
end

--- Scan `i` of many: everything differs.
function scans.any(i, dpi)
  local random = celspan.random("any " .. i)
  return { seed = i, dpi = dpi, turn = 10 * random "turn" - 5,
    shift = { WIDTH * (0.1 * random "x" - 0.05), HEIGHT * (0.1 * random "y" - 0.05) },
    bed = i % 5 == 4 and "#fdfdfd" or nil, grain = 0.01 + 0.03 * random "grain",
    dust = 40, shadow = i % 3 == 0 and 0.25 + 0.25 * random "shadow" or nil,
    colours = i % 4 == 1 and { "#262624", "#c23b38", "#4c9ac6" } or nil,
    grey = i % 4 == 2 or i % 4 == 0, bits = i % 8 < 4 and 8 or 16 }, i % 2 == 0 and "tif" or "png"
end

return scans
