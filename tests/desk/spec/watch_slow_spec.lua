-- celspan watch: frames that are slow.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"
local workbench = require "tests.support.workbench"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

--- A film whose frames take as long as they have rows: `steps` for each, 16 times in a pixel.
local function film(steps)
  return ([[
local celspan = require "celspan"
local function slow()
  local sum = 0
  for i = 1, %d do sum = sum + i end
  return { { 0, 640, "#00ff00" } }
end
return celspan.film { size = { 640, 360 }, frames = 99, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.scanline { bounds = { 0, 0, 640, 360 }, spans = slow } } }
end }
]]):format(steps)
end

--- A film that threads draw.
local DRAWN = [[
local celspan = require "celspan"
return celspan.film { size = { 640, 360 }, frames = 9, frame = function(f)
  local discs = {}
  for i = 1, 300 do
    discs[i] = celspan.circle { centre = { 2 * i, 180 }, radius = 90 - f.number, texture = "#f00" }
  end
  return celspan.rostrum { celspan.cel(discs) }
end }
]]

--- A request for a frame of a width, as a renderer reads it.
local function wanted(number, width)
  local ask = '{ "want": "frame", "number": %d, "size": [%d, 9], "crop": [0, 0, %d, 9],'
    .. ' "what": "rgba" }'
  return (">s4"):pack(ask:format(number, width, width))
end

--- A request as a renderer reads it, and that it is given up.
local function abandoned(text) return (">s4I4"):pack(text, 1 << 24 | 1) end

after_each(watching.finish)

describe("a slow frame", function()
  it("is given up when it is not wanted any more #plain", function()
    watching.begin { ["shot.lua"] = film(50000) }
    local said = watching.speak(watching.watch(), [=[
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const abandon = async (body, more = headers) => (await web.get("/abandon",
        { method: "POST", headers: more, body: JSON.stringify(body) })).status;
      const pause = seconds => new Promise(done => setTimeout(done, 1000 * seconds));
      await web.get("/frame/1.png?size=8x8");
      const wanted = ["a", "b", "c"].map(wish =>
        web.get(`/frame/1.rgba?size=1280x720&wish=${wish}`));
      await pause(0.3);
      const posts = [await abandon({ wish: "a" }), await abandon({ wish: "b" }),
                     await abandon({ wish: "c" }), await abandon({}),
                     await abandon({ wish: "none" }), await abandon({ wish: "a" }, {})];
      let done = false;
      const all = Promise.all(wanted).finally(() => { done = true; });
      while (!done) { // a request may have arrived after it was abandoned, on a busy machine
        await pause(0.2);
        for (const wish of ["a", "b", "c"]) await abandon({ wish });
      }
      const answers = (await all).map(one => one.status);
      return { posts, answers,
               next: (await web.get("/frame/2.png?size=8x8")).status,
               errors: (await web.get("/errors.json")).body };]=])
    assert.same({ 200, 200, 200, 400, 200, 403 }, said.posts)
    assert.same({ 503, 503, 503 }, said.answers)
    assert.equal(200, said.next)
    assert.equal("[]\n", said.errors)
  end)

  it("is given up when both requests arrive before the renderer has begun #plain", function()
    watching.begin { ["shot.lua"] = film(50000), asks = abandoned [[
      { "want": "frame", "number": 1, "size": [1280, 720], "crop": [0, 0, 1280, 720],
        "what": "rgba" }]] }
    local code, out = watching.bench:inside(("{ cat asks; sleep 2; } | '%s' stage shot.lua")
      :format(workbench.absolute))
    assert.equal(0, code)
    local _, at = (">s4"):unpack(out)
    local _, head = (">I4s4"):unpack(out, at)
    local rows = json.decode(head).message:match "stopped after (%d+) of 720 rows"
    assert.is_true(tonumber(rows) <= 64, head) -- in two seconds there are some hundreds
  end)

  it("holds no picture back that was begun before it #plain", function()
    local endless = DRAWN:gsub("  local discs", "  while f.number == 2 do end\n%0")
    watching.begin { asks = wanted(1, 90) .. wanted(2, 90), ["shot.lua"] = endless }
    local code = watching.bench:inside(([[{
      { cat asks; exec sleep 60; } 2>/dev/null |
        '%s' stage shot.lua --limit time=600,steps=0 >answers 2>/dev/null &
      timeout 60 sh -c 'until grep -aq picture answers; do sleep 0.02; done'
      code=$?; kill $!; exit $code; }]]):format(workbench.absolute))
    assert.equal(0, code)
  end)

  it("is left when there are no more requests #plain", function()
    local asks = wanted(1, 4000) .. wanted(3, 4000) .. wanted(4, 90)
    watching.begin { asks = asks, ["shot.lua"] = DRAWN }
    for _ = 1, 5 do
      local code = watching.bench:inside(("'%s' stage shot.lua --workers 2 <asks >answers")
        :format(workbench.absolute))
      assert.equal(0, code)
    end
  end)

  it("is shown coarse first, then sharp, and gives way to the next one #plain", function()
    if not present.program "chromium" then return pending "there is no chromium" end
    watching.begin { ["shot.lua"] = film(4000) }
    local said = watching.see(watching.watch(), [=[
      await page.get(`(() => {
        window.seen = [];
        const { dataset } = document.querySelector("#canvas");
        new MutationObserver(() => {
          const now = dataset.frame + " " + dataset.size;
          if (dataset.size && window.seen.at(-1) !== now) window.seen.push(now);
        }).observe(document.querySelector("#canvas"), { attributes: true });
      })()`);
      const sharp = frame => page.until(`${canvas("frame")} === "${frame}"
        && ${canvas("size")}.split("x")[0] > 1000`);
      await sharp(1);
      await page.press("ArrowRight");
      await sharp(2);
      const first = await page.get("window.seen");
      await page.press("ArrowRight");
      await page.until(`${canvas("frame")} === "3"`);
      await page.press("ArrowRight");
      await page.pause(0.2);
      await page.press("ArrowRight");
      await sharp(5);
      return { first, seen: await page.get("window.seen"), fault: await text("error") };]=])
    local sizes = {}
    for _, one in ipairs(said.seen) do
      local frame, width = one:match "^(%d+) (%d+)x"
      sizes[frame] = (sizes[frame] or "") .. (tonumber(width) > 1000 and "S" or "c")
    end
    assert.equal("cS", sizes["2"])
    assert.equal("c", sizes["3"])
    assert.equal("cS", sizes["5"])
    assert.equal("", said.fault)
  end)

  it("is played smaller, at most a third, and is sharp where films are compared or it stops #plain",
    function()
      if not present.program "chromium" then return pending "there is no chromium" end
      watching.begin { ["shot.lua"] = film(4000) }
      local said = watching.see(watching.watch(), [=[
        const width = `Number(${canvas("size")}?.split("x")[0])`;
        await page.until(`${width} > 1000 && ${canvas("stale")} === undefined`);
        const whole = await page.get(width);
        const isSmall = `${width} === ${Math.ceil(whole / 3)}
          && document.querySelector("#rate").textContent.endsWith(" fps 1/3 size")`;
        const isSharp = `${width} === ${whole}
          && document.querySelector("#rate").textContent.endsWith(" fps")`;
        await page.press("l");
        await page.until(isSmall);
        await page.press("w");
        await page.until(isSharp);
        await page.press("w");
        await page.until(isSmall);
        await page.get(`(() => {
          window.seen = [];
          new MutationObserver(() => seen.push(${width})).observe(
            document.querySelector("#canvas"), { attributeFilter: ["data-size"] });
          document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "k", bubbles: true }));
        })()`);
        await page.until(`${width} === ${whole} && ${canvas("stale")} === undefined`);
        const seen = await page.get("seen"), rate = await text("rate");
        for (const key of ["i", "ArrowRight", "o", "l"]) await page.press(key);
        await page.until(isSharp); // all of a short loop can be kept
        return { whole, seen, rate };]=])
      assert.same({ said.whole }, said.seen)
      assert.equal("", said.rate)
    end)
end)
