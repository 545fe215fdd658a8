-- Scripts of the site that run in their places, with the engine that `./run web` made.
local browsing = require "tests.support.browsing"
local markdown = require "tests.support.markdown"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local WEB = present.engine()
local AXE = "out/npm/node_modules/axe-core/axe.min.js"

if not present.program "chromium" or not present.site() then
  return pending "there is no node with markdown-it, no python3 with pygments, or no chromium"
end
if not WEB then
  return pending "there is no out/web: ./run web makes it"
end

local bench

--- Saves a block of a page as a file of the bench.
local function save(page, name)
  markdown.save(page, bench.folder, function(block) return block.name == name end)
end

setup(function()
  bench = workbench.new()
  local code, _, err = bench:shell(("cd '%s' && node docs/site/make.js '%s/site' '%s'")
    :format(os.getenv "PWD", bench.folder, WEB))
  assert.equal(0, code, err)
  save("README.md", "moon")
  save("docs/cookbook.md", "endless_zoom")
end)
teardown(function() bench:remove() end)

--- What the steps return, in JavaScript, on a page of the site that a reader sees who wants no
--- motion. `run` begins a figure and waits for its picture; `same` returns how many pixels of it
--- are not those of a PNG of the bench, or the size if that is another.
local function see(steps, policy)
  return browsing.see("about:blank", ([=[
    const site = await require("./site.js")("%s/site");
    site.policy = %s;
    await page.call("Network.enable");
    await page.call("Emulation.setEmulatedMedia",
      { features: [{ name: "prefers-reduced-motion", value: "reduce" }] });
    await page.call("Emulation.setDeviceMetricsOverride",
      { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
    const load = name => page.load(site.at(name), /^http:/);
    const one = (name, part = "") => `document.querySelector("[data-script=${name}] ${part}")`;
    const state = (name, value) => page.until(`${one(name)}.dataset.state === "${value}"`);
    const run = async name => {
      await page.get(`${one(name, ".run")}.focus()`);
      await page.press("Enter");
      await state(name, "drawn");
    };
    const same = async (name, picture) => {
      site.pages["picture.png"] = require("fs").readFileSync("%s/" + picture);
      return await page.get(`(async () => {
        const canvas = ${one(name, "canvas")}, { width, height } = canvas;
        const image = new Image();
        image.src = "picture.png?${picture}";
        await image.decode();
        if (image.width !== width || image.height !== height) return width + "x" + height;
        const other = new OffscreenCanvas(width, height).getContext("2d");
        other.drawImage(image, 0, 0);
        const [a, b] = [canvas.getContext("2d"), other]
          .map(pen => new Uint32Array(pen.getImageData(0, 0, width, height).data.buffer));
        return a.filter((code, i) => code !== b[i]).length;
      })()`);
    };
    const type = (name, from, to) => page.get(`(() => {
      const area = ${one(name, "textarea")};
      area.value = area.value.replace(${JSON.stringify(from)}, ${JSON.stringify(to)});
      area.dispatchEvent(new Event("input"));
    })()`);
    const place = (name, part) => page.get(`(() => {
      const box = ${one(name, part)}.getBoundingClientRect();
      return [box.left, box.top, box.width, box.height]; })()`);
    /** The middle of the first token with a text. */
    const token = (name, text) => page.get(`(() => {
      const span = [...${one(name)}.querySelectorAll("code span")]
        .find(span => span.textContent === ${JSON.stringify(text)});
      span.scrollIntoView({ block: "center" });
      const box = span.getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2]; })()`);
    const pixel = (name, x, y) => page.get(`[...${one(name, "canvas")}.getContext("2d")
      .getImageData(${x}, ${y}, 1, 1).data].join()`);
    const becomes = (name, x, y, codes) => page.until(`[...${one(name, "canvas")}.getContext("2d")
      .getImageData(${x}, ${y}, 1, 1).data].join() === "${codes}"`);
    const code = name => page.get(`${one(name, "textarea")}.value`);
    try { %s } finally { site.close(); }]=])
    :format(bench.folder, policy and ("%q"):format(policy) or "null", bench.folder, steps))
end

--- Renders a script of the bench to a PNG.
local function render(script, picture, options)
  local code, _, err = bench:inside(("'%s' render %s.lua -o %s --progress none %s")
    :format(workbench.absolute, script, picture, options))
  assert.equal(0, code, err)
end

describe("a script of the site #plain", function()
  it("draws what the program draws, also zoomed, where pages forbid eval", function()
    render("moon", "moon.png", "--frames 1 --size 640x360")
    render("moon", "near.png", "--frames 1 --size 2560x1440 --crop 960,540,640,360")
    render("endless_zoom", "room.png", "--frames 1 --size 640x360")
    local said = see([=[
      await load("index.html");
      const before = page.requests.filter(one => one.includes("/live/")).length;
      await run("moon");
      const moon = await same("moon", "moon.png");
      for (const times of [2, 4]) {
        await page.get(`${one("moon", "[title='Zoom in']")}.click()`);
        await page.until(`${one("moon", "output")}.textContent.includes("×${times}")`);
      }
      const near = await same("moon", "near.png");
      await load("cookbook.html");
      await run("endless_zoom");
      const outside = page.requests
        .filter(one => !one.startsWith(site.at("")) && !/^(data|about):/.test(one));
      return { before, moon, near, room: await same("endless_zoom", "room.png"), outside };]=],
      "default-src 'self'; img-src 'self' data:; script-src 'self' 'wasm-unsafe-eval'")
    assert.same({ before = 0, moon = 0, near = 0, room = 0, outside = {} }, said)
  end)

  it("is changed in its place: errors, numbers, colours, lines, and the escape key", function()
    local said = see [=[
      await load("index.html");
      await run("moon");
      const before = await code("moon"), said = {};

      await type("moon", "74, fill", "74, fil");
      await state("moon", "failed");
      said.fault = await page.get(`${one("moon", ".fault")}.textContent`);
      said.line = await page.get(`${one("moon", ".fault")}.style.getPropertyValue("--line")`);
      const [, top] = await place("moon", ".fault");
      const [, from, , height] = await place("moon", "textarea");
      said.row = (top - from) / (height / before.split("\n").length);

      await page.get(`${one("moon", "textarea")}.focus()`);
      await page.press("Escape");
      await state("moon", "drawn");
      said.isBack = before === await code("moon");

      const dark = await pixel("moon", 165, 220), [x, y] = await token("moon", "24");
      await page.mouse("mousePressed", x, y, { button: "left", clickCount: 1 });
      for (const way of [4, 20, 80]) {
        await page.mouse("mouseMoved", x + way, y, { button: "left", buttons: 1 });
      }
      await page.mouse("mouseReleased", x + 80, y, { button: "left", clickCount: 1 });
      await becomes("moon", 165, 220, "255,210,122,255");
      said.isWider = dark !== await pixel("moon", 165, 220)
        && (await code("moon")).includes("128, 208, 44, 30");

      await page.click(...await token("moon", '"#ffd27a"'));
      await page.get(`(() => { const field = ${one("moon", "[type=color]")};
        field.value = "#ff0000"; field.dispatchEvent(new Event("input")); })()`);
      await becomes("moon", 140, 220, "255,0,0,255");

      const [, , width] = await place("moon", "canvas"), house = await pixel("moon", 100, 340);
      await page.get(`${one("moon", "canvas")}.scrollIntoView({ block: "center" })`);
      const [left, above] = await place("moon", "canvas");
      await page.click(left + 140 / 640 * width, above + 220 / 640 * width);
      await page.until(`${one("moon")}.querySelector(".lit")`);
      said.lit = await page.get(`${one("moon", ".lit")}.style.getPropertyValue("--line")`);

      await page.click(...await token("moon", "208"));
      await becomes("moon", 100, 340, "0,0,0,0");
      said.isAlone = house !== "0,0,0,0" && await pixel("moon", 140, 220) === "255,0,0,255";
      said.points = await page.get(
        `[...${one("moon")}.querySelectorAll(".handle")].map(one => one.value)`);

      await page.get(`${one("moon", "canvas")}.scrollIntoView({ block: "center" })`);
      const [h, v] = (await place("moon", ".handle")).map(side => side + 8);
      await page.mouse("mousePressed", h, v, { button: "left", clickCount: 1 });
      await page.mouse("mouseMoved", h - 100, v, { button: "left", buttons: 1 });
      await page.mouse("mouseReleased", h - 100, v, { button: "left", clickCount: 1 });
      await becomes("moon", 50, 220, "255,0,0,255");
      return said;]=]
    assert.is_truthy(said.fault:find("unknown field 'fil'; did you mean 'fill'", 1, true))
    assert.is_true(math.abs(said.row - 3) < 0.3, said.row)
    said.fault, said.row = nil, nil
    assert.same({ line = "3", isBack = true, isWider = true, lit = "6", isAlone = true,
      points = { "128, 208" } }, said)
  end)

  it("that never ends, or wants all memory, ends with a sentence", function()
    local said = see [=[
      await load("index.html");
      await run("moon");
      const notes = [];
      for (const bomb of ["while true do end", "local t = {} for i = 1, 1e9 do t[i] = { i } end"]) {
        await type("moon", "-- moon.lua", bomb);
        await state("moon", "failed");
        const place = `(${one("moon", ".fault")} ?? ${one("moon", ".note")})`;
        notes.push(await page.get(`${place}.textContent`));
        await type("moon", bomb, "-- moon.lua");
        await state("moon", "drawn");
      }
      return notes;]=]
    assert.is_truthy(said[1]:find("step", 1, true), said[1])
    assert.is_truthy(said[2]:find("MiB", 1, true), said[2])
  end)

  it("keeps its picture and says why, without WebAssembly", function()
    local said = see [=[
      const notes = [];
      for (const source of ["", "delete globalThis.WebAssembly"]) {
        await page.call("Page.addScriptToEvaluateOnNewDocument", { source });
        site.policy = source ? null : "default-src 'self'; img-src 'self' data:";
        await load("index.html");
        await page.get(`${one("moon", "img")}.click()`);
        await state("moon", "failed");
        notes.push(await page.get(`${one("moon", ".note")}.textContent`),
          await page.get(`${one("moon", "img")}.checkVisibility()`));
      }
      return notes;]=]
    local sentence = "This browser has no WebAssembly, or the page forbids it: "
      .. "the picture stays still."
    assert.same({ sentence, true, sentence, true }, said)
  end)

  if io.open(AXE) then
    it("has no fault that axe-core finds while it runs", function()
      assert.same({}, see([=[
        const axe = require("fs").readFileSync("]=] .. AXE .. [=[", "utf8"), found = [];
        await load("index.html");
        await run("moon");
        await type("moon", "fill", "fil");
        await state("moon", "failed");
        await page.get(axe + "; 0");
        for (const theme of ["light", "dark"]) {
          await page.get(`document.querySelector("[value=${theme}]").click()`);
          await page.settle();
          found.push(...await page.get(`axe.run(${one("moon")}, { resultTypes: ["violations"] })
            .then(all => all.violations.map(({ id, nodes }) => "${theme}: " + id + ": "
              + nodes[0].target + ": " + nodes[0].failureSummary))`));
        }
        return found;]=]))
    end)
  end
end)
