// The films of `bench films` by the engine of web pages, beside the program with one worker:
// milliseconds of a processor for a frame of 1280 x 720, to pixels. From the top of the tree:
//
//   node tests/bench/web.mjs WEB PROGRAM     WEB: of ./run web; PROGRAM: celspan
//
// `first` is a film's first measured frame, which makes what the later ones use again.
import { spawnSync } from "child_process";
import fs from "fs";
import path from "path";
import { pathToFileURL } from "url";
import { withFiles } from "../page/files.mjs";

const FRAMES = 48, ROUNDS = 3;
const FILMS = [
  ["demo", "scripts/demo.lua", 100],
  ["film opening", "scripts/film.lua", 101],
  ["film street", "scripts/film.lua", 250],
  ["film close", "scripts/film.lua", 421],
  ["film town", "scripts/film.lua", 600],
  ["simple", "tests/bench/scripts/simple.lua", 60],
  ["flat discs", "tests/bench/scripts/discs.lua", 60],
  ["procedures", "scripts/scanline.lua", 1],
];

const [web, program] = process.argv.slice(2);
const { open } = await import(pathToFileURL(path.resolve(web, "engine.mjs")));
const module = await WebAssembly.compile(fs.readFileSync(`${web}/celspan-whole.wasm`));
const more = JSON.parse(fs.readFileSync(`${web}/more.json`, "utf8"));
const size = [1280, 720];

const processor = (work) => {
  const from = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(from);
  return (user + system) / 1000;
};

/** The engine with the files that a film looks for, and after the script has run. */
const start = async (script, first) => {
  const engine = await open(module), source = fs.readFileSync(script, "utf8");
  const run = () => engine.run(source, { name: script, steps: 1e9, memory: 2 ** 30 });
  withFiles(engine, more, () => {
    run();
    engine.frame(first);
    engine.pixels(...size);
  });
  return [engine, run()];
};

const inPage = async (script, first) => {
  const [engine, film] = await start(script, first);
  const draw = (number) => processor(() => { engine.frame(number); engine.pixels(...size); });
  const count = Math.min(FRAMES, film.first + film.count - 1 - first);
  const cold = draw(first);
  let all = 0;
  for (let number = first + 1; number <= first + count; number++) all += draw(number);
  engine.close();
  return [cold, count > 0 ? all / count : undefined, count];
};

/** Processor time of the program for some frames, in milliseconds. */
const native = (script, first, last) => {
  const command = `TIMEFORMAT='%U %S'; time '${program}' render '${script}' --trust --limit time=0 ` +
    `--size ${size.join("x")} --workers 1 --progress none --frames ${first}-${last} -o - >/dev/null`;
  const { stderr } = spawnSync("bash", ["-c", command], { encoding: "utf8",
    env: { ...process.env, CELSPAN_PATH: "scripts/?.lua" } });
  const times = stderr.trim().split(/\s+/).slice(-2).map(Number);
  if (times.some(isNaN)) throw new Error(stderr);
  return 1000 * (times[0] + times[1]);
};

const least = (values) => Math.min(...values);
console.log("ms a frame        program      page  ratio   first: program      page");
for (const [name, script, first] of FILMS) {
  const pages = [], starts = [], wholes = [];
  for (let round = 0; round < ROUNDS; round++) {
    pages.push(await inPage(script, first));
    starts.push(native(script, first, first));
    if (pages[0][2] > 0) wholes.push(native(script, first, first + pages[0][2]));
  }
  const cold = [least(starts), least(pages.map((page) => page[0]))];
  const warm = pages[0][2] > 0
    ? [(least(wholes) - cold[0]) / pages[0][2], least(pages.map((page) => page[1]))] : [];
  console.log(name.padEnd(14), ...[warm[0], warm[1]].map((v) => (v?.toFixed(2) ?? "-").padStart(10)),
    (warm.length ? (warm[1] / warm[0]).toFixed(2) : "-").padStart(6),
    ...cold.map((v, i) => v.toFixed(1).padStart(i ? 10 : 16)));
}
