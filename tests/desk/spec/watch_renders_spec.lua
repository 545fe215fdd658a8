-- celspan watch: the renders that its page begins, where files, scripts and signals are unkind.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local SLOW = [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 100000, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, f.number % 8, 8 } } } end }
]]

--- The slow film whose frames begin with some statements.
local function film(statements)
  return (SLOW:gsub("function%(f%)\n", "%0" .. statements:gsub("%%", "%%%%") .. "\n"))
end

before_each(function() watching.begin { ["shot.lua"] = SLOW } end)
after_each(watching.finish)

local HELP = [=[
  const { execSync } = require("child_process");
  const headers = { Origin: `http://127.0.0.1:${web.port}` };
  const ask = body => web.get("/render", { method: "POST", headers, body: JSON.stringify(body) });
  const render = async body => (await ask(body)).status;
  const whole = async () => JSON.parse((await web.get("/state.json")).body);
  const state = async () => (await whole()).render;
  const until = async fits => {
    for (;;) {
      const now = await state();
      if (fits(now)) return now;
      await web.pause(0.02);
    }
  };
  const isOver = now => now.state !== "running";
  await web.get("/frame/1.png");
]=]

local function speak(arguments, steps)
  return watching.speak(watching.watch(arguments), HELP .. steps)
end

describe("the files of a render from the page", function()
  it("are in a folder with any name, of which no part is a number", function()
    watching.bench:inside "mkdir 'a#b' a1b && mv shot.lua 'a#b' && echo kept >'a#b/out.png'"
    watching.bench:inside "cp 'a#b/out.png' a1b/out.png"
    local said = speak("'a#b/shot.lua'", [=[
      const still = { format: "png", file: "out.png", frames: "1" };
      const first = await ask(still);
      await render({ format: "gif", file: "out.gif" });
      await render({ cancel: true });
      const last = await until(isOver), good = await render({ ...still, file: "two.##.png" });
      return { status: first.status, body: first.body, last, good, done: await until(isOver) };]=])
    assert.equal(409, said.status)
    assert.same({ exists = true, message = "out.png is there already" }, json.decode(said.body))
    assert.same({ "cancelled", 200, "done" }, { said.last.state, said.good, said.done.state })
    assert.equal("kept\n", watching.bench:read "a#b/out.png")
    assert.equal("kept\n", watching.bench:read "a1b/out.png")
    assert.same({ "out.png", "shot.lua", "two.01.png" }, watching.bench:files "a#b")
  end)

  it("have numbers of at most twenty digits, and are there even if nobody can read them", function()
    watching.bench:inside "ln -s loop.png loop.png"
    local said = speak(nil, [=[
      const still = { format: "png", frames: "1" };
      const found = {};
      for (const count of [20, 21]) {
        found[count] = await render({ ...still, file: `${"#".repeat(count)}.png` });
        await until(isOver);
      }
      found.loop = await render({ ...still, file: "loop.png" });
      return found;]=])
    assert.same({ ["20"] = 200, ["21"] = 400, loop = 409 }, said)
    assert.truthy(watching.bench:read(("0"):rep(19) .. "1.png"))
  end)

  it("are in the folder of -o, and in no other", function()
    watching.bench:inside "mkdir -p out/in && ln -s ../out out/same && ln -s .. out/away"
    local said = speak("shot.lua -o out", [=[
      const found = { folder: (await whole()).folder };
      const bad = { up: "../a.png", away: "away/a.png", root: "/tmp/a.png", none: "no/a.png" };
      for (const [name, file] of Object.entries({ plain: "a.png", inner: "in/b.png",
          same: "same/c.png", ...bad })) {
        found[name] = await render({ format: "png", frames: "1", file });
        await until(isOver);
      }
      return found;]=])
    assert.same({ folder = "out/", plain = 200, inner = 200, same = 200, up = 400, away = 400,
                  root = 400, none = 400 }, said)
    assert.same({ "a.png", "away", "c.png", "in", "same" }, watching.bench:files "out")
    assert.same({ "b.png" }, watching.bench:files "out/in")
    local code, _, message = watching.bench:celspan_inside "watch shot.lua -o missing"
    assert.equal(5, code)
    assert.truthy(message:find("-o missing: there is no such folder", 1, true), message)
  end)

  it("are of one render at a time, which no question can replace", function()
    local said = speak(nil, [=[
      await render({ format: "gif", file: "a.gif" });
      const second = await ask({ format: "png", file: "b.png", frames: "1", replace: true });
      await render({ cancel: true });
      await until(isOver);
      return { status: second.status, body: second.body };]=])
    assert.equal(409, said.status)
    assert.equal("a render is running: cancel it first\n", said.body)
  end)
end)

describe("what a render prints", function()
  it("is read in a moment, whatever the length of its lines", function()
    watching.bench:write("shot.lua",
      film 'io.stderr:write(("x"):rep(4000000), "\\n") error "no paint"')
    local said = speak("shot.lua --trust", [=[
      await render({ format: "png", file: "a.png", frames: "1" });
      return await until(isOver);]=])
    assert.equal("failed", said.state)
    assert.equal("shot.lua:3: frame 1: no paint", said.message)
  end)

  it("changes nothing but numbers and a short text in the state of the page", function()
    watching.bench:write("shot.lua", film [[
      print '{"event": "frame", "done": 1e999, "count": {"a": 1}, "left": "<b>"}'
      print '{"event": "error", "message": {"a": 1}}'
      for i = 1, 4e7 do i = i + 1 end
      error("no paint" .. ("x"):rep(5000))]])
    local said = speak(nil, [=[
      await render({ format: "png", file: "a.png", frames: "1" });
      const found = [];
      const last = await until(now => { found.push(now); return isOver(now); });
      return { found, last };]=])
    for _, one in ipairs(said.found) do
      assert.is_true(one.done == nil or one.done == 0, tostring(one.done))
      assert.is_true(one.count == nil or one.count == 1)
      assert.is_true(one.left == nil)
    end
    assert.equal("failed", said.last.state)
    assert.truthy(said.last.message:find("no paint", 1, true))
    assert.is_true(#said.last.message <= 2000)
  end)

  it("is reported a few times a second", function()
    local said = speak(nil, [=[
      const before = (await whole()).news, began = Date.now();
      await render({ format: "png", file: "x.######.png" });
      await until(now => now.done > 100);
      const after = (await whole()).news, seconds = (Date.now() - began) / 1000;
      await render({ cancel: true });
      await until(isOver);
      return { count: after - before, seconds };]=])
    -- one at the beginning, and those of the frames that are checked meanwhile
    assert.is_true(said.count <= 3 + 6 * said.seconds, said.count .. " in " .. said.seconds)
  end)

  it("does not end the server, even if it is no answer of a renderer", function()
    watching.bench:write("shot.lua", 'io.stdout:write("\\0\\0\\0\\1x") io.stdout:flush()\n' .. SLOW)
    local said = watching.speak(watching.watch "shot.lua --trust", [=[
      const errors = await web.get("/errors.json"), frame = await web.get("/frame/1.png");
      return { errors: JSON.parse((await web.get("/errors.json")).body), status: frame.status };]=])
    assert.equal(409, said.status)
    assert.equal("the renderer's answer cannot be read", said.errors[1].message)
  end)
end)

describe("a render that is ended", function()
  it("leaves no part of a file when the server is ended", function()
    speak(nil, [=[
      await render({ format: "gif", file: "x.gif" });
      await until(now => now.done > 5);
      return 0;]=])
    assert.truthy(table.concat(watching.bench:files(), " "):find "x.gif.%x+.part")
    watching.stop()
    assert.falsy(table.concat(watching.bench:files(), " "):find "gif")
  end)

  it("leaves none when it does not end by itself", function()
    local address = watching.watch()
    local said = watching.speak(address, HELP .. ([=[
      await render({ format: "gif", file: "x.gif" });
      await until(now => now.done > 5);
      execSync("pkill -STOP -P %s -f 'render shot.lua'");
      await render({ cancel: true });
      return await until(isOver);]=]):format(watching.server()))
    assert.equal("cancelled", said.state)
    assert.falsy(table.concat(watching.bench:files(), " "):find "gif")
  end)
end)
