// Whether the engine of web pages draws the frames that the program draws: asks it questions such
// as those of tests/golden/digests.txt, with the files of the current folder.
//
//   node tests/page/digests.mjs FOLDER QUESTIONS [EVERY]
//
// FOLDER: of ./run web. EVERY: 10 asks every tenth question. What celspan.wasm lacks is asked of
// celspan-whole.wasm, as pages do. What this lacks, too, is counted as not asked; the last line is
// `EQUAL DIFFERENT NOT_ASKED`.
import fs from "fs";
import path from "path";
import { pathToFileURL } from "url";
import { withFiles } from "./files.mjs";

const [folder, questions, every = "1"] = process.argv.slice(2);
const { open } = await import(pathToFileURL(path.resolve(folder, "engine.mjs")));
const modules = await Promise.all(["celspan", "celspan-whole"].map((name) =>
  WebAssembly.compile(fs.readFileSync(`${folder}/${name}.wasm`))));
const more = JSON.parse(fs.readFileSync(`${folder}/more.json`, "utf8"));

/** "1,5-7,10-20:5" -> numbers */
const frames_of = (text) => text.split(",").flatMap((part) => {
  const [, first, last, step] = part.match(/^(-?\d+)(?:-(-?\d+))?(?::(\d+))?$/);
  const all = [];
  for (let n = +first; n <= +(last ?? first); n += +(step ?? 1)) all.push(n);
  return all;
});

/** The lines of `celspan render --hash`. */
const answer = (engine, script, options) => {
  const film = engine.run(fs.readFileSync(script, "utf8"), { name: script });
  const [width, height] = options["--size"]?.split("x").map(Number) ?? [film.width, film.height];
  const last = film.first + film.count - 1;
  return frames_of(options["--frames"] ?? `${film.first}-${last}`).map((number) => {
    engine.frame(number);
    return `${number} ${engine.digest(width, height)}`;
  }).join("\n");
};

const ask = async (module, script, options) => {
  const engine = await open(module);
  return withFiles(engine, more, () => answer(engine, script, options), options["--allow"]);
};

const LACKS = /this celspan has no |needs the module |by the program celspan alone/;
const askAny = (script, options) => ask(modules[0], script, options).catch((error) => {
  if (!LACKS.test(error.message)) throw error;
  return ask(modules[1], script, options);
});

const LEAST = 50; // answers that are equal, when all questions are asked
const counts = { equal: 0, different: 0, skipped: 0 };
const blocks = fs.readFileSync(questions, "utf8").trim().split(/\n\n+/);
for (const [place, block] of blocks.entries()) {
  const [question, ...lines] = block.split("\n"), [kind, script, ...rest] = question.split(" ");
  const options = Object.fromEntries(rest.map((word, i) => [word, rest[i + 1]]));
  if (kind !== "render" || options["--crop"] || place % +every) continue;
  try {
    const found = await askAny(script, options);
    if (found === lines.join("\n")) counts.equal++;
    else {
      counts.different++;
      console.error(`${question}\n${found}\nbut the program says\n${lines.join("\n")}`);
    }
  } catch (error) {
    const lacks = LACKS.test(error.message);
    counts[lacks ? "skipped" : "different"]++;
    console.error(`${question}: ${lacks ? "" : "failed: "}${error.message}`);
    if (!lacks && !error.status) console.error(error.stack);
  }
}
console.log(counts.equal, counts.different, counts.skipped);
process.exit(counts.different > 0 || counts.equal < LEAST / every - 1 ? 1 : 0);
