// The size of the engine of web pages, and the time and the memory of a card.
//
//   node tests/page/measure.mjs FOLDER
//
// FOLDER: of ./run web. Sizes and memory may not be greater than here; seconds are only printed.
import fs from "fs";
import path from "path";
import zlib from "zlib";
import { pathToFileURL } from "url";

const MOST = { gzip: 850000, brotli: 720000 }; // bytes of celspan.wasm
const MOST_MEMORY = 32 << 20;

const [folder] = process.argv.slice(2);
let good = true;
const check = (name, value, most) => {
  if (value <= most) return;
  good = false;
  console.error(`${name} is ${value}, more than ${most}`);
};

const pack = (bytes) => ({
  gzip: zlib.gzipSync(bytes, { level: 9 }).length,
  brotli: zlib.brotliCompressSync(bytes, { params: {
    [zlib.constants.BROTLI_PARAM_QUALITY]: 11, [zlib.constants.BROTLI_PARAM_LGWIN]: 24,
    [zlib.constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } }).length });

console.log("file                    bytes      gzip    brotli");
for (const name of ["celspan.wasm", "celspan-whole.wasm", "engine.mjs", "more.json"]) {
  const bytes = fs.readFileSync(`${folder}/${name}`), packed = pack(bytes);
  console.log(name.padEnd(20), ...[bytes.length, packed.gzip, packed.brotli]
    .map((size) => String(size).padStart(9)));
  if (name === "celspan.wasm")
    for (const way of Object.keys(MOST)) check(`${name} by ${way}`, packed[way], MOST[way]);
}

const { open } = await import(pathToFileURL(path.resolve(folder, "engine.mjs")));
const bytes = fs.readFileSync(`${folder}/celspan.wasm`);
const font = fs.readFileSync("scripts/type/block.ttf");
const card = fs.readFileSync("tests/page/card.lua", "utf8");
const draw = (engine) => {
  engine.run(card, { name: "card.lua" });
  engine.frame(1);
  return engine.pixels(1200, 630);
};
const begun = performance.now();
const module = await WebAssembly.compile(bytes);
const engine = await open(module, { files: { "scripts/type/block.ttf": font } });
draw(engine);
const times = [performance.now() - begun];
for (let i = 0; i < 9; i++) {
  const from = performance.now();
  draw(engine);
  times.push(performance.now() - from);
}
const next = times.slice(1).sort((a, b) => a - b)[4];
console.log(`a card of 1200 x 630: ${times[0].toFixed()} ms with compiling, then ${next.toFixed()} ms;`,
  `${(engine.memory().all / 2 ** 20).toFixed(1)} MiB of memory`);
check("the memory of a card", engine.memory().all, MOST_MEMORY);
process.exit(good ? 0 : 1);
