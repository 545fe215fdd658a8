// Draws a card as PNG, once cold and then 20 times, and prints a row of the table of card.sh.
//
//   node tests/bench/card.mjs empty|celspan|satori FOLDER WEB
//
// Cold: what is loaded and compiled counts, reading the files does not.
import fs from "fs";
import path from "path";
import { createRequire } from "module";
import { pathToFileURL } from "url";

const [kind, folder, web] = process.argv.slice(2);
const TIMES = 20, SIZE = [1200, 630];
const font = fs.readFileSync("scripts/type/block.ttf");

const makers = {
  empty: async () => () => {},
  celspan: async () => {
    const bytes = fs.readFileSync(`${web}/celspan.wasm`);
    const card = fs.readFileSync("tests/page/card.lua", "utf8");
    let module;
    return async () => {
      const { render } = await import(pathToFileURL(path.resolve(web, "render.mjs")));
      module ??= await WebAssembly.compile(bytes);
      return render(card, { module, files: { "scripts/type/block.ttf": font } });
    };
  },
  satori: async () => {
    const require = createRequire(path.resolve(folder, "x.js"));
    const box = (style, ...children) => ({ type: "div", props: { style, children } });
    const card = box({ width: 1200, height: 630, display: "flex", background: "#f3ead6" },
      box({ position: "absolute", left: 80, top: 90, width: 160, height: 14, background: "#e0654f" }),
      box({ position: "absolute", left: 80, top: 120, width: 1040, fontSize: 76, color: "#232942" },
        "How lists of spans draw a whole film"),
      box({ position: "absolute", left: 80, top: 530, fontSize: 34, color: "#8d4a3b" },
        "28 November, 7 minutes"));
    return async () => {
      const { default: satori } = require("satori");
      const { Resvg } = require("@resvg/resvg-js");
      const svg = await satori(card, { width: SIZE[0], height: SIZE[1],
        fonts: [{ name: "block", data: font, weight: 400, style: "normal" }] });
      return new Resvg(svg).render().asPng();
    };
  },
};

const draw = await makers[kind]();
const times = [];
let png;
for (let i = 0; i <= TIMES; i++) {
  const begun = performance.now();
  png = await draw();
  times.push(performance.now() - begun);
}
const next = times.slice(1).sort((a, b) => a - b)[TIMES / 2];
const { rss } = process.memoryUsage();
if (png) fs.writeFileSync(`${folder}/${kind}.png`, png);
console.log(kind.padEnd(8), times[0].toFixed(1).padStart(14), next.toFixed(1).padStart(9),
  (rss / 2 ** 20).toFixed(1).padStart(14));
