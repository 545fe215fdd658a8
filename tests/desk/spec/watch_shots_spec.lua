-- celspan watch: what it says of frames in which two shots are seen, as in a dissolve.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

-- A day and a night, both with a sky; a bird that only the day has, a lamp that only the night has.
local FILM = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function shot(colour, name, size)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function(f)
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 64, 36, texture = colour } }:named "sky",
      celspan.cel { celspan.circle { centre = { 20, 18 }, radius = size, texture = "#fd06" } }
        :named(name) }
  end }
end
return cut { { film = shot("#8cf", "bird", 4), name = "day" }, BETWEEN,
             { film = shot("#003", "lamp", 9), name = "night" } }
]]

after_each(watching.finish)

--- Starts the server of the film with this transition. Returns its address.
local function watch(between)
  watching.begin { ["shot.lua"] = (FILM:gsub("BETWEEN", between)) }
  return watching.watch()
end

--- The steps that list, of a server, the objects at points in frames, and the rows of the sheet.
local STEPS = [=[
  const get = async path => JSON.parse((await web.get(path)).body);
  const at = async (x, y, frame) => (await get(`/at/${x},${y}.json?frame=${frame}`))
    .map(one => [one.shot || "-", one.kind, one.name].join(" "));
  const rows = (await get("/sheet.json")).rows.map(one => [one.name, one.cel,
    one.cells.map(cell => cell.join(":")).join(" ")].join(", "));
  const tree = (await get("/objects.json?frame=18")).map(one => `${one.shot || "-"} ${one.name}`);
  return { rows, tree, first: await at(20, 18, 2), early: await at(20, 18, 14),
           late: await at(20, 18, 23), rim: await at(28, 18, 14), last: await at(20, 18, 30) };
]=]

local DAY = { "day object ", "day cel bird", "day object ", "day cel sky" }
local NIGHT = { "night object ", "night cel lamp", "night object ", "night cel sky" }

local function joined(...)
  local all = {}
  for _, list in ipairs { ... } do table.move(list, 1, #list, #all + 1, all) end
  return all
end

local ROWS = { "day / bird, day/bird, 1:1 25:", "day / sky, day/sky, 1:1 25:",
               "night / lamp, night/lamp, 13:1", "night / sky, night/sky, 13:1" }

describe("a dissolve", function()
  it("has the objects of both shots at a point, those that are seen more first", function()
    local said = watching.speak(watch "cut.dissolve(0.5)", STEPS)
    assert.same({ DAY, NIGHT }, { said.first, said.last })
    assert.same(joined(DAY, NIGHT), said.early)
    assert.same(joined(NIGHT, DAY), said.late)
    assert.same(joined({ DAY[3], DAY[4] }, NIGHT), said.rim)
  end)

  it("has the cels of each shot in its tree and in the sheet, and no others", function()
    local said = watching.speak(watch "cut.dissolve(0.5)", STEPS)
    assert.same(ROWS, said.rows)
    assert.same({ "day bird", "day sky", "night lamp", "night sky" }, said.tree)
  end)
end)

--- The hits that are of a shot: edges between shots are of none.
local function of_shots(hits)
  local list = {}
  for _, hit in ipairs(hits) do list[#list + 1] = not hit:find "^- " and hit or nil end
  return list
end

describe("a wipe", function()
  it("has the objects of the shot that is seen at a point, and rows of each shot", function()
    local said = watching.speak(watch "cut.wipe()(0.5)", STEPS)
    assert.same(ROWS, said.rows)
    assert.same({ DAY, NIGHT }, { said.first, said.last })
    assert.same({ DAY, NIGHT }, { of_shots(said.early), of_shots(said.late) })
  end)
end)

-- A square that moves under a shutter of five moments.
local SHUTTER = [[
local celspan = require "celspan"
local shutter = require "celspan.shutter"
return celspan.film { size = { 64, 36 }, frames = 9, frame = shutter { samples = 5,
  frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { 8 * f.time, 2, 8, 8 }:named "square" } }
end } }
]]

describe("a shutter", function()
  it("has each object once at a point", function()
    watching.begin { ["shot.lua"] = SHUTTER }
    local said = watching.speak(watching.watch(), [=[
      return (await web.get("/at/4,4.json?frame=1")).body;]=])
    assert.equal(2, #json.decode(said))
  end)
end)

describe("the page of celspan watch #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  it("names the shots of what it lists, and asks again in another frame", function()
    local said = watching.see(watch "cut.dissolve(0.5)", [=[
      await page.until(`${canvas("frame")} === "1"`);
      const spot = async (x, y) => page.get(`(() => { const box = document.querySelector("#canvas")
        .getBoundingClientRect(); return [box.left + box.width * ${x} / 64,
                                          box.top + box.height * ${y} / 36]; })()`);
      const go = async (frame, list) => {
        await page.press("g");
        await page.get(`document.querySelector("#number").value = "${frame}"`);
        await page.press("Enter");
        await page.until(`${canvas("frame")} === "${frame}"`);
      };
      const items = id => page.get(`[...document.querySelectorAll("#${id} li")]
        .map(one => one.textContent.replace(/ ?shot.lua.*/, ""))`);
      const place = () => text("place");
      await go(23);
      await page.press("q");
      await page.until(`document.querySelectorAll("[data-object]").length === 4`);
      const tree = await page.get(`[...document.querySelectorAll("#object-list li")]
        .map(one => one.dataset.object ?? "= " + one.textContent)`);
      const row = await page.get(`(() => { const box = document
        .querySelector("[data-object='night/lamp']").getBoundingClientRect();
        return [box.left + 9, box.top + 9]; })()`);
      await page.mouse("mouseMoved", ...row);
      await page.until(`!document.querySelector("#overlay").hidden
        && document.querySelector("#overlay").getContext("2d").getImageData(0, 0,
          document.querySelector("#overlay").width, document.querySelector("#overlay").height)
          .data.some(one => one > 0)`);
      await page.mouse("mouseMoved", ...await spot(20, 18));
      await page.until(`document.querySelector("#under").textContent === "night / lamp"`);
      const rim = await spot(26, 18);
      await page.press("p");
      await page.click(...rim);
      await page.until(`document.querySelectorAll("#hits li").length > 4`);
      const both = await items("hits"), first = await place();
      const mixed = await page.get(`document.querySelector("#hex").value`);
      await go(34);
      await page.until(`document.querySelector("#hits").textContent.startsWith("night")
        && !document.querySelector("#hits").textContent.includes("day")`);
      const last = await place(), plain = await page.get(`document.querySelector("#hex").value`);
      await page.press("Home");
      await page.until(`document.querySelectorAll("#hits li").length === 3`);
      return { tree, both, first, mixed, last, plain, day: await items("hits"),
               none: await page.get(`document.querySelector("#inspector").ariaBusy`) };]=])
    assert.same({ "= day", "day/bird", "day/sky", "= night", "night/lamp", "night/sky" }, said.tree)
    assert.same({ "night", "lamp, fill paint #ffdd00", "lamp (cel)", "sky, fill paint #000033",
                  "sky (cel)", "day", "sky, fill paint #88ccff", "sky (cel)" }, said.both)
    assert.same({ "day", "sky, fill paint #88ccff", "sky (cel)" }, said.day)
    assert.truthy(said.first:find ", frame 23$" and said.last:find ", frame 34$", said.last)
    assert.equal("#aa9227", said.plain)
    assert.not_equal(said.plain, said.mixed)
  end)
end)
