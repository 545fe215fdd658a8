-- celspan watch: which renderer is given which request, and with how many workers. The processes
-- and the clock are the test's own, so that nothing depends on the speed of a machine.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

local now, started

--- A process that keeps what is sent to it, and gives the answers that a test has put into it.
local function new_process()
  local process = { sent = {}, answers = {}, abandoned = {} }
  function process:send(text)
    table.insert(self.sent, json.decode(text))
    return true
  end
  function process:abandon(number) table.insert(self.abandoned, number) end
  function process:take() return table.remove(self.answers, 1) end
  function process.words() return "" end
  function process.finish() return 1 end
  function process.kill() end
  function process.is_gone() return true end
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
  local load_it = assert(loadfile "src/desk/program/verbs/watch/renderers.lua")
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

--- Lets a renderer answer with a head and bytes.
local function put(i, head, bytes)
  head.files = {}
  table.insert(started[i].answers, (">s4"):pack(program.json(head)) .. (bytes or ""))
end

--- Lets a renderer answer the request that it was sent last; bytes: nil if it refuses.
local function answer(i, bytes) put(i, { good = bytes ~= nil, message = "no" }, bytes) end

--- Lets it say that it has built the frame that it was sent last.
local function begin(i) put(i, { good = true, begun = true, seconds = 1, camera = "c" }) end

--- Lets it give the picture of its request with this number; bytes: nil if it failed.
local function draw(i, number, bytes)
  put(i, { picture = number, seconds = 2, message = not bytes and "no" or nil }, bytes)
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
  it("are drawn side by side, and share the processors", function()
    for number = 1, 3 do ask(number) end
    step()
    assert.same({ "1 by 1" }, sent(1))
    for _ = 1, 2 do
      begin(1)
      step()
    end
    assert.same({ "1 by 1", "2 by 1", "3 by 1" }, sent(1))
    assert.equal(1, #started)
  end)

  it("are built one after the other, while earlier ones are drawn", function()
    ask(1)
    ask(2)
    step(3)
    assert.same({ "1 by 1" }, sent(1))
    begin(1)
    step()
    draw(1, 1, "one")
    begin(1)
    step()
    draw(1, 2, "two")
    step()
    assert.same({ "1:one", "2:two" }, results)
  end)

  it("are given in the order in which they are drawn", function()
    for number = 1, 3 do ask(number) end
    for _ = 1, 2 do
      step()
      begin(1)
    end
    step() -- the third is being built, perhaps for ever
    draw(1, 2, "two")
    draw(1, 1, "one")
    step()
    assert.same({ "2:two", "1:one" }, results)
  end)

  it("may be drawn before it is said that they are begun", function()
    local heads = {}
    ask(1, { done = function(head, bytes) table.insert(heads, { head, bytes }) end })
    step()
    draw(1, 1, "one")
    step()
    assert.same({}, heads)
    begin(1)
    step()
    assert.same({ { { good = true, seconds = 3, camera = "c" }, "one" } }, heads)
    ask(2)
    step()
    draw(1, 2, "two")
    answer(1)
    step()
    assert.same({ "2:422" }, results)
  end)

  it("wait where enough are drawn, and other requests do not", function()
    for number = 1, 5 do ask(number) end
    ask(6, { ask = { want = "costs" } })
    for _ = 1, 3 do
      step()
      begin(1)
    end
    step()
    assert.same({ "1 by 1", "2 by 1", "3 by 1", "costs" }, sent(1))
    answer(1, "costs")
    step()
    draw(1, 1, "one")
    step()
    assert.same({ "6:costs", "1:one" }, results)
    assert.equal("4 by 1", sent(1)[5])
  end)

  it("are given up one by one", function()
    for number = 1, 4 do ask(number) end
    step()
    begin(1)
    step()
    begin(1)
    step()
    for _, wish in ipairs { "w2", "w2", "w3", "w4", "none" } do pool:abandon(wish) end
    assert.same({ 2, 3 }, started[1].abandoned)
    answer(1)
    draw(1, 1, "one")
    draw(1, 2)
    step()
    assert.same({ "4:503", "3:503", "1:one", "2:503" }, results)
  end)

  it("do not fail with one of them", function()
    for number = 1, 3 do ask(number) end
    step()
    answer(1)
    step()
    begin(1)
    step()
    draw(1, 2)
    begin(1)
    step()
    draw(1, 3, "three")
    step()
    assert.same({ "1:422", "2:422", "3:three" }, results)
  end)

  it("are drawn by another renderer when theirs has ended, once", function()
    for number = 1, 3 do ask(number) end
    step()
    begin(1)
    step()
    table.insert(started[1].answers, false)
    step(2)
    assert.same({ "2:500" }, results)
    assert.same({ "1 by 1" }, sent(2))
    begin(2)
    step()
    assert.same({ "1 by 1", "3 by 1" }, sent(2))
    table.insert(started[2].answers, false)
    step(2)
    table.sort(results)
    assert.same({ "1:500", "2:500", "3:500" }, results)
  end)

  it("may begin everything again when one fails", function()
    ask(1)
    ask(2, { failed = function()
      pool:close("again", 503)
      ask(3)
    end })
    step()
    begin(1)
    step()
    answer(1)
    started[1].kill = function(self) self.take = function() return false end end
    step()
    assert.same({ "1:503" }, results)
    assert.same({ "3 by 2" }, sent(2))
  end)

  it("end a renderer that answers what it was not asked", function()
    for _, put_it in ipairs { answer, begin } do
      started, results = {}, {}
      renderers_of {}
      ask(1)
      step()
      begin(1)
      draw(1, 1, "one")
      put_it(1, "more")
      step()
      assert.same({ "1:one" }, results)
      ask(2)
      step()
      assert.same({ "2 by 2" }, sent(2))
    end
  end)

  it("fail where the answer cannot be used", function()
    ask(1, { done = function() error "no" end })
    step()
    answer(1, "bytes")
    step()
    assert.same({ "1:500" }, results)
    assert.is_nil(pool.list[1])
  end)
end)

describe("a frame that is wanted alone #plain", function()
  it("has all workers", function()
    for number = 1, 3 do
      ask(number)
      step()
      begin(1)
      draw(1, number, "done")
      step()
    end
    assert.same({ "1 by 2", "2 by 2", "3 by 2" }, sent(1))
  end)
end)

describe("another renderer #plain", function()
  it("is started when nothing is heard of the others for a while", function()
    ask(1)
    step()
    ask(2)
    step(3)
    assert.equal(1, #started)
    now = 0.3
    step()
    assert.same({ { "1 by 2" }, { "2 by 1" } }, { sent(1), sent(2) })
  end)

  it("is not started while frames are only slow", function()
    for number = 1, 9 do ask(number) end
    for number = 1, 9 do
      step()
      begin(1)
      now = now + 0.2
      step()
      if number > 1 then draw(1, number - 1, "done") end
      now = now + 0.2
    end
    assert.equal(1, #started)
  end)

  it("ends when it is not needed any more", function()
    ask(1)
    step()
    ask(2)
    now = 0.3
    step(2)
    answer(1, "one")
    begin(2)
    draw(2, 1, "two")
    step()
    now = 30
    step(2)
    assert.equal(1, #pool.list)
  end)

  it("is one of four at most", function()
    for number = 1, 9 do
      ask(number)
      now = now + 0.3
      step(2)
    end
    assert.equal(4, #started)
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

  it("are those of frames that are wanted alone #workers #always", function()
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
