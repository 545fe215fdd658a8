-- Lottie animations: how layers depend on each other, by mattes, masks, parents and compositions;
-- their sounds, and their slots.
local celspan = require "celspan"
local lotties = require "tests.support.lotties"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
local try, write = lotties.reader(bench)
local still, keys, layer, box, at = lotties.still, lotties.keys, lotties.layer, lotties.box,
  lotties.code
local RED, NONE = "ff0000 255", "000000 0"

local function read(layers, fields, options) return assert(try(layers, fields, options)) end

local function placed(x, y) return { p = still { x, y } } end

teardown(function() bench:remove() end)

describe("mattes", function()
  it("are not of a layer that names itself: it is seen", function()
    local art = read { layer({ box(20, 20) }, { ind = 1, tt = 1, tp = 1, ks = placed(50, 50) }) }
    assert.same(RED, at(art, 0, 50, 50))
    assert.same({ "layers[0] 'art': its mattes form a circle; it has none" }, art.skipped)
  end)

  it("of mattes are cut where there are too many", function()
    local list = {}
    for i = 1, 300 do
      list[i] = layer({ box(20, 20) }, { ind = i, tt = i > 1 and 1 or nil, ks = placed(50, 50) })
    end
    local art = read(list)
    assert.same(RED, at(art, 0, 50, 50))
    assert.same("layers[21] 'art': more than 20 mattes of mattes; it has none", art.skipped[1])
    for i = 1, 300 do list[i].tp = i + 1 end -- the same the other way
    list[1].tt = 1
    assert.same(RED, at(read(list), 0, 50, 50))
  end)
end)

describe("parents", function()
  it("are at most a hundred, in whatever order they are listed", function()
    for _, step in ipairs { 1, -1 } do
      local list = {}
      for i = 1, 150 do
        local place = step > 0 and i or 151 - i
        list[place] = layer({ box(2, 2) }, { ind = i, parent = i > 1 and i - 1 or nil,
          ks = placed(0.5, 0.5) })
      end
      assert.matches("its parents form a circle, or are too many", read(list).skipped[1])
    end
  end)
end)

describe("a layer that follows its way", function()
  local p = keys { { 10, { 20, 20 } }, { 20, { 20, 60 } }, { 40, { 20, 60 } }, { 50, { 80, 60 } } }
  local art = function() return read { layer({ box(20, 4) }, { ao = 1, ks = { p = p } }) } end

  it("has the direction of the nearest way, before, between and after its keys", function()
    local one = art()
    for frame, want in pairs { [0] = "down", [10] = "down", [15] = "down", [30] = "down",
                               [45] = "right", [50] = "right", [90] = "right" } do
      local _, _, w, h = one:at(frame):bounds()
      assert.same({ frame, want }, { frame, w > h and "right" or "down" })
    end
  end)

  it("that never moves is not turned", function()
    local _, _, w, h = read({ layer({ box(20, 4) }, { ao = 1,
      ks = { p = keys { { 0, { 5, 5 } }, { 9, { 5, 5 } } } } }) }):at(3):bounds()
    assert.is_true(w > h)
  end)
end)

describe("masks", function()
  local function rectangle(x0, x1)
    local none = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }
    return { c = true, i = none, o = none, v = { { x0, 0 }, { x1, 0 }, { x1, 100 }, { x0, 100 } } }
  end
  local function masked(list)
    local masks = {}
    for i, one in ipairs(list) do
      masks[i] = { mode = one[1], pt = still(one[2]), o = still(100) }
    end
    return read { layer({ { ty = "rc", p = { k = { 50, 50 } }, s = { k = { 100, 100 } } },
                          select(2, box(1, 1)) }, { masksProperties = masks }) }
  end

  it("of one mode are as many as there are", function()
    for _, mode in ipairs { "a", "s" } do
      local list = {}
      for i = 1, 300 do list[i] = { mode, rectangle((i - 1) / 6, i / 6) } end
      local art = masked(list)
      assert.same(mode == "a" and { RED, NONE } or { NONE, RED }, { at(art, 0, 20.05, 50),
        at(art, 0, 70, 50) })
      assert.same({}, art.skipped)
    end
  end)

  it("of changing modes, or of differences, are listed when there are too many", function()
    local list = {}
    for i = 1, 150 do list[i] = { i % 2 == 1 and "a" or "i", rectangle(0, 50) } end
    local art = masked(list)
    assert.same(RED, at(art, 0, 20, 50))
    assert.matches("^layers%[0%]%.masksProperties%[20%] 'art': its layer has too many masks",
      art.skipped[1])
    for i = 1, 40 do list[i] = { "f", rectangle(0, 10 * i) } end
    art = masked(list)
    assert.is_userdata(art:at(0))
    assert.matches("masksProperties%[6%] 'art': its layer has too many", art.skipped[1])
  end)
end)

describe("compositions", function()
  it("nested too deep are refused with what is too deep", function()
    local assets = {}
    for i = 0, 300 do
      assets[i + 1] = { id = "c" .. i, layers = { { ty = 0, refId = "c" .. i + 1 } } }
    end
    local art, message = try({ { ty = 0, refId = "c0" } }, { assets = assets })
    assert.is_nil(art)
    assert.matches("layers: compositions are nested more than 200 deep; that is the limit$",
      message)
  end)

  it("nested deeper than can be drawn leave a note, and no error", function()
    local assets = { { id = "c0", layers = { layer({ box(20, 20) }, { ks = placed(50, 50) }) } } }
    for i = 1, 150 do
      assets[i + 1] = { id = "c" .. i, layers = { { ty = 0, refId = "c" .. i - 1, ip = 0, op = 9,
        w = 100, h = 100, ks = { p = still { 0.1, 0 } } } } }
    end
    local art = read({ { ty = 0, refId = "c150", ip = 0, op = 9, w = 100, h = 100, ks = {} } },
      { assets = assets })
    assert.is_userdata(art:at(0))
    assert.matches("it cannot be drawn at frame 0: .*nested 129 levels deep", art.skipped[1])
  end)
end)

describe("what is left out", function()
  it("is in the order of the file", function()
    local assets = {}
    for i = 1, 9 do assets[i] = { id = "p" .. i, w = 9, h = 9, p = ("none-%d.png"):format(i) } end
    local art = read({}, { assets = assets })
    for i = 1, 9 do
      assert.matches(("^assets%%[%d%%]: the picture 'p%d' is missing"):format(i - 1, i),
        art.skipped[i])
    end
  end)
end)

describe("a composition that is shown twice", function()
  --- The alpha of the pixel that is half covered, where layers show the same composition.
  local function edge(...)
    local inner = layer({ box(20.5, 20) }, { ks = placed(40.25, 40) }) -- from 30 to 50.5
    local list = {}
    for i, fields in ipairs { ... } do
      list[i] = { ty = 0, refId = "c", ip = 0, op = 100, st = 0, w = 100, h = 100 }
      for name, value in pairs(fields) do list[i][name] = value end
    end
    local art = read(list, { assets = { { id = "c", layers = { inner } } } })
    local film = celspan.film { size = { 100, 100 }, frames = 1, space = "srgb", frame = function()
      return celspan.rostrum { celspan.cel { art:at(0) } }
    end }
    local codes = assert(celspan.pixels(film)):bytes { depth = 8, alpha = "straight" }
    local place = 4 * (100 * 40 + 50)
    assert.same({ 255, 0, 0 }, { codes:byte(place + 1, place + 3) })
    return codes:byte(place + 4)
  end

  it("in the same place has both edges, as in players", function()
    assert.same(128, edge {})
    assert.same(191, edge({}, {}))
    assert.same(223, edge({}, {}, {}))
  end)

  it("at other places, times or frames is not averaged", function()
    assert.same(128, edge({}, { ks = placed(-0.5, 0) }))
    assert.same(128, edge({}, { op = 0 }))
    assert.same(128, edge({}, { hd = true }))
  end)
end)

describe("sounds", function()
  bench:write("a.wav", "RIFF")
  local voice = { id = "v", p = "a.wav", u = "" }
  local function song(fields)
    local item = { ty = 6, refId = "v", ip = 0, op = 100, st = 0 }
    for name, value in pairs(fields or {}) do item[name] = value end
    return item
  end
  local function heard(layers, inner, fields)
    local assets = { voice, { id = "c", layers = inner or {} } }
    local document = { assets = assets, ip = 10, op = 90 }
    for name, value in pairs(fields or {}) do document[name] = value end
    local art = read(layers, document)
    local list = {}
    for i, one in ipairs(art.sounds) do
      assert.matches("a%.wav$", one[1])
      list[i] = { one.at, one.from, one.to, one.speed }
    end
    return list, art
  end

  it("begin and end with their layer, in seconds of the film and of the file", function()
    -- 25 frames a second; the animation begins at 10
    assert.same({ { 0, 0.4, 3.6 } }, heard { song() })
    assert.same({ { 0.6, 0.4, 1 } }, heard { song { st = 15, ip = 25, op = 40 } })
    assert.same({}, heard { song { ip = 95 } })
  end)

  it("of compositions have the time of each layer that shows them", function()
    local function comp(fields)
      local item = { ty = 0, refId = "c", ip = 0, op = 100, st = 0 }
      for name, value in pairs(fields) do item[name] = value end
      return item
    end
    local list = heard({ comp { st = 20, op = 50 }, comp { st = 60, ip = 60 } }, { song() })
    assert.same({ { 0.4, 0, 1.2 }, { 2, 0, 1.2 } }, list)
    -- twice as slow: the frames 10 to 90 are 5 to 45 of the composition
    assert.same({ { 0, 0.2, 1.8, 0.5 } }, heard({ comp { sr = 2 } }, { song() }))
    local art
    list, art = heard({ comp { tm = keys { { 0, 0 }, { 9, 1 } } } }, { song() })
    assert.same({}, list)
    assert.matches("its time is remapped; its sounds are left out", art.skipped[1])
    list = heard({ comp {} }, { song(), comp {} }) -- a composition in itself
    assert.same(1, #list)
  end)

  it("may be inside the file, by an address", function()
    for _, word in ipairs { "data", "DATA" } do
      local inside = { id = "v", p = word .. ":audio/wav;base64,UklGRg==", e = 1 }
      local art = read({ song() }, { assets = { inside } })
      assert.same({ inside.p, {} }, { art.sounds[1][1], art.skipped })
    end
  end)

  --- A dotLottie file whose layers show the sound b.wav of these bytes.
  local function archive(layers, bytes, version)
    local is_old = version == "1"
    local path = write(lotties.archive {
      { "manifest.json", lotties.json { version = version, animations = { { id = "m" } } } },
      { (is_old and "animations/" or "a/") .. "m.json", lotties.json(lotties.document(layers,
        { assets = { { id = "v", p = "b.wav", u = "/audio/" }, { id = "w", p = "w.wav" } } })) },
      { is_old and "audio/b.wav" or "u/b.wav", bytes }, { "u/w.wav", "RIFF" },
    }, "lottie")
    return path
  end
  local function in_archive(...) return assert(require "celspan.lottie".read(archive(...))) end

  it("may be in the archive, in the folder of either version", function()
    for version = 1, 2 do
      for bytes, coded in pairs { ["RIFF \0\255,%"] = "UklGRiAA/ywl", ["a\254"] = "Yf4=",
                                  ["a"] = "YQ==" } do
        local art = in_archive({ song() }, bytes, tostring(version))
        assert.same({ "data:;base64," .. coded, {} }, { art.sounds[1][1], art.skipped })
      end
    end
  end)

  it("inside the file are at most 128 MiB, counted for each layer", function()
    local inside, many = { id = "v", p = "data:," .. ("a"):rep(16 << 20) }, {}
    for i = 1, 10 do many[i] = song() end
    many[11], many[12] = song { refId = "w" }, song { refId = "s" }
    local art = read(many, { assets = { inside, { id = "w", p = "a.wav" },
                                        { id = "s", p = "data:,a" } } })
    -- with its first letters, the eighth is beyond; a.wav is a file, and the last one has room
    assert.same(9, #art.sounds)
    assert.matches("a%.wav$", art.sounds[8][1])
    assert.same("data:,a", art.sounds[9][1])
    assert.matches("layers%[7%].*its sound is missing: the sounds inside the file are larger",
      art.skipped[1])
  end)

  it("in the archive count as many bytes as they have, and are not read when there is no room",
    function()
      local many = {}
      for i = 1, 40 do many[i] = song() end -- 80 MiB, and 240 MiB as escapes of addresses
      local art = in_archive(many, ("\255"):rep(2 << 20))
      assert.same({ 40, {} }, { #art.sounds, art.skipped })
      local path = archive({ song(), song { refId = "w" } }, "RIFF")
      local text = bench:read(path:match "[^/]*$")
      local place = assert(text:find("u/b.wav", text:find("PK\1\2", 1, true), true))
      text = text:sub(1, place - 23) .. string.pack("<I4", 200 << 20) .. text:sub(place - 18)
      art = assert(require "celspan.lottie".read(write(text, "lottie"))) -- it says 200 MiB
      assert.same(1, #art.sounds)
      assert.matches("layers%[0%].*larger than 128 MiB", art.skipped[1])
    end)

  it("that are not in the archive or the file are noted", function()
    local art = read({ song() }, { assets = { { id = "v", p = "none.wav" } } })
    assert.matches("its sound is missing: there is no file 'none.wav'", art.skipped[1])
    local path = write(lotties.archive {
      { "manifest.json", lotties.json { animations = { { id = "m" } } } },
      { "a/m.json", lotties.json(lotties.document({ song() }, { assets = { voice } })) },
    }, "lottie")
    art = assert(require "celspan.lottie".read(path))
    assert.matches("its sound is missing: .*the archive has no 'u/a.wav'", art.skipped[1])
  end)

  it("are at most a thousand", function()
    local many = {}
    for i = 1, 1002 do many[i] = song() end
    local list, art = heard(many)
    assert.same(1000, #list)
    assert.matches("more than 1000 sounds", art.skipped[1])
  end)
end)

describe("slots", function()
  it("have the kind of the property that uses them, also when they are set", function()
    local item = layer({ { ty = "rc", p = { k = { 0, 0 } }, s = { k = { 20, 20 } } },
                         { ty = "fl", c = { k = { 1, 0, 0 } }, o = { k = 100 } } },
      { ks = { p = { sid = "place" } } })
    local slots = { place = { p = still { 50, 50, 0 } } } -- three numbers, as of a colour
    local art = read({ item }, { slots = slots })
    assert.same({ kind = "list", value = { 50, 50, 0 } }, art.slots.place)
    art = read({ item }, { slots = slots }, { set = { place = "20, 80" } })
    assert.same({ RED, NONE }, { at(art, 0, 20, 80), at(art, 0, 50, 50) })
    local none, message = try({ item }, { slots = slots }, { set = { place = "#f00" } })
    assert.is_nil(none)
    assert.matches("the slot 'place' takes numbers$", message)
  end)

  it("are named by strings", function()
    local path = write(lotties.document {})
    raised.each {
      ["lottie: read: set is values by slot, such as { tint = \"#f80\" }"] =
        function() require "celspan.lottie".read(path, { set = { 7, x = 1 } }) end,
    }
  end)

  local function themed(rules, item, slots)
    local path = write(lotties.archive {
      { "manifest.json", lotties.json { animations = { { id = "m" } },
        themes = { { id = "t" } } } },
      { "a/m.json", lotties.json(lotties.document({ item }, { slots = slots })) },
      { "t/t.json", lotties.json { rules = rules } },
    }, "lottie")
    return assert(require "celspan.lottie".read(path, { theme = "t" }))
  end

  it("that are gradients have as many stops as the theme says", function()
    local item = layer { { ty = "rc", p = { k = { 50, 50 } }, s = { k = { 100, 100 } } },
      { ty = "gf", t = 1, o = { k = 100 }, s = { k = { 0, 0 } }, e = { k = { 100, 0 } },
        g = { p = 2, k = { sid = "sky" } } } }
    local slots = { sky = { p = { p = 2, k = still { 0, 0, 0, 0, 1, 0, 0, 0 } } } }
    assert.same("000000 255", at(read({ item }, { slots = slots }), 0, 50, 50))
    local stops = { { offset = 0, color = { 1, 0, 0, 1 } },
                    { offset = 0.5, color = { 0, 1, 0, 1 } },
                    { offset = 1, color = { 0, 0, 1, 1 } } }
    local art = themed({ { id = "sky", type = "Gradient", value = stops } }, item, slots)
    assert.same({ "00ff00 255", "808000 255" }, { at(art, 0, 50, 50), at(art, 0, 25, 50) })
    local held = { { frame = 0, value = stops } }
    art = themed({ { id = "sky", type = "Gradient", keyframes = held } }, item, slots)
    assert.same("00ff00 255", at(art, 0, 50, 50))
  end)

  it("that a theme names and the animation lacks are listed; rules of other animations are not its",
    function()
      local item = layer({ box(20, 20) }, { ks = { p = { sid = "place" } } })
      local art = themed({ { id = "plce", value = { 1, 1 } },
                           { id = "place", value = { 20, 80 }, animations = { "other" } } }, item,
        { place = { p = still { 50, 50 } } })
      assert.same({ "the theme has a rule for 'plce', which is no slot of the animation" },
        art.skipped)
      assert.same(RED, at(art, 0, 50, 50))
    end)
end)
