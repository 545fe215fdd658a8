-- celspan watch: playing while hands, saves, errors and other windows get in its way.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end

-- The frames after GOOD fail.
local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, frame = function(f)
  assert(f.number <= GOOD, "no drawing of " .. f.number)
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { f.index, 9 }, radius = 4 } } }
end }
]]

local function film(good) return (FILM:gsub("GOOD", tostring(good))) end

--- Steps in the page of a film that is shown. The page counts the ticks, and those that wait for a
--- moment to draw, and keeps what was asked for: the number of the frame, the build, the status.
local function see(script, steps)
  watching.bench:inside "mkdir film"
  watching.bench:write("film/shot.lua", script)
  return watching.see(watching.watch "film/shot.lua", [=[
    const number = `Number(${canvas("frame")})`;
    const isWrong = `!document.querySelector("#error").hidden`;
    const shown = `Number(document.querySelector("#frame").textContent)`;
    const folder = "]=] .. watching.bench.folder .. [=[/film";
    const save = text => page.write(folder + "/shot.lua", text);
    await page.until(`${number} === 1`);
    await page.get(`(() => {
      window.most = window.ticks = 0;
      window.asked = [];
      const real = window.fetch, next = window.requestAnimationFrame, waiting = new Set();
      window.fetch = async (address, more) => {
        const frame = /^.frame.([0-9]+).*build=([0-9]+)/.exec(address);
        const one = frame && { number: Number(frame[1]), build: Number(frame[2]) };
        if (one) asked.push(one);
        const answer = await real(address, more);
        if (one) one.status = answer.status;
        return answer;
      };
      window.requestAnimationFrame = act => {
        if (act.name === "tick") {
          ticks++;
          waiting.add(act = act.bind(null));
        }
        most = Math.max(most, waiting.size);
        return next(now => { waiting.delete(act); act(now); });
      };
    })()`);]=] .. steps)
end

before_each(function() watching.begin {} end)
after_each(watching.finish)

describe("playing in the page of celspan watch #plain", function()
  it("is one chain of ticks, however quickly it is begun, ended and changed", function()
    local said = see(film(48), [=[
      await page.get(`(() => {
        const press = key => document.body.dispatchEvent(
          new KeyboardEvent("keydown", { key, bubbles: true }));
        for (let i = 0; i < 20; i++) {
          for (const key of ["k", "k", "k", "l", "l", "j", "i", "x", "ArrowRight", "l"]) press(key);
        }
      })()`);
      await page.until(`${number} > 30`);
      await page.press("k");
      const name = await page.get(`document.querySelector("#play").ariaLabel`);
      await page.press("j");
      await page.until(`${number} < 20`);
      return { most: await page.get("most"), name };]=])
    assert.same({ most = 1, name = "Play" }, said)
  end)

  it("asks for a moment to draw only when there is a frame to show", function()
    local said = see((film(48):gsub("fps = %d+", "fps = 4")), [=[
      await page.get(`(() => {
        window.shown = window.ticks = 0;
        new MutationObserver(records => { shown += records.length; }).observe(
          document.querySelector("#canvas"), { attributeFilter: ["data-frame"] });
      })()`);
      await page.press("l");
      await page.until("shown >= 8");
      await page.press("k");
      return page.get("({ shown, ticks })");]=])
    -- the first tick shows the frame that is there
    assert.is_true(said.ticks <= said.shown + 1, said.ticks)
  end)

  it("continues over frames that fail, shows their errors, and asks for each once", function()
    local said = see(film(24), [=[
      await page.press("l");
      const errors = [];
      for (let lap = 0; lap < 3; lap++) {
        await page.until(`${isWrong} && ${shown} > 24`);
        errors.push(await text("error"), await page.get(`${number} <= 24`));
        await page.until(`!${isWrong} && ${shown} <= 24 && ${number} <= 24`);
      }
      const name = await page.get(`document.querySelector("#play").ariaLabel`);
      return { errors, name, twice: await page.get(`(list => list.filter((one, i) =>
        list.indexOf(one) < i))(asked.filter(one => one.status === 422).map(one => one.number))`) };
    ]=])
    for lap = 1, 3 do
      assert.truthy(said.errors[2 * lap - 1]:find "no drawing of %d+$", said.errors[2 * lap - 1])
      assert.is_true(said.errors[2 * lap])
    end
    assert.same({ "Pause", {} }, { said.name, said.twice })
  end)

  it("asks for nothing while nobody can see it, and continues where the clock is", function()
    local said = see((film(9999):gsub("frames = 48", "frames = 9999")), [=[
      const { windowId } = await page.call("Browser.getWindowForTarget");
      const turn = async (windowState, isHidden) => {
        await page.call("Browser.setWindowBounds", { windowId, bounds: { windowState } });
        await page.until(`document.hidden === ${isHidden}`);
      };
      await page.press("l");
      await page.until(`${number} > 3`);
      const before = await page.get(shown);
      await turn("minimized", true);
      await page.until("asked.every(one => one.status)");
      const count = await page.get("asked.length");
      await page.pause(2);
      const more = await page.get("asked.length") - count;
      await turn("normal", false);
      await page.until(`${number} > ${before + 48}`);
      return { more, jump: await page.get(`asked[${count}].number`) - before };]=])
    assert.equal(0, said.more)
    assert.is_true(said.jump >= 48, said.jump)
  end)

  it("continues after saves in quick succession, most of them broken", function()
    local said = see(film(48), ([=[
      const good = %q, short = good.replace("frames = 48", "frames = 12");
      const broken = ["return nil +", "error 'no film'", good.replace("36 }", "0 }"),
                      good.replace("<= 48", "<= 0"), "while true do", ""];
      for (const [key, last, count] of [["l", good, 48], ["j", short, 12], ["l", good, 48]]) {
        await page.press(key);
        for (let i = 0; i < 24; i++) {
          save(i %% 4 ? broken[i %% broken.length] : good);
          await page.pause(0.02 * (i %% 5));
        }
        save("return nil +");
        await page.until(`${isWrong} && document.querySelector("#error").textContent
          .includes("unexpected symbol")`);
        const build = await page.get(`Number(${canvas("build")})`);
        save(last);
        await page.until(`document.querySelector("#frames").textContent === "${count}"
          && !${isWrong} && Number(${canvas("build")}) > ${build}
          && asked.some(one => one.status === 200 && one.number > 1 && one.build > ${build})`);
        const first = await page.get(number);
        await page.until(`${number} !== ${first}`);
      }
      await page.until(`${number} > 30`);
      return { name: await page.get(`document.querySelector("#play").ariaLabel`),
               most: await page.get("most") };]=]):format(film(48)):gsub("\\\n", "\\n"))
    assert.same({ name = "Pause", most = 1 }, said)
  end)

  it("continues after the folder of the film was removed, and a render into it leaves nothing",
    function()
      local said = see((film(1000000):gsub("frames = 48", "frames = 1000000")), [=[
        const fs = require("fs"), good = fs.readFileSync(folder + "/shot.lua", "utf8");
        const state = `document.querySelector("#render-state").dataset.state`;
        const click = id => page.get(`document.querySelector("#${id}").click()`);
        await page.press("l");
        await click("render");
        await click("render-start");
        await page.until(`/^frame [1-9]/.test(
          document.querySelector("#render-words").textContent)`);
        fs.rmSync(folder, { recursive: true });
        await page.until(isWrong);
        const error = await text("error");
        await click("render-cancel");
        await page.until(`["cancelled", "failed"].includes(${state})`);
        await click("render-start");
        await page.until(`${state} === "failed"`);
        const words = await text("render-words");
        fs.mkdirSync(folder);
        save(good);
        await page.until(`!${isWrong}`);
        const first = await page.get(number);
        await page.until(`${number} !== ${first}`);
        return { error, words, left: fs.readdirSync(folder) };]=])
      local missing = "cannot open film/shot.lua: No such file or directory"
      assert.same({ error = missing, words = missing, left = { "shot.lua" } }, said)
    end)
end)
