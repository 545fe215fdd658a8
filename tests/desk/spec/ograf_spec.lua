-- Films as graphics of OGraf (EBU): the manifest, the element in a browser, and what is refused.
-- tests/page/ograf.mjs tests the engine in a graphic.
local browsing = require "tests.support.browsing"
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
teardown(function() bench:remove() end)

local FILM = [[
return film { size = { 160, 90 }, fps = 10, frames = 12, title = 'A "third"',
  marks = { hold = 4, more = 8 }, frame = function(f)
    return cel { rect { 8 * f.number, 20, 40, 50, fill = "#e0654f" },
      circle { 20.4, 45, 16.3, fill = "#f2b705" } }
  end }
]]
local ASKED = [[
local words = require "parts.words"
local p = parameters { tint = { colour = "#F26419" }, size = { 20, min = 1, max = 60 },
  at = { 120, 80, point = true }, line_one = words }
return film { size = { 160, 90 }, frames = 2, frame = function(f)
  return circle { p.at[1], p.at[2], p.size, fill = p.tint }
end }
]]

-- What EBU's specification of version 1 requires of a manifest, and the fields that it knows.
local SCHEMA = "https://ograf.ebu.io/v1/specification/json-schemas/graphics/schema.json"
local REQUIRED = { ["$schema"] = "string", id = "string", name = "string", main = "string",
  supportsRealTime = "boolean", supportsNonRealTime = "boolean" }
local KNOWN = { version = "string", description = "string", author = "table", schema = "table",
  customActions = "table", stepCount = "number", renderRequirements = "table" }

--- The manifest in a folder of a graphic, which is valid.
local function manifest(folder, name)
  local found = assert(json.decode(bench:read(("%s/%s.ograf.json"):format(folder, name))))
  for field, kind in pairs(REQUIRED) do assert.equal(kind, type(found[field]), field) end
  for field, value in pairs(found) do
    local kind = REQUIRED[field] or KNOWN[field]
    assert.is_true(field:find "^v_" ~= nil or kind == type(value), field)
  end
  assert.equal(SCHEMA, found["$schema"])
  assert.is_nil(found.id:find "/")
  assert.is_true(found.supportsRealTime or found.supportsNonRealTime)
  local main = bench:read(folder .. "/" .. found.main)
  assert.is_true(main:find("\nexport default class", 1, true) ~= nil)
  return found
end

--- The sentence with which a film is refused.
local function refused(script, words)
  bench:write("refused.lua", script)
  local code, err = bench:ran("render refused.lua -o x.ograf --progress none " .. words)
  assert.is_true(code ~= 0)
  return err
end

--- A folder in the place of celspan-web.
local function engine()
  bench:inside "mkdir -p web empty parts"
  for _, name in ipairs { "engine.mjs", "celspan.wasm", "LICENSES" } do
    bench:write("web/" .. name, "of " .. name)
  end
  bench:write("web/more.json", "{}")
end

describe("a graphic #plain", function()
  it("has a manifest with its steps", function()
    if not present.pages() then return pending "celspan was built without clang and lld" end
    bench:rendered(FILM, "-o lower.ograf/")
    local found = manifest("lower.ograf", "lower")
    assert.same({ 'A "third"', "lower", 2, {} },
      { found.name, found.id, found.stepCount, found.schema.properties })
  end)

  it("plays to its marks, and shows the frame of a time", function()
    if not present.pages() then return pending "celspan was built without clang and lld" end
    if not present.program("node", "chromium") then return pending "there is no browser" end
    bench:rendered(FILM, "-o lower.ograf")
    bench:write("page.html", [[<!doctype html><title>x</title><body><script type="module">
      import Graphic from "./lower.ograf/graphic.mjs";
      customElements.define("a-graphic", Graphic);
      globalThis.graphic = document.createElement("a-graphic");
      document.body.append(graphic);
      globalThis.pixels = () => graphic.shadowRoot?.querySelector("canvas").getContext("2d")
        .getImageData(0, 0, 160, 90).data ?? [];
      // The left edge of the square, from which the frame is known; -1: nothing is seen.
      globalThis.frame = () => { const all = pixels();
        for (let x = 0; x < 160; x++) if (all[(68 * 160 + x) * 4 + 3]) return x / 8;
        return [...all].some(Boolean) ? -2 : -1; };
    </script>]])
    local said = browsing.see("about:blank", ([=[
      const site = await require("./site.js")("%s");
      try {
        await page.load(site.at("page.html"), /^http:/);
        await page.until("globalThis.frame");
        const ask = code => page.get(`(async () => { ${code} })()`);
        const after = code => ask(`const answer = await graphic.${code};
          return [answer?.statusCode ?? 200, frame(), answer?.currentStep ?? null]`);
        const said = [await after("playAction({})")];
        const to = timestamp => `goToTime({ timestamp: ${timestamp} })`;
        const plan = (...pairs) => `setActionsSchedule({ schedule: ${JSON.stringify(
          pairs.map(([timestamp, type]) => ({ timestamp, action: { type, params: {} } })))} })`;
        for (const code of ["load({ data: {} })", "playAction({})",
          "playAction({ goto: 1, skipAnimation: true })", "updateAction({ data: {} })",
          "playAction({ goto: 0 })", "stopAction({ skipAnimation: true })",
          "customAction({ id: 'x' })", to("'x'"), "load({ data: {}, renderType: 'non-realtime' })",
          to(500), to(1199), to(1200), to(0), plan([1000, "stopAction"], [100, "playAction"]),
          to(50), to(200), to(999), to(1200), to(1700), plan([0, "x"]), plan(), to(400)])
          said.push(await after(code));
        const shown = await page.get("[...pixels()]");
        return { said, shown, requests: page.requests.filter(url => !url.startsWith("http://127.")),
          left: await ask("await graphic.dispose(); return graphic.shadowRoot.childNodes.length") };
      } finally { site.close(); }]=]):format(bench.folder))
    local null = json.null
    assert.same({ { 400, -1, null } }, { said.said[1] })
    assert.same({
      { 200, -1, null }, { 200, 4, 0 }, { 200, 8, 1 }, { 200, 8, null }, { 200, 4, 0 },
      { 200, -1, null }, { 400, -1, null }, { 400, -1, null }, { 200, -1, null }, { 200, 6, null },
      { 200, 12, null }, { 200, -1, null }, { 200, 1, null }, { 200, 1, null }, { 200, -1, null },
      { 200, 2, null }, { 200, 4, null }, { 200, 10, null }, { 200, -1, null }, { 400, -1, null },
      { 200, -1, null }, { 200, 5, null } }, { table.unpack(said.said, 2) })
    assert.same({}, said.requests)
    assert.equal(0, said.left)
    local code, raw = bench:celspan_inside "render film.lua --frames 5 -o - --progress none"
    assert.equal(0, code)
    local worst = 0 -- the canvas keeps colours multiplied by alpha, and a plane rounds places
    for i, value in ipairs(said.shown) do
      local alpha = i % 4 == 0 and 255 or raw:byte(i + -i % 4)
      worst = math.max(worst, math.abs(value - raw:byte(i)) * alpha / 255)
    end
    assert.is_true(worst <= 2, "differs by " .. worst)
  end)

  it("with parameters contains the engine and the files of the script", function()
    engine()
    bench:write("parts/words.lua", 'return "one"')
    bench:rendered(ASKED, "-o asked.ograf --engine web")
    local found = manifest("asked.ograf", "asked")
    local is = found.schema.properties
    assert.same({ 0, "object", "color-rrggbb", "#f26419", "number", 60, "array", "line one" },
      { found.stepCount, found.schema.type, is.tint.gddType, is.tint.default, is.size.type,
        is.size.maximum, is.at.type, is.line_one.title })
    for name, text in pairs { ["engine.mjs"] = "of engine.mjs", LICENSES = "of LICENSES",
      ["files/film.lua"] = ASKED, ["files/parts/words.lua"] = 'return "one"' } do
      assert.equal(text, bench:read("asked.ograf/" .. name))
    end
    assert.matches('"/parts/words.lua": "files/parts/words.lua"',
      bench:read "asked.ograf/graphic.mjs", 1, true)
  end)

  it("is refused with a sentence", function()
    engine()
    assert.matches("give its folder with --engine DIR; ./run web makes one",
      refused(ASKED, "--engine empty"), 1, true)
    assert.matches("leave --frames out", refused(FILM, "--frames 1-3"), 1, true)
    assert.matches("takes no --quality", refused(FILM, "--quality 5"), 1, true)
    local _, err = bench:ran "render film.lua -o x.plane --engine web"
    assert.matches("plane takes no --engine", err, 1, true)
  end)
end)
