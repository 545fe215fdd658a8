--- The path of a reader who starts at a function: each call in the order of the text, each body
--- once.
local walk = {}

--- Folders that are left out: a call to them does not count as leaving the room.
local EVERYWHERE = { base = true }

--- The calls in a function's body that lead to other functions of the tree, in order.
local function calls_of(tree, fn)
  local list = {}
  for i = fn.from, fn.to do
    local called = tree:used_at(fn.file, i)
    if called and called ~= fn and not EVERYWHERE[called.file.room] then
      list[#list + 1] = called
    end
  end
  return list
end

--- Walks from the function of this name; nil if it does not exist. Returns counts: of functions, of
--- units, of rooms, of changes of room there and back, and of those when bodies that were read
--- before count too; and pairs["FROM -> TO"], how many calls made a change.
function walk.from(tree, name)
  local start = tree.shared[name]
  if not start then return nil end
  local told = { functions = 0, units = 0, rooms = 0, changes = 0, all_changes = 0,
                 pairs = {} }
  local seen = {}
  local function see(kind, key)
    if seen[key] then return end
    seen[key] = true
    told[kind] = told[kind] + 1
  end
  local function count_change(from, to, is_new)
    if from.room == to.room then return end
    told.all_changes = told.all_changes + 2
    if not is_new then return end
    told.changes = told.changes + 2
    local key = from.room .. " -> " .. to.room
    told.pairs[key] = (told.pairs[key] or 0) + 1
  end
  local function read(fn)
    see("functions", fn)
    see("units", fn.file.unit)
    see("rooms", "/" .. fn.file.room)
    for _, called in ipairs(calls_of(tree, fn)) do
      local is_new = not seen[called]
      count_change(fn.file, called.file, is_new)
      if is_new then read(called) end
    end
  end
  read(start)
  return told
end

return walk
