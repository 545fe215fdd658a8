-- The element <celspan-film>, which celspan plane -o celspan-film.js writes, in pages of a server.
local browsing = require "tests.support.browsing"
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.pages() then return pending "celspan was built without clang and lld" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end

local AXE = "out/npm/node_modules/axe-core/axe.min.js"

local STILL = [[
local celspan = require "celspan"
return celspan.film { size = { 160, 90 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#204060", celspan.cel {
    celspan.circle { centre = { 80, 45 }, radius = 30, texture = "#f26419" } } }
end }
]]
local MOVING = [[
local celspan = require "celspan"
return celspan.film { size = { 160, 90 }, fps = 25, frames = 50, frame = function(f)
  return celspan.rostrum { back = "#204060", celspan.cel {
    celspan.circle { centre = { 3 * f.number, 45 }, radius = 30.3,
      texture = celspan.linear { from = { 3 * f.number, 15 }, to = { 80, 90 },
        { 0, "#f26419" }, { 1, "#102040" } } } } }
end }
]]

-- What the steps use: the files in the folder, with a policy; and the page of an element.
local HELP = [[
  const POLICY = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; "
    + "img-src 'self'; style-src 'self'";
  const folder = "%s", site = await require("./site.js")(folder);
  site.policy = POLICY;
  const MODULE = '<script type="module" src="celspan-film.js"></script>';
  const CLASSIC = '<script src="celspan-film.js"></script>';
  // Shows elements. Their events are noted before the script of the elements runs.
  async function show(elements, script = MODULE) {
    site.pages["x.html"] = "<!doctype html><html lang=en><title>x</title><main><h1>Films</h1>"
      + elements + "</main><script src='listen.js'></script>" + script;
    site.pages["listen.js"] = `const films = [...document.querySelectorAll("celspan-film")];
      const events = films.map(() => []), film = films[0];
      for (const name of ["loadeddata", "play", "pause", "timeupdate", "ended", "error"])
        films.forEach((one, i) => one.addEventListener(name, event =>
          events[i].push(event.message ? name + ": " + event.message : name)));
      const part = (id, one = film) => one.shadowRoot.getElementById(id);
      const pixel = (x, y, one = film) =>
        part("view", one).getContext("2d").getImageData(x, y, 1, 1).data.join();`;
    await page.load(site.at("x.html"), /^http:/);
  }
  const steps = async () => {
]]

-- A plane of one colour, with more in it.
local FLAT = [[
return film { size = { 160, 90 }, fps = 4, frames = %d, frame = function(f)
  return rostrum { back = f.number == 1 and "%s" or "#ff0000", %s } end }
]]
local TABLE = "x,y,width,height,plane\n"
local DOTS = [[cel((function()
  local dots = {}
  for i = 1, 6000 do dots[i] = circle { (i * 0.618 % 1) * 160, 60 + i % 97 * 0.3, 0.1 } end
  return dots
end)())]]

-- Steps that show NAME.plane, 640 pixels wide, with `middle`, a place three windows deep.
local NESTED = [[
  const place = (at, side, length) => [0, 1].reduce(
    inner => at + side * inner / length, at + side / 2);
  const middle = [place(40, 1.6, 160), place(20, 0.9, 90)];
  const shown = (colour, x, y) => page.until(`pixel(${x}, ${y}) === "${colour}"`);
  const nested = async (name, attributes = "") => {
    await show(`<celspan-film src="${name}.plane" width="640" ${attributes}></celspan-film>`);
    await page.until("events[0].length");
  };
  const deep = () => page.get(`film.zoom(${middle}, 1e6, "instant"), 0`);
]]

local bench

setup(function()
  bench = workbench.new()
  bench:write("still.lua", STILL)
  bench:write("film.lua", MOVING)
  for _, command in ipairs { "render still.lua -o still.plane", "render film.lua -o film.plane",
    "render still.lua -o still.png --size 320x180", "plane -o celspan-film.js" } do
    local code, _, err = bench:celspan_inside(command)
    assert(code == 0, err)
  end
end)
teardown(function() bench:remove() end)

local function made(name, frames, colour, more)
  bench:write(name .. ".lua", FLAT:format(frames, colour, more or ""))
  local code, _, err = bench:celspan_inside("render %s.lua -o %s.plane", name, name)
  assert(code == 0, err)
end

--- Puts planes into the windows of another one: rows of a table.
local function joined(name, outer, rows)
  bench:write("windows.csv", TABLE .. rows)
  local code, _, err = bench:celspan_inside("plane %s.plane --windows windows.csv -o %s.plane",
    outer, name)
  assert(code == 0, err)
end

--- nest.plane: navy with more than 64 KB of dots; in it an orange window, one that is never near,
--- and one of a hundredth, which is green; in that a maroon one, and in that a white one. Returns
--- the bytes of the outer one.
local function nest()
  if bench:read "nest.plane" then return end
  made("navy", 1, "#000080", DOTS)
  made("orange", 2, "#ff8000")
  made("green", 1, "#008000")
  made("maroon", 1, "#800000")
  made("white", 1, "#ffffff")
  joined("third", "maroon", "40,20,1.6,0.9,white.plane\n")
  joined("second", "green", "40,20,1.6,0.9,third.plane\n")
  joined("nest", "navy", "100,5,50,28.125,orange.plane\n10,50,1.6,0.9,maroon.plane\n"
    .. "40,20,1.6,0.9,second.plane\n")
end

--- still_nest.plane: blue, with an orange window that changes four times a second, and a green one.
local function still_nest()
  nest()
  if bench:read "still_nest.plane" then return end
  made("blue", 1, "#0000ff")
  joined("still_nest", "blue", "80,5,50,28.125,orange.plane\n20,20,30,15,green.plane\n")
end

--- The part of nest.plane that is a plane, as it is asked for.
local function part(name)
  local from = bench:read "nest.plane":find(bench:read(name .. ".plane"), 1, true) - 1
  return ("nest.plane bytes=%d-%d"):format(from, from + #bench:read(name .. ".plane") - 1)
end

--- What the steps return, which have the names of HELP.
local function see(steps)
  return browsing.see("about:blank", HELP:gsub("%%s", bench.folder, 1) .. steps .. [[
  };
  try { return await steps(); } finally { site.close(); }]])
end

describe("the element of planes #plain", function()
  it("shows a plane under a strict policy, as a module and as a classic script", function()
    local said = see [=[
      const found = [];
      for (const script of [MODULE, CLASSIC]) {
        await show(`<celspan-film src="still.plane" width="320" aria-label="A disc">
          </celspan-film>`, script);
        await page.until("events[0].length");
        found.push(await page.get(`[events[0].join(), pixel(160, 90), pixel(2, 2),
          film.getBoundingClientRect().height, film.role ?? film.getAttribute("role"),
          part("view").getAttribute("aria-label"), film.duration, film.paused]`));
      }
      return found;]=]
    local one = { "loadeddata", "242,100,25,255", "32,64,96,255", 180, "group", "A disc", 0, true }
    assert.same({ one, one }, said)
  end)

  it("still shows everything where its size changes, or what was asked for at first", function()
    local said = see [=[
      await show(`<celspan-film src="still.plane" width="320"></celspan-film>
        <celspan-film width="320"></celspan-film>`);
      await page.get("films[1].src = 'still.plane', films[1].zoom(60, 45, 4), 0");
      await page.until("events.every(list => list.length)");
      // The pixel is read when the canvas has its new size, before a tile of that size can arrive.
      const shown = await page.get(`new Promise(done => {
        new MutationObserver(() => done(pixel(80, 16))).observe(part("view"), { attributes: true,
          attributeFilter: ["width"] });
        film.width = 160;
      })`);
      await page.until("part('view').width === 160");
      const [one, other] = await page.get("films.map(one => one.view)");
      return [one.factor, one.width, shown, other]; ]=]
    assert.same({ 1, 160, "242,100,25,255", { x = 60, y = 45, width = 40, factor = 4 } }, said)
  end)

  it("shows its contents until then, without a script, and where it fails", function()
    local said = see [=[
      const inside = `<img src="still.png" alt="A disc">`;
      const seen = `[film.querySelector("img")?.checkVisibility(),
        part("poster").checkVisibility()]`;
      const found = [];
      site.delay = 500;
      await show(`<celspan-film src="still.plane" width="320">${inside}</celspan-film>`);
      found.push(await page.get(seen));
      await page.until("events[0].length");
      found.push(await page.get(seen));
      await show(`<celspan-film src="still.plane" poster="still.png"></celspan-film>`);
      found.push(await page.get(seen));
      await page.until("events[0].length");
      found.push(await page.get(seen));
      await show(`<celspan-film src="none.plane" width="320">${inside}</celspan-film>`);
      await page.until("events[0].length");
      found.push(await page.get(seen));
      await show(`<celspan-film src="still.plane">${inside}</celspan-film>`, "");
      found.push(await page.get(`[film.firstChild.checkVisibility(), film.firstChild.width]`));
      return found;]=]
    assert.same({ { true, false }, { false, false }, { json.null, true }, { json.null, false },
                  { true, false }, { true, 320 } }, said)
  end)

  it("shows the frames that celspan draws, to the bit", function()
    local code, _, err = bench:inside(("for i in $(seq 50); do '%s' convert film.plane $i.png "
      .. "--frame $i --size 160x90 || exit; done"):format(workbench.absolute))
    assert.equal(0, code, err)
    local said = see [=[
      await show(`<celspan-film src="film.plane" width="160"></celspan-film>`);
      await page.until("events[0].length");
      return page.get(`(async () => {
        const digest = async pencil => {
          const { data } = pencil.getImageData(0, 0, 160, 90);
          const bytes = new Uint8Array(await crypto.subtle.digest("SHA-256", data));
          return [...bytes].map(byte => byte.toString(16).padStart(2, "0")).join("");
        };
        const pencil = new OffscreenCanvas(160, 90).getContext("2d"), wrong = [], all = new Set();
        for (let i = 0; i < 50; i++) {
          film.currentTime = i / 25;
          const drawn_on = done => film.addEventListener("timeupdate", done, { once: true });
          if (i) await new Promise(drawn_on);
          const answer = await fetch(i + 1 + ".png");
          pencil.drawImage(await createImageBitmap(await answer.blob()), 0, 0);
          const drawn = await digest(part("view").getContext("2d"));
          if (drawn !== await digest(pencil)) wrong.push(i);
          all.add(drawn);
        }
        return { wrong, different: all.size };
      })()`);]=]
    assert.same({ wrong = {}, different = 50 }, said)
  end)

  it("plays, pauses, seeks and ends, with an event for each", function()
    local said = see [=[
      await show(`<celspan-film width="160" controls></celspan-film>`);
      // before there is a film
      await page.get("film.src = 'film.plane', film.currentTime = 1.6, film.play(), 0");
      await page.until("events[0].includes('ended')");
      const first = await page.get(
        "[[...events[0]], film.currentTime, film.paused, film.duration]");
      const again = await page.get("film.play(), film.currentTime"); // from the start
      const sought = await page.get(
        "film.play(), film.currentTime = 1.6, [film.currentTime, film.paused]");
      await page.get("film.currentTime = 0.4, film.play(), 0");
      await page.until("film.currentTime > 0.4");
      const paused = await page.get("film.pause(), film.currentTime");
      await page.pause(0.2);
      const still = await page.get("film.currentTime") === paused;
      await page.get(
        "events[0].length = 0, film.loop = true, film.currentTime = 1.6, film.play(), 0");
      await page.until("film.currentTime < 1");
      const loops = await page.get("!film.paused && !events[0].includes('ended')");
      const wrong = await page.get(`(() => { try { film.currentTime = "soon"; }
        catch (fault) { return String(fault); } })()`);
      const ends = await page.get(`film.pause(), [-5, 99].map(time => {
        film.currentTime = time;
        return film.currentTime;
      })`);
      return { first, again, sought, still, loops, wrong, ends };]=]
    local events = table.concat(said.first[1], " ")
    for _, some in ipairs { "^play loadeddata", " timeupdate", " pause ended" } do
      assert.matches(some, events)
    end
    assert.same({ 1.96, true, 2 }, { table.unpack(said.first, 2) })
    assert.same({ 0, { 1.6, false }, true, true },
      { said.again, said.sought, said.still, said.loops })
    assert.equal("TypeError: currentTime: soon is not a time", said.wrong)
    assert.same({ 0, 1.96 }, said.ends)
  end)

  it("plays by itself, but not where less motion is wanted", function()
    local said = see [=[
      const found = [];
      for (const value of ["no-preference", "reduce"]) {
        await page.call("Emulation.setEmulatedMedia",
          { features: [{ name: "prefers-reduced-motion", value }] });
        await show(`<celspan-film src="film.plane" width="160" autoplay loop muted>
          </celspan-film>`);
        await page.until("events[0].includes('loadeddata')");
        await page.pause(0.3);
        found.push(await page.get("film.paused"));
      }
      await page.get("film.play(), 0"); // who asks gets it
      found.push(await page.get("film.paused"));
      return found;]=]
    assert.same({ false, true, false }, said)
  end)

  it("hears the keys of the one that has the focus, and its buttons", function()
    local said = see [=[
      await show(`<celspan-film src="film.plane" width="320" controls loop></celspan-film>
        <celspan-film src="film.plane" width="320" controls loop></celspan-film>`);
      await page.until("events.every(list => list.length)");
      const times = () => page.get("films.map(one => Math.round(one.currentTime * 25))");
      const found = [];
      await page.press(".");
      found.push(await times()); // neither
      await page.get("films[1].focus(), 0");
      for (const key of "...,") await page.press(key);
      found.push(await times());
      await page.press(" ");
      await page.until("!films[1].paused && films[0].paused");
      await page.press(" ");
      await page.until("films[1].paused");
      await page.press("+");
      await page.until("films[1].view.factor > 1.49");
      found.push(await page.get("films[0].view.factor"));
      await page.get(`part("in", films[0]).focus(), 0`);
      await page.press(" "); // presses the button, and does not play
      await page.until("films[0].view.factor > 1.99");
      found.push(await page.get("films[0].paused"));
      await page.get(`part("play", films[0]).focus(), 0`);
      await page.press(" ");
      await page.until("!films[0].paused");
      found.push(await page.get(`[...films.map(one => part("play", one).ariaLabel),
        part("frame", films[1]).getAttribute("aria-valuetext").replace(/^[0-9]+/, "N")]`));
      return found;]=]
    assert.same({ { 0, 0 }, { 0, 2 }, 1, true, { "Pause", "Play", "N of 50" } }, said)
  end)

  it("zooms a still by wheel, pinch and zoom(); over a film the wheel moves the page", function()
    local said = see [=[
      await show(`<celspan-film src="still.plane" width="320"></celspan-film>
        <celspan-film src="film.plane" width="320"></celspan-film><p id="long"></p>`);
      await page.get("document.getElementById('long').style.height = '3000px', 0");
      await page.until("events.every(list => list.length)");
      const middle = i => page.get(`(box => [box.x + box.width / 2, box.y + box.height / 2])(
        films[${i}].getBoundingClientRect())`);
      const [x, y] = await middle(0), other = await middle(1), found = [];
      await page.mouse("mouseWheel", x, y, { deltaX: 0, deltaY: -300 });
      await page.until("Math.abs(film.view.factor - 2) < 1e-3");
      found.push(await page.get("scrollY"));
      await page.call("Input.synthesizePinchGesture",
        { x, y, scaleFactor: 2, gestureSourceType: "touch" });
      await page.until("film.view.factor > 3");
      await page.get("film.zoom(81, 45.5, 1e5), 0");
      await page.until("film.view.factor > 99999");
      await page.until("pixel(160, 90) === '242,100,25,255'");
      found.push(await page.get("[film.view.x, film.view.y].map(v => v.toFixed(3)).join()"));
      await page.mouse("mouseWheel", ...other, { deltaX: 0, deltaY: 300 });
      await page.until("scrollY > 0");
      found.push(await page.get("films[1].view.factor"));
      await page.get("scrollTo(0, 0), films[1].focus({ preventScroll: true }), 0");
      await page.mouse("mouseWheel", ...other, { deltaX: 0, deltaY: -300 });
      await page.until("films[1].view.factor > 1.9");
      found.push(await page.get(`(() => { try { film.zoom(1, 2, 0); }
        catch (fault) { return String(fault); } })()`));
      return found;]=]
    assert.same({ 0, "81.000,45.500", 1,
                  "TypeError: zoom: 1, 2, 0 is not a place and a factor above 0" }, said)
  end)

  it("is shown eight times on a page, with one decoder", function()
    local said = see [=[
      await page.call("Page.addScriptToEvaluateOnNewDocument", { source: `
        const compile = WebAssembly.compile;
        let compiled = 0;
        WebAssembly.compile = bytes => (compiled++, compile.call(WebAssembly, bytes));` });
      await show(`<celspan-film src="film.plane" width="200" autoplay loop></celspan-film>`
        .repeat(8));
      await page.until(
        "events.every(list => list.filter(name => name === 'timeupdate').length > 9)");
      await page.get("films.forEach(one => one.pause()), films[3].currentTime = 1, 0");
      return page.get("[compiled, films.filter(one => one.currentTime === 1).length > 0]");]=]
    assert.same({ 1, true }, said)
  end)

  it("is not drawn where it cannot be seen, but its time continues", function()
    local said = see [=[
      await show(`<p id="long"></p>
        <celspan-film src="film.plane" width="200"></celspan-film>`);
      await page.until("events[0].includes('loadeddata')");
      await page.get("document.getElementById('long').style.height = '3000px', 0");
      await page.get(`new Promise(done => new IntersectionObserver(
        entries => entries.at(-1).isIntersecting || done(0)).observe(film))`);
      await page.get("events[0].length = 0, film.play(), 0");
      // Two seconds without a frame: the last one of the film is never its time.
      await page.get(`requestAnimationFrame(() => requestAnimationFrame(begun => {
        while (performance.now() < begun + 2200);
      })), 0`);
      await page.until("events[0].includes('ended')");
      await page.pause(0.2);
      const unseen = await page.get("[...events[0]]");
      await page.get("film.scrollIntoView(), 0");
      await page.until("events[0].includes('timeupdate')");
      return [unseen, await page.get("events[0]")];]=]
    assert.same({ { "play", "pause", "ended" }, { "play", "pause", "ended", "timeupdate" } }, said)
  end)

  it("continues where it is moved, ends where it is removed, and begins again by src", function()
    local said = see [=[
      await show(`<celspan-film src="film.plane" width="160" autoplay loop></celspan-film>`);
      await page.until("film.currentTime > 0");
      const found = [];
      found.push(await page.get(`(async () => {
        film.currentTime = 1;
        document.body.append(film);
        await new Promise(queueMicrotask); // after that of the film
        return [film.paused, film.currentTime];
      })()`));
      await page.until("film.currentTime !== 1");
      await page.get("events[0].length = 0, film.remove(), 0");
      await page.pause(0.1);
      found.push(await page.get("[film.paused, events[0].at(-1), film.view]"));
      await page.get("events[0].length = 0, film.src = 'still.plane', 0");
      await page.get("document.body.append(film), 0");
      await page.until("events[0].includes('loadeddata')");
      found.push(await page.get("[film.duration, pixel(80, 45)]"));
      await show("<celspan-film></celspan-film>", "");
      // before there are elements
      await page.get(`film.src = "film.plane", film.loop = true, film.currentTime = 1, 0`);
      await page.get(`document.head.append(Object.assign(document.createElement("script"),
        { src: "celspan-film.js" })), 0`);
      await page.until("events[0].length");
      found.push(await page.get(`[film.getAttribute('src'), film.hasAttribute('loop'),
        part('frame').value, events[0][0]]`));
      return found;]=]
    assert.same({ { false, 1 }, { true, "pause", json.null }, { 0, "242,100,25,255" },
                  { "film.plane", true, "26", "loadeddata" } }, said)
  end)

  it("shows planes in planes, a million deep, and reads what is near alone", function()
    nest()
    local said = see(NESTED .. [=[
      site.parts = true;
      await nested("nest");
      await shown("255,128,0,255", 500, 80);
      const found = [[await page.get("pixel(5, 5)"), ...site.asked.splice(0)]];
      for (const [factor, colour] of [[1, "0,0,128,255"], [100, "0,128,0,255"],
                                      [1e4, "128,0,0,255"], [1e6, "255,255,255,255"]]) {
        await page.get(`film.zoom(${middle}, ${factor}, "instant"), 0`);
        await shown(colour, 320, 180);
        found.push([await page.get("film.view.factor"), ...site.asked.splice(0)]);
      }
      await page.get(`film.zoom(${middle}, 1e15, "instant"), 0`);
      await page.until("film.view.factor > 1e10 && film.view.factor < 1e11");
      await shown("255,255,255,255", 320, 180);
      await page.get("film.zoom(80, 45, 1, 'instant'), 0");
      await shown("0,0,128,255", 5, 5);
      await page.pause(0.1);
      return [found, site.asked, await page.get("events[0]")];]=])
    local outer = #bench:read "navy.plane" + 24 + 8 * 4 + 36 * 3
    assert.same({ "0,0,128,255", "x.html", "listen.js", "celspan-film.js",
      "nest.plane bytes=0-65535", ("nest.plane bytes=65536-%d"):format(outer - 1),
      part "orange" }, said[1][1])
    assert.same({ 1 }, said[1][2])
    local near = { part "second", part "third", part "white" }
    for i = 1, 3 do
      assert.same(near[i], said[1][i + 2][2])
      assert.near(1, said[1][i + 2][1] / 100 ^ i, 1e-9)
      assert.is_nil(said[1][i + 2][3])
    end
    assert.same({ {}, { "loadeddata" } }, { said[2], said[3] })
  end)

  it("shows planes in planes of a server that sends whole files", function()
    nest()
    assert.same({ "x.html", "listen.js", "celspan-film.js", "nest.plane bytes=0-65535" },
      see(NESTED .. [=[
      await nested("nest");
      await deep();
      await shown("255,255,255,255", 320, 180);
      return site.asked;]=]))
  end)

  it("reads the head of a nest of which a server sends a short part first", function()
    nest()
    assert.same({ { "loadeddata" }, "255,128,0,255" }, see(NESTED .. [=[
      Object.assign(site, { parts: true, first: 100 });
      await nested("nest");
      await page.until("pixel(500, 80) !== '0,0,128,255'");
      await shown("255,128,0,255", 500, 80);
      return [await page.get("events[0]"), await page.get("pixel(500, 80)")];]=]))
  end)

  it("shows 256 windows at most, of however many a file has", function()
    made("blue", 1, "#0000ff")
    made("green", 1, "#008000")
    joined("crowd", "green", ("60,30,80,45,blue.plane\n"):rep(16))
    for name, crowds in pairs { bearable = 15, crowded = 16 } do
      joined(name, "blue", ("100,5,50,28.125,crowd.plane\n"):rep(crowds)
        .. "20,20,32,30,green.plane\n")
    end
    assert.same({ "0,128,0,255", "0,0,255,255" }, see(NESTED .. [=[
      const found = [];
      for (const name of ["bearable", "crowded"]) {
        await nested(name);
        await page.until("pixel(410, 30) === '0,128,0,255'"); // of a crowd, beside its windows
        await page.pause(0.5);
        found.push(await page.get("pixel(140, 140)"));
      }
      return found;]=]))
  end)

  it("plays planes in a still, which appear when they become large", function()
    still_nest()
    local said = see(NESTED .. [=[
      await nested("still_nest");
      await shown("255,128,0,255", 500, 80);
      const half = await page.get("pixel(140, 110)");
      await page.get("film.play(), 0");
      for (const colour of ["255,0,0,255", "255,128,0,255", "255,0,0,255"])
        await shown(colour, 500, 80);
      const red = async () => await page.get("pixel(500, 80)") === "255,0,0,255";
      do {
        await page.get("film.play(), 0");
        await page.pause(0.05);
        await page.get("film.pause(), 0");
        await page.pause(0.1);
      } while (!await red());
      await page.get("film.play(), film.pause(), 0"); // which begins where it was
      await page.pause(0.1);
      return [await red(), half,
              await page.get("[film.paused, film.currentTime, film.duration > 1e9]")];]=])
    assert.is_true(said[1])
    assert.matches("^0,6%d,12%d,255$", said[2])
    assert.same({ true, 0, true }, said[3])
  end)

  it("draws only what has changed since the picture before", function()
    still_nest()
    local said = see(NESTED .. [=[
      await nested("still_nest");
      await shown("255,128,0,255", 500, 80);
      await page.get(`window.calls = { clearRect: 0, putImageData: 0 }, Object.keys(calls)
        .forEach(name => {
          const own = CanvasRenderingContext2D.prototype[name];
          CanvasRenderingContext2D.prototype[name] = function (...words) {
            calls[name]++;
            return own.apply(this, words);
          };
        }), film.play(), 0`);
      await page.pause(2);
      return page.get(`film.pause(), [calls.clearRect, calls.putImageData, part("play").hidden,
        part("frame").hidden, part("number").hidden]`);]=])
    local pictures, decoded = table.unpack(said)
    assert.same({ false, true, true }, { table.unpack(said, 3) }) -- it plays, and has one frame
    assert.is_true(pictures >= 2 and pictures <= 9, "pictures: " .. pictures)
    assert.is_true(decoded <= pictures + 1, "planes that were decoded: " .. decoded)
  end)

  it("forgets planes that are far away, and reads them again", function()
    made("black", 1, "#000000")
    made("green", 1, "#008000")
    local rows = {}
    for i = 1, 70 do
      bench:write(("one%d.plane"):format(i), bench:read "green.plane")
      rows[i] = ("%g,%g,10.5,10.5,one%d.plane\n"):format((i - 1) % 15 * 10.6,
        (i - 1) // 15 * 10.6, i)
    end
    joined("many", "black", table.concat(rows) .. "80,70,3,3,green.plane\n")
    local said = see(NESTED .. [=[
      site.parts = true;
      const asked = () => site.asked.filter(name => name.startsWith("many")).length;
      const all = async count => {
        for (let i = 0; i < 200 && asked() < count; i++) await page.pause(0.05);
        await page.pause(0.2);
        return asked();
      };
      await nested("many");
      const found = [await all(71)];
      await page.get("film.zoom(81.5, 71.5, 40, 'instant'), 0");
      found.push(await all(72));
      await page.get("film.zoom(80, 45, 1, 'instant'), 0");
      found.push(await all(79));
      return found;]=])
    assert.same({ 71, 72, 79 }, said)
  end)

  it("refuses a damaged plane in a plane, and asks again for what did not come", function()
    nest()
    local bytes = bench:read "nest.plane"
    local at = bytes:find(bench:read "white.plane", 1, true) + 60
    bench:write("nothing.plane", "")
    bench:write("torn.plane", bytes:sub(1, at) .. "x" .. bytes:sub(at + 2))
    local said = see(NESTED .. [=[
      site.parts = true;
      const found = [];
      await nested("torn");
      await deep();
      await page.until("events[0].length > 1");
      found.push(await page.get("events[0][1]"));
      await nested("nothing");
      found.push(await page.get("events[0][0]"));
      await nested("nest");
      site.lost = true;
      await deep();
      await page.pause(0.2);
      await page.get(`film.zoom(${middle}, 1e8, "instant"), 0`);
      await shown("0,0,0,0", 320, 180); // where a plane that is too large to be drawn was
      await deep();
      site.lost = false;
      await shown("255,255,255,255", 320, 180);
      found.push(await page.get("events[0]"));
      return found;]=])
    assert.same({ "error: This picture is damaged: band 0: the checksum is wrong.",
      "error: This picture is damaged: the file is too short for a plane file.",
      { "loadeddata" } }, said)
  end)

  it("says what is wrong with a file, in an alert and an event, for each player", function()
    local film = bench:read "film.plane"
    local half = #film // 2
    bench:write("damaged.plane", film:sub(1, half) .. string.char(film:byte(half + 1) ~ 1)
      .. film:sub(half + 2))
    bench:write("short.plane", film:sub(1, half))
    bench:write("empty.plane", "")
    local said = see [=[
      const names = ["damaged", "damaged", "short", "empty", "none", "celspan-film.js?"];
      await show(names.map(name => `<celspan-film src="${name}.plane" width="160" autoplay>
        </celspan-film>`).join("") + `<celspan-film src="#nothing"></celspan-film>
        <celspan-film></celspan-film>`);
      await page.until(
        "events.slice(0, 7).every(list => list.some(name => name.startsWith('error')))");
      return page.get(`films.map((one, i) => ({ last: events[i].at(-1) ?? "",
        alert: part("fault", one).textContent, role: part("fault", one).role, paused: one.paused,
        seen: part("fault", one).checkVisibility() }))`);]=]
    for i, wanted in ipairs { "This picture is damaged: ", "This picture is damaged: ",
      "This picture is damaged: ", "This picture is damaged: the file is too short",
      "none.plane: this file cannot be loaded: 404 Not Found.",
      "This picture is damaged: ", "#nothing: the page has no such element." } do
      assert.matches(wanted, said[i].alert, 1, true)
      assert.same({ last = "error: " .. said[i].alert, alert = said[i].alert, role = "alert",
                    paused = true, seen = true }, said[i])
    end
    assert.same({ "", "", false }, { said[8].last, said[8].alert, said[8].seen })
  end)

  it("says so where the policy of the page forbids WebAssembly", function()
    local said = see [=[
      site.policy = POLICY.replace(" 'wasm-unsafe-eval'", "");
      await show(`<celspan-film src="still.plane"></celspan-film>`.repeat(2));
      await page.until("events.every(list => list.length)");
      return page.get(
        `films.map((one, i) => [part("fault", one).textContent, events[i].join()])`);]=]
    for _, one in ipairs(said) do
      assert.matches("does not allow WebAssembly", one[1], 1, true)
      assert.equal("error: " .. one[1], one[2])
    end
  end)

  it("can be imported where there is no page", function()
    local code, out, err =
      bench:inside "cp celspan-film.js x.mjs && node x.mjs && node celspan-film.js"
    assert.same({ 0, "", "" }, { code, out, err })
  end)
end)

describe("pages with planes #plain", function()
  if not io.open(AXE) then return pending "axe-core was not fetched" end

  it("have no fault that axe-core finds", function()
    for name in pairs { still = 1, film = 1 } do
      local code, _, err = bench:celspan_inside("plane %s.plane -o %s.html", name, name)
      assert.equal(0, code, err)
    end
    local said = see([=[
      const axe = require("fs").readFileSync("]=] .. AXE .. [=[", "utf8");
      const found = [];
      async function look(where) {
        await page.get(axe + "; 0");
        const one = await page.get(`axe.run().then(all => ({ passed: all.passes.length,
          bad: all.violations.map(({ id, nodes }) => id + ": " + nodes[0].failureSummary) }))`);
        found.push(...one.bad.map(bad => where + ": " + bad));
        if (one.passed < 10) found.push(where + ": only " + one.passed + " rules passed");
      }
      site.policy = "default-src 'unsafe-inline' 'unsafe-eval' data: 'self'";
      for (const name of ["still", "film"]) {
        await page.load(`file://${folder}/${name}.html`);
        await page.until("where.textContent");
        await look(name);
      }
      await show(`<celspan-film src="film.plane" controls aria-label="A disc"></celspan-film>
        <celspan-film src="still.plane" controls><img src="still.png" alt="A disc"></celspan-film>
        <celspan-film src="none.plane" poster="still.png"></celspan-film>`);
      await page.until("events.every(list => list.length)");
      await look("elements");
      return found;]=])
    assert.same({}, said)
  end)
end)
