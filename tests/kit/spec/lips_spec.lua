-- Lip-sync files into mouth shapes, frame by frame.
local lips = require "celspan.lips"
local present = require "tests.support.present"
local raised = require "tests.support.raised"

local material = present.material

local paths = {}

--- A temporary file with this text.
local function write(text)
  local path = os.tmpname()
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  paths[#paths + 1] = path
  return path
end

--- The shapes of a text as one string, "AABB".
local function shapes(text, options)
  local track = assert(lips.read(write(text), options))
  local list = {}
  for n = 1, track.frames do list[n] = track:at(n) end
  return table.concat(list, " ")
end

after_each(function()
  for i = #paths, 1, -1 do
    os.remove(paths[i])
    paths[i] = nil
  end
end)

describe("the shape of a frame", function()
  it("is the one that covers most of it", function()
    -- at 10 a second: B covers 60 % of frame 3
    assert.are.equal("X X B B C C",
      shapes("0.00\tX\n0.24\tB\n0.41\tC\n0.60\tX\n", { fps = 10, hold = 1 }))
  end)

  it("does not drop a closed mouth that is shorter than half a frame", function()
    assert.are.equal("D D A D D",
      shapes("0.00\tD\n0.22\tA\n0.26\tD\n0.50\tX\n", { fps = 10, hold = 1 }))
    assert.are.equal("D D D D D",
      shapes("0.00\tD\n0.22\tB\n0.26\tD\n0.50\tX\n", { fps = 10, hold = 1 }))
  end)

  it("is held for at least two frames", function()
    assert.are.equal("C C C C D D D D",
      shapes("0.00\tC\n0.30\tB\n0.40\tD\n0.80\tX\n", { fps = 10, hold = 4 }))
    assert.are.equal("C C C B B D D D",
      shapes("0.00\tC\n0.30\tB\n0.40\tD\n0.80\tX\n", { fps = 10 }))
  end)

  it("is the first one before the recording, and the mouth at rest after it", function()
    local track = assert(lips.read(write "0.00\tB\n0.50\tX\n", { fps = 10 }))
    assert.are.same({ "B", "B", "B", "X", "X", 5 }, { track:at(-3), track:at(5), track:at(5.9),
      track:at(6), track:at(99), track.frames })
    assert.are.equal("X", track.rest)
    track = assert(lips.read(write "MohoSwitch1\n1 E\n3 etc\n4 etc\n"))
    assert.are.same({ "etc", "rest", "rest" }, { track:at(4), track:at(5), track.rest })
  end)

  it("at rest has the name of its drawing", function()
    local text = "0.00\tB\n0.50\tX\n"
    local track = assert(lips.read(write(text), { set = { "A", "B" }, map = { A = "closed" } }))
    assert.are.equal("closed", track:at(99))
    track = assert(lips.read(write(text), { map = { X = "smile" } }))
    assert.are.equal("smile", track:at(99))
  end)
end)

describe("names", function()
  it("fall back when the set of drawings lacks a shape", function()
    local text = "0.00\tG\n0.20\tH\n0.40\tX\n0.60\tE\n0.80\tX\n"
    assert.are.equal("A A C C A A E E", shapes(text, { fps = 10, set = { "A", "B", "C", "E" } }))
    assert.are.equal("G G H H X X E E", shapes(text, { fps = 10 }))
  end)

  it("are mapped to the user's own", function()
    assert.are.equal("open open B B",
      shapes("0.00\tD\n0.20\tB\n0.40\tX\n", { fps = 10, map = { D = "open" } }))
  end)
end)

describe("a file", function()
  it("of Moho counts from 1, and the last of equal frames wins", function()
    assert.are.equal("rest rest AI AI etc etc rest",
      shapes("MohoSwitch1\n1 rest\n3 E\n3 AI\n5 etc\n7 rest\n"))
  end)

  it("of Moho may start late and contain lines that are not cues", function()
    assert.are.equal("rest rest O O", shapes("MohoSwitch1\nnot a cue\n3 O\n4 O\n"))
  end)

  it("of Papagayo 1 counts from 0 and closes the mouth after a phrase", function()
    local text = "lipsync version 1\na.wav\n24\n8\n1\n\tvoice\n\thi\n\t1\n\t\thi\n\t\t2\n\t\t5\n"
      .. "\t\t1\n\t\t\thi 2 5 2\n\t\t\t\t2 E\n\t\t\t\t4 AI\n"
    assert.are.equal("rest rest E E AI AI rest rest", shapes(text))
  end)

  it("of Papagayo 2 is JSON", function()
    local text = [[{"version": 2, "fps": 24, "sound_duration": 8, "voices": [{"phrases": [
      {"text": "hi", "start_frame": 2, "end_frame": 5, "words": [
        {"text": "hi", "phonemes": [{"text": "E", "frame": 2}, {"text": "AI", "frame": 4}]}]}]}]}]]
    assert.are.equal("rest rest E E AI AI rest rest", shapes(text))
  end)

  it("of Rhubarb says the same in TSV, JSON and XML", function()
    local json = [[{"metadata": {"duration": 0.6}, "mouthCues": [
      {"start": 0, "end": 0.24, "value": "X"}, {"start": 0.24, "end": 0.6, "value": "B"}]}]]
    local xml = '<?xml version="1.0"?><rhubarbResult><mouthCues>'
      .. '<mouthCue start="0.00" end="0.24">X</mouthCue>'
      .. '<mouthCue start="0.24" end="0.60">B</mouthCue></mouthCues></rhubarbResult>'
    local options = { fps = 10 }
    local expected = "X X B B B B"
    assert.are.equal(expected, shapes("0.00\tX\n0.24\tB\n0.60\tX\n", options))
    assert.are.equal(expected, shapes(json, options))
    assert.are.equal(expected, shapes(xml, options))
  end)

  it("that leaves a gap between cues holds the shape before it, as TSV does", function()
    local json = [[{"mouthCues": [{"start": 0, "end": 0.21, "value": "B"},
      {"start": 0.46, "end": 0.48, "value": "C"}, {"start": 0.68, "end": 0.9, "value": "D"}]}]]
    local xml = '<mouthCue start="0" end="0.21">B</mouthCue><mouthCue start="0.46" end="0.48">C'
      .. '</mouthCue><mouthCue start="0.68" end="0.9">D</mouthCue>'
    local options = { fps = 10, hold = 1 }
    -- frame 5 is B for 60 %, 6 and 7 are C, for 80 % in the second of them
    local expected = "B B B B B C C D D"
    assert.are.equal(expected, shapes("0.00\tB\n0.46\tC\n0.68\tD\n0.90\tX\n", options))
    assert.are.equal(expected, shapes(json, options))
    assert.are.equal(expected, shapes(xml, options))
  end)

  it("may list its cues in any order", function()
    local json = [[{"mouthCues": [{"start": 0.2, "end": 0.4, "value": "C"},
      {"start": 0, "end": 0.2, "value": "B"}]}]]
    assert.are.equal("B B C C", shapes(json, { fps = 10, hold = 1 }))
  end)

  it("that ends before its first frame is refused", function()
    for _, text in ipairs { "MohoSwitch1\n0 rest\n",
      '{"mouthCues":[{"start":0,"end":0,"value":"X"}]}' } do
      local track, message = lips.read(write(text))
      assert.is_nil(track)
      assert.is_truthy(message:find(": it ends before its first frame", 1, true), message)
    end
  end)

  it("that declares more cues than it contains is read to its end", function()
    local head =
      "lipsync version 1\na.wav\n%s\n48\n1\nvoice\nhello\n%s\nhello\n3\n30\n%s\nhello 3 9 %s\n3 E\n"
    assert.is_truthy(shapes(head:format(24, "1e18", "1", "1")):find "E")
    assert.is_nil((lips.read(write(head:format(24, "1", "1", "99999999999")))))
  end)

  it("with an invalid frame rate is refused", function()
    for _, fps in ipairs { "0", "-1", "1e999", "1001" } do
      local track, message =
        lips.read(write(("lipsync version 1\na.wav\n%s\n48\n1\nv\nt\n1\nt\n3\n30\n1\nt "
        .. "3 9 1\n3 E\n"):format(fps)))
      assert.is_nil(track)
      assert.is_truthy(message:find("its frame rate is", 1, true), message)
    end
  end)

  it("that is missing or of another kind gives nil and a message with its name", function()
    local track, message = lips.read "no/such/file.tsv"
    assert.is_nil(track)
    assert.is_truthy(message:find("no/such/file.tsv", 1, true))
    for _, text in ipairs { "", "hello", "{", "{}", "<a/>", "MohoSwitch1\n", "lipsync version 1\n",
                            "0.00\tX\n", "0.1 A\nrubbish\n" } do
      local path = write(text)
      track, message = lips.read(path)
      assert.is_nil(track, text)
      assert.are.equal(path .. ": ", message:sub(1, #path + 2))
    end
  end)

  it("with wrong options raises at the caller's line", function()
    local message = raised.message(function() lips.read("x", { fsp = 12 }) end)
    assert.is_truthy(message:find
      "lips_spec.lua:%d+: lips: unknown field 'fsp'; did you mean 'fps'?")
    raised.message(lips.read, "x", { hold = 0 })
    raised.message(lips.read, 3)
  end)
end)

describe("real recordings", function()
  local function each(try)
    if not material then return pending "CELSPAN_MATERIAL is not set" end
    for _, name in ipairs { "human/austen-0880", "human/austen-0930", "espeak/fox",
                            "espeak/peter" } do
      try(material .. "/lipsync/" .. name)
    end
  end

  it("say the same in TSV, JSON and XML", function()
    each(function(path)
      local tsv = assert(lips.read(path .. ".rhubarb.tsv"))
      local json = assert(lips.read(path .. ".rhubarb.json"))
      local xml = assert(lips.read(path .. ".rhubarb.xml"))
      assert.are.same(tsv.shapes, json.shapes, path)
      assert.are.same(tsv.shapes, xml.shapes, path)
      for _, track in ipairs { tsv, json, xml } do
        assert.are.equal("X", track:at(track.frames + 1), path)
      end
    end)
  end)

  it("keep every shape for two frames and every closed mouth", function()
    local closed = { A = true, X = true }
    each(function(path)
      for _, fps in ipairs { 12, 24, 25 } do
        local free = assert(lips.read(path .. ".rhubarb.json", { fps = fps, hold = 1 }))
        local held = assert(lips.read(path .. ".rhubarb.json", { fps = fps }))
        assert.are.equal(free.frames, held.frames)
        local length = 1
        for n = 2, held.frames do
          if held:at(n) == held:at(n - 1) then
            length = length + 1
          else
            local is_first = n - length == 1
            assert.is_true(length >= 2 or is_first or closed[held:at(n - 1)], path .. " at " .. n)
            length = 1
          end
        end
        for n = 1, free.frames do
          if free:at(n) == "A" then
            assert.is_true(held:at(n) == "A" or held:at(n - 1) == "A" or held:at(n + 1) == "A",
              path .. " at " .. n)
          end
        end
      end
    end)
  end)

  it("read from Moho and Papagayo", function()
    each(function(path)
      local moho = assert(lips.read(path .. ".moho.dat"))
      assert.are.equal("rest", moho:at(moho.frames))
      assert.are.equal("rest", moho:at(moho.frames + 1))
      if path:find "human" then
        local papagayo = assert(lips.read(path .. ".pgo"))
        assert.is_true(math.abs(papagayo.frames - moho.frames) <= 8)
      end
    end)
  end)
end)
