// The steps of watch.sh: a dark window with the rows of a shot, the values, and the form of a render.
await page.call("Emulation.setDeviceMetricsOverride",
  { width: 1280, height: 800, deviceScaleFactor: 1, mobile: false });
const isSettled = `document.querySelector("#canvas").dataset.frame === "60"
  && !("stale" in document.querySelector("#canvas").dataset)
  && document.querySelector("#timeline").ariaBusy === "false"`;
const shot = async name => {
  await page.until(isSettled);
  await page.pause(2);
  await page.shot(`${process.env.SHOTS}/${name}.png`);
};
const isDark = await page.get(`document.documentElement.dataset.theme === "dark"`);
if (!isDark) await page.press("t");
for (const key of ["g", "6", "0", "Enter", "s", "q"]) {
  await page.press(key);
  await page.pause(1);
}
await shot("watch");
for (const key of ["s", "v"]) await page.press(key);
await shot("watch_values");
await page.press("v");
await page.get(`document.querySelector("#render").click()`);
await shot("watch_render");
