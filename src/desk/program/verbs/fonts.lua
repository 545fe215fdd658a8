--- celspan fonts [SCRIPT]: the files of fonts that a film may read.
local program, request = ...
local native = require "celspan.native"

local DEEPEST = 8 -- folders in folders
local facts = program.part("facts.lua", program, request)
facts:lists("fonts", "system")

--- Prints the fonts of a folder and of the folders in it. before: what precedes their names.
local function list(folder, before, kind, depth)
  local names = native.folder(folder) or {}
  table.sort(names)
  for _, name in ipairs(names) do
    if program.has_ending(name, ".ttf", ".otf", ".ttc", ".otc") then
      facts:item(kind, before .. name, "%s", before .. name)
    elseif depth < DEEPEST then
      list(folder .. "/" .. name, before .. name .. "/", kind, depth + 1)
    end
  end
end

list(request[1] and (request[1]:match "^(.*)/[^/]*$" or ".") or ".", "", "fonts", 0)
facts:line "with --allow-system-fonts:"
local home = os.getenv "HOME"
for _, folder in ipairs { "/usr/share/fonts", "/usr/local/share/fonts",
                          home and home .. "/.local/share/fonts", home and home .. "/.fonts" } do
  list(folder, folder .. "/", "system", 0)
end
facts:finish()
