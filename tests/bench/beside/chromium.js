// A film by screenshots of headless Chromium: node chromium.js DRAWING FOLDER [PAGE]
"use strict";
const { spawn } = require("child_process");
const fs = require("fs");
const path = require("path");
const { pathToFileURL } = require("url");
const [drawing, folder, page = path.join(__dirname, "chromium.html")] = process.argv.slice(2);

const browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--disable-gpu",
  "--no-first-run", "--allow-file-access-from-files", "--remote-debugging-pipe",
  `--user-data-dir=${path.join(folder, "profile")}`],
  { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const waiting = new Map();
let last = 0, text = "", loaded;
const isLoaded = new Promise(resolve => { loaded = resolve; });

function send(method, params, sessionId) {
  browser.stdio[3].write(JSON.stringify({ id: ++last, method, params, sessionId }) + "\0");
  return new Promise((resolve, reject) => waiting.set(last, { resolve, reject }));
}

// Messages end with a zero; a screenshot comes in many pieces.
browser.stdio[4].setEncoding("utf8").on("data", piece => {
  const messages = (text + piece).split("\0");
  text = messages.pop();
  for (const { id, method, result, error } of messages.map(JSON.parse)) {
    if (method === "Page.loadEventFired") loaded();
    if (error) waiting.get(id)?.reject(new Error(error.message));
    else waiting.get(id)?.resolve(result);
    waiting.delete(id);
  }
});

async function main() {
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const call = (method, params) => send(method, params, sessionId);
  const run = expression => call("Runtime.evaluate", { expression, awaitPromise: true });
  await call("Emulation.setDeviceMetricsOverride",
    { width: 1280, height: 720, deviceScaleFactor: 1, mobile: false });
  await call("Page.enable");
  await call("Page.navigate", { url: pathToFileURL(page).href });
  await isLoaded;
  await run(`ready(${JSON.stringify(pathToFileURL(drawing).href)})`);
  for (let frame = 0; frame < 150; frame++) {
    await run(`show(${frame})`);
    const { data } = await call("Page.captureScreenshot", { format: "png" });
    const name = String(frame + 1).padStart(4, "0") + ".png";
    fs.writeFileSync(path.join(folder, name), Buffer.from(data, "base64"));
  }
  await send("Browser.close");
}

main().catch(fault => {
  console.error(fault);
  browser.kill();
  process.exitCode = 1;
});
