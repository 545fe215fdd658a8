-- Exposure sheets of any bytes, the first of which chooses the format (the fuzz target), and sheets
-- damaged in every way, the same ways each time:
--
--   lua_host tests/fuzz/sheets.lua [ROUNDS [SEED]]     a round is a damaged text of each format
--
-- A reader may only return a sheet, or nil and a sentence that names the file. A sheet is queried,
-- written as text, and must be read back as the same.
local celspan = require "celspan"
local sheet = require "celspan.sheet"

local fuzz = {}

--- A text of each format, as programs write them.
fuzz.seeds = {
  xdts = [[exchangeDigitalTimeSheet Save Data
{"version":5,"header":{"cut":"12","scene":"3"},"timeTables":[{"name":"one","duration":24,
"timeTableHeaders":[{"fieldId":0,"names":["A","B"]},{"fieldId":3,"names":["Anna"]},
{"fieldId":5,"names":["cam"]}],
"fields":[{"fieldId":0,"tracks":[{"trackNo":0,"frames":[
{"frame":-2,"data":[{"id":0,"values":["1a"]}]},
{"frame":3,"data":[{"id":0,"values":["SYMBOL_TICK_1"],"options":["OPTION_KEYFRAME"]}]},
{"frame":9,"data":[{"id":0,"values":["SYMBOL_NULL_CELL"]}]}]},{"trackNo":1,"frames":[]}]},
{"fieldId":3,"tracks":[{"trackNo":0,"frames":[{"frame":4,"data":[{"id":0,"values":["Anna",
"Hello"]}]},
{"frame":5,"data":[{"id":0,"values":["SYMBOL_HYPHEN"]}]}]}]},
{"fieldId":9,"tracks":[{"trackNo":0,"frames":[
{"frame":0,"data":[{"id":0,"values":["\u732b"]}]}]}]}]}]}]],
  ["tvpaint.csv"] =
    'UTF-8, TVPaint, "CSV 1.0"\r\nProject Name, Width, Height, Frame Count, Layer Count, '
    .. 'Frame Rate, Pixel Aspect Ratio, Field Mode\r\n"shot ""1""", 640, 480, 4, 2, '
    .. '12.000000, 1.000000, '
    .. 'Progressive\r\n#Layers, "ground", "hero, left"\r\n#Density, 1.000000, 0.500000\r\n'
    .. '#Blending, "Color", "Multiply"\r\n#Visible, 1, 0\r\n#00000, "a.png", ""\r\n#00001, '
    .. '"a.png", "x.png"\r\n'
    .. '#00002, "", "x.png"\r\n#00003, "", "y.png"\r\n',
  ["studio.csv"] =
    "\239\187\191,,chars/main,\n,BG,A,B\n1,1,1,\n2,,\u{25CB},2\n3,,\u{25CF},\u{D7}\n4,,2,\n",
  txt = 'celspan sheet 1\nname "a \\"b\\""\nsize 640x360\nfps 12.5\nframes 5\n# remark\n'
    .. 'note dialogue "A" 2-4 "Anna" "Hi\\nyou"\nlayers  A  "b c"\n  1  1/ik  -\n\n  2  |/r  "x '
    .. 'y"/m\n  4  |  |\n',
  oca = [[{"name":"shot","frameRate":12,"width":8,"height":8,"startTime":2,"endTime":8,"layers":[
{"name":"body","type":"paintlayer","frames":[{"name":"b2","fileName":"body\\b2.png","frameNumber":4,
"duration":2},
{"name":"b1","fileName":"body/b1.png","frameNumber":0,"duration":4.0},
{"name":"_blank","fileName":"","frameNumber":6}]},
{"name":"group","type":"grouplayer","childLayers":[{"name":"bg","animated":false,"opacity":0.5,
"frames":[{"name":"","fileName":"body/b1.png","frameNumber":0}]}]}]}]],
}

local formats = {}
for name in pairs(fuzz.seeds) do formats[#formats + 1] = name end
table.sort(formats)

-- ---------------------------------------------------------------- damage

local numbers = { "0", "-1", "1e300", "-1e300", "10000000", "10000001", "9223372036854775807",
  "1e-320", "0.5",
                  "-0", "00000000000007", "0x10", "nan" }
local pieces = { "\0", "\255", "\237\160\128", "\239\187\191", '"', "\\", "\\u0000", "\r", "\n\n\n",
  ",,,,", "{", "[[[[[[[[",
                 "}", "null", "true", "[]", "{}", "#", "|", "/", "-", "SYMBOL_NULL_CELL",
                 "SYMBOL_HYPHEN", "../..", ("x"):rep(3000),
                 ("[" ):rep(3000), "#99999999", "note camera A 1-10000000 x\n", "layers a a\n" }

local changes = {}

--- The end is missing.
function changes.cut(text, pick) return text:sub(1, pick("at", 0, #text)) end

function changes.byte(text, pick)
  local at = pick("at", 1, #text)
  return text:sub(1, at - 1) .. string.char(pick("byte", 0, 255)) .. text:sub(at + 1)
end

--- A piece of the text is repeated, missing, or moved.
function changes.splice(text, pick)
  local from = pick("from", 1, #text)
  local part = text:sub(from, from + pick("length", 0, 60))
  local to = pick("to", 1, #text)
  return text:sub(1, to) .. part .. text:sub(to + 1 + pick("over", 0, 40))
end

function changes.insert(text, pick)
  local at = pick("at", 0, #text)
  return text:sub(1, at) .. pieces[pick("piece", 1, #pieces)] .. text:sub(at + 1)
end

--- One of the numbers of the text becomes another.
function changes.number(text, pick)
  local places = {}
  for from, to in text:gmatch "()%-?%d+%.?%d*()" do places[#places + 1] = { from, to } end
  local place = places[pick("place", 1, math.max(1, #places))] or { 1, 1 }
  return text:sub(1, place[1] - 1) .. numbers[pick("number", 1, #numbers)] .. text:sub(place[2])
end

local names = {}
for name in pairs(changes) do names[#names + 1] = name end
table.sort(names)

--- The damaged text of a round.
function fuzz.damaged(format, round, seed)
  local random = celspan.random(("%s %d %d"):format(format, round, seed))
  local text = fuzz.seeds[format]
  for i = 1, random("count", 1, 4) do
    local function pick(what, m, n) return random(("%d %s"):format(i, what), m, n) end
    if #text > 0 then text = changes[names[pick("change", 1, #names)]](text, pick) end
  end
  return text
end

-- ---------------------------------------------------------------- judging

--- Calls all queries; raises an error if a result is wrong.
local function ask(made, path)
  for i in ipairs(made.layers) do
    made:at(i, 1)
    made:marks(i, made.frames)
    for _, change in ipairs(made:changes(i)) do
      assert(change.frame >= 1 and change.frame <= made.frames, "a change is outside of the sheet")
    end
  end
  made:notes_at(1)
  for _, note in ipairs(made.notes) do
    assert(1 <= note.from and note.from <= note.to and note.to <= made.frames,
      "a note is outside of the sheet")
  end
  assert(made:write(path))
  local again = assert(sheet.read(path))
  assert(again:text() == made:text(), "its text is read as another sheet")
end

--- Reads a damaged text from a file whose name begins with `start`; raises an error unless the
--- result is a sheet or a sentence. Returns the sheet, if any.
function fuzz.try(format, text, start)
  local path = start .. "." .. format
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  local begun = os.clock()
  local made, message = sheet.read(path)
  assert(made or type(message) == "string" and message:find(path, 1, true)
    and #message < #path + 500,
    "no sentence that names the file")
  if made then ask(made, start .. ".again.txt") end
  assert(os.clock() - begun < 5, "it took more than five seconds")
  return made
end

local own = os.tmpname()
os.remove(own)

function fuzz.try_bytes(bytes)
  local format = formats[(bytes:byte() or 0) % #formats + 1]
  fuzz.try(format, bytes:sub(2), own)
  os.remove(own .. "." .. format)
  os.remove(own .. ".again.txt")
end

--- Rounds of all formats; returns how many texts were read as sheets. Raises an error with the
--- round that went wrong.
function fuzz.run(rounds, seed, folder)
  local count = 0
  for round = 1, rounds do
    for _, format in ipairs(formats) do
      local text = fuzz.damaged(format, round, seed)
      local good, answer = pcall(fuzz.try, format, text, folder .. "/damaged")
      if not good then
        error(("%s, round %d of seed %d: %s\n%q")
          :format(format, round, seed, tostring(answer), text:sub(1, 2000)), 0)
      end
      if answer then count = count + 1 end
    end
  end
  return count
end

if arg and arg[0] and arg[0]:find "sheets%.lua$" then
  local rounds, seed = math.tointeger(arg[1] or 1000), math.tointeger(arg[2] or 1)
  local folder = os.tmpname()
  os.remove(folder)
  assert(os.execute("mkdir " .. folder))
  local good, answer = pcall(fuzz.run, rounds, seed, folder)
  os.execute("rm -r " .. folder)
  if not good then error(answer, 0) end
  print(("%d damaged sheets, of which %d could be read"):format(rounds * #formats, answer))
end

return fuzz
