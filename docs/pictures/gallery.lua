-- Prints docs/gallery.md: the works with what to look at in each, and every other script of
-- scripts/ by its subject, with its picture and its words, the first sentence of the script. From
-- the top of the tree:
--
--   lua5.4 docs/pictures/gallery.lua > docs/gallery.md
package.path = "./?.lua;" .. package.path
local list = require "docs.pictures.list"
local system = require "tests.support.system"

-- In the order of the page: the script, its idea, what to look at in it, what its picture shows.
-- `beside`: a work that is shown at its side, because its picture is not wide.
local WORKS = {
  { "film", "A lamplighter, a spark, and the last lamp of a town.",
    "`timing.lua` has the seconds of all moves and sounds; each shot is a file that reads them",
    "An old man in a top hat laughs with closed eyes: the street lamp before him burns",
    seconds = require("scripts.film.timing").seconds },
  { "town", "A winter night, and behind each window somebody is awake. [Go in](town.md).",
    "each room is a film of its own, a plane in the plane of the town",
    "A village on a hill in a snowy night, with all its windows lit", seconds = 12,
    size = "a hundred rooms" }, -- no lines: rooms are added
  { "works/moon_cat", "Whoever pats the moon may get the day.",
    "`moon ~ town`: one exclusive-or is the whole picture",
    "A white cat in the night, and a moon as high as the picture, on which roofs are black" },
  { "works/puddle", "Nobody is looking.",
    "one drawing with bones; a list of seconds is the acting",
    "A child in a yellow coat hangs on an umbrella above a puddle, in the rain" },
  { "works/room", "There is no room. Or is there?",
    "letters with an axis of widths, laid out again in each frame",
    "There is no: three rows of huge black letters, and narrow red ones that push in: room" },
  { "works/thread", "A line would rather be a bird.",
    "one stroke, morphed between three lists of points",
    "A red bird flies up from the end of the pencil line of which it is drawn" },
  { "works/slip", "Titles of a film that does not exist.",
    "the list that moves the dot also plays the bass",
    "A white dot bends black bars on red apart" },
  { "works/rooster", "Somebody has to call the sun.",
    "papers without photographs: noise, patterns, torn edges",
    "A rooster of cut papers crows at a night sky, and his call hangs there in letters" },
  { "works/quarter_turns", "Sixty-four quarters, four turns, no seam.",
    "the time of a tile is its distance from the middle",
    "Quarters of discs in five colours, four by four, as pinwheels and leaves",
    beside = { "works/egg", "Soft. Fried. And the third?",
      "upright, three cards, a word that bears the joke",
      "A chick stands in half an eggshell on thin legs, with a piece of shell as a hat" } },
  { "works/press", "A machine that makes cubes meets a ball.",
    "isometric faces; grain is `dissolve` at another scale",
    "A green press with wide eyes stares at a ball that has sprung up on its belt" },
  { "works/billion", "How long is a life? Count in heartbeats.",
    "a rectangle of years by pulse; areas tell the story",
    "A mouse, a cat and an elephant as squares of one size, and a black one with a heart" },
  { "demo", "Evening falls, and a girl brings the light.",
    "all that glows is exposed a second time, and so is all on which it shines",
    "A girl holds up a lantern on a hill at night; a firework bursts over a village" },
}

-- The other scripts, with what their pictures show.
local SUBJECTS = {
  { "Characters", {
    walking = "A child in a yellow coat walks with an umbrella through a rainy town",
    fox = "A red fox between golden trunks and falling leaves",
    turn = "A head with brown hair in eight steps from one side to the other, and a butterfly",
    hat = "A boy with freckles, his head aslant under a red hat with a feather",
    lip_cels = "A girl in a yellow cap, and nine mouths in a row below her" },
    "walking fox turn hat lip_cels" },
  { "Drawings by hand", {
    pencil = "A green frog laughs on a lily pad under the moon",
    light_table = "A sheet on a bright table, and six drawings of a falling ball through it",
    waving = "An owl on a branch lifts one wing to its head",
    exposure_sheet = "A red ball, flat on the floor, beside a table with one line marked",
    strokes = "A thick wave of ink, red loops, and a green oval road with dashes" },
    "pencil light_table waving exposure_sheet strokes" },
  { "Words", {
    title = "Long Night, in dark letters over dunes; the last two are still in the air",
    credits = "Jobs and names in two columns on black, faint at the upper and the lower edge" },
    "title credits" },
  { "Camera and depth", {
    parallax = "Trunks of a wood, the far ones pale in mist",
    perspective = "A long hall with a floor of black and white squares, and pictures on both walls",
    pan = "Narrow coloured houses in a row, and their reflection in a canal",
    rack_focus = "A cat in the window of a small house, sharp; a lantern before it, blurred",
    terapixel = "A town on a hill, a window in it with a room behind, and a note on the wall there",
    dissolve = "Dunes under a white sun, which becomes the moon over a lake, in three steps" },
    "parallax perspective pan rack_focus terapixel dissolve" },
  { "Light and paint", {
    layers = "Mountains behind firs, the last light on a peak",
    relight = "One house at a corner three times: at noon, at six, and at nine by its lamp",
    lights_and_gels = "A round window of red, blue and yellow glass in a dark wall",
    gradient = "A green vase, two balls and a cut stone on a table",
    kernels = "One drawing eight times, from hard to soft edges" },
    "layers relight lights_and_gels gradient kernels" },
  { "Pictures", {
    sea = "A boat with a striped flag between two purple arms from the sea",
    picture = "Two postcards on a dark desk, and above them a slide that shines",
    trace = "A yellow fish with a black outline" },
    "sea picture trace" },
  { "Shape and line", {
    primitives = "Eight tiles, each with a shape: a square, a heart, a star, a striped ball",
    booleans = "A flower and rings four times: joined, shared, cut, and each without the other",
    scanline = "A sailing boat at dusk, and the sun's light on the waves" },
    "primitives booleans scanline" },
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

--- Where a script is, what it is called, and what its picture is.
local function path_of(name) return ("scripts/%s.lua"):format(name) end
local function title_of(name) return system.read(path_of(name)):match 'title = "([^"]*)"' end
local function put_picture(name, words)
  return ("![%s](pictures/%s)"):format(words, assert(picture_of[name], name))
end

--- How long a work is, how long its script is or what it has, and where that is.
local function facts_of(work)
  local name, seconds = work[1], work.seconds
  local path = path_of(name)
  local text = system.read(path)
  seconds = seconds or tonumber(text:match "duration = ([%d.]+)")
    or text:match "frames = (%d+)" / 24
  local lines = ("%d lines"):format(lines_of(path)):gsub("^(%d+)(%d%d%d) ", "%1,%2 ")
  local sound = name == "film" and "[with its sound](pictures/little-one.mp4) · "
    or text:find "sound =" and "sound · " or ""
  return ("%.3g s · %s · %s[script](../%s)"):format(seconds, work.size or lines, sound, path)
end

--- A work, large: its title, its picture, its idea, what to look at, and where it is.
local function put_work(work)
  local name, idea, look, words = table.unpack(work)
  io.write(("\n## %s\n\n%s\n\n%s\n\n"):format(title_of(name), put_picture(name, words), idea),
    ("**Take it apart:** %s.\n\n%s\n"):format(look, facts_of(work)))
end

--- Two works side by side.
local function put_pair(left, right)
  local pictures, words = {}, {}
  for i, work in ipairs { left, right } do
    pictures[i] = put_picture(work[1], work[4])
    words[i] = ("%s **Take it apart:** %s. %s"):format(work[2], work[3], facts_of(work))
  end
  io.write(("\n## %s · %s\n"):format(title_of(left[1]), title_of(right[1])),
    "\n| | |\n|---|---|\n| ", table.concat(pictures, " | "), " |\n| ",
    table.concat(words, " | "), " |\n")
end

--- Scripts, small, in rows of pictures above their words.
local function put_wall(names, shown)
  io.write("\n", ("| "):rep(COLUMNS), "|\n", ("|---"):rep(COLUMNS), "|\n")
  for first = 1, #names, COLUMNS do
    local pictures, words = {}, {}
    for i = 1, math.min(COLUMNS, #names - first + 1) do
      local name = names[first + i - 1]
      local path = path_of(name)
      pictures[i] = put_picture(name, assert(shown[name], name))
      words[i] = ("[%s](../%s) %s"):format(name, path, words_of(system.read(path)))
    end
    io.write("| ", table.concat(pictures, " | "), " |\n| ", table.concat(words, " | "), " |\n")
  end
end

io.write [[
# Gallery

Works of a few seconds. Each is a script: watch it, change a number, make it yours.
]]
local is_put = {}
local function note(work)
  is_put[work[1]] = true
  return work
end
for _, work in ipairs(WORKS) do
  if work.beside then put_pair(note(work), note(work.beside)) else put_work(note(work)) end
end

io.write [[

## How to see them

```sh
./run demo
PATH=$PWD/build:$PATH
celspan play scripts/works/moon_cat.lua --allow scripts
celspan render scripts/works/moon_cat.lua --allow scripts -o cat.mp4
```

The first line builds celspan and makes the last work above; the second lets your shell find it.
`play` shows a work with its sound, `render` makes a video of it. `--allow scripts` lets it read the
letters that lie beside it: a film may read nothing else ([sandbox](sandbox.md)). `./run film` makes
Little One, with its sound.

Everything here is drawn by its script: what looks like a photograph or a scan, too.

## All scripts

[The cookbook](cookbook.md) has shorter ones, one for each task. [`celspan watch`](watch.md) shows a
film again each time its script is saved, here the film of `celspan init`:

![A page in a browser: a cat that leaps before the moon, what is drawn at a point of it, and below
them the time line](pictures/watch.png)
]]
for _, subject in ipairs(SUBJECTS) do
  local names = {}
  for name in subject[3]:gmatch "%S+" do names[#names + 1] = note { name }[1] end
  io.write("\n### ", subject[1], "\n")
  put_wall(names, subject[2])
end
for path in system.output("LC_ALL=C ls scripts/*.lua scripts/works/*.lua"):gmatch "[^\n]+" do
  assert(is_put[path:match "^scripts/([%w_/]+)%.lua$"], path .. " has no place")
end
