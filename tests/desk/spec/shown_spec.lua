-- A file has one film, and a frame of a film one look: whatever verb shows them makes the same
-- picture, in the working space of the film, or in that of the kind of file.
--
-- All files show black at 4/10 over white: 6/10 of the light, or of the codes.
local celspan = require "celspan"
require "celspan.spec"
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local LIGHT, CODES = 203, 153 -- 8-bit codes
local bench = workbench.new()

teardown(function() bench:remove() end)

-- ---------------------------------------------------------------- the files

local SCRIPT = [[
local celspan = require "celspan"
local size = { 8, 8 }
local film = { size = size, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8, texture = "#fff" } },
    celspan.cel { celspan.rect { 0, 0, 8, 8, texture = "#000" }, opacity = 0.4 }:named "veil" }
end }
film.space = %q
return celspan.film(film)
]]

local function even(code) return function() return code, code, code, 255 end end

local painting = { w = 8, h = 8, layers = {
  { name = "paper", x = 0, y = 0, w = 8, h = 8, pixel = even(255) },
  { name = "veil", x = 0, y = 0, w = 8, h = 8, pixel = even(0), opacity = 0.4 },
} }

local DRAWING = [[
<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">
<rect width="8" height="8" fill="#fff"/><rect width="8" height="8" opacity="0.4"/></svg>
]]

local files = {
  { "linear.lua", LIGHT, SCRIPT:format "linear" },
  { "srgb.lua", CODES, SCRIPT:format "srgb" },
  { "painting.ora", CODES, paintings.openraster(painting) },
  { "drawing.svg", CODES, DRAWING },
}
for _, file in ipairs(files) do bench:write(file[1], file[3]) end

-- ---------------------------------------------------------------- the verbs

local function run(arguments, ...)
  local code, out, err = bench:celspan_inside(arguments, ...)
  assert.equal(0, code, err)
  return out, err
end

--- The red code of a pixel of a picture.
local function pixel(name, x, y)
  local drawn = celspan.image { file = bench.folder .. "/" .. name }
  local _, _, w, h = drawn:bounds()
  local rostrum = celspan.rostrum { antialias = "none", celspan.cel { drawn } }
  local image = assert(celspan.pixels(rostrum, { size = { w // 1 | 0, h // 1 | 0 } }))
  return image:bytes({ depth = 8 }):byte(4 * (y * image.width + x) + 1)
end

local count = 0

--- The red code in the middle of a picture of 8 by 8 pixels that a verb makes.
local function middle_of(arguments, name)
  count = count + 1
  local output = count .. ".png"
  run(arguments, name, output)
  return pixel(output, 4, 4)
end

local function code_of(light)
  local drawn = celspan.rect { 0, 0, 1, 1, texture = celspan.rgb(light, light, light) }
  local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { drawn } },
    { size = { 1, 1 } }))
  return (image:bytes { depth = 8 }):byte(1)
end

--- Of a verb: what it shows of a file, as a code of 8 bits.
local shows = {}

function shows.render(file) return middle_of("render %s -o %s", file[1]) end

function shows.convert(file)
  return middle_of("convert %s %s", file[1])
end

function shows.contact(file)
  run("contact %s -o contact-%s.png", file[1], file[1])
  return pixel(("contact-%s.png"):format(file[1]), 20, 20)
end

function shows.tiles(file)
  run("tiles %s -o tiles-%s", file[1], file[1])
  local name = file[1]:gsub("%..*", "")
  return pixel(("tiles-%s/%s_files/3/0_0.png"):format(file[1], name), 4, 4)
end

function shows.probe(file)
  local out = run("probe %s 4 4", file[1])
  return code_of(tonumber(out:match "^%S+"))
end

function shows.plane(file)
  run("render %s -o %s.plane", file[1], file[1])
  return middle_of("convert %s.plane %s", file[1])
end

function shows.watch(file)
  local ask = '{"want":"frame","number":1,"size":[8,8],"crop":[0,0,8,8],"what":"rgba"}'
  bench:write("ask", string.pack(">s4", ask))
  -- The picture is given up when the requests end.
  local wait = ("(cat ask; for i in $(seq 900); do grep -qE 'picture|false' answer-%s && break; "
    .. "sleep 0.02; done) | timeout 20 '%s' stage %s >answer-%s")
  bench:inside(wait:format(file[1], workbench.absolute, file[1], file[1]))
  local answers, at = bench:read("answer-" .. file[1]), 1
  local message, head
  repeat -- the picture may come before the answer that says that it is begun
    message, at = (">s4"):unpack(answers, at)
    head = (">s4"):unpack(message)
  until head:find "picture"
  return message:byte(-4)
end

function shows.trace(file)
  run("trace %s -o traced.svg --colours 1", file[1])
  return tonumber(bench:read("traced.svg"):match 'fill="#(%x%x)', 16)
end

function shows.relight(file)
  return middle_of("relight %s -o %s --light '#fff' --to '#fff'", file[1])
end

local it_sees = present.pictures() and present.type() and it or pending

local of_films = { "render", "contact", "probe", "tiles", "watch" }
local of_pictures = { "convert", "trace", "relight" }

--- Tests that all these verbs show the file in its code, or one that is `off` from it.
local function compare_verbs(verbs, file, off)
  for _, verb in ipairs(verbs) do
    it_sees(("%s looks the same to %s"):format(file[1], verb), function()
      assert.near(file[2], shows[verb](file), off)
    end)
  end
end

describe("one film of a file:", function()
  for _, file in ipairs(files) do
    local is_script = file[1]:find "%.lua$"
    compare_verbs(of_films, file, 0)
    if not is_script then compare_verbs(of_pictures, file, 0) end
    -- A plane has no layers of pictures in sRGB, and colours of 16 bits in light.
    if file[1] ~= "painting.ora" then compare_verbs({ "plane" }, file, 1) end
  end
end)

describe("a file", function()
  it_sees("is compared as it is rendered", function()
    for i = 3, 4 do
      local name = files[i][1]
      run("render %s -o %s.png", name, name)
      assert.near(0, tonumber(run("compare %s %s.png --fail 0.002", name, name):match " (%S+)"),
        0.002)
    end
  end)

  it_sees("of Photoshop is its merged picture to the verbs of pictures, which say so", function()
    bench:write("painting.psd", paintings.psd(painting))
    assert.equal(CODES, middle_of("render %s -o %s", "painting.psd"))
    local _, err = run "convert painting.psd merged.png"
    assert.matches("painting.psd: its merged picture is taken; 'celspan render' shows its layers",
      err, 1, true)
  end)

  it_sees("has one frame", function()
    for _, arguments in ipairs { "convert drawing.svg a.png --frame 2",
      "convert painting.ora a.png --frame 2" } do
      local code, _, err = bench:celspan_inside(arguments)
      assert.equal(2, code)
      assert.matches("there is no frame 2: it has only frame 1", err, 1, true)
    end
  end)

  it_sees("that is damaged is named with its line", function()
    bench:write("torn.svg", '<svg xmlns="http://www.w3.org/2000/svg">\n<rect')
    local code, _, err = bench:celspan_inside "render torn.svg -o torn.png"
    assert.equal(4, code)
    assert.matches("^celspan: error: torn.svg:2: ", err)
  end)

  it_sees("of a drawing sets its texts in the font that is given", function()
    bench:write("text.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8">'
      .. '<text y="8" font-size="16">I</text></svg>')
    local font = os.getenv "PWD" .. "/scripts/type/block.ttf"
    local _, err = run "render text.svg -o bare.png"
    assert.matches("no font is given: 'celspan render --set font=FILE' gives one", err, 1, true)
    _, err = run("render text.svg -o set.png --set 'font=%s' --allow '%s'", font,
      font:match "^(.*)/")
    assert.is_nil(err:find("no font is given", 1, true))
    assert.equal(1, (bench:celspan_inside "compare bare.png set.png"))
  end)
end)

-- ---------------------------------------------------------------- frames in Lua

describe("a film in srgb", function()
  local film = load(SCRIPT:format "srgb")()

  it_sees("looks like its picture to a spec", function()
    run "render srgb.lua -o golden.png"
    assert.frame(film, 1).looks_like(bench.folder .. "/golden.png")
    assert.point(film, 1, 4, 4).shows "#999999"
  end)

  it("shows no cel that changes nothing", function()
    local function frame()
      return celspan.rostrum { table.unpack(film:at(1)), celspan.cel {}:named "nothing" }
    end
    assert.cel(film:with { frame = frame }, 1, "nothing").is_not.visible()
    assert.cel(film, 1, "veil").is_visible()
  end)

  it("has planes of its colours", function()
    local image = assert(assert(celspan.plane(film)):pixels())
    assert.equal(CODES, (image:bytes { depth = 8 }):byte(1))
  end)

  it_sees("has skins of its colours", function()
    local both = [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 2, space = "srgb", frame = function(f)
  if f.number == 2 then return celspan.rostrum {} end
  return celspan.rostrum { celspan.cel { %s } }
end }]]
    local paper = "celspan.rect { 0, 0, 8, 8, texture = %q }"
    bench:write("mixed.lua", both:format(paper:format "#fff" .. ", "
      .. "celspan.rect { 0, 0, 8, 8, texture = celspan.rgb('#000', 0.4) }"))
    bench:write("flat.lua", both:format(paper:format "#999"))
    for _, name in ipairs { "mixed", "flat" } do
      run("render %s.lua --onion 1,0 --frames 2 -o %s-skin.png", name, name)
    end
    assert.equal(0, (bench:celspan_inside "compare mixed-skin.png flat-skin.png --fail 0.005"))
  end)
end)
