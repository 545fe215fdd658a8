--- The files that films have asked for, which of them they read, and which were saved (celspan
--- watch).
--
--   renderers --paths--> add --> inotify --> take --> the films that have asked for what changed
--
-- A film reads what it was let read: the sandbox refuses files outside its folders, also where the
-- script ignores that.
local program, request = ...

local WATCHED_MOST = 10000 -- files

local files = {}
files.__index = files

-- owners[folder][name]: the films that have asked for this file, and whether they read it.
-- folders[number of the watcher]: the names of that folder in the films, such as "" and "./".
-- missing[folder]: the folder cannot be watched, because it does not exist.
function files.new()
  return setmetatable({ watcher = program.watcher(), owners = {}, folders = {}, missing = {},
                        count = 0 }, files)
end

local function split(path) return path:match "^(.-)([^/]+)$" end

function files:watch_folder(folder)
  local number = self.watcher:add(folder == "" and "." or folder)
  if number then
    self.folders[number] = self.folders[number] or {}
    self.folders[number][folder] = true
  end
  self.missing[folder] = not number or nil
  return number
end

--- Watches a file for a film, { script = }. is_read: the film read the file; otherwise it was
--- refused.
function files:add(path, side, is_read)
  local folder, name = split(path)
  local known = folder and self.owners[folder] and self.owners[folder][name]
  if not folder or not known and self.count == WATCHED_MOST then return end
  if not self.owners[folder] then
    self.owners[folder] = {}
    self:watch_folder(folder)
  end
  if not known then
    known, self.count = {}, self.count + 1
    self.owners[folder][name] = known
  end
  known[side] = is_read
end

--- Whether a film reads a file; nil: it has not asked for it. A trusted script may read modules
--- without asking, so modules beside it count, too.
function files:state(path, side)
  local folder, name = split(path)
  local known = folder and self.owners[folder] and self.owners[folder][name]
  if known and known[side] ~= nil then return known[side] end
  local is_module = folder and request.trust and name:match "%.lua$"
    and folder == (side.script:match "^.*/" or "")
  return is_module and true or nil
end

--- Whether an event matters for a film. name "": the folder is gone; number -1: events were lost.
function files:concerns(number, name, side)
  local is_changed = number == -1
  for folder in pairs(self.folders[number] or {}) do
    is_changed = is_changed or name == "" or self:state(folder .. name, side) ~= nil
  end
  return is_changed
end

--- Finds folders that exist again. All films that ask for files in them count as affected.
function files:find_missing()
  local is_found = false
  for folder in pairs(self.missing) do is_found = self:watch_folder(folder) ~= nil or is_found end
  return is_found
end

--- Called when a folder is gone.
function files:lose(number)
  for folder in pairs(self.folders[number] or {}) do self.missing[folder] = true end
  self.folders[number] = nil
end

--- Returns the given films that have asked for a file which has changed since the last call.
function files:take(sides)
  local events, changed = self.watcher:take(), {}
  for i = 1, #events, 2 do
    local number, name = events[i], events[i + 1]
    for _, side in ipairs(sides) do
      changed[side] = changed[side] or self:concerns(number, name, side) or nil
    end
    if name == "" then self:lose(number) end
  end
  if self:find_missing() then
    for _, side in ipairs(sides) do changed[side] = true end
  end
  return changed
end

--- The path of the first file that a film reads and for which fits(path) is true; nil: none.
function files:find(side, fits)
  for folder, list in pairs(self.owners) do
    for name, sides in pairs(list) do
      if sides[side] and fits(folder .. name) then return folder .. name end
    end
  end
  return nil
end

--- The path by which a film knows a file that an editor names from the root; nil: the film does not
--- read it.
function files:path_of(name, side)
  return self:find(side, function(path)
    return name == path or name:sub(-#path - 1) == "/" .. path
  end)
end

--- The path of a file that a sentence about a film names in Lua's way: only the end of a long path,
--- after three dots. nil: the film does not read it.
function files:named(name, side)
  if self:state(name, side) then return name end
  local ending = name:match "^%.%.%.(.+)$"
  return ending and self:find(side, function(path) return path:sub(-#ending) == ending end)
end

function files:descriptor() return self.watcher:descriptor() end

return files
