-- celspan watch: films of a billion frames, of ten thousand cels and of a thousand shots, and names
-- of 255 bytes that look like parts of a page.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program("node", "chromium") then return pending "there is no node or chromium" end

local NAME = [[("<img src=x onerror='hit = 1'><b onclick='hit = 2'>" .. ("n"):rep(205))]]

local CELS = [[
local celspan = require "celspan"
return celspan.film { title = NAME, size = { 64, 36 }, fps = 24, frames = 1000000000,
  frame = function()
    local cels = {}
    for i = 1, 10000 do
      cels[i] = celspan.cel { celspan.rect { i % 64, i % 36, 4, 4, texture = "#f80" } }
        :named(i == 10000 and NAME or "cel number " .. i)
    end
    return celspan.rostrum(cels) end }
]]

local SHOTS = [[
local celspan = require "celspan"
local shot = celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function()
  return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#369" } }
    :named "ground" } end }
local shots = {}
for i = 1, 1000 do shots[i] = { film = shot, name = "n" .. i .. NAME:sub(1, 250) } end
return require "celspan.cut"(shots)
]]

before_each(function() watching.begin {} end)
after_each(watching.finish)

--- What the page says of a film after its last frame was asked for.
local function see(script)
  watching.bench:write("shot.lua", (script:gsub("NAME", function() return NAME end)))
  return watching.see(watching.watch(), [=[
    const count = selector => page.get(`document.querySelectorAll("${selector}").length`);
    await page.until(`${canvas("frame")} === "1"`);
    for (const key of ["s", "q", "End"]) await page.press(key);
    const last = await text("frames");
    await page.until(`${canvas("frame")} === "${last}"`);
    await page.until(`document.querySelector("#objects").ariaBusy === "false"
      && document.querySelector("[data-object]")`);
    return { last, code: await text("timecode"), shots: await count("[data-shot]"),
      objects: await count("[data-object]"), hint: await page.get(
        `(hint => hint.hidden ? "" : hint.textContent)(document.querySelector("#objects-hint"))`),
      first: await page.get(`document.querySelector("[data-object]").dataset.object`),
      tags: await count("img, b[onclick]"), hit: await page.get("window.hit ?? 0"),
      isWide: await page.get(`document.documentElement.scrollWidth > window.innerWidth`) };]=])
end

describe("a film beyond all measure in the page #plain", function()
  it("has a billion frames of ten thousand cels, of which the first are listed", function()
    local said = see(CELS)
    assert.same({ "1000000000", "41666666:15" }, { said.last, said.code })
    assert.same({ 2000, "These are the first 2000." }, { said.objects, said.hint })
    assert.same({ load("return " .. NAME)(), 0, 0, false },
      { said.first, said.tags, said.hit, said.isWide })
  end)

  it("has a thousand shots", function()
    local said = see(SHOTS)
    assert.same({ "24000", 1000, 1, "" }, { said.last, said.shots, said.objects, said.hint })
    assert.same({ 0, 0, false }, { said.tags, said.hit, said.isWide })
  end)
end)
