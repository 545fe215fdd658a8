-- Prints docs/gallery.md: each film of scripts/ with its picture, its words, which are the first
-- paragraph of the script, and its commands. From the top of the tree:
--
--   lua5.4 docs/pictures/gallery.lua > docs/gallery.md
package.path = "./?.lua;" .. package.path
local list = require "docs.pictures.list"
local system = require "tests.support.system"

local FIRST = { "film", "demo" } -- the others follow by name
local BY_HAND = { film = "`./run film`" } -- which also makes the sound

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
  return table.concat(words, " ")
end

local function put(name)
  local path = "scripts/" .. name .. ".lua"
  io.write(("\n## [%s](../%s)\n\n"):format(name, path))
  if picture_of[name] then
    io.write(("![%s](pictures/%s.png)\n\n"):format(name, picture_of[name]))
  end
  local commands = ("`celspan play %s`, `celspan render %s -o %s.mp4`"):format(path, path, name)
  io.write(words_of(path), "\n\n", BY_HAND[name] or commands, "\n")
end

io.write [[
# Gallery

The films of this repository, each with its script to take apart, and with the commands that show
it and make a video of it. `./run docs` makes this page. [The cookbook](cookbook.md) has shorter
scripts, one for each task. [`celspan watch`](watch.md) shows a film again each time its script is
saved, here a small film of five shots:

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
