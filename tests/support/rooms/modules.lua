--- The modules of celspan in Lua: their folders in lua/celspan, in the order in which they may
--- require each other, as src/kit/lua/module/meson.build lists them.
local system = require "tests.support.system"

local modules = {}

--- The folders in order, and for each module its folder's rank and its path from the root.
local function listed(root)
  local text = assert(system.read(root .. "/src/kit/lua/module/meson.build"))
  local folders, ranks, paths = {}, {}, {}
  for line in assert(text:match "lua_modules = (%b[])"):sub(2, -2):gmatch "%b[]" do
    local folder = line:match "'(%w+)'"
    folders[#folders + 1] = folder
    for list in line:sub(2, -2):gmatch "%b[]" do
      for name in list:gmatch "'([%w_]+)'" do
        ranks[name] = #folders
        paths[name] = ("lua/celspan/%s/%s.lua"):format(folder, name)
      end
    end
  end
  return folders, ranks, paths
end

--- The folders with modules in Lua, from the bottom up.
function modules.folders(root)
  local folders = listed(root)
  for i, folder in ipairs(folders) do folders[i] = "lua/celspan/" .. folder end
  return folders
end

--- Each file is listed, and none requires a module of a later folder.
function modules.check(root, fault)
  local _, ranks, paths = listed(root)
  local is_listed, count = {}, 0
  for name, path in pairs(paths) do
    is_listed[path] = true
    for other in (system.read(root .. "/" .. path) or ""):gmatch 'require "celspan%.([%w_]+)"' do
      count = count + 1
      if (ranks[other] or 0) > ranks[name] then
        fault("%s requires celspan.%s, which is in a later folder", path, other)
      end
    end
  end
  for _, path in ipairs(system.lines(("cd '%s' && find lua -name '*.lua'"):format(root))) do
    count = count + 1
    if not is_listed[path] then
      fault("%s is not listed in src/kit/lua/module/meson.build", path)
    end
  end
  return count
end

return modules
