--- The files of an OpenColorIO configuration: itself, and the tables that it names.
--
--   search_path: luts:more          the folders, from that of the configuration on
--   src: half.cube                  a table, in the first folder that has it
--
-- The text is searched, and not the configuration that the library makes of it, so that all tables
-- are found that any space may need. Names with variables of shots ($SHOT) are not known here.
local program, path = ...

local MOST_BYTES = 16 * 1024 * 1024

--- A value without quotes and without a comment behind it.
local function bare(text)
  return text:match '^"([^"]*)"' or text:match "^'([^']*)'" or text:match "^([^,}#]-)%s*$"
    or text:match "^([^,}#]-)%s*[,}#]"
end

local function folder_of(name) return name:match "^(.*/)[^/]*$" or "" end

local function in_folder(folder, name)
  return name:sub(1, 1) == "/" and name or folder .. name
end

--- The folders in which tables are looked for.
local function folders_in(text)
  local own, list = folder_of(path), {}
  local function add(names)
    for name in names:gmatch "[^:]+" do list[#list + 1] = in_folder(own, name):gsub("/*$", "/") end
  end
  local line, rest = text:match "\nsearch_path:[ \t]*([^\n]*)(.*)"
  if line and line ~= "" then add(bare(line) or "") end
  for item in (line == "" and rest:match "^[\n%s]*(.-)\n%a" or ""):gmatch "%-[ \t]+([^\n]+)" do
    add(bare(item) or "")
  end
  list[#list + 1] = own
  return list
end

local function is_file(name) return program.entries(name) == false end

local file = io.open(path, "rb")
local text = file and file:read(MOST_BYTES) or ""
if file then file:close() end
local list = is_file(path) and { path } or {}
local folders = folders_in("\n" .. text)
for value in text:gmatch "[%s{,]src:[ \t]*([^\n]+)" do
  local name = bare(value)
  for _, folder in ipairs(name and folders or {}) do
    local found = in_folder(folder, name)
    if is_file(found) then
      list[#list + 1] = found
      break
    end
  end
end
return list
