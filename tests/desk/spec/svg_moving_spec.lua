-- Drawings that move: at(seconds), how long they move, what is not run, and bad input; and the
-- pictures of a browser at the same times.
local celspan = require "celspan"
local browsing = require "tests.support.browsing"
local moving = require "tests.support.moving"
local present = require "tests.support.present"
local svg = require "celspan.svg"
local workbench = require "tests.support.workbench"

if not present.type() then return pending "celspan was built without expat" end

local bench

setup(function() bench = workbench.new() end)
teardown(function() bench:remove() end)

-- ---------------------------------------------------------------- a browser

local SIDE, COLUMNS = 100, 10 -- of a picture; of pictures in a row
-- Pictures are alike if at most this share of the pixels is off by more than NEAR codes. The edges
-- of large circles are drawn with other coverage; a scene that moves in another way fails in most
-- of its five pictures, and then fewer than ALIKE are alike.
local SHARE, NEAR, ALIKE = 0.01, 24, 0.98

--- All drawings at a time, in rows, as the codes of a picture.
local function sheet(arts, seconds)
  local cels = {}
  for i, art in ipairs(arts) do
    local x, y = (i - 1) % COLUMNS * SIDE, (i - 1) // COLUMNS * SIDE
    local area = celspan.rect { 0, 0, SIDE, SIDE }
    cels[i] = celspan.cel { celspan.clip(art:at(seconds), area):translate(x, y) }
  end
  cels.back = "#ffffff"
  local rostrum = celspan.rostrum(cels)
  local film = celspan.film { size = { COLUMNS * SIDE, math.ceil(#arts / COLUMNS) * SIDE },
                              frames = 1, space = "srgb", frame = function() return rostrum end }
  return assert(celspan.pixels(film)):bytes { depth = 8 }
end

local FRAME = "<!doctype html><style>body{margin:0;overflow:hidden}svg{display:block}</style>"
-- The animations of styles are paused at once: those that are over are listed no longer.
local PAUSE = [[<script>window.running = document.getAnimations()
  .filter(one => one.playState != "paused"); running.forEach(one => one.pause())</script>]]

-- The number of pixels of each picture that are off, at each time.
local STEPS = [==[
  const fs = require("fs");
  const { folder, times, count, side, columns, near } = %s;
  await page.call("Emulation.setDeviceMetricsOverride",
    { width: side * columns, height: 900, deviceScaleFactor: 1, mobile: false });
  await page.load("file://" + folder + "/page.html", /^file:/);
  const found = [];
  for (const [i, seconds] of times.entries()) {
    await page.get(`(async () => {
      for (const frame of document.querySelectorAll("iframe")) {
        const root = frame.contentDocument.querySelector("svg");
        root.pauseAnimations();
        root.setCurrentTime(${seconds});
        for (const one of frame.contentWindow.running) one.currentTime = ${seconds} * 1000;
      }
      await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
    })()`);
    const { data } = await page.call("Page.captureScreenshot", { format: "png" });
    const codes = fs.readFileSync(folder + "/" + i + ".codes").toString("base64");
    found.push(await page.get(`(async () => {
      const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes("${data}")]));
      const [side, columns] = [${side}, ${columns}];
      const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
      canvas.drawImage(image, 0, 0);
      const theirs = canvas.getImageData(0, 0, image.width, image.height).data;
      const ours = bytes("${codes}");
      const off = [];
      for (let n = 0; n < ${count}; n++) {
        off[n] = 0;
        for (let y = 0; y < side; y++) for (let x = 0; x < side; x++) {
          const row = Math.floor(n / columns) * side + y;
          const at = row * side * columns + n %% columns * side + x;
          let most = 0;
          for (let c = 0; c < 3; c++) {
            most = Math.max(most, Math.abs(ours[at * 4 + c] - theirs[at * 4 + c]));
          }
          off[n] += most > ${near};
        }
      }
      return off;
    })()`));
  }
  return found;
]==]

--- For each time, how many pixels of each scene are off.
local function compared(scenes)
  local arts, page = {}, { "<!doctype html><style>body{margin:0;line-height:0;width:1000px}"
    .. "iframe{border:0;vertical-align:top}</style>" }
  for i, scene in ipairs(scenes) do
    local text = moving.document(scene)
    arts[i] = svg.load(bench:write(i .. ".svg", text))
    page[#page + 1] = ('<iframe width="%d" height="%d" srcdoc="%s"></iframe>'):format(SIDE, SIDE,
      (FRAME .. text .. PAUSE):gsub("&", "&amp;"):gsub('"', "&quot;"))
  end
  bench:write("page.html", table.concat(page))
  for i, seconds in ipairs(moving.times) do
    bench:write(i - 1 .. ".codes", sheet(arts, seconds))
  end
  local given = '{ folder: "%s", times: [%s], count: %d, side: %d, columns: %d, near: %d }'
  given = given:format(bench.folder, table.concat(moving.times, ", "), #scenes, SIDE, COLUMNS,
    NEAR)
  return browsing.see("about:blank", STEPS:format(given), 120)
end

describe("a browser shows the same", function()
  if not present.program("chromium", "node") then
    return pending "there is no chromium or no node"
  end

  local function agrees(name, scenes)
    local alike, all, others = 0, 0, {}
    for i, counts in ipairs(compared(scenes)) do
      for scene, off in ipairs(counts) do
        local is_alike = off <= SHARE * SIDE * SIDE
        all, alike = all + 1, alike + (is_alike and 1 or 0)
        if not is_alike then
          others[#others + 1] = ("%d at %g s: %d pixels"):format(scene, moving.times[i], off)
        end
      end
    end
    if os.getenv "CELSPAN_VERBOSE" then print("# " .. table.concat(others, "\n# ")) end
    print(("# %s: %d of %d pictures are alike"):format(name, alike, all))
    assert.is_true(alike >= ALIKE * all, table.concat(others, "\n"))
  end

  it("as animate, set, animateTransform and animateMotion", function()
    agrees("SMIL", moving.smil)
  end)

  it("as @keyframes", function() agrees("keyframes", moving.styles) end)

  it("on a path of the style, and with lists of stops", function()
    agrees("paths", moving.paths)
  end)
end)

-- ---------------------------------------------------------------- without a browser

local count = 0

--- A drawing with these contents.
local function read(text)
  count = count + 1
  return svg.load(bench:write(("drawing-%d.svg"):format(count), moving.document { text }))
end

--- A rectangle of 10 by 10 with animations inside it.
local function box(text) return ('<rect width="10" height="10">%s</rect>'):format(text) end

--- Where the first thing of a drawing begins in x at a time.
local function x_at(art, seconds) return (art:at(seconds):bounds()) end

describe("a drawing", function()
  it("moves, and is the same as the file without its animations", function()
    local art = read(box '<animate attributeName="x" from="20" to="60" dur="2s" fill="freeze"/>')
    assert.are.equal(2, art.seconds)
    assert.are.equal(0, (art.object:bounds()))
    assert.are.same({ 20, 40, 60, 60 }, { x_at(art, 0), x_at(art, 1), x_at(art, 2), x_at(art, 9) })
    assert.are.same({}, art.skipped)
  end)

  it("is rendered as it is at the beginning, where it is set for ever", function()
    local path = bench:write("set.svg", moving.document { box '<set attributeName="x" to="40"/>' })
    assert.is_nil(svg.load(path).seconds)
    local code, out, err = bench:celspan("probe %s 42 2", path)
    assert.same({ 0, "" }, { code, err })
    local _, beside = bench:celspan("probe %s 2 2", path)
    assert.are_not.equal(out, beside)
    assert.matches("0 0 0 0", beside)
  end)

  it("says how long it moves", function()
    local function seconds(text) return read(text).seconds end
    local function moves(more) return box('<animate attributeName="x" to="9" ' .. more .. "/>") end
    assert.is_nil(seconds(box ""))
    assert.are.equal(3.5, seconds(moves 'dur="1s" begin="0; 2.5s"'))
    assert.are.equal(4, seconds(moves 'dur="4s" repeatCount="indefinite"'
      .. moves 'dur="3s" repeatDur="indefinite"'))
    assert.are.equal(1, seconds(moves 'dur="4s" repeatCount="indefinite"' .. moves 'dur="1s"'))
    -- two that wait for each other, for ever: the time from one beginning to the next
    assert.are.equal(3, seconds(moves 'id="a" dur="1s" begin="0;b.end"'
      .. moves 'id="b" dur="2s" begin="a.end"'))
    local style = "<style>@keyframes k{to{fill:red}}rect{animation:k %s}</style>" .. box ""
    assert.are.equal(2.25, seconds(style:format "1s 0.25s 2"))
    assert.are.equal(1.5, seconds(style:format "1500ms infinite"))
    assert.is_nil(seconds(style:format "1s paused"))
  end)

  it("lists what is not run", function()
    local function notes(text)
      local list = {}
      for i, note in ipairs(read(text).skipped) do list[i] = note.what end
      return list
    end
    local function begins(text)
      return notes(box(('<animate attributeName="x" to="9" dur="1s" begin="%s"/>'):format(text)))
    end
    for _, text in ipairs { "click", "other.click+1s", "nobody.end", "indefinite", "nan",
                            "accessKey(a)", "wallclock(2026-11-26)" } do
      assert.are.same({ ('animate: begin "%s" is not run'):format(text) }, begins(text))
    end
    assert.are.same({}, begins "0; 1s; -2s; 00:01; 01:00:02.5; 3min; 200ms")
    assert.are.same({ "animate of unheard" }, notes(box '<animate attributeName="unheard"/>'))
    assert.are.same({ "script" }, notes "<script/>")
    assert.are.same({ 'offset-path "ray(0deg)"' },
      notes("<style>@keyframes k{to{offset-path:ray(0deg)}}</style>" .. box ""))
  end)

  it("opens its file once: other times do not need it", function()
    local slide = '<animate attributeName="x" values="0;40" dur="1s"/>'
    local paused = "<style>@keyframes k{to{x:40px}} rect{x:0;animation:k 1s linear -0.5s paused}"
      .. "</style>" .. box ""
    bench:write("inner.svg", moving.document { box(slide) })
    for i, text in ipairs { box(slide), paused,
                            '<image href="inner.svg" width="100" height="100"/>' } do
      local path = bench:write("gone.svg", moving.document { text })
      local art = svg.load(path)
      assert(os.remove(path))
      assert.are.near(20, x_at(art, 0.5), 1e-9, i)
    end
    local path = bench:write("gone.svg", moving.document { box "" })
    local still = svg.load(path)
    assert(os.remove(path))
    assert.are.same({ still.object:bounds() }, { still:at(3):bounds() })
  end)

  it("refuses invalid times", function()
    local art = read(box "")
    for _, value in ipairs { -1, 0 / 0, math.huge, 1e13, "1", {} } do
      assert.has_error(function() art:at(value) end)
    end
    assert.has_error(function() art:at() end)
    local changed = art:with { ["#1"] = function(part) return part end }
    assert.has_error(function() changed:at(1) end)
    assert.is_nil((read(""):at(1e12):bounds()))
  end)
end)

describe("times", function()
  --- Where each box of a drawing is in x at a time, of `lanes` of 10 px.
  local function places(seconds, ...)
    local boxes = {}
    for i, text in ipairs { ... } do
      boxes[i] = ('<rect width="10" height="10" y="%d"><animate attributeName="x" values="20;40" '
        .. 'fill="freeze" %s/></rect>'):format(10 * i - 10, text)
    end
    local art, found = read(table.concat(boxes)), {}
    for i = 1, #boxes do
      local part = celspan.clip(art:at(seconds), celspan.rect { 0, 10 * i - 10, 100, 10 })
      local film = celspan.film { size = { 100, 10 * #boxes }, frames = 1,
                                  frame = function()
                                    return celspan.rostrum { celspan.cel { part } }
                                  end }
      local bytes, x = assert(celspan.pixels(film)):bytes { depth = 8 }, 0
      while bytes:byte(((10 * i - 5) * 100 + x) * 4 + 4) < 128 do x = x + 1 end
      found[i] = x
    end
    return found
  end

  it("keep an end that is known before the beginning", function()
    local first, second = 'id="a" dur="0.5s"', 'begin="1s" end="a.end+1.2s" dur="2s"'
    assert.are.same({ 40, 25 }, places(1.5, first, second))
    assert.are.same({ 40, 27 }, places(2.5, first, second))
  end)

  it("know a beginning before the one that it follows", function()
    local first, second = 'id="a" begin="3s" dur="1s"', 'begin="a.begin-2s" dur="2s"'
    assert.are.same({ 0, 30 }, places(2, first, second))
    assert.are.same({ 24, 30 },
      places(2, 'id="a" begin="1s" dur="5s"', 'begin="a.end-5s" dur="2s"'))
  end)

  it("move back and are withdrawn with the moments that they follow", function()
    local function three(seconds, ends, again)
      return places(seconds, ('id="a" begin="2s" dur="1s" end="%s"'):format(ends),
        'begin="a.end-1.5s" dur="2s"', ('id="c" begin="d.begin-1.1s" dur="0.2s"'),
        ('id="d" begin="0s; %s" dur="0.3s"'):format(again))[2]
    end
    assert.are.equal(25, three(2, "c.end+9s", "1s"))
    assert.are.equal(30, three(2, "c.end+2.4s", "1s"))
    assert.are.equal(0, three(2, "c.end", "1s"))
  end)

  it("follow an end that is indefinite, and do not follow the last of the others", function()
    assert.are.same({ 30, 0, 30, 30 }, places(1.5, 'begin="1s" end="0.5s; indefinite" dur="1s"',
      'begin="1s" end="0.5s" dur="1s"', 'begin="1s" end="0.5s; click" dur="1s"',
      'begin="1s" end="indefinite" dur="1s"'))
  end)
end)

describe("values", function()
  local function at(text, seconds) return x_at(read(box(text)), seconds) end

  it("that do not mix are not paced", function()
    assert.are.equal(0, (read('<g><rect width="9" height="9"/><animate attributeName="visibility" '
      .. 'values="visible;hidden;visible;hidden;visible" calcMode="paced" dur="5s"/></g>')
      :at(2.5):bounds()))
    assert.is_nil((read('<rect width="9" height="9"><animate attributeName="display" '
      .. 'values="inline;none;inline;none;none" calcMode="paced" dur="5s"/></rect>')
      :at(3.5):bounds()))
    assert.are.equal(12, at('<animate attributeName="x" values="0;10;20" calcMode="paced" '
      .. 'keyTimes="0;0.9;1" dur="5s"/>', 3))
    -- of the angles of turns only, not of their centres
    assert.are.near(-10, at('<animateTransform attributeName="transform" type="rotate" '
      .. 'values="0;30;180" calcMode="paced" dur="2s"/>', 1), 1e-9)
  end)

  it("begin with what the element inherits, however deep it is", function()
    local rules, depth = {}, 100
    for i = 1, 200 do rules[i] = ("nothing g x%d{fill:red}"):format(i) end
    local boxes = {}
    for i = 1, 200 do
      boxes[i] = '<rect width="10" height="10"><animate attributeName="fill" to="#fff" dur="2s"/>'
        .. "</rect>"
    end
    local art = read("<style>" .. table.concat(rules) .. "</style>" .. ("<g>"):rep(depth)
      .. table.concat(boxes) .. ("</g>"):rep(depth))
    assert.are.equal(0, x_at(art, 1))
  end)
end)

describe("keyframes", function()
  --- Where a box in which 0 to 40 px is animated by the style begins at a time.
  local function at(seconds, style, frames)
    local text = "<style>@keyframes k{%s} rect{animation:%s}</style>"
    return x_at(read(text:format(frames or "from{x:0px}to{x:40px}", style) .. box ""), seconds)
  end

  it("step before and after, forwards and backwards", function()
    assert.are.equal(0, at(0, "k 1s steps(2,start) 1s both"))
    assert.are.equal(20, at(1, "k 1s steps(2,start) 1s both"))
    assert.are.equal(0, at(2, "k 1s steps(2,start) reverse both"))
    assert.are.equal(40, at(0, "k 1s steps(2,end) 1s reverse both"))
    assert.are.equal(20, at(0.5, "k 1s linear;animation-timing-function:steps(2.5)"))
    assert.are.equal(20, at(0.5, "k 1s linear;animation-timing-function:steps(1,jump-none)"))
    assert.are.equal(40, at(0.5, "k 1s linear;animation-timing-function:steps(2,jump-none)"))
  end)

  it("at the same share are replaced, and those that are important do not count", function()
    assert.are.equal(15, at(0.25, "k 1s linear", "50%{x:20px}50%{x:30px}"))
    assert.are.equal(10, at(0.25, "k 1s linear",
      "50%{x:20px;animation-timing-function:step-end}50%{x:30px}"))
    assert.are.equal(5, at(0.25, "k 1s linear", "from{x:0px}to{x:20px}to{x:40px!important}"))
  end)

  it("may follow lists of stops, which continue beyond their ends", function()
    local function stops(seconds, list, wanted)
      assert.are.near(wanted, at(seconds, ("k 1s linear(%s) both"):format(list)), 1e-9, list)
    end
    stops(0.45, "0, 0.9 45%, 1", 36)
    stops(0.5, "0, 1 25%, 0", 40 * 2 / 3)
    stops(0, "0 20%, 1 100%", -10)
    stops(0.5, "0, 0.2 50%, 1 50%, 0.4", 40)
    stops(0.7, "0, .3 60% 80%, 1", 12)
    stops(0.25, "0, 0.1, 0.2, 1", 3)
    stops(0.5, "1 50%, 0.2 40%, 0.2", 8) -- places never go back
  end)

  it("do not move where a list of stops lies", function()
    for _, bad in ipairs { "", "1", "0 1", "0,,1", "0,1,", "0, 50%", "0 1% 2% 3%, 1", "a,1",
                           "nan,1", "1e999,0" } do
      assert.are.equal(0, at(0.5, ("k 1s linear(%s)"):format(bad)), bad)
    end
    assert.are.equal(0, at(0.5, "k 1s linear(0,1"))
  end)

  it("may move an element along a path of its style", function()
    local function place(style, seconds)
      local text = '<style>@keyframes k{to{offset-distance:100%%}} rect{%s;animation:k 1s linear}'
        .. "</style>" .. box ""
      local x, y = read(text:format(style)):at(seconds):bounds()
      return { x, y }
    end
    local track = "offset-rotate:0deg;offset-path:path('M10 20H50V60')"
    assert.are.same({ 30, 20 }, place(track, 0.25))
    assert.are.same({ 50, 40 }, place(track, 0.75))
    assert.are.same({ 25, 15 }, place(track .. ";offset-anchor:5px 5px", 0.25))
    assert.are.same({ 35, 20 }, place(track .. ";transform:translate(5px)", 0.25))
    for _, none in ipairs { "none", "path('')", "path('M')", "path('M5 5')", "path('M5 5H9 Q')",
                            "path(evenodd, 'M5 5H9')", "path(M5 5H9)", "path('M1e400 5H9')" } do
      assert.are.same({ 0, 0 }, place("offset-path:" .. none, 0.5), none)
    end
    local art = read("<style>rect{offset-path:ray(45deg);offset-distance:5}</style>" .. box "")
    assert.are.same({ 'offset-path "ray(45deg)"', 'offset-distance "5"' },
      { art.skipped[1].what, art.skipped[2].what })
  end)

  it("along paths are refused in time, where many elements have long ones", function()
    local path = "M0 0" .. ("l1 1"):rep(100000)
    local text = "<style>rect{offset-path:path('" .. path .. "')}</style>" .. ("<rect/>"):rep(1000)
    local begun = os.clock()
    local ok, message = svg.read(bench:write("long.svg", moving.document { text }))
    assert.is_nil(ok)
    assert.is_truthy(message:find("the paths that elements lie on are too long together", 1, true))
    assert.is_true(os.clock() - begun < 10)
  end)

  it("have names that begin like other words", function()
    for _, name in ipairs { "reverse2", "infinite2", "both_", "paused.x", "ease-in-2" } do
      local text = "<style>@keyframes %s{to{x:40px}} rect{animation:%s 1s linear}</style>" .. box ""
      assert.are.equal(20, x_at(read(text:format(name, name)), 0.5), name)
    end
    assert.are.equal(0, at(0.5, "k 1s linear other"))
  end)

  it("are added to the value without them", function()
    local function width(composition, style, frames)
      local text = "<style>@keyframes k{%s} rect{%s;animation:k 1s linear;animation-composition:%s}"
        .. "</style>" .. box ""
      local _, _, w = read(text:format(frames, style, composition)):at(0.5):bounds()
      return w
    end
    assert.are.equal(20, width("replace", "width:10px", "from{width:10px}to{width:30px}"))
    assert.are.equal(30, width("add", "width:10px", "from{width:10px}to{width:30px}"))
    assert.are.equal(25, width("add", "width:10px", "to{width:30px}"))
    local wide = "from{scale:2}to{scale:2}"
    assert.are.near(60, width("add", "scale:3", wide), 1e-9)
    assert.are.near(40, width("accumulate", "scale:3", wide), 1e-9)
    wide = "from{transform:scale(2)}to{transform:scale(2)}"
    assert.are.near(60, width("add", "transform:scale(3)", wide), 1e-9)
    assert.are.near(40, width("accumulate", "transform:scale(3)", wide), 1e-9)
    assert.are.near(20, width("accumulate", "transform:none", wide), 1e-9)
  end)

  it("mix the colour that is inherited", function()
    local text = '<g color="#fff"><rect width="10" height="10"/></g><style>@keyframes k'
      .. "{from{fill:currentColor} to{fill:currentColor}} rect{animation:k 1s}</style>"
    local art = read(text)
    local film = celspan.film { size = { 1, 1 }, frames = 1, frame = function()
      return celspan.rostrum { celspan.cel { art:at(0.5) } }
    end }
    assert.are.same({ 255, 255, 255, 255 },
      { assert(celspan.pixels(film)):bytes { depth = 8 }:byte(1, 4) })
  end)
end)

describe("the program", function()
  it("makes a film of 24 frames a second of a drawing that moves", function()
    local path = bench:write("slide.svg", moving.document {
      box '<animate attributeName="x" from="0" to="80" dur="2s"/>' })
    local function done(arguments, ...)
      local code, out, err = bench:celspan(arguments, ...)
      assert.are.equal(0, code, err)
      return out .. err
    end
    assert.is_truthy(done("info '%s'", path):find("\nseconds 2\n", 1, true))
    assert.is_truthy(done("check '%s'", path):find("48 frames checked", 1, true))
    assert.are.equal("0 0 0 1\n", done("probe '%s' 45 5 --frame 25", path))
    assert.are.equal("0 0 0 0\n", done("probe '%s' 45 5 --frame 1", path))
    done("convert '%s' '%s/25.png' --frame 25", path, bench.folder)
    done("render '%s' --frames 25 -o '%s/film.png'", path, bench.folder)
    local same = done("compare '%s/film.png' '%s/25.png'", bench.folder, bench.folder)
    assert.is_truthy(same:find("largest_difference 0 ", 1, true), same)
    local code, _, err = bench:celspan("convert '%s' '%s/25.png' --frame 49", path, bench.folder)
    assert.are.equal(2, code)
    assert.is_truthy(err:find("there is no frame 49: it has 48", 1, true), err)
  end)
end)

describe("bad input", function()
  local function still(text)
    local art = read(box(text))
    for _, seconds in ipairs { 0, 0.5, 1e6 } do assert.are.equal(0, x_at(art, seconds), text) end
    return art
  end

  it("has no effect where lists lie", function()
    local function slide(more)
      still('<animate attributeName="x" values="50;60;70" dur="1s" fill="freeze" ' .. more .. "/>")
    end
    slide 'keyTimes="0;1"'
    slide 'keyTimes="0;0.8;0.3"'
    slide 'keyTimes="0;0.5;0.9"'
    slide 'keyTimes="0;nan;1"'
    slide 'keyTimes="0;1e308;1"'
    slide 'keyTimes="0.1;0.5;1"'
    slide 'calcMode="spline"'
    slide 'calcMode="spline" keySplines="0 0 1 1"'
    slide 'calcMode="spline" keySplines="0 0 1 1;0 0 2 1"'
    still '<animate attributeName="x" values="" dur="1s"/>'
    still '<animate attributeName="x" values=";;;" dur="1s"/>'
    still '<animate attributeName="x" from="50" dur="1s"/>'
    still '<animate attributeName="x" from="nan" to="1e400" dur="1s"/>'
    still '<animateMotion values="nan,1;2" dur="1s"/>'
    still '<animateMotion path="M0" dur="1s"/>'
    still '<animateMotion><mpath href="#nobody"/></animateMotion>'
    still '<animateTransform attributeName="x" type="rotate" to="50" dur="1s"/>'
    still '<animate attributeName="transform" to="translate(50)" dur="1s"/>'
    still '<animate href="#nobody" attributeName="x" to="50" dur="1s"/>'
  end)

  it("has no effect where times lie", function()
    local function slide(more)
      return still('<animate attributeName="x" values="50;60" ' .. more .. "/>")
    end
    slide 'begin="indefinite" dur="1s"'
    slide 'begin="1e308s" dur="1s"'
    slide 'begin="a.begin" id="a" dur="1s"'
    slide 'begin="0" end="-5s" dur="1s"'
    slide 'begin="-9s" dur="2s"'
  end)

  it("counts durations beyond 1e12 as not given", function()
    local art = read(box '<animate attributeName="x" values="50;60" dur="1e308s"/>')
    assert.are.same({ 50, 50 }, { x_at(art, 0), x_at(art, 1e12) })
    art = read(box('<animate attributeName="x" by="1e11" dur="1s" accumulate="sum" '
      .. 'repeatCount="1e12"/>'))
    assert.are.equal(1e12, art.seconds)
    assert.has_no_error(function() art:at(1e11) end)
  end)

  it("does not measure boxes in boxes again and again", function()
    local art = read("<style>g{transform:rotate(90deg);transform-box:fill-box;transform-origin:"
      .. 'center}</style><defs><g id="g">' .. ("<g>"):rep(39) .. '<rect width="10" height="6"/>'
      .. ("</g>"):rep(40) .. '</defs><use href="#g" x="20"/>')
    assert.are.equal(20, (art.object:bounds()))
  end)

  it("stops where intervals change each other in a circle", function()
    local art = read(box('<animate id="a" attributeName="x" to="3" begin="b.end-0.5s;0" '
      .. 'end="b.begin;indefinite" dur="1s"/><animate id="b" attributeName="y" by="3" '
      .. 'begin="a.begin-0.2s;a.end" dur="0.4s" restart="whenNotActive"/>'))
    assert.has_no_error(function() art:at(5) end)
  end)

  it("ends where animations wait for each other in circles", function()
    local function pair(a, b)
      return box(('<animate id="a" attributeName="x" by="5" dur="1s" begin="%s"/>'
        .. '<animate id="b" attributeName="y" by="5" dur="1s" begin="%s"/>'):format(a, b))
    end
    for _, one in ipairs { { "b.begin", "a.begin" }, { "0;b.begin", "a.begin" },
                           { "0;b.end-1s", "a.end-1s" }, { "0;b.begin-1s", "a.begin-1s" },
                           { "0;b.begin+1e-12s", "a.begin+1e-12s" } } do
      local art = read(pair(one[1], one[2]))
      local ok, message = pcall(art.at, art, 100)
      assert.is_true(ok or tostring(message):find "begin and end too often" ~= nil, message)
    end
  end)

  it("is noted, where a drawing in the drawing has too many animations", function()
    local turn = '<animateTransform attributeName="transform" type="rotate" by="1" dur="2s"/>'
    local inner = bench:write("turns.svg", moving.document { box(turn:rep(1000)) })
    local image = '<image href="turns.svg" width="100" height="100"/>'
    local path = bench:write("outer.svg", moving.document { image .. box(turn) })
    assert.are.equal(0, x_at(svg.load(path), 0))
    assert.is_truthy(svg.load(path):at(0):bounds())
    local ok, message = pcall(function() svg.load(inner):at(1) end)
    assert.is_false(ok)
    assert.is_truthy(message:find("too many transforms are added to each other", 1, true))
  end)

  it("is refused in time, where many elements have long lists of animations", function()
    local text = "<style>@keyframes k{to{x:9px}} rect{animation:%s;animation-delay:%s}</style>%s"
    local begun = os.clock()
    local ok, message = svg.read(bench:write("lists.svg", moving.document { text:format(
      ("k 1s,"):rep(63) .. "k 1s", ("0s,"):rep(100000) .. "0s", ("<rect/>"):rep(2000)) }))
    assert.is_nil(ok)
    assert.is_truthy(message:find("the values of the animations are too long together", 1, true))
    assert.is_true(os.clock() - begun < 10)
  end)

  it("takes little memory, where an element has many animations", function()
    local names = { "opacity", "fill", "stroke", "stroke-width", "stroke-opacity", "fill-opacity",
                    "visibility", "font-size", "stroke-dashoffset", "stroke-miterlimit", "x", "y",
                    "width", "height", "rx", "ry", "transform", "color", "letter-spacing",
                    "word-spacing", "stop-opacity", "flood-opacity", "stop-color", "flood-color",
                    "cx", "cy", "r", "rotate", "scale", "translate", "fill-rule", "clip-rule",
                    "stroke-linecap", "stroke-linejoin", "display", "font-weight" }
    local frames = {}
    for i, name in ipairs(names) do frames[i] = name .. ":inherit" end
    local text = "<style>@keyframes k{from{%s}} rect{animation:%s}</style>"
    local function peak()
      local file = assert(io.open "/proc/self/status")
      local size = tonumber(file:read "a":match "VmHWM:%s*(%d+)")
      file:close()
      return size
    end
    local art = read(text:format(table.concat(frames, ";"), ("k 1s,"):rep(63) .. "k 1s")
      .. ("<rect/>"):rep(20))
    local before = peak()
    art:at(0.5)
    assert.is_true(peak() - before < 64 * 1024)
  end)

  it("is the same, whether time runs forwards or back", function()
    local text = box('<animate id="a" attributeName="x" by="40" dur="0.4s" begin="0;b.end+0.1s"/>'
      .. '<animate id="b" attributeName="y" by="3" dur="0.3s" begin="a.end" end="a.end+0.2s"/>')
    local on, back = read(text), read(text)
    local found = {}
    for i = 0, 40 do found[i] = x_at(on, i / 8) end
    for i = 40, 0, -1 do assert.are.equal(found[i], x_at(back, i / 8), i) end
  end)

  it("is read in time, with 20,000 animations", function()
    local list = {}
    for i = 1, 20000 do
      list[i] = ('<animate id="n%d" attributeName="x" by="1" dur="1s" begin="%s"/>'):format(i,
        i > 1 and "n" .. i - 1 .. ".end" or "0")
    end
    local begun = os.clock()
    local art = read(box(table.concat(list)))
    assert.are.equal(20000, art.seconds)
    assert.are.equal(0.5, x_at(art, 19999.5))
    -- each time continues the one before
    for i = 1, 3 do assert.are.equal(0.5 + i / 64, x_at(art, 19999.5 + i / 64)) end
    assert.is_true(os.clock() - begun < 10)
  end)
end)
