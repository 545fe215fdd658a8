-- celspan watch: whether everybody can use its page, as axe-core finds, which `./run` fetches.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

local AXE = "out/npm/node_modules/axe-core/axe.min.js"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end
if not io.open(AXE) then return pending "axe-core was not fetched" end

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { level = { 0.5, min = 0, max = 1 }, tint = { colour = "#cc0000" },
  side = { "left", "right" }, title = "Hello", round = true }
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, marks = { half = 24 },
  frame = function(f)
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 64, 36, texture = p.tint } }:named "ground",
      celspan.cel { celspan.circle { centre = { f.index, 18 }, radius = 30 * p.level } } }
  end }
]]

before_each(function() watching.begin { ["shot.lua"] = FILM } end)
after_each(watching.finish)

describe("the controls of the page of celspan watch #plain", function()
  it("have names, and those with a key say it, as the list of keys does", function()
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      for (const key of "sq") await page.press(key);
      await page.until(`document.querySelectorAll("#object-list li, #names li").length === 4`);
      return page.get(`(() => {
        const words = { " ": "space", ArrowLeft: "left", ArrowRight: "right" };
        const marks = { left: "←", right: "→" };
        const listed = [...document.querySelectorAll("#keys dt")]
          .flatMap(one => one.textContent.split(/,? /));
        const controls = [...document.querySelectorAll("button, summary, select, input, textarea")];
        const nameOf = one => one.ariaLabel || one.labels?.[0]?.textContent.trim()
          || one.textContent.trim() || document.getElementById(
            one.getAttribute("aria-labelledby"))?.textContent;
        const bad = controls.filter(one => !nameOf(one)).map(one => one.outerHTML);
        const keyed = controls.filter(one => one.dataset.key);
        for (const one of keyed) {
          const { key } = one.dataset, word = words[key] ?? key;
          if (!one.title.endsWith("(" + word + ")")) bad.push(one.id + ": its title: " + one.title);
          const isListed = key === "?" || listed.includes(marks[word] ?? word);
          if (!isListed) bad.push(one.id + ": not listed");
        }
        return { bad, controls: controls.length, keyed: keyed.length };
      })()`);]=])
    assert.same({}, said.bad)
    assert.is_true(said.controls > 60 and said.keyed >= 25, said.controls .. ", " .. said.keyed)
  end)
end)

describe("the page of celspan watch #plain", function()
  it("has no fault that axe-core finds, dark and light, with panels, dialogs and errors", function()
    local said = watching.see(watching.watch "shot.lua --editor true", [=[
      const found = [];
      const look = async where => {
        const one = await page.get(`axe.run({ rules: { "label-content-name-mismatch": {
          enabled: true } } }).then(all => ({ passed: all.passes.length,
          bad: all.violations.map(({ id, nodes }) => id + " at " + nodes.length + " places: "
            + nodes[0].target + ": " + nodes[0].failureSummary) }))`);
        found.push(...one.bad.map(bad => where + ": " + bad));
        if (one.passed < 10) found.push(where + ": only " + one.passed + " rules passed");
      };
      await page.until(`${canvas("frame")} === "1"`);
      await page.get(require("fs").readFileSync("]=] .. AXE .. [=[", "utf8") + "; 0");
      const themes = {};
      for (const theme of ["one", "other"]) {
        await look(theme);
        for (const key of "ysn") await page.press(key);
        await page.until(`document.querySelectorAll("#names li").length > 1`);
        await page.until(`document.querySelector("#canvas2").dataset.frame === "1"
          && document.querySelector("#form2 input")`);
        await look(theme + " with values");
        await page.press("c");
        await page.until(`document.querySelectorAll("#cost-rows tr").length === 3`);
        await look(theme + " with costs");
        await page.press("q");
        await page.until(`document.querySelectorAll("#object-list li").length > 1`);
        await look(theme + " with objects");
        await page.press("r");
        await look(theme + " with faults");
        for (const menu of ["render", "view", "comparing"]) {
          await page.get(`document.querySelector("#${menu}").click()`);
          await look(theme + " with the menu " + menu);
          await page.press("Escape");
        }
        await page.press("p");
        await page.settle();
        const box = await page.get(`(() => { const box = document.querySelector("#canvas")
          .getBoundingClientRect(); return [box.left + 9, box.top + 9]; })()`);
        await page.click(...box);
        await page.until(`document.querySelectorAll("#hits li").length > 1`);
        await look(theme + " with the inspector");
        await page.press("?");
        await look(theme + " with keys");
        await page.get(`document.querySelector("#keys button").click()`);
        await page.until(`!document.querySelector("dialog[open]")`);
        page.write("]=] .. watching.bench.folder .. [=[/shot.lua", "return nil +");
        await page.until(`!document.querySelector("#error").hidden`);
        await look(theme + " with an error");
        page.write("]=] .. watching.bench.folder .. [=[/shot.lua", ]=] .. ("%q"):format(FILM)
        :gsub("\\\n", "\\n") .. [=[);
        await page.until(`document.querySelector("#error").hidden`);
        themes[await page.get("document.documentElement.dataset.theme")] = true;
        for (const key of "pyst") await page.press(key);
      }
      const narrow = async (width, height) => {
        await page.call("Emulation.setDeviceMetricsOverride",
          { width, height, deviceScaleFactor: 1, mobile: false });
        await page.press("v");
        await look(`at ${width} x ${height}`);
        await page.press("v");
        return page.get(`document.documentElement.scrollWidth - innerWidth`);
      };
      const wide = await narrow(2560, 1440), slim = await narrow(390, 844);
      const controls = await page.get(`[...document.querySelectorAll("button, input, select")]
        .filter(one => one.checkVisibility() && one.getBoundingClientRect().top < 70).length`);
      return { found, themes, overflow: [wide, slim], controls };]=], 120)
    assert.same({ 0, 0 }, said.overflow)
    assert.is_true(said.controls <= 9, said.controls)
    assert.same({ dark = true, light = true }, said.themes)
    assert.same("", table.concat(said.found, "\n"))
  end)
end)
