-- celspan watch: its timeline, objects, values and renders.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

-- Two shots with half a second of a dissolve between them; values in three groups of fields.
local FILM = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local p = celspan.parameters {
  word = "a", sun = { 20, 18, point = true, group = "Light", about = "its place" },
  how = { ease = "outBack", group = "Light" }, level = { 2, min = 0, max = 9 }, dim = false }
local function shot(colour)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, marks = { bell = 40 },
    frame = function()
      return celspan.rostrum {
        celspan.cel { celspan.rect { 0, 0, 64, 36, texture = colour } }:named "ground",
        celspan.cel { celspan.circle { centre = p.sun, radius = 6, texture = "#fd0" }
          :named "disc" }:named "sun" }
    end }
end
return cut { { film = shot "#036", name = "evening" }, cut.dissolve(0.5),
             { film = shot "#630", name = "night" }, title = "Hours" }
]]

local SLOW = [[
local celspan = require "celspan"
return celspan.film { size = { 8, 8 }, frames = 100000, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, f.number % 8, 8 } } } end }
]]

before_each(function() watching.begin { ["shot.lua"] = FILM } end)
after_each(watching.finish)

--- What a POST to /render answers, for each of a list of forms.
local FORMS = [=[
  const headers = { Origin: `http://127.0.0.1:${web.port}` };
  const render = async body => (await web.get("/render",
    { method: "POST", headers, body: JSON.stringify(body) })).status;
  const state = async () => JSON.parse((await web.get("/state.json")).body).render;
  const until = async (...wanted) => {
    for (;;) {
      const now = await state();
      if (wanted.includes(now.state)) return now;
      await web.pause(0.05);
    }
  };
  await web.get("/frame/1.png");
]=]

describe("a film of several shots", function()
  it("has shots, objects, and values in the order of the script", function()
    local said = watching.speak(watching.watch(), [=[
      const get = async path => (await web.get(path)).body;
      const film = await get("/film.json"), rows = await get("/sheet.json");
      return { film, rows, tree: await get("/objects.json?frame=3"),
               parameters: JSON.parse(await get("/state.json")).parameters.map(one => one.name),
               curve: await get("/curve.json?name=outBack"),
               none: (await web.get("/curve.json?name=x")).status };]=])
    local shots = json.decode(said.film).shots
    assert.same({ name = "evening", from = 1, to = 48, before = 0, after = 12, into = "" },
      shots[1])
    assert.same({ name = "night", from = 37, to = 84, before = 12, after = 0, into = "dissolve" },
      shots[2])
    local names = {}
    for i, row in ipairs(json.decode(said.rows).rows) do names[i] = row.name end
    assert.same({ "evening / disc", "evening / sun", "evening / ground", "night / disc",
                  "night / sun", "night / ground" }, names)
    local tree = {}
    for i, one in ipairs(json.decode(said.tree)) do
      tree[i] = ("%d %s %s %s"):format(one.depth, one.kind, one.name, one.line)
    end
    assert.same({ "0 cel sun 11", "1 object disc 11", "0 cel ground 10" }, tree)
    assert.same({ "word", "sun", "how", "level", "dim" }, said.parameters)
    local curve = json.decode(said.curve)
    assert.equal(49, #curve)
    for i, value in ipairs(curve) do
      local along = (i - 1) / 48 - 1 -- the ease by its own formula, from its end
      assert.near(1 + 2.70158 * along ^ 3 + 1.70158 * along ^ 2, value, 1e-9, i)
    end
    assert.equal(404, said.none)
  end)

  it("has no shots where it is no cut", function()
    watching.bench:write("shot.lua", SLOW)
    local said = watching.speak(watching.watch(), [=[
      return (await web.get("/film.json")).body;]=])
    assert.is_nil(json.decode(said).shots)
  end)
end)

describe("a render from the page", function()
  it("writes beside the script, asks before it replaces, and says what fails", function()
    local said = watching.speak(watching.watch(), FORMS .. [=[
      const still = { format: "png", file: "out.png", frames: "5", size: "32x18" };
      const first = await render(still), done = await until("done", "failed");
      const again = await render(still), replaced = await render({ ...still, replace: true });
      await until("done");
      const all = await render({ format: "png", file: "all.##.png", frames: "1-3", draft: true });
      await until("done");
      return { first, done, again, replaced, all };]=])
    assert.equal(200, said.first)
    assert.same({ state = "done", file = "out.png", number = 1 }, said.done)
    assert.same({ 409, 200, 200 }, { said.again, said.replaced, said.all })
    watching.bench:celspan_inside "render shot.lua -o same.png --frames 5 --size 32x18"
    assert.equal(watching.bench:read "same.png", watching.bench:read "out.png")
    for i = 1, 3 do assert.truthy(watching.bench:read(("all.%02d.png"):format(i))) end
    assert.is_nil(watching.bench:read "all.04.png")
  end)

  it("has a command with the options and arguments of the run", function()
    watching.bench:write("a.json", '{ "level": 3 }')
    local words = "--set dim=true --set-from a.json --trust --workers 1 --size 32x18 shot.lua"
    local said = watching.speak(watching.watch(words .. " -- one 'a b'"), [=[
      await web.get("/frame/1.png");
      return JSON.parse((await web.get("/state.json")).body);]=])
    assert.same({ "--trust", "--workers", "1" }, said.options)
    assert.same({ "one", "a b" }, said.arguments)
    assert.equal("true", said.parameters[5].value)
  end)

  it("refuses files outside of the folder, options in names, and what the film is not", function()
    watching.bench:inside "mkdir in && ln -s /tmp away"
    local said = watching.speak(watching.watch(), FORMS .. [=[
      const one = { format: "png", file: "a.png", frames: "1" }, found = {};
      const bad = { up: "../a.png", deep: "in/../../a.png", root: "/tmp/a.png", away: "away/a.png",
        option: "--trust.png", inner: "in/-o.png", dot: ".a.png", none: "", other: "a.lua",
        script: "shot.lua", zero: "a\u0000.png", line: "a\n.png", absent: "no/a.png",
        percent: "%s.png", back: "..\\a.png", long: "a".repeat(300) + ".png" };
      for (const [name, file] of Object.entries(bad)) found[name] = await render({ ...one, file });
      for (const [name, more] of Object.entries({ format: { format: "sh" }, size: { size: "9" },
          large: { size: "99999x9" }, frames: { frames: "1 --trust" }, late: { frames: "85" },
          table: { file: {} }, many: { frames: "1-9" } })) {
        found[name] = await render({ ...one, ...more });
      }
      found.stranger = (await web.get("/render", { method: "POST", body: JSON.stringify(one),
        headers: { Origin: "http://evil.example" } })).status;
      found.get = (await web.get("/render")).status;
      return { found, state: (await state()).state,
               good: await render({ ...one, file: "in/a.png" }) };]=])
    for name, status in pairs(said.found) do
      assert.equal(name == "stranger" and 403 or name == "get" and 404 or 400, status, name)
    end
    assert.equal("idle", said.state)
    assert.equal(200, said.good)
  end)

  it("does not follow a link that is a file's name", function()
    local kept = os.tmpname()
    watching.bench:inside(("echo kept >%s && ln -s %s link.png"):format(kept, kept))
    local said = watching.speak(watching.watch(), FORMS .. [=[
      const status = await render({ format: "png", file: "link.png", frames: "1" });
      return { status };]=])
    assert.equal(400, said.status)
    assert.equal("kept\n", watching.bench:read(kept))
    os.remove(kept)
  end)

  it("leaves nothing when it is cancelled or fails", function()
    watching.bench:write("shot.lua", SLOW)
    local address = watching.watch()
    local said = watching.speak(address, FORMS .. [=[
      await render({ format: "png", file: "x.######.png" });
      for (let now = await state(); !(now.done > 20); now = await state()) await web.pause(0.02);
      const busy = await render({ format: "png", file: "y.png", frames: "1" });
      await render({ cancel: true });
      return { busy, last: await until("cancelled") };]=])
    assert.equal(409, said.busy)
    assert.equal("cancelled", said.last.state)
    local _, out = watching.bench:inside "ls"
    assert.falsy(out:find "png", out)
    watching.bench:write("shot.lua", (SLOW:gsub("return celspan.rostrum", 'if f.number == 3 then '
      .. 'error "no paint" end %0')))
    said = watching.speak(address, FORMS .. [=[
      for (let is; !(is?.build > 1 && is.shown); await web.pause(0.02)) {
        is = JSON.parse((await web.get("/state.json")).body);
      }
      await render({ format: "png", file: "x.######.png", frames: "1-9" });
      return await until("failed", "done");]=])
    assert.equal("failed", said.state)
    assert.truthy(said.message:find("no paint", 1, true), said.message)
    _, out = watching.bench:inside "ls"
    assert.falsy(out:find "png", out)
  end)
end)

describe("the page of celspan watch as a studio #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  it("is small, and speaks to nobody else", function()
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const names = page.requests.map(url => new URL(url)).filter(url => /[.](js|css)$/
        .test(url.pathname)).map(url => url.href);
      let bytes = 0;
      for (const name of new Set(names)) {
        bytes += Number(await page.get(`fetch("${name}").then(one => one.text())
          .then(text => new TextEncoder().encode(text).length)`));
      }
      return { bytes, count: new Set(names).size,
               asked: page.requests.filter(url => url.endsWith("/state.json?since=0")).length,
               foreign: page.requests.filter(url => !url.startsWith("http://127.0.0.1:")) };]=])
    assert.is_true(said.bytes <= 122880, said.bytes)
    assert.equal(2, said.count) -- all modules are one script
    assert.equal(1, said.asked)
    assert.same({}, said.foreign)
  end)

  it("has a timeline: shots, marks, timecodes, and keys between them", function()
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const shots = await page.get(`[...document.querySelectorAll("[data-shot]")].map(one =>
        [one.dataset.shot, one.dataset.from, one.dataset.to].join(" "))`);
      const marks = await page.get(`[...document.querySelectorAll("[data-mark]")].map(one =>
        one.dataset.mark + " " + one.dataset.frame)`);
      const joins = await page.get(`[...document.querySelectorAll("[data-transition]")].map(one =>
        one.dataset.transition + " " + one.textContent)`);
      const seen = [];
      for (const key of ["]", "]", "["]) {
        await page.press(key);
        seen.push(await page.get(`document.querySelector("#frame").textContent + " "
          + document.querySelector("#timecode").textContent`));
      }
      await page.press("g");
      await page.get(`document.querySelector("#number").value = "2:12"`);
      await page.press("Enter");
      await page.until(`${canvas("frame")} === "61"`);
      await page.press("s");
      const folds = `[...document.querySelectorAll("#names [aria-expanded]")]`;
      await page.until(`${folds}.length === 3`);
      const opened = await page.get(`${folds}.map(one => one.getAttribute("aria-expanded"))`);
      const rows = await page.get(`[...document.querySelectorAll("[data-row]")]
        .map(one => one.dataset.row)`);
      return { shots, marks, joins, seen, opened, rows };]=])
    assert.same({ "evening 1 48", "night 37 84" }, said.shots)
    assert.same({ "bell 40" }, said.marks)
    assert.same({ "dissolve dissolve" }, said.joins)
    assert.same({ "37 1:12", "40 1:15", "37 1:12" }, said.seen)
    assert.same({ "false", "true", "true" }, said.opened)
    assert.same({ "evening", "night", "night / sun", "night / disc", "night / ground" }, said.rows)
  end)

  it("has objects, values with handles, and a form that renders", function()
    local said = watching.see(watching.watch "--strict shot.lua -- 'a b'", [=[
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      const paths = await page.get(`[...document.querySelectorAll("[data-object]")]
        .map(one => one.dataset.object)`);
      await page.settle();
      const box = await page.get(`(() => { const box = document.querySelector("#canvas")
        .getBoundingClientRect(); return [box.left + box.width * 24 / 64, box.top + box.height / 2];
      })()`);
      await page.mouse("mouseMoved", ...box);
      await page.until(`document.querySelector("#under").textContent === "disc"`);
      const [x, y] = await page.get(`(box => [box.left, box.top])(
        document.querySelector("#under").getBoundingClientRect())`);
      const isBeside = Math.abs(x - box[0]) < 30 && Math.abs(y - box[1]) < 30;
      await page.press("v");
      const names = await page.get(`[...document.querySelectorAll("#values #form [name]")]
        .map(one => one.name)`);
      const group = await page.get(`document.querySelector("#form fieldset").textContent`);
      const old = await page.get(canvas("build"));
      const isStale = await page.get(`(sun => {
        sun.focus();
        sun.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
        return "stale" in document.querySelector("#canvas").dataset;
      })(document.querySelector("[data-point=sun]"))`);
      await page.until(`${canvas("build")} !== "${old}"`);
      await page.until(`!("stale" in document.querySelector("#canvas").dataset)`);
      const command = await page.get(`document.querySelector("#command").value`);
      await page.get(`document.querySelector("#render").click()`);
      await page.get(`(() => { const { elements } = document.querySelector("#render-form");
        elements.format.value = "png"; elements.range.value = "frame";
        elements.range.dispatchEvent(new Event("input", { bubbles: true })); })()`);
      const file = await page.get(`document.querySelector("#render-form").elements.file.value`);
      const state = await page.get(`document.querySelector("#render-state").dataset.state`);
      const line = await page.get(`document.querySelector("#render-command").value`);
      await page.get(`document.querySelector("#render-start").click()`);
      await page.until(`document.querySelector("#render-state").dataset.state === "done"`);
      return { paths, isBeside, names, group, isStale, command, file, state, line };]=])
    assert.same({ "evening/sun", "evening/sun/disc", "evening/ground" }, said.paths)
    assert.same({ "word", "sun", "how", "level", "dim" }, said.names)
    assert.truthy(said.group:find("Light.*sun.*its place.*how"))
    assert.is_true(said.isStale and said.isBeside)
    assert.equal("celspan render shot.lua --strict --set sun=21,18 -o shot.mp4 -- 'a b'",
      said.command)
    assert.same({ "shot.0001.png", "idle" }, { said.file, said.state })
    assert.equal("celspan render shot.lua --strict --set sun=21,18 --frames 1 -o shot.0001.png "
      .. "-- 'a b'",
      said.line)
    assert.truthy(watching.bench:read "shot.0001.png")
  end)
end)
