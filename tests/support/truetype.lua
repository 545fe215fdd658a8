--- Writes TrueType fonts, variable ones too, for tests and for the font that ships.
---
---   truetype.build { name = "Block", units = 1000, ascent = 800, descent = -200, glyphs = { ... },
---     kerning = { { left, right, value }, ... },
---     ligatures = { { glyph, glyph, ..., result }, ... },
---     axis = { tag = "wght", least = 300, default = 400, most = 900 } } -> bytes
---
--- A glyph is { characters = { 65 }, advance = 600, contours = { { {x, y, is_on}, ... }, ... } },
--- and with an axis `least` and `most`: contours with as many points, and, where its width changes,
--- advances = { least =, most = }. The first one represents missing characters. In place of
--- contours a glyph may have components = { { glyph, dx, dy }, ... }, and so in `least` and `most`:
--- other glyphs that have contours, moved. Numbers in components, `kerning` and `ligatures`
--- are those of glyphs, from 1. Source: OpenType 1.9.
local truetype = {}

local function u16(n) return string.pack(">I2", n & 0xffff) end
local function u32(n) return string.pack(">I4", n & 0xffffffff) end
local function i16(n) return string.pack(">i2", n) end

--- All items, each packed by `pack`, as one text.
local function all(items, pack)
  local parts = {}
  for i, item in ipairs(items) do parts[i] = pack(item) end
  return table.concat(parts)
end

local function padded(bytes, to) return bytes .. ("\0"):rep(-#bytes % to) end

-- ---------------------------------------------------------------- outlines

local function points_of(contours)
  local points = {}
  for _, contour in ipairs(contours) do table.move(contour, 1, #contour, #points + 1, points) end
  return points
end

local function bounds_of(points)
  local box = { math.huge, math.huge, -math.huge, -math.huge }
  for _, p in ipairs(points) do
    box[1], box[2] = math.min(box[1], p[1]), math.min(box[2], p[2])
    box[3], box[4] = math.max(box[3], p[1]), math.max(box[4], p[2])
  end
  return #points > 0 and box or { 0, 0, 0, 0 }
end

--- The bounds of a glyph, also of one that is made of others.
local function glyph_bounds(font, glyph)
  local corners = {}
  for _, part in ipairs(glyph.components or {}) do
    local box = bounds_of(points_of(font.glyphs[part[1]].contours))
    corners[#corners + 1] = { box[1] + part[2], box[2] + part[3] }
    corners[#corners + 1] = { box[3] + part[2], box[4] + part[3] }
  end
  return bounds_of(glyph.components and corners or points_of(glyph.contours))
end

local function composite_entry(font, glyph)
  local parts = {}
  for i, part in ipairs(glyph.components) do -- offsets in words, and whether more parts follow
    parts[i] = u16(i < #glyph.components and 0x23 or 3) .. u16(part[1] - 1) .. i16(part[2])
      .. i16(part[3])
  end
  return padded(i16(-1) .. all(glyph_bounds(font, glyph), i16) .. table.concat(parts), 4)
end

local function glyf_entry(font, glyph)
  if glyph.components then return composite_entry(font, glyph) end
  local points = points_of(glyph.contours)
  if #points == 0 then return "" end
  local ends, flags, xs, ys, count, x, y = {}, {}, {}, {}, 0, 0, 0
  for i, contour in ipairs(glyph.contours) do
    count = count + #contour
    ends[i] = count - 1
  end
  for i, p in ipairs(points) do
    flags[i] = string.char(p[3] and 1 or 0)
    xs[i], ys[i] = i16(p[1] - x), i16(p[2] - y)
    x, y = p[1], p[2]
  end
  return padded(i16(#ends) .. all(bounds_of(points), i16) .. all(ends, u16) .. u16(0)
    .. table.concat(flags) .. table.concat(xs) .. table.concat(ys), 4)
end

local function outlines(font)
  local glyf, loca, at = {}, {}, 0
  for i, glyph in ipairs(font.glyphs) do
    glyf[i], loca[i] = glyf_entry(font, glyph), u32(at)
    at = at + #glyf[i]
  end
  return table.concat(glyf), table.concat(loca) .. u32(at)
end

-- ---------------------------------------------------------------- metrics and names

local function head(font)
  return u32(0x10000) .. u32(0x10000) .. u32(0) .. u32(0x5f0f3cf5) .. u16(3) .. u16(font.units)
    .. ("\0"):rep(16) .. i16(0) .. i16(font.descent) .. i16(font.units) .. i16(font.ascent)
    .. u16(0)
    .. u16(8) .. i16(2) .. i16(1) .. i16(0)
end

local function hhea(font)
  return u32(0x10000) .. i16(font.ascent) .. i16(font.descent) .. i16(0) .. u16(font.units)
    .. ("\0"):rep(22) .. u16(#font.glyphs)
end

local function maxp(font)
  local points, contours, parts = 0, 0, 0
  for _, glyph in ipairs(font.glyphs) do
    points = math.max(points, #points_of(glyph.contours or {}))
    contours = math.max(contours, #(glyph.contours or {}))
    parts = math.max(parts, #(glyph.components or {}))
  end
  return u32(0x10000) .. u16(#font.glyphs) .. u16(points) .. u16(contours) .. u16(points * parts)
    .. u16(contours * parts) .. u16(2) .. ("\0"):rep(12) .. u16(parts) .. u16(parts > 0 and 1 or 0)
end

local function hmtx(font)
  return all(font.glyphs, function(glyph)
    return u16(glyph.advance) .. i16(glyph_bounds(font, glyph)[1])
  end)
end

local function cmap(font)
  local map = {}
  for i, glyph in ipairs(font.glyphs) do
    for _, character in ipairs(glyph.characters or {}) do map[#map + 1] = { character, i - 1 } end
  end
  table.sort(map, function(a, b) return a[1] < b[1] end)
  local groups = all(map, function(one) return u32(one[1]) .. u32(one[1]) .. u32(one[2]) end)
  return u16(0) .. u16(1) .. u16(3) .. u16(10) .. u32(12)
    .. u16(12) .. u16(0) .. u32(16 + #groups) .. u32(0) .. u32(#map) .. groups
end

local function utf16(text)
  return (text:gsub(".", "\0%0"))
end

local function name(font)
  local texts = { [1] = font.name, [2] = "Regular", [4] = font.name, [6] = font.name:gsub(" ", "") }
  if font.axis then texts[256] = font.axis.name or font.axis.tag end
  local ids = {}
  for id in pairs(texts) do ids[#ids + 1] = id end
  table.sort(ids)
  local at, storage = 0, all(ids, function(id) return utf16(texts[id]) end)
  return u16(0) .. u16(#ids) .. u16(6 + 12 * #ids) .. all(ids, function(id)
    local size = 2 * #texts[id]
    at = at + size
    return u16(3) .. u16(1) .. u16(0x409) .. u16(id) .. u16(size) .. u16(at - size)
  end) .. storage
end

local function os2(font)
  return u16(4) .. i16(font.units // 2) .. u16(400) .. u16(5) .. u16(0) .. ("\0"):rep(20) .. i16(0)
    .. ("\0"):rep(10) .. ("\0"):rep(16) .. "NONE" .. u16(64) .. u16(32) .. u16(0xfffd)
    .. i16(font.ascent) .. i16(font.descent) .. i16(0) .. u16(font.ascent) .. u16(-font.descent)
    .. ("\0"):rep(8) .. i16(font.x_height or font.units // 2)
    .. i16(font.cap_height or font.ascent) .. u16(0) .. u16(32) .. u16(2)
end

local function post() return u32(0x30000) .. ("\0"):rep(28) end

-- ---------------------------------------------------------------- pairs and ligatures

local function kern(font)
  local pairs_of = all(font.kerning, function(one)
    return u16(one[1] - 1) .. u16(one[2] - 1) .. i16(one[3])
  end)
  return u16(0) .. u16(1) .. u16(0) .. u16(14 + #pairs_of) .. u16(1) .. u16(#font.kerning)
    .. ("\0"):rep(6) .. pairs_of
end

--- One ligature of glyphs; no other ligature begins with the first of them.
local function ligature_set(one)
  local rest = table.move(one, 2, #one - 1, 1, {})
  return u16(1) .. u16(4) .. u16(one[#one] - 1) .. u16(#one - 1)
    .. all(rest, function(glyph) return u16(glyph - 1) end)
end

--- One lookup of ligatures under the feature "liga" of every script.
local function gsub(font)
  local list = table.move(font.ligatures, 1, #font.ligatures, 1, {})
  table.sort(list, function(a, b) return a[1] < b[1] end)
  local sets, offsets, at = {}, {}, 6 + 2 * #list
  for i, one in ipairs(list) do
    sets[i], offsets[i] = ligature_set(one), u16(at)
    at = at + #sets[i]
  end
  local coverage = u16(1) .. u16(#list) .. all(list, function(one) return u16(one[1] - 1) end)
  local subtable = u16(1) .. u16(at) .. u16(#list) .. table.concat(offsets) .. table.concat(sets)
    .. coverage
  local scripts = u16(1) .. "DFLT" .. u16(8) .. u16(4) .. u16(0) .. u16(0) .. u16(0xffff) .. u16(1)
    .. u16(0)
  local features = u16(1) .. "liga" .. u16(8) .. u16(0) .. u16(1) .. u16(0)
  local lookups = u16(1) .. u16(4) .. u16(4) .. u16(0) .. u16(1) .. u16(8) .. subtable
  return u32(0x10000) .. u16(10) .. u16(10 + #scripts) .. u16(10 + #scripts + #features) .. scripts
    .. features .. lookups
end

-- ---------------------------------------------------------------- variations

local function fixed(value) return u32(math.floor(value * 65536)) end

local function fvar(font)
  local axis = font.axis
  return u32(0x10000) .. u16(16) .. u16(2) .. u16(1) .. u16(20) .. u16(0) .. u16(8) .. axis.tag
    .. fixed(axis.least) .. fixed(axis.default) .. fixed(axis.most) .. u16(0) .. u16(256)
end

local function i8(n) return string.pack(">i1", n) end

--- Differences in runs of at most 64, as bytes if they fit, otherwise as words. The last four
--- points are those of the metrics; the second of them is the advance, which grows by `wider`.
local function packed(from, to, place, wider)
  local values, most = {}, math.abs(wider)
  for i = 1, #from do
    values[i] = to[i][place] - from[i][place]
    most = math.max(most, math.abs(values[i]))
  end
  table.move({ 0, wider, 0, 0 }, 1, 4, #values + 1, values)
  local parts = {}
  for first = 1, #values, 64 do
    local last = math.min(first + 63, #values)
    parts[#parts + 1] = string.char((most > 127 and 0x40 or 0) | last - first)
      .. all(table.move(values, first, last, 1, {}), most > 127 and i16 or i8)
  end
  return table.concat(parts)
end

--- The points of a form of a glyph that change: of a composite, how far its parts are moved.
local function changing(glyph, form)
  if not glyph.components then return points_of(glyph[form]) end
  local offsets = {}
  for i, part in ipairs(glyph[form] or {}) do offsets[i] = { part[2], part[3] } end
  return offsets
end

--- The changes of a glyph towards the least and the greatest value of the axis, for all its points.
local function gvar_entry(glyph)
  local from = changing(glyph, glyph.components and glyph.least and "components" or "contours")
  if #from == 0 and not glyph.advances then return "" end
  local headers, data = {}, {}
  for i, peak in ipairs { -1, 1 } do
    local form = peak < 0 and "least" or "most"
    local to, wider = changing(glyph, form), 0
    if glyph.advances then wider = glyph.advances[form] - glyph.advance end
    data[i] = "\0" .. packed(from, to, 1, wider) .. packed(from, to, 2, 0)
    headers[i] = u16(#data[i]) .. u16(0xa000) .. i16(peak * 0x4000)
  end
  return padded(u16(2) .. u16(4 + #headers[1] * 2) .. table.concat(headers) .. table.concat(data),
    2)
end

local function gvar(font)
  local entries, offsets, at = {}, {}, 0
  for i, glyph in ipairs(font.glyphs) do
    entries[i], offsets[i] = gvar_entry(glyph), u32(at)
    at = at + #entries[i]
  end
  local start = 20 + 4 * (#entries + 1)
  return u32(0x10000) .. u16(1) .. u16(0) .. u32(start) .. u16(#entries) .. u16(1) .. u32(start)
    .. table.concat(offsets) .. u32(at) .. table.concat(entries)
end

-- ---------------------------------------------------------------- the file

local function checksum(bytes)
  local sum = 0
  for word in padded(bytes, 4):gmatch "...." do
    sum = sum + string.unpack(">I4", word) & 0xffffffff
  end
  return sum
end

--- tables by tag -> the bytes of a font.
function truetype.join(tables)
  local tags = {}
  for tag in pairs(tables) do tags[#tags + 1] = tag end
  table.sort(tags)
  local directory, bodies, at = {}, {}, 12 + 16 * #tags
  local range, selector = 16, 0
  while range * 2 <= 16 * #tags do range, selector = range * 2, selector + 1 end
  for i, tag in ipairs(tags) do
    local body = tables[tag]
    directory[i] = tag .. u32(checksum(body)) .. u32(at) .. u32(#body)
    bodies[i] = padded(body, 4)
    at = at + #bodies[i]
  end
  return u32(0x10000) .. u16(#tags) .. u16(range) .. u16(selector) .. u16(16 * #tags - range)
    .. table.concat(directory) .. table.concat(bodies)
end

--- The tables of a font by tag.
function truetype.tables(font)
  local glyf, loca = outlines(font)
  local tables = { head = head(font), hhea = hhea(font), maxp = maxp(font), hmtx = hmtx(font),
    cmap = cmap(font), glyf = glyf, loca = loca, name = name(font), post = post(),
    ["OS/2"] = os2(font) }
  if font.kerning then tables.kern = kern(font) end
  if font.ligatures then tables.GSUB = gsub(font) end
  if font.axis then tables.fvar, tables.gvar = fvar(font), gvar(font) end
  return tables
end

function truetype.build(font) return truetype.join(truetype.tables(font)) end

return truetype
