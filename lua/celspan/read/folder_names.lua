--- What the names of files in a folder say: which are pictures, and in which order.
local folder_names = {}

--- File extensions of pictures; other files in a folder are skipped.
local endings = {}
for ending in ("png jpg jpeg tif tiff exr tga dpx cin webp bmp gif jp2 hdr"):gmatch "%a+%d?" do
  endings[ending] = true
end

--- The name of a file that is a picture, without its ending; nil: it is another file.
function folder_names.picture(name)
  local base, ending = name:match "^(.*)%.(%w+)$"
  return base and endings[ending:lower()] and base or nil
end

--- A key that sorts "b10" after "b9", because digits are compared as numbers.
local function natural_key(name)
  return (name:lower():gsub("%d+", function(digits)
    local number = digits:gsub("^0+", "")
    return ("%03d"):format(#number) .. number
  end))
end

function folder_names.sort(names)
  local keys = {}
  for _, name in ipairs(names) do keys[name] = natural_key(name) end
  table.sort(names, function(a, b)
    if keys[a] ~= keys[b] then return keys[a] < keys[b] end
    return a < b
  end)
end

return folder_names
