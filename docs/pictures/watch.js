// The steps of watch.sh: a dark window, and frame 112.
await page.call("Emulation.setDeviceMetricsOverride",
  { width: 1440, height: 855, deviceScaleFactor: 1, mobile: false });
await page.pause(4);
for (const key of ["g", "1", "1", "2", "Enter", "t"]) {
  await page.press(key);
  await page.pause(1);
}
await page.pause(25); // until the picture is sharp
await page.shot(process.env.SHOT);
