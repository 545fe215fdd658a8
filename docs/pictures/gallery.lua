-- Prints docs/gallery.md: each film of scripts/ with its picture and its words, which are the first
-- sentence of the script. From the top of the tree:
--
--   lua5.4 docs/pictures/gallery.lua > docs/gallery.md
package.path = "./?.lua;" .. package.path
local list = require "docs.pictures.list"
local system = require "tests.support.system"

local FIRST = { "film", "demo" } -- the others follow by name
local BY_HAND = { film = "`./run film` makes it, with its sound." }

local picture_of = {}
for _, picture in ipairs(list) do
  local name = (picture.script or ""):match "^scripts/([%w_]+)%.lua$" or picture.name
  picture_of[name] = picture_of[name] or picture.name
end

local function words_of(path)
  local words = {}
  for line in system.read(path):gmatch "([^\n]*)\n" do
    local text = line:match "^%-%- (%S.*)$"
    if not text then break end
    words[#words + 1] = text
  end
  local text = table.concat(words, " ")
  return text:match "^.-[.!?]%f[ \0]" or text
end

local function put(name)
  local path = "scripts/" .. name .. ".lua"
  io.write(("\n## [%s](../%s)\n\n"):format(name, path))
  if picture_of[name] then
    io.write(("![%s](pictures/%s.png)\n\n"):format(name, picture_of[name]))
  end
  io.write(words_of(path), BY_HAND[name] and " " .. BY_HAND[name] or "", "\n")
end

io.write [[
# Gallery

For people who look for an idea: the films of this repository, each with its script to take apart.
`celspan play scripts/demo.lua` shows one, and `celspan render scripts/demo.lua -o demo.mp4` makes a
video of it. [The cookbook](cookbook.md) has shorter scripts, one for each task. [`celspan
watch`](watch.md) shows a film again each time its script is saved, here the first film as a cut:

![the page of celspan watch](pictures/watch.png)
]]
local is_first = {}
for _, name in ipairs(FIRST) do
  is_first[name] = true
  put(name)
end
for path in system.output("LC_ALL=C ls scripts/*.lua"):gmatch "[^\n]+" do
  local name = path:match "([%w_]+)%.lua$"
  if not is_first[name] then put(name) end
end
