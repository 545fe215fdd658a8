// The steps of watch.sh: a dark window of double density with the inspector on the cat, the values
// and the onion skin, and the form of a render.
await page.call("Emulation.setDeviceMetricsOverride",
  { width: 1120, height: 720, deviceScaleFactor: 2, mobile: false });
const isSettled = `document.querySelector("#canvas").dataset.frame === "69"
  && !("stale" in document.querySelector("#canvas").dataset)
  && document.querySelector("#timeline").ariaBusy === "false"`;
const shot = async name => {
  await page.until(isSettled);
  await page.pause(3);
  await page.shot(`${process.env.SHOTS}/${name}.png`);
};
const press = async keys => {
  for (const key of keys) {
    await page.press(key);
    await page.pause(1);
  }
};
const isDark = await page.get(`document.documentElement.dataset.theme === "dark"`);
if (!isDark) await page.press("t");
await press(["g", "6", "9", "Enter", "s", "p"]);
await page.until(isSettled);
const box = await page.get(`(r => [r.x, r.y, r.width, r.height])(
  document.querySelector("#canvas").getBoundingClientRect())`);
await page.click(box[0] + 0.362 * box[2], box[1] + 0.37 * box[3]);
await shot("watch");
await page.get(`document.querySelector('[aria-label="Onion: leap/cat"]').click(), 1`);
await press(["s", "v"]);
await shot("watch_values");
await press(["n", "n", "n", "v"]);
await page.get(`document.querySelector("#render").click()`);
await shot("watch_render");
