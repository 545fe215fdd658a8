-- celspan watch: its server as programs and strangers meet it, and its page in a browser. One file,
-- because a server is begun once for many tests.
local json = require "celspan.json"
local present = require "tests.support.present"
local system = require "tests.support.system"
local watching = require "tests.support.watching"
local workbench = require "tests.support.workbench"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
return celspan.film { title = "Ball", size = { 64, 36 }, fps = 24, frames = 48, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#ffe0b0" } }:named "ground",
    celspan.cel { celspan.circle { centre = { 10 + f.index, 18 }, radius = 6, texture = "#c33" } },
  }
end, marks = { half = 24 } }
]]

local watch, speak, see, stop = watching.watch, watching.speak, watching.see, watching.stop
local bench

before_each(function()
  watching.begin { ["shot.lua"] = FILM }
  bench = watching.bench
end)

after_each(watching.finish)

describe("the server of celspan watch", function()
  it("answers programs that have the token", function()
    local said = speak(watch(), [=[
      const all = {};
      for (const path of ["/film.json", "/errors.json", "/sheet.txt", "/at/10,18.json?frame=1",
                          "/frame/1.png", "/frame/2.rgba?size=640x360&crop=100,20,30,10"]) {
        const answer = await web.get(path);
        all[path] = [answer.status, answer.body, answer.head];
      }
      all["/frame/2.rgba"] = all["/frame/2.rgba?size=640x360&crop=100,20,30,10"][1].length;
      delete all["/frame/2.rgba?size=640x360&crop=100,20,30,10"];
      all["/frame/1.png"] = Buffer.from(all["/frame/1.png"][1], "latin1").toString("base64");
      return all;]=])
    local film = json.decode(said["/film.json"][2])
    assert.same({ frames = 48, first = 1, poster = 1, fps = 24, size = { 64, 36 }, title = "Ball",
                  sound = false, marks = { { frame = 24, name = "half" } } }, film)
    assert.equal("[]\n", said["/errors.json"][2])
    local _, sheet = bench:celspan_inside "sheet shot.lua"
    assert.equal(sheet, said["/sheet.txt"][2])
    assert.equal(30 * 10 * 4, said["/frame/2.rgba"])
    local hits = json.decode(said["/at/10,18.json?frame=1"][2])
    local lines = {}
    for i, hit in ipairs(hits) do
      lines[i] = ("%s %s %s:%d"):format(hit.kind, hit.name, hit.file, hit.line)
    end
    assert.same({ "object  shot.lua:5", "cel  shot.lua:5", "object  shot.lua:4",
                  "cel ground shot.lua:4" }, lines)
    bench:inside(("echo '%s' | base64 -d >seen.png"):format(said["/frame/1.png"]))
    bench:celspan_inside "render shot.lua -o made.png --frames 1 --progress none"
    local code, out = bench:celspan_inside "compare seen.png made.png"
    assert.equal(0, code, out)
    for _, name in ipairs { "Content-Security-Policy: default-src 'self';",
                            "Cache-Control: no-store", "X-Content-Type-Options: nosniff",
                            "Cross-Origin-Resource-Policy: same-origin" } do
      assert.truthy(said["/film.json"][3]:find(name, 1, true), name)
    end
    assert.falsy(said["/film.json"][3]:find "Access%-Control")
  end)

  it("refuses strangers, and what they try", function()
    local said = speak(watch(), [=[
      const { port, token } = web, own = `http://127.0.0.1:${port}`;
      const film = "/film.json?token=" + token, long = "y".repeat(9000);
      const head = text => ({ headers: { "Celspan-Token": text } });
      const twice = (name, value) => ({ headers: { [name]: `${value}\r\n${name}: ${value}` } });
      const refused = await web.statuses([
        ["/film.json"], ["/state.json"], ["/frame/1.png"], ["/film.json?token=" + token.slice(1)],
        ["/film.json?token=" + token + "0"],
        [film, { headers: { Host: "evil.example:" + port } }],
        [film, { headers: { Host: "127.0.0.1" } }],
        [film, { headers: { Origin: "http://evil.example" } }],
        [film, { headers: { Origin: "null" } }],
        ["/film.json", head(token.slice(1))], ["/film.json", head(token + "0")],
        ["/film.json", { headers: { Cookie: `celspan-${port}=${token}; token=${token}` } }],
        ["/page.js", { headers: { "Sec-Fetch-Site": "cross-site" } }],
        ["/page.js", { headers: { "Sec-Fetch-Site": "same-site" } }],
        [film, { method: "POST" }]]);
      const doubled = await web.statuses([
        [film, { headers: { Host: `127.0.0.1:${port}\r\nHost: evil.example` } }],
        [film, twice("Host", "127.0.0.1:" + port)], [film, twice("origin", own)],
        ["/film.json", twice("Celspan-Token", token)], [film, twice("Content-Length", "0")]]);
      const methods = await web.statuses([
        [film, { method: "POST", headers: { Origin: own } }], [film, { method: "DELETE" }],
        [film, { method: "OPTIONS" }], [film, { method: "PUT" }]]);
      const paths = await web.statuses(["/frame/../../etc/passwd", "/%2e%2e/etc/passwd",
        "/frame/1.png/../x", "//etc/passwd", "/frame/shot.lua", "/shot.lua", "/frame/1.exr",
        "/frame/49.png", "/frame/0.png"].map(path => [path + "?token=" + token]));
      const sizes = await web.statuses(["size=0x1", "size=1048577x1", "size=9x", "crop=0,0,65,1",
        "crop=-1,0,1,1", "size=1048576x1048576"].map(q => [`/frame/1.png?${q}&token=${token}`]));
      const lengths = await web.statuses([
        [film, { headers: { X: long } }], [film, { headers: { X: long.repeat(9) } }],
        [film + "&a=" + long],
        [film, { method: "POST", headers: { Origin: own }, body: "x".repeat(5000) }]]);
      const nameless = await web.statuses([[film, { headers: { Host: null } }]]);
      const admitted = await web.statuses([[film], ["/film.json", head(token)], ["/"],
        ["/page.js"], ["/favicon.ico"],
        [film, { headers: { Host: "localhost:" + port } }],
        [film, { headers: { Origin: own } }]]);
      const page = await web.get("/");
      const led = await web.ask("/", { headers: { "Sec-Fetch-Site": "cross-site" } });
      return { refused, doubled, methods, paths, sizes, lengths, nameless, admitted,
               page: page.head, led: led.body,
               wide: (await web.get("/frame/1.png?size=1048576x1048576&crop=7,9,2,2")).status,
               counts: JSON.parse((await web.get("/counts.json")).body) };]=])
    local function all(status, count, list)
      assert.equal(count, #list)
      for i, one in ipairs(list) do assert.equal(status, one, i) end
    end
    all(403, 15, said.refused)
    all(405, 4, said.methods)
    all(404, 9, said.paths)
    all(400, 6, said.sizes)
    all(200, 7, said.admitted)
    all(400, 5, said.doubled)
    assert.same({ 431, 431, 431, 413 }, said.lengths)
    assert.same({ 400 }, said.nameless)
    assert.equal(200, said.wide)
    assert.is_true(said.counts.oversized >= 3)
    assert.falsy(said.page:find "Set%-Cookie")
    assert.truthy(said.led:find('http-equiv="refresh" content="0; url=/"', 1, true))
  end)

  it("answers the first request as soon as the film can be asked", function()
    bench:write("shot.lua", "for i = 1, 2e7 do local x = i end\n" .. FILM)
    local said = speak(watch(), [=[
      const all = ["/film.json", "/frame/1.png", "/errors.json"].map(path => web.get(path));
      return (await Promise.all(all)).map(one => one.status);]=])
    assert.same({ 200, 200, 200 }, said)
  end)

  it("refuses wrong queries, and answers the next ones", function()
    local said = speak(watch(), [=[
      const large = `{"list":[${Array(2000).fill("1e9")}]}`, nines = "9".repeat(400);
      const cels = ['{"list":1}', '{"list":{"a":1}}', '["h"]', '{"ground":"x"}', '{"ground":1}',
                    "7", large].map(text => "/frame/1.rgba?size=8x8&cels=" + encodeURI(text));
      const points = [`/at/${nines},1.json`, "/at/1,99999999999.json", "/at/1.2.3,4.json"];
      const refused = [];
      for (const path of [...cels, ...points]) refused.push((await web.get(path)).status);
      const list = await web.get('/frame/1.rgba?size=8x8&cels={"list":"h","ground":"h"}');
      const at = await web.get("/at/10,18.json");
      return { refused, list: list.status, at: at.status, still: (await web.get("/")).status };]=])
    assert.same({ 400, 400, 400, 400, 400, 400, 400, 400, 400, 400 }, said.refused)
    assert.same({ 200, 200, 200 }, { said.list, said.at, said.still })
  end)

  it("lets nobody keep the user out", function()
    local said = speak(watch(), [=[
      const { port, token, get, pause } = web;
      const slow = [];
      for (let i = 0; i < 40; i++) {
        slow.push(web.connect());
        slow[i].send("GET /film.json HTTP/1.1\r\nHost: 127.0");
        await pause(0.01);
      }
      await pause(0.2);
      const displaced = slow.map(one => one.isOver);
      const user = (await get("/film.json")).status;
      for (const one of slow) one.socket.destroy();
      await pause(0.3);
      const { news } = JSON.parse((await get("/state.json")).body);
      await pause(0.3);
      const held = [];
      for (let i = 0; i < 32; i++) {
        held.push(web.connect());
        held[i].send(`GET /state.json?since=${news}&token=${token} HTTP/1.1\r\n`
                     + `Host: 127.0.0.1:${port}\r\n\r\n`);
      }
      await pause(0.5);
      const late = web.connect();
      const isRefused = await late.over(5);
      const kept = held.filter(one => !one.isOver).length;
      return { displaced, user, isRefused, kept };]=])
    for i = 1, 8 do assert.is_true(said.displaced[i], i) end -- the oldest
    for i = 9, 40 do assert.is_false(said.displaced[i], i) end
    assert.equal(200, said.user)
    assert.is_true(said.isRefused)
    assert.equal(32, said.kept)
  end)

  local function endless()
    bench:write("shot.lua", (FILM:gsub("  return celspan.rostrum", [[
      if f.number == 2 then while true do end end
      if f.number == 3 then local t = {} for i = 1, 1e12 do t[i] = ("x"):rep(1e5) .. i end end
      %0]])))
  end

  it("answers while frames never end", function()
    endless()
    local said = speak(watch "shot.lua --limit time=600,steps=0", [=[
      const { get } = web, answers = [], ended = [];
      for (let i = 1; i < 3; i++) get(`/frame/2.png?size=${i}x9`).then(() => ended.push(1));
      for (let i = 0; i < 4; i++) answers.push((await get("/frame/1.png")).status);
      for (const path of ["/film.json", "/errors.json"]) {
        answers.push((await get(path)).status);
      }
      const endedFirst = ended.length;
      for (let i = 3; i < 6; i++) get(`/frame/2.png?size=${i}x9`);
      let busy;
      do { busy = (await get("/frame/1.png")).status; } while (busy === 200);
      return { answers, endedFirst, busy };]=])
    assert.same({ 200, 200, 200, 200, 200, 200 }, said.answers)
    assert.equal(0, said.endedFirst)
    assert.equal(503, said.busy) -- four renderers are at work for ever
  end)

  it("says which limit ended a frame #plain", function()
    endless()
    local said = speak(watch "shot.lua --limit time=1,memory=64M", [=[
      const two = web.get("/frame/2.png"), three = web.get("/frame/3.png");
      return { two: (await two).body, three: (await three).body,
               errors: JSON.parse((await web.get("/errors.json")).body) };]=])
    -- a busy machine keeps it waiting for ten seconds instead
    assert.truthy(said.two:find "^shot.lua:3: frame 2: the script .* more than 10? sec", said.two)
    assert.truthy(said.three:find("^shot.lua:4: .*%-%-limit"), said.three)
    local lines = {}
    for _, one in ipairs(said.errors) do lines[one.frame] = one.line end
    assert.same({ 3, 4 }, { lines[2], lines[3] }) -- busy machines fail others, too
  end)

  it("says what is wrong with a script, and shows it once it is good", function()
    bench:write("shot.lua", "local x = = 3")
    local said = speak(watch(), [=[
      const fs = require("fs");
      const until = async test => {
        for (;;) {
          const state = JSON.parse((await web.get("/state.json")).body);
          if (test(state)) return state;
          await web.pause(0.05);
        }
      };
      const bad = await until(state => state.errors.length);
      const frame = await web.get("/frame/1.png");
      fs.writeFileSync("]=] .. bench.folder .. [=[/shot.lua", ]=] .. ("%q"):format(FILM)
      :gsub("\\\n", "\\n") .. [=[);
      const good = await until(state => state.shown);
      return { bad, status: frame.status, body: frame.body, good };]=])
    assert.same({ file = "shot.lua", line = 1, message = "shot.lua:1: unexpected symbol near '='",
                  callers = {}, lines = { { 1, "local x = = 3" } } }, said.bad.errors[1])
    assert.equal(409, said.status)
    assert.equal("shot.lua:1: unexpected symbol near '='\n", said.body)
    assert.same({}, said.good.errors)
  end)

  it("sees saves of a script and of its modules, whatever names their folder has", function()
    bench:shell(("mkdir %s/parts"):format(bench.folder))
    bench:write("parts/one.lua", "return 1")
    bench:write("shot.lua", ('local one = require "parts.one"\n'
      .. 'require "celspan".read "./none.txt"\n' .. FILM):gsub(", marks = .-}", ""))
    local said = speak(watch(), [=[
      const fs = require("fs"), state = async () =>
        JSON.parse((await web.get("/state.json")).body);
      const seen = [];
      for (const file of ["", "shot.lua", "parts/one.lua", "shot.lua", "none.txt"]) {
        const before = seen.length ? (await state()).build : 0;
        if (file) fs.appendFileSync("]=] .. bench.folder .. [=[/" + file, "\n");
        for (let i = 0; i < 200; i++) {
          const now = await state();
          if (now.build > before && now.shown && !now.building) {
            seen.push(file);
            break;
          }
          await web.pause(0.05);
        }
      }
      return { seen, hasMarks: Array.isArray((await state()).film.marks) };]=])
    assert.same({ "", "shot.lua", "parts/one.lua", "shot.lua", "none.txt" }, said.seen)
    assert.is_true(said.hasMarks)
  end)

  it("checks the other frames by itself", function()
    bench:write("shot.lua", (FILM:gsub("radius = 6", "radius = f.number == 40 and -1 or 6")))
    local said = speak(watch(), [=[
      for (;;) {
        const errors = JSON.parse((await web.get("/errors.json")).body);
        if (errors.length) return errors;
        await web.pause(0.1);
      }]=])
    assert.equal(1, #said)
    assert.equal(40, said[1].frame)
    assert.equal(5, said[1].line)
  end)

  it("opens lines that the film has named in the editor, without a shell", function()
    bench:write("edit", ('#!/bin/sh\necho "$@" >>%s/opened\n'):format(bench.folder))
    bench:inside "chmod +x edit"
    local said = speak(watch("shot.lua --editor './edit -g {file}:{line} $(touch x);'"), [=[
      const { port, token } = web;
      const open = (body, headers) => web.get("/open", { method: "POST", body, headers });
      const own = { Origin: `http://127.0.0.1:${port}` };
      const line = '{"file": "shot.lua", "line": 4}';
      const before = (await open(line, own)).status;
      await web.get("/at/10,18.json?frame=1");
      const refused = [await open(line), await open('{"file": "/etc/passwd", "line": 4}', own),
                       await open('{"file": "shot.lua", "line": 7}', own), await open("4", own),
                       await web.get("/open?file=shot.lua&line=4")];
      const opened = await open(line, own);
      await web.pause(0.5);
      return { before, refused: refused.map(one => one.status), opened: opened.status };]=])
    assert.equal(404, said.before)
    assert.same({ 403, 404, 404, 400, 404 }, said.refused)
    assert.equal(200, said.opened)
    assert.equal(("-g %s/shot.lua:4 $(touch x);\n"):format(bench.folder), bench:read "opened")
    assert.is_nil(bench:read "x")
  end)

  it("gives the editor nothing but files that the film reads, whatever a script names", function()
    bench:write("edit", ('#!/bin/sh\necho "$@" >>%s/opened\n'):format(bench.folder))
    bench:write("+!cmd.lua", "return 1\nreturn 2")
    bench:inside "chmod +x edit && mkfifo fifo.png"
    bench:write("shot.lua", [[
      local celspan = require "celspan"
      local tricks = {
        function() error("+silent !touch x:7: attempt to index nil", 0) end,
        function() error("shot.lua:1: a (called from -x:2, --eval=(y):3, /etc/passwd:4)", 0) end,
        function() assert(load("error 'loaded'", "@-c quit"))() end,
        function() pcall(celspan.read, "/etc/passwd") error("/etc/passwd:3: boom", 0) end,
        function() pcall(celspan.read, "none.lua") error("fifo.png:1: boom", 0) end,
        function() pcall(celspan.image, { file = "fifo.png" }) error("fifo.png:1: boom", 0) end,
        function() celspan.read "+!cmd.lua" error("+!cmd.lua:2: boom", 0) end,
      }
      return celspan.film { size = { 64, 36 }, frames = 9, frame = function(f)
        if tricks[f.number] then tricks[f.number]() end
        if f.number == 9 then return celspan.rostrum {} end
        local disc = [=[return require "celspan".circle { centre = { 9, 9 }, radius = 9 }]=]
        return celspan.rostrum { celspan.cel { assert(load(disc, "@-c"))() } }
      end }]])
    local said = speak(watch "shot.lua --editor ./edit\\ {line}\\ {file}", [=[
      for (let i = 1; i < 9; i++) await web.get(`/frame/${i}.png`);
      const errors = JSON.parse((await web.get("/errors.json")).body), statuses = {};
      const hits = JSON.parse((await web.get("/at/9,9.json?frame=8")).body);
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const named = [["+silent !touch x", 7], ["-x", 2], ["--eval=", 3], ["/etc/passwd", 4],
                     ["/etc/passwd", 3], ["-c quit", 1], ["-c", 1], ["none.lua", 1]];
      for (const [file, line] of [...named, ["shot.lua", 1], ["+!cmd.lua", 2]]) {
        const body = JSON.stringify({ file, line });
        const { status } = await web.get("/open", { method: "POST", body, headers });
        statuses[`${file}:${line}`] = status;
      }
      await web.pause(0.5);
      return { errors, hits, statuses };]=])
    for place, status in pairs(said.statuses) do
      local is_own = place == "shot.lua:1" or place == "+!cmd.lua:2"
      assert.equal(is_own and 200 or 404, status, place)
    end
    assert.equal(("1 %s/shot.lua\n2 %s/+!cmd.lua\n"):format(bench.folder, bench.folder),
      bench:read "opened")
    for _, hit in ipairs(said.hits) do assert.not_equal("-c", hit.file) end
    local by_frame = {}
    for _, one in ipairs(said.errors) do by_frame[one.frame] = one end
    assert.same({ { 1, "return 1" }, { 2, "return 2" } }, by_frame[7].lines)
    for _, frame in ipairs { 1, 4, 5, 6 } do assert.is_nil(by_frame[frame].lines, frame) end
    assert.is_nil(by_frame[4].file)
  end)

  it("has renderers that answer the next request after one that they cannot answer", function()
    bench:write("requests", (">s4s4s4"):pack('{"want":"none"}', '{"want":"frame","number":1}',
      '{"want":"film"}'))
    local code, out = bench:inside(("'%s' stage shot.lua <requests"):format(workbench.absolute))
    assert.equal(0, code)
    local good, at = {}, 1
    while at <= #out do
      local message
      message, at = (">s4"):unpack(out, at)
      good[#good + 1] = json.decode((">s4"):unpack(message)).good
    end
    assert.same({ false, false, true }, good)
  end)

  it("has renderers that load no modules of celspan for what the script does not do", function()
    local loads = [[
local celspan = require "celspan"
local box = { 0, 0, 8, 8 }
local function film()
  return celspan.film { size = { 8, 8 }, frames = 2, frame = function()
    local names = {}
    for name in pairs(debug.getregistry()["celspan.loaded"] or {}) do names[#names + 1] = name end
    table.sort(names)
    print("loaded:" .. table.concat(names, ","))
    return celspan.rostrum { celspan.cel { celspan.rect(box) } }
  end }
end
]]
    bench:write("loads.lua", loads .. "return film()")
    bench:write("cuts.lua", loads .. 'celspan.parameters { side = 8 }\n'
      .. 'return require "celspan.cut" { film(), film() }')
    bench:write("requests", (">s4s4"):pack('{"want":"film"}',
      '{"want":"frame","number":1,"size":[8,8],"crop":[0,0,8,8],"what":"picture"}'))
    local function loaded(script)
      local code, out, err = bench:inside(("'%s' stage %s --trust <requests")
        :format(workbench.absolute, script))
      assert.equal(0, code, err)
      local answer = (">s4"):unpack(out)
      return json.decode((">s4"):unpack(answer)), err:match "loaded:([^\n]*)"
    end
    local plain, of_plain = loaded "loads.lua"
    assert.equal("", of_plain)
    assert.same({}, plain.parameters)
    assert.is_nil(plain.film.shots)
    local cut, of_cut = loaded "cuts.lua"
    assert.truthy(of_cut:find "celspan.shots" and of_cut:find "celspan.parameters", of_cut)
    assert.equal("side", cut.parameters[1].name)
    assert.equal(2, #cut.film.shots)
  end)

  it("ends its renderers with itself", function()
    local address = watch()
    speak(address, [=[return (await web.get("/frame/1.png")).status;]=])
    local server = watching.server()
    local children = bench:read(("/proc/%s/task/%s/children"):format(server, server))
    assert.truthy(children:find "%d")
    stop()
    for child in children:gmatch "%d+" do
      assert.is_nil((os.execute(("kill -0 %s 2>/dev/null"):format(child))))
    end
    assert.equal("", bench:read "complained")
  end)

  it("refuses what it cannot do", function()
    local port = watch():match ":(%d+)/"
    local code, _, err = bench:celspan_inside("watch shot.lua --port %s", port)
    assert.equal(2, code)
    local refusal = ("--port %s: another program uses this port"):format(port)
    assert.truthy(err:find(refusal, 1, true), err)
    code, _, err = bench:celspan_inside "watch none.lua"
    assert.equal(4, code)
    assert.truthy(err:find("none.lua: No such file or directory", 1, true), err)
    code, _, err = bench:inside(("CELSPAN_WEB_MODULE=none.so '%s' watch shot.lua")
      :format(workbench.absolute))
    assert.equal(4, code)
    assert.truthy(err:find("showing a film in a browser needs the module celspan-web.so", 1, true),
      err)
  end)

  it("is not part of the program", function()
    local libraries = system.output(("ldd '%s' 2>/dev/null"):format(workbench.absolute))
    assert.falsy(libraries:find "microhttpd")
  end)
end)

describe("the page of celspan watch #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  it("shows, steps and plays frames, by keys alone", function()
    local said = see(watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const first = await page.get(`[${canvas("size")}, ${canvas("crop")},
        document.querySelector("#canvas").width, document.querySelector("#canvas").height]`);
      await page.press("ArrowRight"); await page.press("ArrowRight"); await page.press("ArrowLeft");
      await page.until(`${canvas("frame")} === "2"`);
      const stepped = await text("frame");
      await page.press(" ");
      await page.until(`Number(${canvas("frame")}) > 12`);
      await page.press(" ");
      const stopped = await text("frame");
      await page.pause(0.3);
      const still = await text("frame");
      await page.press("End");
      await page.until(`${canvas("frame")} === "48"`);
      const foreign = page.requests.filter(url => !url.startsWith("http://127.0.0.1:"));
      return { first, stepped, stopped, still, foreign, hash: await page.get("location.href") };]=])
    local w, h = said.first[1]:match "(%d+)x(%d+)"
    assert.equal(("0,0,%s,%s"):format(w, h), said.first[2])
    assert.same({ tonumber(w), tonumber(h) }, { said.first[3], said.first[4] })
    assert.equal("2", said.stepped)
    assert.equal(said.stopped, said.still)
    assert.same({}, said.foreign)
    assert.falsy(said.hash:find "token")
  end)

  it("shows every save, and an error over the last good picture", function()
    bench:write("colour.lua", 'return "#3c3"')
    bench:write("shot.lua", (FILM:gsub('"#ffe0b0"', 'require "colour"')))
    local said = see(watch(), [=[
      const folder = "]=] .. bench.folder .. [=[/";
      const colour = () => page.get(`[...document.querySelector("#canvas").getContext("2d")
        .getImageData(0, 0, 1, 1).data].join()`);
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("ArrowRight");
      await page.until(`${canvas("frame")} === "2"`);
      const colours = [await colour()], old = await page.get(canvas("build"));
      page.write(folder + "colour.lua", 'return "#33c"');
      await page.until(`${canvas("build")} !== "${old}"`);
      colours.push(await colour());
      page.write(folder + "colour.lua", 'error "no paint"');
      await page.until(`!document.querySelector("#error").hidden`);
      const error = await text("error"), seen = await page.get(canvas("frame"));
      colours.push(await colour());
      page.write(folder + "colour.lua", 'return 7');
      await page.until(`document.querySelector("#error").textContent.startsWith("shot.lua:4")`);
      const refused = await text("error");
      page.write(folder + "colour.lua", 'return "#c3c"');
      await page.until(`document.querySelector("#error").hidden`);
      colours.push(await colour());
      return { colours, error, seen, refused, last: await page.get(canvas("frame")) };]=])
    assert.same({ "51,204,51,255", "51,51,204,255", "51,51,204,255", "204,51,204,255" },
      said.colours)
    assert.truthy(said.error:find("colour.lua:1: frame 2: no paint", 1, true), said.error)
    assert.equal("2", said.seen)
    assert.truthy(said.refused:find("shot.lua:4: frame 2: ", 1, true), said.refused)
    assert.equal("2", said.last)
  end)

  it("zooms to the largest frame, and shows there what a render shows", function()
    local said = see(watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const box = await page.get(`(() => { const b = document.querySelector("#canvas")
        .getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()`);
      const x = box[0] + box[2] * 16 / 64, y = box[1] + box[3] / 2;
      for (let i = 0; i < 60; i++) {
        await page.mouse("mouseWheel", x, y, { deltaX: 0, deltaY: -200 });
      }
      await page.until(`${canvas("size")} === "1048576x589824"`);
      await page.press("p");
      await page.until(`${canvas("crop")}.split(",")[2] < 1010`);
      await page.click(600, 400);
      await page.until(`document.querySelectorAll("#hits li").length > 1`);
      const picture = await page.get(`document.querySelector("#canvas").toDataURL()`);
      return { picture: picture.split(",")[1], crop: await page.get(canvas("crop")),
               hits: await page.get(`document.querySelector("#hits").innerText`) };]=])
    bench:write("seen.base64", said.picture)
    bench:inside "base64 -d seen.base64 >seen.png"
    bench:celspan_inside("render shot.lua -o made.png --frames 1 --size 1048576x589824 --crop %s "
      .. "--progress none", said.crop)
    local code, out = bench:celspan_inside "compare seen.png made.png --fail 0.004"
    assert.equal(0, code, out)
    assert.matches("ground %(cel%)%s+shot%.lua:4", said.hits)
  end)

  it("shows the exposure sheet, and goes where it is clicked", function()
    local said = see(watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("s");
      await page.until(`document.querySelectorAll("#names li").length === 2`);
      const box = await page.get(`(() => { const b = document.querySelector("#rows")
        .getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()`);
      await page.click(box[0] + box[2] * 29.5 / 48, box[1] + 30);
      await page.until(`${canvas("frame")} === "30"`);
      const painted = await page.get(`[8, 30].map(y => document.querySelector("#rows")
        .getContext("2d").getImageData(4, y * devicePixelRatio, 1, 1).data[3])`);
      const left = id => page.get(`document.querySelector("${id}").getBoundingClientRect().x`);
      return { painted, head: (await left("#head") - await left("#rows")) / box[2] * 48,
               names: await page.get(`[...document.querySelectorAll("#names li")]
                 .map(one => one.title).join("\\n")`) };]=])
    assert.same({ 255, 255 }, said.painted)
    assert.is_true(math.abs(said.head - 29) < 0.2, said.head)
    assert.equal("cel 2\nground", said.names)
  end)

  it("shows the frames before and after, in red and green", function()
    local said = see(watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      for (let i = 0; i < 4; i++) await page.press("ArrowRight");
      await page.until(`${canvas("frame")} === "5"`);
      const colour = x => page.get(`(() => { const canvas = document.querySelector("#canvas");
        return [...canvas.getContext("2d").getImageData(Math.round(${x} / 64 * canvas.width),
          Math.round(canvas.height / 2), 1, 1).data]; })()`);
      const plain = await colour(8.4);
      await page.press("n");
      await page.until(`document.querySelector("#onion").textContent === "Onion skin 1"
        && !document.querySelector("#canvas").hasAttribute("data-stale")`);
      // The ball is from 8 to 20, and before and after that a unit to the left and to the right.
      return { plain, before: await colour(7.4), after: await colour(20.5),
               ground: await colour(40), ball: await colour(14) };]=])
    assert.same({ 204, 51, 51, 255 }, said.plain)
    assert.is_true(said.before[1] > said.before[2] + 40, table.concat(said.before, ","))
    assert.is_true(said.after[2] < 224 and said.after[1] < said.ground[1],
      table.concat(said.after, ","))
    assert.same({ 255, 224, 176, 255 }, said.ground)
    assert.same({ 204, 51, 51, 255 }, said.ball)
  end)

  it("compares a save with the one before, by a wipe or their difference", function()
    local said = see(watch(), [=[
      const folder = "]=] .. bench.folder .. [=[/", fs = require("fs");
      const colours = () => page.get(`[0.1, 0.9].map(x => { const canvas =
        document.querySelector("#canvas"); return [...canvas.getContext("2d")
        .getImageData(Math.round(x * canvas.width), 2, 1, 1).data].join(); })`);
      // On a slow machine a picture of a quarter of the size comes first.
      const isFine = `(one => 2 * one.width > one.clientWidth)(document.querySelector("#canvas"))`;
      await page.until(`${canvas("frame")} === "1" && ${isFine}`);
      const old = await page.get(canvas("build"));
      const script = fs.readFileSync(folder + "shot.lua", "utf8");
      page.write(folder + "shot.lua", script.replace("#ffe0b0", "#ffd0b0"));
      await page.until(`${canvas("build")} !== "${old}" && ${isFine}`);
      const seen = [];
      for (const key of ["w", "d", "d"]) {
        await page.press(key);
        seen.push(await colours());
      }
      return seen;]=])
    assert.same({ { "255,224,176,255", "255,208,176,255" }, { "0,64,0,255", "0,64,0,255" },
                  { "255,208,176,255", "255,208,176,255" } }, said)
  end)

  it("has a form for the parameters, which the address and a command line hold", function()
    bench:write("shot.lua", (FILM:gsub("return celspan.film", [[
      local p = celspan.parameters { tint = { colour = "#33cc33" }, side = { "left", "right" },
                                     size = { 6, min = 0, max = 30 }, on = true, name = "it's",
                                     off = false }
      %0]], 1):gsub('"#ffe0b0"', "p.tint"):gsub("radius = 6", "radius = p.size")))
    local said = see(watch "shot.lua --set size=5", [=[
      const colour = () => page.get(`[...document.querySelector("#canvas").getContext("2d")
        .getImageData(0, 0, 1, 1).data].join()`);
      const put = async (kind, value) => {
        const old = await page.get(canvas("build"));
        await page.get(`(() => { const input = document.querySelector("#form input[type=${kind}]");
          input.value = "${value}"; input.dispatchEvent(new Event("input")); })()`);
        await page.until(`${canvas("build")} !== "${old}"`);
      };
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("v");
      const first = await page.get(`[...document.querySelectorAll("#form input, #form select")]
        .map(one => one.type === "checkbox" ? String(one.checked) : one.value).join("|")`);
      const colours = [await colour()];
      await put("color", "#3333cc");
      colours.push(await colour());
      await put("range", "29.99999");
      await page.until(`location.hash.endsWith("&size=30")`);
      const said = { first, colours,
                     command: await page.get(`document.querySelector("#command").value`),
                     address: await page.get("location.hash") };
      await page.get(`document.querySelector("#reset-values").click()`);
      await page.until(`document.querySelector("#form input[type=range]").value === "5"
        && !location.hash`);
      return { ...said, last: await page.get("location.hash") };]=])
    -- In the order of the script.
    assert.equal("#33cc33|left|5|5|true|it's|false", said.first)
    assert.same({ "51,204,51,255", "51,51,204,255" }, said.colours)
    assert.equal("celspan render shot.lua --set tint=#3333cc --set size=30 -o shot.mp4",
      said.command)
    assert.equal("#tint=%233333cc&size=30", said.address)
    assert.equal("", said.last)
  end)

  it("plays alone, without bars, with celspan play, whose commands have no token", function()
    bench:inside "mkdir bin"
    bench:write("bin/xdg-open", ('#!/bin/sh\ncd %s\ncat /proc/[0-9]*/cmdline >seen 2>/dev/null\n'
      .. 'echo "$@" >opened\n'):format(bench.folder))
    bench:inside "chmod +x bin/xdg-open"
    local path = watching.start(("PATH=%s/bin:$PATH XDG_RUNTIME_DIR=%s exec '%s' play shot.lua "
      .. ">said 2>complained"):format(bench.folder, bench.folder, workbench.absolute), function()
      return (bench:read "opened" or ""):match "^%g+"
    end)
    local address = bench:read(path):match 'url=(http%g+)"'
    assert.equal("watching " .. address .. "\n", bench:read "said")
    assert.falsy(bench:read("seen"):find(address:match "token=(%x+)", 1, true))
    assert.equal("600 700\n", system.output(("stat -c %%a '%s' '%s' | paste -sd ' '")
      :format(path, path:match "^(.*)/")))
    local said = see("file://" .. path, [=[
      await page.until(`Number(${canvas("frame")}) > 3`);
      await page.load();
      await page.until(`Number(${canvas("frame")}) > 3`);
      return page.get(`getComputedStyle(document.querySelector("header")).display`);]=])
    assert.equal("none", said)
    watching.stop()
    assert.is_nil(bench:read(path))
  end)

  it("keeps its token for itself: pages are loaded again, and opened by a bookmark", function()
    local said = see(watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const cookie = await page.get("document.cookie");
      const addresses = [];
      for (const address of ["", `${await page.get("location.origin")}/`]) {
        await page.load(address);
        await page.until(`${canvas("frame")} === "1"`);
        addresses.push(await page.get("location.pathname + location.search"));
      }
      const own = await page.get("location.origin");
      await page.load(`data:text/html,<script>location = "${own}/%23x=1"</script>`,
        new RegExp(`^${own}/$`));
      const led = await page.get("location.hash");
      await page.get("localStorage.clear()");
      await page.load();
      await page.until(`document.querySelector("#news")?.textContent.includes("token is missing")`);
      return { cookie, addresses, led };]=])
    assert.same({ cookie = "", addresses = { "/", "/" }, led = "" }, said)
  end)
end)
