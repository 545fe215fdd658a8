--- The vocabulary of the house, to be edited: everyday words that mean one thing, and where.
local words = {}

--- word    as a whole component of a name; -s at its end is left off
--- forms   other components that count as the word
--- means   the one meaning it has
--- places  beginnings of paths below src/ where names may hold it
--- but     beginnings of paths that are not meant by these
--- say     what to say instead of a word that has no meaning here, and so no places
words.list = {
  { word = "look", say = "class, side, term, change or cancelled" },
  { word = "reach", means = "how many pixels a kernel or a blur extends",
    places = { "kernel/", "defocus/", "filter/kernel", "filter/convolve", "filter/soft",
               "render/soft" } },
  { word = "cell", means = "what lies between two neighbouring boundaries of a row",
    places = { "compose/", "paint/", "area/", "kernel/", "row/", "filter/" },
    but = { "filter/soft", "filter/kernel", "kernel/kernel" } },
  { word = "strip", means = "a span that a scan-line procedure gives",
    places = { "scene/scanline", "compose/", "paint/", "area/", "kernel/", "row/", "filter/" } },
  { word = "band", means = "the rows that a worker makes at a time",
    places = { "render/bands", "render/frame", "base/pipeline", "film/" } },
  { word = "block", means = "a block of the deflate format",
    places = { "deflate/", "output/block", "output/deflate", "output/huffman" } },
  { word = "level", means = "a picture halved so many times",
    places = { "pictures/", "sample/", "scene/picture", "compose/sampler", "compose/texels",
               "cli/tile", "cli/pyramid", "cli/request" } },
  { word = "soft", forms = { "soften", "softened", "softness" }, say = "defocus" },
  { word = "shot", say = "plan for the compiled frame, script for the film that is open" },
  { word = "slide", say = "picture layer" },
  { word = "detail", say = "what the index counts" },
  { word = "part", means = "a file under another name until it is whole",
    places = { "output/part.", "output/files/part." } },
  { word = "piece", means = "a straight piece of a boundary",
    places = { "geometry/", "sweep/", "area/", "kernel/", "defocus/", "filter/" } },
  { word = "slice", means = "a part of a row's height between two heights",
    places = { "area/", "defocus/", "filter/area", "filter/window", "filter/soft" } },
  { word = "hold", means = "keeping what is shared in memory while it is read",
    places = { "base/cache", "pictures/", "scene/picture", "defocus/", "filter/soft_bands",
               "compose/soft" } },
  { word = "take", means = "what a sink does with a row or with bytes",
    places = { "output/", "deflate/", "render/", "film/", "bind/", "cli/" } },
  { word = "seen", say = "whose view it is" },
  { word = "stand", forms = { "stood" }, say = "at which place" },
  { word = "turn", means = "where a curve turns back", places = { "geometry/" } },
  { word = "lane", means = "one number of a register",
    places = { "base/wide", "base/vector", "colour/", "sweep/advance", "paint/", "sample/",
               "compose/shade" } },
  { word = "hand", say = "worker" },
  { word = "crew", say = "workers" },
  { word = "knot", means = "a knot of a NURBS curve", places = { "geometry/" } },
  { word = "trace", means = "the edges of a row that are kept for the kernels above and below it",
    places = { "kernel/", "row/", "filter/trace", "filter/gather", "filter/scan" } },
  { word = "pen", means = "what writes the spans of a row", places = { "span/" } },
  { word = "fold", means = "joining layers front to back", places = { "compose/", "paint/" } },
  { word = "door", means = "where what a script gives is checked", places = { "scene/" } },
}

--- What the types of the biggest subjects are counted by: beginnings of paths, of both layouts.
words.subjects = {
  { name = "exact coverage", "area/", "filter/area", "filter/blocks", "filter/carry",
    "filter/cluster", "filter/edges", "filter/meetings", "filter/strokes", "filter/window" },
  { name = "kernels", "kernel/", "filter/kernel", "filter/trace", "filter/convolve",
    "filter/gather" },
  { name = "defocus", "defocus/", "filter/soft", "compose/soft", "render/soft" },
  { name = "painting", "paint/", "compose/blend", "compose/palette", "compose/ramps", "compose/run",
    "compose/shade" },
  { name = "pictures", "pictures/", "sample/", "scene/picture", "compose/sampler",
    "compose/texels" },
  { name = "how a row is driven", "row/", "filter/scan", "filter/centre", "filter/strips" },
}

function words.begins_with_any(path, beginnings)
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

--- The entries whose words a name holds where it may not, each once.
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
