-- Drawings that move: at(seconds), how long they move, what is not run, and bad input; and the
-- pictures of a browser at the same times.
local celspan = require "celspan"
local browsing = require "tests.support.browsing"
local moving = require "tests.support.moving"
local present = require "tests.support.present"
local svg = require "celspan.svg"
local workbench = require "tests.support.workbench"

if not present.art() then return pending "celspan was built without expat" end

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
    print(("# %s: %d of %d pictures are alike"):format(name, alike, all))
    assert.is_true(alike >= ALIKE * all, table.concat(others, "\n"))
  end

  it("as animate, set, animateTransform and animateMotion", function()
    agrees("SMIL", moving.smil)
  end)

  it("as @keyframes", function() agrees("keyframes", moving.styles) end)
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
    assert.are.same({ 'offset-path "path(\'M0 0\')"' },
      notes("<style>@keyframes k{to{offset-path:path('M0 0')}}</style>" .. box ""))
  end)

  it("refuses invalid times", function()
    local art = read(box "")
    for _, value in ipairs { -1, 0 / 0, math.huge, 1e13, "1", {} } do
      assert.has_error(function() art:at(value) end)
    end
    assert.has_error(function() art:at() end)
    assert.has_error(function() art:with({}):at(1) end)
    assert.is_nil((read(""):at(1e12):bounds()))
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

  it("is read in time, with 100,000 animations", function()
    local list = {}
    for i = 1, 100000 do
      list[i] = ('<animate id="n%d" attributeName="x" by="1" dur="1s" begin="%s"/>'):format(i,
        i > 1 and "n" .. i - 1 .. ".end" or "0")
    end
    local begun = os.clock()
    local art = read(box(table.concat(list)))
    assert.are.equal(100000, art.seconds)
    assert.are.equal(0.5, x_at(art, 99999.5))
    assert.is_true(os.clock() - begun < 20)
  end)
end)
