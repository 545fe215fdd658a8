-- celspan watch: which renderer is given which request, and with how many workers. The processes
-- and the clock are the test's own, so that nothing depends on the speed of a machine.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

local now, started

--- A process that keeps what is sent to it, and gives the answers that a test has put into it.
local function new_process()
  local process = { sent = {}, answers = {} }
  function process:send(text)
    table.insert(self.sent, json.decode(text))
    return true
  end
  function process:take() return table.remove(self.answers, 1) end
  function process.words() return "" end
  function process.finish() return 1 end
  started[#started + 1] = process
  return process
end

--- An object of numbers, texts and flags as JSON.
local function encoded(object)
  local pairs_of = {}
  for name, value in pairs(object) do
    pairs_of[#pairs_of + 1] = { name, type(value) == "table" and {} or value }
  end
  return json.encode(pairs_of)
end

local program = {
  clock = function() return now end,
  divide_memory = function() end,
  json = encoded,
  pass_on = function(words) return words end,
  processors = function() return 2 end,
  renderer = new_process,
}

local pool, results

local function renderers_of(request)
  local load_it = assert(loadfile "src/program/verbs/watch/renderers.lua")
  pool = load_it(program, request).new("shot.lua", function() end)
end

--- Asks for a frame, and for others. more: the fields of the job that are its own.
local function ask(number, more)
  local job = { ask = { want = "frame", number = number }, wish = "w" .. number,
                done = function(_, bytes) table.insert(results, number .. ":" .. bytes) end,
                failed = function(_, status) table.insert(results, number .. ":" .. status) end }
  for name, value in pairs(more or {}) do job[name] = value end
  pool:ask(job)
end

local function step(times)
  for _ = 1, times or 1 do pool:step() end
end

--- Lets a renderer answer what it was sent last.
local function answer(i, bytes)
  local head = program.json { good = bytes ~= nil, message = "no", files = {} }
  table.insert(started[i].answers, (">s4"):pack(head) .. (bytes or ""))
end

--- The frames that a renderer was sent, each with its workers.
local function sent(i)
  local list = {}
  for _, one in ipairs(started[i] and started[i].sent or {}) do
    list[#list + 1] = one.want == "frame" and ("%d by %d"):format(one.number, one.workers)
      or one.want
  end
  return list
end

before_each(function()
  now, started, results = 0, {}, {}
  renderers_of {}
end)

describe("frames that are wanted at once #plain", function()
  it("are drawn side by side, each by a share of the processors", function()
    for number = 1, 3 do ask(number) end
    step(2)
    assert.equal(2, #started)
    answer(1, "one")
    step()
    assert.same({ { "1 by 2", "3 by 1" }, { "2 by 1" } }, { sent(1), sent(2) })
  end)

  it("do not wait for each other", function()
    for number = 1, 3 do ask(number) end
    step(2)
    answer(2, "two")
    step()
    assert.same({ "2:two" }, results)
    answer(1, "one")
    answer(2, "three")
    step()
    table.sort(results)
    assert.same({ "1:one", "2:two", "3:three" }, results)
  end)

  it("are given up one by one", function()
    for number = 1, 3 do ask(number) end
    step(2)
    pool:abandon "w2"
    pool:abandon "w3"
    assert.same({ { "1 by 2" }, { "2 by 1", "abandon" } }, { sent(1), sent(2) })
    answer(1, "one")
    answer(2)
    step()
    table.sort(results)
    assert.same({ "1:one", "2:503", "3:503" }, results)
  end)

  it("do not fail with one of them, or with its renderer", function()
    for number = 1, 4 do ask(number) end
    step(2)
    answer(2)
    step()
    assert.same({ "2:422" }, results)
    table.insert(started[2].answers, false)
    answer(1, "one")
    step(2)
    assert.same({ "2:422", "3:500", "1:one" }, results)
    assert.same({ "1 by 2", "4 by 2" }, sent(1))
  end)

  it("have no more renderers than there are workers", function()
    for number = 1, 9 do ask(number) end
    step(9)
    assert.equal(2, #started)
    started = {}
    renderers_of { workers = "1" }
    for number = 1, 9 do ask(number) end
    step(9)
    assert.equal(1, #started)
    assert.same({ "1 by 1" }, sent(1))
    started = {}
    renderers_of { workers = "9" }
    for number = 1, 9 do ask(number) end
    step(9)
    assert.equal(4, #started)
    assert.same({ "4 by 2" }, sent(4))
  end)
end)

describe("a frame that is wanted alone #plain", function()
  it("has all workers, also where there are several renderers", function()
    for number = 1, 3 do ask(number) end
    step(2)
    answer(1, "one")
    answer(2, "two")
    step()
    answer(1, "three")
    step()
    ask(4)
    step()
    local last = { sent(1)[#sent(1)], sent(2)[#sent(2)] }
    table.sort(last)
    assert.equal("4 by 2", last[#last])
  end)

  it("does not start a renderer, nor do other requests beside it", function()
    ask(1)
    step()
    ask(2)
    for _ = 1, 3 do ask(3, { ask = { want = "costs" } }) end
    step(3)
    assert.equal(1, #started)
    now = 0.3
    step()
    assert.equal(2, #started) -- as for every request that has waited so long
  end)
end)

describe("the pictures of frames that are wanted at once", function()
  local FILM = [[
    local celspan = require "celspan"
    return celspan.film { size = { 320, 180 }, frames = 9, frame = function(f)
      if f.number == 4 then error "this frame is bad" end
      return celspan.rostrum { celspan.cel { celspan.circle {
        centre = { 30 * f.number, 90 }, radius = 60, texture = "#ff8800" }:blur(5) } }
    end }
  ]]
  before_each(function() watching.begin { ["shot.lua"] = FILM } end)
  after_each(watching.finish)

  it("are those of frames that are wanted alone #plain", function()
    if not present.web() then return pending "celspan was built without libmicrohttpd" end
    if not present.program "node" then return pending "there is no node" end
    local said = watching.speak(watching.watch "shot.lua --workers 7", [=[
      const get = i => web.get(`/frame/${i}.rgba`), alone = [];
      for (let i = 1; i < 9; i++) alone.push(await get(i));
      const beside = await Promise.all([1, 2, 3, 4, 5, 6, 7, 8].map(get));
      const same = beside.map((one, i) => one.body === alone[i].body);
      return { same, status: beside.map(one => one.status),
               differ: alone[0].body !== alone[1].body };]=])
    assert.same({ true, true, true, true, true, true, true, true }, said.same)
    assert.same({ 200, 200, 200, 422, 200, 200, 200, 200 }, said.status)
    assert.is_true(said.differ)
  end)
end)
