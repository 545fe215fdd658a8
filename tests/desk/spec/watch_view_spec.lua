-- celspan watch: what lies under the picture, and other ways to look at it.
local json = require "celspan.json"
local present = require "tests.support.present"
local system = require "tests.support.system"
local watching = require "tests.support.watching"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
local function ball(at) return celspan.circle { centre = at, radius = 6, texture = "#c33" } end
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, frame = function(f)
  return celspan.rostrum { camera = { centre = { 32, 18 }, width = 32 },
    celspan.cel { celspan.rect { 0, 0, 64, 36, texture = "#ffe0b0" } }:named "ground",
    f.number > 2 and celspan.cel { ball { 32, 18 }, front = { 0, 0.5, 0 }, defocus = 2 }
        :named "ball"
      or celspan.cel { celspan.rect { 20, 20, 2, 2, texture = "#00f" } },
  }
end }
]]

-- A camera that moves, turns and widens over a square that does not, and a ball that does.
local PAN = [[
local celspan = require "celspan"
return celspan.film { size = { 64, 36 }, frames = 9, frame = function(f)
  return celspan.rostrum {
    camera = { centre = { 20 + 4 * f.number, 18 }, width = 60 + f.number, rotate = f.number },
    celspan.cel { celspan.rect { -99, -99, 299, 299, texture = "#ccc" } },
    celspan.cel { celspan.rect { 20, 10, 16, 16, texture = "#036" } },
    f.number > 4 and celspan.cel { celspan.rect { 4 * f.number, 2, 4, 4, texture = "#f00" } } }
end }
]]

before_each(function() watching.begin { ["shot.lua"] = FILM } end)
after_each(watching.finish)

describe("a frame in another way", function()
  it("is without cels, lights or defocus, and shows spans or what a line made", function()
    local said = watching.speak(watching.watch(), [=[
      const frame = "/frame/3.rgba?size=64x36";
      const colour = async (query, x, y) => {
        const { status, body } = await web.get(frame + query), at = 4 * (64 * y + x);
        if (status !== 200) return [status];
        return [0, 1, 2, 3].map(i => body.charCodeAt(at + i));
      };
      const cels = letters => "&cels=" + encodeURIComponent(JSON.stringify(letters));
      const made = line => `&show=made&file=shot.lua&line=${line}`;
      return { lit: await colour("", 32, 18), unlit: await colour(cels({ ball: "lf" }), 32, 18),
               hidden: await colour(cels({ ball: "h" }), 32, 18),
               none: await colour(cels({ ball: "h", ground: "h" }), 32, 18),
               soft: await colour("", 32, 7), sharp: await colour(cels({ ball: "f" }), 32, 7),
               spans: await colour("&show=spans", 2, 2), end: await colour("&show=spans", 0, 2),
               circle: await colour(made(2), 32, 18), beside: await colour(made(2), 4, 4),
               ground: await colour(made(5), 4, 4), nothing: await colour(made(1), 32, 18),
               bad: await web.statuses(["cels=4", "show=x"].map(query =>
                 [`${frame}&${query}&token=${web.token}`])) };]=])
    assert.same({ 0, 35, 0, 255 }, said.lit)
    assert.same({ 204, 51, 51, 255 }, said.unlit)
    assert.same({ 255, 224, 176, 255 }, said.hidden)
    assert.same({ 0, 0, 0, 0 }, said.none)
    assert.are_not.same(said.soft, said.sharp)
    assert.same({ 60, 130, 255, 110 }, said.spans)
    assert.same({ 60, 130, 255, 255 }, said["end"])
    assert.equal(255, said.circle[4])
    assert.equal(0, said.beside[4])
    assert.equal(255, said.ground[4])
    assert.equal(0, said.nothing[4])
    assert.same({ 400, 400 }, said.bad)
  end)

  it("travels as runs, which are the same pixels in fewer bytes", function()
    local unpack = system.read "src/desk/program/verbs/watch/runs.js":gsub("\nexport ", "\n")
    local said = watching.speak(watching.watch(), unpack .. [=[
      const bytes = async path => Buffer.from((await web.get(path)).body, "latin1");
      const said = { same: [], shares: [] };
      for (const [query, w, h] of [["size=640x360", 640, 360], ["size=64x36&crop=20,8,7,9", 7, 9],
                                   ["size=64x36&crop=3,3,1,20", 1, 20]]) {
        const plain = await bytes(`/frame/3.rgba?${query}`);
        const runs = new Uint8Array(await bytes(`/frame/3.runs?${query}`)).buffer;
        said.same.push(Buffer.compare(plain, Buffer.from(unpack(runs, w, h).buffer)) === 0);
        said.shares.push(runs.byteLength / plain.length);
      }
      return said;]=])
    assert.same({ true, true, true }, said.same)
    assert.is_true(said.shares[1] < 0.5, said.shares[1])
    for i = 2, 3 do assert.is_true(said.shares[i] < 1.1) end
  end)

  it("is seen by the camera of another frame", function()
    watching.bench:write("shot.lua", PAN)
    local said = watching.speak(watching.watch(), [=[
      const get = async query => (await web.get(`/frame/${query}`)).body;
      const camera = async number => /Celspan-Camera: (.*)\r/
        .exec((await web.get(`/frame/${number}.rgba?size=64x36`)).head)[1];
      return { same: await get("2.rgba?camera=3") === await get("3.rgba"),
               other: await get("2.rgba") === await get("3.rgba"),
               again: await get("2.rgba?camera=2") === await get("2.rgba"),
               cameras: [await camera(2), await camera(2), await camera(3)],
               none: (await web.get("/frame/2.png?camera=10")).status };]=])
    assert.is_true(said.same and said.again and not said.other)
    assert.equal(said.cameras[1], said.cameras[2])
    assert.are_not.equal(said.cameras[1], said.cameras[3])
    assert.equal(404, said.none)
  end)

  it("has objects at its points where the camera shows them", function()
    local said = watching.speak(watching.watch(), [=[
      return (await web.get("/at/42,18.json?frame=3")).body;]=])
    -- Twice as large: the ball is from 20 to 44.
    assert.equal("ball", json.decode(said)[2].name)
  end)

  it("has objects and cels with an opacity, and cels with a light", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local dot = celspan.circle { centre = { 32, 18 }, radius = 6 }
return celspan.film { size = { 64, 36 }, frames = 1, frame = function()
  return celspan.rostrum { brightness = 0.5,
    celspan.cel { dot, front = { on = "cel", texture = celspan.linear { from = { 0, 0 },
      to = { 64, 0 }, { 0, "#f00" }, { 1, "#00f" } } } },
    celspan.cel { dot, opacity = 0.25, front = { 1, 0.5, 0 } }, celspan.cel { dot:fade(0.75) } }
end }
]])
    local said = json.decode(watching.speak(watching.watch(), [=[
      return (await web.get("/at/32,18.json?frame=1")).body;]=]))
    local found = {}
    for i, one in ipairs(said) do
      local light = type(one.light) == "table" and table.concat(one.light, " ") or one.light or "-"
      found[i] = ("%s %g %s"):format(one.kind, one.opacity, light)
    end
    assert.same({ "object 0.75 -", "cel 1 0.5 0.5 0.5", "object 1 -", "cel 0.25 0.5 0.25 0.0",
                  "object 1 -", "cel 1 texture" }, found)
  end)

  it("has parts of drawings, with their lines in the drawing", function()
    if not present.type() then return pending "celspan was built without the type module" end
    watching.bench:write("nell.svg", [[
<svg xmlns="http://www.w3.org/2000/svg" width="64" height="36">
  <rect width="64" height="36" fill="#ccc"/>
  <g id="hand">
    <circle id="thumb" cx="30" cy="18" r="8" fill="#f00"/>
    <circle cx="50" cy="18" r="8" fill="#00f"/>
  </g>
</svg>
]])
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local art = require "celspan.svg".read "nell.svg"
return celspan.film { size = { 64, 36 }, frames = 2, frame = function(f)
  local shown = f.number == 1 and art
    or art:with { thumb = function(one) return one:translate(1, 0) end }
  return celspan.rostrum { celspan.cel { shown.object } }
end }
]])
    local said = watching.speak(watching.watch "shot.lua --editor true", [=[
      const at = async number => JSON.parse((await web.get(`/at/30,18.json?frame=${number}`)).body)
        .map(one => `${one.name} ${one.file}:${one.line}`);
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const found = { first: await at(1), second: await at(2) };
      const post = line => web.get("/open",
        { method: "POST", headers, body: JSON.stringify({ file: "nell.svg", line }) });
      return { ...found, open: [(await post(4)).status, (await post(7)).status] };]=])
    local wanted = { "thumb nell.svg:4", "hand nell.svg:3", " nell.svg:2", " nell.svg:1",
                     " shot.lua:6" }
    assert.same(wanted, said.first)
    assert.same(wanted[1], said.second[1])
    assert.same(wanted[2], said.second[2])
    assert.same({ 200, 404 }, said.open)
  end)

  it("says through which lines an object was made", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local function ball(x) return celspan.circle { centre = { x, 18 }, radius = 6 } end
local function pair(x) local one = ball(x) return one end
local still = ball(50)
return celspan.film { size = { 64, 36 }, frames = 1, frame = function()
  local left = pair(10)
  return celspan.rostrum { celspan.cel { left, still } }
end }
]])
    local said = watching.speak(watching.watch "shot.lua --editor true", [=[
      const at = async x => JSON.parse((await web.get(`/at/${x},18.json?frame=1`)).body)[0];
      const left = await at(10), still = await at(50);
      const headers = { Origin: `http://127.0.0.1:${web.port}` };
      const post = (file, line) => web.get("/open",
        { method: "POST", headers, body: JSON.stringify({ file, line }) });
      return { left, still, open: [(await post("shot.lua", 3)).status,
                                   (await post("shot.lua", 1)).status] };]=])
    assert.equal(2, said.left.line)
    assert.equal("in ball, from shot.lua:3, shot.lua:6", said.left.via)
    assert.same({ { file = "shot.lua", line = 3 }, { file = "shot.lua", line = 6 } },
      said.left.callers)
    assert.equal("in ball, from shot.lua:4", said.still.via)
    assert.same({ 200, 404 }, said.open)
  end)

  it("has costs, as a whole and of each cel", function()
    local said = watching.speak(watching.watch(), [=[
      return JSON.parse((await web.get("/costs.json?frame=3&size=640x360")).body);]=])
    local names = {}
    for i, one in ipairs(said) do
      names[i] = ("%s %s:%s"):format(one.name, one.file, one.line)
      assert.is_true(one.seconds > 0 and one.bytes > 0)
    end
    assert.same({ " nil:0", "ground shot.lua:5", "ball shot.lua:6" }, names)
    assert.is_true(said[2].single > 0 and said[2].gradient == 0)
    assert.is_true(said[3].gradient > 0) -- it is defocused
  end)

  it("has costs of cels without a name by their places", function()
    watching.bench:write("shot.lua", [[
local celspan = require "celspan"
local dot = celspan.circle { centre = { 9, 9 }, radius = 6 }
return celspan.rostrum { celspan.cel { dot }, celspan.cel { dot } }
]])
    local said = watching.speak(watching.watch(), [=[
      return JSON.parse((await web.get("/costs.json?frame=1&size=640x360")).body);]=])
    assert.same({ "", "cel 1", "cel 2" }, { said[1].name, said[2].name, said[3].name })
  end)
end)

describe("a line that an editor sends", function()
  it("is known by its file and line, with the frames that it made something in", function()
    local said = watching.speak(watching.watch(), [=[
      const here = (body, headers) => web.get("/here",
        { method: "POST", body: JSON.stringify(body), headers });
      await web.get("/frame/1.png");
      const none = (await web.get("/made.json")).body;
      const stranger = { Origin: "http://evil.example" };
      const refused = [await here({ file: "/etc/passwd", line: 2 }),
                       await here({ file: "shot.lua" }),
                       await here({ file: "shot.lua", line: 2 }, stranger)];
      const taken = await here({ file: "]=] .. watching.bench.folder .. [=[/shot.lua", line: 2 });
      const runs = (await web.get("/made.json")).body;
      const bare = await web.statuses([["/here", { method: "POST", body: "{}" }]]);
      return { none, refused: refused.map(one => one.status), taken: taken.body, runs, bare };]=])
    assert.equal("[]\n", said.none)
    assert.same({ 404, 404, 403 }, said.refused)
    assert.same({ file = "shot.lua", line = 2, count = 1 }, json.decode(said.taken))
    assert.same({ { 3, 48 } }, json.decode(said.runs))
    assert.same({ 403 }, said.bare)
  end)
end)

describe("the page of celspan watch over its picture #plain", function()
  if not present.program "chromium" then return pending "there is no chromium" end

  local COLOUR = [[
    const colour = (id, x, y) => page.get(`(() => { const canvas = document.querySelector("#${id}");
      return canvas.hidden ? [] : [...canvas.getContext("2d").getImageData(
        Math.floor(${x} * canvas.width), Math.floor(${y} * canvas.height), 1, 1).data]; })()`);
    const click = what => page.get(`document.querySelector('${what}').click()`);
    await page.until(`${canvas("frame")} === "1"`);
    await page.press("ArrowRight"); await page.press("ArrowRight");
    await page.until(`${canvas("frame")} === "3"`);
  ]]

  it("has spans, and an outline of what a line made, which is also a strip over the sheet",
    function()
      local address = watching.watch()
      local said = watching.see(address, COLOUR .. [=[
        await page.press("s");
        await page.until(`document.querySelectorAll("#names li").length > 1`);
        await page.press("e");
        await page.until(`!document.querySelector("#overlay").hidden`);
        const spans = await colour("overlay", 0.1, 0.1);
        await page.press("e");
        await page.until(`document.querySelector("#overlay").hidden`);
        const server = new URL("]=] .. address .. [=[");
        server.pathname = "/here";
        await fetch(server,
          { method: "POST", body: JSON.stringify({ file: "shot.lua", line: 2 }) });
        await page.until(`!document.querySelector("#overlay").hidden`);
        // The ball is from 20 to 44 of 64.
        const border = await page.get(`(() => { const canvas = document.querySelector("#overlay");
          const row = canvas.getContext("2d").getImageData(0, canvas.height >> 1, canvas.width, 1);
          const list = [];
          for (let x = 0; x < canvas.width; x++) {
            if (row.data[4 * x + 3]) list.push(Math.round(x / canvas.width * 64));
          }
          return [...new Set(list)]; })()`);
        await page.until(`document.querySelector("#ticks").getContext("2d")
          .getImageData(document.querySelector("#ticks").width >> 1, 3, 1, 1).data[3] > 0`);
        const strip = await colour("ticks", 0.01, 0.15);
        await page.press("Escape");
        await page.until(`document.querySelector("#overlay").hidden`);
        return { spans, border, strip };]=])
      assert.same({ 60, 130, 255, 110 }, said.spans)
      assert.same({ 20, 44 }, said.border)
      assert.equal(0, said.strip[4])
    end)

  it("shows cels alone, hidden, without light and in focus", function()
    local said = watching.see(watching.watch(), COLOUR .. [=[
      const wait = async old => page.until(`[...document.querySelector("#canvas").getContext("2d")
        .getImageData(document.querySelector("#canvas").width >> 1,
          document.querySelector("#canvas").height >> 1, 1, 1).data].join() !== "${old}"`);
      await page.press("s");
      await page.until(`document.querySelectorAll("#names button").length === 15`);
      const seen = [];
      const press = async what => {
        const old = (await colour("canvas", 0.5, 0.5)).join();
        await click(`#names [aria-label="${what}"]`);
        await wait(old);
        seen.push((await colour("canvas", 0.5, 0.5)).join());
      };
      await press("Unlit: ball");
      await press("Hide: ball");
      await press("Hide: ball");
      await press("Solo: ground");
      await press("Solo: ball");
      return { seen, pressed: await page.get(`document.querySelector(
        '[aria-label="Unlit: ball"]').ariaPressed`) };]=])
    assert.same({ "204,51,51,255", "255,224,176,255", "204,51,51,255", "255,224,176,255",
                  "204,51,51,255" }, said.seen)
    assert.equal("true", said.pressed)
  end)

  it("shows the drawings around one as its camera sees them", function()
    watching.bench:write("shot.lua", PAN)
    local said = watching.see(watching.watch(), COLOUR .. [=[
      const pixels = () => page.get(`(() => { const canvas = document.querySelector("#canvas");
        return [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data]
          .join(); })()`);
      // The picture, when it has stayed the same for a while.
      const settled = async () => {
        for (let last = "";;) {
          const now = await pixels();
          if (now === last) return now;
          last = now;
          await page.pause(0.5);
        }
      };
      await page.until(`${canvas("size")}.split("x")[0] > 1000`);
      const plain = await settled();
      await page.press("n");
      while (await pixels() === plain) await page.pause(0.1);
      const before = plain.split(","), after = (await settled()).split(",");
      let shown = 0; // film units
      for (let i = 0; i < after.length; i += 4)
        shown += (before[i] !== after[i] || before[i + 1] !== after[i + 1]) / after.length * 4;
      shown *= 64 * 36;
      await page.press("ArrowRight");
      await page.until(`${canvas("frame")} === "4"`);
      await page.pause(0.7);
      await settled();
      // The ball of frame 5, in green, as large as the camera of frame 4 shows it.
      const changed = await page.get(`(() => { const canvas = document.querySelector("#canvas");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let i = 0; i < data.length; i += 4) count += data[i + 1] - data[i + 2] > 20;
        return count / canvas.width / canvas.height * 64 * 36; })()`);
      return { shown, changed };]=])
    -- The ball of frame 5 alone: what only the camera moves is not shown.
    assert.is_true(math.abs(said.shown - 16) < 3, said.shown)
    assert.is_true(math.abs(said.changed - 16) < 3, said.changed)
  end)

  it("compares any frame with one that is held", function()
    local said = watching.see(watching.watch(), COLOUR .. [=[
      const middle = (channel, value) => page.until(`(() => {
        const canvas = document.querySelector("#canvas");
        return canvas.getContext("2d").getImageData(canvas.width >> 1, canvas.height >> 1, 1, 1)
          .data[${channel}] === ${value}; })()`);
      await page.press("h");
      await page.press("d");
      await middle(1, 0);
      const same = await colour("canvas", 0.5, 0.5);
      await page.press("ArrowLeft");
      await page.until(`${canvas("frame")} === "2"`);
      // The ball of frame 3 is green there, and the ground of frame 2 is not.
      await middle(0, 255);
      const other = await colour("canvas", 0.5, 0.5), beside = await colour("canvas", 0.05, 0.05);
      await page.press("w");
      const left = await colour("canvas", 0.45, 0.5), right = await colour("canvas", 0.55, 0.5);
      return { same, other, beside, left, right,
               text: await page.get(`document.querySelector("#hold").textContent`) };]=])
    assert.same({ 0, 0, 0, 255 }, said.same)
    assert.same({ 0, 0, 0, 255 }, said.beside)
    assert.equal(255, said.other[1])
    assert.same({ 0, 35, 0, 255 }, said.left)
    assert.same({ 255, 224, 176, 255 }, said.right)
    assert.equal("Held: frame 3", said.text)
  end)

  it("shows the frame under the pointer over the scrubber, and guides over the picture", function()
    local said = watching.see(watching.watch(), COLOUR .. [=[
      const shown = id => page.get(`!document.querySelector("#${id}").hidden`);
      const box = await page.get(`(() => { const box = document.querySelector("#scrub")
        .getBoundingClientRect(); return [box.left, box.top, box.width, box.height]; })()`);
      await page.mouse("mouseMoved", box[0] + box[2] - 2, box[1] + box[3] / 2);
      await page.until(`document.querySelector("#thumb").dataset.frame === "48"`);
      const size = await page.get(`[document.querySelector("#thumb").width,
        document.querySelector("#thumb").height]`), middle = await colour("thumb", 0.5, 0.5);
      await page.mouse("mouseMoved", 200, 200);
      await page.until(`document.querySelector("#thumb").hidden`);
      const guides = [];
      for (let i = 0; i < 3; i++) {
        await page.press("a");
        guides.push([await shown("safe"), await shown("fields")].join());
      }
      return { size, middle, guides, fields: await page.get(
        `[...document.querySelectorAll("#fields div")]
          .map(one => one.textContent).join(" ")`) };]=])
    assert.same({ 160, 90 }, said.size)
    assert.same({ 0, 35, 0, 255 }, said.middle)
    assert.same({ "true,false", "false,true", "false,false" }, said.guides)
    assert.equal("1 2 3 4 5 6 7 8 9 10 11 12", said.fields)
  end)

  it("lists what cels and frames cost", function()
    local said = watching.see(watching.watch(), COLOUR .. [=[
      await page.press("c");
      await page.until(`document.querySelectorAll("#cost-rows tr").length === 3`);
      await page.until(`document.querySelectorAll("#slowest li").length === 3`);
      const names = await page.get(`[...document.querySelectorAll("#cost-rows th")]
        .map(one => one.textContent)`);
      const slowest = await page.get(`document.querySelector("#slowest button").textContent`);
      await click("#slowest button");
      await page.until(`"frame " + ${canvas("frame")} === "${slowest}"`);
      return names;]=])
    assert.same({ "the frame", "ground", "ball" }, said)
  end)
end)
