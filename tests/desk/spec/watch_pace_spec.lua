-- celspan watch: which frames are asked for while a film plays, what is kept of them, and what
-- comes first.
local json = require "celspan.json"
local present = require "tests.support.present"
local system = require "tests.support.system"
local watching = require "tests.support.watching"

if not present.program "node" then return pending "there is no node" end

-- Plays 20 seconds of a film of 24 frames a second, by a clock of its own: `drawn` frames a second
-- are drawn, `together` of them arrive at the same time, and three are asked for at once. It says
-- how many frames a second are shown in the second half, and the longest time that one stays.
local MODEL = [=[
const RATE = 24, TICK = 1 / 60;
function played(drawn, together) {
  const pace = newPace(), waiting = [], here = new Set();
  let place = -1, isAsked = false, free = 0, shown = -1, count = 0, last = 10, longest = 0;
  for (let now = 0; now < 20; now += TICK) {
    const elapsed = now * RATE;
    while (waiting.length && waiting[0].at <= now) {
      const one = waiting.shift();
      here.add(one.number);
      noteArrival(pace, one.began, one.at, 1);
    }
    while (waiting.length < 3) {
      const next = nextPlace(pace, place, elapsed, RATE, isAsked);
      if (next > elapsed + pace.latency * RATE + 8) break;
      place = next;
      isAsked = true;
      free = Math.max(free, now) + 1 / drawn;
      const at = Math.ceil(free * drawn / together - 1e-6) * together / drawn;
      waiting.push({ at, began: now, number: Math.ceil(place) });
    }
    for (let at = Math.floor(elapsed); at > shown && at > elapsed - 24; at--) {
      if (!here.has(at)) continue;
      if (now >= 10) {
        count++;
        longest = Math.max(longest, now - last);
        last = now;
      }
      shown = at;
    }
  }
  return [count / 10, longest * RATE];
}
console.log(JSON.stringify({ list: [[15, 1], [21, 1], [13, 1], [18, 1], [40, 1], [16, 2]]
  .map(one => played(...one)) }));
]=]

-- The sizes in which a film of 24 frames a second is drawn. A sharp frame takes `frame(i)` seconds,
-- and `share` of them is for its pixels, of which a smaller one has fewer.
local SIZED = [=[
function sized(frame, share = 1) {
  const pace = newPace(), said = [];
  for (let i = 0, now = 1; i < 400; i++) {
    const whole = frame(i), took = whole * (1 - share + share / pace.coarse ** 2);
    noteArrival(pace, now, now + took, pace.coarse);
    now += Math.max(took, 1 / 24);
    if (said.at(-1) !== pace.coarse) said.push(pace.coarse);
    chooseSize(pace, 24);
  }
  return { list: said };
}
console.log(JSON.stringify({
  fast: sized(() => 0.02), cold: sized(i => i === 0 ? 0.3 : 0.02), enough: sized(() => 0.04),
  late: sized(() => 0.05), slow: sized(() => 0.12), slowest: sized(() => 1),
  vain: sized(() => 0.1, 0.1), shot: sized(i => i < 200 ? 0.12 : 0.02),
  busy: sized(i => i > 4 && i < 12 ? 0.4 : 0.12), // the computer has other work for a moment
  unsteady: sized(i => i % 2 ? 0.03 : 0.05) }));
]=]

--- What a module of the page prints, as JSON, with more text at its end.
local function run(module, text)
  local name = os.tmpname()
  system.write(name .. ".mjs", system.read("src/desk/program/verbs/watch/" .. module) .. text)
  local pipe = assert(io.popen("node " .. name .. ".mjs 2>&1"))
  local said = pipe:read "a"
  pipe:close()
  os.remove(name)
  os.remove(name .. ".mjs")
  return assert(json.decode(said), said)
end

describe("playing", function()
  it("shows nearly all frames that can be drawn in time", function()
    local list = run("pace.js", MODEL).list
    local least = { 14, 19, 12, 16.5, 23.5, 14 }
    for i, one in ipairs(list) do
      assert.is_true(one[1] >= least[i], one[1])
      assert.is_true(one[2] < 5, one[2])
    end
    assert.equal(#least, #list)
  end)

  it("draws frames smaller only where this brings them in time, and does not flicker", function()
    local said = run("pace.js", SIZED)
    local sizes = {}
    for name, one in pairs(said) do sizes[name] = table.concat(one.list, " ") end
    assert.same({ fast = "1", cold = "1", enough = "1", unsteady = "1", late = "1 1.5",
                  slow = "1 2", slowest = "1 3", shot = "1 2 1.5 1", busy = "1 2 1 2",
                  vain = "1 2 1 2 1 2 1 2 1" }, sizes)
  end)

  it("leaves a bar for each of half a million frames", function()
    local said = run("cost.js", [=[
      for (let i = 1; i <= 500000; i++) noteTime(i, i === 7 ? 2 : 1, 1);
      const heights = new Set();
      let count = 0;
      const brush = { fillRect: (x, y, wide, height) => { count++; heights.add(height); } };
      drawStrip(brush, 0, 24, x => x, 1, 0.5, {});
      console.log(JSON.stringify({ count, heights: [...heights] }));]=])
    assert.same({ count = 500000, heights = { 10, 20 } }, said)
  end)
end)

if not present.web() or not present.program "chromium" then return end

describe("a page that is opened", function()
  after_each(watching.finish)

  -- The film has what the page asks for by itself: values with a curve, a list of files, a sound.
  it("asks for the first picture before all that lies beside it", function()
    watching.begin { ["shot.lua"] = [[
local celspan = require "celspan"
local p = celspan.parameters { how = { ease = "outBack" }, size = { 3, min = 1, max = 9 } }
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, marks = { bell = 40 },
  frame = function()
    return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9, 9 }, radius = p.size } } }
  end }
]] }
    local said = watching.see(watching.watch(), [=[
      const all = `performance.getEntriesByType("resource")`;
      await page.until(`${all}.some(one => one.name.includes("/curve.json"))`);
      return { list: (await page.get(`(() => {
        const list = ${all}, seen = Math.min(...list.filter(one => one.name.includes("/frame/"))
          .map(one => one.responseEnd));
        return list.filter(one => one.startTime < seen)
          .map(one => new URL(one.name).pathname.replace(/[0-9]+[.]runs/, "N"));
      })()`)).filter(name => name !== "/icon.svg") };]=])
    local names = {}
    for i = 1, 4 do names[i] = said.list[i] end
    table.sort(names)
    assert.same({ "/frame/N", "/page.css", "/page.js", "/state.json" }, names)
    for i = 5, #said.list do -- the next news, and the same frame again
      assert.is_true(said.list[i] == "/state.json" or said.list[i] == "/frame/N", said.list[i])
    end
  end)

  it("asks for the picture of the values in its address at once in its size", function()
    watching.begin { ["shot.lua"] = [[
local celspan = require "celspan"
local p = celspan.parameters { size = { 3, min = 1, max = 9 } }
return celspan.film { size = { 64, 36 }, frame = function()
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9, 9 }, radius = p.size } } }
end }
]] }
    local said = watching.see(watching.watch() .. "#size=7", [=[
      await page.until(`document.querySelector("#canvas").dataset.build === "2"
        && !document.querySelector("[data-stale]")`);
      return page.get(`(({ searchParams: query }, { dataset }) => ({
        asked: [query.get("size"), query.get("crop"), query.get("build")],
        shown: [dataset.size, dataset.crop, dataset.build] }))(
          new URL(performance.getEntriesByType("resource").map(one => one.name)
            .find(name => name.includes("/frame/"))), document.querySelector("#canvas"))`);]=])
    assert.same(said.shown, said.asked)
  end)

  it("asks for the picture of a value together with it, and for all else afterwards", function()
    watching.begin { ["shot.lua"] = [[
local celspan = require "celspan"
local p = celspan.parameters { size = { 3, min = 1, max = 9 } }
return celspan.film { size = { 64, 36 }, frames = 48,
  frame = function()
    return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9, 9 }, radius = p.size } } }
  end }
]] }
    local said = watching.see(watching.watch(), [=[
      const canvasOf = `document.querySelector("#canvas")`;
      await page.until(`${canvasOf}.dataset.build > 0
        && performance.getEntriesByType("resource").some(one => one.name.includes("/wave.json"))`);
      await page.get(`(() => {
        const ask = window.fetch, { build, size } = ${canvasOf}.dataset, { width } = ${canvasOf};
        // a slow machine shows a coarse picture, too
        const nameOf = address => !address.includes("/frame/") ? address.replace(/[?].*/, "")
          : address.includes("?size=" + size + "&") ? "picture" : "coarse picture";
        window.said = [];
        window.drawn = 0;
        const note = (name, act) => {
          const own = CanvasRenderingContext2D.prototype[name];
          CanvasRenderingContext2D.prototype[name] = function(...given) {
            act(...given);
            own.apply(this, given);
          };
        };
        note("clearRect", () => { drawn++; });
        note("putImageData", image => { if (image.width === width) said.push("painted"); });
        history.replaceState = () => said.push("address");
        window.fetch = async (address, more) => {
          said.push("ask " + nameOf(address));
          const answer = await ask(address, more);
          said.push("answer " + nameOf(address));
          return answer;
        };
        new MutationObserver(() => {
          if (${canvasOf}.dataset.build !== build && !said.includes("seen")) {
            said.push("seen", drawn);
          }
        }).observe(${canvasOf}, { attributes: true });
        const field = document.querySelector("#form [name=size]");
        field.value = 7;
        field.dispatchEvent(new Event("input", { bubbles: true }));
      })()`);
      await page.until(`said.includes("ask /wave.json") && said.includes("address")`);
      return { list: await page.get("said") };]=])
    assert.equal("ask /parameters", said.list[1])
    assert.truthy(said.list[2]:find "^ask .*picture$", said.list[2])
    local count, at = {}, nil
    for i, what in ipairs(said.list) do
      if what == "seen" then at = i end
      count[what] = (count[what] or 0) + 1
      assert.is_true(at ~= nil or what ~= "ask /wave.json" and what ~= "address", what)
    end
    assert.equal(0, said.list[at + 1], "canvases that were drawn again before the picture")
    for _, what in ipairs { "ask /parameters", "ask picture", "painted", "address" } do
      assert.equal(1, count[what], what)
    end
  end)

  it("writes nothing again that a value has not changed", function()
    watching.begin { ["shot.lua"] = [[
local celspan = require "celspan"
local p = celspan.parameters { size = { 3, min = 1, max = 9 } }
return celspan.film { size = { 64, 36 }, frames = 48, marks = { bell = 40 }, frame = function()
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9, 9 }, radius = p.size } } }
end }
]] }
    local said = watching.see(watching.watch(), [=[
      const build = `Number(document.querySelector("#canvas").dataset.build)`;
      await page.until(`${build} > 0 && document.querySelector("#marks button")`);
      await page.get(`(() => {
        window.first = ${build};
        window.written = new Set();
        const look = list => list.forEach(({ target }) => written.add(target.id));
        new MutationObserver(look).observe(document, { subtree: true, childList: true,
                                                       attributes: true });
        const field = document.querySelector("#form [name=size]");
        field.value = 7;
        field.dispatchEvent(new Event("input", { bubbles: true }));
      })()`);
      await page.until(`${build} > first && !document.querySelector("[data-stale]")`);
      return { list: await page.get("[...written]") };]=])
    local written = {}
    for _, id in ipairs(said.list) do written[id] = true end
    assert.is_true(written.canvas)
    for _, id in ipairs { "marks", "shots", "title", "frame", "timecode", "zoom", "facts", "spot",
                          "compare", "render-state", "render-progress", "render-cancel", "mute",
                          "overlay" } do
      assert.is_nil(written[id], id)
    end
  end)
end)
