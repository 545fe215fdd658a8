// A graphic of OGraf with the engine, without a browser: goToTime shows the frames of the program,
// also with other values, and a wrong value is a sentence.
//
//   node tests/page/ograf.mjs FOLDER CELSPAN      FOLDER: of ./run web
import assert from "assert/strict";
import fs from "fs";
import os from "os";
import path from "path";
import { execFileSync } from "child_process";
import { pathToFileURL } from "url";

const FILM = `
local p = parameters { name = "Ann", tint = { colour = "#f26419" }, at = { 20, 60, point = true } }
return film { size = { 320, 90 }, fps = 10, frames = 12, marks = { hold = 5 }, frame = function(f)
  return cel { circle { 24 * f.number, 45, 20.3, fill = p.tint },
    text { p.name, font = "type/block.ttf", size = 30, at = p.at } }
end }`;

const [web, celspan] = process.argv.slice(2).map((name) => path.resolve(name));
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "celspan-ograf-"));
process.on("exit", () => fs.rmSync(folder, { recursive: true, force: true }));
fs.mkdirSync(`${folder}/type`);
fs.copyFileSync("scripts/type/block.ttf", `${folder}/type/block.ttf`);
fs.writeFileSync(`${folder}/third.lua`, FILM);
const native = (...words) => execFileSync(celspan, ["render", "third.lua", "--progress", "none",
  ...words], { cwd: folder, maxBuffer: 2 ** 30 });
native("-o", "third.ograf", "--engine", web);

// ---- as much of a browser as a graphic needs

let seen; // the pixels of the canvas; null: nothing
class Element {
  attachShadow() { return this.shadowRoot = { replaceChildren() {} }; }
}
Object.assign(globalThis, {
  HTMLElement: Element,
  CSSStyleSheet: class { replaceSync() {} },
  ImageData: class { constructor(data) { this.data = data; } },
  requestAnimationFrame: (call) => setTimeout(call, 5),
  document: { createElement: () => ({ getContext() {
    return { canvas: this, putImageData: ({ data }) => { seen = Buffer.from(data); },
             clearRect: () => { seen = null; } };
  } }) },
  fetch: async (url) => new Response(fs.readFileSync(url)),
});

const { default: Graphic } =
  await import(pathToFileURL(path.join(folder, "third.ograf/graphic.mjs")));
const graphic = new Graphic();
const good = async (answer) => assert.equal((await answer)?.statusMessage, undefined);
const shows = (frame, ...words) =>
  assert.ok(seen.equals(native("--frames", `${frame}`, "-o", "-", ...words)), `frame ${frame}`);

await good(graphic.load({ data: {}, renderType: "non-realtime" }));
assert.ok(!seen);
for (const frame of [1, 7, 12]) {
  await good(graphic.goToTime({ timestamp: (frame - 1) * 100 }));
  shows(frame);
}
await good(graphic.updateAction({ data: { name: "Zoe", tint: "#3060c0", at: [60, 70] } }));
await good(graphic.goToTime({ timestamp: 340 }));
const values = ["--set", "name=Zoe", "--set", "tint=#3060c0", "--set", "at=60,70"];
shows(4, ...values);
const answer = await graphic.updateAction({ data: { tint: "no colour" } });
assert.equal(answer.statusCode, 400);
assert.match(answer.statusMessage, /tint/);
await good(graphic.goToTime({ timestamp: 341 }));
shows(4, ...values);

await good(graphic.load({ data: { name: "Ann" }, renderType: "realtime" }));
assert.deepEqual(await graphic.playAction({}), { statusCode: 200, currentStep: 0 });
shows(5);
await good(graphic.stopAction({}));
assert.equal(seen, null);
console.log("a graphic shows the frames of the program");
