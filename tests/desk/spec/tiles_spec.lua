-- celspan tiles: the pyramid's shape, its tiles compared with the frame's pixels, linked, omitted
-- and kept tiles, and the page in a browser. One file, because all tests cut the same frames.

local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

-- Pictures are read to compare them.
local it_compares = present.pictures() and it or pending

local bench, folder

local function read(path) return bench:read(path) end
local function write(name, text) return bench:write(name, text) end
local function shell(command) return bench:shell(command) end
local function celspan(arguments, ...) return bench:celspan(arguments, ...) end


local function count_files(path, name)
  return #system.lines(("find '%s' -type f -name '%s'"):format(path, name or "*.png"))
end

--- Device and inode of a file: equal for two names of one file.
local function identity(path) return system.lines(("stat -c %%d:%%i '%s'"):format(path))[1] end

--- The difference of two pictures, 0 to 1; nil if they have different sizes.
local function difference(a, b)
  local _, text = celspan("compare '%s' '%s' --fail 1", a, b)
  return tonumber(text:match("largest_difference ([%d.e+-]+)"))
end

local function assert_success(arguments, ...)
  local code, out, err = celspan(arguments, ...)
  assert.are.equal(0, code, err)
  return out, err
end

-- 700 x 500, a plain background with something round in the middle, and a clear left edge.
local PLAIN = [[
local celspan = require "celspan"
return celspan.film{ size = {700, 500}, frames = 2, title = "a <plain> one", frame = function(f)
  return celspan.rostrum{ celspan.cel{
    celspan.rect{ 200, 0, 500, 500, texture = "#336699" },
    celspan.circle{ centre = {450, 250}, radius = 60 + f.index, texture = celspan.radial{
      centre = {450, 250}, radius = 60, {0, "#ffffff"}, {1, "#aa3311"} } } } }
end }
]]

-- For tests of other things: as few tiles as possible.
local SMALL = [[
local celspan = require "celspan"
return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 9, 9 } } }
]]

local script

before_each(function()
  bench = workbench.new()
  folder = bench.folder
  script = write("plain.lua", PLAIN)
end)

after_each(function() bench:remove() end)

describe("a Deep Zoom pyramid", function()
  it("has a level for every halving, down to one pixel", function()
    assert_success("tiles %s -o %s/p --tile 64 --progress none", script, folder)
    local dzi = read(folder .. "/p/plain.dzi")
    assert.is_truthy(dzi:find('Format="png" Overlap="1" TileSize="64"', 1, true))
    assert.is_truthy(dzi:find('<Size Width="700" Height="500"/>', 1, true))
    local counts = {}
    for level = 0, 10 do
      local factor = 2 ^ (10 - level)
      local function tiles(side) return math.ceil(math.ceil(side / factor) / 64) end
      counts[level] = tiles(700) * tiles(500)
    end
    assert.are.equal(88, counts[10])
    for level = 0, 10 do
      assert.are.equal(counts[level], count_files(folder .. "/p/plain_files/" .. level), level)
    end
  end)

  it_compares("contains the pixels of the frame at each level's size, with the overlap", function()
    assert_success("tiles %s -o %s/p --tile 64 --progress none", script, folder)
    for _, case in ipairs {
      { 10, "0_0", "0,0,65,65" }, { 10, "7_3", "447,191,66,66" }, { 10, "10_7", "639,447,61,53" },
      { 9, "3_1", "191,63,66,66" },
    } do
      local level, tile, crop = table.unpack(case)
      local w, h = 700 // 2 ^ (10 - level), 500 // 2 ^ (10 - level)
      assert_success("render %s --frames 1 --size %dx%d --crop %s -o %s/crop.png --progress none",
        script, w, h, crop, folder)
      local path = ("%s/p/plain_files/%d/%s.png"):format(folder, level, tile)
      assert.are.equal(0, difference(folder .. "/crop.png", path), path)
    end
  end)

  it_compares("comes close to the frame if it is the mean of a larger level", function()
    assert_success("tiles %s -o %s/p --progress none", script, folder)
    assert_success("render %s --frames 1 --size 175x125 -o %s/whole.png --progress none", script,
      folder)
    assert.is_true(difference(folder .. "/whole.png", folder .. "/p/plain_files/8/0_0.png") < 0.03)
    assert.is_not_nil(read(folder .. "/p/plain_files/0/0_0.png"))
  end)

  it_compares("shows the requested frame", function()
    assert_success("tiles %s --frame 2 -o %s/p --progress none", script, folder)
    assert_success("render %s --frames 2 --crop 253,0,256,255 -o %s/x.png --progress none", script,
      folder)
    assert.are.equal(0, difference(folder .. "/x.png", folder .. "/p/plain_files/10/1_0.png"))
  end)

  it("is the same with any number of workers", function()
    assert_success("tiles %s -o %s/one --tile 32 --workers 1 --progress none", script, folder)
    assert_success("tiles %s -o %s/four --tile 32 --workers 4 --progress none", script, folder)
    assert.are.equal(0, (shell(("diff -r %s/one/plain_files %s/four/plain_files"):format(folder,
      folder))))
  end)

  it_compares("can be made from a picture like from a script", function()
    assert_success("render %s --frames 1 -o %s/still.png --progress none", script, folder)
    assert_success("tiles %s/still.png -o %s/p --tile 64 --progress none", folder, folder)
    assert_success("tiles %s -o %s/q --tile 64 --progress none", script, folder)
    assert.are.equal(0, difference(folder .. "/p/still_files/10/7_3.png",
      folder .. "/q/plain_files/10/7_3.png"))
  end)

  it_compares("can be made from a span file like from a script", function()
    assert_success("render %s --frames 1 -o %s/still.span --progress none", script, folder)
    assert_success("tiles %s/still.span -o %s/p --tile 64 --progress none", folder, folder)
    assert_success("tiles %s -o %s/q --tile 64 --progress none", script, folder)
    assert.are.equal(0, difference(folder .. "/p/still_files/10/7_3.png",
      folder .. "/q/plain_files/10/7_3.png"))
  end)
end)

describe("equal tiles", function()
  it("are one file with several names", function()
    assert_success("tiles %s -o %s/p --tile 64 --progress none", script, folder)
    local tiles = folder .. "/p/plain_files/10/"
    assert.are.equal(identity(tiles .. "1_1.png"), identity(tiles .. "1_2.png"))
    assert.are.equal(identity(tiles .. "9_1.png"), identity(tiles .. "9_5.png"))
    assert.are_not.equal(identity(tiles .. "1_1.png"), identity(tiles .. "9_1.png"))
  end)

  it("are left out on request if they are empty", function()
    local _, err = assert_success("tiles %s -o %s/p --tile 64 --skip-empty --progress lines",
      script, folder)
    assert.is_nil(read(folder .. "/p/plain_files/10/1_1.png"))
    assert.is_not_nil(read(folder .. "/p/plain_files/10/3_1.png"))
    assert.is_truthy(err:match("(%d+) left out") ~= "0", err)
  end)
end)

describe("a IIIF image", function()
  it_compares("has the tiles that its information names", function()
    assert_success("tiles %s -o %s/p --format iiif --tile 128 --progress none", script, folder)
    local info = read(folder .. "/p/plain/info.json")
    for _, part in ipairs {
      '"@context": "http://iiif.io/api/image/3/context.json"', '"type": "ImageService3"',
      '"protocol": "http://iiif.io/api/image"', '"profile": "level0"', '"width": 700',
      '"height": 500', '"scaleFactors": [1, 2, 4, 8]', '"extraFormats": ["png"]',
    } do
      assert.is_truthy(info:find(part, 1, true), part)
    end
    for _, name in ipairs {
      "0,0,128,128/128,128", "640,384,60,116/60,116", "512,256,188,244/94,122",
      "0,0,700,500/88,63", "full/88,63",
    } do
      local path = ("%s/p/plain/%s/0/default.png"):format(folder, name)
      assert.is_not_nil(read(path), path)
    end
    assert_success("render %s --frames 1 --size 350x250 --crop 256,128,94,122 -o %s/x.png",
      script, folder)
    assert.are.equal(0, difference(folder .. "/x.png",
      folder .. "/p/plain/512,256,188,244/94,122/0/default.png"))
  end)
end)

describe("tiles of JPEG", function()
  it_compares("come close to the frame, and are declared in its information", function()
    write("a 50% one.lua", (PLAIN:gsub("} } } }", '} } }, back = "#fbe9c6" }')))
    assert_success("tiles '%s/a 50%% one.lua' -o %s/p --format iiif --picture JPEG --tile 512 "
      .. "--progress none", folder, folder)
    local info = read(folder .. "/p/a 50% one/info.json")
    assert.is_truthy(info:find('"id": "http://localhost:8000/a%2050%25%20one"', 1, true), info)
    assert.is_nil(info:find("Formats", 1, true))
    assert_success("render '%s/a 50%% one.lua' --frames 1 --size 350x250 -o %s/x.png "
      .. "--progress none", folder, folder)
    local differs = difference(folder .. "/x.png",
      folder .. "/p/a 50% one/0,0,700,500/350,250/0/default.jpg")
    assert.is_true(differs > 0 and differs < 0.3, tostring(differs))
  end)
end)

describe("a large frame", function()
  it("is refused with a list of the levels that are within the limit", function()
    local code, _, err = celspan("tiles %s --size 1000000x700000 -o %s/p", script, folder)
    assert.are.equal(6, code)
    assert.is_truthy(err:find("levels 0 to 20 have", 1, true), err)
    assert.is_truthy(err:find("--levels 0-16", 1, true), err)
    assert.is_nil(read(folder .. "/p/plain.tiles"))
  end)

  it("is refused without that list if not even the first one is", function()
    local code, _, err = celspan("tiles %s -o %s/p --levels 9-10 --tiles-limit 1", script, folder)
    assert.are.equal(6, code)
    assert.is_truthy(err:find("levels 9 to 10 have 8 tiles, and the limit is 1: raise "
      .. "--tiles-limit", 1, true), err)
  end)

  it("is made at the requested levels, and at deep levels around places", function()
    write("places.txt", "# a comment\n\n450 250 2 the middle\n")
    assert_success("tiles %s --size 1000000x700000 -o %s/p --levels 0-3 --places %s/places.txt "
      .. "--progress none", script, folder, folder)
    local page = read(folder .. "/p/index.html")
    assert.is_truthy(page:find('"the middle"', 1, true))
    assert.is_not_nil(read(folder .. "/p/plain_files/20/2530_1377.png"))
    assert.are.equal(nil, read(folder .. "/p/plain_files/20/0_0.png"))
  end)

  it("has a page in the colour of the background, whatever the weights of exposures sum to",
    function()
    local blurred = write("blurred.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 64, 64 }, frame = function()
  local exposures = {}
  for i = 1, 10 do exposures[i] = { celspan.rostrum { back = "#c08040" }, 1 / 10 } end
  return exposures
end }
]])
    assert_success("tiles %s -o %s/p --progress none", blurred, folder)
    assert.is_truthy(read(folder .. "/p/index.html"):find('"#c08040"', 1, true))
  end)

  it("makes only the tiles that touch a crop", function()
    assert_success("tiles %s -o %s/p --tile 64 --levels 10-10 --crop 100,100,60,60 --progress none",
      script, folder)
    assert.are.equal(4, count_files(folder .. "/p/plain_files"))
  end)

  it("makes the same tiles for a crop as for the whole frame, at small levels too", function()
    for _, format in ipairs { "dzi", "iiif" } do
      local options = ("--tile 64 --format %s --progress none"):format(format)
      assert_success("tiles %s -o %s/%s/whole %s", script, folder, format, options)
      assert_success("tiles %s -o %s/%s/part --crop 300,400,400,100 %s", script, folder, format,
        options)
      local _, different = shell(("cd '%s/%s/part' && find . -name '*.png' | while read -r tile; "
        .. "do cmp \"$tile\" \"../whole/$tile\"; done"):format(folder, format))
      assert.are.equal("", different)
    end
  end)
end)

describe("a resumed run", function()
  it("keeps finished tiles and makes the rest", function()
    assert_success("tiles %s -o %s/whole --tile 64 --progress none", script, folder)
    assert_success("tiles %s -o %s/p --tile 64 --levels 0-9 --progress none", script, folder)
    local before = identity(folder .. "/p/plain_files/9/0_0.png")
    local log = read(folder .. "/p/plain.tiles")
    write("p/plain.tiles", log .. "row 10 1 0 10 and more\nrow 10 0 0 1")
    assert_success("tiles %s -o %s/p --tile 64 --progress none", script, folder)
    assert.are.equal(before, identity(folder .. "/p/plain_files/9/0_0.png"))
    assert.are.equal(0, (shell(("diff -r %s/whole/plain_files %s/p/plain_files"):format(folder,
      folder))))
    local _, err = assert_success("tiles %s -o %s/p --tile 64 --progress lines", script, folder)
    assert.is_truthy(err:find("0 tiles written, 0 linked", 1, true), err)
  end)

  it("does not mix two scenes, and starts over on request", function()
    assert_success("tiles %s -o %s/p --progress none", script, folder)
    local code, _, err = celspan("tiles %s --frame 2 -o %s/p --progress none", script, folder)
    assert.are.equal(2, code)
    assert.is_truthy(err:find("--fresh", 1, true), err)
    assert_success("tiles %s --frame 2 -o %s/p --levels 0-8 --fresh --progress none", script,
      folder)
    assert.is_nil(read(folder .. "/p/plain_files/10/0_0.png"))
  end)

  it("recognises pixels in memory by their content, also next to a procedure", function()
    for _, procedure in ipairs { "",
      "celspan.scanline{ bounds = {0, 0, 9, 9}, spans = function() end }," } do
      local film = write("pixels.lua", ([[
        local celspan = require "celspan"
        local file = assert(io.open("%s/pixels.bin", "rb"))
        local pixels = file:read("a")
        file:close()
        return celspan.rostrum{ celspan.cel{ %s
          celspan.image{ pixels = pixels, size = {2, 2}, format = "grey8", w = 64, h = 64 } }
            }]]):format(folder, procedure))
      write("pixels.bin", "\0\1\2\3")
      assert_success("tiles %s -o %s/q --size 64x64 --fresh --trust --progress none", film, folder)
      assert_success("tiles %s -o %s/q --size 64x64 --trust --progress none", film, folder)
      write("pixels.bin", "\0\1\2\4")
      local code, _, err = celspan("tiles %s -o %s/q --size 64x64 --trust --progress none", film,
        folder)
      assert.are.equal(2, code)
      assert.is_truthy(err:find("--fresh", 1, true), err)
    end
  end)

  it("does not touch a folder that it did not make", function()
    shell(("mkdir -p %s/p/plain_files %s/p/plain && echo mine >%s/p/plain_files/mine")
      :format(folder, folder, folder))
    for layout, name in pairs { dzi = "plain_files", iiif = "plain" } do
      local code, _, err = celspan("tiles %s -o %s/p --format %s --fresh --progress none", script,
        folder, layout)
      assert.are.equal(2, code, err)
      assert.is_truthy(err:find(("already holds a %s that was not made by celspan tiles")
        :format(name), 1, true), err)
    end
    assert.are.equal("mine\n", read(folder .. "/p/plain_files/mine"))
  end)

  it("does not wait for another run", function()
    local small = write("small.lua", SMALL)
    assert_success("tiles %s --size 20x20 -o %s/p --progress none", small, folder)
    for _, options in ipairs { "", "--fresh" } do
      local code, _, err =
        shell(("flock '%s/p/small.tiles' '%s' tiles '%s' --size 20x20 -o '%s/p' --progress none %s")
        :format(folder, workbench.binary, small, folder, options))
      assert.are.equal(5, code)
      assert.is_truthy(err:find("small.tiles: another celspan is writing these tiles", 1, true),
        err)
    end
  end)

  it("starts over if the tiles of its record are missing, or of another version", function()
    local small = write("small.lua", SMALL)
    assert_success("tiles %s --size 20x20 -o %s/p --progress none", small, folder)
    shell(("rm -r '%s/p/small_files'"):format(folder))
    assert_success("tiles %s --size 20x20 -o %s/p --fresh --progress none", small, folder)
    assert.is_truthy(read(folder .. "/p/small_files/5/0_0.png"))
    for _, record in ipairs { "", "celspan tiles 1\n",
      "celspan tiles 2 00112233445566778899aabbccddeeff\n" } do
      write("p/small.tiles", record)
      local code, _, err = celspan("tiles %s --size 20x20 -o %s/p --progress none", small, folder)
      assert.are.equal(2, code)
      assert.is_truthy(err:find("give --fresh to remove them", 1, true), err)
    end
  end)

  it("makes a row again if a digit of its line was changed, and all rows after it", function()
    assert_success("tiles %s -o %s/whole --tile 64 --levels 8-8 --progress none", script, folder)
    assert_success("tiles %s -o %s/p --tile 64 --levels 8-8 --progress none", script, folder)
    local record = read(folder .. "/p/plain.tiles")
    local changed, count = record:gsub("row 8 1 ", "row 9 1 ")
    assert.are.equal(1, count)
    write("p/plain.tiles", changed)
    os.remove(folder .. "/p/plain_files/8/0_1.png")
    assert_success("tiles %s -o %s/p --tile 64 --levels 8-8 --progress none", script, folder)
    assert.are.equal(record, read(folder .. "/p/plain.tiles"))
    assert.are.equal(0, (shell(("diff -r %s/whole/plain_files %s/p/plain_files"):format(folder,
      folder))))
  end)

  it("removes the temporary files of a killed one, and no others", function()
    local small = write("small.lua", SMALL)
    assert_success("tiles %s --size 20x20 -o %s/p --progress none", small, folder)
    shell(("mkdir '%s/p/openseadragon'"):format(folder))
    local dead = { "small_files/5/.0_0.png.7f30.part", "small_files/.x.png.0000.part",
      ".index.html.12ef.part", ".small.dzi.0001.part",
      "openseadragon/.openseadragon.min.js.00aa.part" }
    local others = { "small_files/5/mine.part", ".mine.xyz1.part", "mine" }
    for _, names in ipairs { dead, others } do
      for _, name in ipairs(names) do write("p/" .. name, "part of a file") end
    end
    write("p/.alive.png.0002.part", "")
    local code = shell(("flock '%s/p/.alive.png.0002.part' '%s' tiles '%s' --size 20x20 -o '%s/p' "
      .. "--progress none"):format(folder, workbench.binary, small, folder))
    assert.are.equal(0, code)
    for _, name in ipairs(dead) do assert.is_nil(read(folder .. "/p/" .. name), name) end
    for _, name in ipairs(others) do assert.is_not_nil(read(folder .. "/p/" .. name), name) end
    assert.is_not_nil(read(folder .. "/p/.alive.png.0002.part"))
  end)

  it("distinguishes what a script is given from other values, if it has procedures", function()
    local small = write("small.lua", [[
      local celspan = require "celspan"
      local colour = ... or celspan.parameters { tint = { colour = "#0f0" } }.tint
      return celspan.rostrum{ celspan.cel{ celspan.scanline{ bounds = {0, 0, 9, 9},
        spans = function(y) return { {0, y, colour} } end } } }]])
    local arguments = "tiles %s --size 20x20 -o %s/p%d --progress none %s"
    for i, way in ipairs { "-- '%s'", "--set 'tint=%s'" } do
      assert_success(arguments, small, folder, i, way:format "#f00")
      assert_success(arguments, small, folder, i, way:format "#f00")
      assert.are.equal(2, (celspan(arguments, small, folder, i, way:format "#00f")))
    end
  end)

  it("names the tile that cannot be written", function()
    assert_success("tiles %s -o %s/p --tile 64 --levels 0-1 --progress none", script, folder)
    shell(("mkdir -p '%s/p/plain_files/9/4_3.png/in the way'"):format(folder))
    local code, _, err = celspan("tiles %s -o %s/p --tile 64 --levels 9-9 --progress none", script,
      folder)
    assert.are.equal(5, code, err)
    assert.is_truthy(err:find("plain_files/9/4_3.png", 1, true), err)
  end)

  it("ends by its signal and leaves no incomplete file", function()
    local code = shell(("timeout -s INT 0.5 '%s' tiles %s --size 20000x20000 --tile 32 --overlap 0 "
      .. "--tiles-limit 1000000 -o %s/p --progress none"):format(workbench.binary, script, folder))
    assert.is_true(code == 124 or code == 130, tostring(code))
    assert.are.equal(0, count_files(folder .. "/p", "*.part"))
    assert.is_nil(read(folder .. "/p/index.html"))
  end)
end)

describe("wrong usage", function()
  for arguments, message in pairs {
    ["tiles %s"] = "give -o DIR",
    ["tiles %s -o p --tile 3"] = "16 to 8192",
    ["tiles %s -o p --tile 64 --overlap 40"] = "half",
    ["tiles %s -o p --format iiif --overlap 1"] = "share no pixels",
    ["tiles %s -o p --levels 3-99"] = "levels 0 to 10",
    ["tiles %s -o p --picture webp"] = "not png or jpg",
    ["tiles %s -o p --format zip"] = "dzi or iiif",
  } do
    it("of " .. arguments:gsub("%%s", "SCRIPT") .. " is refused", function()
      local code, _, err = celspan(arguments, script)
      assert.are.equal(2, code)
      assert.is_truthy(err:find(message, 1, true), err)
    end)
  end

  it("is an invalid file of places, or one with places outside the film", function()
    for _, place in ipairs { "somewhere", "1 2 3", "1 2 nan it", "1 2 inf it", "1 2 1e999 it",
      "1 2 0 it",
      "1 2 -1 it", "-1 2 3 it",
      "701 2 3 it", "1 -2 3 it", "1 501 3 it", "1 2 3 " .. ("long "):rep(60) } do
      write("places.txt", "0 0 1 the corner\n" .. place .. "\n")
      local code, _, err = celspan("tiles %s -o %s/p --places %s/places.txt", script, folder,
        folder)
      assert.are.equal(2, code, place)
      assert.is_truthy(err:find("places.txt:2: a place is X Y WIDTH NAME, within the film of 700 "
        .. "x 500 units", 1, true), err)
    end
  end)

  it("is a folder whose name is too long, or that cannot be made", function()
    for _, case in ipairs { { ("x/"):rep(3000), "the name is too long" },
      { "/proc/nothing/here", "cannot make its folder" } } do
      local code, _, err = celspan("tiles %s -o %s --progress none", script, case[1])
      assert.are.equal(5, code, err)
      assert.is_truthy(err:find(case[2], 1, true), err)
    end
  end)

  it("is a limit for a picture", function()
    local code, _, err = celspan("tiles tests/faults/pixels.png -o %s/p --limit steps=1", folder)
    assert.are.equal(2, code)
    assert.is_truthy(err:find("are for scripts", 1, true), err)
  end)

  it("is a missing file, or a folder that cannot be made", function()
    assert.are.equal(4, (celspan("tiles %s/none.png -o %s/p", folder, folder)))
    assert.are.equal(4, (celspan("tiles %s -o %s/p --places %s/none", script, folder, folder)))
    assert.are.equal(4, (celspan("tiles %s -o %s/p --places %s", script, folder, folder)))
    assert.are.equal(5, (celspan("tiles %s -o %s/p --progress none", script, "/dev/null")))
  end)
end)

describe("an existing viewer", function()
  local VIEWER = ("// a viewer\n"):rep(3000) -- more than is copied at once

  local function is_copied(options)
    local small = write("small.lua", SMALL)
    assert_success("tiles %s --size 20x20 -o %s/p --fresh --progress none %s", small, folder,
      options)
    local page = read(folder .. "/p/index.html")
    return page:find([["openseadragon": true]], 1, true) ~= nil,
      read(folder .. "/p/openseadragon/openseadragon.min.js")
  end

  it("is copied next to the page, which refers to it, and is kept", function()
    shell(("mkdir -p '%s/checkout/build/openseadragon' '%s/plain'"):format(folder, folder))
    write("plain/openseadragon.min.js", VIEWER)
    write("checkout/build/openseadragon/openseadragon.min.js", VIEWER)
    for _, place in ipairs { "plain", "checkout", "plain/openseadragon.min.js" } do
      shell(("rm -rf '%s/p'"):format(folder))
      for _, options in ipairs { ("--viewer %s/%s"):format(folder, place), "" } do
        -- then kept from the run before
        local is_told, bytes = is_copied(options)
        assert.is_true(is_told and bytes == VIEWER, place)
      end
    end
  end)

  it("is copied, and places are read, by a confined process too", function()
    shell(("mkdir -p '%s/viewers' '%s/scripts'"):format(folder, folder))
    write("viewers/a.js", VIEWER)
    write("places.txt", "3 3 2 here\n")
    -- A leak check attaches to the process from another one, which --strict does not allow.
    local code, _, err =
      shell(("ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 '%s' tiles '%s' --size 20x20 -o "
      .. "'%s/p' --strict "
      .. "--viewer '%s/viewers/a.js' --places '%s/places.txt' --progress none")
      :format(workbench.binary,
      write("scripts/small.lua", SMALL), folder, folder, folder))
    if code == 6 and err:find("--strict: ", 1, true) then
      return pending "the kernel cannot confine a process"
    end
    assert.are.equal(0, code, err)
    assert.is_true(VIEWER == read(folder .. "/p/openseadragon/openseadragon.min.js"))
    assert.is_truthy(read(folder .. "/p/index.html"):find('"here"', 1, true))
  end)

  it("is an error if it cannot be written", function()
    write("a.js", VIEWER)
    shell(("mkdir -p '%s/p/openseadragon/openseadragon.min.js/in the way'"):format(folder))
    local code, _, err = celspan("tiles %s --size 20x20 -o %s/p --viewer %s/a.js --progress none",
      write("small.lua", SMALL), folder, folder)
    assert.are.equal(5, code)
    assert.is_truthy(err:find("openseadragon.min.js", 1, true), err)
  end)
end)

describe("a missing viewer", function()
  it("is reported before anything is made", function()
    os.execute(("mkdir -p '%s/x.js'"):format(folder))
    write("empty.js", "")
    for _, viewer in ipairs { "nowhere", "x", folder, folder .. "/x.js", folder .. "/empty.js" } do
      local code, _, err = celspan("tiles %s -o %s/p --viewer %s --progress none", script, folder,
        viewer)
      assert.are.equal(4, code)
      assert.are.equal(("celspan: error: --viewer %s: it contains no readable "
        .. "openseadragon.min.js\n"):format(viewer), err)
      assert.are.equal(0, #system.lines(("find '%s/p' 2>/dev/null"):format(folder)))
    end
  end)
end)

describe("the page", function()
  it("contains its data safely and requests nothing from the network", function()
    assert_success("tiles %s -o %s/p --progress none", script, folder)
    local page = read(folder .. "/p/index.html")
    assert.is_truthy(page:find([["title": "a \u003cplain\u003e one"]], 1, true))
    assert.is_nil(page:find("https?://"))
    assert.is_nil(page:find("@PYRAMID@", 1, true) or page:find("@VIEWER@", 1, true))
    assert.is_truthy(page:find([["openseadragon": false]], 1, true))
  end)

  local it_in_node = present.pictures() and present.program "node" and it or pending

  --- The drawing of the page after some actions, as a picture, and its reported state.
  local function draw_in_node(window, actions)
    local code, text, message = shell(("node tests/support/page.js %s/p/index.html %s %s")
      :format(folder, window, actions))
    assert.are.equal(0, code, message)
    write("page.lua", text)
    assert_success("render %s/page.lua -o %s/page.png --progress none", folder, folder)
    return text
  end

  --- The frame, 2400 x 1500, as a crop of it at some size.
  local function expect(size, crop, most)
    assert_success("render %s --frames 1 --size %s --crop %s -o %s/frame.png --progress none",
      script,
      size, crop, folder)
    local differs = difference(folder .. "/page.png", folder .. "/frame.png")
    assert.is_true(differs and differs <= most, ("%s %s: %s"):format(size, crop, differs))
  end

  local function make_tiles(options)
    script = write("ground.lua", (PLAIN:gsub("} } } }", '} } }, back = "#fbe9c6" }')))
    assert_success("tiles %s -o %s/p --size 2400x1500 --progress none %s", script, folder, options)
  end

  for _, layout in ipairs { "dzi", "iiif" } do
    it_in_node("draws with its own viewer the same as a render: " .. layout, function()
      make_tiles("--format " .. layout)
      draw_in_node("600 375 1", "hash:1200,750,2400")
      expect("600x375", "0,0,600,375", 0.02)
      draw_in_node("600 375 2", "hash:1200,750,2400") -- twice as many pixels on the same screen
      expect("1200x750", "0,0,1200,750", 0.02)
      draw_in_node("600 375 1", "hash:1100,700,600")
      expect("2400x1500", "800,512,600,375", 1 / 255 + 1e-9)
      local text = draw_in_node("600 375 1", "hash:1200,750,1200 drag:300,200,200,150 key:1")
      assert.is_truthy(text:find("-- address: #1400,850,600\n-- ", 1, true), text:sub(-200))
      assert.is_truthy(text:find("-- missing: 0", 1, true))
      expect("2400x1500", "1100,662,600,375", 1 / 255 + 1e-9)
    end)
  end

  it_in_node("keeps the point under the pointer in place, and stays inside its limits", function()
    make_tiles ""
    local function told(actions, window)
      return draw_in_node(window or "600 375 1", actions):match "address: #?(%S*)"
    end
    -- Pixel (450, 100) of the window shows (1800, 400) before and after.
    assert.are.equal("1500,575,1200", told "wheel:450,100,-300")
    assert.are.equal("1200,750,600", told "pinch:300,187.5,4")
    assert.are.equal("1680,750,2400", told "key:ArrowRight")
    assert.are.equal("1200,750,2400", told "key:+ key:ArrowLeft key:0")
    assert.are.equal("1200,750,75", told(("key:PageDown "):rep(12)))
    assert.are.equal("1200,750,3000", told(("key:- "):rep(4)))
    assert.are.equal("1200,750,1200", told "click:in")
    make_tiles("--places " .. write("places.txt", "350 250 70 middle\n7 490 7 corner\n"))
    assert.are.equal("1200,750,240", told "place:middle")
    assert.are.equal("1200,750,2400", told "place:corner place:middle place:everything")
    assert.are.equal("24,1470,75", told "place:middle place:corner")
  end)

  it_in_node("shows coarser tiles where finer ones do not exist, or do not arrive", function()
    make_tiles "--levels 0-10"
    local text = draw_in_node("600 375 1", "hash:1100,700,600")
    assert.is_truthy(text:find("-- missing: 0", 1, true))
    expect("2400x1500", "800,512,600,375", 0.9)
    assert.is_true(difference(folder .. "/page.png", folder .. "/frame.png") > 0)
    make_tiles "--fresh"
    draw_in_node("600 375 1", "lose:_files/12/ hash:1100,700,600")
    local coarse = read(folder .. "/page.png")
    draw_in_node("600 375 1", "lose:_files/12/ lose:_files/11/ lose:_files/10/ hash:1100,700,600")
    assert.are_not.equal(coarse, read(folder .. "/page.png"))
    local _, opaque = shell(("grep -c celspan.rect %s/page.lua"):format(folder))
    assert.is_true(tonumber(opaque) > 3) -- every place is still drawn
  end)

  it_in_node("shows the kept tiles that there are while a coarser one has not arrived", function()
    make_tiles ""
    local text = draw_in_node("60 37 1", "hold:_files/7/ lose:_files/9/0_0 hash:1200,750,2400")
    assert.is_truthy(text:find("_files/9/1_0", 1, true), text)
    assert.is_nil(text:find("_files/9/0_0", 1, true))
  end)

  local it_in_a_browser = present.program("chromium", "python3") and it or pending

  --- The drawing of the page at a place, as a PNG file: its canvas, without the buttons over it.
  local function draw_in_browser(port, place, path)
    shell(("timeout 90 chromium --headless=new --no-sandbox --disable-gpu "
      .. "--user-data-dir=%s/browser --window-size=600,600 --virtual-time-budget=9000 --dump-dom "
      .. "'http://127.0.0.1:%s/probe.html#%s' >%s/dom.html"):format(folder, port, place, folder))
    shell(([[python3 -c 'import base64, re, sys
dom = open("%s/dom.html").read()
data = re.search("<title>data:image/png;base64,([^<]*)</title>", dom).group(1)
open("%s", "wb").write(base64.b64decode(data))']]):format(folder, path))
    local png = read(path)
    assert.is_not_nil(png, "the page drew nothing")
    return string.unpack(">I4I4", png, 17)
  end

  local function serve(path)
    local port = system.lines("python3 -c 'import socket; s = socket.socket(); "
      .. "s.bind((\"127.0.0.1\", 0)); print(s.getsockname()[1])'")[1]
    local server = system.lines(("python3 -m http.server %s --bind 127.0.0.1 --directory '%s' "
      .. ">/dev/null 2>&1 & echo $!"):format(port, path))[1]
    shell(("for i in 1 2 3 4 5 6 7 8 9 10; do python3 -c 'import urllib.request; "
      .. "urllib.request.urlopen(\"http://127.0.0.1:%s/\")' && break; sleep 0.2; done")
      :format(port))
    return port, server
  end

  -- Something to see at every depth: rings around a place, each a third as wide as the one before.
  local DEEP = [[
    local celspan = require "celspan"
    local rings = { celspan.rect { 0, 0, 1000, 1000, texture = "#20304a" } }
    for i = 0, 9 do
      local side = 900 / 3 ^ i
      for k = 0, 7 do
        rings[#rings + 1] = celspan.rect { 0.3 * side, -0.1 * side, 0.15 * side, 0.2 * side,
          texture = celspan.rgb(0.2 + 0.1 * k, 0.9 - 0.1 * k, (i % 3) / 2) }
          :rotate(45 * k + 10 * i):translate(432.6, 692.9)
      end
    end
    return celspan.film { size = { 1000, 1000 }, frames = 1, frame = function()
      return celspan.rostrum { celspan.cel(rings) }
    end }]]

  it_in_a_browser("shows at four depths the same as a render #plain", function()
    write("deep.lua", DEEP)
    write("deep.txt", "432.1 693.2 9.6 near\n433.2 692.7 2.6 nearer\n441 698 44 beside\n")
    assert_success("tiles %s/deep.lua --size 100000x100000 --levels 8-10 "
      .. "--places %s/deep.txt -o %s/p --progress none", folder, folder, folder)
    -- A browser without a screen runs faster than time, but rarely requests a frame, and its clock
    -- does not wait for pictures that are decoded in the background.
    write("p/probe.html", (read(folder .. "/p/index.html"):gsub("<head>", [[%0<script>
      requestAnimationFrame = call => setTimeout(() => call(performance.now()), 16);
      delete HTMLImageElement.prototype.decode;
      setTimeout(() => { document.title = here("view").toDataURL(); }, 6000);</script>]])))
    local port, server = serve(folder .. "/p")
    local views = { { 50000, 50000, 100000 }, { 44100, 69800, 5000 }, { 43210, 69320, 960 },
                    { 43320, 69270, 300 } }
    local sizes = {}
    for i, v in ipairs(views) do
      local path = ("%s/shot%d.png"):format(folder, i)
      sizes[i] = { pcall(draw_in_browser, port, table.concat(v, ","), path) }
    end
    os.execute("kill " .. server)
    for i, v in ipairs(views) do
      local is_drawn, w, h = table.unpack(sizes[i])
      assert.is_true(is_drawn, w)
      local scale = w / v[3]
      local side = math.floor(100000 * scale + 0.5)
      assert_success("render %s/deep.lua --size %dx%d --crop %d,%d,%d,%d -o %s/x%d.png "
        .. "--progress none", folder, side, side, math.floor(v[1] * scale - w / 2 + 0.5),
        math.floor(v[2] * scale - h / 2 + 0.5), w, h, folder, i)
      local _, text = celspan("compare %s/x%d.png %s/shot%d.png --fail 0.15", folder, i, folder, i)
      local differing = tonumber(text:match("pixels_differing (%d+)"))
      assert.is_true(differing and differing < w * h * 0.1, i .. " " .. text)
    end
  end)
end)
