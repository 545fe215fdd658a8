-- Callers: the callers listed after an error in a helper, and the files found next to a caller.
local celspan = require "celspan"
local workbench = require "tests.support.workbench"

local build = workbench.build

local hand = [[
local celspan = require "celspan"
local hand = {}
local function finger(width)
  return celspan.rect { 0, 0, width, 1 }
end
function hand.draw(width)
  local shape = finger(width)
  return shape
end
function hand.complain(width)
  error("a hand is not " .. width .. " wide", 2)
end
function hand.count(n)
  if n == 0 then local nothing = celspan.rect { 0, 0, -1, 1 } return nothing end
  local shape = hand.count(n - 1)
  return shape
end
function hand.vanish()
  error("the hand is gone", 0)
end
return hand
]]

local shot = [[
local celspan = require "celspan"
local hand = require "hand"
local function pose(f)
  local shape = %s
  return celspan.rostrum { celspan.cel { shape } }
end
return celspan.film { size = { 8, 8 }, frames = 2, frame = function(f)
  local stack = pose(f)
  return stack
end }
]]

describe("an error in a helper", function()
  local bench
  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  --- The message of a render whose pose is made by this expression; {shot} and {hand} are the
  --- files.
  local function message_of(expression)
    bench:write("hand.lua", hand)
    bench:write("shot.lua", shot:format(expression))
    local code, _, text = bench:celspan("render '%s/shot.lua' -o '%s/a.####.png' --progress none",
      bench.folder, bench.folder)
    assert.are.equal(3, code)
    return (text:gsub(bench.folder .. "/", "")) -- temporary folders have names of different lengths
  end

  it("lists its callers, the nearest first", function()
    assert.is_truthy(message_of("hand.draw(-3)")
      :find("hand.lua:4: frame 1: rect: w is -3; it must be "
      .. "0 or more (called from hand.lua:7, shot.lua:4, shot.lua:8)", 1, true),
      message_of "hand.draw(-3)")
  end)

  it("lists them for the helper's own errors too, after the line of the error", function()
    assert.is_truthy(message_of("hand.complain(7)"):find(
      "shot.lua:4: frame 1: a hand is not 7 wide (called from shot.lua:8)", 1, true),
      message_of "hand.complain(7)")
  end)

  it("has the line that raised it, where its message names none", function()
    assert.is_truthy(message_of("hand.vanish()"):find(
      "hand.lua:19: frame 1: the hand is gone (called from shot.lua:4, shot.lua:8)", 1, true),
      message_of "hand.vanish()")
  end)

  it("lists no callers if a frame function itself fails", function()
    bench:write("shot.lua", [[
local celspan = require "celspan"
return celspan.film { frame = function() return celspan.rect { 0, 0, -1, 1 } end }
]])
    local _, _, text = bench:celspan("check '%s/shot.lua'", bench.folder)
    assert.is_nil(text:find("called from", 1, true), text)
  end)

  it("has the line of a frame function that ends with the call", function()
    for call, said in pairs {
      ["ease"] = [[require "celspan.ease" "inotquad"]], ["svg"] = [[require "celspan.svg".read(7)]],
      ["sheet"] = [[require "celspan.sheet".new { fsp = 1 }]],
      ["layers"] = [[require "celspan.layers".read("a.ora", { smoth = true })]],
      ["lips"] = [[require "celspan.lips".read("a.tsv", { fsp = 1 })]],
      ["cut"] = [[require "celspan.cut" { dissolv = 1 }]],
      ["motion"] = [[require "celspan.motion".along "M0 0Z3"]],
      ["captions"] = [[require "celspan.captions".read(7)]],
      ["celspan"] = [[celspan.read(7)]],
      ["keys"] = [[require "celspan.keys" { { 1, 2 } }:at "x"]],
    } do
      bench:write("shot.lua", 'local celspan = require "celspan"\nreturn celspan.film { size = '
        .. "{ 8, 8 }, frame = function()\n  return " .. said .. "\nend }")
      local _, _, text = bench:celspan("check '%s/shot.lua'", bench.folder)
      assert.is_truthy(text:find("shot.lua:3: " .. call .. ": ", 1, true), text)
    end
  end)

  it("lists them once if a film is made from another film's frames", function()
    local shots = celspan.film { size = { 4, 4 }, frame = function()
      local function draw() error "torn" end
      local cel = draw()
      return celspan.rostrum { cel }
    end }
    local cut = celspan.film { size = { 4, 4 }, frame = function()
      local function take() local frame = shots:at(1) return frame end
      local frame = take()
      return frame
    end }
    local _, message = pcall(cut.at, cut, 1)
    assert.are.equal(1, select(2, message:gsub("%(called from ", "")), message)
    assert.are.equal(1, select(2, message:gsub("frame 1: ", "")), message)
    assert.is_truthy(message:find("torn (called from ", 1, true), message)
  end)

  it("lists a recursive function once", function()
    assert.is_truthy(message_of("hand.count(50)"):find(
      "(called from hand.lua:15, shot.lua:4, shot.lua:8)", 1, true), message_of "hand.count(50)")
  end)

  it("lists the first and the last of many callers", function()
    local steps = {}
    for i = 1, 9 do
      steps[i] = ("local function f%d(x) local r = %s return r end"):format(i,
        i == 1 and "celspan.rect { 0, 0, -1, 1 }" or ("f%d(x)"):format(i - 1))
    end
    bench:write("many.lua", 'local celspan = require "celspan"\n' .. table.concat(steps, "\n")
      .. "\nlocal shape = f9()\nreturn celspan.rostrum { celspan.cel { shape } }")
    local _, _, text = bench:celspan("info '%s/many.lua'", bench.folder)
    text = text:gsub(bench.folder .. "/", "")
    assert.is_truthy(text:find("many.lua:2: rect: w is -1; it must be 0 or more (called from "
      .. "many.lua:3, "
      .. "many.lua:4, many.lua:5, many.lua:6, many.lua:7, ..., many.lua:11)", 1, true), text)
  end)

  it("lists those in the script's own body and in the modules it loads", function()
    bench:write("hand.lua", hand)
    bench:write("shot.lua",
      'local hand = require "hand"\nlocal shape = hand.draw(-1)\nreturn shape')
    local _, _, text = bench:celspan("info '%s/shot.lua'", bench.folder)
    text = text:gsub(bench.folder .. "/", "")
    assert.is_truthy(text:find("(called from hand.lua:7, shot.lua:2)", 1, true), text)
  end)

  it("leaves out celspan's own modules, whose errors have the caller's line", function()
    bench:write("shot.lua", [[
local celspan = require "celspan"
local multiplane = require "celspan.multiplane"
local function stack(light)
  local rostrum = multiplane { film = { 8, 8 }, brightness = light }
  return rostrum
end
local rostrum = stack(-1)
return rostrum
]])
    local _, _, text = bench:celspan("info '%s/shot.lua'", bench.folder)
    text = text:gsub(bench.folder .. "/", "")
    assert.is_truthy(text:find("shot.lua:4: rostrum: brightness is -1; it must be 0 or more "
      .. "(called from shot.lua:7)", 1, true), text)
  end)

  it("is reported for the function of a scan-line primitive, named by its own line", function()
    local function show(row)
      return select(2, celspan.pixels(celspan.rostrum { celspan.cel {
        celspan.scanline { bounds = { 0, 0, 2, 2 }, spans = row } } }, { size = { 2, 2 } }))
    end
    local function share() return celspan.rgb(2, 0, 0), 1 end
    local file, line = debug.getinfo(1, "S").short_src, debug.getinfo(1, "l").currentline
    local helped = show(function()
      local paint = share()
      return { { 0, 1, paint } }
    end)
    local wrong = show(function() return { { 0, 0 / 0, "#fff" } } end)
    assert.are.equal(("%s:%d: rgb: pigment[1] is 2; it must be between 0 and 1 (called from %s:%d)")
      :format(file, line - 1, file, line + 2), helped)
    assert.are.equal(("%s:%d: scanline: span 1: its value 2 must be a finite number, got nan")
      :format(file, line + 5), wrong)
  end)

  it("has its callers in the messages of render, and of film:at", function()
    local function finger() local shape = celspan.rect { 0, 0, -1, 1 } return shape end
    local line = debug.getinfo(1, "l").currentline + 2
    local film = celspan.film { size = { 4, 4 }, frame = function()
      local shape = finger()
      return celspan.rostrum { celspan.cel { shape } }
    end }
    local callers = (" (called from %s:%d)"):format(debug.getinfo(1, "S").short_src, line)
    local done, message = celspan.render(film, bench.folder .. "/a.png")
    assert.is_nil(done)
    assert.are.equal(callers, message:sub(-#callers))
    local good, raised = pcall(film.at, film, 1)
    assert.is_false(good)
    assert.are.equal(callers, raised:sub(-#callers))
  end)
end)

describe("a file's name", function()
  local bench
  before_each(function()
    bench = workbench.new()
    assert(os.execute(("mkdir '%s/parts' '%s/parts/deep'"):format(bench.folder, bench.folder)))
    local cues = { near = "0.00\tA\n1.00\tX\n", script = "0.00\tB\n1.00\tX\n" }
    bench:write("mouth.tsv", cues.script)
    bench:write("only.tsv", cues.script)
    bench:write("parts/mouth.tsv", cues.near)
    bench:write("parts/part.lua", [[
local celspan = require "celspan"
local lips = require "celspan.lips"
local part = {}
function part.mouth(name) return assert(lips.read(name)):at(1) end
function part.message(name) return (select(2, lips.read(name))) end
function part.picture(name) return celspan.picture { file = name, box = { 0, 0, 4, 4 } } end
return part
]])
    bench:write("shot.lua", [[
package.path = package.path .. ";" .. ...
local celspan = require "celspan"
local lips = require "celspan.lips"
local part = require "part"
print(part.mouth "mouth.tsv", assert(lips.read "mouth.tsv"):at(1))
print(pcall(part.mouth, "only.tsv"))
print(part.message "none.tsv")
print(celspan.pixels(celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 4, 4,
  texture = part.picture "none.png" } } }, { size = { 4, 4 } }))
return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 4, 4, texture = part.picture "none.png"
  } } }
]])
  end)
  after_each(function() bench:remove() end)

  local function lines_of(text)
    local lines = {}
    for line in text:gsub(bench.folder, "HERE"):gmatch "[^\n]+" do lines[#lines + 1] = line end
    return lines
  end

  it("is found next to the caller's file, else next to the script; both are reported", function()
    local code, _, printed = bench:celspan("probe '%s/shot.lua' 1 1 --trust -- '%s/parts/?.lua'",
      bench.folder, bench.folder)
    assert.are.equal(4, code)
    local lines = lines_of(printed)
    assert.are.equal("A\tB", lines[1])
    assert.are.equal("true\tB", lines[2])
    assert.are.equal("HERE/parts/none.tsv: No such file or directory; also looked for at "
      .. "HERE/none.tsv",
      lines[3])
    local told =
      "HERE/parts/none.png: cannot be opened: No such file or directory; also looked for at "
      .. "HERE/none.png"
    assert.is_truthy(lines[4]:find(told, 1, true), lines[4])
    assert.is_truthy(lines[5]:find(told, 1, true), lines[5])
  end)

  it("is found only next to the nearest caller if no script is run", function()
    local code, out = bench:shell(
      ("cd / && LUA_PATH=';;' LUA_CPATH='%s/?.so' '%s/tests/lua_host' '%s/shot.lua' "
      .. "'%s/parts/?.lua'"):format(
        build, build, bench.folder, bench.folder))
    assert.are.equal(0, code)
    local lines = lines_of(out)
    assert.are.equal("A\tB", lines[1])
    assert.is_truthy(lines[2]:find("false\t.*HERE/parts/only.tsv: No such file or directory$"),
      lines[2])
    assert.are.equal("HERE/parts/none.tsv: No such file or directory", lines[3])
    assert.is_nil(lines[4]:find("also looked for", 1, true), lines[4])
  end)

  it("is used unchanged if no file calls, and if it is absolute", function()
    local _, out = bench:shell(
      ([[cd '%s' && LUA_PATH=';;' LUA_CPATH='%s/?.so' '%s/tests/lua_host' -e '
        local lips = require "celspan.lips"
        print(lips.read "mouth.tsv":at(1), lips.read "%s/parts/mouth.tsv":at(1))']]):format(
        bench.folder, build, build, bench.folder))
    assert.are.equal("B\tA\n", out)
  end)
end)
