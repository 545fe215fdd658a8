-- The town with a hundred windows: its table, its rooms, its size, and the film of the way into it.

local csv = require "celspan.csv"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

if not present.type() then return pending "rooms are signed with letters" end

local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 300) >= 300
local NUMBERS = { x = "number", y = "number", width = "number", height = "number" }

--- The rows of a table of boxes.
local function read(path)
  return assert(csv.decode(system.read(path), { types = NUMBERS }))
end
local boxes = read "scripts/town/boxes.csv"

local bench
before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

local function run(arguments, ...)
  local code, out, err = bench:celspan(arguments, ...)
  assert.are.equal(0, code, err)
  return out
end

--- Boxes whose room has a script, and those of rooms in rooms.
local function rooms()
  local list, tables = {}, { boxes }
  for _, path in ipairs(system.lines "ls scripts/town/windows/*.csv") do
    tables[#tables + 1] = read(path)
  end
  for _, rows in ipairs(tables) do
    for _, box in ipairs(rows) do
      if box.room ~= "" then list[#list + 1] = box end
    end
  end
  return list
end

--- What `celspan info` says of a room: { frames =, fps =, size = }.
local function film_of(room)
  local text = run("info scripts/town/windows/%s.lua --allow scripts", room)
  local width, height = text:match "size (%d+)x(%d+)"
  return { frames = tonumber(text:match "frames (%d+)"), fps = tonumber(text:match "fps (%d+)"),
    different = tonumber(text:match "different (%d+)"), ratio = width / height }, text
end

--- The bytes of a plane of a script.
local function bytes_of(script, options)
  run("render %s --allow scripts --depth 8 --progress none %s -o %s/made.plane", script,
    options or "", bench.folder)
  return #bench:read "made.plane"
end

describe("the town", function()
  it("has a hundred boxes in its frame, none in another one", function()
    assert.is_true(#boxes >= 100)
    for i, a in ipairs(boxes) do
      assert.is_true(a.x >= 0 and a.y >= 0 and a.x + a.width <= 1920 and a.y + a.height <= 1080)
      for j = 1, i - 1 do
        local b = boxes[j]
        assert.is_true(a.x >= b.x + b.width or b.x >= a.x + a.width or a.y >= b.y + b.height
          or b.y >= a.y + a.height, a.box .. " lies in " .. b.box)
      end
    end
  end)

  it("has each room once, and no other scripts", function()
    local seen, count = {}, 0
    for _, box in ipairs(rooms()) do
      assert.is_nil(seen[box.room], box.room)
      seen[box.room], count = true, count + 1
    end
    for _, path in ipairs(system.lines "ls scripts/town/windows/*.lua") do
      assert.is_true(seen[path:match "([%w_]+)%.lua$"], path)
      count = count - 1
    end
    assert.equal(0, count)
  end)

  it("has panes as their rooms have them", function()
    for _, box in ipairs(boxes) do
      local script = system.read(("scripts/town/windows/%s.lua"):format(box.room))
      assert.equal(script:match 'pane = "(%l+)"' or "transom", box.pane, box.room)
    end
  end)

  it("has rooms of the shape of their boxes, of 2, 4 or 8 seconds, of few drawings", function()
    local list = rooms()
    for i = 1, #list, HAS_ALL and 1 or 7 do
      local film, text = film_of(list[i].room)
      assert.near(list[i].width / list[i].height, film.ratio, 0.01, list[i].room)
      assert.equal(12, film.fps, text)
      assert.is_truthy(({ [24] = 1, [48] = 1, [96] = 1 })[film.frames], text)
      assert.is_true(film.different <= 32, text)
    end
  end)

  it("has small rooms", function()
    local list = rooms()
    for i = 1, #list, HAS_ALL and 1 or 12 do
      local bytes = bytes_of(("scripts/town/windows/%s.lua"):format(list[i].room))
      assert.is_true(bytes <= 48000, ("%s: %d bytes"):format(list[i].room, bytes))
    end
  end)

  it("is seen after 300 KB at most", function()
    local sum = 0
    for _, part in ipairs { "still", "lights", "street", "air", "snow" } do
      sum = sum + bytes_of("scripts/town.lua", "--set part=" .. part)
    end
    assert.is_true(sum <= 300000, sum)
  end)

  it("is entered by a film of 20 seconds with sound", function()
    local text = run("info scripts/town/zoom.lua --allow scripts")
    assert.matches("480", text:match "frames[^\n]*")
    run("render scripts/town/zoom.lua --allow scripts --progress none --size 54x96 "
      .. "--frames 1,200,320,480 -o %s/zoom.####.png", bench.folder)
    local seen = {}
    for _, number in ipairs { "0001", "0200", "0320", "0480" } do
      seen[bench:read("zoom." .. number .. ".png")] = true
    end
    local count = 0
    for _ in pairs(seen) do count = count + 1 end
    assert.equal(4, count)
  end)
end)
