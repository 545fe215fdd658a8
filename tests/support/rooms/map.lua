--- The folders of src/ with a sentence each, from the bottom up: `./run map`; and the units of some
--- of them: `./run map FOLDER`.
local modules = require "tests.support.rooms.modules"
local units_of_folder = require("tests.support.rooms.units").of

local map = {}

--- The folders of Lua, from the bottom up.
local function lua_folders(root)
  local list = modules.folders(root)
  list[#list + 1] = "src/desk/program/verbs"
  return list
end

--- The single sentence of a folder, from its folder.md; nil if there is none.
local function sentence_of(root, folder)
  local file = io.open(("%s/%s/folder.md"):format(root, folder))
  if not file then return end
  local text = file:read("a"):gsub("%s+", " "):gsub(" $", "")
  file:close()
  return text
end

--- The wings and the folders in them, in the order in which they may include each other.
local function folders(tree)
  local list, is_listed = {}, {}
  local function add(folder)
    if not is_listed[folder] then list[#list + 1] = folder end
    is_listed[folder] = true
  end
  for _, room in ipairs(tree.rooms) do
    add(room:match "^[^/]+")
    add(room:match "^[^/]+/[^/]+")
    if not room:find "^%a+/include/" then add(room) end
  end
  return list
end

local function units_of(tree, folder)
  local units, lines, is_counted = 0, 0, {}
  for _, file in ipairs(tree.files) do
    if file.room == folder then
      lines = lines + file.lines
      units = units + (is_counted[file.unit] and 0 or 1)
      is_counted[file.unit] = true
    end
  end
  return units, lines
end

--- Text in lines of at most `width` characters.
local function wrapped(text, width)
  local lines, line = {}, ""
  for word in text:gmatch "%S+" do
    if #line + #word + 1 > width and line ~= "" then
      lines[#lines + 1], line = line, ""
    end
    line = line == "" and word or line .. " " .. word
  end
  lines[#lines + 1] = line
  return lines
end

local function put_wrapped(label, text, width)
  local lines = wrapped(text, width)
  print(label .. lines[1])
  for i = 2, #lines do print((" "):rep(#label) .. lines[i]) end
end

--- The folders of src/ with their figures; of one house alone, if `house` is given.
local function put_folders(tree, root, house)
  print(("%-24s %5s %6s"):format("folder", "units", "lines"))
  for _, folder in ipairs(folders(tree)) do
    local is_house = not folder:find "/"
    local units, lines = units_of(tree, folder)
    local name = is_house and folder .. "/" or "  " .. folder:match "/(.*)" .. "/"
    local figures = units > 0 and ("%5d %6d"):format(units, lines) or (" "):rep(12)
    if not house or folder:match "^[^/]+" == house then
      if is_house then print() end
      put_wrapped(("%-24s %s  "):format(name, figures), sentence_of(root, "src/" .. folder) or "",
        61)
    end
  end
end

--- Where the lines are that are shipped: sources of all languages, without tests and without what
--- is generated.
local SHIPPED = {
  { "core", "src/core subprojects/spanfile/include subprojects/spanfile/src" },
  { "kit", "src/kit subprojects/planefile/include subprojects/planefile/src "
    .. "subprojects/planefile/wasm" },
  { "desk", "src/desk" },
  { "lua/celspan", "lua" },
}

local function put_lines(root)
  print "Shipped lines (.c .h .cpp .lua .js .html .css, without tests):\n"
  local sum = 0
  for _, place in ipairs(SHIPPED) do
    local find = "cd '%s' && find %s -name '*.[ch]' -o -name '*.cpp' -o -name '*.lua' "
      .. "-o -name '*.js' -o -name '*.html' -o -name '*.css'"
    local pipe = assert(io.popen(("{ %s; } | xargs cat | wc -l"):format(
      find:format(root, place[2]))))
    local lines = pipe:read "n"
    pipe:close()
    sum = sum + lines
    print(("  %-12s %7d"):format(place[1], lines))
  end
  print(("  %-12s %7d"):format("all", sum))
end

function map.put(tree, root)
  print("Folders of src/ from the bottom up; each includes its own files and earlier "
    .. "folders only.\n")
  put_folders(tree, root)
  print()
  for _, folder in ipairs(lua_folders(root)) do
    put_wrapped(("%-31s  "):format(folder .. "/"), sentence_of(root, folder) or "", 67)
  end
  print()
  put_lines(root)
  print("\n./run map FOLDER lists the folders of a house (core, kit, desk), or the units of a "
    .. "folder\nsuch as svg.")
end

-- ---------------------------------------------------------------- units

--- The folder that a word means: its path, or the end of its path, such as svg.
local function find_folder(tree, root, word)
  word = "/" .. word:gsub("/+$", "")
  local paths = {}
  for i, room in ipairs(tree.rooms) do paths[i] = "src/" .. room end
  table.move(lua_folders(root), 1, 99, #paths + 1, paths)
  for _, path in ipairs(paths) do
    if ("/" .. path):sub(-#word) == word then return root .. "/" .. path end
  end
end

local function put_units_of(folder, list)
  print(folder:gsub("^%./", "") .. "/\n")
  for _, unit in ipairs(list) do
    put_wrapped(("%-22s %5d  "):format(unit.name, unit.lines), unit.sentence or "", 70)
  end
end

--- Prints the folders of houses, and the units of folders. Returns false, after a message, if a
--- word means no folder.
function map.put_units(tree, root, words)
  for _, word in ipairs(words) do
    local is_house = word == "core" or word == "kit" or word == "desk"
    local folder = find_folder(tree, root, word)
    local list = folder and units_of_folder(folder) or {}
    if is_house then
      put_folders(tree, root, word)
    elseif #list == 0 then
      io.stderr:write(("run: map: '%s' is not a folder with sources; `./run map` lists them\n")
        :format(word))
      return false
    end
    if not is_house then put_units_of(folder, list) end
  end
  return true
end

-- ---------------------------------------------------------------- checks

--- Each unit of a folder begins with a sentence.
local function check_units(root, folder, fault)
  local list = units_of_folder(root .. "/" .. folder)
  for _, unit in ipairs(list) do
    if not unit.sentence then
      fault("%s/%s: none of %s begins with a comment, which `./run map` prints", folder, unit.name,
        table.concat(unit.files, ", "))
    end
  end
  return #list
end

--- Each folder has a sentence that ends with a full stop, and only one; and each unit has one.
function map.check(tree, root, fault)
  local list = folders(tree)
  for i, folder in ipairs(list) do list[i] = "src/" .. folder end
  table.move(lua_folders(root), 1, 99, #list + 1, list)
  for _, folder in ipairs(list) do
    local text = sentence_of(root, folder)
    if not text then
      fault("%s has no folder.md with the sentence that `./run map` prints", folder)
    elseif not text:find "%.$" or text:find "%.%s+%u" then
      fault("%s/folder.md is not one sentence with a full stop", folder)
    end
  end
  local count = #list
  for _, room in ipairs(tree.rooms) do count = count + check_units(root, "src/" .. room, fault) end
  for _, folder in ipairs(lua_folders(root)) do count = count + check_units(root, folder, fault) end
  return count
end

return map
