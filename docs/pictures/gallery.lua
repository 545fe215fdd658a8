-- Prints docs/gallery.md: the works of scripts/works, in the order of list.lua, and each script of
-- scripts/ by its subject; with its picture and its words, the first sentence of the script. From
-- the top of the tree:
--
--   lua5.4 docs/pictures/gallery.lua > docs/gallery.md
package.path = "./?.lua;" .. package.path
local list = require "docs.pictures.list"
local system = require "tests.support.system"

local SUBJECTS = {
  { "Films", "film demo" },
  { "Characters", "walking fox turn hat lip_cels" },
  { "Drawings by hand", "pencil light_table waving exposure_sheet strokes" },
  { "Camera and depth", "parallax perspective pan rack_focus terapixel dissolve" },
  { "Light and paint", "layers relight lights_and_gels gradient kernels" },
  { "Words", "title credits" },
  { "Shape and line", "primitives booleans scanline" },
  { "Pictures", "sea picture trace" },
}
local COLUMNS = 3

local picture_of = {}
for _, picture in ipairs(list) do
  local name = (picture.script or ""):match "^scripts/([%w_/]+)%.lua$" or picture.name
  picture_of[name] = picture_of[name] or list.file_of(picture)
end

--- The first sentence of a script.
local function words_of(text)
  local words = {}
  for line in text:gmatch "([^\n]*)\n" do
    local word = line:match "^%-%- (%S.*)$"
    if not word then break end
    words[#words + 1] = word
  end
  local comment = table.concat(words, " ")
  return comment:match "^.-[.!?]%f[ \0]" or comment
end

--- The number of lines of a script and of the modules in the folder of its name.
local function lines_of(path)
  return tonumber((system.output(("cat %s $(find %s -name '*.lua' 2>/dev/null) | wc -l")
    :format(path, path:gsub("%.lua$", "")))))
end

--- A work, large: its title, its picture, its idea, its length, and its script.
local function put_work(name)
  local path = ("scripts/%s.lua"):format(name)
  local text = system.read(path)
  local title, idea = words_of(text):match "^(.-): (.*)$"
  local seconds = tonumber(text:match "duration = ([%d.]+)") or text:match "frames = (%d+)" / 24
  io.write(("\n## %s\n\n![%s](pictures/%s)\n\n"):format(title, title, picture_of[name]),
    ("%s %.3g seconds, [%d lines](../%s).\n"):format(idea:gsub("^%l", string.upper), seconds,
      lines_of(path), path))
end

--- Scripts, small, in rows of pictures above their words.
local function put_wall(names)
  io.write("\n", ("| "):rep(COLUMNS), "|\n", ("|---"):rep(COLUMNS), "|\n")
  for first = 1, #names, COLUMNS do
    local pictures, words = {}, {}
    for i = 1, math.min(COLUMNS, #names - first + 1) do
      local name = names[first + i - 1]
      local path = ("scripts/%s.lua"):format(name)
      pictures[i] = picture_of[name] and ("![%s](pictures/%s)"):format(name, picture_of[name]) or ""
      words[i] = ("[%s](../%s) %s"):format(name, path, words_of(system.read(path)))
    end
    io.write("| ", table.concat(pictures, " | "), " |\n| ", table.concat(words, " | "), " |\n")
  end
end

io.write [[
# Gallery

For people who look for an idea: works of a few seconds, each with its script to take apart.
`celspan play scripts/works/moon_cat.lua --allow scripts` shows one; `celspan render` with `-o
film.mp4` makes a video of it, and `./run docs` of all. [The cookbook](cookbook.md) has shorter
scripts, one for each task. Everything here is drawn by its script: what looks like a photograph or
a scan, too.
]]
for _, picture in ipairs(list) do
  if picture.name:find "^works/" then put_work(picture.name) end
end

io.write [[

## All scripts

`./run film` makes Little One, with its sound. [`celspan watch`](watch.md) shows a film again each
time its script is saved, here the first film as a cut:

![the page of celspan watch](pictures/watch.png)
]]
local is_put = {}
for _, subject in ipairs(SUBJECTS) do
  local names = {}
  for name in subject[2]:gmatch "%S+" do
    names[#names + 1], is_put[name] = name, true
  end
  io.write("\n### ", subject[1], "\n")
  put_wall(names)
end
for path in system.output("LC_ALL=C ls scripts/*.lua"):gmatch "[^\n]+" do
  assert(is_put[path:match "([%w_]+)%.lua$"], path .. " has no subject")
end
