--- SVG drawings compared with other renderers' pictures of them.
--
--   lua5.4 tests/svg/compare.lua FOLDER [PATTERN]     with LUA_PATH and LUA_CPATH as for specs
--
-- FOLDER is that of the sample material; PATTERN selects drawings by their names. The letters of
-- the pictures in svg-w3c are Roboto's: CELSPAN_ROBOTO names the folder of Roboto-Regular.ttf and
-- its faces, by default where Debian's fonts-roboto-unhinted puts them. Films are in "srgb", so
-- that edges are mixed as in the references. A drawing passes when less than 0.5 % of its pixels
-- are off by more than 24 of 255; the others are listed with how much is off and what was skipped.
-- Then come the drawings that differ although nothing was skipped, with the reason for each.
-- Drawings whose picture shows the letters UB are not compared, because no renderer has to match
-- it: the specification does not define the result. The last line is "N of M drawings pass".
local celspan = require "celspan"
local native = require "tests.support.own" "celspan.native"

local MOST_OFF, MOST_SHARE = 24, 0.005
local ALL = "all was drawn"
local ROBOTO = os.getenv "CELSPAN_ROBOTO"
  or "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF"

--- Roboto for every family, in the form that the core expects; empty if it is missing.
local function roboto()
  local list = {}
  for face, name in pairs { [""] = "Regular", [" bold"] = "Bold", [" italic"] = "Italic",
                            [" bold italic"] = "BoldItalic" } do
    local file = ("%s/Roboto-%s.ttf"):format(ROBOTO, name)
    local there = io.open(file, "rb")
    if there then
      there:close()
      list[#list + 1] = { "default" .. face, file }
    end
  end
  return list
end

local fonts = roboto()
if #fonts == 0 then
  print("Roboto is not there: texts are not drawn, and many drawings of svg-w3c are off")
end

local function files_below(folder)
  local list = {}
  local find = assert(io.popen("cd '" .. folder .. "' && find . -name '*.svg' | LC_ALL=C sort"))
  for line in find:lines() do list[#list + 1] = line:sub(3, -5) end
  find:close()
  return list
end

--- The picture of an object over white as codes, rows from the top.
local function codes(object, w, h)
  local white = celspan.rect { 0, 0, w, h, texture = "#fff" }
  local rostrum = celspan.rostrum { celspan.cel { white, object } }
  local film = celspan.film { size = { w, h }, frames = 1, space = "srgb",
                              frame = function() return rostrum end }
  return assert(celspan.pixels(film)):bytes { depth = 8 }
end

--- The share of the pixels in the first `rows` rows that are off.
local function share_off(a, b, w, rows)
  local off = 0
  for y = 0, rows - 1 do
    local at = y * w * 4
    if a:sub(at + 1, at + w * 4) ~= b:sub(at + 1, at + w * 4) then
      for x = at + 1, at + w * 4, 4 do
        local r, g, blue = a:byte(x, x + 2)
        local r2, g2, b2 = b:byte(x, x + 2)
        local most = math.max(math.abs(r - r2), math.abs(g - g2), math.abs(blue - b2))
        if most > MOST_OFF then off = off + 1 end
      end
    end
  end
  return off / (w * rows)
end

--- Why a drawing differs although nothing is skipped; one without a reason here is a fault.
local reasons = {
  ["svg-resvg/shapes/circle/simple-case"] = "the picture has a fringe of a shape that is covered",
  ["svg-resvg/shapes/rect/rx-attribute-clamping"] =
    "the picture has a fringe of a shape that is covered",
  ["svg-resvg/shapes/rect/vmin-and-vmax-values"] =
    "the picture is of a window of 500 px, which the file does not name",
  ["svg-resvg/shapes/rect/vw-and-vh-values"] =
    "the picture is of a window of 500 px, which the file does not name",
  ["svg-resvg/structure/transform-origin/on-image"] =
    "the picture mixes the codes of texels; celspan averages their light",
}

--- Whether the title of a drawing says that the result is undefined: the picture shows UB.
local function is_undefined(svg)
  local file = assert(io.open(svg, "rb"))
  local title = file:read("a"):match "<title>(.-)</title>" or ""
  file:close()
  return title:find("(UB", 1, true) ~= nil
end

local function what_was_skipped(drawing)
  local seen, list = {}, {}
  for _, entry in ipairs(drawing:skipped()) do
    if not seen[entry.what] then
      seen[entry.what] = true
      list[#list + 1] = entry.what
    end
  end
  return #list > 0 and "skipped " .. table.concat(list, ", ") or ALL
end

--- Compares one drawing; returns whether it passes and why not. caption: rows at the bottom that do
--- not count.
local function compare(svg, png, caption)
  local drawing, message = native.read_svg(svg, fonts, "srgb")
  if not drawing then return false, "refused: " .. message:gsub("^.*/", "") end
  local reference = celspan.image { file = png }
  local _, _, w, h = reference:bounds()
  local width, height = drawing:size()
  local sx, sy = width > 0 and w / width or 1, height > 0 and h / height or 1
  local ours = codes(drawing:object():scale(sx, sy), w, h)
  local share = share_off(ours, codes(reference, w, h), w, h - caption)
  return share < MOST_SHARE, ("%.2f %% off, %s"):format(100 * share, what_was_skipped(drawing))
end

--- Features whose drawings are counted by themselves.
local features = { { "mask", "^masking/mask/" }, { "opacity", "^painting/opacity/" },
                   { "mix-blend-mode", "^painting/mix%-blend%-mode/" },
                   { "pattern", "^paint%-servers/pattern/" }, { "filters", "^filters/" } }

local material = assert(arg[1], "the folder of the sample material is missing")
local wanted = arg[2] and arg[2] ~= "all" and arg[2] or nil
local passed, count = 0, 0
local silent = {} -- drawings that differ although nothing was skipped
local undefined = 0

--- Compares one drawing of a side; returns whether it passes.
local function try(side, name)
  local base = ("%s/%s/"):format(material, side.folder)
  local svg, whole = base .. name .. ".svg", side.folder .. "/" .. name
  local ok, is_good, why = pcall(compare, svg, base .. side.png:format(name), side.caption)
  if not ok then is_good, why = false, is_good end
  if not is_good then print(("%s: %s"):format(whole, why)) end
  if not is_good and why:find(ALL, 1, true) then
    silent[#silent + 1] = whole
  end
  for _, feature in ipairs(features) do
    if name:find(feature[2]) then
      feature.count = (feature.count or 0) + 1
      feature.passed = (feature.passed or 0) + (is_good and 1 or 0)
    end
  end
  return is_good
end

for _, side in ipairs {
  { folder = "svg-resvg", png = "%s.png", caption = 0 },
  { folder = "svg-w3c", png = "%s-ref.png", caption = 60 },
} do
  local side_passed, side_count = 0, 0
  for _, name in ipairs(files_below(material .. "/" .. side.folder)) do
    local is_wanted = not wanted or (side.folder .. "/" .. name):find(wanted)
    if is_wanted and is_undefined(("%s/%s/%s.svg"):format(material, side.folder, name)) then
      undefined = undefined + 1
    elseif is_wanted then
      local is_good = try(side, name)
      side_count = side_count + 1
      side_passed = side_passed + (is_good and 1 or 0)
    end
  end
  print(("%s: %d of %d drawings pass"):format(side.folder, side_passed, side_count))
  passed, count = passed + side_passed, count + side_count
end

for _, feature in ipairs(features) do
  if feature.count then
    print(("  %s: %d of %d"):format(feature[1], feature.passed, feature.count))
  end
end
local unexplained = 0
print(("%d drawings are not compared: their pictures show the letters UB"):format(undefined))
print "drawings that differ and nothing was skipped:"
for _, name in ipairs(silent) do
  unexplained = unexplained + (reasons[name] and 0 or 1)
  print(("  %s: %s"):format(name, reasons[name] or "NO REASON"))
end
print(("%d of them, %d without a reason"):format(#silent, unexplained))
print(("%d of %d drawings pass"):format(passed, count))
