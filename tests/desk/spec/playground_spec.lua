-- The playground of the site: the files that it saves, beside those of the program; its page.
local browsing = require "tests.support.browsing"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local WEB = present.engine()
local AXE = "out/npm/node_modules/axe-core/axe.min.js"

if not present.program("node", "chromium", "ffmpeg", "ffprobe") then
  return pending "there is no node, no chromium or no ffmpeg"
end
if not WEB then
  return pending "there is no out/web: ./run web makes it"
end

-- A bar and a tone begin together.
local WIDTH, HEIGHT, SECONDS, ONSET, FPS = 192, 108, 6, 3, 24
local FRAME = WIDTH * HEIGHT * 3 // 2 -- bytes
local FILM = ([[
local p = celspan.parameters { radius = { 30, min = 5, max = 60, about = "of the dot" },
  ground = { colour = "#234" }, isQuiet = false, side = { "left", "right" } }
return film { size = { %d, %d }, fps = %d, frames = %d,
  sound = not p.isQuiet and { { "tone.wav", at = %d, gain = 0.8 } } or nil,
  frame = function(f)
    local shapes = { back = p.ground,
      circle { 20 + f.index / 2, 54, p.radius, fill = "#f26419c0" } }
    if f.index >= %d then shapes[2] = rect { 140, 10, 30, 90, fill = "#8fd8ff" } end
    return shapes
  end }
]]):format(WIDTH, HEIGHT, FPS, SECONDS * FPS, ONSET, ONSET * FPS)

-- What a plane cannot contain.
local PROCEDURE = [[return film { size = { 64, 64 }, frames = 2, frame = function()
  return { scanline { bounds = { 0, 0, 64, 64 },
    spans = function() return { { 0, 64, "red" } } end } }
end }]]

local bench

setup(function()
  bench = workbench.new()
  local code, _, err = bench:shell(([[F='%s' && mkdir -p "$F/site/live" "$F/bin" &&
    cp -r docs/site/play "$F/site" && cp '%s'/* "$F/site/live" &&
    mv "$F/site/live/engine.mjs" "$F/site/live/engine.js"]]):format(bench.folder, WEB))
  assert.equal(0, code, err)
  bench:write("film.lua", FILM)
  bench:write("bin/ffmpeg", "#!/bin/sh\n[ \"$1\" != -version ] || exec echo ffmpeg version 9 x\n"
    .. "exec cat >frames.yuv\n")
  assert.equal(0, (bench:inside("chmod +x bin/ffmpeg && ffmpeg -v error -f lavfi -i "
    .. "sine=440:sample_rate=48000:duration=1 tone.wav && ffmpeg -v error -i tone.wav -ac 2 "
    .. "tone.aac")))
end)
teardown(function() bench:remove() end)

--- What the steps return, in JavaScript, in an empty page; with the modules of the playground, and
--- the engine with the film.
local function see(steps)
  return browsing.see("about:blank", ([=[
    const fs = require("fs"), site = await require("./site.js")("%s/site");
    site.pages["empty.html"] = "<!doctype html><title>x</title>";
    const read = name => JSON.stringify(fs.readFileSync("%s/" + name).toString("base64"));
    try {
      await page.load(site.at("empty.html"), /^http:/);
      return await page.get(`(async () => {
        const bytes = text => Uint8Array.from(atob(text), sign => sign.charCodeAt(0));
        const text = parts => new Promise(done => {
          const reader = new FileReader();
          reader.onload = () => done(reader.result.replace(/.*,/, ""));
          reader.readAsDataURL(new Blob([parts].flat()));
        });
        const { open } = await import("/live/engine.js");
        const { calls } = await import("/play/save.js"), share = await import("/play/share.js");
        const { mix, RATE } = await import("/play/export.js");
        const answer = await fetch("/live/celspan.wasm");
        const more = await (await fetch("/live/more.json")).json();
        const engine = await open(await WebAssembly.compile(await answer.arrayBuffer()),
          { files: { ...more, "/tone.wav": bytes(${read("tone.wav")}) } });
        const source = atob(${read("film.lua")}), film = engine.run(source);
        const all = { engine, progress() {},
          build: ({ frame }) => (engine.frame(frame), film) };
        const samples = async ({ bytes }) => {
          const context = new OfflineAudioContext(2, 1, RATE);
          return [(await context.decodeAudioData(bytes.slice().buffer)).getChannelData(0)];
        };
        const fault = promise => promise.then(() => "nothing", error => error.message);
        %s
      })()`);
    } finally { site.close(); }]=]):format(bench.folder, bench.folder, steps), 60)
end

--- Saves what a page answered as a file of the bench.
local function keep(name, base64)
  bench:write(name .. ".txt", base64)
  assert.equal(0, (bench:inside(("base64 -d %s.txt >%s"):format(name, name))))
end

--- What a program prints in the bench.
local function printed(command)
  local code, out, err = bench:inside(command)
  assert.equal(0, code, err)
  return out, err
end

describe("the playground #plain", function()
  local saved, frames

  setup(function()
    bench:inside(("PATH=\"$PWD/bin:$PATH\" '%s' render film.lua -o film.mp4 --progress none "
      .. "--set isQuiet=true"):format(workbench.absolute))
    frames = bench:read "frames.yuv"
    saved = see [=[
      // An encoder that some browsers have: its chunks are those of a file, without their heads.
      class Aac {
        static async isConfigSupported({ codec }) { return { supported: codec === "mp4a.40.2" }; }
        constructor({ output }) { this.output = output; }
        configure() {}
        encode() {}
        close() {}
        async flush() {
          const own = bytes(${read("tone.aac")});
          const decoderConfig = { description: new Uint8Array([17, 144]) };
          for (let at = 0, i = 0, end; at < own.length; at = end, i++) {
            end = at + ((own[at + 3] & 3) << 11 | own[at + 4] << 3 | own[at + 5] >> 5);
            const data = own.subarray(at + 7, end);
            this.output({ byteLength: data.length, copyTo: to => to.set(data), type: "key",
              timestamp: Math.round(i * 1024e6 / RATE) }, { decoderConfig });
          }
        }
      }
      const given = [], Own = VideoFrame, sounds = calls.sounds({ frame: film.first }, all);
      VideoFrame = class extends Own {
        constructor(bytes, shape) { super(bytes, shape); given.push(bytes.slice()); }
      };
      sounds[0].samples = await samples(sounds[0]);
      const sound = mix(sounds, film.count / film.fps);
      const webm = await calls.save({ ...film, kind: "webm", sound }, all);
      const frames = await new Blob(given).arrayBuffer();
      const mp4 = await calls.save({ ...film, kind: "mp4", sound }, all);
      const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", frames));
      const apng = await calls.save({ ...film, kind: "apng", count: 3 }, all);
      const png = await calls.save({ ...film, kind: "png", first: 100, count: 1 }, all);
      const odd = await fault(calls.save({ ...film, kind: "webm", width: 193 }, all));
      const huge = await fault(calls.save(
        { ...film, kind: "webm", width: 16384, height: 16384 }, all));
      globalThis.AudioEncoder = Aac;
      const aac = await calls.save({ ...film, kind: "mp4", sound }, all);
      delete globalThis.VideoEncoder;
      const none = await fault(calls.save({ ...film, kind: "webm" }, all));
      return { webm: await text(webm), mp4: await text(mp4), aac: await text(aac),
        apng: await text(apng), png: await text(png), odd, huge, none,
        hash: [...hash].map(one => one.toString(16).padStart(2, "0")).join("") };]=]
    for _, kind in ipairs { "webm", "mp4", "apng", "png" } do keep("film." .. kind, saved[kind]) end
    keep("aac.mp4", saved.aac)
  end)

  it("gives the encoder the frames that the program gives to ffmpeg", function()
    assert.equal(SECONDS * FPS * FRAME, #frames)
    assert.equal(printed "sha256sum frames.yuv":match "%x+", saved.hash)
  end)

  for kind, codec in pairs { webm = "vp9", mp4 = "h264" } do
    it("saves films with sound that ffmpeg reads, all frames and all colours: " .. kind, function()
      local facts = printed("ffprobe -v error -count_frames -show_entries stream=codec_name,"
        .. "nb_read_frames,color_range,color_space,r_frame_rate:format=duration film." .. kind)
      for _, part in ipairs { "codec_name=" .. codec, "codec_name=opus", "color_range=tv",
        "color_space=bt709", "r_frame_rate=24/1", "nb_read_frames=" .. SECONDS * FPS,
        "duration=6.0" } do
        assert.is_truthy(facts:find(part, 1, true), facts)
      end
      local _, said = printed(("ffmpeg -i film.%s -f rawvideo -pix_fmt yuv420p -video_size %dx%d "
        .. "-framerate %d -i frames.yuv -lavfi psnr -f null -"):format(kind, WIDTH, HEIGHT, FPS))
      assert.is_true(tonumber(said:match "average:([%d.]+)") >= 36, said)
      assert.is_truthy(printed("ffmpeg -v error -ss 4.5 -i film." .. kind
        .. " -frames:v 1 -f framemd5 -"):find "\n0,")
    end)

    it("has the sound in step with the pictures: " .. kind, function()
      local samples = printed("ffmpeg -v error -i film." .. kind .. " -f s16le -ac 1 -ar 48000 -")
      local at = 1
      while math.abs((string.unpack("<i2", samples, at))) < 600 do at = at + 2 end
      local second = (at - 1) / 2 / 48000
      assert.is_true(math.abs(second - ONSET) < 0.005, second)
      local pictures = printed("ffmpeg -v error -i film." .. kind
        .. " -map 0:v -f rawvideo -pix_fmt yuv420p -")
      local bar = ONSET * FPS * FRAME + WIDTH * 54 + 150 + 1
      assert.is_true(pictures:byte(bar) > pictures:byte(bar - FRAME) + 50)
    end)
  end

  it("has AAC in MP4, where a browser has its encoder", function()
    local facts = printed "ffprobe -v error -show_entries stream=codec_name,channels aac.mp4"
    assert.is_truthy(facts:find("codec_name=aac\nchannels=2", 1, true), facts)
    local _, said = printed "ffmpeg -i aac.mp4 -t 0.9 -map 0:a -af volumedetect -f null -"
    local loudest = tonumber(said:match "max_volume: ([-%d.]+)") -- of the tone: -21 dB
    assert.is_true(loudest and math.abs(loudest + 21) < 1, said)
  end)

  it("saves pictures and APNG with the pixels of the program", function()
    local own = ("'%s' render film.lua --progress none --set isQuiet=true -o - --frames %%s "
      .. "| sha256sum"):format(workbench.absolute)
    for kind, numbers in pairs { apng = "1-3", png = "100" } do
      assert.equal(printed(own:format(numbers)), (printed(
        "ffmpeg -v error -i film." .. kind .. " -f rawvideo -pix_fmt rgba - | sha256sum")))
    end
  end)

  it("says what it cannot encode", function()
    assert.equal("A video has an even width and height, not 193 x 108.", saved.odd)
    assert.equal("This browser cannot encode 16384 x 16384 pixels for WebM.", saved.huge)
    assert.is_truthy(saved.none:find("no WebCodecs", 1, true), saved.none)
  end)

  it("mixes sounds as the program does", function()
    bench:write("film.lua", (FILM:gsub('{ { "tone.wav".-gain = 0.8 } }', [[{
      { "tone.wav", at = 0.5, from = 0.2, fade = { 0.1, 0.3 }, pan = -0.5, duck = "b",
        duck_release = 0.2 },
      { "tone.wav", at = 1.1, to = 0.4, name = "b", gain = 0.3 } }]])))
    local mixed = see [=[
      const sounds = calls.sounds({ frame: film.first }, all);
      for (const one of sounds) one.samples = await samples(one);
      const channels = mix(sounds, film.count / film.fps);
      const parts = Int16Array.from({ length: 2 * channels[0].length },
        (_, i) => Math.round(channels[i % 2][i >> 1] * 32767));
      return { mix: await text([parts]) };]=]
    keep("mix.raw", mixed.mix)
    printed(("'%s' sound film.lua -o own.wav"):format(workbench.absolute))
    local own = printed "ffmpeg -v error -i own.wav -f s16le -ac 2 -"
    local found, worst = bench:read "mix.raw", 0
    assert.equal(#own, #found)
    for at = 1, #own - 1, 2 do
      local a, b = string.unpack("<i2", own, at), string.unpack("<i2", found, at)
      worst = math.max(worst, math.abs(a - b))
    end
    assert.is_true(worst <= 2, worst)
    bench:write("film.lua", FILM)
  end)

  it("knows parameters, and the scripts of addresses", function()
    local seen = see [=[
      const [, version] = (await share.fragment(engine.version(), source)).match(/^#(.*):/);
      const hash = await share.fragment(version, source), at = hash.length >> 1;
      const codes = crypto.getRandomValues(new Uint8Array(50000));
      const zeros = await text(await new Response(new Blob([new Uint8Array(2e6)]).stream()
        .pipeThrough(new CompressionStream("deflate"))).blob());
      return { version, parameters: engine.parameters(), none: await share.shared("#main") === null,
        same: (await share.shared(hash)).source === source,
        faults: await Promise.all([hash.slice(0, at), hash + "A",
          hash.slice(0, at) + (hash[at] === "A" ? "B" : "A") + hash.slice(at + 1), "#x:abc",
          "#0.1.0:" + zeros.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")]
          .map(one => fault(share.shared(one)))),
        long: await fault(share.fragment(version, String.fromCharCode(...codes))) };]=]
    assert.is_true(seen.same)
    assert.is_true(seen.none)
    assert.is_truthy(seen.version:find "^%d+%.%d+%.%d+$")
    for _, fault in ipairs(seen.faults) do
      assert.equal("The script in this address is damaged. Ask for the address again.", fault)
    end
    assert.equal(5, #seen.faults)
    assert.is_truthy(seen.long:find("too long for an address", 1, true), seen.long)
    local short = {}
    for i, one in ipairs(seen.parameters) do
      local choices = table.concat(one.choices, "|")
      short[i] = table.concat({ one.name, one.kind, one.value, choices }, " ")
    end
    assert.same({ "ground colour #234 ", "isQuiet boolean false ", "radius number 30 ",
      "side choice left left|right" }, short)
    assert.same({ 5, 60, "of the dot" },
      { seen.parameters[3].least, seen.parameters[3].most, seen.parameters[3].about })
  end)
end)

if not present.site() then
  return pending "there is no markdown-it of node, or no pygments of python3"
end

--- What the steps return, in JavaScript, with the page of the playground, which is open.
local function visit(steps)
  return browsing.see("about:blank", ([=[
    const fs = require("fs"), folder = "%s";
    const site = await require("./site.js")(folder + "/page");
    const source = fs.readFileSync(folder + "/film.lua", "utf8");
    const open = async (rest = "") => {
      await page.load("about:blank", /^about:/);
      await page.load(site.at("playground.html" + rest), /^http:/);
      await page.until(`document.querySelector("figure").dataset.state`);
    };
    const text = name => page.get(`document.querySelector("${name}").textContent`);
    const note = async () => await text(".note") + await page.get(
      `document.querySelector(".fault")?.textContent ?? ""`);
    const put = script => page.get(`(() => { const area = document.querySelector("textarea");
      area.value = ${JSON.stringify(script)}; delete document.querySelector("figure").dataset.state;
      area.dispatchEvent(new Event("input")); })()`);
    const ends = state => page.until(
      `document.querySelector("figure").dataset.state === "${state}"`);
    const give = (name, bytes) => page.get(`(() => { const all = new DataTransfer();
      all.items.add(new File([new Uint8Array(${JSON.stringify([...bytes])})], "${name}"));
      document.querySelector("main").dispatchEvent(new DragEvent("drop",
        { dataTransfer: all, bubbles: true })); })()`);
    try { await open();
      %s } finally { site.close(); }]=]):format(bench.folder, steps), 60)
end

describe("the page of the playground #plain", function()
  setup(function()
    local code, _, err = bench:shell(("node docs/site/make.js '%s/page' '%s'")
      :format(bench.folder, WEB))
    assert.equal(0, code, err)
  end)

  it("draws with values, prints a command, reads dropped files, and stops what is saved", function()
    local seen = visit [=[
      await put(source);
      await page.until(`document.querySelector("#values select")`);
      await page.get(`(() => { const one = document.querySelector("#values [type=range]");
        one.value = 45; one.dispatchEvent(new Event("input")); })()`);
      await page.until(`/radius=45/.test(document.querySelector("#command").textContent)
        && document.querySelector("#digest").textContent`);
      const answer = { digest: await text("#digest"), command: await text("#command"), said: [] };
      answer.kinds = await page.get(
        `[...document.querySelectorAll("#values :is([type], select)")].map(one => one.type)`);
      const save = async () => {
        await page.get(`document.querySelector("#kind").value = "mp4";
          document.querySelector("#save").click()`);
        await page.until(`document.querySelector("#said").textContent
          && document.querySelector("#save").textContent === "Save"`);
        answer.said.push(await text("#said"));
      };
      await save();
      await give("tone.wav", fs.readFileSync(folder + "/tone.wav"));
      await page.until(`/can read/.test(document.querySelector("#said").textContent)`);
      await save();
      for (const [kind, frame] of [["mp4", 77], ["json", 78]]) { // a picture waits meanwhile
        await page.get(`document.querySelector("#size").value = "384x216";
          document.querySelector("#kind").value = "${kind}";
          document.querySelector("#save").click()`);
        await page.until(`document.querySelector("#progress").value > 0`);
        await page.get(`{ const place = document.querySelector(".bar [type=range]");
          place.value = ${frame}; place.dispatchEvent(new Event("input")); } 0`);
        await page.get(`document.querySelector("#save").click()`);
        await page.until(`/stopped/.test(document.querySelector("#said").textContent)
          && document.querySelector(".bar output").textContent.startsWith("${frame}/")`);
      }
      return answer;]=]
    assert.same({ "color", "checkbox", "range", "select-one" }, seen.kinds)
    local code, out, err = bench:celspan_inside("%s", seen.command:match "\ncelspan ([^\n]*)$")
    assert.equal(0, code, err)
    assert.equal(out:match "[^\n]+", seen.digest)
    assert.equal("There is no tone.wav: drop the file on this page.", seen.said[1])
    assert.is_truthy(seen.said[2]:find "^film.mp4 was saved: %d", seen.said[2])
  end)

  it("saves drawings, Lottie and planes as the program does, by an engine that is loaded for it",
    function()
    local seen = visit(([=[
      const change = (name, value) => page.get(`{ const one = document.querySelector("${name}");
        one.value = "${value}"; one.dispatchEvent(new Event("input"));
        one.dispatchEvent(new Event("change")); } 0`);
      const loaded = () => site.asked.filter(name => name.includes("whole")).length;
      const save = async kind => {
        await change("#kind", kind);
        await page.get(`document.querySelector("#save").click()`);
        await page.until(`document.querySelector("#save").textContent === "Save"`);
        return { command: await text("#command"), said: await text("#said"),
          bytes: await page.get(`new Promise(done => {
            const reader = new FileReader();
            reader.onload = () => done(reader.result.replace(/.*,/, ""));
            reader.readAsDataURL(saved);
          })`) };
      };
      await page.get(`{ const own = URL.createObjectURL, said = document.querySelector("#said");
        globalThis.saved = new Blob([]), globalThis.heard = [];
        URL.createObjectURL = blob => { saved = blob; return own.call(URL, blob); };
        new MutationObserver(() => heard.push(said.textContent)).observe(said, { childList: true });
        } 0`);
      await put(source);
      await page.until(`document.querySelector("#values select")`);
      await change("#values [type=range]", 45);
      await page.until(`/radius=45/.test(document.querySelector("#command").textContent)`);
      await change(".bar [type=range]", 100);
      await page.until(`/--frames 100/.test(document.querySelector("#command").textContent)`);
      await save("png");
      const answer = { before: loaded() };
      for (const kind of ["svg", "json", "plane"]) answer[kind] = await save(kind);
      Object.assign(answer, { after: loaded(), heard: await page.get("heard") });
      await put(`%s`);
      await page.until(`!document.querySelector("#values label")`);
      answer.refused = await save("plane");
      answer.picture = await save("svg");
      return answer;]=]):format(PROCEDURE))
    assert.same({ 0, 1 }, { seen.before, seen.after })
    assert.is_truthy(table.concat(seen.heard, "\n"):find("is loaded", 1, true))
    local function made(one)
      local code, _, err = bench:celspan_inside("%s", one.command:match "^celspan ([^\n]*)")
      return code, err:gsub("celspan: ", "")
    end
    for _, kind in ipairs { "svg", "json", "plane" } do
      keep("page." .. kind, seen[kind].bytes)
      local code, notes = made(seen[kind])
      assert.equal(0, code, notes)
      assert.is_true(bench:read("film." .. kind) == bench:read("page." .. kind), kind)
      for note in seen[kind].said:gmatch "\n([^\n]+)" do
        assert.is_truthy(notes:find(note, 1, true), note)
      end
    end
    assert.is_truthy(seen.json.said:find("\nfilm.json: the sound of the film is left out", 1, true))
    bench:write("film.lua", PROCEDURE)
    local code, fault = made(seen.refused)
    assert.is_true(code ~= 0 and fault:find(seen.refused.said, 1, true) ~= nil, seen.refused.said)
    code, fault = made(seen.picture)
    assert.equal(0, code, fault)
    assert.is_truthy(seen.picture.said:find("\n" .. fault:match "film.svg: is a picture[^\n]*",
      1, true), seen.picture.said)
    bench:write("film.lua", FILM)
  end)

  it("shares scripts by addresses, and says which are damaged or of another version", function()
    local seen = visit [=[
      await put(source);
      await ends("drawn");
      await page.get(`document.querySelector("#share").click()`);
      await page.until("location.hash");
      const hash = await page.get("location.hash");
      await page.until(`document.querySelector("#said").textContent`);
      const answer = { share: await text("#said") };
      await open(hash);
      answer.same = await page.get(`document.querySelector("textarea").value`) === source;
      answer.own = await text("#said");
      await open(hash.replace(/[0-9]+[.]/, "7."));
      await page.until(`document.querySelector("#said").textContent`);
      answer.other = await text("#said");
      await open(hash.slice(0, 60));
      answer.cut = await text("#said");
      return answer;]=]
    assert.is_true(seen.same)
    assert.equal("The address of this page now has the script.", seen.share)
    assert.equal("", seen.own)
    assert.is_truthy(seen.other:find("comes from celspan 7.", 1, true), seen.other)
    assert.is_truthy(seen.cut:find("damaged", 1, true), seen.cut)
  end)

  -- The larger engine has what the first one says that it lacks.
  it("draws dropped pictures and what they become, by an engine that is loaded for them", function()
    assert.equal(0, bench:inside([[cp "$OLDPWD/scripts/pictures/scan.png" scan.png &&
      ffmpeg -v error -i scan.png -q:v 2 photo.jpg && printf 'GIF89a' >odd.png]]))
    local shown = "return rostrum { cel { rect { 0, 0, 560, 380, "
      .. "fill = picture { file = '%s' } } } }"
    local scripts = { shown:format "scan.png", shown:format "photo.jpg",
      "local list = {} for i, one in ipairs(require 'celspan.trace'.picture('scan.png').shapes) do "
        .. "list[i] = one.object:with { fill = i % 2 == 0 and 'teal' or 'gold' } end "
        .. "return rostrum { cel(list) }" }
    local seen = visit(([=[
      const loaded = () => site.asked.filter(name => name.includes("whole")).length;
      const answer = { none: loaded(), digests: [], commands: [] };
      await put("local wall = picture { file = 'odd.' .. 'png' }\n"
        + "return rostrum { cel { rect { 0, 0, 64, 64, fill = wall } } }");
      await ends("failed");
      answer.missing = await note();
      answer.once = loaded();
      await give("odd.png", fs.readFileSync(folder + "/odd.png"));
      await page.until(`/odd.png: is not/.test(document.querySelector(".note")?.textContent
        + document.querySelector(".fault")?.textContent)`);
      for (const name of ["scan.png", "photo.jpg"]) {
        await give(name, fs.readFileSync(folder + "/" + name));
      }
      for (const script of ["%s"]) {
        await put(script);
        await ends("drawn");
        await page.until(`document.querySelector("#digest").textContent`);
        answer.digests.push(await text("#digest"));
        answer.commands.push(await text("#command"));
      }
      answer.twice = loaded();
      return answer;]=]):format(table.concat(scripts, '", "')))
    assert.same({ 0, 1, 1 }, { seen.none, seen.once, seen.twice })
    assert.is_truthy(seen.missing:find("odd.png", 1, true), seen.missing)
    for i, script in ipairs(scripts) do
      bench:write("film.lua", script)
      local words = seen.commands[i]:match "\ncelspan ([^\n]*)$"
      local code, out, err = bench:celspan_inside("%s", words)
      assert.equal(0, code, err)
      assert.equal(out:match "[^\n]+", seen.digests[i])
    end
    bench:write("film.lua", FILM)
  end)

  it("answers bad scripts, and what a browser lacks, with a sentence", function()
    local seen = visit [=[
      const answer = {}, SCRIPTS = { loop: "while true do end",
        memory: "return ('x'):rep(2 ^ 32)",
        font: "return rostrum { text { 'a', font = 'no.ttf' } }",
        word: "return rostrum { circle { 1, 2, 3, fil = 'red' } }" };
      for (const [name, script] of Object.entries(SCRIPTS)) {
        await put(script);
        await ends("failed");
        answer[name] = await note();
      }
      await put("return rostrum { back = 'teal' } --" + "x".repeat(1e6));
      await ends("drawn");
      await give("film.lua", Buffer.from("return rostrum { back = 'navy' }"));
      await page.until(`document.querySelector("textarea").value.length < 100`);
      await ends("drawn");
      site.policy = "script-src 'self'";
      await open();
      answer.policy = await note();
      site.policy = null;
      await page.call("Page.addScriptToEvaluateOnNewDocument",
        { source: "delete globalThis.WebAssembly" });
      await open();
      answer.none = await note();
      return answer;]=]
    assert.is_truthy(seen.loop:find "steps", seen.loop)
    assert.is_truthy(seen.memory:find "more than %d+", seen.memory)
    assert.is_truthy(seen.font:find("no.ttf", 1, true), seen.font)
    assert.is_truthy(seen.word:find("unknown field 'fil'", 1, true), seen.word)
    assert.is_truthy(seen.policy:find "WebAssembly", seen.policy)
    assert.is_truthy(seen.none:find "WebAssembly", seen.none)
  end)

  it("has no fault that axe-core finds, and fits a telephone", function()
    if not io.open(AXE) then return pending "axe-core was not fetched" end
    local seen = visit(([=[
      await page.get(fs.readFileSync("%s", "utf8") + "; 0");
      const faults = [];
      for (const value of ["light", "dark"]) {
        await page.call("Emulation.setEmulatedMedia",
          { features: [{ name: "prefers-color-scheme", value }] });
        faults.push(...await page.get(`axe.run(document, { resultTypes: ["violations"] })
          .then(({ violations }) => violations.map(({ id, nodes }) =>
            id + ": " + nodes[0].html + nodes[0].failureSummary))`));
      }
      await page.call("Emulation.setDeviceMetricsOverride",
        { width: 390, height: 844, deviceScaleFactor: 1, mobile: false });
      await page.settle();
      return { faults,
        isWide: await page.get("document.documentElement.scrollWidth > innerWidth") };
      ]=]):format(AXE))
    assert.same({ faults = {}, isWide = false }, seen)
  end)
end)
