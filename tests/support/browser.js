// Drives pages in Debian's chromium, such as that of celspan watch, through a pipe of its own:
//
//   node browser.js FOLDER ADDRESS STEPS
//   node browser.js FOLDER
//
// FOLDER is the browser's own, ADDRESS the page that is opened, or about:blank. STEPS is a file with
// the body of an asynchronous function of `page`; what it returns is printed as JSON. It is not part
// of the page. Without them, each line of standard input is ADDRESS STEPS SECONDS, and is answered by
// a line: a browser takes long to begin, and one does for many pages. They share nothing.
const { spawn } = require("child_process");
const fs = require("fs");
const readline = require("readline");

const [folder, ...single] = process.argv.slice(2);
const SECONDS = Number(process.env.CELSPAN_BROWSER_SECONDS ?? 180);

const browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--disable-gpu", "--mute-audio",
  "--no-first-run", "--disable-extensions", "--disable-background-networking",
  "--remote-debugging-pipe", "--window-size=1280,800", `--user-data-dir=${folder}`],
  { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
// Ends all its processes: one that survives would write to a folder that the caller removes.
const end = code => { process.kill(-browser.pid, "SIGKILL"); process.exit(code); };
const fail = fault => { console.error(fault); end(1); };

// ---- messages: JSON, ended by a zero

let last = 0, text = "";
const waiting = new Map();
let hear = () => {}; // for the events of the browser

function send(method, params = {}, sessionId) {
  const id = ++last;
  browser.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
  return new Promise((resolve, reject) => waiting.set(id, { resolve, reject }));
}

function take(message) {
  if (message.method) hear(message);
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

/** Hears all events: keeps the addresses that were asked for, and waits for documents. */
function listener() {
  const requests = [];
  let wanted, isHere, done;
  hear = ({ method, params }) => {
    if (method === "Network.requestWillBeSent") requests.push(params.request.url);
    const { url, urlFragment = "", parentId } = params.frame ?? {};
    if (method === "Page.frameNavigated" && !parentId) isHere = wanted?.test(url + urlFragment);
    if (method === "Page.loadEventFired" && isHere) done();
  };
  const loaded = pattern => new Promise(resolve => {
    [wanted, isHere, done] = [pattern, false, resolve];
  });
  return { requests, loaded };
}

async function open(address) {
  const { browserContextId } = await send("Target.createBrowserContext");
  const { targetId } = await send("Target.createTarget",
    { url: "about:blank", browserContextId, width: 1280, height: 800 });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const call = (method, params) => send(method, params, sessionId);
  const { requests, loaded } = listener();
  const page = {
    call, pause, requests,
    close: () => send("Target.disposeBrowserContext", { browserContextId }),
    /** Goes to an address, or loads the page again, and waits for the whole document: what was asked
     * meanwhile would have no answer. `wanted` matches its address where others lead to it. */
    async load(url, wanted = /^(?!about:)/) {
      const whole = loaded(wanted);
      const { errorText } = await (url ? call("Page.navigate", { url }) : call("Page.reload"));
      if (errorText) throw new Error(`${url}: ${errorText}`);
      await whole;
    },
    /** The value of an expression in the page. */
    async get(expression) {
      const answer = await call("Runtime.evaluate",
        { expression, awaitPromise: true, returnByValue: true });
      if (answer.exceptionDetails) throw new Error(JSON.stringify(answer.exceptionDetails));
      return answer.result.value;
    },
    /** Waits until an expression is true. */
    async until(expression) {
      for (let i = 0; i < 1200; i++) {
        if (await page.get(`Boolean(${expression})`)) return;
        await pause(0.05);
      }
      throw new Error(`never true: ${expression}`);
    },
    /** Waits until the page is laid out and drawn as it is now: places that are asked for before
     * that, after a panel was opened, are old ones. */
    async settle() {
      await page.get(`new Promise(done => requestAnimationFrame(
        () => requestAnimationFrame(() => done())))`);
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
  await call("Page.enable");
  if (address === "about:blank") return page;
  await call("Network.enable");
  await page.load(address, /^http:/);
  return page;
}

/** Prints what the steps return in a page. */
async function act(address, steps, given) {
  const seconds = Number(given) || SECONDS; // for everything
  const late = setTimeout(() => fail(`no end after ${seconds} seconds`), seconds * 1000);
  const page = await open(address);
  const all = Object.getPrototypeOf(act).constructor("page", "require", fs.readFileSync(steps, "utf8"));
  console.log(JSON.stringify(await all(page, require) ?? null));
  await page.close();
  clearTimeout(late);
}

async function main() {
  if (single.length) await act(...single);
  else for await (const line of readline.createInterface(process.stdin)) await act(...line.split(" "));
  end(0);
}

main().catch(fail);
