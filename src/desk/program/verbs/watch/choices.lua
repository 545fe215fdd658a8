--- The files that a parameter of a film may name (celspan watch).
--
-- INVARIANT: they lie in the folder of the script, or in one inside it, also where links lead.
-- Names that begin with a dot are left out.
local program = ...

local FILES_MOST = 500    -- the most files that are listed
local ENTRIES_MOST = 10000 -- the most entries that are examined
local DEPTH_MOST = 6       -- folders inside one another

local choices = {}

-- Endings that belong to one kind; every other ending is a separate kind.
local kinds = {}
for _, kind in ipairs { "png jpg jpeg tif tiff exr tga webp gif bmp dpx hdr",
                        "wav flac ogg opus mp3 m4a aac aif aiff", "csv tsv", "ora psd kra",
                        "srt vtt" } do
  for ending in kind:gmatch "%l%w*" do kinds[ending] = kind end
end

local function kind_of(name)
  local ending = (name:match "%.(%w+)$" or ""):lower()
  return kinds[ending] or ending
end

local function add(walk, name, depth)
  local path = walk.top .. name
  local resolved = program.resolve(path)
  local is_inside = resolved and program.is_within(walk.folder, resolved)
  if not is_inside or walk.seen[resolved] then return end
  walk.seen[resolved], walk.count = true, walk.count + 1
  local entries = program.entries(path)
  if entries == false then
    if kind_of(name) == walk.kind then table.insert(walk.list, name) end
  elseif entries and depth < DEPTH_MOST then
    table.sort(entries)
    for _, entry in ipairs(entries) do
      if walk.count > ENTRIES_MOST or #walk.list == FILES_MOST then return end
      if entry:sub(1, 1) ~= "." then
        add(walk, name == "" and entry or name .. "/" .. entry, depth + 1)
      end
    end
  end
end

--- The files of the same kind as a file, with their names relative to the folder of a script.
function choices.like(script, file)
  local top = script:match "^.*/" or "./"
  local walk = { top = top, folder = program.resolve(top), kind = kind_of(file), list = {},
                 seen = {}, count = 0 }
  if walk.folder then add(walk, "", 0) end
  table.sort(walk.list)
  return walk.list
end

return choices
