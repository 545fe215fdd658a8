--- celspan tiles SCRIPT|FILE -o DIR: a frame or a picture as a pyramid of tiles.
---
---   shown (a frame of a film, or a picture) + pyramid, plan (which tiles)
---     --> the tiles of an earlier run? --> the tiles that are missing, and their page
local program, request = ...

local TILE_LEAST, TILE_MOST, TILES_MOST = 16, 8192, 200000
local NAME_MOST = 127 -- bytes of the name of a pyramid
local ENDINGS = { png = "png", jpg = "jpg", jpeg = "jpg" }

local path, output = request[1], request.output
if not output then
  program.usage "-o is missing: give -o DIR, the folder for the tiles and their page"
end
if request.viewer then program.find_viewer(request.viewer) end
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
if not ENDINGS[picture:lower()] then program.usage("--picture: '%s' is not png or jpg", picture) end
local top, single = shown:pyramid { layout = layout, tile = tile, overlap = overlap,
  folder = output, name = name, ending = ENDINGS[picture:lower()] }

-- ---------------------------------------------------------------- the plan

local first, last = (request.levels or ""):match "(%d+)%D+(%d+)"
first, last = math.tointeger(first) or is_dzi and 0 or single, math.tointeger(last) or top
if last > top then
  program.usage("--levels %d-%d: a frame of %d x %d pixels has levels 0 to %d", first, last,
    shown.width, shown.height, top)
end
local limit = math.tointeger(request.tiles_limit) or TILES_MOST
local count, deepest, fitting, fitting_count = shown:plan(first, last, limit)
if count then
  local advice = fitting < 0 and "" or ("give --levels %d-%d for %d of them, or "):format(first,
    fitting, fitting_count)
  program.fail("limit", "levels %d to %d have %d tiles, and the limit is %d: %sraise --tiles-limit",
    first, deepest, count, limit, advice)
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
local written, linked, skipped = shown:tiles(shown.title or name)
if request.progress ~= "none" then
  program.note("%d tiles written, %d linked to equal ones, %d left out", written, linked, skipped)
end
