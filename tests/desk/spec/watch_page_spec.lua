-- celspan watch: its page under hands: keys, focus, questions, and what is late.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end

-- Two shots, each with a cel that has no name.
local CUT = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function shot(colour)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function(f)
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 64, 36, texture = colour } },
      celspan.cel { celspan.circle { centre = { f.index, 9 }, radius = 4, texture = "#fd0" } }
        :named "sun" } end }
end
return cut { { film = shot "#036", name = "evening" }, { film = shot "#630", name = "night" } }
]]

-- A shot with a cel that has two parts.
local PARTS = [[
local celspan = require "celspan"
local function box(x) return celspan.rect { x, 0, 8, 8, texture = "#fff" } end
local shot = celspan.film { size = { 64, 36 }, frames = 4, frame = function()
  return celspan.rostrum { celspan.cel { box(0):named "near", box(9):named "far" }:named "hills" }
end }
return require "celspan.cut" { { film = shot, name = "evening" } }
]]

-- A ball that moves and a cel without a name, and values of several kinds.
local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { constructor = { 3, min = 0, max = 9 }, length = "short",
  at = { 20, 18, point = true }, dim = true }
for i = 1, SPIN do end
return celspan.film { size = { 64, 36 }, fps = 24, frames = 400, marks = { MARKS },
  frame = function(f)
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#fff" } },
      celspan.cel { celspan.rect { 8 * f.index, 0, 8, 36, texture = "#00f" } }:named "__proto__",
      celspan.cel { celspan.rect { 0, 8 * f.index, 4, 4, texture = "#0f0" } }:named "dot" }
  end }
]]

local function film(marks, spin)
  return (FILM:gsub("MARKS", marks or "one = 40, two = 43, far = 300")
    :gsub("SPIN", tostring(spin or 0)))
end

-- A sky with a glow in it, and three cels that one line makes; the first is an area with a stroke.
local GLOW = [[
local celspan = require "celspan"
local cel = celspan.cel
local function box(x) return celspan.rect { x, 2, 8, 8, texture = "#3b5578" } end
local far = box(40):named "wing"
local sun = celspan.circle { centre = { 32, 26 }, radius = 4, texture = "#fd0" }
local wing = celspan.group { celspan.group { box(4),
  celspan.stroke { d = "M 4 2 h 8", width = 2, texture = "#fff" } } }
return celspan.film { size = { 64, 36 }, frames = 4, frame = function(f)
  return celspan.rostrum { front = { 1, 0.5, 0.5 },
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#048" },
      sun:glow { radius = 1 + f.index, colour = "#fd0" } }:named "sky",
    cel { wing:named "wing" }:named "near", cel { far }:named "far", cel { box(52) } }
end }
]]

--- Steps in the page, with helpers. `text` of an element, by its selector, is `$(selector)`.
local function see(steps, script)
  watching.bench:write("shot.lua", script or film())
  return watching.see(watching.watch(), [=[
    const all = (selector, what) => page.get(
      `[...document.querySelectorAll(${JSON.stringify(selector)})].map(one => ${what})`);
    const of = async (selector, what) => (await all(selector, what))[0];
    const set = (selector, code) => page.get(`(one => { ${code} })(document.querySelector(
      ${JSON.stringify(selector)}))`);
    const click = async selector => {
      const [x, y] = await of(selector, `(box => [box.x + box.width / 2, box.y + box.height / 2])(
        one.getBoundingClientRect())`);
      await page.click(x, y);
    };
    const colour = (x, y) => page.get(`(canvas => [...canvas.getContext("2d").getImageData(
      canvas.width * ${x} / 64, canvas.height * ${y} / 36, 1, 1).data].slice(0, 3))(
      document.querySelector("#canvas"))`);
    const turns = async (from, x, y) => {
      for (let i = 0; i < 100 && (await colour(x, y)).join() === from.join(); i++) {
        await page.pause(0.05);
      }
      return colour(x, y);
    };
    const stub = code => page.get(`(() => { const real = window.fetch, seen = window.seen = {};
      const json = (value, status = 200) => new Response(JSON.stringify(value), { status });
      window.fetch = async (address, more) => { ${code}; return real(address, more); }; })()`);
    await page.until(`${canvas("frame")} === "1"`);]=] .. steps)
end

before_each(function() watching.begin {} end)
after_each(watching.finish)

describe("the page of celspan watch under hands #plain", function()
  it("has as many names as rows, also after the frame has left the shot", function()
    local said = see([=[
      await page.press("s");
      await page.until(`document.querySelectorAll("[data-row]").length === 4`);
      await page.press("End");
      await page.until(`${canvas("frame")} === "48"`);
      const rows = await all("[data-row]", "one.dataset.row");
      return { rows, height: await of("#cells", "one.style.height") };]=], CUT)
    assert.same({ "evening", "evening / sun", "evening / cel 1", "night" }, said.rows)
    assert.equal("88px", said.height)
  end)

  it("names inner cels and outlines by their owners, and outlines what a row names", function()
    local said = see([=[
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 7`);
      const tree = await all("[data-object]", `one.style.getPropertyValue("--depth") + " "
        + one.textContent`);
      await page.settle();
      const outlined = async path => {
        await page.mouse("mouseMoved", ...await of(`[data-object='${path}'] .name`,
          `(box => [box.x + 5, box.y + 5])(one.getBoundingClientRect())`));
        await page.until(`!document.querySelector("#overlay").hidden && decodeURIComponent(document
          .querySelector("#overlay").dataset.over).endsWith("cel=${path.split("/")[0]}")`);
        return page.get(`(one => { const { data } = one.getContext("2d").getImageData(0, 0,
          one.width, one.height); const at = data.map((_, i) => i % 4 === 3 && data[i] ? 1 : 0);
          const seen = [...at.keys()].filter(i => at[i]).map(i => (i >> 2) % one.width / one.width);
          return [Math.min(...seen), Math.max(...seen)].map(x => Math.round(64 * x)); })(
            document.querySelector("#overlay"))`);
      };
      const lines = [await outlined("near"), await outlined("far/wing"), await outlined("cel 4")];
      await page.press("s");
      await page.until(`document.querySelectorAll("[data-row]").length > 3`);
      const rows = await all("[data-row]", "one.dataset.row");
      await page.press("p");
      await page.settle();
      const spot = await of("#canvas", `(box => [box.x + box.width * 8 / 64,
        box.y + box.height * 6 / 36])(one.getBoundingClientRect())`);
      await page.click(...spot);
      await page.until(`document.querySelectorAll("#hits li").length > 2`);
      return { tree, lines, rows, hits: await all("#hits li",
        `[...one.childNodes].filter(part => part.localName !== "p").map(part => part.textContent)
          .join("").trim()`), chip: await of("#hits .chip", "one.style.backgroundColor") };]=],
      GLOW)
    assert.same({ "0 cel 4", "0 far", "1 wing", "0 near", "1 wing", "0 sky", "1 sky" }, said.tree)
    assert.same({ { 4, 12 }, { 40, 48 }, { 52, 60 } }, said.lines)
    assert.same({ "cel 4", "far", "wing", "near", "sky" }, said.rows)
    assert.same({ "wing, fill paint #3b5578", "wing (object) paint #3b5578",
                  "near (cel) light 1, 0.5, 0.5", "sky, fill paint #004488",
                  "sky (cel) light 1, 0.5, 0.5" }, said.hits)
    assert.equal("rgb(59, 85, 120)", said.chip)
  end)

  it("draws a sheet of many rows where it is scrolled to", function()
    local said = see [=[
      await stub(`if (address.startsWith("/sheet.json")) return json({ frames: 400,
        rows: Array.from({ length: 1500 }, (_, i) =>
          ({ name: "cel " + i, cells: [[1, "1"]] })) })`);
      await page.press("s");
      await page.until(`document.querySelectorAll("[data-row]").length === 1500`);
      const found = await of("#rows", `one.height <= innerHeight`);
      await set("#timeline", "one.scrollTop = 20000");
      await page.until(`parseFloat(document.querySelector("#rows").style.top) > 19000`);
      const drawn = await page.get(`document.querySelector("#rows").getContext("2d")
        .getImageData(4, 0, 1, 99).data.filter((one, i) => i % 4 === 3 && one).length`);
      return { found, drawn: drawn > 50 };]=]
    assert.same({ found = true, drawn = true }, said)
  end)

  it("asks before it replaces a file, and keeps the question and the name", function()
    local said = see([=[
      await stub(`if (address === "/render") return seen.wish = JSON.parse(more.body), seen.busy
        ? new Response("a render is running", { status: 409 })
        : seen.wish.replace ? json({}) : json({ exists: true, message: "it is there" }, 409)`);
      await click("#render");
      await set("#render-form", `one.elements.file.value = "mine.mp4"; const say = (name, kind) =>
        one.elements[name].dispatchEvent(new Event(kind, { bubbles: true })); say("file", "input");
        one.elements.format.value = "png"; say("format", "input"); say("format", "change");`);
      const file = await of("#render-form [name=file]", "one.value");
      await click("#render-start");
      await page.until(`document.querySelector("#render-state").dataset.state === "asking"`);
      page.write("]=] .. watching.bench.folder .. [=[/shot.lua", ]=]
      .. ("%q"):format(film "new = 7"):gsub("\\\n", "\\n") .. [=[);
      await page.until(`document.querySelector("[data-mark=new]")`);
      const kept = await of("#render-state", "one.dataset.state");
      await click("#render-start");
      await page.until("seen.wish.replace");
      await page.get("seen.busy = 1");
      await click("#render-start");
      await page.until(`document.querySelector("#render-state").dataset.state === "failed"`);
      const words = await of("#render-words", "one.textContent");
      await page.press("Escape");
      return { file, kept, words, replace: await page.get("seen.wish.replace"),
               focus: await page.get("document.activeElement.id") };]=])
    assert.same({ file = "mine.####.png", kept = "asking", words = "a render is running",
                  replace = false, focus = "render" }, said)
  end)

  it("asks busy renderers again, and says that it reads", function()
    local said = see [=[
      await stub(`if (/objects|sheet|wave|at[/]/.test(address)) { const kind = address.slice(1, 3);
        seen[kind] = (seen[kind] ?? 0) + 1; if (seen[kind] < 3) return json({}, 503); }`);
      await page.press("s");
      await page.press("q");
      const isBusy = await of("#objects", "one.ariaBusy");
      const hint = await of("#objects-hint", "one.hidden");
      const words = await of("#objects h2", `getComputedStyle(one, "::after").content`);
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      await page.until(`document.querySelectorAll("[data-row]").length === 3`);
      await page.until(`document.querySelector("#timeline").ariaBusy === "false"`);
      await page.press("p");
      await click("#canvas");
      await page.until(`document.querySelectorAll("#hits li").length > 0`);
      return { isBusy, hint, words };]=]
    assert.same({ isBusy = "true", hint = true, words = '"reading …"' }, said)
  end)

  it("shows every cel in another way, also one without a name, and keeps the focus", function()
    local said = see [=[
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      await set('[aria-label="Hide: cel 1"]', "one.focus({ focusVisible: true })");
      await page.press("Enter");
      const hidden = await turns([255, 255, 255], 50, 30);
      const focus = await page.get("document.activeElement.ariaLabel");
      await page.press("Enter");
      const shown = await turns(hidden, 50, 30), blue = await colour(4, 30);
      await click('[aria-label="Hide: __proto__"]');
      const gone = await turns(blue, 4, 30);
      const before = await page.get(`document.querySelector("#frame").textContent`);
      await page.press(" ");
      await page.until(`document.querySelector("#frame").textContent !== "${before}"`);
      return { hidden, focus, shown, blue, gone };]=]
    assert.same({ hidden = { 0, 0, 0 }, focus = "Hide: cel 1", shown = { 255, 255, 255 },
                  blue = { 0, 0, 255 }, gone = { 255, 255, 255 } }, said)
  end)

  it("shows neighbours of chosen cels, behind them", function()
    local said = see [=[
      await page.press("ArrowRight"); await page.press("ArrowRight");
      await page.until(`${canvas("frame")} === "3"`);
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      const plain = await colour(12, 30);
      await click('[aria-label="Onion: __proto__"]');
      const before = await turns(plain, 12, 30);
      return { plain, before, after: await colour(28, 30), own: await colour(20, 30),
               dot: await colour(2, 10), pressed: await of("#onion", "one.ariaPressed") };]=]
    assert.same({ 255, 255, 255 }, said.plain)
    assert.is_true(said.before[1] > said.before[2] and said.after[2] > said.after[1])
    assert.same({ { 0, 0, 255 }, { 255, 255, 255 }, "true" }, { said.own, said.dot, said.pressed })
  end)

  it("folds the parts of a cel in the tree and in the sheet together, and shots", function()
    local said = see([=[
      await page.press("q"); await page.press("s");
      const count = async () => [await all("[data-object]", 1), await all("[data-row]", 1)]
        .map(list => list.length).join();
      await page.until(`document.querySelectorAll("[data-row]").length === 4`);
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      const seen = [];
      for (const row of ['object="evening/hills"', 'row="evening / hills"', 'head="evening"']) {
        await click(`[data-${row}] .fold`);
        seen.push(await count());
      }
      return seen;]=], PARTS)
    assert.same({ "1,2", "3,4", "0,4" }, said)
  end)

  it("takes a film when it is ready, and not only when it was saved", function()
    local tall = film("late = 9", 3e8):gsub("{ 64, 36 }", "{ 36, 64 }")
    local said = see([=[
      page.write("]=] .. watching.bench.folder .. [=[/shot.lua", ]=]
      .. ("%q"):format(tall):gsub("\\\n", "\\n") .. [=[);
      await page.until(`document.querySelector("[data-mark=late]")`);
      await page.until(`document.querySelector("#canvas").width
        < document.querySelector("#canvas").height`);
      return all("[data-mark]", "one.dataset.mark");]=])
    assert.same({ "late" }, said)
  end)

  it("leaves keys to fields, and leaves a dialog by Escape", function()
    local said = see [=[
      await page.press("v");
      await set("#form [name=constructor]", "one.focus()");
      await page.press("Home");
      await page.until(`document.querySelector("#command").value.includes("constructor=0")`);
      await set("#form [name=dim]", "one.focus({ focusVisible: true })");
      await page.press(" ");
      const isDim = await of("#form [name=dim]", "one.checked");
      const label = await of("#play", "one.ariaLabel");
      await page.press("Escape");
      await page.press("g");
      await set("#number", `one.value = "5"`);
      await page.press("Enter");
      await page.until(`${canvas("frame")} === "5"`);
      await page.press("g");
      await set("#number", `one.value = "9"`);
      await page.call("Input.dispatchKeyEvent", { type: "keyDown", key: "Escape", code: "Escape",
        windowsVirtualKeyCode: 27 });
      await page.until(`!document.querySelector("dialog[open]")`);
      await page.pause(0.2);
      await page.get(`document.querySelector("#desk").scrollTop = 50`);
      return { isDim, label, frame: await of("#frame", "one.textContent"),
               scrolled: await of("#desk", "one.scrollTop") };]=]
    assert.same({ isDim = false, label = "Play", frame = "5", scrolled = 0 }, said)
  end)

  it("gives the values of a file, says what is odd in it, and gives the first again", function()
    local said = see [=[
      await page.press("v");
      const load = text => set("#load-values", `const all = new DataTransfer();
        all.items.add(new File([${JSON.stringify(text)}], "a.json")); one.files = all.files;
        one.dispatchEvent(new Event("change"));`);
      await load(`{ "constructor": 5, "length": { "x": 1 }, "at": [4, 5], "__proto__": 1 }`);
      await page.until(`document.querySelector("#form [name=at]").value === "4,5"`);
      const words = await of("#values-said", "one.textContent");
      const loaded = await all("#form [name]", "one.value");
      await click("#reset-values");
      await page.until(`document.querySelector("#form [name=at]").value === "20,18"`);
      const reset = await all("#form [name]", "one.value");
      await set("[data-point=at]", "one.focus()");
      await page.press("ArrowRight");
      return { words, loaded, reset, moved: await of("#form [name=at]", "one.value") };]=]
    assert.same({ "5", "short", "4,5", "on" }, said.loaded)
    assert.same({ "3", "short", "20,18", "on" }, said.reset)
    assert.equal("a.json: the film has no __proto__. a.json: length cannot be that. ", said.words)
    assert.equal("21,18", said.moved)
  end)

  it("snaps to the nearest mark, shows captions, and has few blocks in few pixels", function()
    local said = see([=[
      const box = await of("#ruler", `(box => [box.x, box.y + 9, box.width / 400])(
        one.getBoundingClientRect())`);
      const drag = async at => {
        const x = box[0] + box[2] * (at - 0.5);
        await page.mouse("mousePressed", x, box[1], { button: "left", buttons: 1, clickCount: 1 });
        await page.mouse("mouseReleased", x, box[1], { button: "left" });
        return of("#frame", "one.textContent");
      };
      const seen = [await drag(42), await drag(41), await drag(100)];
      await stub(`if (address.startsWith("/state.json")) { const said = await (await real(address,
        more)).json(); said.film.captions = [{ from: 10, to: 30, text: "<b>Hello" }];
        return json(said); }`);
      page.write("]=] .. watching.bench.folder .. [=[/shot.lua", ]=]
      .. ("%q"):format(film "new = 7"):gsub("\\\n", "\\n") .. [=[);
      await page.until(`document.querySelector("[data-mark=new]")`);
      const captions = await all("#captions button", "one.textContent + one.dataset.from");
      for (let i = 0; i < 9; i++) {
        await page.mouse("mouseWheel", box[0], box[1], { deltaX: 0, deltaY: -400 });
      }
      await page.until(`document.querySelectorAll("[data-mark], #captions button").length === 0`);
      return { seen, captions };]=])
    assert.same({ seen = { "43", "40", "100" }, captions = { "<b>Hello10" } }, said)
  end)

  it("asks one question about the pointer at a time", function()
    local said = see [=[
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 3`);
      await stub(`if (address.startsWith("/at/")) { seen.now = (seen.now ?? 0) + 1;
        seen.most = Math.max(seen.most ?? 0, seen.now); seen.count = (seen.count ?? 0) + 1;
        await new Promise(done => setTimeout(done, 300)); seen.now--; }`);
      const [x, y] = await of("#canvas",
        `(box => [box.x + 99, box.y + 99])(one.getBoundingClientRect())`);
      for (let i = 0; i < 8; i++) {
        await page.mouse("mouseMoved", x + 4 * i, y);
        await page.pause(0.1);
      }
      await page.until("seen.count > 1 && seen.now === 0");
      return { most: await page.get("seen.most") };]=]
    assert.same({ most = 1 }, said)
  end)

  it("has the sheet of the second film below that of the first", function()
    watching.bench:write("other.lua", [[
      local celspan = require "celspan"
      return celspan.film { size = { 8, 8 }, fps = 12, frames = 20, frame = function()
        return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 8, 8 } }:named "late" } end }]])
    watching.bench:write("shot.lua", film())
    local said = watching.see(watching.watch "shot.lua other.lua", [=[
      await page.until(`document.querySelector("#canvas2").dataset.frame === "1"`);
      await page.press("s");
      await page.until(`document.querySelectorAll("[data-row]").length === 5`);
      return page.get(`[...document.querySelectorAll("[data-row]")]
        .map(one => one.dataset.row)`);]=])
    assert.same({ "dot", "__proto__", "cel 1", "other.lua", "late" }, said)
  end)

  it("plays by the space key after clicks, and leaves the form of a render by Escape", function()
    local said = see [=[
      const plays = async () => {
        await page.press(" ");
        const label = await of("#play", "one.ariaLabel");
        await page.press("Home");
        return [label, await of("#view", "one.ariaExpanded")].join();
      };
      const seen = [];
      await click("#view"); await page.press("Escape");
      seen.push(await plays());
      await click("[data-mark=far]");
      seen.push(await plays());
      await click("#first");
      seen.push(await plays());
      await click("#render");
      await set("#render-form [name=format]", "one.focus()");
      await page.press("Escape");
      const form = await page.get(`[document.activeElement.id,
        document.querySelector("#render-form").hidden].join()`);
      await set("#view", "one.focus()");
      await page.press("Tab");
      const tabbed = await plays();
      return { seen, form, tabbed };]=]
    assert.same({ "Pause,false", "Pause,false", "Pause,false" }, said.seen)
    assert.equal("render,true", said.form)
    assert.equal("Play,false", said.tabbed)
  end)

  it("drags a point within the film on a grid, and gives values before by ctrl-z", function()
    local said = see [=[
      const place = (x, y) => of("#canvas", `(box => [box.x + box.width * ${x} / 64,
        box.y + box.height * ${y} / 36])(one.getBoundingClientRect())`);
      const value = () => of("#form [name=at]", "one.value");
      const drag = async (x, y, modifiers = 0) => {
        const from = await of("[data-point=at]", `(box => [box.x + box.width / 2,
          box.y + box.height / 2])(one.getBoundingClientRect())`);
        const press = { button: "left", buttons: 1, clickCount: 1, modifiers };
        await page.mouse("mousePressed", ...from, press);
        await page.mouse("mouseMoved", ...await place(x, y), press);
        await page.mouse("mouseReleased", ...await place(x, y), { button: "left" });
        return value();
      };
      const inside = await drag(30.2, 9.8), free = await drag(31.37, 9.8, 8);
      const beyond = await drag(64.4, 40);
      await set("[data-point=at]", "one.focus()");
      await page.press("ArrowLeft");
      const moved = await value();
      for (const wanted of [beyond, free, inside, "20,18"]) {
        await page.press("z", 2);
        await page.until(`document.querySelector("#form [name=at]").value === "${wanted}"`);
      }
      return { inside, free, beyond, moved };]=]
    assert.equal("64,36", said.beyond)
    assert.truthy(said.inside:find "^30%.2,9%.8$", said.inside)
    assert.truthy(said.free:find "^31%.3%d,9%.%d+$", said.free)
    assert.equal("63,36", said.moved)
  end)

  it("gives values before again after one was given back, and after a reset", function()
    local said = see [=[
      const field = "#form [name=at]", values = () => all("#form [name]", "one.value");
      const give = text => set(field, `one.value = "${text}";
        one.dispatchEvent(new Event("change"))`);
      const until = text => page.until(`document.querySelector(${JSON.stringify(field)}).value
        === "${text}"`);
      const undo = async text => { await page.press("z", 2); await until(text); };
      await page.press("v");
      await give("10,10");
      await page.press("1"); // another change begins with another key
      await give("11,10");
      await set("#form .back:not([hidden])", "one.click()");
      await until("20,18");
      await undo("11,10");
      await set("#reset-values", "one.click()");
      await until("20,18");
      await undo("11,10");
      await undo("10,10");
      await undo("20,18");
      return values();]=]
    assert.same({ "3", "short", "20,18", "on" }, said)
  end)

  it("takes back what changed something, and finds no fault in names of objects", function()
    local said = see [=[
      const field = "#form [name=at]";
      const give = text => set(field, `one.value = "${text}";
        one.dispatchEvent(new Event("change"))`);
      const until = text => page.until(`location.hash === "${text}"`);
      await page.press("v");
      await give("10,10");
      await until("#at=10%2C10");
      for (const key of ["1", "2", "3"]) { await page.press(key); await give("10,10"); }
      await page.press("z", 2);
      await page.until(`document.querySelector("${field}").value === "20,18"`);
      return all("#form .wrong:not([hidden])", "one.textContent");]=]
    assert.same({}, said)
  end)

  it("gives values also after the script has lost the parameter of one", function()
    local fewer = film():gsub("constructor = %b{}, ", "")
    local said = see([=[
      const give = (name, text) => set(`#form [name=${name}]`, `one.value = "${text}";
        one.dispatchEvent(new Event(one.type === "range" ? "input" : "change"))`);
      const until = hash => page.until(`location.hash === "${hash}" && ${canvas("build")} > 1
        && !document.querySelector("#canvas").hasAttribute("data-stale")`);
      await give("constructor", 5);
      await until("#constructor=5");
      page.write("]=] .. watching.bench.folder .. [=[/shot.lua", ]=] .. ("%q"):format(fewer)
        :gsub("\\\n", "\\n") .. [=[);
      await page.until(`!document.querySelector("#form [name=constructor]")`);
      await give("at", "4,5");
      await until("#at=4%2C5");
      return of("#form [name=at]", "one.value");]=])
    assert.equal("4,5", said)
  end)

  it("marks the point that is inspected, and has one playhead over all rows", function()
    local said = see [=[
      await page.press("s"); await page.press("p");
      await page.until(`document.querySelectorAll("[data-row]").length === 3`);
      await page.settle();
      const at = await of("#canvas", `(box => [box.x + box.width / 4, box.y + box.height / 4])(
        one.getBoundingClientRect())`);
      const middle = `(box => [box.x + box.width / 2, box.y + box.height / 2])(
        one.getBoundingClientRect())`;
      await page.click(...at);
      await page.until(`!document.querySelector("#spot").hidden`);
      const spot = await of("#spot", middle);
      await page.press("]");
      await page.until(`${canvas("frame")} === "40"`);
      const heads = await all(".head", "one.getBoundingClientRect().x");
      const ruler = await of("#ruler", `(box => box.x + box.width * 39 / 400)(
        one.getBoundingClientRect())`);
      const play = await of("#play", "one.getBoundingClientRect().x");
      await page.press("End");
      await page.until(`${canvas("frame")} === "400"`);
      const moved = await of("#play", "one.getBoundingClientRect().x") - play;
      await page.press("p");
      return { off: Math.hypot(spot[0] - at[0], spot[1] - at[1]), count: heads.length, moved,
               far: Math.max(...heads.map(one => Math.abs(one - ruler))),
               gone: await of("#spot", "one.hidden") };]=]
    assert.is_true(said.off < 2, said.off)
    assert.is_true(said.far < 2, said.far)
    assert.same({ 2, 0, true }, { said.count, said.moved, said.gone })
  end)
end)
