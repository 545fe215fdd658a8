-- celspan watch: the sound of a film, for programs and in its page.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end
if not present.program "ffmpeg" then return pending "there is no ffmpeg" end

local FILM = [[
local celspan = require "celspan"
local lips = require "celspan.lips"
local mouth = assert(lips.read("line.tsv", { fps = 24 }))
return celspan.film { title = "Voice", size = { 64, 36 }, fps = 24, frames = 96,
  sound = { "tone.wav", at = 1 }, marks = { half = 49 }, frame = function(f)
    local x = mouth:at(f.number) == "A" and 10 or 30
    return celspan.rostrum { celspan.cel { celspan.rect { x, 10, 8, 8, texture = "#c33" } } }
  end }
]]

--- Seconds of the sample 16,384 in one channel.
local function tone(seconds)
  local data = ("<i2"):pack(16384):rep(seconds * 48000)
  return ("<c4I4c4c4I4I2I2I4I4I2I2c4I4"):pack("RIFF", 36 + #data, "WAVE", "fmt ", 16, 1, 1, 48000,
    96000, 2, 16, "data", #data) .. data
end

before_each(function()
  watching.begin { ["shot.lua"] = FILM, ["tone.wav"] = tone(2),
                   ["line.tsv"] = "0.00\tX\n1.00\tA\n2.00\tD\n3.00\tX\n" }
end)

after_each(watching.finish)

describe("the sound of celspan watch", function()
  it("is what celspan sound writes, whole or of a run of frames", function()
    local said = watching.speak(watching.watch(), [=[
      const get = async path => {
        const answer = await web.get(path);
        return [answer.status, Buffer.from(answer.body, "latin1").toString("base64")];
      };
      return { all: await get("/sound.wav"), part: await get("/sound.wav?frames=13-36"),
               bad: await web.statuses(["frames=3-1", "frames=0-3", "frames=1-97", "frames=x"]
                 .map(query => [`/sound.wav?${query}&token=${web.token}`])),
               wave: (await web.get("/wave.json?columns=8")).body };]=])
    local bench = watching.bench
    bench:celspan_inside "sound shot.lua -o all.wav"
    bench:celspan_inside "sound shot.lua -o part.wav --frames 13-36"
    for name, answer in pairs { all = said.all, part = said.part } do
      assert.equal(200, answer[1])
      bench:write("said.base64", answer[2])
      bench:inside "base64 -d said.base64 >said.wav"
      local code = bench:inside(("cmp said.wav %s.wav"):format(name))
      assert.equal(0, code, name)
    end
    assert.same({ 400, 404, 404, 400 }, said.bad)
    local wave = json.decode(said.wave)
    assert.same({ 0, 0, 127, 127, 127, 127, 0, 0 }, wave.columns)
    assert.same({ { name = "line.tsv", cells = { { 1, "X" }, { 25, "A" },
                                                 { 49, "D" } } } }, wave.lips)
  end)

  it("is read again when its file is saved", function()
    watching.bench:write("short.wav", tone(1))
    local said = watching.speak(watching.watch(), [=[
      const state = async () => JSON.parse((await web.get("/state.json")).body);
      await web.get("/sound.wav");
      const before = (await state()).build;
      const folder = "]=] .. watching.bench.folder .. [=[";
      require("fs").copyFileSync(folder + "/short.wav", folder + "/tone.wav");
      for (;;) {
        const now = await state();
        if (now.build > before && now.shown) break;
        await web.pause(0.05);
      }
      const { columns } = JSON.parse((await web.get("/wave.json?columns=8")).body);
      return columns;]=])
    assert.same({ 0, 0, 127, 127, 0, 0, 0, 0 }, said)
  end)

  it("is not there where the film has none", function()
    watching.bench:write("shot.lua", (FILM:gsub('sound = .- }, ', "", 1)))
    local said = watching.speak(watching.watch(), [=[
      const { body } = await web.get("/wave.json");
      return { status: (await web.get("/sound.wav")).status,
               film: (await web.get("/film.json")).body, columns: JSON.parse(body).columns };]=])
    assert.equal(404, said.status)
    assert.is_false(json.decode(said.film).sound)
    assert.same({}, said.columns)
  end)
end)

describe("the page of celspan watch with a sound #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  it("plays it in step with the picture, one frame of it at a step, and is quiet on demand",
    function()
      local said = watching.see(watching.watch(), [=[
        // What is started, and how loud it begins.
        await page.get(`(() => {
          window.heard = [];
          const start = AudioBufferSourceNode.prototype.start;
          AudioBufferSourceNode.prototype.start = function(when, offset, duration) {
            const from = Math.round(offset * 48000);
            heard.push({ when, offset, duration, level: this.buffer.getChannelData(0)[from] });
            start.call(this, when, offset, duration);
          };
        })()`);
        await page.until(`${canvas("frame")} === "1"`);
        await page.press("g");
        await page.get(`document.querySelector("#number").value = "30"`);
        await page.press("Enter");
        await page.until(`heard.length === 1`);
        const tap = await page.get("heard[0]");
        await page.press("Home");
        await page.until(`heard.length === 2`);
        await page.get("heard.length = 0");
        await page.press(" ");
        await page.until(`Number(${canvas("frame")}) > 20`);
        const played = await page.get("heard[0]");
        await page.press("u");
        const before = await page.get("heard.length");
        await page.pause(0.7);
        await page.press(" ");
        await page.press("ArrowRight");
        await page.pause(0.3);
        return { tap, played, more: await page.get("heard.length") - before,
                 pressed: await page.get(`document.querySelector("#mute").ariaPressed`) };]=])
      assert.is_true(math.abs(said.tap.offset - 29 / 24) < 1e-6)
      assert.is_true(math.abs(said.tap.duration - 1 / 24) < 1e-6)
      assert.equal(0.5, said.tap.level)
      -- The first that is heard is of the place of the picture, which began before.
      assert.is_true(said.played.offset < 0.8, said.played.offset)
      assert.equal(0, said.more)
      assert.equal("true", said.pressed)
    end)

  it("draws its wave, the marks and the mouths in the timeline", function()
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("s");
      await page.until(`document.querySelectorAll("#names li").length === 2`);
      await page.until(`document.querySelector("#timeline").ariaBusy === "false"`);
      const drawn = await page.get(`(() => { const wave = document.querySelector("#wave");
        const brush = wave.getContext("2d"), r = devicePixelRatio;
        const at = x => brush.getImageData(Math.round(x * wave.width), 8 * r, 1, 1).data[3];
        return [at(0.1), at(0.4), at(0.6), at(0.9)]; })()`);
      return { drawn, mark: await page.get(`document.querySelector("[data-mark=half]")
                 .dataset.frame`),
               names: await page.get(`[...document.querySelectorAll("#names li")]
                 .map(one => one.title).join("\\n")`) };]=])
    assert.equal("cel 1\nline.tsv", said.names)
    assert.equal("49", said.mark)
    for i, is_drawn in ipairs { false, true, true, false } do
      assert.equal(is_drawn, said.drawn[i] > 0, i)
    end
  end)
end)
