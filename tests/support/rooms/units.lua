--- The units of a folder with a sentence each: `./run map FOLDER`. The sentence is the first one of
--- the comment with which a source begins: of the header, else of another file of the unit.
local system = require "tests.support.system"

local units = {}

--- The order in which files are examined: a header explains the purpose of a unit.
local ENDINGS = { "h", "hpp", "c", "cpp", "lua" }
local IS_SOURCE = { h = true, hpp = true, c = true, cpp = true, lua = true }

--- The lines of the comment at the beginning of a source, up to its first empty line; nil if there
--- is none.
local function opening(text)
  local comment = text:match "^/%*(.-)%*/"
  if comment then return comment:gsub("\n ?%*", "\n") .. "\n" end
  local lines = {}
  for line in text:gmatch "([^\n]*)\n" do
    if not line:find "^%-%-" then break end
    lines[#lines + 1] = line:gsub("^%-+", "")
  end
  return lines[1] and table.concat(lines, "\n") .. "\n"
end

--- The first sentence of the comment at the beginning of a source, which a drawing may follow; nil
--- if there is none.
local function sentence_of(path)
  local comment = opening(assert(system.read(path)))
  if not comment then return end
  local text = (comment:match "^(.-)\n%s*\n" or comment):gsub("%s+", " "):gsub("^ ", "")
  text = text:match "^(.-%.) %a" or text:match "^(.-[.:]) %u" or text:gsub(" $", "")
  return (text:gsub("[.:,]$", "")) .. "."
end

--- The units of a folder, sorted: name, files (their endings), sentence, lines.
function units.of(folder)
  local list, by_name = {}, {}
  for _, name in ipairs(system.lines("ls " .. system.quote(folder))) do
    local stem, ending = name:match "^(.+)%.(%a+)$"
    if IS_SOURCE[ending] then
      stem = stem:gsub("_wide$", "")
      local unit = by_name[stem] or { name = stem, files = {}, lines = 0 }
      if not by_name[stem] then list[#list + 1] = unit end
      by_name[stem] = unit
      unit.files[#unit.files + 1] = name
      unit.lines = unit.lines + select(2, system.read(folder .. "/" .. name):gsub("\n", ""))
    end
  end
  for _, unit in ipairs(list) do
    for _, ending in ipairs(ENDINGS) do
      for _, kernel in ipairs { "", "_wide" } do
        local path = ("%s/%s%s.%s"):format(folder, unit.name, kernel, ending)
        unit.sentence = unit.sentence or system.exists(path) and sentence_of(path) or nil
      end
    end
  end
  table.sort(list, function(a, b) return a.name < b.name end)
  return list
end

return units
