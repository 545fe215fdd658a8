// The npm package celspan-web: packed and installed in an empty project, where it draws what the
// program draws, and where scripts that are wrong or evil end with sentences.
//
//   node tests/page/package.mjs FOLDER CELSPAN      FOLDER: of ./run web
import assert from "assert/strict";
import fs from "fs";
import os from "os";
import path from "path";
import { execFileSync } from "child_process";
import { pathToFileURL } from "url";
import { Worker } from "worker_threads";

const MOST = 1e6; // bytes of the packed package

const [folder, celspan] = process.argv.slice(2).map((name) => path.resolve(name));
const project = fs.mkdtempSync(path.join(os.tmpdir(), "celspan-web-"));
process.on("exit", () => fs.rmSync(project, { recursive: true, force: true }));
const inside = (command, ...words) =>
  execFileSync(command, words, { cwd: project, encoding: "utf8" });
/** Like the engine, which knows no folder of a script: its files are in the given one. */
const native = (folder, script, ...words) => execFileSync(celspan, ["render", "-", "--progress",
  "none", ...words], { cwd: folder, input: fs.readFileSync(script), maxBuffer: 2 ** 30 });

const tarball = inside("npm", "pack", "--silent", folder).trim();
const packed = fs.statSync(path.join(project, tarball)).size;
console.log(`${tarball}: ${packed} bytes`);
assert.ok(packed < MOST, `more than ${MOST} bytes`);
inside("npm", "init", "-y");
inside("npm", "install", "--offline", "--no-audit", "--no-fund", `./${tarball}`);

// The example of README.md is written as there, so it asks for the package by its name.
const own = path.join(project, "node_modules/celspan-web");
const readme = fs.readFileSync(path.join(own, "README.md"), "utf8");
fs.writeFileSync(path.join(project, "card.mjs"), readme.match(/```js\n([^]*?)```/)[1]);
inside("node", "card.mjs");
const header = fs.readFileSync(path.join(project, "card.png")).subarray(16, 24);
assert.deepEqual([header.readUInt32BE(0), header.readUInt32BE(4)], [1200, 630]);

const { open, render } = await import(pathToFileURL(path.join(own, "render.mjs")));
const bytes = fs.readFileSync(path.join(own, "celspan.wasm"));
const module = await WebAssembly.compile(bytes);
const more = JSON.parse(fs.readFileSync(path.join(own, "more.json"), "utf8"));

/** The same as render of a file, with the files that it lists as missing. */
const draw = async (folder, script, options) => {
  const files = { ...more };
  for (;;) {
    const source = fs.readFileSync(script, "utf8");
    try { return await render(source, { module, files, ...options }); }
    catch (error) {
      const found = (error.missing ?? [])
        .filter((name) => fs.statSync(folder + name, { throwIfNoEntry: false })?.isFile());
      if (!found.length) throw error;
      for (const name of found) files[name] = fs.readFileSync(folder + name);
    }
  }
};

// ---- it draws what the program draws

const FILMS = [[".", "tests/page/card.lua", 1, [1200, 630]],
               ["scripts", "scripts/demo.lua", 30, [320, 180]],
               ["scripts", "scripts/waving.lua", 24, [333, 187]]];
for (const [place, script, frame, size] of FILMS) {
  const words = [place, script, "--frames", `${frame}`, "--size", size.join("x")];
  const { data } = await draw(place, script, { frame, size, format: "pixels" });
  assert.ok(native(...words, "-o", "-").equals(Buffer.from(data.buffer)), `${script}: pixels`);
  const png = Buffer.from(await draw(place, script, { frame, size }));
  const [file, other] = ["web.png", "program.png"].map((name) => path.join(project, name));
  native(...words, "-o", other);
  assert.ok(fs.readFileSync(other).equals(png), `${script}: PNG`);
  fs.writeFileSync(file, png);
  native(...words, "-o", `${other}.tga`);
  execFileSync(celspan, ["compare", file, `${other}.tga`]);
}

// ---- a worker gets the compiled module

const posted = await new Promise((resolve, reject) => {
  const code = `const { parentPort, workerData } = require("worker_threads");
    import(workerData.url).then(async ({ render }) =>
      parentPort.postMessage(await render("return rostrum { back = 'teal' }", workerData)))`;
  const url = pathToFileURL(path.join(own, "render.mjs")).href;
  const worker = new Worker(code, { eval: true,
    workerData: { url, module, size: [2, 1], format: "pixels" } });
  worker.on("message", resolve).on("error", reject);
});
assert.deepEqual([...posted.data], [0, 128, 128, 255, 0, 128, 128, 255]);

// ---- what cannot be drawn is a sentence, and the next call works

const DISC = "return rostrum { cel { circle { 50, 50, 40, fill = parameters { tint = 'gold' }.tint } } }";
const size = [100, 100];
const disc = await render(DISC, { module, size });
const refused = async (sentence, source, options) => {
  await assert.rejects(render(source, { module, size, ...options }), (error) => {
    assert.match(error.message, sentence);
    return true;
  });
  assert.deepEqual(await render(DISC, { module, size }), disc, `after: ${sentence}`);
};
await refused(/^film\.lua:1: .*'radus'.*'radius'/, "return rostrum { cel { circle { radus = 1 } } }");
await refused(/no parameter 'hue'/, DISC, { set: { hue: "red" } });
await refused(/x\.ttf/, "return rostrum { cel { text { 'A', font = 'x.ttf' } } }");
await refused(/steps/, "while true do end");
await refused(/steps/, "pcall(function() while true do end end) while true do end");
await refused(/the script needs more than 128 MiB/, "local t = {} while true do t[#t + 1] = ('x'):rep(1e6) .. #t end");
await refused(/memory/, DISC, { size: [16384, 16384], memory: 2 ** 25, format: "pixels" });
await refused(/width must be a whole number/, DISC, { size: 5 });
await refused(/whole number, got 1.5/, DISC, { frame: 1.5 });
await refused(/format must be/, DISC, { format: "jpg" });
await refused(/a file is a text or bytes/, DISC, { files: { "a.lua": 5 } });
await refused(/module must be the compiled/, DISC, { module: undefined });
await refused(/celspan\.wasm is damaged/, DISC, { module: bytes.subarray(0, bytes.length / 2) });
await refused(/is no celspan\.wasm of this version/, DISC,
  { module: new WebAssembly.Module(Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0)) });
await assert.rejects(render("return rostrum { cel { text { 'A', font = 'x.ttf' } } }", { module }),
  ({ missing }) => missing.join() === "/x.ttf");
assert.deepEqual(await render(DISC, { module: bytes, size }), disc);
assert.notDeepEqual(await render(DISC, { module, size, set: { tint: "teal" } }), disc);

// ---- its memory

const engine = await open(module);
await assert.rejects(async () => engine.pixels(2, 2), /run a script first/);
console.log("the package draws what the program draws");
