--- celspan tiles SCRIPT|FILE -o DIR: a frame or a picture as a pyramid of tiles.
---
---   shown (a frame of a film, or a picture) + pyramid, jobs (which tiles)
---     --> the tiles of an earlier run? --> the tiles that are missing --> their page
local program, request = ...

local TILE_LEAST, TILE_MOST, TILES_MOST = 16, 8192, 200000
local NAME_MOST = 127 -- bytes of the name of a pyramid
local PLACE_NAME_MOST = 95 -- bytes
local PLACE_WIDTH, PLACE_HEIGHT = 2560, 1440 -- pixels made around a place: a large screen
local OPENSEADRAGON = "/openseadragon/openseadragon.min.js" -- below the folder of the page
local ENDINGS = { png = "png", jpg = "jpg", jpeg = "jpg" }

local path, output = request[1], request.output
if not output then
  program.usage "-o is missing: give -o DIR, the folder for the tiles and their page"
end

--- The bytes of a file; nil, what failed, and the reason of the system.
local function read(file_path)
  local file, message = io.open(file_path, "rb")
  if not file then return nil, "opened", message:sub(#file_path + 3) end
  local bytes, reason = file:read "a"
  file:close()
  return bytes, "read", reason
end

--- The script of OpenSeadragon, from its file, its folder, or the folder that it was built in.
local function find_viewer(from)
  for _, place in ipairs { "", "/openseadragon.min.js", "/build" .. OPENSEADRAGON } do
    local viewer = (from .. place):find "%.js$" and read(from .. place) or ""
    if viewer ~= "" then return viewer end
  end
  program.fail("input", "--viewer %s: it contains no readable openseadragon.min.js", from)
end

local viewer = request.viewer and find_viewer(request.viewer)
local is_film = request.script or program.is_film(path) or program.has_ending(path, ".lua")
if not is_film then program.refuse_rights() end
local shown = program.shown(path, is_film)
local base = path:match "[^/]*$"
local name = (base:match "^(.+)%.[^.]*$" or base):sub(1, NAME_MOST)

-- ---------------------------------------------------------------- the pyramid

local layout = request.format or "dzi"
local is_dzi = layout == "dzi"
local tile = math.tointeger(request.tile) or is_dzi and 254 or 512
local overlap = math.tointeger(request.overlap) or is_dzi and 1 or 0
local picture = request.picture or "png"
if tile < TILE_LEAST or tile > TILE_MOST then
  program.usage("--tile %d: a tile has %d to %d pixels a side", tile, TILE_LEAST, TILE_MOST)
end
if not is_dzi and overlap > 0 then
  program.usage "--overlap is only for --format dzi: the tiles of IIIF share no pixels"
end
if overlap > tile // 2 then
  program.usage("--overlap %d: it can be half of a tile's %d pixels at most", overlap, tile)
end
if request.sparse and overlap < 1 then
  program.usage "--sparse needs --format dzi and --overlap 1 or more"
end
local ending = ENDINGS[picture:lower()]
if not ending then program.usage("--picture: '%s' is not png or jpg", picture) end
local top, single = shown:pyramid { layout = layout, tile = tile, overlap = overlap,
  folder = output, name = name, ending = ending }

-- ---------------------------------------------------------------- places

--- A line "X Y WIDTH NAME", in film units: the centre, and the width to show; nil: it is no place.
local function place_of(line)
  local x, y, width, label = line:match "^%s*(%S+)%s+(%S+)%s+(%S+)%s+([^\r]+)"
  x, y, width = tonumber(x), tonumber(y), tonumber(width)
  if not (x and y and width) or #label > PLACE_NAME_MOST then return nil end
  local is_inside = x >= 0 and x <= shown.film_width and y >= 0 and y <= shown.film_height
  return is_inside and width > 0 and width < math.huge
    and { x = x, y = y, width = width, label = label } or nil
end

local function read_places(file_path)
  local text, what, why = read(file_path)
  if not text then program.fail("input", "%s: cannot be %s: %s", file_path, what, why) end
  local places, number = {}, 0
  for line in text:gmatch "[^\n]*" do
    number = number + 1
    if line:find "^%s*[^%s#]" then
      places[#places + 1] = place_of(line) or program.usage("%s:%d: a place is X Y WIDTH NAME, "
        .. "within the film of %g x %g units", file_path, number, shown.film_width,
        shown.film_height)
    end
  end
  return places
end

local function clamp(pixel, least, most)
  return math.floor(math.max(least, math.min(most, pixel)))
end

--- The pixels of the frame that a screen shows around a place at a level.
local function around(place, level)
  local x, y = place.x / shown.film_width * shown.width, place.y / shown.film_height * shown.height
  local across, down = PLACE_WIDTH / 2 * 2 ^ (top - level), PLACE_HEIGHT / 2 * 2 ^ (top - level)
  return clamp(x - across, 0, shown.width - 1), clamp(y - down, 0, shown.height - 1),
    clamp(x + across, 1, shown.width), clamp(y + down, 1, shown.height)
end

-- ---------------------------------------------------------------- the plan

local first, last = (request.levels or ""):match "(%d+)%D+(%d+)"
first, last = math.tointeger(first) or is_dzi and 0 or single, math.tointeger(last) or top
if last > top then
  program.usage("--levels %d-%d: a frame of %d x %d pixels has levels 0 to %d", first, last,
    shown.width, shown.height, top)
end
local places = request.places and read_places(request.places) or {}
local jobs, count = {}, 0

--- Adds tiles of a level: all, or those at some pixels of the frame.
local function add(level, ...)
  local x0, y0, x1, y1 = shown:touched(level, ...)
  jobs[#jobs + 1], count = { level, x0, y0, x1, y1 }, count + (x1 - x0) * (y1 - y0)
end

local limit = math.tointeger(request.tiles_limit) or TILES_MOST
local fitting, fitting_count -- the last level up to which there are no more tiles than the limit
for level = first, top do
  if level <= last then add(level) end
  if level <= last and count <= limit then fitting, fitting_count = level, count end
  for _, place in ipairs(level > last and places or {}) do add(level, around(place, level)) end
end
if count > limit then
  local advice = fitting and ("give --levels %d-%d for %d of them, or "):format(first, fitting,
    fitting_count) or ""
  program.fail("limit", "levels %d to %d have %d tiles, and the limit is %d: %sraise --tiles-limit",
    first, jobs[#jobs][1], count, limit, advice)
end

-- ---------------------------------------------------------------- the run

local state = shown:find_tiles()
if request.fresh and (state == "same" or state == "other") then
  shown:clear_tiles()
elseif state == "foreign" then
  program.usage("%s already holds a %s%s that was not made by celspan tiles: give another folder",
    output, name, is_dzi and "_files" or "")
elseif state == "other" then
  program.usage("%s holds tiles of another scene or of other options: give --fresh to remove them, "
    .. "or another folder", output)
end
local written, linked, skipped, background, rows = shown:tiles(jobs)

-- ---------------------------------------------------------------- the description

local DZI = [[
<?xml version="1.0" encoding="UTF-8"?>
<Image xmlns="http://schemas.microsoft.com/deepzoom/2008" Format="%s" Overlap="%d" TileSize="%d">
  <Size Width="%d" Height="%d"/>
</Image>
]]

-- Static files do not know their address on a server: users write it into "id".
local IIIF = [[
{
  "@context": "http://iiif.io/api/image/3/context.json",
  "id": "http://localhost:8000/%s",
  "type": "ImageService3",
  "protocol": "http://iiif.io/api/image",
  "profile": "level0",
  "width": %d,
  "height": %d,
  "tiles": [{ "width": %d, "height": %d, "scaleFactors": [%s] }],
  "sizes": [{ "width": %d, "height": %d }]%s
}
]]

local function describe_iiif()
  local factors, most = {}, 1 << (top - single)
  for level = top, single, -1 do factors[#factors + 1] = 1 << (top - level) end
  local address = name:gsub('[ %%"\\<>?#]', function(one) return ("%%%02X"):format(one:byte()) end)
  return IIIF:format(address, shown.width, shown.height, tile, tile, table.concat(factors, ", "),
    (shown.width + most - 1) // most, (shown.height + most - 1) // most, ending == "jpg" and ""
    or (',\n  "preferredFormats": ["%s"],\n  "extraFormats": ["%s"]'):format(ending, ending))
end

-- ---------------------------------------------------------------- the page

--- A string of JSON inside a script element: nothing in it can end the element or begin a tag.
local function quoted(text)
  return '"' .. text:gsub('[%c"\\<>&]', function(one) return ("\\u%04x"):format(one:byte()) end)
    .. '"'
end

--- The existing tiles, as rectangles [level, row, end of rows, column, end of columns].
local function coverage()
  local list, box = {}, {}
  for _, row in ipairs(rows) do
    if row[1] == box[1] and row[2] == box[3] and row[3] == box[4] and row[4] == box[5] then
      box[3] = box[3] + 1
    else
      box = { row[1], row[2], row[2] + 1, row[3], row[4] }
      list[#list + 1] = box
    end
  end
  for i, one in ipairs(list) do list[i] = ("[%d,%d,%d,%d,%d]"):format(table.unpack(one)) end
  return table.concat(list, ",")
end

--- The places, in pixels of the frame.
local function placed()
  local list = {}
  local across, down = shown.width / shown.film_width, shown.height / shown.film_height
  for i, place in ipairs(places) do
    list[i] = ("\n    [%.9g, %.9g, %.9g, %s]"):format(place.x * across, place.y * down,
      place.width * across, quoted(place.label))
  end
  return table.concat(list, ",")
end

local DATA = [[
{
  "name": %s,
  "title": %s,
  "layout": "%s", "ending": "%s", "background": "%s",
  "openseadragon": %s,
  "width": %d, "height": %d, "tile": %d, "overlap": %d,
  "places": [%s],
  "tiles": [%s]
}]]

if viewer then program.save(output .. OPENSEADRAGON, viewer) end
if is_dzi then
  program.save(output .. "/" .. name .. ".dzi", DZI:format(ending, overlap, tile, shown.width,
    shown.height))
else
  program.save(output .. "/" .. name .. "/info.json", describe_iiif())
end
program.save(output .. "/index.html", (program.text "tiles.html":gsub("@(%u+)@", {
  VIEWER = program.text "viewer.js",
  PYRAMID = DATA:format(quoted(name), quoted(shown.title or name), layout,
    ending, background, read(output .. OPENSEADRAGON) ~= nil, shown.width,
    shown.height, tile, overlap, placed(), coverage()),
})))
if request.progress ~= "none" then
  program.note("%d tiles written, %d linked to equal ones, %d left out", written, linked, skipped)
end
