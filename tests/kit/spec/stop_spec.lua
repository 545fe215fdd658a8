-- SIGTERM and SIGHUP (shells make background jobs ignore SIGINT): whatever the program is doing,
-- the signal ends it before the frame is finished, and it leaves no files.
local workbench = require "tests.support.workbench"

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

--- Seconds after which a program that a signal does not end is killed; and the size of a frame that
--- is not finished within them.
local LIMIT, WIDTH, HEIGHT = 60, 192000, 108000

local POINTS = [[
local seed, points = 7, { rule = "evenodd" }
local function random() seed = (seed * 1103515245 + 12345) % 2147483648 return seed / 2147483648 end
for i = 1, 16000 do points[i] = { 1920 * random(), 1080 * random() } end
local scribble = celspan.polygon(points)
]]

local HUNG = "('a'):rep(300000):find(('a-'):rep(8) .. 'b')"

--- Things that a frame function may do endlessly, or for long.
local busy = {
  ["a loop in pcall"] = "while true do pcall(function() while true do end end) end",
  ["a loop in xpcall"] = [[while true do
    xpcall(function() while true do end end, function() while true do end end) end]],
  ["a finaliser"] =
    "setmetatable({}, { __gc = function() while true do end end }) collectgarbage()",
  ["table.move"] = "table.move({}, 1, 1 << 52, 2)",
  ["table.sort"] = [[table.sort(setmetatable({}, { __len = function() return 1 << 30 end,
    __index = function() return 1 end }))]],
  ["string.rep"] = "return string.rep('', 1 << 60)",
  ["string.find"] = HUNG,
  ["string.gsub"] = "(('('):rep(200000)):gsub('%b()', '')",
  ["celspan.pixels"] = POINTS .. [[for _ = 1, 99 do
    celspan.pixels(celspan.rostrum { celspan.cel { scribble } }, { size = { 1920, 1080 } }) end]],
}

--- Objects that take endlessly, or long, to render: the frame's file is open then.
local shown = {
  ["a polygon of 16,000 points"] = { POINTS, "scribble" },
  ["a procedure"] = { "", "celspan.scanline { bounds = { 0, 0, 9, 9 }, spans = function() " .. HUNG
    .. " end }" },
}

local function script(before, frame, object)
  return ([[local celspan = require "celspan"
%s
return celspan.film { size = { %d, %d }, frames = 99, frame = function()
  pcall(function() io.stderr:write "begun\n" end); -- the sandbox has none
  (function() %s end)()
  return celspan.rostrum { celspan.cel { %s } }
end }]]):format(before, WIDTH, HEIGHT, frame, object)
end

--- Stops a render by a signal in its first frame, of which nothing is left. options: of render,
--- "--trust" by default. Returns standard error.
local function stop(text, signal, code, options)
  bench:write("film.lua", text)
  local started = ("'%s' render %s film.lua -o out/f.##.png --progress none")
    :format(workbench.absolute, options or "--trust")
  local got, out, err = bench:shell(([[cd '%s' && mkdir out && { %s 2>said & pid=$!
    (sleep %d; kill -KILL $pid) >/dev/null 2>&1 & late=$!
    for i in $(seq 100); do [ -s said ] && break; sleep 0.02; done; sleep 0.1
    kill -%s $pid; wait $pid; code=$?; kill $late; cat said >&2; exit $code; }]])
    :format(bench.folder, started, LIMIT, signal))
  assert.are.equal(code, got, out .. err)
  assert.are.same({}, bench:files "out")
  return err
end

--- Programs started by nohup ignore SIGHUP, and so do all that they start.
local function hangs_up()
  local status = assert(io.open "/proc/self/status"):read "a"
  return tonumber(status:match "SigIgn:%s*(%x+)", 16) & 1 == 0
end

describe("a signal ends", function()
  for name, frame in pairs(busy) do
    it(name, function() stop(script("", frame, ""), "TERM", 143) end)
  end
  for name, parts in pairs(shown) do
    it(name, function()
      if hangs_up() then
        stop(script(parts[1], "", parts[2]), "HUP", 129)
      else
        stop(script(parts[1], "", parts[2]), "TERM", 143)
      end
    end)
  end

  it("a function of C in the sandbox, in order", function()
    local said = stop(script("", HUNG, ""), "TERM", 143, "--limit time=0")
    assert.falsy(said:find("was killed", 1, true), said)
  end)
end)
