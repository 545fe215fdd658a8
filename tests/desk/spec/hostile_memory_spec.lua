-- Drawings and scripts of a few bytes that want gigabytes: the limits of memory end the run, with
-- their exit code and a sentence; no script can catch that, and no process holds much more.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local PEAK = workbench.build .. "/tests/peak"
local LIMIT = 64 << 20

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

-- ---------------------------------------------------------------- drawings

local function svg(...)
  return '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">'
    .. table.concat { ... } .. "</svg>"
end

--- Path data of that many points.
local function line(count)
  local points = { "M0 0" }
  for i = 1, count do points[i + 1] = ("L%d %d"):format(i, i % 7) end
  return table.concat(points)
end

local function marker(name, content)
  return ('<marker id="%s" markerWidth="9" markerHeight="9">%s</marker>'):format(name, content)
end

--- A path with a marker at each of its points.
local function marked(name)
  return ('<path d="%s" marker-mid="url(#%s)"/>'):format(line(60), name)
end

--- Groups that each show the one before ten times.
local function uses(depth)
  local groups = { '<g id="a0">' .. ('<rect width="1" height="1"/>'):rep(50) .. "</g>" }
  for i = 1, depth do
    groups[i + 1] = ('<g id="a%d">%s</g>'):format(i, ('<use href="#a%d"/>'):format(i - 1):rep(10))
  end
  return ('<defs>%s</defs><use href="#a%d"/>'):format(table.concat(groups), depth)
end

local DRAWINGS = {
  markers = function()
    return svg(marker("c", '<path d="M0 0L1 1L2 0Z"/>'), marker("b", marked "c"),
      marker("a", marked "b"), marked "a")
  end,
  uses = function() return svg(uses(4)) end,
  points = function() return svg('<path d="', line(900000), '"/>') end,
  shapes = function() return svg(('<rect width="1" height="1"/>'):rep(400000)) end,
  groups = function() return svg(('<g class="a b c" data-x="yyyyyyyyyyyyyyyy"/>'):rep(500000)) end,
  stops = function()
    return svg("<linearGradient id='g'>", ("<stop offset='.5'/>"):rep(600000), "</linearGradient>",
      "<rect width='9' height='9' fill='url(#g)'/>")
  end,
}

--- Reads a drawing in a way that would let a script continue, and says so.
local READ = [[
local celspan, svg = require "celspan", require "celspan.svg"
local way = ...
local art, message
if way == "answer" then art, message = svg.read "drawing.svg" end
if way == "pcall" then art = select(2, pcall(svg.read, "drawing.svg")) end
if way == "xpcall" then xpcall(svg.read, function(m) message = m end, "drawing.svg") end
if way == "resume" then
  message = select(2, coroutine.resume(coroutine.create(svg.read), "drawing.svg"))
end
if way == "close" then
  local raising <const> = setmetatable({}, { __close = function() error "another" end })
  pcall(function() local closed <close> = raising; svg.read "drawing.svg" end)
end
print "it continues"
return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 9, 9 } } }
]]

-- ---------------------------------------------------------------- scripts

local SCRIPTS = {
  table = "local t = {} for i = 1, 1e9 do t[i] = i end",
  text = "local t = {} for i = 1, 1e6 do t[i] = ('x'):rep(1e6 + i) end",
  shapes = "local t = {} for i = 1, 1e8 do t[i] = celspan.rect { 0, 0, i, i } end",
  pictures = "local t = {} for i = 1, 1e5 do t[i] = celspan.image { pixels = ('abcd'):rep(1e4), "
    .. "size = { 100, 100 }, format = 'rgba8' } end",
}

-- ---------------------------------------------------------------- running

local function watched(arguments)
  local code, out, err = bench:shell(("cd '%s' && '%s' 60 '%s' %s")
    :format(bench.folder, PEAK, workbench.absolute, arguments))
  local words, bytes = err:match "^(.*)peak (%d+) processor [%d.]+\n$"
  return code, out .. words, tonumber(bytes)
end

local function ends(arguments, code, sentence, limit)
  local got, words, bytes = watched(arguments)
  local where = ("%s: exit code %d, %d MiB: %s"):format(arguments, got, bytes >> 20, words)
  assert.equal(code, got, where)
  assert.truthy(words:find(sentence, 1, true), where)
  assert.falsy(words:find("it continues", 1, true), where)
  assert.is_true(bytes < 1.5 * limit, where)
end

describe("the limit of memory #plain", function()
  local sentence = "the script needs more than 64 MiB (--limit memory=SIZE allows more)"
  for name, make in pairs(DRAWINGS) do
    it("counts what a drawing holds while it is read: " .. name, function()
      if not present.type() then return pending "there is no type module" end
      bench:write("drawing.svg", make())
      bench:write("film.lua", READ)
      ends("check film.lua --limit memory=64M -- answer", 6, "film.lua:4: " .. sentence, LIMIT)
    end)
  end

  for _, way in ipairs { "pcall", "xpcall", "resume", "close" } do
    it("cannot be caught by " .. way, function()
      if not present.type() then return pending "there is no type module" end
      bench:write("drawing.svg", DRAWINGS.markers())
      bench:write("film.lua", READ)
      ends("check film.lua --limit memory=64M -- " .. way, 6, sentence, LIMIT)
    end)
  end

  for name, work in pairs(SCRIPTS) do
    it("ends a script that makes too much: " .. name, function()
      bench:write("film.lua", "local celspan = require 'celspan'\npcall(function() " .. work
        .. " end)\nprint 'it continues'\n" .. "return celspan.rostrum {}\n")
      ends("check film.lua --limit memory=64M", 6, sentence, LIMIT)
    end)
  end

  it("does not depend on what the caches may hold", function()
    if not present.type() then return pending "there is no type module" end
    bench:write("drawing.svg", DRAWINGS.uses())
    bench:write("film.lua", READ)
    for _, memory in ipairs { 0, 100, 4000 } do
      ends(("render film.lua --hash --progress none --memory %d --limit memory=64M -- answer")
        :format(memory), 6, sentence, LIMIT)
    end
  end)
end)

describe("the limit of rendering #plain", function()
  it("ends a frame before the machine is full, and names it", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 64, 64 }, frames = 2, frame = function(f)
  local list = {}
  for i = 1, f.number == 1 and 1 or 0 do
    local square = celspan.rect { 9, 9, 9, 9 }
    for k = 1, 500000 do list[k] = square end
  end
  return celspan.rostrum { celspan.cel(list) } end }
]])
    local limit = "render-memory=128M"
    ends("render film.lua --hash --progress none --limit " .. limit, 33, "frame 1: out of memory: "
      .. "rendering needs more than 128 MiB (--limit render-memory=SIZE allows more)", 128 << 20)
    local code, out =
      watched("render film.lua --hash --progress none --keep-going --limit " .. limit)
    assert.equal(1, code)
    assert.truthy(out:find "2 %x+\n", out)
  end)

  it("is enough for any number of dashes: a few are in memory at a time", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
local list = {}
for i = 1, 4 do
  list[i] = celspan.stroke { d = "M0 " .. 3 * i .. "H64", dash = { 0.0016, 0.0004 } }
end
local rostrum = celspan.rostrum { celspan.cel(list) }
return celspan.film { size = { 64, 16 }, frame = function() return rostrum end }
]])
    local code, out, bytes = watched("render film.lua --hash --progress none --workers 1 "
      .. "--limit memory=8M --limit render-memory=32M")
    assert.equal(0, code, out)
    assert.is_true(bytes < 1.5 * (40 << 20), bytes)
  end)
end)
