-- celspan watch: two scripts, or one with two sets of values, under one playhead.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { level = { 0, min = 0, max = 1 }, tint = { colour = "#cc0000" } }
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, frame = function(f)
  local share = f.index / 47
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = celspan.rgb(p.level, share, 0) } } }
end }
]]

-- Half the frames a second, fewer of them, and another shape.
local OTHER = [[
local celspan = require "celspan"
return celspan.film { size = { 32, 32 }, fps = 12, frames = 10, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 32, 32, texture = "#00f" } } }
end }
]]

before_each(function() watching.begin { ["shot.lua"] = FILM, ["other.lua"] = OTHER } end)
after_each(watching.finish)

describe("a second film that is watched", function()
  it("is asked for by side=2, and has errors of its own", function()
    local said = watching.speak(watching.watch "shot.lua other.lua", [=[
      const body = async path => (await web.get(path)).body;
      const film = [await body("/film.json"), await body("/film.json?side=2")];
      const byte = (await body("/frame/1.rgba?side=2")).charCodeAt(2);
      const many = (await web.get("/frame/11.png?side=2")).status;
      require("fs").writeFileSync("]=] .. watching.bench.folder .. [=[/other.lua", "return nil +");
      let errors = [];
      while (errors.length === 0) errors = JSON.parse(await body("/errors.json?side=2"));
      return { film, byte, many, errors, third: (await web.get("/film.json?side=3")).status,
               first: await body("/errors.json"),
               shown: (await web.get("/frame/1.png")).status };]=])
    assert.same({ 64, 36 }, json.decode(said.film[1]).size)
    assert.same({ 32, 32 }, json.decode(said.film[2]).size)
    assert.equal(255, said.byte)
    assert.equal("other.lua", said.errors[1].file)
    assert.equal("[]\n", said.first)
    assert.same({ 404, 404, 200 }, { said.many, said.third, said.shown })
  end)

  it("is not there until the page asks for it", function()
    local said = watching.speak(watching.watch(), [=[
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const post = async (path, value) => (await web.get(path,
        { method: "POST", headers, body: JSON.stringify(value) })).status;
      const film = async () => (await web.get("/film.json?side=2")).status;
      const wait = async () => { while (await film() === 409); };
      await web.get("/frame/1.png");
      const none = [await film(), await post("/parameters?side=2", { level: "1" })];
      await post("/compare", { on: true });
      await wait();
      const values = [await post("/parameters?side=2", { level: "1" }),
                      await post("/parameters?side=2", { level: "1", size: "1" }),
                      await post("/parameters?side=2", { level: 1 })];
      await wait();
      const red = async side => (await web.get(`/frame/1.rgba?side=${side}`)).body.charCodeAt(0);
      const reds = [await red(1), await red(2)];
      await post("/compare", { on: false });
      return { none, values, reds, after: await film() };]=])
    assert.same({ 404, 404 }, said.none)
    assert.same({ 200, 200, 400 }, said.values)
    assert.same({ 0, 255 }, said.reds)
    assert.equal(404, said.after)
  end)
end)

describe("the page of celspan watch with two films #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  local HELP = [[
    const beside = name => `document.querySelector("#canvas2").dataset.${name}`;
    const colour = id => page.get(`[...document.querySelector("#${id}").getContext("2d")
      .getImageData(3, 3, 1, 1).data].slice(0, 3)`);
    await page.until(`${canvas("frame")} === "1"`);
  ]]

  it("shows scripts at the same time of each, and an error over one alone", function()
    local said = watching.see(watching.watch "shot.lua other.lua", HELP .. [=[
      await page.until(`${beside("frame")} === "1"`);
      const at = async () =>
        [await page.get(canvas("frame")), await page.get(beside("frame"))].join();
      const seen = [];
      for (const other of [1, 2, 2, 3]) {
        await page.press("ArrowRight");
        await page.until(`${beside("frame")} === "${other}" && ${canvas("frame")} ===
          document.querySelector("#frame").textContent`);
        seen.push(await at());
      }
      await page.press("End");
      await page.until(`${beside("frame")} === "10" && ${canvas("frame")} === "48"`);
      const captions = [await text("caption"), await text("caption2")];
      const desks = await page.get(`["#desk", "#desk2"].map(id =>
        document.querySelector(id).getBoundingClientRect().width)`);
      page.write("]=] .. watching.bench.folder .. [=[/other.lua", "return nil +");
      await page.until(`!document.querySelector("#error2").hidden`);
      const old = await page.get(`["#canvas", "#canvas2"].map(id =>
        document.querySelector(id).classList.contains("old"))`);
      await page.press("y");
      await page.until(`document.querySelector("#desk2").hidden`);
      return { seen, captions, desks, old, blue: await colour("canvas2") };]=])
    assert.same({ "2,1", "3,2", "4,2", "5,3" }, said.seen)
    assert.same({ "shot.lua", "other.lua" }, said.captions)
    assert.is_true(math.abs(said.desks[1] - said.desks[2]) <= 2)
    assert.same({ false, true }, said.old)
    assert.same({ 0, 0, 255 }, said.blue)
  end)

  it("compares two sets of values, which the address holds", function()
    local address = watching.watch()
    local said = watching.see(address, HELP .. [=[
      const give = value => page.get(`(() => { const input = document.querySelector("#form2 input");
        input.value = ${value}; input.dispatchEvent(new Event("input")); })()`);
      await page.press("y");
      await page.until(`${beside("frame")} === "1" && document.querySelector("#form2 input")`);
      const same = await text("caption2");
      await give(1);
      await page.until(`document.querySelector("#canvas2").getContext("2d")
        .getImageData(3, 3, 1, 1).data[0] === 255`);
      await page.press("End");
      await page.until(`${beside("frame")} === "48" && ${canvas("frame")} === "48"`);
      const colours = [await colour("canvas"), await colour("canvas2")];
      const captions = [await text("caption"), await text("caption2")];
      await page.press("d");
      const difference = await colour("canvas");
      await page.press("d");
      for (let i = 0; i < 4; i++) {
        await page.press("y");
        await page.pause(0.1 * i);
      }
      await page.until(`${beside("frame")} === "48" && !document.querySelector("#desk2").hidden`);
      await page.press(" ");
      await page.pause(0.5);
      await page.press(" ");
      await page.until(`${beside("frame")} === ${canvas("frame")}
        && ${canvas("frame")} === document.querySelector("#frame").textContent`);
      const hash = await page.get("location.hash");
      const command = await page.get(`document.querySelector("#command").value`);
      await page.load();
      await page.until(`document.querySelector("#form2 input")?.value === "1"`);
      await page.until(`document.querySelector("#canvas2").getContext("2d")
        .getImageData(3, 3, 1, 1).data[0] === 255`);
      return { same, colours, captions, difference, hash, command };]=])
    assert.equal("the same values", said.same)
    assert.same({ { 0, 255, 0 }, { 255, 255, 0 } }, said.colours)
    assert.same({ "level 0", "level 1" }, said.captions)
    assert.same({ 255, 0, 0 }, said.difference)
    assert.equal("#2%3A=&2%3Alevel=1", said.hash)
    assert.equal("celspan render shot.lua -o shot.mp4\n"
      .. "celspan render shot.lua --set level=1 -o other.mp4", said.command)
  end)
end)
