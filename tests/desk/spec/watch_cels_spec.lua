-- celspan watch: the labels of cels in the tree of a frame, by which they are shown in another way.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

-- Two shots with half a second of a dissolve between them. Each has a left half, and a right half
-- without a name; PARTS: what else the cut has.
local CUT = [[
local celspan = require "celspan"
local cut = require "celspan.cut"
local function shot(colour)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function()
    return celspan.rostrum {
      celspan.cel { celspan.rect { 0, 0, 32, 36, texture = colour } }:named "nell",
      celspan.cel { celspan.rect { 32, 0, 32, 36, texture = "#fff" } } }
  end }
end
return cut { { film = shot "#f00", name = "evening" }, cut.dissolve(0.5), shot "#00f" PARTS }
]]

-- A square that moves under a shutter of several moments, and a ground.
local SHUTTER = [[
local celspan = require "celspan"
local shutter = require "celspan.shutter"
return celspan.film { size = { 64, 36 }, frames = 9, frame = shutter { samples = 5,
  frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#ccc" } },
    celspan.cel { celspan.rect { 8 * f.time, 2, 8, 8, texture = "#f00" }:named "square" } }
end } }
]]

after_each(watching.finish)

--- What a server says of a script: the colours of a pixel in frames with cels changed, and the
--- trees of frames, each as a list of "depth kind name label".
local HELP = [=[
  const colour = async (number, cels, x, y) => {
    const query = `size=64x36&cels=${encodeURIComponent(JSON.stringify(cels))}`;
    const { status, body } = await web.get(`/frame/${number}.rgba?${query}`), at = 4 * (64 * y + x);
    return status !== 200 ? [status] : [0, 1, 2, 3].map(i => body.charCodeAt(at + i));
  };
  const tree = async number => JSON.parse((await web.get(`/objects.json?frame=${number}`)).body)
    .map(one => [one.depth, one.kind, one.name, one.label || "-"].join(" "));
]=]

local function speak(script, steps)
  watching.begin { ["shot.lua"] = script }
  return watching.speak(watching.watch(), HELP .. steps)
end

describe("the cels of a frame", function()
  it("are once in the tree, whatever the number of exposures, and have labels", function()
    local said = speak(SHUTTER, [=[
      return { tree: await tree(2), hidden: await colour(2, { "cel 1": "h" }, 60, 30),
               shown: await colour(2, { "cel 2": "h" }, 60, 30) };]=])
    assert.same({ "0 cel  cel 2", "1 object square -", "0 cel  cel 1" }, said.tree)
    assert.same({ 0, 0, 0, 0 }, said.hidden)
    assert.equal(255, said.shown[4])
  end)

  it("are those of shots in a cut, where a label begins with the shot", function()
    local said = speak(CUT:gsub("PARTS", ""), [=[
      return { first: await tree(2), both: await tree(18), last: await tree(30),
               sheet: JSON.parse((await web.get("/sheet.json")).body).rows
                 .filter(one => one.cel).map(one => one.cel),
               hidden: await colour(2, { "evening/nell": "h", "shot 2/nell": "h" }, 9, 9),
               whole: await colour(2, { "shot 2/nell": "h", "shot 2/cel 2": "h" }, 9, 9),
               white: await colour(2, { "evening/cel 2": "h" }, 50, 9),
               plain: await colour(2, { nell: "h" }, 9, 9),
               half: await colour(18, { "evening/cel 2": "h" }, 50, 9) };]=])
    local evening = { "0 cel  evening/cel 2", "0 cel nell evening/nell" }
    local second = { "0 cel  shot 2/cel 2", "0 cel nell shot 2/nell" }
    assert.same(evening, said.first)
    assert.same({ evening[1], evening[2], second[1], second[2] }, said.both)
    assert.same(second, said.last)
    assert.same({ "evening/cel 2", "evening/nell", "shot 2/cel 2", "shot 2/nell" }, said.sheet)
    assert.same({ 0, 0, 0, 0 }, said.hidden)
    assert.same({ 255, 0, 0, 255 }, said.whole)
    assert.same({ 0, 0, 0, 0 }, said.white)
    assert.same({ 0, 0, 0, 0 }, said.plain)
    assert.is_true(said.half[4] > 0 and said.half[4] < 255)
  end)

  it("are those of shots also below what lies over them", function()
    local over = [[, over = function()
      return celspan.cel { celspan.rect { 0, 0, 4, 4, texture = "#0f0" } }:named "sign" end]]
    local said = speak((CUT:gsub("PARTS", function() return over end)), [=[
      return { tree: await tree(2), hidden: await colour(2, { "evening/nell": "h" }, 9, 9),
               rest: await colour(2, { "evening/nell": "h" }, 50, 9),
               sign: await colour(2, { "evening/nell": "h" }, 1, 1),
               none: await colour(2, { sign: "h" }, 1, 1),
               sheet: JSON.parse((await web.get("/sheet.json")).body).rows
                 .map(one => `${one.name} ${one.cel}`).filter(one => !/undef/.test(one)) };]=])
    assert.same({ "0 cel sign sign", "0 cel  evening/cel 2", "0 cel nell evening/nell" }, said.tree)
    assert.same({ 0, 0, 0, 0 }, said.hidden)
    assert.same({ 255, 255, 255, 255 }, said.rest)
    assert.same({ 0, 255, 0, 255 }, said.sign)
    assert.same({ 255, 0, 0, 255 }, said.none)
    assert.same({ "evening / sign sign", "evening / cel 2 evening/cel 2",
                  "evening / nell evening/nell", "shot 2 / sign sign",
                  "shot 2 / cel 2 shot 2/cel 2", "shot 2 / nell shot 2/nell" }, said.sheet)
  end)
end)

-- A ground, a ball that moves, and a box that moves behind it.
local ONION = [[
local celspan = require "celspan"
return celspan.film { size = { 64, 36 }, frames = 9, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#fff" } }:named "ground",
    celspan.cel { celspan.rect { 8 * f.number - 8, 24, 8, 8, texture = "#000" } },
    celspan.cel { celspan.rect { 8 * f.number - 8, 4, 8, 8, texture = "#000" } }:named "ball" }
end }
]]

describe("the onion skin of a frame", function()
  it("is that of a render, of all cels but grounds or of those that are chosen", function()
    local said = speak(ONION, [=[
      const all = (await web.get("/frame/3.png?size=64x36&onion=1,1")).body;
      require("fs").writeFileSync(process.argv[3] + ".png", Buffer.from(all, "latin1"));
      const pixel = async (query, x, y) => {
        const { status, body } = await web.get(`/frame/3.rgba?size=64x36&onion=${query}`);
        const at = 4 * (64 * y + x);
        return status !== 200 ? [status] : [0, 1, 2].map(i => body.charCodeAt(at + i));
      };
      const skins = list => `1,1&skins=${encodeURIComponent(JSON.stringify(list))}`;
      const hide = cels => `&cels=${encodeURIComponent(JSON.stringify(cels))}`;
      return { own: await pixel("1,1", 20, 8), before: await pixel("1,1", 12, 8),
               after: await pixel("1,1", 28, 8), box: await pixel("1,1", 12, 28),
               ball: await pixel(skins(["ball"]), 12, 8),
               none: await pixel(skins(["ball"]), 12, 28),
               second: await pixel(skins(["cel 2"]), 12, 28), early: await pixel("1,0", 28, 8),
               hidden: await pixel("1,1" + hide({ "cel 2": "h" }), 20, 28),
               shown: await pixel("1,1" + hide({ "cel 2": "h" }), 20, 8),
               rest: await pixel("1,1" + hide({ "cel 2": "h" }), 12, 8),
               gone: await pixel("1,1" + hide({ "cel 2": "h" }), 12, 28),
               plain: (await web.get("/frame/3.rgba?size=64x36&onion=0,0")).body
                 === (await web.get("/frame/3.rgba?size=64x36")).body,
               large: (await web.get("/frame/3.rgba?size=100000x56250&crop=0,0,9,9&onion=1,1"))
                 .status,
               bad: await web.statuses(["onion=1", "onion=17,0", "onion=-1,1", "onion=1,1&skins=x",
                 "onion=1,1&skins=%7B%22a%22:1%7D", "onion=1,1&skins=[1]"].map(query =>
                   [`/frame/3.rgba?${query}&token=${web.token}`])) };]=])
    local function is_red(one) return one[1] > one[2] + 15 and one[1] > one[3] + 15 end
    local function is_green(one) return one[2] > one[1] + 15 and one[2] > one[3] + 15 end
    local white = { 255, 255, 255 }
    assert.same({ 0, 0, 0 }, said.own)
    assert.is_true(is_red(said.before) and is_green(said.after) and is_red(said.box))
    assert.is_true(is_red(said.ball) and is_red(said.second))
    assert.same({ white, white }, { said.none, said.early })
    assert.is_true(said.hidden[1] > 0 and is_red(said.rest))
    assert.same(white, said.gone)
    assert.same({ 0, 0, 0 }, said.shown)
    assert.is_true(said.plain)
    assert.equal(200, said.large)
    assert.same({ 400, 400, 400, 400, 400, 400 }, said.bad)
    watching.bench:celspan_inside "render shot.lua -o r.png --frames 3 --size 64x36 --onion 1,1"
    assert.equal(0, (watching.bench:celspan_inside "compare r.png steps.js.png"))
  end)

  it("chooses cels of the shots of a cut", function()
    local said = speak((CUT:gsub("PARTS", ""):gsub("32, 36, texture = colour",
      "f.number, 36, texture = colour"):gsub("frame = function%(%)", "frame = function(f)")), [=[
      const pixel = async skins => {
        const { body } = await web.get("/frame/4.rgba?size=64x36&onion=0,4&skins="
          + encodeURIComponent(JSON.stringify(skins)));
        return [0, 1, 2, 3].map(i => body.charCodeAt(4 * (64 * 9 + 5) + i));
      };
      return { seen: await pixel(["evening/nell"]), other: await pixel(["shot 2/nell"]) };]=])
    assert.is_true(said.seen[4] > 0)
    assert.equal(0, said.other[4])
  end)
end)
