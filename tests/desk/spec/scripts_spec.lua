-- The scripts that ship: each makes a picture of its last frame. With --full also of frames
-- between, with one worker, with the same last one; and its frames are checked: of films with more
-- than 8 frames a part, except with --all.

package.path = "./scripts/?.lua;" .. package.path
setmetatable(_G, { __index = require "celspan".names {} }) -- as in scripts that the program runs
local shipped = require "tests.support.shipped"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BINARY = workbench.binary
local WIDTH, HEIGHT = 96, 54
local SIZE = WIDTH * HEIGHT * 4 -- of a frame
local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 300) >= 300
local MOST_FRAMES = 8
local MOST_CHECKED = HAS_ALL and math.huge or 8

local function run(arguments)
  local text, ended_well = system.output(("'%s' %s"):format(BINARY, arguments))
  return ended_well and text
end

--- A script as an argument, with its options.
local function quoted(path) return ("'%s'%s"):format(path, shipped.options(path)) end

--- Frames as bytes, RGBA, 8 bits each; nil when the command failed.
local function render(script, frames, workers)
  return run(("render %s -o - --frames %s --size %dx%d --workers %d --progress none")
    :format(quoted(script), frames, WIDTH, HEIGHT, workers))
end

local counts = {}

--- The number of frames of a script: the film says it, where the script runs here; celspan info
--- builds all of them.
local function frames_of(path)
  if not counts[path] then
    local runs, film = pcall(dofile, path)
    counts[path] = runs and (film.frames or 1)
      or tonumber(assert(run("info " .. quoted(path))):match("frames%s+(%d+)"))
  end
  return counts[path]
end

--- The first frame, others at equal distances, and the last one, as --frames takes them; and how
--- many these are, at most `most` and the last one.
local function spread(count, most)
  local step = math.max(1, math.ceil((count - 1) / most))
  if count == 1 then return "1", 1 end
  return ("1-%d:%d,%d"):format(count - 1, step, count), (count - 2) // step + 2
end

local last = {}

--- The last frame of a script, by two workers.
local function last_of(path)
  last[path] = last[path] or assert(render(path, frames_of(path), 2))
  return last[path]
end

local function colours(frame)
  local seen, count = {}, 0
  for i = 1, #frame, 4 do
    local colour = frame:sub(i, i + 3)
    if not seen[colour] then seen[colour], count = true, count + 1 end
  end
  return count
end

describe("the scripts that ship", function()
  it("are the demo and one for each feature", function()
    assert.is_true(#shipped.scripts() >= 15)
  end)

  for _, path in ipairs(shipped.scripts()) do
    local test = shipped.lacks_module(path) and pending or it

    test(path .. " makes a picture", function()
      local bytes = last_of(path)
      assert.are.equal(SIZE, #bytes)
      assert.is_true(colours(bytes) >= 5, "the frame is blank")
    end)

    test(path .. " makes pictures, the same whenever it is asked #full", function()
      local asked, count = spread(frames_of(path), MOST_FRAMES)
      local bytes = assert(render(path, asked, 1))
      assert.are.equal(count * SIZE, #bytes)
      for _, n in ipairs { 1, (count + 1) // 2, count } do
        assert.is_true(colours(bytes:sub((n - 1) * SIZE + 1, n * SIZE)) >= 5, "frame is blank")
      end
      assert.is_true(bytes:sub(-SIZE) == last_of(path), "another picture alone, by two")
    end)

    test(path .. " has a frame function that is pure #full", function()
      local asked = spread(frames_of(path), MOST_CHECKED)
      assert.is_truthy(run(("check %s --frames %s"):format(quoted(path), asked)))
    end)
  end
end)
