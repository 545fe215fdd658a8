// Speaks to the server of celspan watch as a program or a stranger would, byte by byte:
//
//   node stranger.js ADDRESS STEPS
//
// STEPS is a file with the body of an asynchronous function of `web`; what it returns is printed as
// JSON.
const net = require("net");
const fs = require("fs");

const [address, steps] = process.argv.slice(2);
const [, host, port, token] = address.match(/^http:\/\/([^:]+):(\d+)\/\?token=(\w+)$/);
const SECONDS = 150; // for everything
setTimeout(() => { console.error(`no end after ${SECONDS} seconds`); process.exit(1); },
           SECONDS * 1000);

const pause = seconds => new Promise(done => setTimeout(done, seconds * 1000));

/** A connection: what it received, and whether it has ended. */
function connect() {
  const line = { text: "", isOver: false, socket: net.connect(Number(port), host) };
  line.socket.on("data", bytes => { line.text += bytes.toString("latin1"); });
  line.socket.on("error", () => {});
  line.socket.on("close", () => { line.isOver = true; });
  line.send = bytes => line.socket.write(bytes);
  line.over = async seconds => {
    for (let i = 0; i < seconds * 50 && !line.isOver; i++) await pause(0.02);
    return line.isOver;
  };
  return line;
}

/** An answer of a request, of which everything may be chosen. */
async function ask(path, { method = "GET", headers = {}, body = "" } = {}) {
  const all = { Host: `127.0.0.1:${port}`, Connection: "close", ...headers };
  if (body) all["Content-Length"] = body.length;
  const lines = Object.entries(all).filter(([, value]) => value !== null)
    .map(([name, value]) => `${name}: ${value}\r\n`).join("");
  const line = connect(), began = Date.now();
  line.send(`${method} ${path} HTTP/1.1\r\n${lines}\r\n${body}`);
  await line.over(30);
  const at = line.text.indexOf("\r\n\r\n");
  return { status: Number(line.text.slice(9, 12)), head: line.text.slice(0, at),
           body: line.text.slice(at + 4), seconds: (Date.now() - began) / 1000 };
}

const web = {
  host, port, token, pause, connect, ask,
  /** The same with the token. */
  get: (path, more) => ask(`${path}${path.includes("?") ? "&" : "?"}token=${token}`, more),
  statuses: async list => {
    const found = [];
    for (const [path, more] of list) found.push((await ask(path, more)).status);
    return found;
  },
};

async function main() {
  const act = Object.getPrototypeOf(main).constructor("web", "require", fs.readFileSync(steps, "utf8"));
  console.log(JSON.stringify(await act(web, require) ?? null));
  process.exit(0);
}

main().catch(fault => { console.error(fault); process.exit(1); });
