-- celspan watch: what the server says of a film before a frame is made.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { plain = false, typed = { false, about = "a switch" } }
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, first = 11, poster = "1.5s",
  frame = function()
    return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, p.plain and 9 or 64, 36 } } }
  end }
]]

after_each(watching.finish)

local function speak(script, arguments, steps)
  watching.begin { ["shot.lua"] = script }
  return watching.speak(watching.watch(arguments), steps)
end

describe("a film that is watched", function()
  it("has a poster, at which the page opens #plain", function()
    local said = json.decode(speak(FILM, nil, 'return (await web.get("/film.json")).body;'))
    assert.same({ 11, 47 }, { said.first, said.poster })
    watching.finish()
    said = speak(FILM:gsub("poster = [^,]*,", ""), nil,
      'return (await web.get("/film.json")).body;')
    assert.equal(11, json.decode(said).poster)
    watching.finish()
    if not present.program "chromium" then return pending "there is no chromium" end
    watching.begin { ["shot.lua"] = FILM }
    local seen = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "47"`);
      const opened = await text("frame");
      await page.press("Home");
      await page.until(`${canvas("frame")} === "11"`);
      return opened;]=])
    assert.equal("37", seen)
  end)

  it("has parameters whose default is false, and can be set to it again", function()
    local said = speak(FILM, "shot.lua --set plain=true", [=[
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const values = async () => JSON.parse((await web.get("/state.json")).body).parameters
        .map(one => [one.name, one.default, one.value]);
      const give = async given => {
        await web.get("/parameters", { method: "POST", headers, body: JSON.stringify(given) });
        const answer = await web.get("/frame/11.png?size=64x36");
        return [answer.status, ...await values()];
      };
      await web.get("/film.json");
      return { first: await values(), on: await give({ typed: "true" }),
               off: await give({ typed: "false", plain: "false" }) };]=])
    assert.same({ { "plain", false, "true" }, { "typed", false, "false" } }, said.first)
    assert.same({ 200, { "plain", false, "true" }, { "typed", false, "true" } }, said.on)
    assert.same({ 200, { "plain", false, "false" }, { "typed", false, "false" } }, said.off)
  end)

  it("says the script's own error first, whatever --set says", function()
    local said = speak('local celspan = require "celspan"\nerror "own"\n', "shot.lua --set a=1",
      'return JSON.parse((await web.get("/errors.json")).body);')
    assert.same({ "shot.lua:2: own" }, { said[1].message, said[2] })
  end)
end)
