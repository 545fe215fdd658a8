-- The site that `./run docs site` makes of the Markdown: its links, its pictures and scripts, what
-- readers see without a script, and what axe-core finds.
local browsing = require "tests.support.browsing"
local markdown = require "tests.support.markdown"
local present = require "tests.support.present"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local AXE = "out/npm/node_modules/axe-core/axe.min.js"

if not present.site() then
  return pending "there is no node with markdown-it, or no python3 with pygments"
end

local MOST_BYTES = 33000 -- of scripts and styles, compressed
local SAMPLE = { "index.html", "first-hour.html", "lua-shapes.html",
  "source/tests/bench/beside.html" }

local bench, root
local pages = {} -- the text of each page of the site, by its address

setup(function()
  bench, root = workbench.new(), os.getenv "PWD"
  local code, _, err = bench:shell(("cd '%s' && node docs/site/make.js '%s/site'")
    :format(root, bench.folder))
  assert.equal(0, code, err)
  for _, path in ipairs((system.lines(("cd '%s/site' && find . -name '*.html'")
    :format(bench.folder)))) do
    pages[path:sub(3)] = bench:read("site/" .. path)
  end
end)
teardown(function() bench:remove() end)

--- The address of a link in a page, seen from the top of the site, and its anchor.
local function target_of(address, link)
  local path, anchor = link:match "^([^#]*)#?(.*)$"
  if path == "" then return address, anchor end
  path = (address:match "^(.*/)" or "") .. path
  repeat
    local before = path
    path = path:gsub("[^/]+/%.%./", "", 1)
  until path == before
  return path, anchor
end

local anchors = {} -- of each page

local function anchors_of(address)
  if not anchors[address] then
    local found = {}
    for id in pages[address]:gmatch ' id="([^"]*)"' do
      found[id] = (found[id] or 0) + 1
    end
    anchors[address] = found
  end
  return anchors[address]
end

--- What is wrong with a link; nil: nothing.
local function fault_of(address, link)
  local path, anchor = target_of(address, link)
  if not pages[path] and not bench:read("site/" .. path) then return "there is no " .. path end
  if not pages[path] or anchor == "" then return nil end
  if anchors_of(path)[anchor] ~= 1 then return path .. " has no section " .. anchor end
end

describe("the site #plain", function()
  it("links only to existing pages and sections, and loads nothing from another server", function()
    local faults, count = {}, 0
    for address, text in pairs(pages) do
      for tag, attributes in text:gmatch "<(%a+)( [^>]*)>" do
        for name, link in attributes:gmatch ' (%a+)="([^"]*)"' do
          local is_outside = link:find "^https?://" and tag == "a"
          if (name == "href" or name == "src") and not is_outside and not link:find "^data:" then
            count = count + 1
            faults[#faults + 1] = fault_of(address, link)
          end
        end
      end
    end
    assert.same({}, faults)
    assert.is_true(count > 5000, count)
  end)

  it("has a page for each page of the documentation, and a menu that leads to all", function()
    local menu = pages["index.html"]:match '<nav class="menu".-</nav>'
    for _, path in ipairs((system.lines "ls docs/*.md *.md")) do
      local address = path:match "([^/]*)%.md$":lower():gsub("^readme$", "index") .. ".html"
      assert.is_truthy(menu:find('href="' .. address .. '"', 1, true), address)
      local title = markdown.read(path):match "^# ([^\n]*)"
      assert.is_truthy(pages[address]:find("<h1[^>]*>" .. title:gsub("%p", "%%%0")), address)
    end
  end)

  it("has headings that are at most a level below the one before", function()
    for address, text in pairs(pages) do
      local last = 0
      for level in text:gmatch "<h(%d)" do
        assert.is_true(tonumber(level) <= last + 1, address)
        last = tonumber(level)
      end
    end
  end)

  it("has tables whose heads have words, if they have any", function()
    local heads, tables, walls = 0, 0, 0
    for address, text in pairs(pages) do
      assert.is_falsy(text:find "<th></th>", address)
      for class, after in text:gmatch "<table([^>]*)>%s*<(%a+)>" do
        tables, heads = tables + 1, heads + (after == "thead" and 1 or 0)
        if class == ' class="wall"' then walls = walls + 1 end
      end
    end
    assert.is_true(heads > 200 and heads < tables, heads .. " of " .. tables)
    assert.is_true(walls > 5)
    for _, name in ipairs { "index", "gallery" } do
      assert.is_truthy(pages[name .. ".html"]:find('<table class="wall">', 1, true))
    end
    assert.is_truthy(pages["lua-motion.html"]:find("<td></td>", 1, true))
  end)

  it("has pictures with a size and a text", function()
    local count = 0
    for address, text in pairs(pages) do
      for attributes in text:gmatch "<img ([^>]*)>" do
        count = count + 1
        local width, height = attributes:match 'width="(%d+)" height="(%d+)"'
        local said = attributes:match 'alt="([^"]+)"'
        assert.is_truthy(width and said and said ~= "result", address .. ": " .. attributes)
        local file = io.open(bench.folder .. "/site/" .. attributes:match 'src="([^"]*)"', "rb")
        local png = file:read(24):match "^\x89PNG........IHDR(........)"
        file:close()
        if png then assert.same(png, string.pack(">I4I4", width, height)) end
      end
    end
    assert.is_true(count > 150, count)
    -- This one moves: its size is in its extended header.
    assert.is_truthy(pages["first-hour.html"]:find 'dot.webp" [^>]*width="480" height="270"')
  end)

  it("plays a film where the picture of its name is", function()
    local film = pages["gallery.html"]:match "<video [^>]*>"
    assert.is_truthy(film:find('src="docs/pictures/little-one.mp4"', 1, true), film)
    assert.is_truthy(film:find('poster="pictures/little-one.webp"', 1, true), film)
    assert.is_truthy(film:find('width="960" height="540"', 1, true), film)
  end)

  it("shows each complete script with its name, and with its picture if it has one", function()
    local shown, with_stage = 0, 0
    for _, block in ipairs(markdown.blocks "docs/cookbook.md") do
      if block.language == "lua" and block.name ~= "plates" then
        local figure = pages["cookbook.html"]:match(
          ('<figure class="script" data%%-script="%s">.-</figure>'):format(block.name))
        assert.is_truthy(figure, block.name)
        assert.is_truthy(figure:find(block.name .. ".lua</b>", 1, true))
        shown = shown + 1
        if figure:find('<div class="stage">[^\n]*<img src="pictures/' .. block.name) then
          with_stage = with_stage + 1
        end
      end
    end
    assert.is_true(shown > 60 and with_stage == shown, with_stage .. " of " .. shown)
  end)

  it("shows no motion to those who want none: the first frame of a picture, or a better", function()
    local better = 'reduced-motion: reduce)" srcset="pictures/little-one.webp"'
    assert.is_truthy(pages["index.html"]:find(better, 1, true))
    local count = 0
    for _, text in pairs(pages) do
      for still in text:gmatch 'reduced%-motion: reduce%)" srcset="([^"]*still/[^"]*)"' do
        count = count + 1
        local bytes = bench:read("site/" .. still)
        local whole, flags = string.unpack("<I4", bytes, 5), bytes:byte(21)
        assert.equal(#bytes, whole + 8, still)
        assert.equal(0, flags & ~0x10, still)
        assert.is_truthy(bytes:find "^RIFF....WEBPVP8X.-VP8[ L]")
        assert.is_falsy(bytes:find("ANMF", 1, true), still)
      end
    end
    assert.is_true(count > 60, count)
  end)

  it("has small scripts and styles", function()
    local packed = system.output [[cd docs/site &&
      for i in *.css site.js live/* play/*; do gzip -9c $i; done | wc -c]]
    assert.is_true(tonumber(packed) <= MOST_BYTES and tonumber(packed) > 5000, packed)
    for address, text in pairs(pages) do
      assert.is_falsy(text:find "<style" or text:find "<script>" or text:find ' style="', address)
    end
  end)

  it("is not made of pages with dead links, or without a place in the menu", function()
    bench:shell(("mkdir -p '%s/tree/docs' && cp -r '%s/docs/site' '%s/tree/docs/site'")
      :format(bench.folder, root, bench.folder))
    local function refused(menu, files)
      bench:write("tree/docs/site/menu.json", menu)
      for name, text in pairs(files) do bench:write("tree/" .. name, text) end
      local code, _, err = bench:inside "cd tree && node docs/site/make.js ../refused"
      return code ~= 0 and err:match "Error: ([^\n]*)"
    end
    local menu = '{ "Begin": { "README.md": "celspan" } }'
    assert.equal("README.md: there is no docs/b.md",
      refused(menu, { ["README.md"] = "# celspan\n\nSee [this](docs/b.md).\n" }))
    assert.equal("docs/site/menu.json: docs/a.md is missing",
      refused(menu, { ["README.md"] = "# celspan\n\nText.\n", ["docs/a.md"] = "# A\n\nText.\n" }))
  end)

  it("plays the film of a work where it was made, and else shows its picture", function()
    bench:inside("mkdir -p works/docs/pictures/works works/out/docs/works")
    bench:inside(("cp -r '%s/docs/site' works/docs/site"):format(root))
    bench:write("works/docs/site/menu.json", '{ "Begin": { "README.md": "celspan" } }')
    bench:write("works/README.md", "# celspan\n\n![A cat](docs/pictures/works/cat.webp)\n")
    bench:write("works/docs/pictures/works/cat.webp",
      markdown.read "docs/pictures/works/moon_cat.webp")
    local function index()
      local code, _, err = bench:inside "cd works && node docs/site/make.js ../shown"
      assert.equal(0, code, err)
      return bench:read "shown/index.html"
    end
    assert.matches('<img src="pictures/works/cat.webp"', index(), 1, true)
    bench:write("works/out/docs/works/cat.mp4", "film")
    assert.matches('<video src="works/cat.mp4" poster="pictures/works/cat.webp"', index(), 1, true)
    assert.equal("film", bench:read "shown/works/cat.mp4")
  end)

  it("plays a plane in the page of its name, and links its picture in others", function()
    bench:inside("mkdir -p town/docs/pictures town/out/docs")
    bench:inside(("cp -r '%s/docs/site' town/docs/site"):format(root))
    bench:write("town/docs/site/menu.json",
      '{ "Begin": { "README.md": "celspan", "docs/town.md": "Town" } }')
    bench:write("town/README.md", "# celspan\n\n[![In](docs/pictures/town.webp)](docs/town.md)\n")
    bench:write("town/docs/town.md", "# Town\n\n![A town](pictures/town.webp)\n")
    bench:write("town/docs/pictures/town.webp", markdown.read "docs/pictures/town.webp")
    bench:write("town/out/docs/town.plane", "plane")
    bench:write("town/out/docs/celspan-film.js", "player")
    local code, _, err = bench:inside "cd town && node docs/site/make.js ../shown"
    assert.equal(0, code, err)
    local index, page = bench:read "shown/index.html", bench:read "shown/town.html"
    assert.matches('<a href="town.html"><img src="pictures/town.webp"', index, 1, true)
    assert.is_nil(index:find("celspan-film", 1, true))
    assert.matches('<celspan-film src="town.plane" autoplay loop controls', page, 1, true)
    assert.matches('src="celspan-film.js"></script>', page, 1, true)
    assert.same({ "plane", "player" },
      { bench:read "shown/town.plane", bench:read "shown/celspan-film.js" })
  end)
end)

if not present.program "chromium" then return pending "there is no chromium" end

--- What the steps return, in JavaScript, with the site at `site` and the addresses in `names`.
local function see(names, steps, seconds)
  return browsing.see("about:blank", ([=[
    const site = await require("./site.js")("%s/site"), names = "%s".split(" ");
    const size = (width, height) => page.call("Emulation.setDeviceMetricsOverride",
      { width, height, deviceScaleFactor: 1, mobile: false });
    const wish = value => page.call("Emulation.setEmulatedMedia",
      { features: [{ name: "prefers-color-scheme", value }] });
    await page.call("Network.enable");
    try { %s } finally { site.close(); }]=])
    :format(bench.folder, table.concat(names, " "), steps), seconds)
end

describe("a page of the site #plain", function()
  it("needs no script to be read, dark and light", function()
    local said = see({ "first-hour.html" }, [=[
      await page.call("Emulation.setScriptExecutionDisabled", { value: true });
      await size(1280, 800);
      await wish("light");
      await page.load(site.at(names[0]), /^http:/);
      const ground = () => page.get(`getComputedStyle(document.body).backgroundColor`);
      const grounds = [await ground()];
      for (const value of ["dark", "light", "auto"]) {
        const [x, y] = await page.get(`(() => { const box = document.querySelector(
          "[value=${value}]").parentElement.getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2]; })()`);
        await page.click(x, y);
        await page.until(`document.querySelector("[value=${value}]").checked`);
        grounds.push(await ground());
      }
      await wish("dark");
      grounds.push(await ground());
      const shown = await page.get(`["main p", ".menu [aria-current]", ".contents a", "main img"]
        .map(one => document.querySelector(one).checkVisibility()
          && document.querySelector(one).getBoundingClientRect().height > 10)`);
      await size(390, 844);
      await page.until(`innerWidth === 390`);
      const menu = `document.querySelector(".menu > details")`;
      const before = await page.get(`${menu}.getBoundingClientRect().height`);
      await page.click(60, 68);
      await page.until(`${menu}.getBoundingClientRect().height > ${before + 200}`);
      const hasNoScript = await page.get(`!document.querySelector(".copy")`);
      return { grounds, shown, hasNoScript };]=])
    local light, dark = said.grounds[1], said.grounds[2]
    assert.not_equal(light, dark)
    assert.same({ light, dark, light, light, dark }, said.grounds)
    assert.same({ true, true, true, true }, said.shown)
    assert.is_true(said.hasNoScript)
  end)

  it("keeps the choice between dark and light for the next one, with a script", function()
    local themes = see({ "index.html", "guide.html" }, [=[
      await wish("light");
      await page.load(site.at(names[0]), /^http:/);
      const themes = [];
      for (const value of ["dark", "light"]) {
        await page.get(`document.querySelector("[value=${value}]").click()`);
        await page.load(site.at(names[1]), /^http:/);
        themes.push(await page.get(`document.querySelector("[name=theme]:checked").value + " "
          + getComputedStyle(document.documentElement).colorScheme`));
      }
      return themes;]=])
    assert.same({ "dark dark", "light light" }, themes)
  end)

  --- What axe-core finds in a page, dark and light; whether it is wider than a telephone; and what
  --- it loads from elsewhere. parts: those that are looked at, in JavaScript.
  local function faults_of(address, parts)
    local said = see({ address }, [=[
      const axe = require("fs").readFileSync("]=] .. AXE .. [=[", "utf8"), found = [];
      const look = async (where, least, rules) => {
        const one = await page.get(`axe.run(]=] .. parts .. [=[, { ${rules}
          resultTypes: ["violations"] }).then(all => ({ passed: all.passes.length,
          bad: all.violations.map(({ id, nodes }) => id + " at " + nodes.length + " places: "
            + nodes[0].target + ": " + nodes[0].failureSummary) }))`);
        found.push(...one.bad.map(bad => where + ": " + bad));
        if (one.passed < least) found.push(where + ": only " + one.passed + " rules passed");
      };
      await wish("light");
      await size(1280, 800);
      await page.load(site.at(names[0]), /^http:/);
      await page.get(axe + "; 0");
      await look("light", 15, "");
      await wish("dark");
      await look("dark", 1, "runOnly: ['color-contrast', 'link-in-text-block'],");
      await size(390, 844);
      await page.settle();
      if (await page.get(`document.documentElement.scrollWidth > innerWidth`)) {
        found.push("wider than a telephone");
      }
      const outside = one => !one.startsWith(site.at("")) && !one.startsWith("data:");
      found.push(...page.requests.filter(outside));
      return { found, requests: page.requests.length };]=])
    assert.is_true(said.requests > 2, said.requests)
    return said.found
  end

  if io.open(AXE) then
    for _, address in ipairs(SAMPLE) do
      it(address .. " has no fault that axe-core finds", function()
        assert.same({}, faults_of(address, "document"))
      end)
    end

    -- One address in eight; all with ./run test --all. Without the words of code, which take long,
    -- and have the same few colours everywhere.
    it("on other addresses has no fault that axe-core finds #full", function()
      local addresses, found = {}, {}
      for address in pairs(pages) do addresses[#addresses + 1] = address end
      table.sort(addresses)
      local is_all = (tonumber(os.getenv "CELSPAN_SCENES") or 0) >= 300
      for i = 1, #addresses, is_all and 1 or 8 do
        for _, fault in ipairs(faults_of(addresses[i], '{ exclude: "pre span" }')) do
          found[#found + 1] = addresses[i] .. ": " .. fault
        end
      end
      assert.same({}, found)
    end)
  else
    pending "axe-core was not fetched"
  end
end)
