--- The artwork of the sample material compared with librsvg's pictures of it.
--
--   lua5.4 tests/svg/clipart.lua MATERIAL [PATTERN]     with LUA_PATH and LUA_CPATH as for specs
--
-- PATTERN selects drawings by their names. The longer side of a drawing is SIDE pixels, and it lies
-- over white. librsvg draws it six times larger, and the codes are averaged: at the same size its
-- pictures have seams between shapes that abut. A drawing agrees when 97 % of its pixels are off by
-- at most 24 of 255. The others are listed with what was skipped, then the one that agrees least.
-- The last line is "N of M drawings agree". Needs rsvg-convert (Debian's librsvg2-bin).
local celspan = require "celspan"
local svg = require "celspan.svg"
local system = require "tests.support.system"

local SIDE, TIMES = 256, 6
-- What librsvg uses in place of fonts that are not installed (Debian's fonts-dejavu-core).
local FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
local MOST_OFF, LEAST_SHARE = 24, 0.97

local function film(w, h, object)
  local white = celspan.rect { 0, 0, w, h, texture = "#fff" }
  local rostrum = celspan.rostrum { celspan.cel { white, object } }
  return celspan.film { size = { w, h }, frames = 1, space = "srgb",
                        frame = function() return rostrum end }
end

--- The codes of a drawing of this size.
local function ours(art, w, h)
  local object = art.object:scale(w / art.width, h / art.height)
  return assert(celspan.pixels(film(w, h, object))):bytes { depth = 8 }
end

--- The same by librsvg. As linear light, codes are averaged as they are.
local function theirs(path, w, h)
  local png = os.tmpname()
  local ok = os.execute(("rsvg-convert --unlimited -b white -w %d -h %d '%s' -o %s 2>/dev/null")
    :format(TIMES * w, TIMES * h, path, png))
  if not ok then return nil, "librsvg refuses it" end
  local large = celspan.image { file = png, colour = "linear", x = 0, y = 0, w = w, h = h }
  local rostrum = celspan.rostrum { celspan.cel { large } }
  local image = assert(celspan.pixels(rostrum, { size = { w, h }, film = { w, h } }))
  os.remove(png)
  return image:bytes { depth = 8, colour = "linear" }
end

local function share_near(a, b)
  local near = 0
  for x = 1, #a, 4 do
    local r, g, blue = a:byte(x, x + 2)
    local r2, g2, b2 = b:byte(x, x + 2)
    local most = math.max(math.abs(r - r2), math.abs(g - g2), math.abs(blue - b2))
    if most <= MOST_OFF then near = near + 1 end
  end
  return near / (#a // 4)
end

local function skipped(art)
  local seen, list = {}, {}
  for _, entry in ipairs(art.skipped) do
    if not seen[entry.what] then
      seen[entry.what], list[#list + 1] = true, entry.what
    end
  end
  return #list > 0 and "skipped " .. table.concat(list, ", ") or "all was drawn"
end

--- The share of the pixels that are near, and how a drawing is off; nil and the reason if librsvg
--- does not draw it.
local function compare(path)
  local art, message = svg.read(path, { fonts = { default = FONT } })
  if not art then return 0, "refused: " .. message end
  local scale = SIDE / math.max(art.width, art.height)
  local w = math.max(1, math.floor(art.width * scale + 0.5))
  local h = math.max(1, math.floor(art.height * scale + 0.5))
  local reference, why = theirs(path, w, h)
  if not reference then return nil, why end
  local share = share_near(ours(art, w, h), reference)
  return share, ("%.2f %% near, %s"):format(100 * share, skipped(art))
end

local material, pattern = assert(arg[1], "the folder of the sample material is missing"), arg[2]
local agree, count, least = 0, 0, { share = 1 }
for _, path in ipairs(system.lines(("ls '%s'/artwork-*/*.svg"):format(material))) do
  local name = path:match "([^/]*/[^/]*)%.svg$"
  if not pattern or name:find(pattern) then
    local share, how = compare(path)
    if not share or share < LEAST_SHARE then print(name .. ": " .. how) end
    count = count + (share and 1 or 0)
    agree = agree + (share and share >= LEAST_SHARE and 1 or 0)
    if share and share < least.share then least = { share = share, name = name } end
  end
end
if least.name then
  print(("%s agrees least: in %.2f %% of its pixels"):format(least.name, 100 * least.share))
end
print(("%d of %d drawings agree"):format(agree, count))
