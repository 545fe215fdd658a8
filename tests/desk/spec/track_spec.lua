-- Following a region through files, and the queries of a track. tests/kit/unit/test_track.c checks
-- the accuracy.
local celspan = require "celspan"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local track = require "celspan.track"
local workbench = require "tests.support.workbench"

if not present.pictures() then
  describe("following", function()
    it("is through pictures", function() pending "there is no picture module" end)
  end)
  return
end

local bench, folder
local WIDTH, HEIGHT, FRAMES = 240, 160, 9

--- A card of spots, 90 x 70.
local function spots(seed, count, w, h)
  local random = celspan.random(seed)
  local parts = { celspan.rect { 0, 0, w, h, texture = "#777777" } }
  for i = 1, count do
    parts[#parts + 1] = celspan.circle { centre = { w * random("x" .. i), h * random("y" .. i) },
      radius = 2 + 6 * random("r" .. i),
      texture = celspan.rgb(random("a" .. i), random("b" .. i), random("c" .. i)) }
  end
  return celspan.clip(celspan.union(parts), celspan.rect { 0, 0, w, h })
end

local ground, card = spots("ground", 160, WIDTH, HEIGHT), spots("card", 70, 90, 70)

--- The position of the card, or of something on it, in a frame.
local function pose(object, n)
  return object:translate(-45, -35):rotate(3 * (n - 4)):translate(115 + 2.5 * (n - 4), 82 - 1.5 * n)
end

local function write_frames()
  for n = 1, FRAMES do
    local cels = { celspan.cel { ground }, celspan.cel { pose(card, n) } }
    if n == 6 then cels[3] = celspan.cel { spots("cover", 160, WIDTH, HEIGHT) } end
    local image = assert(celspan.pixels(celspan.rostrum(cels), { size = { WIDTH, HEIGHT } }))
    assert(image:write(("%s/card.%04d.png"):format(folder, n)))
  end
end

local function region() return pose(celspan.rect { 4, 4, 82, 62 }, 4) end

local followed

setup(function()
  bench = workbench.new()
  folder = bench.folder
  write_frames()
  followed = assert(track.follow(folder .. "/card.####.png", { from = 4, at = region() }))
end)

teardown(function() bench:remove() end)

--- The centre of the bounds of an object.
local function centre(object)
  local x, y, w, h = object:bounds()
  return x + w / 2, y + h / 2
end

local function dot(x, y) return celspan.circle { centre = { x, y }, radius = 0.001 } end

describe("a track", function()
  it("reports the position of the region in each frame, and where it is lost", function()
    assert.are.same({ 1, 2, 3, 4, 5, 6, 7, 8, 9 }, followed.frames)
    assert.are.same({ 6 }, followed.lost)
    assert.are.same({ 4, "similarity", WIDTH, HEIGHT },
      { followed.from, followed.model, followed.width, followed.height })
    local _, is_found = followed:motion(6)
    assert.is_false(is_found)
    _, is_found = followed:motion(7)
    assert.is_true(is_found)
    assert.are.same({ 1, 0, 0, 0, 1, 0, 0, 0, 1 }, (followed:motion(4)))
  end)

  it("places art within a fifth of a pixel", function()
    for n = 1, FRAMES do
      for _, at in ipairs { { 10, 10 }, { 80, 60 }, { 45, 35 } } do
        local x, y = centre(pose(dot(at[1], at[2]), n))
        local said_x, said_y = centre(followed:place(pose(dot(at[1], at[2]), 4), n))
        local limit = n == 6 and 0.5 or 0.2 -- between the frames beside it where it was lost
        assert.near(x, said_x, limit)
        assert.near(y, said_y, limit)
      end
    end
  end)

  it("steadies moving art, and accepts cels and a film's frames", function()
    local x, y = centre(followed:steady(pose(dot(20, 20), 8), 8))
    local first_x, first_y = centre(pose(dot(20, 20), 4))
    assert.near(first_x, x, 0.2)
    assert.near(first_y, y, 0.2)
    local film = celspan.film { size = { WIDTH, HEIGHT }, frames = FRAMES, frame = function(f)
      return celspan.rostrum { followed:place(celspan.cel { pose(card, 4) }, f) }
    end }
    local r, g, b = celspan.probe(film, 115, 70, { frame = 5 })
    local s, t, u = celspan.probe(celspan.rostrum { celspan.cel { followed:place(pose(card, 4),
      5) } },
      115, 70)
    assert.are.same({ s, t, u }, { r, g, b })
  end)

  it("is constant outside its frames", function()
    assert.are.same((followed:motion(9)), (followed:motion(50)))
    assert.are.same((followed:motion(1)), (followed:motion(-3)))
  end)

  it("is written and read back", function()
    local path = folder .. "/card.json"
    assert.is_true(followed:write(path))
    local again = assert(track.read(path))
    assert.are.same(followed.frames, again.frames)
    assert.are.same(followed.lost, again.lost)
    for n = 1, FRAMES do assert.are.same((followed:motion(n)), (again:motion(n))) end
    assert.are.same({ nil, folder .. "/no/card.json.part: No such file or directory" },
      { followed:write(folder .. "/no/card.json") })
  end)

  it("follows a rectangle, selected frames, and with all models", function()
    local x, y, w, h = region():bounds()
    for _, model in ipairs { "similarity", "perspective" } do
      local t = assert(track.follow(folder .. "/card.####.png",
        { from = 4, at = { x + 12, y + 12, w - 24, h - 24 }, frames = "4-5", model = model }))
      assert.are.same({ 4, 5 }, t.frames)
      assert.are.equal(0, #t.lost)
    end
  end)
end)

describe("the hat of scripts/hat.lua", function()
  it("is placed by its track within half a pixel of the head", function()
    package.path = "scripts/?.lua;" .. package.path
    setmetatable(_G, { __index = celspan.names {} }) -- as in scripts that the program runs
    local head, t = require "hat.head", assert(track.read "../../../scripts/hat/track.json")
    for n = 1, head.frames do
      for _, at in ipairs { { -60, -40 }, { 60, -40 }, { 0, 60 } } do
        local x, y = centre(head.pose(dot(at[1], at[2]), n - 1))
        local said_x, said_y = centre(t:place(head.pose(dot(at[1], at[2]), 0), n))
        assert.near(x, said_x, 0.5)
        assert.near(y, said_y, 0.5)
      end
    end
  end)
end)

describe("following", function()
  local function follow(options, pattern)
    local t, message = track.follow(pattern or folder .. "/card.####.png", options)
    assert.is_nil(t)
    return message
  end

  it("reports what is wrong with files and regions", function()
    local at = { 50, 50, 80, 60 }
    assert.are.equal(folder .. "/hat.####.png: there are no such files",
      follow({ from = 1, at = at }, folder .. "/hat.####.png"))
    assert.is_truthy(follow({ from = 20, at = at }):find("frame 20, in which", 1, true))
    assert.is_truthy(follow({ from = 1, at = at, frames = "1-12" }):find("frame 10: ", 1, true))
    assert.is_truthy(follow({ from = 1, at = at, frames = "1-" }):find("1-", 1, true))
    assert.is_truthy(follow({ from = 1, at = { 1, 1, 5,
      5 } }):find("frame 1: track: the region is 5 x 5", 1, true))
    assert.is_truthy(follow({ from = 1, at = celspan.union {} })
      :find("card.####.png: frame 1: the object 'at' covers nothing", 1, true))
    assert.is_truthy(follow({ from = 1, at = at }, folder):find(folder, 1, true))
    local grey = celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 99, 99, texture = "#888" } } }
    assert(assert(celspan.pixels(grey, { size = { 90, 90 } })):write(folder .. "/grey.1.png"))
    assert.is_truthy(follow({ from = 1, at = { 9, 9, 70, 70 } }, folder .. "/grey.#.png")
      :find("too little texture: 0 corners were found, and 4 are needed", 1, true))
    assert(assert(celspan.pixels(grey, { size = { 90, 80 } })):write(folder .. "/card.0099.png"))
    local message = follow { from = 1, at = at }
    os.remove(folder .. "/card.0099.png")
    assert.is_truthy(message:find("has 90 x 80 pixels, and the first frame 240 x 160", 1, true))
  end)

  it("refuses wrong fields at the caller's line", function()
    local function refused(options)
      local here = debug.getinfo(1, "l").currentline
      local message, line = raised.sentence(function() track.follow("a.#.png", options) end)
      assert.are.equal(here + 1, line)
      return message
    end
    local at = { 1, 2, 30, 40 }
    local function has(message, words) assert.is_truthy(message:find(words, 1, true), message) end
    has(refused { from = 1, at = at, framez = "1" }, "did you mean 'frames'?")
    has(refused { at = at }, "field 'from' must be the number of a frame, got nil")
    has(refused { from = 1.5, at = at }, "got 1.5")
    has(refused { from = 1 }, "field 'at' must be {x, y, w, h} or an object, got nil")
    has(refused { from = 1, at = celspan.cel { region() } }, "or an object, got a cel")
    has(refused { from = 1, at = { 1, 2, 3 } }, "at[4]")
    has(refused { from = 1, at = at, model = "affine" }, "affine")
    has(raised.message(function() followed:place(3, 1) end),
      "place takes an object or a cel, got number")
    has(raised.message(function() followed:steady(dot(1, 1), "x") end),
      "steady takes a frame or its number")
    has(raised.message(function() return followed.lots end), "did you mean 'lost'?")
  end)
end)

describe("a file of a track", function()
  local function message_of(text)
    local path = folder .. "/bad.json"
    local file = assert(io.open(path, "wb"))
    file:write(text)
    file:close()
    local t, message = track.read(path)
    assert.is_nil(t)
    return message:gsub("^.*bad%.json: ", "")
  end
  local head = '{"celspan": "track", "from": 1, "model": "similarity", "at": [1, 2, 3, 4], '
    .. '"size": [5, 6], "frames": '

  it("is refused with the position of the fault", function()
    assert.are.equal("the file must be a track of celspan", (message_of "{}"))
    assert.are.equal("frames is missing", (message_of((head:gsub(', "frames": ', "}")))))
    for _, list in ipairs { '[{"frame": 1, "lost": true}]}', "[]}" } do
      assert.are.equal("frames must be a list with a frame in which the region was found",
        (message_of(head .. list)))
    end
    assert.are.equal("frames[1].matrix must be 9 numbers",
      (message_of(head .. '[{"frame": 1, "matrix": []}]}')))
    assert.are.equal("frames[1].matrix: 9 must be a number from -1e+15 to 1e+15, got inf",
      (message_of(head .. '[{"frame": 1, "matrix": [1,0,0,0,1,0,0,0,1e999]}]}')))
    assert.are.equal("frames[1].matrix must be invertible",
      (message_of(head .. '[{"frame": 1, "matrix": [0,0,0,0,0,0,0,0,0]}]}')))
    assert.are.equal("frames[2].frame must be a number that is not already used", (message_of(head
      .. '[{"frame": 1, "lost": true}, {"frame": 1, "lost": true}]}')))
    assert.are.equal("frames[1].frame must be a whole number from -1000000000000000 to "
      .. "1000000000000000, got 1.5", (message_of(head .. '[{"frame": 1.5}]}')))
    assert.is_truthy(message_of(head):find("line 1", 1, true))
    assert.is_truthy(select(2, track.read(folder .. "/none.json")):find("No such file", 1, true))
  end)
end)

describe("celspan track", function()
  local function run(arguments) return bench:celspan_inside("track %s", arguments) end

  it("writes a track and reports lost frames", function()
    local code, out, err = run "card.####.png --from 4 --at 75,45,80,60 -o made/card.json"
    assert.are.equal(0, code, err)
    assert.are.equal("", out)
    assert.are.equal("celspan: 9 frames followed, 1 lost: 6\n", err)
    assert.are.same({ 6 }, assert(track.read(folder .. "/made/card.json")).lost)
    code, out = run "card.####.png --from 4 --at 75,45,80,60 --frames 4-5 --model translation"
    assert.are.equal(0, code)
    assert.is_truthy(out:find('"model": "translation"', 1, true))
  end)

  it("has the exit codes of all verbs", function()
    assert.are.equal(2, (run "card.####.png"))
    assert.are.equal(2, (run "card.####.png --from 4 --at 1,2,3"))
    assert.are.equal(2, (run "card.####.png --from 4 --at 1,2,30,40 --model affine"))
    assert.are.equal(4, (run "hat.####.png --from 4 --at 1,2,30,40"))
    assert.are.equal(4, (run "card.####.png --from 4 --at 1,2,3,4"))
    assert.are.equal(5,
      (run "card.####.png --from 4 --at 75,45,80,60 --frames 4-5 -o card.0001.png/x.json"))
  end)
end)
