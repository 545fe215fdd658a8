-- The extension for Visual Studio Code, with a substitute for the editor (support/vscode.js).
local json = require "celspan.json"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.web() then return pending "celspan was built without libmicrohttpd" end
if not present.program "node" then return pending "there is no node" end

local FILM = [[
local celspan = require "celspan"
return celspan.film { size = { 64, 36 }, fps = 24, frames = 48, frame = function(f)
  return celspan.rostrum {
    celspan.cel { celspan.circle { centre = { 10 + f.index, 18 }, radius = 6, texture = "#c33" } }
      :named "ball",
  }
end }
]]

local bench

before_each(function()
  bench = workbench.new()
  bench:write("shot.lua", FILM)
end)

after_each(function() bench:remove() end)

--- What the steps return.
local function run(steps)
  local path = bench:write("steps.js", steps)
  local code, out, err = bench:shell(("node tests/support/vscode.js '%s' '%s/shot.lua' '%s'")
    :format(workbench.absolute, bench.folder, path))
  assert.equal(0, code, err)
  return assert(json.decode(out))
end

describe("the extension for Visual Studio Code", function()
  it("shows the film beside its script, and jumps both ways", function()
    local said = run [=[
      const picture = number => desk.messages.find(one => one.kind === "picture"
        && one.value.number === number);
      const red = ({ bytes, width }, x, y) =>
        bytes.slice(4 * (y * width + x), 4 * (y * width + x) + 4);
      desk.edit(3);
      await desk.run("celspan.watch");
      const first = await desk.until(() => picture(1));
      desk.say({ frame: 20 });
      const later = await desk.until(() => picture(20));
      desk.say({ at: [29, 18] });
      const { value: hits } = await desk.until(() =>
        desk.messages.find(one => one.kind === "hits"));
      await desk.say({ open: hits[0] });
      await desk.run("celspan.here");
      const { value: made } = await desk.until(() =>
        desk.messages.find(one => one.kind === "outline"));
      await desk.run("celspan.browser");
      const child = desk.panel;
      await desk.run("celspan.stop");
      return { first: red(first.value, 10, 18), later: red(later.value, 29, 18), hits,
               shown: desk.shown, inside: red(made, 29, 18), outside: red(made, 2, 2),
               html: desk.panel.webview.html.includes("NONCE"), external: desk.external,
               isClosed: child.isClosed, errors: desk.errors };]=]
    assert.same({ 204, 51, 51, 255 }, said.first)
    assert.same({ 204, 51, 51, 255 }, said.later)
    assert.equal("ball", said.hits[2].name)
    assert.same({ { bench.folder .. "/shot.lua", 3 } }, said.shown)
    assert.equal(255, said.inside[4])
    assert.equal(0, said.outside[4])
    assert.is_false(said.html)
    assert.truthy(said.external[1]:find "^http://127%.0%.0%.1:%d+/%?token=%x+$")
    assert.is_true(said.isClosed)
    assert.same({}, said.errors)
  end)

  it("lists the errors of the film at their lines, until they are gone", function()
    local said = run [=[
      const file = desk.fs.realpathSync(process.argv[3]), good = desk.fs.readFileSync(file, "utf8");
      desk.edit(0);
      await desk.run("celspan.watch");
      await desk.until(() => desk.messages.some(one => one.kind === "picture"));
      desk.fs.writeFileSync(file, "\nlocal x = = 3");
      const problems = [...await desk.until(() => desk.problems.size > 0 && desk.problems)];
      desk.fs.writeFileSync(file, good);
      await desk.until(() => desk.problems.size === 0);
      return { problems, shown: desk.messages.filter(one => one.kind === "errors").length > 2 };]=]
    assert.equal(1, #said.problems)
    local _, list = table.unpack(said.problems[1])
    assert.same({ { 1, "shot.lua:2: unexpected symbol near '='" } }, list)
    assert.is_true(said.shown)
  end)

  it("says what is missing", function()
    local said = run [=[
      await desk.run("celspan.watch");
      await desk.run("celspan.here");
      await desk.run("celspan.browser");
      return desk.errors;]=]
    assert.same({ "celspan: open the Lua script of a film first", "celspan: watch a film first",
                  "celspan: watch a film first" }, said)
  end)
end)
