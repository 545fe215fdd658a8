// Runs the extension of editors/vscode with a substitute for the module `vscode`:
//
//   node vscode.js CELSPAN SCRIPT STEPS
//
// STEPS is a file with the body of an asynchronous function of `desk`; what it returns is printed as
// JSON. It is not part of the extension.
const fs = require("fs");
const Module = require("module");

const [program, script, steps] = process.argv.slice(2);
const SECONDS = 180; // for everything

const commands = new Map();
const desk = {
  shown: [],     // places that were opened: file, line from 0
  messages: [],  // what the panel was sent
  errors: [],    // sentences that were shown
  problems: new Map(), // by file: messages and lines from 0
  external: [],  // addresses
  editor: null, panel: null, fs,
  run: name => commands.get(name)(),
  /** What the panel says. */
  say: message => desk.panel.hear(message),
  pause: seconds => new Promise(done => setTimeout(done, seconds * 1000)),
  async until(test) {
    for (let i = 0; i < 400; i++) {
      const value = test();
      if (value) return value;
      await desk.pause(0.05);
    }
    throw new Error(`never true: ${test}`);
  },
  edit(line) {
    desk.editor = { document: { languageId: "lua", fileName: script },
                    selection: { active: { line } } };
  },
};

class Position { constructor(line, character) { Object.assign(this, { line, character }); } }
class Range { constructor(...of) { this.start = typeof of[0] === "number" ? new Position(of[0], of[1]) : of[0]; } }
class Diagnostic { constructor(range, message) { Object.assign(this, { range, message }); } }
const uri = path => ({ path, toString: () => path });

const vscode = {
  Position, Range, Diagnostic, DiagnosticSeverity: { Error: 0 }, ViewColumn: { One: 1, Beside: -2 },
  Uri: { file: uri, parse: uri },
  commands: { registerCommand(name, act) { commands.set(name, act); return { dispose() {} }; } },
  env: { openExternal: address => desk.external.push(address.path) },
  languages: { createDiagnosticCollection: () => ({
    clear: () => desk.problems.clear(),
    set: (of, list) => desk.problems.set(of.path,
      list.map(one => [one.range.start.line, one.message])),
    dispose() {},
  }) },
  workspace: {
    getConfiguration: () => ({ get: name => name === "path" ? program : [] }),
    openTextDocument: async of => ({ path: of.path }),
  },
  window: {
    get activeTextEditor() { return desk.editor; },
    showErrorMessage: sentence => desk.errors.push(sentence),
    showTextDocument: async (text, { selection }) => desk.shown.push([text.path, selection.start.line]),
    createWebviewPanel() {
      const panel = { isClosed: false, closed: [], webview: {
        html: "", postMessage: message => desk.messages.push(message),
        onDidReceiveMessage(act) { panel.hear = act; } },
        onDidDispose: act => panel.closed.push(act),
        dispose() {
          if (panel.isClosed) return;
          panel.isClosed = true;
          panel.closed.forEach(act => act());
        } };
      desk.panel = panel;
      return panel;
    },
  },
};

const load = Module._load;
Module._load = (name, ...more) => name === "vscode" ? vscode : load(name, ...more);

async function main() {
  const extension = require("../../editors/vscode/extension.js");
  extension.activate({ subscriptions: [] });
  const act = Object.getPrototypeOf(main).constructor("desk", fs.readFileSync(steps, "utf8"));
  const said = await act(desk);
  extension.deactivate();
  console.log(JSON.stringify(said ?? null));
  process.exit(0);
}

setTimeout(() => { console.error(`no end after ${SECONDS} seconds`); process.exit(1); }, SECONDS * 1000);
main().catch(fault => { console.error(fault); process.exit(1); });
