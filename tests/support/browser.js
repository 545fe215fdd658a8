// Drives a page in Debian's chromium, such as that of celspan watch, through a pipe of its own:
//
//   node browser.js FOLDER ADDRESS STEPS
//
// FOLDER is the browser's own, ADDRESS the page that is opened, or about:blank. STEPS is a file with
// the body of an asynchronous function of `page`; what it returns is printed as JSON. It is not part
// of the page.
const { spawn } = require("child_process");
const fs = require("fs");

const [folder, address, steps] = process.argv.slice(2);
const SECONDS = Number(process.env.CELSPAN_BROWSER_SECONDS ?? 60); // for everything

const browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--disable-gpu", "--mute-audio",
  "--no-first-run", "--disable-extensions", "--disable-background-networking",
  "--remote-debugging-pipe", "--window-size=1280,800", `--user-data-dir=${folder}`],
  { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
// Ends all its processes: one that survives would write to a folder that the caller removes.
const end = code => { process.kill(-browser.pid, "SIGKILL"); process.exit(code); };
const fail = fault => { console.error(fault); end(1); };
setTimeout(() => fail(`no end after ${SECONDS} seconds`), SECONDS * 1000);

// ---- messages: JSON, ended by a zero

let last = 0, text = "";
const waiting = new Map(), requests = [];

function send(method, params = {}, sessionId) {
  const id = ++last;
  browser.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
  return new Promise((resolve, reject) => waiting.set(id, { resolve, reject }));
}

function take(message) {
  if (message.method === "Network.requestWillBeSent") requests.push(message.params.request.url);
  const call = waiting.get(message.id);
  if (!call) return;
  waiting.delete(message.id);
  if (message.error) call.reject(new Error(message.error.message));
  else call.resolve(message.result);
}

browser.stdio[4].on("data", bytes => {
  text += bytes;
  for (let at; (at = text.indexOf("\0")) >= 0; text = text.slice(at + 1)) {
    take(JSON.parse(text.slice(0, at)));
  }
});

// ---- the page

const CODES = { " ": "Space", ArrowLeft: "ArrowLeft", ArrowRight: "ArrowRight" };
const TEXTS = { Enter: "\r" };
const pause = seconds => new Promise(done => setTimeout(done, seconds * 1000));

async function open() {
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const call = (method, params) => send(method, params, sessionId);
  const page = {
    call, pause, requests,
    /** The value of an expression in the page. */
    async get(expression) {
      const answer = await call("Runtime.evaluate",
        { expression, awaitPromise: true, returnByValue: true });
      if (answer.exceptionDetails) throw new Error(JSON.stringify(answer.exceptionDetails));
      return answer.result.value;
    },
    /** Waits until an expression is true. */
    async until(expression) {
      for (let i = 0; i < 400; i++) {
        if (await page.get(`Boolean(${expression})`)) return;
        await pause(0.05);
      }
      throw new Error(`never true: ${expression}`);
    },
    async press(key, modifiers = 0) {
      const params = { key, code: CODES[key], modifiers, text: key.length === 1 ? key : TEXTS[key] };
      await call("Input.dispatchKeyEvent", { type: "keyDown", ...params });
      await call("Input.dispatchKeyEvent", { type: "keyUp", ...params, text: undefined });
    },
    async mouse(type, x, y, more = {}) {
      await call("Input.dispatchMouseEvent", { type, x, y, ...more });
    },
    async click(x, y) {
      await page.mouse("mousePressed", x, y, { button: "left", clickCount: 1 });
      await page.mouse("mouseReleased", x, y, { button: "left", clickCount: 1 });
    },
    write: (path, text) => fs.writeFileSync(path, text),
    /** A picture of the window, into a file. */
    async shot(path) {
      const { data } = await call("Page.captureScreenshot", { format: "png" });
      fs.writeFileSync(path, Buffer.from(data, "base64"));
    },
  };
  if (address === "about:blank") return page;
  await call("Network.enable");
  await call("Page.navigate", { url: address });
  await page.until("location.protocol === 'http:' && document.readyState === 'complete'");
  return page;
}

async function main() {
  const page = await open();
  const act = Object.getPrototypeOf(main).constructor("page", "require", fs.readFileSync(steps, "utf8"));
  console.log(JSON.stringify(await act(page, require) ?? null));
  end(0);
}

main().catch(fail);
