-- Pictures in tiles, in the program. Their blocks: unit/tiled.

local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

-- Pictures are read.
local it_reads = present.pictures() and it or pending

local bench, folder

before_each(function()
  bench = workbench.new()
  folder = bench.folder
  bench:write("scan.lua", [[
return film { size = { 700, 500 }, frame = function()
  return rostrum { cel { rect { 200, 0, 500, 500, fill = "#336699" },
    circle { 450, 250, 60, fill = radial { centre = { 450, 250 }, radius = 60,
      { 0, "#ffffff" }, { 1, "#aa3311" } } } } }
end }]])
end)

after_each(function() bench:remove() end)

local function run(arguments, ...)
  local code, out, err = bench:celspan(arguments, ...)
  assert.are.equal(0, code, err)
  return out
end

--- Makes the scan, and tiles of it in the folder p.
local function cut(options)
  run("render %s/scan.lua -o %s/scan.png --progress none", folder, folder)
  run("tiles %s/scan.lua -o %s/p --tile 64 --progress none %s", folder, folder, options or "")
end

--- A film of objects in the units of the scan; returns its script.
local function film(objects)
  return bench:write("film.lua", ([[return film { size = { 700, 500 }, frame = function()
    return rostrum { cel { %s } } end }]]):format(objects))
end

local function render(name, options)
  run("render %s/film.lua -o %s/%s --progress none %s", folder, folder, name, options or "")
end

local function difference(a, b)
  return tonumber(run("compare %s/%s %s/%s --fail 1", folder, a, folder, b)
    :match "largest_difference ([%d.e+-]+)")
end

--- What a render says that fails.
local function failure()
  local code, _, err = bench:celspan("render %s/film.lua -o %s/x.png", folder, folder)
  assert.are_not.equal(0, code)
  return err
end

describe("a picture in tiles", function()
  it_reads("is itself at scale 1, and a level at its scale, with any threads", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    render("one.png", "--workers 1")
    render("four.png", "--workers 4 --memory 2")
    assert.are.equal(0, difference("one.png", "scan.png"))
    assert.are.equal(0, difference("four.png", "scan.png"))
    render("half.png", "--size 350x250")
    run("render %s/scan.lua -o %s/level.png --size 350x250 --progress none", folder, folder)
    assert.are.equal(0, difference("half.png", "level.png"))
    render("all.png", "--size 1000x714")
    render("part.png", "--size 1000x714 --crop 531,200,300,200")
    film 'image { file = "all.png", x = -531, y = -200 }'
    render("cut.png", "--crop 0,0,300,200")
    assert.are.equal(0, difference("part.png", "cut.png"))
  end)

  it_reads("is the same with only the tiles that hold something", function()
    cut "--sparse"
    local code = bench:shell(("test -e %s/p/scan_files/10/4_1.png"):format(folder))
    assert.are_not.equal(0, code)
    assert.is_not_nil(bench:read(folder .. "/p/scan_files/10/6_3.png"))
    film 'image { file = "p/scan.dzi" }'
    render "sparse.png"
    assert.are.equal(0, difference("sparse.png", "scan.png"))
  end)

  it_reads("takes the next smaller level where a tile is missing, which the probe sees", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    os.remove(folder .. "/p/scan_files/10/6_3.png")
    render "hole.png"
    local far = difference("hole.png", "scan.png")
    assert.is_true(far > 0 and far < 0.4, tostring(far))
    local there = tonumber(run("probe %s/scan.lua 425.5 213.5", folder):match "[%d.]+")
    local here = tonumber(run("probe %s/film.lua 425.5 213.5", folder):match "[%d.]+")
    assert.is_true(there ~= here and math.abs(there - here) < 0.05, there .. " " .. here)
  end)

  it_reads("is another picture after a tile has been replaced", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    render("kept.#.png", "--resume")
    assert.are.equal(0, difference("kept.1.png", "scan.png"))
    bench:write("new.png", bench:read(folder .. "/p/scan_files/10/7_3.png"))
    assert(os.rename(folder .. "/new.png", folder .. "/p/scan_files/10/6_3.png"))
    render("kept.#.png", "--resume")
    assert.is_true(difference("kept.1.png", "scan.png") > 0)
  end)

  it_reads("names a tile that is damaged, and all its tiles are files of the film", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    bench:write("p/scan_files/10/6_3.png", "no picture")
    assert.is_truthy(failure():find("p/scan_files/10/6_3.png: ", 1, true))
    run("check %s/film.lua", folder)
    local files = run("check %s/film.lua --files", folder)
    assert.is_truthy(files:find("p/scan.dzi", 1, true) and files:find("files/10/6_3.png", 1, true))
  end)

  it_reads("has the tiles that there are as files, whatever its description says", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    local text = bench:read(folder .. "/p/scan.dzi")
    bench:write("p/scan.dzi", (text:gsub('Width="%d+"', 'Width="99999999999999999999"')))
    local _, files = bench:shell(("timeout 20 '%s' check '%s/film.lua' --files")
      :format(bench.absolute, folder))
    for level = 0, 10 do
      assert.is_truthy(files:find(("scan_files/%d/0_0.png"):format(level), 1, true))
    end
  end)
end)

describe("celspan tiles --sparse", function()
  it("needs tiles that share pixels", function()
    for _, options in ipairs { "--overlap 0", "--format iiif" } do
      local code, _, err = bench:celspan("tiles %s/scan.lua -o %s/p --sparse %s", folder, folder,
        options)
      assert.are.equal(2, code)
      assert.is_truthy(err:find("--sparse needs --format dzi and --overlap 1", 1, true), err)
    end
  end)
end)

describe("a description of tiles", function()
  local GOOD = '<Image Format="png" Overlap="1" TileSize="64"><Size Width="9" Height="9"/>'
    .. "</Image>"

  for name, case in pairs {
    ["no number"] = { '"64"', '"-64"', "in tiles of -1" },
    ["a tile of nothing"] = { '"64"', '"0"', "in tiles of 0" },
    ["much overlap"] = { '"1"', '"33"', "33 of overlap" },
    ["a huge size"] = { '"9"', '"99999999999"', "-1 x 9 pixels" },
    ["a large size"] = { '"9"', '"20000000"', "20000000 x 9 pixels" },
    ["another folder"] = { '"png"', '"/../x"', "in files '/../x'" },
    ["a long ending"] = { '"png"', '"portable"', "in files ''" },
    ["no size"] = { "<Size.->", "", "-1 x -1 pixels" },
    ["no end"] = { "</Image>", "", "scan.dzi:1" },
    ["entities of entities"] = { "^",
      '<!DOCTYPE x [<!ENTITY a "aa"><!ENTITY b "&a;&a;">]>', "entit" },
    ["no tiles"] = { "^", "", "no level has its first tile, 0_0.png" },
  } do
    it_reads("is refused with " .. name, function()
      bench:write("scan.dzi", (GOOD:gsub(case[1], (case[2]:gsub("%%", "%%%%")), 1)))
      film 'rect { 0, 0, 9, 9, fill = picture { file = "scan.dzi" } }'
      local message = failure()
      assert.is_truthy(message:find(case[3], 1, true), message)
    end)
  end

  it_reads("says where it is missing, and goes without source, smooth and layer", function()
    film 'rect { 0, 0, 9, 9, fill = picture { file = "none.dzi" } }'
    assert.is_truthy(failure():find("none.dzi: cannot be opened", 1, true))
    bench:write("scan.dzi", GOOD)
    for _, field in ipairs { "source = { 0, 0, 1, 1 }", "smooth = true", 'layer = "a"' } do
      film(('rect { 0, 0, 9, 9, fill = picture { file = "scan.dzi", %s } }'):format(field))
      assert.is_truthy(failure():find("one in tiles has no pixels", 1, true))
    end
  end)

  it_reads("is that of its image and size, whatever else it has", function()
    cut()
    film 'image { file = "p/scan.dzi" }'
    local text = bench:read(folder .. "/p/scan.dzi")
    bench:write("p/scan.dzi", (text:gsub("</Image>", '<DisplayRects><DisplayRect MinLevel="1" '
      .. 'MaxLevel="2"><Rect X="0" Y="0" Width="5" Height="6"/></DisplayRect></DisplayRects>%0')))
    render "other.png"
    assert.are.equal(0, difference("other.png", "scan.png"))
  end)
end)

describe("a picture with details", function()
  it_reads("is read at its own scale in each of them", function()
    cut()
    bench:write("detail.lua", [[
return film { size = { 400, 300 }, frame = function()
  return cel { rect { 0, 0, 400, 300, fill = "#204010" }, circle { 200, 150, 90, fill = "#fe9" } }
end }]])
    run("render %s/detail.lua -o %s/detail.png --progress none", folder, folder)
    local BOX = "{ 0, 0, 700, 500 }"
    --- A film of a part of the frame, w units wide, filled by a texture in `folder`.
    local function part(name, texture, x, y, w, h)
      bench:write("film.lua", ([[return film { size = { 400, %g }, frame = function()
        return { cel { rect { -700, -500, 2100, 1500, fill = %s } },
          camera = { centre = { %g, %g }, width = %g } } end }]]):format(400 * h // w, texture,
        x + w / 2, y + h / 2, w))
      render(name)
    end
    local detailed = ([[picture { file = "p/scan.dzi", box = %s, %%s
      details = { { file = "detail.png", box = { 448, 248, 4, 3 } } } }]]):format(BOX)
    -- The detail is itself at its scale; around it is the scan, and around the scan nothing.
    part("near.png", detailed:format "", 448, 248, 4, 3)
    assert.is_true(difference("near.png", "detail.png") < 1 / 255)
    part("far.png", detailed:format "", -350, -250, 1400, 1000)
    part("plain.png", ("picture { file = 'p/scan.dzi', box = %s }"):format(BOX), -350, -250, 1400,
      1000)
    local seen = difference("far.png", "plain.png")
    assert.is_true(seen > 0.05 and seen < 1, seen) -- about a pixel
    part("there.png", detailed:format "", 700 * 1025 + 448, 248, 4, 3)
    part("clear.png", "'#0000'", 0, 0, 4, 3)
    assert.equal(0, difference("there.png", "clear.png"))
    part("again.png", detailed:format "wrap = 'repeat',", 1148, 748, 4, 3)
    assert.is_true(difference("again.png", "near.png") < 1 / 255)
  end)

  it_reads("says what is wrong with them", function()
    cut()
    for fields, message in pairs {
      ["details = { {} }"] = "picture: field 'box' must be a box {x, y, width, height}, got nil",
      ["box = { 0, 0, 1, 1 }, details = 3"] =
        "picture: field 'details' must be a list of {box =, file =}, got number",
      ["box = { 0, 0, 1, 1 }, details = { 7 }"] =
        "picture: detail 1 must be {box =, file =}, got number",
      ["box = { 0, 0, 1, 1 }, details = { { file = 'p.png', box = { 0, 0, 1 } } }"] =
        "picture: detail 1: field 'box'[4] must be a number, got nil",
      ["box = { 0, 0, 1, 1 }, wrap = 'clamp', details = {}"] =
        'picture: one with details cannot have wrap = "clamp": "clear" or "repeat"',
      ["box = { 0, 0, 1, 1 }, details = { { box = { 0, 0, 1, -4 }, file = 'p.png' } }"] =
        "picture: detail 1: width and height of its box must be above 0, got -4",
      ["box = { 0, 0, 1, 1 }, details = { box = { 0, 0, 1, 1 } }"] =
        "picture: field 'details' must be a list of {box =, file =}; it has the key 'box'",
      ["box = { 0, 0, 1, 1 }, details = { { details = {} } }"] =
        "picture: detail 1 has details: list them all in the picture",
    } do
      film(("rect { 0, 0, 9, 9, fill = picture { file = 'p/scan.dzi', %s } }"):format(fields))
      assert.matches(message, failure(), 1, true)
    end
  end)
end)
