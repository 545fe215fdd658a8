-- celspan watch: values of parameters, those that cannot be, and what is said of the script's own.
local present = require "tests.support.present"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local p = celspan.parameters {
  lamp = { 20, 18, point = true, about = "its \"place\"", group = "Night" }, size = { 6, min = 1 },
  tint = { colour = "#fd0" }, how = { ease = "inQuad" }, mood = { "calm", "wild" },
  word = "a\nb", is_lit = true, art = { file = "a.png" }, ["end"] = 4 }
return celspan.film { size = { 64, 36 }, frames = 9, frame = function()
  return celspan.rostrum { celspan.cel { celspan.circle { centre = p.lamp, radius = p.size,
    texture = p.tint } } } end }
]]

before_each(function() watching.begin { ["shot.lua"] = FILM } end)
after_each(watching.finish)

--- Steps that give values, and read what the state says of the parameters.
local GIVE = [=[
  const headers = { Origin: `http://127.0.0.1:${web.port}` };
  const give = async given => JSON.parse((await web.get("/parameters",
    { method: "POST", headers, body: JSON.stringify(given) })).body);
  const all = async key => Object.fromEntries(JSON.parse((await web.get("/state.json")).body)
    .parameters.map(one => [one.name, one[key]]));
  await web.get("/frame/1.png");
]=]

describe("values of parameters", function()
  it("are in the order of the script, also those with names in brackets", function()
    watching.bench:write("shot.lua", (FILM:gsub("size = { 6, min = 1 },", "")
      :gsub('"%]%s*= 4 }', '"] = 4, size = 6 }')))
    local said = watching.speak(watching.watch(), GIVE .. [=[
      return JSON.parse((await web.get("/state.json")).body).parameters.map(one => one.name);]=])
    assert.same({ "lamp", "tint", "how", "mood", "word", "is_lit", "art", "end", "size" }, said)
  end)

  it("are forgotten when the saved script cannot have them any more", function()
    local fewer = FILM:gsub("min = 1", "max = 10")
    local said = watching.speak(watching.watch(), GIVE .. [=[
      const given = await give({ size: "50", lamp: "30,9" });
      require("fs").writeFileSync("]=] .. watching.bench.folder .. [=[/shot.lua", ]=]
      .. ("%q"):format(fewer):gsub("\\\n", "\\n") .. [=[);
      const until = Date.now() + 10000;
      let values = {};
      while (values.size !== "6" && Date.now() < until) values = await all("value");
      return { values, status: (await web.get("/frame/1.png")).status };]=])
    assert.same({ "6", "30,9", 200 }, { said.values.size, said.values.lamp, said.status })
  end)

  it("are refused one by one, and are given in their own form", function()
    local said = watching.speak(watching.watch "--set size=3 shot.lua", GIVE .. [=[
      const good = await give({ lamp: " 30, 9", size: "4" });
      const bad = await give({ lamp: "left", size: "0", tint: "rust", how: "outBak", mood: "sad",
                               is_lit: "perhaps", art: "", word: "any" });
      const shot = (await web.get("/frame/1.png")).status;
      return { good, bad, shot, value: await all("value"), start: await all("start") };]=])
    assert.same({ lamp = "30,9", size = "4" }, said.good.values)
    assert.same({}, said.good.refused)
    assert.same({ lamp = "30,9", size = "4", word = "any" }, said.bad.values)
    assert.equal('lamp is \'left\'; it must be a point, such as "120,80"', said.bad.refused.lamp)
    assert.equal("size is '0'; it must be a number of 1 or more", said.bad.refused.size)
    for _, name in ipairs { "tint", "how", "mood", "is_lit", "art" } do
      assert.truthy(said.bad.refused[name]:find("^" .. name .. " is '"), name)
    end
    assert.is_nil(said.bad.refused.word)
    assert.equal(200, said.shot)
    assert.same({ "30,9", "4", "#fd0" }, { said.value.lamp, said.value.size, said.value.tint })
    assert.same({ "20,18", "3" }, { said.start.lamp, said.start.size })
  end)

  it("come with a picture that was asked for before them", function()
    local said = watching.speak(watching.watch(), GIVE .. [=[
      const pixel = async query => (await web.get("/frame/1.rgba?crop=20,18,1,1" + query)).body;
      const old = await pixel(""), early = pixel("&build=2");
      const now = await pixel("&build=1");
      await give({ tint: "#00f" });
      return { isOld: now === old, isNew: await early === await pixel(""),
               isOther: await early !== old };]=])
    assert.same({ isOld = true, isNew = true, isOther = true }, said)
  end)

  it("may never come: the picture that waits for them is given up", function()
    local said = watching.speak(watching.watch(), GIVE .. [=[
      const held = web.get("/frame/1.rgba?build=9&wish=late"), now = await web.get("/frame/1.rgba");
      const body = JSON.stringify({ wish: "late" });
      await web.get("/abandon", { method: "POST", headers, body });
      const answer = await held;
      return { now: now.status, status: answer.status, body: answer.body };]=])
    assert.same({ now = 200, status = 503, body = "it is not wanted any more\n" }, said)
  end)

  it("have lines as the script declares them", function()
    local said = watching.speak(watching.watch(), GIVE .. [=[
      await give({ lamp: "30.5,9", mood: "wild", is_lit: "false", size: "2.50" });
      return await all("source");]=])
    local lamp = [[{ 30.5, 9, point = true, about = "its \"place\"", group = "Night" }]]
    assert.same({ lamp = "lamp = " .. lamp,
      size = "size = { 2.5, min = 1 }", tint = 'tint = { colour = "#fd0" }',
      how = 'how = { ease = "inQuad" }', mood = 'mood = { "wild", "calm" }',
      word = [[word = "a\nb"]], is_lit = "is_lit = false", art = 'art = { file = "a.png" }',
      ["end"] = '["end"] = 4' }, said)
    local lines = {}
    for _, line in pairs(said) do lines[#lines + 1] = line end
    local call = FILM:match "celspan.parameters (%b{})"
    watching.bench:write("again.lua", (FILM:gsub("celspan.parameters %b{}", function()
      return "celspan.parameters { " .. table.concat(lines, ", ") .. " }"
    end)))
    assert.truthy(call)
    local code = watching.bench:celspan_inside "render again.lua -o b.png --frames 1"
    assert.equal(0, code)
    watching.bench:celspan_inside
      "render shot.lua -o a.png --frames 1 --set lamp=30.5,9 --set size=2.5"
    assert.equal(watching.bench:read "a.png", watching.bench:read "b.png")
  end)
end)

describe("the form of values #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  it("marks what is not as in the script, gives it back, and refuses at the field", function()
    local address = watching.watch "--set size=3 shot.lua"
    local said = watching.see(address, [=[
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("v");
      const field = name => `document.querySelector("#form").elements.namedItem("${name}")`;
      const type = (name, value) => page.get(`(() => { const one = ${field(name)};
        one.value = "${value}"; one.dispatchEvent(new Event("change")); })()`);
      const backs = () => page.get(`[...document.querySelectorAll("#form .back:not([hidden])")]
        .map(one => one.textContent)`);
      const wrong = name => `${field(name)}.closest(".field").querySelector(".wrong").textContent`;
      const value = id => page.get(`document.querySelector("#${id}").value`);
      const hash = () => page.get("location.hash");
      const first = await backs(), started = await hash();
      await type("lamp", "30, 9");
      await page.until(`${field("lamp")}.value === "30,9"`);
      await page.until(`document.querySelector("#source").value.startsWith("lamp = { 30, 9")`);
      const changed = await backs(), source = await value("source");
      await page.until(`location.hash`);
      const given = await hash();
      await type("lamp", "left");
      await page.until(`${wrong("lamp")}`);
      const fault = await page.get(wrong("lamp"));
      const isMarked = await page.get(`${field("lamp")}.ariaInvalid === "true"`);
      await page.until(`!document.querySelector("#canvas").hasAttribute("data-stale")`);
      const error = await page.get(`document.querySelector("#error").hidden`);
      await page.until(`!document.querySelector("#command").value.includes("left")`);
      const command = await value("command");
      await page.load(server());
      await page.until(`${canvas("frame")} === "1"`);
      const again = await hash();
      await page.press("v");
      await page.until(`document.querySelectorAll("#form .back:not([hidden])").length === 2`);
      for (const left of [1, 0]) {
        await page.get(`document.querySelector("#form .back:not([hidden])").click()`);
        await page.until(`document.querySelectorAll("#form .back:not([hidden])")
          .length === ${left}`);
      }
      await page.until(`document.querySelector("#sources").hidden
        && !location.hash.includes("lamp")`);
      return { first, started, changed, source, given, fault, isMarked, error, command, again,
               last: await hash(), lamp: await page.get(`${field("lamp")}.value`) };
      function server() { return "]=] .. address .. [=["; }]=])
    assert.same({ "back to 6" }, said.first)
    assert.equal("", said.started)
    assert.same({ "back to 20,18", "back to 6" }, said.changed)
    assert.equal('lamp = { 30, 9, point = true, about = "its \\"place\\"", group = "Night" },\n'
      .. "size = { 3, min = 1 },", said.source)
    assert.same({ "#lamp=30%2C9", "#lamp=30%2C9" }, { said.given, said.again })
    assert.equal('lamp is \'left\'; it must be a point, such as "120,80"', said.fault)
    assert.is_true(said.isMarked and said.error)
    assert.truthy(said.command:find("--set lamp=30,9", 1, true), said.command)
    assert.same({ "#size=6", "20,18" }, { said.last, said.lamp })
  end)

  it("has fields that are named like parts of a form, and one whose default is false", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
celspan.parameters { elements = { 3, group = "<b>one</b>" }, contains = "<i>two</i>",
  replaceChildren = { false, about = "<b>three</b>" }, querySelector = 4 }
return celspan.film { size = { 64, 36 }, frames = 9, frame = function()
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 9, 9 }, radius = 4 } } }
  end }
]])
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      await page.press("v");
      const command = `document.querySelector("#command").value`;
      const act = (name, what) => page.get(`document.querySelector("#form [name=${name}]")${what}`);
      const check = () => act("replaceChildren", ".click()");
      await check();
      await page.until(`${command}.includes("--set replaceChildren=true")`);
      await act("contains", ".select()");
      await page.press("x");
      await page.press("Enter");
      await page.until(`${command}.includes("--set contains=x")`);
      await check();
      await page.until(`!${command}.includes("replaceChildren")`);
      await page.get(`document.querySelector("#reset-values").click()`);
      await page.until(`!${command}.includes("--set")
        && !document.querySelector("#canvas").hasAttribute("data-stale")`);
      return { tags: await page.get(`document.querySelectorAll("#form b, #form i").length`),
        names: await page.get(`[...document.querySelectorAll("#form [name]")]
          .map(one => one.name)`) };]=])
    assert.same({ tags = 0, names = { "elements", "contains", "replaceChildren",
                                      "querySelector" } }, said)
  end)

  it("has handles that can be hidden, and that leave clicks to the inspector", function()
    local said = watching.see(watching.watch(), [=[
      await page.until(`${canvas("frame")} === "1"`);
      const handle = `document.querySelector("[data-point=lamp]")`;
      const isHidden = () => page.get(`${handle}.hidden`);
      const first = await isHidden();
      await page.get(`document.querySelector("#handles").click()`);
      const off = await isHidden();
      await page.get(`document.querySelector("#handles").click()`);
      const on = await isHidden();
      await page.press("p");
      await page.settle();
      await page.click(...await page.get(`(box => [box.left + box.width / 2,
        box.top + box.height / 2])(${handle}.getBoundingClientRect())`));
      await page.until(`document.querySelector("#hits").textContent.includes("shot.lua:7")`);
      return { first, off, on };]=])
    assert.same({ first = false, off = true, on = false }, said)
  end)

  it("says which points a frame reads, also while it is drawn, and not those of others", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local p = celspan.parameters { sun = { 20, 18, point = true }, moon = { 40, 8, point = true },
  star = { 5, 5, point = true } }
return celspan.film { size = { 64, 36 }, frames = 4, frame = function(f)
  local at = f.number < 3 and p.sun or p.moon
  return celspan.rostrum { celspan.cel { celspan.circle { centre = at, radius = 4 },
    celspan.scanline { bounds = { 0, 0, 64, 36 }, spans = function(y)
      return y > p.star[2] and { { 0, 9, "#f80" } } or {} end } } } end }
]])
    local said = watching.speak(watching.watch(), [=[
      const points = async path => /-Points: (.*)/.exec((await web.get(path)).head)[1].trim();
      return [await points("/frame/2.rgba?onion=0,1"), await points("/frame/2.rgba?camera=4"),
              await points("/frame/2.rgba"), await points("/frame/4.rgba")];]=])
    assert.same({ ",sun,star,", ",moon,star," }, { said[3], said[4] })
    for i = 1, 2 do assert.matches(",moon,", said[i]) end
  end)

  it("has pale handles for points that the frame does not read", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local p = celspan.parameters { sun = { 20, 18, point = true }, moon = { 40, 8, point = true },
  lamp = { 5, 5, point = true }, star = { 50, 30, point = true } }
local lamp = p.lamp
local function shot(name)
  return celspan.film { size = { 64, 36 }, fps = 24, frames = 24, frame = function()
    return celspan.rostrum { celspan.cel { celspan.circle { centre = p[name], radius = 4 },
      celspan.circle { centre = lamp, radius = 2 } } } end }
end
return require "celspan.cut" { { film = shot "sun" }, require "celspan.cut".dissolve(0.25),
  { film = shot "moon" } }
]])
    local said = watching.see(watching.watch(), [=[
      const pale = async number => {
        await page.get(`(one => { one.value = ${number}; one.dispatchEvent(new Event("input")); })(
          document.querySelector("#scrub"))`);
        await page.until(`${canvas("frame")} === "${number}"`);
        return page.get(`[...document.querySelectorAll(".handle.idle")]
          .map(one => one.dataset.point).sort().join()`);
      };
      await page.until(`document.querySelectorAll(".handle").length === 4`);
      return [await pale(40), await pale(2), await pale(22), await pale(40), await pale(41)];]=])
    assert.same({ "star,sun", "moon,star", "star", "star,sun", "star,sun" }, said)
  end)
end)
