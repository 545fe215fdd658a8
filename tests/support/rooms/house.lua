--- The size of the house in a dozen figures, to compare two trees:
--- `lua5.4 tests/support/rooms.lua --house [ROOT]`.
local measures = require "tests.support.rooms.measures"

local house = {}

--- Headers that only one unit includes, apart from the unit of the header's own name. Tests count
--- as users: a header included by a test is an interface.
function house.single_user_headers(tree, root)
  local users = {}
  for _, file in ipairs(tree.files) do
    for _, include in ipairs(file.includes) do
      local header = tree.named[include.name]
      if header and header.unit ~= file.unit then
        users[header] = users[header] or {}
        users[header][file.unit] = true
      end
    end
  end
  for name in house.test_includes(root) do
    local header = tree.named[name]
    if header then
      users[header] = users[header] or {}
      users[header].tests = true
    end
  end
  local list = {}
  for _, file in ipairs(tree.files) do
    local count = 0
    for _ in pairs(users[file] or {}) do count = count + 1 end
    if file.is_header and file.house ~= "include" and count <= 1 then
      list[#list + 1] = file.path
    end
  end
  return list
end

--- The names between quotes that the C files of tests/ include.
function house.test_includes(root)
  local pipe = assert(io.popen(("cd '%s' && grep -rhoE '^#include \"[^\"]+\"' tests examples "
    .. "--include=*.c --include=*.h --include=*.cpp"):format(root)))
  local text = pipe:read("a")
  pipe:close()
  return text:gmatch '"([^"]+)"'
end

--- The places that round to single precision by two casts in a row, "base/a.c:1". Why these are
--- faults says cs_number_single.
function house.roundings(tree)
  local list = {}
  for _, file in ipairs(tree.files) do
    for i, word in ipairs(file.text) do
      local casts = word == "float" and table.concat(file.text, "", math.max(1, i - 4), i)
      if casts == "(double)(float" then
        list[#list + 1] = ("%s:%d"):format(file.path, file.line[i])
      end
    end
  end
  return list
end

--- The types that headers declare and leave to a source to define: declared[name] = true.
local function opaque_types(tree)
  local declared = {}
  for _, file in ipairs(tree.files) do
    local defined = {}
    for _, one in ipairs(file.types) do defined[one.name] = true end
    for _, name in ipairs(file.is_header and file.names or {}) do
      if name.kind == "type" and not defined[name.name] then declared[name.name] = true end
    end
  end
  return declared
end

--- Names of types that are defined in two places: { { name, place, place }, ... }. An opaque type,
--- which a header declares and only sources define, is one type, no matter how many sources
--- implement it.
function house.doubled_types(tree)
  local is_opaque, in_header = opaque_types(tree), {}
  local places, list = {}, {}
  for _, file in ipairs(tree.files) do
    for _, one in ipairs(file.types) do
      local place = ("%s:%d"):format(file.path, one.line)
      if one.name:find "^cs_" or one.name:find "^celspan_" then
        places[one.name] = places[one.name] or {}
        table.insert(places[one.name], place)
        in_header[one.name] = in_header[one.name] or file.is_header
      end
    end
  end
  for name, found in pairs(places) do
    local is_one = is_opaque[name] and not in_header[name]
    if #found > 1 and not is_one then
      list[#list + 1] = name .. ": " .. table.concat(found, ", ")
    end
  end
  table.sort(list)
  return list
end

local function folder_count(tree)
  local seen, count = {}, 0
  for _, file in ipairs(tree.files) do
    if not seen[file.wing] then seen[file.wing], count = true, count + 1 end
  end
  return count
end

--- The only allowed recursion: a rostrum may be an object of a cel, so cels, objects and rostrums
--- hash and release each other. The scene's types are declared with them.
local RECURSION = "core/model/scene/cel core/model/scene/operands "
  .. "core/model/scene/primitive_data core/model/scene/rostrum core/model/scene/scene"

--- The circles of units by their calls, except the one that is allowed.
function house.circles(tree)
  local list = {}
  for _, circle in ipairs(measures.circles(tree, "unit", true)) do
    if table.concat(circle, " ") ~= RECURSION then list[#list + 1] = circle end
  end
  return list
end

function house.put(tree, root)
  local lines, program = 0, 0
  for _, file in ipairs(tree.files) do
    lines = lines + file.lines
    if file.wing == "desk/program" then program = program + 1 end
  end
  local headers = house.single_user_headers(tree, root)
  local doubled = house.doubled_types(tree)
  local circles = house.circles(tree)
  local function say(name, figure) print(("%6d  %s"):format(figure, name)) end
  say("files of C and C++ in src", #tree.files)
  say("lines of them", lines)
  say("folders in src", folder_count(tree))
  say("files of the program", program)
  say("headers with one user", #headers)
  for _, path in ipairs(headers) do print("          " .. path) end
  say("type names that are defined twice", #doubled)
  for _, text in ipairs(doubled) do print("          " .. text) end
  say("circles of units, by calls, without a rostrum in a cel", #circles)
  for _, circle in ipairs(circles) do print("          " .. table.concat(circle, " <-> ")) end
end

return house
