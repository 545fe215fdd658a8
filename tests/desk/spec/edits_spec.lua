-- Edit lists and storyboards: what is written is read again by celspan, and by a second reader here
-- that follows the published specification of OpenTimelineIO.
local celspan = require "celspan"
local cut = require "celspan.cut"
local json = require "celspan.json"
local workbench = require "tests.support.workbench"

local bench
setup(function() bench = workbench.new() end)
teardown(function() bench:remove() end)

local NTSC = 30000 / 1001

--- The films that FILMS makes, here and in scripts.
local FILMS = [[
local celspan, fps = require "celspan", ...
local function film(count, colour, more)
  local made = { size = { 16, 9 }, fps = fps, frames = count, first = 3, frame = function(f)
    return celspan.rect { 0, 0, 16, 9, texture = celspan.rgb(f.number / 200, colour, 0) }
  end }
  for name, value in pairs(more or {}) do made[name] = value end
  return celspan.film(made)
end
return { hall = film(48, 0.2), nell = film(96, 0.4, { marks = { door = { 10, 14 } } }),
         chase = film(100, 0.6) }
]]

local function films_at(fps) return assert(load(FILMS))(fps) end

local CUT = [[
local cut = require "celspan.cut"
local F = load(%q)(%s)
return cut { cut.fade(6.4 / %s), { film = F.hall, name = "hall" }, cut.dissolve(11 / %s),
  { film = F.nell, name = "nell", from = 8, to = 63 },
  { film = F.chase, name = "chase", from = 14, speed = 1.5 },
  cut.wipe { angle = 90, softness = 0.25 }(7 / %s, "inQuad"),
  { film = F.hall, name = "slow", to = 22, speed = 0.7 }, cut.iris { centre = { 4, 5 } }(2 / %s),
  { film = F.hall, name = "end", to = 20 }, cut.dissolve(5 / %s),
  title = "Evening", marks = { beat = 30, range = { 40, 50 } },
  sound = { { "a.wav", at = 12 / %s, to = 1, name = "voice" },
            { "b.wav", at = 18 / %s, speed = 2 } } }
]]

--- The text of a film of five shots at a rate, which is also this text.
local function script_at(fps)
  local rate = fps == NTSC and "(30000 / 1001)" or tostring(fps)
  local films = ("%q"):format(FILMS)
  return (CUT:gsub("%%(.)", function(what) return what == "s" and rate or films end))
end

--- Writes the edit list of a film; returns its text.
local function written(name, script, more)
  bench:write("film.lua", script)
  local code, _, err = bench:celspan_inside("sheet film.lua -o %s %s", name, more or "")
  assert.are.equal(0, code, err)
  return bench:read(name)
end

local function read(name, text, films)
  if text then bench:write(name, text) end
  return cut.read(bench.folder .. "/" .. name, films)
end

local function refused(message, ...)
  local film, found = read(...)
  assert.is_nil(film)
  assert.truthy(found:find(message, 1, true), found)
end

--- The frames of a film as texts: their pixels.
local function frames(film)
  local list = {}
  for number = film.first, film.first + film.frames - 1 do
    list[#list + 1] = assert(celspan.pixels(film, { frame = number, size = { 16, 9 } })):bytes()
  end
  return list
end

local function with_names(films)
  films.slow, films["end"] = films.hall, films.hall
  return films
end

--- The sounds of a film as texts.
local function sounds_of(film)
  local list = {}
  for i, sound in ipairs(film.sound) do
    list[i] = ("%s %.6f %.6f %.6f %g"):format(sound[1]:match "[^/]*$", sound.at, sound.from,
      sound.to, sound.speed)
  end
  return list
end

-- ---------------------------------------------------------------- a reader from the specification

--- The members that the schemas of OpenTimelineIO 0.17 have beside OTIO_SCHEMA.
local SCHEMAS = {
  ["Timeline.1"] = "global_start_time metadata name tracks",
  ["Stack.1"] = "children effects enabled markers metadata name source_range",
  ["Track.1"] = "children effects enabled kind markers metadata name source_range",
  ["Clip.2"] = "active_media_reference_key effects enabled markers media_references metadata name "
    .. "source_range",
  ["Gap.1"] = "effects enabled markers metadata name source_range",
  ["Transition.1"] = "in_offset metadata name out_offset transition_type",
  ["Marker.2"] = "color comment marked_range metadata name",
  ["ExternalReference.1"] = "available_image_bounds available_range metadata name target_url",
  ["MissingReference.1"] = "available_image_bounds available_range metadata name",
  ["LinearTimeWarp.1"] = "effect_name metadata name time_scalar",
  ["RationalTime.1"] = "rate value", ["TimeRange.1"] = "duration start_time",
}

--- Raises an error unless an object and all in it have the members of their schemas.
local function check_schemas(value)
  if type(value) ~= "table" or value == json.null then return end
  local names = {}
  for name, member in pairs(value) do
    if name ~= "OTIO_SCHEMA" then names[#names + 1] = name end
    if name ~= "metadata" then check_schemas(member) end
  end
  if value.OTIO_SCHEMA then
    table.sort(names)
    assert.are.equal(SCHEMAS[value.OTIO_SCHEMA], table.concat(names, " "), value.OTIO_SCHEMA)
  end
end

--- A track by the rules of the specification: the media that each clip shows with its transitions,
--- and where. { name, first frame of the media, first frame of the film, count }
local function visible(track, rate)
  local list, at = {}, 0
  local function offset(child, name)
    if not child or child.OTIO_SCHEMA ~= "Transition.1" then return 0 end
    assert.are.equal(rate, child[name].rate)
    return child[name].value
  end
  for i, child in ipairs(track.children) do
    if child.OTIO_SCHEMA ~= "Transition.1" then
      local range = child.source_range
      assert.are.equal(rate, range.duration.rate)
      local before = offset(track.children[i - 1], "in_offset")
      local after = offset(track.children[i + 1], "out_offset")
      local speed = child.effects[1] and child.effects[1].time_scalar or 1
      list[#list + 1] = { child.name, range.start_time.value - before * speed, at - before,
                          range.duration.value + before + after }
      at = at + range.duration.value
    end
  end
  return list, at
end

describe("an edit list", function()
  for _, fps in ipairs { 24, 25, 30, NTSC, 60, 60000 / 1001, 24000 / 1001 } do
    it(("in OpenTimelineIO is exact to the frame at %.6g"):format(fps), function()
      local text = written("cut.otio", script_at(fps), "--media 'shots/{name}.mov'")
      local document = json.decode(text)
      check_schemas(document)
      local tracks = document.tracks.children
      local list, count = visible(tracks[1], fps)
      local film = assert(load(script_at(fps)))()
      assert.are.equal(film.frames, count)
      assert.are.same({ { "hall", 0, 0, 48 }, { "nell", 5, 37, 56 }, { "chase", 11, 93, 60 },
        { "slow", 0, 146, 29 }, { "end", 0, 173, 18 } }, list)
      assert.are.equal("shots/slow.mov",
        tracks[1].children[7].media_references.DEFAULT_MEDIA.target_url)
      assert.are.equal("Audio", tracks[2].kind)
      assert.are.equal(12, math.floor(tracks[2].children[1].source_range.duration.value + 0.5))
      text = written("out/cut.otio", (script_at(fps):gsub("a%.wav", "x/a.wav")))
      assert.truthy(text:find("\"../x/a.wav\"", 1, true))
    end)

    for _, form in ipairs { "otio", "edl" } do
      it(("as .%s is read as it was at %.6g"):format(form, fps), function()
        written("cut." .. form, script_at(fps))
        local wanted, found, shots = load(script_at(fps))(), read("cut." .. form, nil,
          with_names(films_at(fps)))
        assert.are.equal("table", type(shots), shots)
        assert.are.same({}, shots.skipped)
        assert.are.same(frames(wanted), frames(found))
        assert.are.equal(fps, found.fps)
        assert.are.equal("Evening", found.title)
        local marks = wanted.marks
        if form == "edl" then marks.range, marks.door = marks.range[1], marks.door[1] end
        assert.are.same(marks, found.marks)
        assert.are.same({ "hall", "nell", "chase", "slow", "end" }, (function()
          local names = {}
          for i, shot in ipairs(shots) do names[i] = shot.name end
          return names
        end)())
        assert.are.equal(37 / fps, shots[2].from)
        assert.are.equal(93 / fps, shots[2].to)
        assert.are.same({ from = 5 / fps, to = 61 / fps }, shots[2].source)
      end)
    end
  end

  it("of a film that was not cut has one shot, and sounds", function()
    written("one.edl", [[return film { frames = 50, title = "One", size = { 16, 9 },
      sound = "a.wav", frame = function() return rect { 0, 0, 1, 1 } end }]])
    local films = { One = films_at(24).nell }
    local film, shots = read("one.edl", nil, films)
    assert.are.equal(50, film.frames)
    assert.are.equal(1, #shots)
    assert.are.same({ "a.wav 0.000000 0.000000 2.083333 1" }, sounds_of(film))
  end)

  it("has the name of the script, where the film has no title", function()
    local script = [[return film { frames = 5, size = { 16, 9 }, frame = function() end }]]
    local text = written("own.edl", script, "--media 'shots/{name}.mov'")
    assert.matches("^TITLE: film\n", text)
    assert.matches("FROM CLIP NAME: film\n.*SOURCE FILE: shots/film%.mov\n", text)
    assert.are.equal("film", json.decode(written("own.otio", script)).name)
    local code, _, err = bench:celspan_inside("sheet film.lua -o own.edl --media '{nam}.mov'")
    assert.are.equal(2, code)
    assert.matches("%-%-media: '{nam}%.mov': only {name} goes in braces", err)
  end)
end)

-- ---------------------------------------------------------------- CMX 3600

local function edl(...) return table.concat({ "TITLE: x", ... }, "\r\n") .. "\n" end

describe("an EDL", function()
  it("has drop frames, or not, and both go with its FCM line", function()
    local long = { a = films_at(NTSC).hall:with { frames = 20000 } }
    local function count(fcm, to)
      local zero = to:gsub("%d", "0")
      return read("a.edl", edl("FCM: " .. fcm, ("001  a  V  C  %s %s 01%s 01%s"):format(zero, to,
        zero:sub(3), to:sub(3))), long).frames
    end
    assert.are.equal(1800, count("NON-DROP FRAME", "00:01:00:00"))
    assert.are.equal(1800, count("DROP FRAME", "00:01:00:02"))
    assert.are.equal(17982, count("DROP FRAME", "00:10:00:00"))
    assert.are.equal(17982, count("NON-DROP FRAME", "00:10:00;00"))
    assert.truthy(written("d.edl", script_at(NTSC)):find("FCM: DROP FRAME\n", 1, true))
    assert.truthy(written("n.edl", script_at(30)):find("FCM: NON-DROP FRAME\n", 1, true))
    refused("line 3: 00:01:00:00 does not exist with drop frames", "b.edl", edl("FCM: DROP FRAME",
      "001  a  V  C  00:00:00:00 00:01:00:00 01:00:00:00 01:01:00:02"), long)
    refused("line 2: an EDL with drop frames at a rate that has none: 24; set fps =", "b.edl",
      edl "FCM: DROP FRAME", films_at(24))
  end)

  it("has dissolves, black, wipes and gaps", function()
    local film, shots = read("a.edl", edl(
      "001  hall     V     C        00:00:00:00 00:00:01:00 01:00:00:00 01:00:01:00",
      "002  hall     V     C        00:00:01:00 00:00:01:00 01:00:01:00 01:00:01:00",
      "002  nell     V     D    012 00:00:00:00 00:00:01:00 01:00:01:00 01:00:02:00",
      "* FROM CLIP NAME: hall", "* TO CLIP NAME: nell",
      "003  BL       V     C        00:00:00:00 00:00:00:12 01:00:02:00 01:00:02:12",
      "004  BL       V     C        00:00:00:12 00:00:00:12 01:00:02:12 01:00:02:12",
      "* LOC: 01:00:00:00 GREEN   door", "* LOC: 01:00:00:00 GREEN   door",
      "004  chase    V     W017 006 00:00:00:00 00:00:01:00 01:00:02:12 01:00:03:12",
      "005  hall     V     C        00:00:00:00 00:00:01:00 01:00:04:00 01:00:05:00"),
      films_at(24))
    assert.are.equal(120, film.frames)
    assert.are.equal(4, #shots)
    assert.are.same({ from = 0, to = 36 / 24 }, shots[1].source)
    assert.are.equal(1, shots[2].from)
    assert.are.same({ "line 11: event 004: the wipe W017 is not known: it is shown as one from "
      .. "left to right", "the mark 'door' is left out: it lies outside the film, another one has "
      .. "its name, or its name is not allowed" }, shots.skipped)
    local list = frames(film)
    assert.are.equal(list[50], list[90])
    assert.are_not.equal(list[50], list[40])
  end)

  it("has sounds where its channels say so, otherwise the ones of its films", function()
    local films = films_at(24)
    for name, film in pairs(films) do films[name] = film:with { sound = name .. ".wav" } end
    local one = "001  hall  %s  C  00:00:00:12 00:00:01:00 01:00:00:00 01:00:00:12"
    local film = read("a.edl", edl(one:format "AA/V"), films)
    assert.are.equal(1, #film.sound)
    assert.are.equal(0.5, film.sound[1].from)
    film = read("a.edl", edl(one:format "V", "002  nell  A2  C  00:00:00:00 00:00:00:06 "
      .. "01:00:00:06 01:00:00:12"), films)
    assert.are.equal(1, #film.sound)
    assert.are.equal(films.nell, film.sound[1][1])
    assert.are.equal(0.25, film.sound[1].at)
    film = read("a.edl", edl(one:format "V"), films)
    assert.are.equal(films.hall, film.sound[1][1])
  end)

  it("has speeds: M2, slower, reversed and held", function()
    local films = films_at(24)
    local function shown(speed, from)
      local film = read("a.edl", edl("001  hall  V  C  " .. from .. " 00:00:01:16 01:00:00:00 "
        .. "01:00:00:04", "M2   hall  " .. speed .. "  " .. from), films)
      return frames(film)
    end
    local hall = frames(films.hall)
    assert.are.same({ hall[11], hall[11], hall[12], hall[12] }, shown("012.0", "00:00:00:10"))
    assert.are.same({ hall[11], hall[10], hall[9], hall[8] }, shown("-024.0", "00:00:00:10"))
    assert.are.same({ hall[11], hall[11], hall[11], hall[11] }, shown("000.0", "00:00:00:10"))
    local _, shots = read("a.edl", edl(
      "001  hall  V  C  00:00:00:00 00:00:01:00 01:00:00:00 01:00:00:12"), films)
    assert.are.same({ "line 2: event 001: it has 24 frames of its source for 12 of the film, and "
      .. "no M2: it is shown at 2 times its speed" }, shots.skipped)
  end)

  it("may have the codes of tapes, which begin at a whole hour", function()
    local films = films_at(24)
    local film, shots = read("a.edl",
      edl "001  hall  V  C  10:00:00:12 10:00:01:00 01:00:00:00 01:00:00:12", films)
    assert.are.equal("table", type(shots), shots)
    assert.are.same({ from = 0.5, to = 1 }, shots[1].source)
    assert.are.same({ "line 2: event 001: the codes of its source are read without their hour" },
      shots.skipped)
    assert.are.equal(frames(films.hall)[13], frames(film)[1])
  end)

  it("that is wrong is refused with its file, line and event", function()
    local films, at = films_at(24), " 00:00:00:00 00:00:01:00 "
    local function wrong(message, ...)
      refused("bad.edl: " .. message, "bad.edl", edl(...), films)
    end
    wrong("line 3: event 002 begins before the one before it ends",
      "001 hall V C" .. at .. "01:00:00:00 01:00:01:00",
      "002 nell V C" .. at .. "01:00:00:12 01:00:01:12")
    wrong("line 2: event 001: there is no film 'chse'; did you mean 'chase'?",
      "001 chse V C" .. at .. "01:00:00:00 01:00:01:00")
    wrong("line 2: event 001 ends before it begins",
      "001 hall V C" .. at .. "01:00:01:00 01:00:00:00")
    wrong("line 2: event 001: field 'to' must be a frame of the film, 3 to 50, got 122",
      "001 hall V C 00:00:00:00 00:00:05:00 01:00:00:00 01:00:05:00")
    wrong('line 2: "1:0:0:0" is no code', "001 hall V C" .. at .. "1:0:0:0 01:00:00:00")
    wrong("line 2: 00:00:00:24 does not exist at 24 codes a second",
      "001 hall V C 00:00:00:00 00:00:00:24 01:00:00:00 01:00:01:00")
    wrong("line 2: event 001: after its number are a reel",
      "001 hall V D x" .. at .. "01:00:00:00 01:00:01:00")
    wrong("line 2: M2 has an event before it", "M2 hall 12.0 00:00:00:00")
    wrong("has no events", "* FROM CLIP NAME: hall")
    wrong("line 3: event 002: the shot has 24 frames, and its transitions need 30",
      "001 chase V C" .. at .. "01:00:00:00 01:00:01:00",
      "002 nell V D 030" .. at .. "01:00:01:00 01:00:02:00")
    assert.has_error(function() read("bad.edl", "", {}) end)
    assert.has_error(function() read("bad.edl", "", { hall = 3 }) end)
    refused("No such file", "none.edl", nil, films)
    local fast = { a = films_at(12.5).hall }
    refused("whole codes in a second, and the rate is 12.5", "bad.edl", edl(), fast)
    bench:write("film.lua", script_at(12.5))
    local code, _, err = bench:celspan_inside "sheet film.lua -o cut.edl"
    assert.are_not.equal(0, code)
    assert.truthy(err:find("the rate is 12.5", 1, true), err)
  end)

  it("may have 10,000 events", function()
    local lines = {}
    local function code(frame)
      return ("%02d:%02d:%02d:%02d"):format(frame // 86400, frame // 1440 % 60, frame // 24 % 60,
        frame % 24)
    end
    for i = 1, 10000 do
      lines[i] = ("%d %s V C 00:00:00:00 00:00:00:02 %s %s"):format(i,
        i % 2 == 0 and "hall" or "nell", code(2 * i), code(2 * i + 2))
    end
    local film, shots = read("many.edl", edl(table.unpack(lines)), films_at(24))
    assert.are.equal(20000, film.frames)
    assert.are.equal(10000, #shots)
  end)
end)

-- ---------------------------------------------------------------- OpenTimelineIO

local function time(value, rate)
  return ('{"OTIO_SCHEMA":"RationalTime.1","rate":%.17g,"value":%.17g}'):format(rate or 24, value)
end

local function range(from, count, rate)
  return ('{"OTIO_SCHEMA":"TimeRange.1","duration":%s,"start_time":%s}'):format(time(count, rate),
    time(from, rate))
end

local function item(schema, name, source, more)
  return ('{"OTIO_SCHEMA":"%s","name":"%s","source_range":%s%s}'):format(schema, name, source,
    more or "")
end

local function timeline(...)
  return ('{"OTIO_SCHEMA":"Timeline.1","tracks":{"OTIO_SCHEMA":"Stack.1","children":['
    .. '{"OTIO_SCHEMA":"Track.1","kind":"Video","children":[%s]}]}}')
    :format(table.concat({ ... }, ","))
end

describe("OpenTimelineIO", function()
  it("has gaps, media with a start, other rates, speeds and older clips", function()
    local films = films_at(24)
    local media = (',"media_reference":{"OTIO_SCHEMA":"ExternalReference.1","target_url":'
      .. '"file:///m/hall%%20one.mov","available_range":%s}'):format(range(86400, 48))
    films["hall one"] = films.hall
    local function warp(speed)
      return (',"effects":[{"OTIO_SCHEMA":"LinearTimeWarp.1","time_scalar":%g}]'):format(speed)
    end
    local film, shots = read("a.otio", timeline(item("Clip.1", "", range(86410, 12), media),
      item("Gap.1", "", range(0, 6)), item("Clip.2", "nell", range(1, 1, 1)),
      item("Clip.2", "chase", range(4, 6), warp(-0.5)),
      item("Clip.2", "chase", range(4, 2), ',"effects":[{"OTIO_SCHEMA":"FreezeFrame.1"}]')), films)
    assert.are.equal("table", type(shots), shots)
    assert.are.same({}, shots.skipped)
    assert.are.equal(12 + 6 + 24 + 6 + 2, film.frames)
    local list, chase = frames(film), frames(films.chase)
    assert.are.equal(frames(films.hall)[11], list[1])
    assert.are.equal(frames(films.nell)[25], list[19])
    assert.are.same({ chase[5], chase[4], chase[4], chase[3], chase[3], chase[2], chase[5],
      chase[5] }, table.move(list, 43, 50, 1, {}))
    assert.are.same({ 45 + 4, 50 }, film.marks["chase (2)"])
  end)

  it("that is not known is black, and said", function()
    local film, shots = read("a.otio", timeline(item("Clip.2", "hall", range(0, 12),
      ',"effects":[{"OTIO_SCHEMA":"Blur.1"}]'), '"text"', item("Odd.7", "x", range(0, 5)),
      ('{"OTIO_SCHEMA":"Transition.1","transition_type":"Melt","in_offset":%s,"out_offset":%s}')
        :format(time(2), time(2)), item("Clip.2", "nell", range(4, 8))), films_at(24))
    assert.are.equal("table", type(shots), shots)
    assert.are.equal(25, film.frames)
    assert.are.same({ 'track 1, item 1 "hall": the effect Blur is not known',
      "track 1, item 2: an object without a schema is not known: it is shown as black",
      'track 1, item 3 "x": Odd is not known: it is shown as black',
      "track 1, item 4: 'Melt' is not known: it is shown as a dissolve" }, shots.skipped)
  end)

  it("may have nested and further tracks, which are said not to be read", function()
    local text = timeline(item("Clip.2", "hall", range(0, 12)), item("Stack.1", "x", range(0, 5)))
    local further = ',{"OTIO_SCHEMA":"Track.1","kind":"Video","children":[]}]}}'
    local film, shots = read("a.otio", (text:gsub("%]}}$", further)), films_at(24))
    assert.are.equal(17, film.frames)
    assert.are.same({ 'track 1, item 2 "x": what is nested in it is not read: it is black; flatten '
      .. "it", "track 2 is not read: only the first one of pictures and those of sounds are" },
      shots.skipped)
  end)

  it("that is wrong is refused with its file and item", function()
    local films = films_at(24)
    local function wrong(message, text)
      refused("bad.otio: " .. message, "bad.otio", text, films)
    end
    local whole = timeline(item("Clip.2", "hall", range(0, 12)))
    for size = 0, #whole - 2, 7 do
      assert.is_nil((read("bad.otio", whole:sub(1, size), films)))
    end
    wrong("has no OpenTimelineIO timeline", "[]")
    wrong("has no track of pictures", timeline())
    wrong('track 1, item 1 "hall": the duration: value must be a number from 0 to 1e+12, got -3',
      timeline(item("Clip.2", "hall", range(0, -3))))
    wrong('track 1, item 1 "hall": the start_time: value must be a number', timeline(item("Clip.2",
      "hall", range(1e300, 3))))
    wrong('track 1, item 1 "hall": the duration: rate must be', timeline(item("Clip.2", "hall",
      range(0, 3, 0))))
    wrong('track 1, item 1 "hal": there is no film \'hal\'; did you mean \'hall\'?',
      timeline(item("Clip.2", "hal", range(0, 3))))
    wrong('track 1, item 1 "hall" has neither', timeline(item("Clip.2", "hall", "null")))
    wrong('track 1, item 1 "hall": field \'to\' must be a frame of the film, 3 to 50, got 62',
      timeline(item("Clip.2", "hall", range(0, 60))))
    wrong("track 1, item 1 \"hall\": key 2 must be a frame of the film", timeline(item("Clip.2",
      "hall", range(0, 12), ',"effects":[{"OTIO_SCHEMA":"LinearTimeWarp.1","time_scalar":9}]')))
    wrong("has 25 frames a second, and the films 24", timeline(item("Clip.2", "hall",
      range(0, 12, 25))))
    wrong("shows no film", timeline(item("Gap.1", "", range(0, 12))))
    local huge = item("Clip.2", "hall", range(0, 12), ',"effects":[{"OTIO_SCHEMA":'
      .. '"LinearTimeWarp.1","time_scalar":1e9}]')
    wrong('track 1, item 1 "hall": time_scalar must be a number from -100 to 100', timeline(huge))
  end)
end)

-- ---------------------------------------------------------------- storyboards

--- A storyboard of 12 panels as Storyboarder 3 writes it; each has a layer of one colour.
local function write_board(change)
  assert(os.execute(("mkdir -p '%s/images'"):format(bench.folder)))
  local boards, at = {}, 0
  for i = 1, 12 do
    local url = ("board-%d-AB%d"):format(i, i)
    boards[i] = { uid = "AB" .. i, url = url .. ".png", newShot = i % 3 == 1, time = at, number = i,
      shot = i .. "A", duration = i % 2 == 0 and 700 + 10 * i or nil,
      dialogue = i % 2 == 0 and "Line " .. i or nil, action = "walks", notes = "",
      layers = { fill = { url = url .. "-fill.png" },
                 ink = { url = url .. "-ink.png", opacity = 0.5 } } }
    at = at + (boards[i].duration or 2000)
    for _, layer in ipairs { "fill", i ~= 5 and "ink" or nil } do
      local film = celspan.film { size = { 4, 4 }, frame = function()
        return layer == "fill" and celspan.rect { 0, 0, 4, 4, texture = celspan.rgb(i / 12, 0, 0) }
          or celspan.rect { 0, 0, 2, 4, texture = "#0f0" }
      end }
      celspan.render(film, ("%s/images/%s-%s.png"):format(bench.folder, url, layer))
    end
  end
  local document = { version = "3.0.0", aspectRatio = 1.5, fps = 24, defaultBoardTiming = 2000,
                     boards = boards }
  if change then change(document) end
  return read("board.storyboarder", json.encode(document, { plain = true }))
end

describe("a storyboard", function()
  it("is an animatic: panels with times, dialogue and pictures", function()
    local film, shots = write_board()
    assert.are.equal("table", type(shots), shots)
    assert.are.equal(12, #shots)
    assert.are.same({ 1350, 900 }, { film.size[1], film.size[2] })
    assert.are.equal(math.floor((6 * 2000 + 6 * 700 + 420) * 0.024 + 0.5), film.frames)
    assert.are.same({ name = "2A", from = 2, to = 65 / 24, source = { from = 0, to = 65 / 24 - 2 },
                      dialogue = "Line 2", action = "walks" }, shots[2])
    assert.are.equal(6, #film.captions)
    assert.are.same({ from = 2, to = 65 / 24, text = "Line 2" }, film.captions[1])
    assert.are.same({ "board 5: there is no images/board-5-AB5-ink.png" }, shots.skipped)
    local pixels = assert(celspan.pixels(film, { frame = 50, size = { 12, 8 } }))
    local r, g = pixels:get(9, 4)
    assert.is_true(math.abs(r - 2 / 12) < 0.01 and g == 0)
    r, g = pixels:get(2, 4)
    assert.is_true(math.abs(r - 1 / 12) < 0.01 and math.abs(g - 0.5) < 0.01)
  end)

  it("that is wrong is refused", function()
    local function wrong(message, change)
      local film, found = write_board(change)
      assert.is_nil(film)
      assert.truthy(found:find("board.storyboarder: " .. message, 1, true), found)
    end
    wrong("board 3: duration must be a number from 0 to 100000000, got -5", function(document)
      document.boards[3].duration = -5
    end)
    wrong("board 2: opacity must be", function(document)
      document.boards[2].layers.ink.opacity = 7
    end)
    wrong("fps must be", function(document) document.fps = 1e9 end)
    wrong("is no storyboard: it has no boards", function(document) document.boards = nil end)
    wrong("has no board that lasts a frame", function(document) document.boards = { list = {} } end)
    wrong("board 1 must be an object, got number", function(document) document.boards[1] = 4 end)
    refused("board.storyboarder: ", "board.storyboarder", '{"boards":[')
    local _, shots = read("board.storyboarder",
      '{"boards":[{"layers":{"ink":{"url":"../x.png"}}}]}')
    assert.are.same({ "board 1: there is no images/../x.png" }, shots.skipped)
  end)
end)
