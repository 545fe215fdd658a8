-- celspan watch: the proposals of its form of a render, and words about renders and hidden cels.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end
if not present.program "chromium" then return pending "there is no chromium" end

-- Two shots with a dissolve, 36 frames in all, and two marks.
local FILM = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function shot(colour)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function()
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 64, 36, texture = colour } }:named "sky",
      celspan.cel { celspan.circle { centre = { 20, 18 }, radius = 6 } }:named "sun" }
  end }
end
return cut { { film = shot "#8cf", name = "day" }, cut.dissolve(0.5),
             { film = shot "#003", name = "night" }, marks = { gull = 5, storm = 20 } }
]]

-- Steps that open the form, choose in it as a hand does, and read it.
local HELP = [=[
  await page.until(`${canvas("frame")} === "1"`);
  const field = name => `document.querySelector("#render-form").elements.${name}`;
  const value = name => page.get(`${field(name)}.value`);
  const choose = (name, value) => page.get(`(() => { const one = ${field(name)};
    one.value = ${JSON.stringify(value)};
    for (const kind of ["input", "change"]) one.dispatchEvent(new Event(kind, { bubbles: true }));
  })()`);
  const click = id => page.get(`document.querySelector("${id}").click()`);
  const state = wanted => page.until(
    `document.querySelector("#render-state").dataset.state === "${wanted}"`);
  const wish = async () =>
    [await value("format"), await value("range"), await value("file")].join(" ");
]=]

before_each(function() watching.begin { ["shot.lua"] = FILM } end)
after_each(watching.finish)

describe("the form of a render #plain", function()
  it("proposes a picture for a frame, and offers shots, marks and a loop where there are some",
    function()
      local said = watching.see(watching.watch(), HELP .. [=[
        await click("#render");
        const options = await page.get(`[...${field("range")}.options]
          .filter(one => !one.disabled).map(one => one.textContent + "=" + one.value)`);
        const seen = [await wish()], size = await value("size");
        await choose("range", "frame"); seen.push(await wish());
        await page.get("document.activeElement.blur()");
        await page.press("ArrowRight");
        await page.until(`${field("file")}.value.includes("2")`); seen.push(await wish());
        await choose("range", "13-36"); seen.push(await wish());
        const command = await page.get(`document.querySelector("#render-command").value`);
        await choose("format", "png"); seen.push(await wish());
        await choose("range", "frame"); await choose("range", "all"); seen.push(await wish());
        await choose("file", "mine.####.png"); await choose("range", "frame");
        seen.push(await wish());
        await choose("range", "20-36");
        await click("#render");
        await page.get("document.activeElement.blur()");
        await page.press("ArrowRight"); await page.press("i");
        await click("#render");
        const loop = await page.get(`[...${field("range")}.options]
          .some(one => one.value === "loop" && !one.disabled && !one.hidden)`);
        const place = await text("render-place");
        return { options, seen, size, place, command, loop, kept: await value("range") };]=])
      assert.same({ "the whole film=all", "this frame=frame", "day=1-24", "night=13-36",
        "the beginning to gull=1-4", "gull to storm=5-19", "storm to the end=20-36" }, said.options)
      assert.same({ "mp4 all shot.mp4", "png frame shot.0001.png", "png frame shot.0002.png",
        "mp4 13-36 shot.13-36.mp4", "png 13-36 shot.####.png", "png all shot.####.png",
        "png frame mine.0002.png" }, said.seen)
      assert.equal("celspan render shot.lua --frames 13-36 -o shot.13-36.mp4", said.command)
      assert.equal("64x36", said.size)
      assert.equal("Beside the script; a file that is there is replaced only after a question.",
        said.place)
      assert.same({ true, "20-36" }, { said.loop, said.kept })
    end)

  it("proposes the size of the film, and says where the file will be", function()
    watching.bench:shell(("mkdir %s/out"):format(watching.bench.folder))
    local said = watching.see(watching.watch "shot.lua --size 32x18 -o out/", HELP .. [=[
      await click("#render");
      return { size: await value("size"), place: await text("render-place"),
               command: await page.get(`document.querySelector("#render-command").value`) };]=])
    assert.equal("64x36", said.size)
    assert.truthy(said.place:find("^In out/; "), said.place)
    assert.equal("celspan render shot.lua -o out/shot.mp4", said.command)
  end)

  it("forgets what it said of the render before, and says on its button how one has ended",
    function()
      local said = watching.see(watching.watch(), HELP .. [=[
        const words = () => text("render-words");
        const button = () => page.get(`document.querySelector("#render span").textContent`);
        await click("#render");
        await choose("format", "png"); await choose("range", "frame");
        await choose("size", "wide");
        await click("#render-start"); await state("failed");
        const bad = await words();
        await choose("size", "32x18"); await state("idle");
        await click("#render-start"); await state("done");
        const good = await words();
        await choose("file", "other.png"); await state("idle");
        await choose("size", "none"); await click("#render-start"); await state("failed");
        await choose("size", "16x9");
        await click("#render-start");
        await click("#render");
        await page.until(`document.querySelector("#render span").textContent === "Written"`);
        await click("#render");
        const opened = await button();
        await state("done");
        return { bad, good, opened, last: await words() };]=])
      assert.equal("write the size as 1280x720", said.bad)
      assert.same({ "written: shot.0001.png", "written: other.png" }, { said.good, said.last })
      assert.equal("Render", said.opened)
      assert.truthy(watching.bench:read "other.png")
    end)

  it("says that cels are hidden here, and the page marks it until all are shown", function()
    local said = watching.see(watching.watch(), HELP .. [=[
      const note = () => page.get(`(one => one.hidden ? "" : one.textContent)(
        document.querySelector("#render-note"))`);
      const marks = () => page.get(`[...document.querySelectorAll(".altered")].map(one => one.id)`);
      await click("#outliner");
      await page.until(`document.querySelectorAll("[data-object]").length === 2`);
      await click("#render");
      const first = [await note(), ...await marks()];
      const press = what => page.get(`document.querySelector("[aria-label='" + ${
        JSON.stringify(what)} + ": day/sun']").click()`);
      await press(await page.get(`document.querySelector("[data-object='day/sun'] .without")
        .ariaLabel.split(":")[0]`));
      const hidden = [await note(), ...await marks()], altered = await text("altered-words");
      await click("#altered-reset");
      return { first, hidden, altered, last: [await note(), ...await marks()] };]=])
    assert.same({ "" }, said.first)
    assert.same({ "1 cel is hidden here; the render has all as they are.", "view", "outliner" },
      said.hidden)
    assert.equal("1 cel is hidden.", said.altered)
    assert.same({ "" }, said.last)
  end)
end)
