// Films that a worker draws.
//
//   const one = film("return rostrum { back = 'teal' }", { name: "film.lua" });
//   const { pixels, size, film: { first, count, fps, width, height, frame } }
//     = await one.draw({ frame: 1, box: [640, 360], view: { scale: 2, x: 0.5, y: 0.5 }, line: 1 });
//   const { places } = await one.at({ frame: 1, x: 320, y: 180 });   "film.lua:1", from the front
//
// box: the most pixels. view: a part of the film, from x, y, which are shares of its sides; without
// it the whole. line: only what this line made, if it made anything.
//
// What cannot be drawn is an Error with a sentence; its `line` is that of the script, or 0. A worker
// that takes too long is ended, and the next question begins another one. Nothing is loaded before
// the first question.
const SECONDS = 8; // for one picture
export const WHOLE = "celspan-whole.wasm"; // the engine that has what the first one lacks
// What the first one lacks: as scripts ask for it, mostly, and as its messages say.
const WANTS = /celspan\.(ink|layers|oca|relight|trace|track)|\.(jpe?g|kra|ora|plane|png|psd)["']/;
const LACKS = /this celspan has no (?!celspan\.render)/;
const NO_ENGINE = "This browser has no WebAssembly, or the page forbids it: the picture stays still.";

let worker, last = 0;
let isWhole = false; // the engine that is asked: from the first question on that needs it
const modules = {}; // promises, by the names of their files
const waiting = new Map(); // the questions without an answer, by their numbers
const files = new Map(); // contents that readers gave, by path

const compiled = async (name) => {
  if (typeof WebAssembly !== "object") throw new Error(NO_ENGINE);
  const answer = await fetch(new URL(name, import.meta.url)).catch(({ message }) =>
    ({ status: message }));
  if (!answer.ok) throw new Error(`The engine could not be loaded: ${answer.status}.`);
  const bytes = await answer.arrayBuffer();
  try { return await WebAssembly.compile(bytes); } catch { throw new Error(NO_ENGINE); }
};

const settle = (id, how, value) => {
  const one = waiting.get(id);
  clearTimeout(one?.timer);
  waiting.delete(id);
  one?.[how](value);
};

/** Ends the worker: what it works at fails, and what waits is asked of the next one. */
const replace = (id, message) => {
  worker.terminate();
  worker = null;
  settle(id, "reject", new Error(message));
  for (const one of waiting.values()) send(one.question);
};

const hear = ({ data: { id, isBegun, share, said, error } }) => {
  const one = waiting.get(id);
  if (!one) return;
  if (isBegun) {
    one.progress?.(share ?? 0);
    clearTimeout(one.timer);
    one.timer = setTimeout(() => replace(id,
      `The script was ended, because its picture took longer than ${SECONDS} seconds.`),
    SECONDS * 1000);
  } else if (error === undefined) settle(id, "resolve", said);
  else settle(id, "reject", new Error(error));
};

const begin = () => {
  const one = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
  one.onmessage = hear;
  one.onerror = () => {
    one.terminate();
    worker = null;
    for (const id of waiting.keys()) settle(id, "reject", new Error("The engine could not be started."));
  };
  for (const [path, content] of files) one.postMessage({ path, content });
  return one;
};

const send = (question) => {
  worker ??= begin();
  worker.postMessage(question);
};

/** The compiled engine of a file, which is loaded once. */
export const prepare = (name) =>
  modules[name] ??= compiled(name).catch((error) => { delete modules[name]; throw error; });

const ask = async (question, progress) => {
  const isAll = isWhole || question.call === "write" || WANTS.test(question.source);
  const loading = prepare(isAll ? WHOLE : "celspan.wasm");
  worker ??= begin(); // is loaded while the engine is compiled
  const complete = { id: ++last, module: await loading, isWhole: isAll, ...question };
  isWhole ||= isAll;
  try {
    return await new Promise((resolve, reject) => {
      waiting.set(complete.id, { question: complete, resolve, reject, progress });
      send(complete);
    });
  } catch (error) {
    if (isAll || !LACKS.test(error.message)) throw error;
    await prepare(WHOLE);
    isWhole = true;
    return ask(question, progress);
  }
};

/** Adds the line that a message names. */
const placed = (error, name) => {
  const at = error.message.indexOf(`${name}:`), rest = error.message.slice(at + name.length + 1);
  const [, line, message] = at < 0 ? [] : rest.match(/^(\d+): ([^]*)$/) ?? [];
  return Object.assign(error, { line: Number(line ?? 0), sentence: message ?? error.message });
};

/** Gives scripts a file, which may replace one. */
export const give = (path, content) => {
  files.set(path, content);
  worker?.postMessage({ path, content });
};

/** Ends the worker, and with it a call; what else waits is asked of the next worker. */
export const stop = (call, message) => {
  const [id] = [...waiting].find(([, { question }]) => question.call === call) ?? [];
  if (id && worker) replace(id, message);
};

export const film = (source, { name = "film.lua", set = {} } = {}) => {
  const put = (call) => async (question, progress) => {
    try { return await ask({ call, source, name, set, ...question }, progress); } catch (error) {
      throw placed(error, name);
    }
  };
  return Object.fromEntries(["draw", "at", "about", "digest", "sounds", "save", "write"]
    .map((call) => [call, put(call)]));
};
