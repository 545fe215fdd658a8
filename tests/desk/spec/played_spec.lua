-- Deliveries in a browser: the codecs that it plays, moving pictures, and sprites by their atlas.

local browsing = require "tests.support.browsing"
local movies = require "tests.support.movies"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

if not present.program("chromium", "node", "base64", "ffmpeg") then
  return pending "there is no chromium, no node or no ffmpeg"
end

--- Four fields of one colour each, which change their places after half of the film.
local FILM = [[
local celspan = require "celspan"
local colours = { "#28506e", "#5a6e46", "#a0a0a0", "#c8b4be" }
return celspan.film { size = { 256, 128 }, fps = 24, frames = 24, frame = function(f)
  local fields = {}
  for i = 1, 4 do
    local place = f.index < 12 and i or 5 - i
    fields[i] = celspan.rect { (place - 1) * 64, 0, 64, 128, texture = colours[i] }
  end
  return celspan.rostrum { celspan.cel(fields) }
end }
]]
local COLOURS = { { 0x28, 0x50, 0x6e }, { 0x5a, 0x6e, 0x46 }, { 160, 160, 160 },
  { 0xc8, 0xb4, 0xbe } }

--- The size and the seconds of what a page shows, and the colours in the middle of four fields: of
--- a video at a quarter of a second, and at three quarters.
local LOOK = [=[
  await page.load("file://%s/page.html");
  return page.get(`(async () => {
    const shown = document.querySelector("img, video"), canvas = document.createElement("canvas");
    const found = { colours: [] };
    const look = () => {
      found.size = [canvas.width, canvas.height]
        = [shown.videoWidth || shown.naturalWidth, shown.videoHeight || shown.naturalHeight];
      const drawing = canvas.getContext("2d");
      drawing.drawImage(shown, 0, 0);
      for (const x of [32, 96, 160, 224]) {
        found.colours.push([...drawing.getImageData(x, 64, 1, 1).data].slice(0, 3));
      }
    };
    if (shown.tagName === "IMG") { await shown.decode(); look(); return found; }
    const once = name => new Promise(done => shown.addEventListener(name, done, { once: true }));
    while (shown.readyState < 2 && !shown.error) {
      await Promise.race([once("loadeddata"), once("error"), new Promise(d => setTimeout(d, 100))]);
    }
    if (shown.error) return { error: shown.error.code };
    found.seconds = shown.duration;
    // The event of a seek can come before its picture, so that is waited for, but not for ever.
    const late = () => new Promise(done => setTimeout(done, 10000));
    const painted = time => new Promise(done => {
      const hear = (_, { mediaTime }) => Math.abs(mediaTime - time) < .1 ? done()
        : shown.requestVideoFrameCallback(hear);
      shown.requestVideoFrameCallback(hear);
    });
    for (const time of [.25, .75]) {
      const sought = Promise.all([once("seeked"), painted(time)]);
      shown.currentTime = time;
      await Promise.race([sought, late()]);
      look();
    }
    return found;
  })()`);]=]

describe("a browser", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("film.lua", FILM)
  end)
  after_each(function() bench:remove() end)

  local function run(words)
    local code, _, err = bench:celspan_inside(words)
    assert.equal(0, code, err)
  end
  local function look(name, element, kind)
    local data = movies.run(bench, "base64 -w0 " .. name)
    bench:write("page.html", ("<%s muted src='data:%s;base64,%s'></%s>"):format(element, kind, data,
      element))
    return browsing.see("about:blank", LOOK:format(bench.folder), 180)
  end
  local function same(found, name)
    assert.same({ 256, 128 }, found.size)
    for i, colour in ipairs(found.colours) do
      local wanted = COLOURS[i <= 4 and i or 9 - i]
      for c = 1, 3 do
        assert.is_true(math.abs(colour[c] - wanted[c]) <= 4, name .. i .. c)
      end
    end
  end

  local VIDEOS = { { "mp4", "h264" }, { "mp4", "av1" }, { "mov", "h264" }, { "webm", "vp9" },
    { "webm", "av1" }, { "mkv", "h264" }, { "mkv", "av1" }, { "mkv", "vp9" } }
  for _, case in ipairs(VIDEOS) do
    local ending, codec = table.unpack(case)
    it(("plays %s in %s, and seeks in it"):format(codec, ending), function()
      run(("render film.lua -o out.%s --codec %s --quality 90"):format(ending, codec))
      local kinds = { mp4 = "video/mp4", mov = "video/mp4", webm = "video/webm",
        mkv = "video/x-matroska" }
      local found = look("out." .. ending, "video", kinds[ending])
      assert.is_nil(found.error)
      assert.is_true(math.abs(found.seconds - 1) < .02, found.seconds)
      assert.equal(8, #found.colours)
      same(found, ending)
    end)
  end

  for _, ending in ipairs { "gif", "webp", "apng", "avif" } do
    it("shows " .. ending, function()
      if ending == "avif" and not present.avif() then return pending "built without libavif" end
      run(("render film.lua -o out.%s --quality 90"):format(ending))
      same(look("out." .. ending, "img", "image/" .. ending), ending)
    end)
  end

  it("puts the frames of a film together from a sheet of sprites and its atlas", function()
    bench:write("film.lua", (FILM:gsub("64, 128, texture", "20, 30 + f.index, texture")))
    run "sprites film.lua -o sheet.png --frames 3,20"
    run "render film.lua -o f.##.png --frames 3,20"
    bench:write("page.html", ("<img src='data:image/png;base64,%s'>"):format(
      movies.run(bench, "base64 -w0 sheet.png")))
    for _, number in ipairs { 3, 20 } do
      local found = browsing.see("about:blank", ([=[
        await page.load("file://%s/page.html");
        return page.get(`(async () => {
          const sheet = document.querySelector("img"), canvas = document.createElement("canvas");
          const { frame, spriteSourceSize: to, sourceSize }
            = (%s).frames["sheet.%04d.png"];
          await sheet.decode();
          [canvas.width, canvas.height] = [sourceSize.w, sourceSize.h];
          const drawing = canvas.getContext("2d");
          drawing.drawImage(sheet, frame.x, frame.y, frame.w, frame.h, to.x, to.y, to.w, to.h);
          return [...drawing.getImageData(0, 0, sourceSize.w, sourceSize.h).data];
        })()`);]=]):format(bench.folder, bench:read "sheet.json", number), 60)
      local plain = movies.pixels(bench, ("f.%02d.png"):format(number), "rgba")
      local bytes = {}
      for i, byte in ipairs(found) do bytes[i] = string.char(byte) end
      assert.is_true(table.concat(bytes) == plain, number)
    end
  end)
end)
