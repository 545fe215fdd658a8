-- The scripts that ship: each makes a picture of its last frame. With --full also of its first and
-- middle ones, with one worker, with the same last one; and all of its frames are checked.

package.path = "./scripts/?.lua;" .. package.path
local shipped = require "tests.support.shipped"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BINARY = workbench.binary
local WIDTH, HEIGHT = 96, 54
local SIZE = WIDTH * HEIGHT * 4 -- of a frame
local MOST_FRAMES = 24

local function run(arguments)
  local text, ended_well = system.output(("%s %s"):format(BINARY, arguments))
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
      local count = frames_of(path)
      local asked = count < 3 and ("1-%d"):format(count)
        or ("1,%d,%d"):format((count + 1) // 2, count)
      local bytes = assert(render(path, asked, 1))
      assert.are.equal(math.min(count, 3) * SIZE, #bytes)
      for n = 0, #bytes // SIZE - 1 do
        assert.is_true(colours(bytes:sub(n * SIZE + 1, (n + 1) * SIZE)) >= 5, "frame is blank")
      end
      assert.is_true(bytes:sub(-SIZE) == last_of(path), "another picture alone, by two")
    end)

    test(path .. " makes frames between those #full", function()
      local count = frames_of(path)
      assert.is_truthy(run(("render %s -o - --frames 1-%d:%d --scale 0.05 --progress none")
        :format(quoted(path), count, math.max(1, count // MOST_FRAMES))))
    end)

    test(path .. " has a frame function that is pure #full", function()
      assert.is_truthy(run("check " .. quoted(path)))
    end)
  end
end)
