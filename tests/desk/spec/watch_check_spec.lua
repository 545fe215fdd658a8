-- celspan watch: the faults of all frames, which are checked while nobody asks for pictures.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local rig = require "celspan.puppet" { art = assert(require "celspan.svg".read "arm.svg"),
  joints = { from = { 0, 0 }, to = { 9, 0 } }, bones = { { "arm", from = "from", to = "to" } } }
local calls = 0 celspan.circle { centre = { 0, 0 }, radius = 1 }
return celspan.film { size = { 64, 36 }, frames = 24, SOUND frame = function(f)
  calls = calls + 1
  if f.number > 12 then error "too late" end
  return celspan.rostrum {
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#ffe0b0" } },
    f.number == 7 and celspan.cel { rig:pose { reach = { to = { 20, 0 } } } },
    f.number > 2 and f.number < 6
      and celspan.cel { celspan.circle { centre = { calls, 18 }, radius = 6 } } }
end }
]]

local GOOD = [[
local celspan = require "celspan"
return celspan.film { size = { 64, 36 }, frames = 24, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.rect { f.index, 0, 4, 4 } } }
end }
]]

before_each(function()
  watching.begin { ["shot.lua"] = FILM:gsub("SOUND", 'sound = "gone.wav",'), ["arm.svg"] =
    '<svg xmlns="http://www.w3.org/2000/svg"><rect id="arm" width="9" height="2"/></svg>' }
end)
after_each(watching.finish)

describe("what is wrong with a film that is watched", function()
  it("is what check finds: sounds, scripts, frames, puppets, and what is not pure", function()
    local said = watching.speak(watching.watch(), [=[
      for (;;) {
        const state = JSON.parse((await web.get("/state.json")).body);
        if (state.shown && !state.checking) return state;
      }]=])
    assert.equal(24, said.checked)
    assert.same({ "shot.lua", 5 }, { said.errors[1].file, said.errors[1].line })
    local found, wanted = {}, {}
    for i, one in ipairs(said.errors) do found[i] = one.message:gsub("frame %d+: ", "") end
    local _, out = watching.bench:celspan_inside "check shot.lua --json 2>/dev/null"
    for _, one in ipairs(json.decode(out)) do wanted[one.message] = true end
    assert.equal(1 + 1 + 1 + 12 + 3, #found)
    for _, message in ipairs(found) do assert.is_true(wanted[message], message) end
    local impure = { said.errors[16].frame, said.errors[17].frame, said.errors[18].frame }
    table.sort(impure)
    assert.same({ 3, 4, 5 }, impure)
  end)

  it("is found without what the frames print, which those that are shown do", function()
    watching.bench:write("shot.lua", "print 'the film'\n"
      .. GOOD:gsub("return celspan.rostrum", "print('frame ' .. f.number) %0"))
    watching.speak(watching.watch(), [=[
      while (JSON.parse((await web.get("/state.json")).body).checking) await web.pause(0.05);
      await web.get("/sheet.json");
      await web.get("/frame/7.png");]=])
    local printed = watching.bench:read "complained"
    assert.truthy(printed:find("^the film\n"), printed)
    assert.equal("frame 7\n", printed:gsub("the film\n", ""))
  end)

  it("is a list in the page, with ways to the frames, until the next good save #plain", function()
    if not present.program "chromium" then return pending "there is no chromium" end
    local said = watching.see(watching.watch "shot.lua --editor true", [=[
      const folder = "]=] .. watching.bench.folder .. [=[";
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("r");
      await page.until(`document.querySelector("#checked").textContent === "24 frames checked"`);
      const items = await page.get(`[...document.querySelectorAll("#fault-list li")]
        .map(one => [...one.querySelectorAll("button, small")]
          .map(one => one.textContent).join())`);
      const button = await text("check");
      await page.get(`[...document.querySelectorAll("#fault-list button")]
        .find(one => one.textContent === "frame 5").click()`);
      await page.until(`${canvas("frame")} === "5"`);
      page.write(folder + "/shot.lua", ]=] .. ("%q"):format(GOOD):gsub("\\\n", "\\n") .. [=[);
      await page.until(`document.querySelector("#checked").textContent
        === "24 frames checked: no faults"`);
      return { items, button, after: await text("check"), list: await text("fault-list") };]=])
    assert.same({ "shot.lua:5", "shot.lua:4", "shot.lua:10,frame 7",
      "shot.lua:7,frame 13,frame 14,frame 15,frame 16,frame 17,frame 18,"
      .. "and 6 more up to 24", "frame 3,frame 4,frame 5" }, said.items)
    assert.equal("Faults 5", said.button)
    assert.equal("Faults 0", said.after)
    assert.equal("", said.list)
  end)
end)
