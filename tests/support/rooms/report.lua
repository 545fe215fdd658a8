--- Prints the figures of a tree's structure as tables of text.
local measures = require "tests.support.rooms.measures"
local walk = require "tests.support.rooms.walk"
local words = require "tests.support.rooms.words"

local report = {}

--- The function that makes a row.
local ROW_MAKER = "cs_row_make"

local function say(format, ...) print(format:format(...)) end

local function title(text) say("\n== %s", text) end

--- A table of rows below their heads: words are left-aligned, numbers right-aligned.
local function put_table(heads, rows)
  local widths = {}
  for _, row in ipairs { heads, table.unpack(rows) } do
    for i, cell in ipairs(row) do widths[i] = math.max(widths[i] or 0, #tostring(cell)) end
  end
  for _, row in ipairs { heads, table.unpack(rows) } do
    local cells = {}
    for i, cell in ipairs(row) do
      local side = type((rows[1] or heads)[i]) == "string" and "-" or ""
      cells[i] = ("%" .. side .. widths[i] .. "s"):format(cell)
    end
    print("   " .. table.concat(cells, "  "))
  end
end

-- ---------------------------------------------------------------- rooms, types

local function put_rooms(tree)
  title "Rooms, from the bottom up"
  local rows, all = {}, { "all", 0, 0, 0, 0, 0 }
  for _, room in ipairs(tree.rooms) do
    local row = measures.room(tree, room)
    rows[#rows + 1] = { room, row.sources, row.headers, row.lines, row.longest, row.header_median }
    for i = 2, 4 do all[i] = all[i] + rows[#rows][i] end
    all[5] = math.max(all[5], row.longest)
  end
  local header_lines = {}
  for _, file in ipairs(tree.files) do
    if file.is_header then header_lines[#header_lines + 1] = file.lines end
  end
  all[6] = measures.quantile(header_lines, 0.5)
  rows[#rows + 1] = all
  put_table({ "room", ".c .cpp", ".h", "lines", "longest function", "header median" }, rows)
  say("   %d files", all[2] + all[3])
end

local function type_row(tree, name, is_meant)
  local counts, row = measures.type_counts(tree, is_meant), { name }
  for _, kind in ipairs(measures.type_kinds) do row[#row + 1] = counts[kind] end
  row[#row + 1] = counts.all
  return row
end

local function put_types(tree)
  local heads = { "room", table.unpack(measures.type_kinds) }
  heads[#heads + 1] = "all"
  title "Types"
  local rows = {}
  for _, room in ipairs(tree.rooms) do
    rows[#rows + 1] = type_row(tree, room, function(file) return file.room == room end)
  end
  rows[#rows + 1] = type_row(tree, "all", function() return true end)
  put_table(heads, rows)
  title "Types by subject"
  heads[1], rows = "subject", {}
  for _, subject in ipairs(words.subjects) do
    rows[#rows + 1] = type_row(tree, subject.name, function(file)
      return words.begins_with_any(file.path, subject)
    end)
  end
  put_table(heads, rows)
end

-- ---------------------------------------------------------------- circles, functions

local function put_circles(tree)
  title "Circles"
  local kinds = {
    { "wing", "wings" }, { "top", "folders" },
    { "room", "rooms, a folder inside a folder being one of its own" },
    { "path", "files" }, { "unit", "units, by their includes" },
    { "unit", "units, by their calls too", true },
  }
  local inside = {}
  for _, kind in ipairs(kinds) do
    local list = measures.circles(tree, kind[1], kind[3])
    say("   %d between %s", #list, kind[2])
    for _, circle in ipairs(list) do
      local room, names = circle[1]:match "^(.*)/" or circle[1], {}
      for i, name in ipairs(circle) do names[i] = i == 1 and name or name:match "[^/]+$" end
      say("      %s", table.concat(names, " <-> "))
      if kind[1] == "unit" and not kind[3] then inside[room] = (inside[room] or 0) + 1 end
    end
  end
  local told = {}
  for _, room in ipairs(tree.rooms) do
    if inside[room] then told[#told + 1] = ("%s %d"):format(room, inside[room]) end
  end
  say("   units, by room: %s", #told > 0 and table.concat(told, ", ") or "none")
  local climbs, count = measures.climbs(tree)
  say("   %d of %d includes run up the list of folders", #climbs, count)
  for _, climb in ipairs(climbs) do
    say("      src/%s:%d: %s", climb.file.path, climb.line, climb.to.path)
  end
end

local function put_functions(tree, limits)
  local list, lines, parameters = measures.functions(tree), {}, {}
  local long, very_long, seven, eight, named = 0, 0, 0, 0, {}
  for i, one in ipairs(list) do
    local count = one.fn.parameters
    lines[i], parameters[i] = one.lines, count
    long = long + (one.lines > limits.most_lines and 1 or 0)
    very_long = very_long + (one.lines > 60 and 1 or 0)
    seven, eight = seven + (count >= 7 and 1 or 0), eight + (count >= 8 and 1 or 0)
    if one.lines > limits.most_lines or count >= limits.most_parameters then
      named[#named + 1] = { one.fn.name, ("%s:%d"):format(one.file.path, one.fn.line), one.lines,
                            count }
    end
  end
  title "Functions"
  say("   %d functions; lines: median %d, p90 %d, most %d; %d over %d, %d over 60", #list,
    measures.quantile(lines, 0.5), measures.quantile(lines, 0.9), lines[#lines], long,
    limits.most_lines, very_long)
  say("   parameters: median %d, p90 %d, most %d; %d have 7 and more, %d have 8 and more",
    measures.quantile(parameters, 0.5), measures.quantile(parameters, 0.9),
    parameters[#parameters], seven, eight)
  table.sort(named, function(a, b)
    if a[3] ~= b[3] then return a[3] > b[3] end
    return a[2] < b[2]
  end)
  put_table({ "function", "where", "lines", "parameters" }, named)
end

-- ---------------------------------------------------------------- names, the way of a row

local function put_names(tree)
  title "Names"
  local count, by_file = measures.naming(tree)
  say("   %d functions are used by other files; %d of them, %.0f %%, are named cs_FILE_...", count,
    by_file, 100 * by_file / math.max(1, count))
  local list, names = measures.misplaced(tree)
  local found = {}
  for _, one in ipairs(list) do
    local here = found[one.entry] or { all = 0, rooms = {} }
    found[one.entry] = here
    here.all = here.all + 1
    here.rooms[one.file.room] = (here.rooms[one.file.room] or 0) + 1
  end
  say("   %d of %d declared names contain a house word where it does not belong", #list, names)
  local rows = {}
  for _, entry in ipairs(words.list) do
    local here, told = found[entry] or { all = 0, rooms = {} }, {}
    for _, room in ipairs(tree.rooms) do
      if here.rooms[room] then told[#told + 1] = ("%s %d"):format(room, here.rooms[room]) end
    end
    rows[#rows + 1] = { entry.word, here.all, " " .. table.concat(told, ", ") }
  end
  for _, row in ipairs(rows) do say("   %-8s %4d %s", table.unpack(row)) end
end

local function put_way(tree, maker)
  title "The way of one row"
  maker = maker or ROW_MAKER
  local told = walk.from(tree, maker)
  if not told then return say("   no function %s", maker) end
  say("   from %s: %d functions in %d files and their headers, %d folders", maker,
    told.functions, told.units, told.rooms)
  say("   %d changes of folder there and back; %d when functions read before count too",
    told.changes, told.all_changes)
  local ways = {}
  for way, count in pairs(told.pairs) do ways[#ways + 1] = ("%3d  %s"):format(count, way) end
  table.sort(ways, function(a, b) return a > b end)
  for _, way in ipairs(ways) do say("      %s", way) end
end

--- The names that contain a house word where it does not belong, with their places.
function report.names(tree, word)
  for _, one in ipairs((measures.misplaced(tree))) do
    if one.entry.word == word then
      local owner = one.name.owner and one.name.owner .. "." or ""
      say("src/%s:%d: %s %s%s", one.file.path, one.name.line, one.name.kind, owner, one.name.name)
    end
  end
end

--- limits: { most_lines, most_parameters, maker }, the last being the function that makes a row.
function report.all(tree, limits)
  put_rooms(tree)
  put_functions(tree, limits)
  put_circles(tree)
  put_types(tree)
  put_names(tree)
  put_way(tree, limits.maker)
end

return report
