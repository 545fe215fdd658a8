--- The sources of a tree: its rooms, which are the folders of src/ with sources, their files, and
--- the includes and uses between them.
local c_source = require "tests.support.rooms.c_source"

local tree = {}
tree.__index = tree

--- The folder of headers through which the other houses see the core; it comes after the core.
tree.DOOR = "core/inside"

-- Folders of the kit that are no part of the library.
local BUILT_APART = { "kit/plugins/moving", "kit/plugins/cairo", "kit/plugins/ocio",
  "kit/plugins/oiio", "kit/plugins/raster", "kit/plugins/type", "kit/plugins/icc",
  "kit/plugins/web", "kit/lua/bind", "kit/lua/nouns", "kit/lua/module", "kit/lua/sandbox",
  "kit/page" }

--- The rank of each folder: the list of src/meson.build, where the door follows the core, folders
--- that are built apart follow the kit, and the program follows all.
function tree.folder_ranks(root)
  local file = assert(io.open(root .. "/src/meson.build", "r"))
  local list = file:read("a"):match "foreach%s+layer%s*:%s*(%b[])"
  file:close()
  assert(list, "src/meson.build: no list of layers found")
  local ranks, count = { ["core/include"] = 0 }, 0
  local function add(name)
    if ranks[name] then return end
    count = count + 1
    ranks[name] = count
  end
  for name in list:gmatch "'([%w_/]+)'" do
    if name:find "^kit/" then
      add(tree.DOOR)
      add "kit/include"
    elseif name:find "^desk/" then
      for _, apart in ipairs(BUILT_APART) do add(apart) end
    end
    add(name)
  end
  add "desk/program"
  return ranks
end

--- The sources below src/, as paths relative to it.
local function source_paths(root)
  local paths = {}
  local find = "cd '%s/src' && find . -name '*.[ch]' -o -name '*.cpp'"
  local pipe = assert(io.popen(find:format(root)))
  for line in pipe:lines() do paths[#paths + 1] = line:sub(3) end
  pipe:close()
  table.sort(paths)
  return paths
end

--- Whether a folder or a file is of the headers for hosts.
function tree.is_public(path) return path:find "^%a+/include/" ~= nil end

--- The name under which sources include a file: its path without the house, or without include/.
function tree.name(path) return (path:gsub("^%a+/", "", 1):gsub("^include/", "")) end

--- The listed folder that contains a path: the longest beginning of the path that is in the list.
function tree.listed(ranks, path)
  local folder = path:match "^(.*)/"
  while folder and not ranks[folder] do folder = folder:match "^(.*)/" end
  return folder
end

--- file.house, file.wing and file.top: the first folder of its path, the first two, and the listed
--- one, such as core, core/engine and core/engine/area. file.room: the folder that holds it.
--- file.unit: a .c or .cpp, its .h and the kernels of the same name are one unit.
local function place(file, path, ranks)
  file.path = path
  file.room = path:match "^(.*)/"
  file.house = path:match "^[^/]+"
  file.wing = path:match "^[^/]+/[^/]+"
  file.top = tree.listed(ranks, path) or file.room
  file.is_header = path:find "%.h$" ~= nil
  file.unit = path:gsub("%.%a+$", ""):gsub("_wide$", "")
  file.name = file.unit:match "[^/]+$"
end

--- The position of a file's folder in the list, from the bottom up.
function tree:rank(file) return self.ranks[file.top] or math.huge end

--- The folders with sources, from the bottom up.
local function collect_rooms(self)
  local rooms, rank = {}, {}
  for _, file in ipairs(self.files) do
    if not rank[file.room] then
      rank[file.room] = self:rank(file)
      rooms[#rooms + 1] = file.room
    end
  end
  table.sort(rooms, function(a, b)
    if rank[a] ~= rank[b] then return rank[a] < rank[b] end
    return a < b
  end)
  return rooms
end

function tree.read(root)
  local self = setmetatable({ files = {}, named = {}, ranks = tree.folder_ranks(root), shared = {},
                              own = {} }, tree)
  for _, path in ipairs(source_paths(root)) do
    local file = c_source.read(root .. "/src/" .. path)
    place(file, path, self.ranks)
    self.files[#self.files + 1] = file
    self.named[tree.name(path)] = file
    self.own[file] = {}
    for _, fn in ipairs(file.functions) do
      fn.file = file
      self.own[file][fn.name] = fn
      local is_ours = fn.name:find "^cs_" or fn.name:find "^celspan_"
      if is_ours and (not fn.is_static or file.is_header) then self.shared[fn.name] = fn end
    end
  end
  self.rooms = collect_rooms(self)
  return self
end

local BEFORE_A_NAME = { ["("] = true, [","] = true, ["="] = true, ["{"] = true, ["?"] = true,
                        [":"] = true }
local AFTER_A_NAME = { [")"] = true, [","] = true, [";"] = true, ["}"] = true, [":"] = true }

--- The function to which a token of a file refers: it is called there, or passed as a function.
function tree:used_at(file, i)
  local word, before, after = file.text[i], file.text[i - 1], file.text[i + 1]
  local fn = self.own[file][word] or self.shared[word]
  if not fn or before == "." or before == "->" then return end
  local is_passed_on = BEFORE_A_NAME[before] and AFTER_A_NAME[after]
  if after == "(" or is_passed_on or word:find "^cs_" then return fn end
end

--- Whether a token is in the body of a function.
local function is_inside(file, i)
  for _, fn in ipairs(file.functions) do
    if i > fn.from and i < fn.to then return true end
  end
  return false
end

local function is_declaration(file, i) return file.is_header and not is_inside(file, i) end

--- Whether a header declares functions that a source defines: a self-check, or one of several
--- sources behind a header. The source includes it for these declarations.
local function is_declared_by(source, header)
  if not header.declared then
    header.declared = {}
    for _, name in ipairs(header.is_header and header.names or {}) do
      if name.kind == "prototype" then header.declared[name.name] = true end
    end
  end
  for _, fn in ipairs(source.functions) do
    if not fn.is_static and header.declared[fn.name] then return true end
  end
  return false
end

--- Calls visit(from, to, why) for each include of a file of the tree and, unless only_includes, for
--- each use of another file's function. With those uses, the include of the header that declares a
--- source's own functions does not count: what the source needs of that unit, it calls.
function tree:each_edge(visit, only_includes)
  for _, file in ipairs(self.files) do
    for _, include in ipairs(file.includes) do
      local to = self.named[include.name]
      local is_meant = to and not tree.is_public(to.room)
      if is_meant and (only_includes or not is_declared_by(file, to)) then
        visit(file, to, include)
      end
    end
    for i = 1, only_includes and 0 or #file.text do
      local fn = self:used_at(file, i)
      local is_other = fn and fn.file ~= file
      if is_other and not is_declaration(file, i) then visit(file, fn.file, fn) end
    end
  end
end

return tree
