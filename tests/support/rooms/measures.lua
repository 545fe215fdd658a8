--- The figures of a tree's structure, as plain tables.
local circles = require "tests.support.rooms.circles"
local tree_of = require "tests.support.rooms.tree"
local words = require "tests.support.rooms.words"

local measures = {}

--- The value below or at which this share of the list lies.
function measures.quantile(list, share)
  table.sort(list)
  return list[math.max(1, math.ceil(#list * share))] or 0
end

--- { { fn, lines, file }, ... } of all functions with a body.
function measures.functions(tree)
  local list = {}
  for _, file in ipairs(tree.files) do
    for _, fn in ipairs(file.functions) do
      list[#list + 1] = { fn = fn, file = file, lines = fn.last - fn.line + 1 }
    end
  end
  return list
end

--- The kinds that type_counts counts.
measures.type_kinds = { "typedef struct", "struct", "union", "enum" }

--- The number of types of each kind in the files that `is_meant` accepts, and in all files.
function measures.type_counts(tree, is_meant)
  local counts = { all = 0 }
  for _, kind in ipairs(measures.type_kinds) do counts[kind] = 0 end
  for _, file in ipairs(tree.files) do
    for _, type in ipairs(is_meant(file) and file.types or {}) do
      local kind = type.kind == "class" and "struct" or type.kind
      if kind == "struct" and type.is_typedef then kind = "typedef struct" end
      counts[kind], counts.all = counts[kind] + 1, counts.all + 1
    end
  end
  return counts
end

--- The row for a room: files, headers, lines, the longest function, the median of the headers.
function measures.room(tree, room)
  local row = { sources = 0, headers = 0, lines = 0, longest = 0 }
  local header_lines = {}
  for _, file in ipairs(tree.files) do
    if file.room == room then
      row.lines = row.lines + file.lines
      if file.is_header then
        row.headers = row.headers + 1
        header_lines[#header_lines + 1] = file.lines
      else
        row.sources = row.sources + 1
      end
      for _, fn in ipairs(file.functions) do
        row.longest = math.max(row.longest, fn.last - fn.line + 1)
      end
    end
  end
  row.header_median = measures.quantile(header_lines, 0.5)
  return row
end

--- Cycles between "room", "path" or "unit" by their includes; by_use: also by their calls.
function measures.circles(tree, key, by_use)
  local edges = {}
  tree:each_edge(function(from, to)
    local a, b = from[key], to[key]
    edges[a] = edges[a] or {}
    if a ~= b then edges[a][b] = true end
  end, not by_use)
  return circles.find(edges)
end

--- Includes that run up the list of folders: { { file, to, line }, ... }.
function measures.climbs(tree)
  local list, count = {}, 0
  tree:each_edge(function(from, to, include)
    count = count + 1
    if tree:rank(to) > tree:rank(from) then
      list[#list + 1] = { file = from, to = to, line = include.line }
    end
  end, true)
  return list, count
end

--- Whether a function is named after its file: cs_FILE_..., or cs_ROOM_FILE_... if the file's name
--- alone would say little. A file that ends in _wide belongs to the one without; a room in the
--- plural is named in the singular.
local function is_named_by(fn)
  local file, room = fn.file.name:gsub("_wide$", ""), fn.file.room:match "[^/]*$"
  for _, stem in ipairs { file, room .. "_" .. file, room:gsub("s$", "") .. "_" .. file } do
    stem = "cs_" .. stem
    if fn.name == stem or fn.name:sub(1, #stem + 1) == stem .. "_" then return true end
  end
  return false
end

--- The number of functions that other files use, and the number of those that are named after their
--- file.
function measures.naming(tree)
  local used, count, named = {}, 0, 0
  tree:each_edge(function(_, _, edge)
    if edge.file and edge.name:find "^cs_" then used[edge] = true end
  end)
  for fn in pairs(used) do
    count = count + 1
    if is_named_by(fn) then named = named + 1 end
  end
  return count, named
end

--- Declared names that contain a house word in a wrong place: { { entry, file, name }, ... }; and
--- the number of names. Functions count where they are defined; names of the public header do not
--- count.
function measures.misplaced(tree)
  local list, count = {}, 0
  for _, file in ipairs(tree.files) do
    local seen = {}
    for _, name in ipairs(tree_of.is_public(file.room) and {} or file.names) do
      local key = (name.owner or "") .. "." .. name.name
      if name.kind ~= "prototype" and not seen[key] then
        seen[key] = true
        count = count + 1
        for _, entry in ipairs(words.misplaced(name.name, file.path)) do
          list[#list + 1] = { entry = entry, file = file, name = name }
        end
      end
    end
  end
  return list, count
end

return measures
