--- The folders of src/ with a sentence each, from the bottom up: `./run map`.
local map = {}

--- The one sentence of a folder, from its folder.md; nil when it has none.
local function sentence_of(root, folder)
  local file = io.open(("%s/src/%s/folder.md"):format(root, folder))
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
    add(room:find "^include" and "include" or room)
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

function map.put(tree, root)
  print("Folders of src/ from the bottom up; each includes its own files and earlier "
    .. "folders only.\n")
  print(("%-18s %5s %6s"):format("folder", "units", "lines"))
  for _, folder in ipairs(folders(tree)) do
    local is_wing = not folder:find "/"
    local units, lines = units_of(tree, folder)
    local name = is_wing and folder .. "/" or "  " .. folder:match "/(.*)" .. "/"
    local figures = units > 0 and ("%5d %6d"):format(units, lines) or (" "):rep(12)
    local text = wrapped(sentence_of(root, folder) or "", 72)
    print(("%s%-18s %s  %s"):format(is_wing and "\n" or "", name, figures, text[1]))
    for i = 2, #text do print((" "):rep(33) .. text[i]) end
  end
end

--- Each folder has a sentence that ends with a full stop, and only one.
function map.check(tree, root, fault)
  local list = folders(tree)
  for _, folder in ipairs(list) do
    local text = sentence_of(root, folder)
    if not text then
      fault("src/%s has no folder.md with the sentence that `./run map` prints", folder)
    elseif not text:find "%.$" or text:find "%.%s+%u" then
      fault("src/%s/folder.md is not one sentence with a full stop", folder)
    end
  end
  return #list
end

return map
