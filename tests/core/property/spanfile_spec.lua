-- Scene to span file to pixels equals scene to pixels, byte for byte: random scenes, every fourth
-- with a picture, in both depths; read back by the decoder that was written only from
-- docs/spanfile.md.
--
-- A failure prints the number of its scene.
local cases = require "tests.support.cases"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"
local decode = dofile "subprojects/spanfile/tests/decode.lua"

local COUNT = cases.count(500)
local BINARY = workbench.binary
local WIDTH, HEIGHT = 61, 47

-- One film, a scene per frame. Arguments: a picture, or nothing if none can be read.
local SCRIPT = [[
local celspan = require "celspan"
local scenes = require "tests.support.scenes"
local picture = ...
return celspan.film{ size = {%d, %d}, frames = %d, frame = function(f)
  local exposures = scenes.load(scenes.script(f.number)):at(1)
  if not picture or f.number %% 4 > 0 then return exposures end
  local image = celspan.image{ file = picture, x = -3, y = 5, w = 50, h = 33 }
  if type(exposures) ~= "table" then exposures = { { exposures, 1 } } end
  return { { celspan.rostrum{ celspan.cel{ image:rotate(f.number) } }, 0.7 },
           table.unpack(exposures) }
end }
]]

local function run(command)
  local output, ended_well = system.output(command)
  assert(ended_well, command)
  return output
end

local function compare(folder, picture, depth, pixel_size)
  local command = ("'%s' render %s/film.lua --trust --progress none --depth %s -o %%s -- %s")
    :format(BINARY, folder, depth, picture)
  run(command:format(folder .. "/####.span"))
  local raw, size, wrong = run(command:format "-"), WIDTH * HEIGHT * pixel_size, {}
  assert.equal(COUNT * size, #raw)
  for frame = 1, COUNT do
    local pixels = decode(system.read(("%s/%04d.span"):format(folder, frame)))
    if pixels ~= raw:sub((frame - 1) * size + 1, frame * size) then wrong[#wrong + 1] = frame end
  end
  assert.equal("", table.concat(wrong, " "), depth)
end

describe("a span file", function()
  it("has exactly the pixels of the scene", function()
    local folder = run("mktemp -d"):gsub("\n", "")
    local film = assert(io.open(folder .. "/film.lua", "w"))
    film:write(SCRIPT:format(WIDTH, HEIGHT, COUNT))
    film:close()
    local picture = present.pictures()
      and ("'%s/scripts/pictures/village.png'"):format(os.getenv "PWD") or ""
    compare(folder, picture, "8", 4)
    compare(folder, picture, "half", 8)
    run("rm -rf " .. folder)
  end)
end)
