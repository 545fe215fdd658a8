// Measures the player in a browser, as steps of tests/support/browser.js (./run bench player), with
// planes in the folder that CELSPAN_PLAYED names: bytes; milliseconds until the first picture of
// the moon through a line of 4 Mbit/s and 20 milliseconds; frames a second of a thousand shapes at
// 1280 x 720 and of eight moons on a page; and milliseconds of processor time for a frame.
const fs = require("fs"), { gzipSync } = require("zlib");
const folder = process.env.CELSPAN_PLAYED, SECONDS = 8;
const LINE = { offline: false, latency: 20, downloadThroughput: 5e5, uploadThroughput: 5e5 };
const FREE = { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: -1 };
const site = await require("./site.js")(folder);
const size = name => fs.statSync(`${folder}/${name}`).size;
const middle = list => [...list].sort((a, b) => a - b)[list.length >> 1];

async function show(films) {
  site.pages["x.html"] = `<!doctype html><title>x</title><body style="margin: 0">${films}
    <script>const films = [...document.querySelectorAll("celspan-film")];
      const counts = films.map(() => 0);
      let first = null;
      films.forEach((film, i) => film.addEventListener("timeupdate", () => counts[i]++));
      films[0].addEventListener("loadeddata", () => { first = performance.now(); });</script>
    <script type="module" src="celspan-film.js"></script>`;
  await page.load(site.at("x.html"), /^http:/);
  await page.until("first");
}

async function first_picture() {
  await page.call("Network.emulateNetworkConditions", LINE);
  await show(`<celspan-film src="moonrise.plane" width="640"></celspan-film>`);
  await page.call("Network.emulateNetworkConditions", FREE);
  return page.get("first");
}

async function script_seconds() {
  const { metrics } = await page.call("Performance.getMetrics");
  return metrics.find(({ name }) => name === "ScriptDuration").value;
}

async function played(name, count, width) {
  await show(`<celspan-film src="${name}.plane" width="${width}" autoplay loop></celspan-film>`
    .repeat(count));
  await page.pause(1); // the first frames are compiled
  const before = await page.get("counts"), began = await script_seconds();
  await page.pause(SECONDS);
  const after = await page.get("counts"), spent = await script_seconds() - began;
  const frames = after.map((number, i) => number - before[i]);
  const all = frames.reduce((sum, number) => sum + number, 0);
  return { frames_a_second: frames.map(number => +(number / SECONDS).toFixed(1)),
           processor_ms_a_frame: +(1000 * spent / all).toFixed(2) };
}

await page.call("Network.enable");
await page.call("Network.setCacheDisabled", { cacheDisabled: true });
await page.call("Performance.enable", { timeDomain: "threadTicks" }); // not those of other programs
await page.call("Emulation.setDeviceMetricsOverride",
  { width: 1280, height: 720, deviceScaleFactor: 1, mobile: false });
const firsts = [];
for (let i = 0; i < 7; i++) firsts.push(await first_picture());
const found = {
  script_gzip_bytes: gzipSync(fs.readFileSync(`${folder}/celspan-film.js`), { level: 9 }).length,
  moon_bytes: size("moonrise.plane"), thousand_bytes: size("thousand.plane"),
  first_picture_ms: Math.round(middle(firsts)),
  first_picture_worst_ms: Math.round(Math.max(...firsts)),
  thousand: await played("thousand", 1, 1280), eight_moons: await played("moonrise", 8, 300),
};
site.close();
return found;
