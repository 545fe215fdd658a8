-- celspan watch: the files that a parameter may name.
local json = require "celspan.json"
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters { take = { file = "takes/red.txt" }, size = 4 }
return celspan.film { size = { 64, 36 }, frames = 9, frame = function()
  local colour = assert(celspan.read(p.take)):match "#%x+"
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 64, 36, texture = colour } } }
end }
]]

before_each(function()
  watching.begin { ["shot.lua"] = FILM }
  watching.bench:inside [[mkdir -p takes/old more && cd takes && echo '#f00' >red.txt &&
    echo '#0f0' >old/green.txt && echo '#00f' >.hidden.txt && echo x >list.csv &&
    ln -s /etc/hostname out.txt && ln -s .. up && ln -s /etc more && echo '#ff0' >../yellow.TXT]]
end)
after_each(watching.finish)

describe("a parameter that is a file", function()
  it("has a list of the files of its kind in the folder of the script, and of no other", function()
    local said = watching.speak(watching.watch(), [=[
      await web.get("/frame/1.png");
      return { files: (await web.get("/files.json?parameter=take")).body,
               wrong: [(await web.get("/files.json?parameter=size")).status,
                       (await web.get("/files.json?parameter=../x")).status,
                       (await web.get("/files.json")).status] };]=])
    assert.same({ "takes/old/green.txt", "takes/red.txt", "yellow.TXT" }, json.decode(said.files))
    assert.same({ 404, 404, 404 }, said.wrong)
  end)

  it("is chosen from that list in the page #plain", function()
    if not present.program "chromium" then return pending "there is no chromium" end
    local said = watching.see(watching.watch(), [=[
      const select = `document.querySelector("#form select")`;
      const options = () => page.get(`[...${select}.options].map(one => one.value)`);
      const colour = () => page.get(`[...document.querySelector("#canvas").getContext("2d")
        .getImageData(3, 3, 1, 1).data].slice(0, 3).join()`);
      const choose = async (name, wanted) => {
        await page.get(`(() => { ${select}.value = "${name}";
          ${select}.dispatchEvent(new Event("input")); })()`);
        for (let i = 0; i < 100 && await colour() !== wanted; i++) await page.pause(0.05);
        return colour();
      };
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("v");
      await page.until(`${select}?.options.length === 3`);
      const first = await options(), seen = [await colour()];
      seen.push(await choose("takes/old/green.txt", "0,255,0"));
      page.write("]=] .. watching.bench.folder .. [=[/takes/white.txt", "#fff");
      await page.get(`${select}.focus()`);
      await page.until(`${select}.options.length === 4`);
      seen.push(await choose("takes/white.txt", "255,255,255"));
      return { first, seen, command: await page.get(`document.querySelector("#command").value`) };
      ]=])
    assert.same({ "takes/old/green.txt", "takes/red.txt", "yellow.TXT" }, said.first)
    assert.same({ "255,0,0", "0,255,0", "255,255,255" }, said.seen)
    assert.equal("celspan render shot.lua --set take=takes/white.txt -o shot.mp4",
      said.command)
  end)
end)
