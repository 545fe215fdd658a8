-- celspan plane: the page, what its decoder draws, and what is refused.
local library = require "celspan"
local browsing = require "tests.support.browsing"
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.pages() then return pending "celspan was built without clang and lld" end

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 160, 90 }, frames = 1, frame = function()
  return celspan.rostrum { back = "#204060", celspan.cel {
    celspan.circle { centre = { 80, 45 }, radius = 30, texture = "#f26419" },
    celspan.rect { 78, 43, 0.01, 4, texture = "#ffffff" } } }
end }
]]

-- Loads the decoder and a plane from a page, as the page does.
local DECODER = [[
  async function decoder_of(path) {
    const html = require("fs").readFileSync(path, "utf8");
    const part = pattern => Buffer.from(pattern.exec(html)[1], "base64");
    const module = require("zlib").gunzipSync(part(/const DECODER = "([^"]*)"/));
    const { instance: { exports } } = await WebAssembly.instantiate(module);
    const plane = part(/<script id="plane"[^>]*>([^<]*)</), address = exports.reserve(plane.length);
    new Uint8Array(exports.memory.buffer, address).set(plane);
    const bytes = (address, count) =>
      Buffer.from(new Uint8Array(exports.memory.buffer, address, count));
    const reason = exports.open(0);
    const said = reason && bytes(reason, 120).toString().replace(/\0[^]*/, "");
    return { exports, bytes, said };
  }
]]

local bench

before_each(function()
  bench = workbench.new()
  bench:write("film.lua", FILM)
end)
after_each(function() bench:remove() end)

local function done(command, ...)
  local code, out, err = bench:inside(command:format(...))
  assert.equal(0, code, err)
  return out
end

local function celspan(arguments, ...)
  return done("'%s' " .. arguments, workbench.absolute, ...)
end

--- What the body of an asynchronous function returns under node.
local function node(steps)
  bench:write("steps.js", DECODER .. ";(async () => {" .. steps
    .. "})().then(said => console.log(JSON.stringify(said)))")
  return assert(json.decode(done "node steps.js"))
end

local function see(steps) return browsing.see("about:blank", steps) end

local it_decodes = present.program "node" and it or pending
local it_shows = present.program("node", "chromium") and it or pending

describe("the page of a plane", function()
  it_decodes("draws the pixels of the library, to the bit #plain", function()
    local make_random = workbench.build .. "/subprojects/planefile/tests/make_random"
    done("'%s' . 48 57 43", make_random)
    local absent = 0 -- the pictures of which are known by name alone
    for i = 0, 47 do
      local code, _, err = bench:celspan_inside("plane %d.plane -o %d.html", i, i)
      if code ~= 0 then
        assert.matches("its pixels are not there", err, 1, true)
        absent = absent + 1
      end
    end
    assert.is_true(absent > 0 and absent < 12)
    local said = node [[
      const fs = require("fs"), wrong = [];
      for (let i = 0; i < 48; i++) {
        if (!fs.existsSync(`${i}.html`)) continue;
        const { exports, bytes, said } = await decoder_of(`${i}.html`);
        const drawn = said || bytes(exports.draw(57, 43, 0, 0, 57, 43), 4 * 57 * 43);
        const crop = said || bytes(exports.draw(57, 43, 20, 10, 1, 1), 4), at = 4 * (57 * 10 + 20);
        const codes = fs.readFileSync(`${i}.codes`);
        if (said || drawn.compare(codes) || crop.compare(codes.subarray(at, at + 4))) wrong.push(i);
      }
      return { wrong };]]
    assert.same({}, said.wrong)
  end)

  it_decodes("says what is wrong with a plane that was altered", function()
    celspan "render film.lua -o a.plane"
    celspan "plane a.plane -o a.html"
    local said = node [[
      const fs = require("fs"), html = fs.readFileSync("a.html", "utf8");
      const start = html.indexOf('<script id="plane"'), middle = html.indexOf(">", start) + 100;
      const other = html[middle] === "A" ? "B" : "A";
      fs.writeFileSync("b.html", html.slice(0, middle) + other + html.slice(middle + 1));
      const { exports, said } = await decoder_of("b.html");
      return { said, size: [exports.draw(1 << 31, 0, 0, 0, 1, 1)] };]]
    assert.matches("the checksum is wrong", said.said, 1, true)
  end)

  it_decodes("shows pictures as they are rendered", function()
    bench:write("film.lua", (FILM:gsub('texture = "#ffffff"', [[
      texture = celspan.picture { size = { 4, 4 },
        pixels = ("\10\200\90\255\99\0\7\255"):rep(8) }]])
      :gsub("78, 43, 0.01, 4", "30, 20, 100, 50")))
    celspan "render film.lua -o a.plane"
    celspan "plane a.plane -o a.html"
    local said = node [[
      const { exports, bytes, said } = await decoder_of("a.html");
      require("fs").writeFileSync("a.pixels", bytes(exports.draw(320, 180, 0, 0, 320, 180),
        4 * 320 * 180));
      return { said };]]
    assert.is_nil(said.said and said.said ~= 0 and said.said or nil)
    local plane = assert(library.plane_read(bench.folder .. "/a.plane"))
    local drawn = bench:read "a.pixels"
    assert.is_true(drawn == plane:pixels { size = { 320, 180 } }:bytes())
    assert.is_true(drawn:find("\10\200\90\255", 1, true) ~= nil)
  end)

  it("has a picture of the first frame, which is there without script", function()
    bench:write("film.lua", (FILM:gsub("frames = 1", "fps = 8, frames = 3")
      :gsub("function%(%)", "function(f)"):gsub("{ 80, 45 }", "{ 20 * f.number, 45 }")))
    celspan "render film.lua -o a.plane"
    celspan "plane a.plane -o a.html"
    local page = bench:read "a.html":gsub("<script.->.-</script>", "")
    bench:write("a.base64", page:match '<img src="data:image/png;base64,([^"]*)" alt="a.plane">')
    done "base64 -d a.base64 >a.png"
    celspan "convert a.plane b.png --frame 1 --size 1280x720"
    assert.matches("largest_difference 0 ", celspan "compare a.png b.png --fail 0.002", 1, true)
  end)

  it("has a player of at most 45 KB, packed, and loads nothing", function()
    celspan "render film.lua -o a.plane"
    celspan 'plane a.plane -o a.html --title "a <b> & \\"c\\""'
    celspan "plane -o celspan-film.js"
    local page = bench:read "a.html"
    assert.is_true(page:find(bench:read "celspan-film.js", 1, true) ~= nil)
    assert.is_true(tonumber(done "gzip -9c celspan-film.js | wc -c") <= 45 * 1000)
    assert.matches("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>", page, 1, true)
    assert.is_nil(page:match "https?:")
    assert.is_nil(page:match "@%u+@")
  end)

  it_shows("shows the plane, sharp at a depth of ten thousand #plain", function()
    celspan "render film.lua -o a.plane"
    celspan "plane a.plane -o a.html"
    local said = see(([=[
      await page.load("file://%s/a.html");
      const root = "film.shadowRoot", fault = `${root}.getElementById("fault").textContent`;
      const pixel = (x, y) => `[...${root}.querySelector("canvas")?.getContext("2d")
        .getImageData(${x}, ${y}, 1, 1).data ?? []]`;
      const at = (x, y) => page.get(pixel(x, y));
      const is_at = (x, y, colour) => page.until(`${pixel(x, y)}.join() === "${colour}"`);
      await is_at(600, 400, "242,100,25,255");
      await page.until("where.textContent");
      const whole = { corner: await at(100, 100), text: await page.get("where.textContent"),
                      fault: await page.get(fault), address: await page.get("location.hash") };
      await page.get("location.hash = '78.005,45,0.016'");
      await page.until("Math.abs(film.view.width - 0.016) < 1e-7");
      await page.until("/10,\\d\\d\\d$/.test(where.textContent)");
      await is_at(230, 400, "242,100,25,255");
      await is_at(640, 400, "255,255,255,255");
      const deep = { left: await at(230, 400), middle: await at(640, 400),
                     right: await at(1050, 400),
                     text: await page.get("where.textContent"),
                     width: await page.get("film.view.width") };
      await page.press("0");
      await is_at(640, 50, "32,64,96,255");
      await page.until("film.view.factor < 1.000001");
      await page.press("+");
      await page.until("/^#80,45,10[67]/.test(location.hash)");
      await page.load();
      await page.until("where.textContent.endsWith('1.5')");
      return { whole, deep };]=]):format(bench.folder))
    assert.same({ 32, 64, 96, 255 }, said.whole.corner)
    assert.same({ "", "" }, { said.whole.fault, said.whole.address })
    assert.matches("^80, 45 ", said.whole.text)
    assert.same({ { 242, 100, 25, 255 }, { 255, 255, 255, 255 }, { 242, 100, 25, 255 } },
      { said.deep.left, said.deep.middle, said.deep.right })
    assert.matches("^78%.005, 45 ", said.deep.text)
    assert.is_true(math.abs(said.deep.width - 0.016) < 1e-6, said.deep.width)
  end)

  it_shows("plays a film, and shows any frame of it #plain", function()
    bench:write("film.lua", (FILM:gsub("frames = 1", "fps = 8, frames = 12")
      :gsub("function%(%)", "function(f)"):gsub("{ 80, 45 }", "{ 20 * f.number, 45 }")))
    celspan "render film.lua -o a.plane"
    celspan "plane a.plane -o a.html"
    local said = see(([=[
      await page.load("file://%s/a.html");
      const part = id => `film.shadowRoot.getElementById("${id}")`;
      const at = x => page.get(`[...${part("view")}.getContext("2d")
        .getImageData(${x}, 400, 1, 1).data]`);
      const text = () => page.get(`${part("number")}.textContent`);
      await page.until("where.textContent");
      const first = [await text(), await at(160), await at(640)];
      for (let i = 0; i < 3; i++) await page.press(".");
      await page.pause(0.3);
      const fourth = [await text(), await at(160), await at(640)];
      await page.press(" ");
      await page.until("film.currentTime === 7 / 8");
      await page.press(",");
      await page.pause(0.5);
      const stopped = await page.get("film.paused");
      await page.get(`${part("frame")}.value = 12; ${part("frame")}.oninput()`);
      const is_free = await page.get(`${part("frame")}.dispatchEvent(new KeyboardEvent("keydown",
        { key: "ArrowRight", bubbles: true, cancelable: true }))`); // the slider's own key
      const last = await text();
      await page.press(".");
      return { first, fourth, stopped, last, is_free, again: await text(),
               fault: await page.get(`${part("fault")}.textContent`) };]=]):format(bench.folder))
    local orange, blue = { 242, 100, 25, 255 }, { 32, 64, 96, 255 }
    assert.same({ "1 / 12", orange, blue }, said.first)
    assert.same({ "4 / 12", blue, orange }, said.fourth)
    assert.same({ true, true }, { said.stopped, said.is_free })
    assert.same({ "12 / 12", "1 / 12", "" }, { said.last, said.again, said.fault })
  end)

  it("is made of plane files only, and needs a name", function()
    for _, one in ipairs {
      { 2, "-o is missing: give -o page.html", "plane a.plane" },
      { 2, "give it a name that ends in .html", "plane a.plane -o a.plane" },
      { 2, "give it a name that ends in .html", "plane a.plane -o a.js" },
      { 2, "which plane?", "plane -o a.html" },
      { 4, "this is not a plane file", "plane film.lua -o a.html" },
      { 4, "No such file", "plane none.plane -o a.html" },
    } do
      local code, _, err = bench:celspan_inside(one[3])
      assert.equal(one[1], code, err)
      assert.matches(one[2], err, 1, true)
    end
    assert.is_nil(bench:read "a.html")
  end)
end)
