--- The vocabulary of the project; add to it freely: everyday words with one technical meaning, and
--- where.
local words = {}

--- word    as a whole component of a name; -s at its end is left off
--- forms   other components that count as the word
--- means   the one meaning it has
--- places  beginnings of paths below the houses of src/ where names may hold it
--- but     beginnings of paths that are not meant by these
--- say     what to say instead of a word that has no meaning here, and so no places
words.list = {
  -- words that have one meaning, and the places where they may be used
  { word = "cel", means = "a sheet of artwork on the rostrum",
    places = { "model/scene/", "frames/", "writers/", "engine/defocus/", "engine/row/plan",
               "tools/relight/", "tools/recolour/values", "lua/", "program/" } },
  { word = "cell", means = "what lies between two neighbouring boundaries of a row",
    places = { "engine/compose/", "engine/paint/", "engine/area/", "engine/kernel/",
               "engine/row/", "engine/map/", "writers/record/", "engine/defocus/edges",
               "engine/defocus/s", "frames/render/drawings" } },
  { word = "strip", means = "rows of a frame that are made together, by one worker or as a file",
    places = { "frames/render/", "output/png/", "writers/join/", "output/sinks/strip",
               "output/sinks/tga", "output/sinks/span", "output/sinks/file_sink",
               "tools/relight/stack", "frames/film/", "base/pipeline", "model/pictures/",
               "program/" } },
  { word = "band",
    means = "rows of a frame, or node rows of a defocused cel's grid, that are kept together; "
      .. "frequencies of a sound",
    places = { "frames/render/", "engine/defocus/", "engine/sample/defocused",
               "plugins/sound/spectrum" } },
  { word = "pane", means = "a part of a crowded frame, compiled by itself",
    places = { "frames/render/" } },
  { word = "block", means = "64 x 64 texels of a picture, or a block of the deflate format",
    places = { "model/pictures/", "engine/sample/", "engine/paint/painter", "output/deflate/",
               "tools/trace/colours" } },
  { word = "level", means = "a picture halved that many times; how loud a sound is",
    places = { "model/pictures/", "engine/sample/", "tools/track/", "writers/tiles/",
               "program/services/shown", "program/options/", "model/scene/",
               "plugins/sound/spectrum" } },
  { word = "slab", means = "a range of heights inside a row", places = { "engine/area/" } },
  { word = "segment", means = "a straight or parabolic piece of a boundary, or of a deflate stream",
    places = { "model/geometry/", "engine/sweep/", "engine/area/", "engine/events/",
               "engine/kernel/", "engine/defocus/", "output/deflate/" } },
  { word = "window",
    means = "pixels that edges cross, summed together; elsewhere a window of the field",
    places = { "engine/area/", "output/deflate/", "plugins/oiio/", "plugins/raster/",
               "plugins/sound/", "model/pictures/load",
               "engine/kernel/kernel" } },
  { word = "span", means = "neighbouring pixels of a row with one description",
    places = { "engine/span/", "engine/area/", "engine/kernel/", "engine/row/", "engine/paint/",
               "engine/map/",
               "engine/compose/", "model/scene/", "engine/sample/", "engine/defocus/",
               "frames/", "writers/", "tools/relight/", "output/", "lua/", "program/", "video/",
               "model/geometry/nurbs", "output/deflate/", "plugins/oiio/plugin/" } },
  { word = "lane", means = "one number of a register",
    places = { "base/wide", "base/vector", "model/colour/", "model/geometry/polyline",
               "engine/sweep/advance", "engine/paint/", "engine/sample/", "output/" } },
  { word = "knot", means = "a knot of a NURBS curve",
    places = { "model/geometry/", "model/scene/", "lua/", "tools/trace/spline" } },
  { word = "pen", means = "the current point of a path", places = { "model/geometry/" } },
  { word = "crossing", means = "how crossing a boundary changes a winding number",
    places = { "engine/sweep/", "engine/compose/", "engine/area/", "model/geometry/bezier",
               "model/scene/inside" } },
  { word = "stage", means = "a film that is watched, in the process that draws it",
    places = { "program/" } },
  { word = "core", means = "the house that draws, as code of another house sees it",
    places = { "lua/bind/host" } },
  -- words that have no meaning here
  { word = "look", say = "side, term, change or cancelled" },
  { word = "reach", say = "extent, radius, advance or close" },
  { word = "soft", forms = { "soften", "softened", "softness" }, say = "defocus, blur" },
  { word = "shot", say = "plan for the compiled frame, script for the film that is open" },
  { word = "slide", say = "image layer" },
  { word = "leaf", forms = { "leaves" }, means = "a leaf of Huffman's tree",
    places = { "output/deflate/" } },
  { word = "toggle", say = "deferred winding change" },
  { word = "detail", say = "what the index counts" },
  { word = "seen", say = "what is visible, or whose view it is" },
  { word = "stand", forms = { "stood" }, say = "at which place" },
  { word = "hand", say = "worker" },
  { word = "crew", say = "thread pool" },
  { word = "roll", say = "row queue" },
  { word = "reel", say = "frame pipeline" },
  { word = "twin", say = "duplicate" },
  { word = "glimpse", say = "pair of light and transmission" },
  { word = "palette", say = "gradient table" },
  { word = "ramp", means = "a share that grows evenly from column to column",
    places = { "engine/area/direct", "engine/kernel/" } },
  { word = "fragment", say = "segment" },
  { word = "cluster", say = "local sweep" },
  { word = "meeting", say = "intersection" },
  { word = "gather", means = "collecting the layers of a cell that contribute",
    places = { "engine/compose/" } },
  { word = "trace", means = "a picture turned into shapes",
    places = { "tools/trace/", "lua/module/tracing", "program/trace", "program/options/request" } },
  { word = "door", say = "check" },
}

--- The path prefixes by which the types of the biggest subjects are counted.
words.subjects = {
  { name = "exact coverage", "engine/area/" },
  { name = "kernels", "engine/kernel/" },
  { name = "defocus", "engine/defocus/", "engine/sample/defocused", "engine/paint/defocused" },
  { name = "painting", "engine/paint/" },
  { name = "pictures", "model/pictures/", "engine/sample/sampler", "engine/sample/placement" },
  { name = "how a row is driven", "engine/row/" },
}

--- path: below src/, with the house or without it.
function words.begins_with_any(path, beginnings)
  path = path:gsub("^core/", ""):gsub("^kit/", ""):gsub("^desk/", "")
  for _, beginning in ipairs(beginnings or {}) do
    if path:sub(1, #beginning) == beginning then return true end
  end
  return false
end

local entry_of = {}
for _, entry in ipairs(words.list) do
  entry_of[entry.word] = entry
  for _, form in ipairs(entry.forms or {}) do entry_of[form] = entry end
end

--- The entries whose words a name contains although it may not, each once.
function words.misplaced(name, path)
  local list, seen = {}, {}
  for component in name:lower():gmatch "[^_]+" do
    local entry = entry_of[component] or entry_of[component:gsub("s$", "")]
    if entry and not seen[entry] then
      seen[entry] = true
      local is_meant = words.begins_with_any(path, entry.places)
        and not words.begins_with_any(path, entry.but)
      if not is_meant then list[#list + 1] = entry end
    end
  end
  return list
end

return words
