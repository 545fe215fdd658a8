// The engine of the page, in a worker: it answers one question after the other. Files that a script
// reads are fetched beside this one, in files/, when the script has asked for them in vain.
import { open } from "./engine.js";

const LIMITS = { steps: 5e7, memory: 128 * 2 ** 20 };

let engine, ready = Promise.resolve(), running = ""; // running: the script whose film the engine has
let hasAll = false; // the engine, which then stays
let more, names; // the second file of Lua modules; the names of files/
const asked = new Set(), given = {}; // paths; files of readers

const part = async (name) => {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name} could not be loaded: ${answer.status}.`);
  return answer;
};
const json = async (name) => (await part(name)).json();

/** Whether a file that was looked for is there; it is then the engine's. */
const give = async (path) => {
  if (asked.has(path)) return false;
  asked.add(path);
  const isOwn = path.startsWith("/celspan/"), name = path.slice(1);
  const list = isOwn ? more ??= await json("more.json") : names ??= await json("files.json");
  if (isOwn ? !(name in list) : !list.includes(name)) return false;
  engine.file(path, isOwn ? list[name]
    : new Uint8Array(await (await part(`files/${name}`)).arrayBuffer()));
  return true;
};

/** Runs a script with those of the values for which it has parameters. */
const run = (source, name, set) => {
  const options = { name, ...LIMITS }, values = Object.entries(set);
  try { engine.run(source, { ...options, set }); } catch (error) {
    if (!values.length) throw error;
    engine.run(source, options);
    const known = engine.parameters().map((one) => one.name);
    const kept = values.filter(([one]) => known.includes(one));
    if (kept.length === values.length) throw error;
    engine.run(source, { ...options, set: Object.fromEntries(kept) });
  }
};

/** Runs a script, unless it has run, and builds a frame. Only what `line` made is in it, if any. */
const build = ({ source, name, set, frame, line }) => {
  const wanted = JSON.stringify([name, source, set]);
  if (running !== wanted) {
    running = "";
    run(source, name, set);
    running = wanted;
  }
  const film = engine.film(), last = film.first + film.count - 1;
  const number = Math.min(Math.max(frame ?? film.first, film.first), last);
  engine.frame(number);
  if (line && !engine.keep(`${name}:${line}`)) engine.frame(number);
  return { ...film, frame: number };
};

/** The pixels of a whole frame that fits in a box, and the part of it in the view. */
const sizes = ({ width, height }, { box, view: { scale, x, y } = { scale: 1, x: 0, y: 0 } }) => {
  const fit = Math.min(box[0] / width, box[1] / height);
  const part = [width, height].map((side) => Math.max(1, Math.round(side * fit)));
  const whole = part.map((side) => Math.round(side * scale));
  return { whole, part: [Math.round(x * whole[0]), Math.round(y * whole[1]), ...part] };
};

const calls = {
  draw(question) {
    const film = build(question), { whole, part } = sizes(film, question);
    const pixels = engine.pixels(...whole, part).slice().buffer;
    return { film, size: part.slice(2), pixels };
  },
  at(question) {
    build(question);
    return { places: engine.at(question.x, question.y) };
  },
};

/** The answer to a question, asked again for as long as files come that it lacked. */
const answer = async (question) => {
  for (;;) {
    postMessage({ id: question.id, isBegun: true });
    try {
      const call = calls[question.call] ?? (await import("../play/save.js")).calls[question.call];
      return await call(question, { engine, build, progress: (share) =>
        postMessage({ id: question.id, isBegun: true, share }) });
    } catch (error) {
      running = "";
      const found = await Promise.all(engine.missing().map(give));
      if (!found.includes(true)) throw error;
    }
  }
};

const reply = async ({ module, isWhole, ...question }) => {
  const { id } = question;
  try {
    if (!engine || isWhole && !hasAll) {
      engine = await open(module, { files: given });
      hasAll = isWhole;
      running = "";
      asked.clear();
    }
    const said = await answer(question);
    postMessage({ id, said }, said.pixels ? [said.pixels] : []);
  } catch (error) {
    postMessage({ id, error: error.message });
    if (error.status) return; // celspan's own sentence; otherwise the next question gets another engine
    engine = undefined;
  }
};

const keep = ({ path, content }) => {
  given[path] = content;
  engine?.file(path, content);
  running = "";
};

onmessage = ({ data }) => { ready = ready.then(() => data.path ? keep(data) : reply(data)); };
