-- The npm package of the player, which ./run player makes, in an empty project: with the example of
-- docs/player.md, without a bundler and with one.
local browsing = require "tests.support.browsing"
local markdown = require "tests.support.markdown"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.pages() then return pending "celspan was built without clang and lld" end
if not present.program("node", "npm", "chromium") then
  return pending "there is no node, npm or chromium"
end

local ESBUILD = "out/npm/node_modules/.bin/esbuild"

local bench

local function done(command, ...)
  local code, out, err = bench:inside(command:format(...))
  assert.equal(0, code, out .. err)
  return out
end

-- The project is the folder: the files of docs/player.md, and the package from its archive.
setup(function()
  bench = workbench.new()
  local root = io.popen("pwd"):read "l"
  done("'%s/packaging/player.sh' '%s' package", root, workbench.absolute)
  done "cd package && npm pack --silent"
  done "npm init -y && npm install --offline --no-audit --no-fund ./package/*.tgz"
  markdown.save("docs/player.md", bench.folder, function() return true end)
  for line in markdown.read "docs/player.md":gmatch "\ncelspan ([^\n]*)" do
    local code, _, err = bench:celspan_inside("%s", line)
    assert.equal(0, code, err)
  end
end)
teardown(function() bench:remove() end)

--- What the page of the example shows, with another script: the size of the film, and a colour.
local function shown(script)
  local page = bench:read "index.html"
  local changed = page:gsub('src="celspan%-film.js"', ('src="%s"'):format(script))
  bench:write("page.html", changed)
  local said = browsing.see("about:blank", ([=[
    const site = await require("./site.js")("%s");
    try {
      await page.load(site.at("page.html"), /^http:/);
      await page.until("document.querySelector('celspan-film').view");
      await page.get(`film = document.querySelector("celspan-film"), film.currentTime = 1, 0`);
      await page.pause(0.3);
      return page.get(`[film.clientWidth, film.clientHeight, film.duration, film.shadowRoot
        .getElementById("view").getContext("2d").getImageData(100, 250, 1, 1).data.join()]`);
    } finally { site.close(); }]=]):format(bench.folder))
  assert.same({ 640, 360, 2, "74,82,127,255" }, said)
end

describe("the npm package of the player #plain", function()
  it("has no dependencies, and the files that it lists", function()
    local listed = done "ls node_modules node_modules/celspan-film"
    for _, name in ipairs { "LICENSE", "README.md", "celspan-film.d.ts", "celspan-film.js",
      "package.json" } do
      assert.matches("\n" .. name .. "\n", listed, 1, true)
    end
    assert.is_nil(bench:read "node_modules/celspan-film/package.json":find '"dependencies"')
    assert.is_nil(bench:read "node_modules/celspan-film/README.md":find "](", 1, true)
    done "node -e 'require(\"celspan-film\"); import(\"celspan-film\")'"
  end)

  it("is used by the page of the documentation as it is", function()
    shown "node_modules/celspan-film/celspan-film.js"
  end)

  it("is bundled by esbuild", function()
    if not io.open(ESBUILD) then return pending "esbuild was not fetched" end
    bench:write("main.js", 'import "celspan-film";\n')
    done("'%s/%s' main.js --bundle --minify --format=esm --outfile=bundle.js",
      io.popen("pwd"):read "l", ESBUILD)
    shown "bundle.js"
  end)
end)
