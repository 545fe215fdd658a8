// The extension of Visual Studio Code for celspan: the film beside its script.
//
//   celspan watch --its address--> this extension --pictures, objects, outlines--> the panel
//                                      ^    |                                        |
//       the editor --line, command-----'    '--a place in a file--> the editor <-----'
//
// The panel cannot show the page of `celspan watch` itself, which no other page may contain; it asks
// for the same over the addresses for programs. Nothing leaves this machine.
const { spawn } = require("child_process");
const path = require("path");
const vscode = require("vscode");

let watched = null;      // the film that is shown: see start
let problems = null;     // the DiagnosticCollection
const RETRY = 300;       // milliseconds, after a request that was refused for the moment
const START = 15000;     // milliseconds in which celspan must print its address

const pause = time => new Promise(done => setTimeout(done, time));

// ---------------------------------------------------------------- celspan watch

/** The address that celspan prints when it serves. */
function addressOf(child) {
  return new Promise((resolve, reject) => {
    let out = "", words = "";
    const timer = setTimeout(() => reject(new Error("celspan watch does not answer")), START);
    child.stdout.on("data", bytes => {
      out += bytes;
      const found = out.match(/^watching (\S+)\n/m);
      if (found) resolve(new URL(found[1]));
    });
    child.stderr.on("data", bytes => { words = (words + bytes).slice(-2000); });
    child.on("error", reject);
    child.on("exit", () => {
      clearTimeout(timer);
      reject(new Error(words.trim() || "celspan watch has ended"));
    });
  });
}

/** Asks the film that is watched; null: it has no such answer. */
async function ask(of, place, fields = {}, body = undefined) {
  const url = new URL(place, of.address);
  url.searchParams.set("token", of.token);
  for (const [name, value] of Object.entries(fields)) url.searchParams.set(name, value);
  const answer = await fetch(url, body && { method: "POST", body: JSON.stringify(body) });
  if (answer.status === 503) {
    await pause(RETRY);
    return of.isOver ? null : ask(of, place, fields, body);
  }
  return answer.ok ? answer : null;
}

async function askJson(...what) {
  const answer = await ask(...what);
  return answer ? answer.json() : null;
}

function end() {
  const old = watched;
  watched = null;
  if (!old) return;
  old.isOver = true;
  old.child.kill();
  old.panel.dispose();
  problems.clear();
}

// ---------------------------------------------------------------- the panel

const PANEL = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>celspan</title>
<meta http-equiv="Content-Security-Policy"
  content="default-src 'none'; style-src 'unsafe-inline'; script-src 'nonce-NONCE'">
<style>
  body { display: grid; grid-template-rows: auto auto 1fr; gap: 8px; padding: 8px; }
  canvas { max-width: 100%; background: #777; cursor: crosshair; }
  canvas.old { filter: grayscale(1) brightness(0.6); }
  label { display: flex; gap: 8px; align-items: center; } input { flex: 1; }
  ol { margin: 0; padding-left: 1.6em; } #error { color: var(--vscode-errorForeground); }
  button { background: none; border: 0; color: var(--vscode-textLink-foreground); cursor: pointer; }
</style></head><body>
<canvas id="canvas" role="img" aria-label="The frame" width="1" height="1"></canvas>
<label>Frame <input id="scrub" type="range" min="1" max="1" value="1"><output id="frame">1</output></label>
<div><p id="error" role="alert"></p><ol id="hits"></ol></div>
<script nonce="NONCE">
  const host = acquireVsCodeApi(), here = id => document.getElementById(id);
  const canvas = here("canvas"), pen = canvas.getContext("2d");
  let size = [1, 1];
  const takes = {
    film(film) { here("scrub").max = film.frames; },
    picture({ width, height, bytes, units, number }) {
      size = units;
      canvas.width = width;
      canvas.height = height;
      pen.putImageData(new ImageData(new Uint8ClampedArray(bytes), width, height), 0, 0);
      here("frame").value = number;
      here("scrub").value = number;
    },
    outline({ width, height, bytes }) {
      const isIn = (x, y) => x >= 0 && y >= 0 && x < width && y < height
        && bytes[4 * (y * width + x) + 3] > 127;
      pen.fillStyle = "#ff961e";
      for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
          const own = isIn(x, y);
          if (own !== isIn(x + 1, y) || own !== isIn(x, y + 1)) pen.fillRect(x, y, 2, 2);
        }
      }
    },
    hits(list) {
      here("hits").replaceChildren(...list.map(hit => {
        const item = document.createElement("li"), button = document.createElement("button");
        button.textContent = (hit.name || hit.kind) + (hit.file ? " " + hit.file + ":" + hit.line : "");
        button.onclick = () => host.postMessage({ open: hit });
        item.append(button);
        return item;
      }));
    },
    errors(list) {
      here("error").textContent = list.length > 0 ? list[0].message : "";
      canvas.classList.toggle("old", list.length > 0);
    },
  };
  addEventListener("message", event => takes[event.data.kind](event.data.value));
  here("scrub").oninput = () => host.postMessage({ frame: Number(here("scrub").value) });
  canvas.onclick = event => host.postMessage({ at: [
    event.offsetX / canvas.clientWidth * size[0], event.offsetY / canvas.clientHeight * size[1]] });
</script></body></html>`;

const MOST = 960; // pixels of a side of the picture in the panel

/** The size of the picture: that of the film, or smaller. */
function sizeOf(film) {
  const scale = Math.min(1, MOST / Math.max(...film.size));
  return film.size.map(side => Math.max(1, Math.round(side * scale)));
}

/** One picture of the frame that is shown; null: it could not be made. */
async function fetchPicture(of, fields = {}) {
  const [width, height] = sizeOf(of.film);
  const name = of.number - 1 + of.film.first;
  const answer = await ask(of, `/frame/${name}.rgba`, { size: `${width}x${height}`, ...fields });
  if (!answer) return null;
  return { width, height, units: of.film.size, number: of.number,
           bytes: Array.from(new Uint8Array(await answer.arrayBuffer())) };
}

/** Shows the frame; while one is on its way, only the newest wish is kept. */
async function show(of) {
  of.isWanted = true;
  if (of.isAsking || !of.film) return;
  of.isAsking = true;
  while (of.isWanted && !of.isOver) {
    of.isWanted = false;
    const picture = await fetchPicture(of);
    if (!picture || of.isOver) continue;
    of.panel.webview.postMessage({ kind: "picture", value: picture });
    if (!of.here) continue;
    const value = await fetchPicture(of, { show: "made", file: of.here.file, line: of.here.line });
    if (value && !of.isOver) of.panel.webview.postMessage({ kind: "outline", value });
  }
  of.isAsking = false;
}

/** The place of a file as the film has it: it is beside the script, or named from the root. */
const placeOf = (of, file) => vscode.Uri.file(path.resolve(of.folder, file));

async function openLine(of, { file, line }) {
  if (!file) return;
  const at = new vscode.Position(Math.max(0, line - 1), 0);
  const text = await vscode.workspace.openTextDocument(placeOf(of, file));
  await vscode.window.showTextDocument(text, { viewColumn: vscode.ViewColumn.One,
                                               selection: new vscode.Range(at, at) });
}

/** What the panel says. */
async function hear(of, said) {
  if (said.open) await openLine(of, said.open);
  if (said.frame && of.film) {
    of.number = Math.min(Math.max(1, said.frame), of.film.frames);
    show(of);
  }
  if (said.at && of.film) {
    const [x, y] = said.at.map(value => value.toFixed(4)), frame = of.number - 1 + of.film.first;
    const value = await askJson(of, `/at/${x},${y}.json`, { frame });
    if (value) of.panel.webview.postMessage({ kind: "hits", value });
  }
}

// ---------------------------------------------------------------- news

function showProblems(of, errors) {
  const lists = new Map();
  for (const { file, line, message } of errors) {
    const uri = placeOf(of, file || of.script), row = Math.max(0, (line || 1) - 1);
    const problem = new vscode.Diagnostic(new vscode.Range(row, 0, row, 1000), message,
                                          vscode.DiagnosticSeverity.Error);
    problem.source = "celspan";
    lists.set(uri.toString(), [uri, [...(lists.get(uri.toString()) || [null, []])[1], problem]]);
  }
  problems.clear();
  for (const [uri, list] of lists.values()) problems.set(uri, list);
}

function takeState(of, state) {
  const isNew = state.build !== of.build || state.shown !== of.isShown;
  const isOther = JSON.stringify(state.here) !== JSON.stringify(of.here);
  Object.assign(of, { news: state.news, build: state.build, isShown: state.shown,
                      here: state.here, film: state.film || of.film });
  if (of.film) {
    of.number = Math.min(of.number, of.film.frames);
    of.panel.webview.postMessage({ kind: "film", value: of.film });
  }
  of.panel.webview.postMessage({ kind: "errors", value: state.shown ? [] : state.errors });
  showProblems(of, state.errors);
  if (state.shown && (isNew || isOther)) show(of);
}

async function listen(of) {
  while (!of.isOver) {
    const state = await askJson(of, "/state.json", { since: of.news }).catch(() => null);
    if (of.isOver) return;
    if (state) takeState(of, state);
    else await pause(RETRY);
  }
}

// ---------------------------------------------------------------- commands

/** Watches the film of the Lua file that is open. */
async function watch() {
  const editor = vscode.window.activeTextEditor;
  if (!editor || editor.document.languageId !== "lua") {
    vscode.window.showErrorMessage("celspan: open the Lua script of a film first");
    return;
  }
  end();
  const settings = vscode.workspace.getConfiguration("celspan");
  const script = editor.document.fileName, folder = path.dirname(script);
  const child = spawn(settings.get("path"),
                      ["watch", path.basename(script), ...settings.get("arguments")],
                      { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  try {
    const address = await addressOf(child);
    start({ child, address, token: address.searchParams.get("token"), script, folder });
  } catch (fault) {
    child.kill();
    vscode.window.showErrorMessage(`celspan: ${fault.message}`);
  }
}

function start(given) {
  const panel = vscode.window.createWebviewPanel("celspan", path.basename(given.script),
    { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
    { enableScripts: true, retainContextWhenHidden: true });
  const of = { ...given, panel, number: 1, news: 0, build: 0, film: null, isShown: false };
  const nonce = require("crypto").randomBytes(16).toString("hex");
  panel.webview.html = PANEL.replaceAll("NONCE", nonce);
  panel.webview.onDidReceiveMessage(said => hear(of, said));
  panel.onDidDispose(() => { if (watched === of) end(); });
  given.child.on("exit", () => { if (watched === of) end(); });
  watched = of;
  listen(of);
}

/** Outlines what the line under the cursor made. */
async function outlineHere() {
  const editor = vscode.window.activeTextEditor;
  if (!watched || !editor) {
    vscode.window.showErrorMessage("celspan: watch a film first");
    return;
  }
  const place = { file: editor.document.fileName, line: editor.selection.active.line + 1 };
  if (!await ask(watched, "/here", {}, place)) {
    vscode.window.showErrorMessage("celspan: the film does not read this file");
  }
}

function openBrowser() {
  if (watched) vscode.env.openExternal(vscode.Uri.parse(watched.address.href));
  else vscode.window.showErrorMessage("celspan: watch a film first");
}

exports.activate = context => {
  problems = vscode.languages.createDiagnosticCollection("celspan");
  const commands = { "celspan.watch": watch, "celspan.here": outlineHere,
                     "celspan.browser": openBrowser, "celspan.stop": end };
  context.subscriptions.push(problems, { dispose: end },
    ...Object.entries(commands).map(([name, act]) => vscode.commands.registerCommand(name, act)));
};

exports.deactivate = end;
