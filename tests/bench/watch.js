// Measures the page of celspan watch, as steps of tests/support/browser.js (./run bench watch):
// what an animator waits for, in milliseconds; what the page and its server hold; and what a
// picture costs in processor time, by the way in which it travels. The film is the demo with a
// parameter, in the folder of SHOT. With CELSPAN_PLAYED=1 shots of the film are only played, at its
// own size. The page may be that of an older build.
const { readFileSync, readdirSync, writeFileSync, appendFileSync } = require("fs");
// the function of the page that takes runs apart
const UNPACK = readFileSync("src/desk/program/verbs/watch/runs.js", "utf8")
  .replace("\nexport ", "\n");
const SHOT = process.env.CELSPAN_SHOT, SERVER = process.env.CELSPAN_SERVER;
const IS_PLAYED = Boolean(process.env.CELSPAN_PLAYED);
const TICK = 10; // milliseconds of the kernel's clock for processes
const PAGE = 4096; // bytes of a page of memory

const [width, height] = IS_PLAYED ? [960, 540] : [1280, 720];
// Frames of scripts/film.lua from which it is played, as in tests/bench/parts_films.lua.
const SHOTS = { opening: 101, street: 250, close: 421, town: 600 };

/** Makes the window so large that the picture has its size, whatever is beside it. */
async function size() {
  for (let wide = width, tries = 0; ;) {
    await page.call("Emulation.setDeviceMetricsOverride",
      { width: wide, height: height + 600, deviceScaleFactor: 1, mobile: false });
    await page.pause(1);
    await page.until(`(one => one.dataset.size && !one.hasAttribute("data-stale"))(
      document.querySelector("#canvas"))`);
    const has = await page.get(`document.querySelector("#canvas").dataset.size`);
    if (has === `${width}x${height}`) return;
    wide += width - has.split("x")[0];
    if (wide > 2 * width + 400 || ++tries === 20) throw new Error(`the picture has ${has}`);
  }
}

await size();

/** Says on standard error what is measured next. */
const begin = what => console.error(`measuring ${what}`);

const middle = list => [...list].sort((a, b) => a - b)[list.length >> 1];

/** Milliseconds from an act in the page until an attribute of the picture changes. */
const timed = (act, name) => page.get(`new Promise(done => {
  const canvas = document.querySelector("#canvas"), old = canvas.dataset.${name};
  const began = performance.now();
  new MutationObserver((_, watcher) => {
    if (canvas.dataset.${name} === old) return;
    watcher.disconnect();
    requestAnimationFrame(() => done(performance.now() - began));
  }).observe(canvas, { attributes: true });
  ${act};
})`);

/** An expression that goes to a frame. */
const scrubTo = number => `(() => { const scrub = document.querySelector("#scrub");
  scrub.value = ${number}; scrub.dispatchEvent(new Event("input")); })()`;

async function several(count, act, name) {
  const list = [];
  for (let i = 0; i < count; i++) {
    list.push(await timed(act(i), name));
    await page.pause(0.1);
  }
  return Math.round(middle(list) * 10) / 10;
}

/** Milliseconds from writing the script until the new picture is painted. */
async function save(i) {
  const old = await page.get(`document.querySelector("#canvas").dataset.build`);
  const painted = page.get(`new Promise(done => {
    const canvas = document.querySelector("#canvas");
    new MutationObserver((_, watcher) => {
      if (canvas.dataset.build === "${old}") return;
      watcher.disconnect();
      requestAnimationFrame(() => done(Date.now()));
    }).observe(canvas, { attributes: true });
  })`);
  const began = Date.now();
  appendFileSync(SHOT, `-- ${i}\n`);
  return await painted - began;
}

/** The sum over a process and all that it has started: of(fields of /proc/N/stat from the 3rd). */
function sumOf(root, of) {
  const parents = new Map(), values = new Map();
  for (const id of readdirSync("/proc").filter(name => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${id}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
      parents.set(id, fields[1]);
      values.set(id, of(fields));
    } catch { /* it has ended */ }
  }
  const isUnder = id => id === root || parents.has(id) && isUnder(parents.get(id));
  return [...values].reduce((all, [id, value]) => all + (isUnder(id) ? value : 0), 0);
}

/** Milliseconds of the processors. */
const timeOf = root => sumOf(root, fields => (Number(fields[11]) + Number(fields[12])) * TICK);
const serverTime = () => timeOf(SERVER);
const pageTime = () => timeOf(String(process.pid)); // with the browser and what draws for it

/** What the server and its renderers hold, and the page's scripts, in MiB; the bytes of the scripts
 * and styles that the page has asked for. */
async function sizes() {
  await page.call("Performance.enable");
  const { metrics } = await page.call("Performance.getMetrics");
  const heap = metrics.find(one => one.name === "JSHeapUsedSize").value;
  const bytes = await page.get(`performance.getEntriesByType("resource")
    .filter(one => /[.](js|css)$/.test(one.name))
    .reduce((all, one) => all + one.decodedBodySize, 0)`);
  return { server_mib: Math.round(sumOf(SERVER, fields => Number(fields[21])) * PAGE / 1048576),
           scripts_mib: Math.round(heap / 1048576), page_bytes: bytes };
}

/** Milliseconds from opening the page until its first picture. */
async function first(count) {
  const list = [];
  await page.call("Page.addScriptToEvaluateOnNewDocument", { source: `
    (function look() {
      if (document.querySelector("#canvas")?.dataset.frame) window.firstAt = performance.now();
      else requestAnimationFrame(look);
    })();` });
  for (let i = 0; i < count; i++) {
    await page.load();
    await page.until("window.firstAt");
    list.push(await page.get("window.firstAt"));
  }
  return Math.round(middle(list));
}

/** What `count` frames cost that come as PNG, as rows of RGBA or as runs, each painted. */
async function travel(ending, count) {
  const server = serverTime(), own = pageTime(), began = Date.now();
  const bytes = await page.get(`(async () => {
    const canvas = document.createElement("canvas"), pen = canvas.getContext("2d");
    const headers = { "Celspan-Token": localStorage.getItem("celspan-token") };
    ${UNPACK}
    let all = 0;
    canvas.width = 1280;
    canvas.height = 720;
    for (let i = 1; i <= ${count}; i++) {
      const answer = await fetch("/frame/" + i + ".${ending}?size=1280x720", { headers });
      const bytes = await answer.arrayBuffer();
      all += bytes.byteLength;
      if ("${ending}" === "png") pen.drawImage(await createImageBitmap(new Blob([bytes])), 0, 0);
      else pen.putImageData(new ImageData("${ending}" === "runs" ? unpack(bytes, 1280, 720)
        : new Uint8ClampedArray(bytes), 1280, 720), 0, 0);
    }
    pen.getImageData(0, 0, 1, 1);
    return all;
  })()`);
  const each = value => Math.round(value / count * 10) / 10;
  return { server_cpu_ms: each(serverTime() - server), page_cpu_ms: each(pageTime() - own),
           wall_ms: each(Date.now() - began), kib: Math.round(bytes / count / 1024) };
}

/** Plays from a frame: how many frames are shown, and what one costs. */
async function play(seconds, from = 1) {
  begin(`playing from frame ${from}`);
  await page.get(scrubTo(from));
  await page.pause(1);
  const server = serverTime(), own = pageTime();
  await page.get(`(() => { window.seen = new Set();
    new MutationObserver(() => seen.add(document.querySelector("#canvas").dataset.frame))
      .observe(document.querySelector("#canvas"), { attributes: true }); })()`);
  await page.press(" ");
  await page.pause(seconds);
  const atEnd = await page.get(`document.querySelector("#canvas").width`);
  await page.press(" ");
  const frames = await page.get("seen.size");
  return { frames_a_second: Math.round(10 * frames / seconds) / 10, width: atEnd,
           server_cpu_ms: Math.round((serverTime() - server) / frames),
           page_cpu_ms: Math.round((pageTime() - own) / frames) };
}

/** Everything else, with the demo. */
async function measure(said) {
  begin("opening");
  said.first_ms = await first(9);
  begin("saving");
  const saves = [];
  for (let i = 0; i < 15; i++) {
    saves.push(await save(i));
    await page.pause(0.3);
  }
  said.save_ms = middle(saves);
  begin("scrubbing");
  said.scrub_ms = await several(25, i => scrubTo(2 + (i * 37) % 200), "frame");
  begin("a parameter");
  await page.press("v");
  said.parameter_ms = await several(15, i => `(() => {
    const input = document.querySelector("#form input[type=range]");
    input.value = ${(i % 9 + 1) / 10}; input.dispatchEvent(new Event("input")); })()`, "build");
  await page.press("v");
  await page.press("0");
  await page.pause(0.5);
  begin("zooming");
  said.zoom_ms = await several(100, () => `document.querySelector("#desk").dispatchEvent(
    new WheelEvent("wheel", { deltaY: -40, clientX: 700, clientY: 400 }))`, "size");
  await page.press("0");
  await page.until(`document.querySelector("#canvas").dataset.size === "1280x720"`);
  begin("pictures that travel");
  for (const ending of ["png", "rgba", "runs"]) {
    said[ending] = await travel(ending, 48).catch(() => null); // older pages have other modules
  }
  said.play = await play(8);
}

const said = { load: Number(readFileSync("/proc/loadavg", "utf8").split(" ")[0]) };
if (IS_PLAYED) {
  for (const [name, from] of Object.entries(SHOTS)) said[name] = await play(6, from);
  const sum = Object.keys(SHOTS).reduce((all, name) => all + said[name].frames_a_second, 0);
  said.all = { frames_a_second: Math.round(10 * sum / Object.keys(SHOTS).length) / 10 };
} else {
  await measure(said);
}
Object.assign(said, await sizes());
return said;
