-- celspan watch: what it holds in memory after many saves. CELSPAN_SAVES: how many, else 30.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

local SAVES = math.tointeger(os.getenv "CELSPAN_SAVES") or 30
local MOST = 20 -- MiB

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end

local FILM = [[
local celspan = require "celspan"
local level, tint = LEVEL, celspan.read "tint.txt"
return celspan.film { size = { 640, 360 }, frames = 48, frame = function(f)
  if level == 5 then error "a frame that fails" end
  local cels = {}
  for i = 1, 50 do
    cels[i] = celspan.cel { celspan.circle { centre = { 12 * i, 180 }, radius = level % 90 + 1,
                                             texture = tint } }:named("dot " .. i)
  end
  return celspan.rostrum(cels)
end }
]]

before_each(function()
  watching.begin { ["shot.lua"] = FILM:gsub("LEVEL", "0"), ["tint.txt"] = "#369" }
end)
after_each(watching.finish)

describe("the memory of celspan watch #plain", function()
  it("is the same after many saves, a tenth of them broken", function()
    local address = watching.watch()
    local said = watching.see(address, [=[
      const fs = require("fs"), saves = ]=] .. SAVES .. [=[, folder = "]=]
      .. watching.bench.folder .. [=[", server = ]=] .. watching.server() .. [=[;
      const film = ]=] .. ("%q"):format(FILM):gsub("\\\n", "\\n") .. [=[;
      const resident = id => Number(/VmRSS:\s+(\d+)/.exec(
        fs.readFileSync(`/proc/${id}/status`, "utf8"))[1]) / 1024;
      const renderers = () => fs.readFileSync(`/proc/${server}/task/${server}/children`, "utf8")
        .split(" ").filter(Boolean);
      // What the server, a renderer and the page hold, in MiB, and how many renderers there are.
      const measure = async () => {
        await page.call("HeapProfiler.collectGarbage");
        const { usedSize, backingStorageSize = 0 } = await page.call("Runtime.getHeapUsage");
        const all = renderers().map(id => { try { return resident(id); } catch { return 0; } });
        const held = (usedSize + backingStorageSize) / 1048576;
        return [resident(server), Math.max(...all), held, all.length];
      };
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("r");
      const seen = [];
      for (let i = 1; i <= saves; i++) {
        const build = await page.get(`Number(${canvas("build")})`);
        const isBad = i % 10 === 7, text = film.replace("LEVEL", i % 20 === 7 ? 5 : i + 10);
        page.write(folder + "/shot.lua", i % 20 === 17 ? "return nil +" : text);
        await page.until(isBad ? `!document.querySelector("#error").hidden`
          : `${canvas("build")} > ${build} && document.querySelector("#error").hidden
            && ${canvas("size")}.split("x")[0] > 400`);
        if (i === 10 || i === saves) seen.push(await measure());
      }
      return seen;]=], 30 + SAVES)
    local before, after = said[1], said[2]
    for i, what in ipairs { "the server", "a renderer", "the page" } do
      local grown = ("%s: %.1f MiB, then %.1f"):format(what, before[i], after[i])
      if SAVES ~= 30 then print("# " .. grown) end
      assert.is_true(before[i] > 0.5 and after[i] - before[i] < MOST, grown)
    end
    assert.is_true(after[4] <= 4, after[4])
  end)
end)
