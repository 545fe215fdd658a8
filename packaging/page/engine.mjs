// celspan in a page, a worker or node: one instance of the WebAssembly shows one film at a time.
//
//   const engine = await open(module, { files: { "/film.svg": bytes } });
//   const film = engine.run("return rostrum { back = 'teal' }");
//   engine.frame(film.first);
//   const rgba = engine.pixels(640, 360);
//
// What cannot be drawn is an Error with the sentence of celspan; engine.missing() then has the paths
// of files that were looked for in vain: give them with engine.file, and run the script again.

const MISSING = -1, FOLDER = -2, NOT_THERE = -52; // of files.c; ENOSYS
const PAGE = 65536; // bytes of WebAssembly's memory
const SIDE_MOST = 16384; // pixels: four bytes each are at most half of the memory
const FRAME_MOST = 2 ** 20; // pixels of the side of a frame of which a part is drawn
const LIMIT_MOST = 2 ** 53;
// celspan_parameter_kind
const KINDS = ["text", "file", "number", "boolean", "choice", "colour", "point", "ease"];
const MEMORY_MOST = 2 ** 31 - PAGE;
const CACHED_MOST = 2 ** 28, CACHED_SHARE = 4; // of the memory, for each of two caches
const PNG = "/dev/png"; // of picture.c, which looks for it, but is not to find it
const EXPORTS = ["memory", "open", "set", "run", "frame", "pixels", "png"];

const encoder = new TextEncoder(), decoder = new TextDecoder();

/** "a/./b", "/a//b" -> "/a/b" */
const clean = (path) => "/" + path.split("/").reduce((way, part) =>
  part === ".." ? way.slice(0, -1) : part && part !== "." ? [...way, part] : way, []).join("/");

/** The bytes of a buffer or a view of one; undefined: it is neither. */
const bytes_of = (given) =>
  ArrayBuffer.isView(given) ? new Uint8Array(given.buffer, given.byteOffset, given.byteLength)
    : given instanceof ArrayBuffer ? new Uint8Array(given) : undefined;

/** The files of a page, and what was looked for in vain. */
class Files {
  constructor() {
    this.numbers = new Map();
    this.bytes = [];
    this.missed = new Set();
  }

  put(path, content) {
    const bytes = typeof content === "string" ? encoder.encode(content) : bytes_of(content);
    if (!bytes)
      throw new Error(`celspan: ${path}: a file is a text or bytes, got ${typeof content}`);
    this.numbers.set(clean(path), this.bytes.length);
    this.bytes.push(bytes);
    this.missed.delete(clean(path));
  }

  clear() {
    this.numbers.clear();
    this.bytes.length = 0;
    this.missed.clear();
  }

  find(path) {
    const name = clean(path), folder = name + "/";
    if (name === "/") return FOLDER;
    if (this.numbers.has(name)) return this.numbers.get(name);
    for (const other of this.numbers.keys()) if (other.startsWith(folder)) return FOLDER;
    if (name !== PNG) this.missed.add(name);
    return MISSING;
  }
}

/** What the WebAssembly asks of JavaScript. `of()` has its exports, when there are some; `most()` is
 * the most memory that it may have; written: what engine.write returns, and its beat. */
const imports = (module, of, memory, files, now, most, written) => {
  const jump = {}; // what longjmp throws
  let high = 0; // the upper half of a result with 64 bits
  const time = (at, unit) => {
    const milliseconds = now(), seconds = Math.floor(milliseconds / 1e3);
    const view = new DataView(of().memory.buffer);
    view.setInt32(at, seconds, true);
    view.setInt32(at + 4, (milliseconds - seconds * 1e3) * unit, true);
    return 0;
  };
  const grow = (size) => {
    if (size > most()) return 0;
    try {
      of().memory.grow(Math.ceil((size - of().memory.buffer.byteLength) / PAGE));
      return 1;
    } catch { return 0; }
  };
  const invoke = (index, ...values) => {
    const stack = of().stackSave();
    try { return of().__indirect_function_table.get(index)(...values); } catch (error) {
      if (error !== jump) throw error;
      of().stackRestore(stack);
      of().setThrew(1, 0);
    }
  };
  const stop = (what) => () => { throw new WebAssembly.RuntimeError(what); };
  const page = {
    find: (path) => files.find(memory.text(path)),
    size: (file) => files.bytes[file].length,
    read: (file, at, to, size) => memory.bytes().set(files.bytes[file].subarray(at, at + size), to),
    beat: (share) => written.beat(share), note: (at) => written.notes.push(memory.text(at)),
    save: (at, size) => { written.bytes = memory.bytes().slice(at, at + size); },
  };
  const env = {
    _emscripten_throw_longjmp: () => { throw jump; },
    getTempRet0: () => high, setTempRet0: (value) => { high = value; },
    clock: () => now() * 1e3, time: () => Math.floor(now() / 1e3),
    clock_gettime: (clock, at) => time(at, 1e6), __clock_gettime: (clock, at) => time(at, 1e6),
    gettimeofday: (at) => time(at, 1e3),
    emscripten_get_heap_max: most, emscripten_resize_heap: grow,
    abort: stop("abort"), exit: stop("exit"),
  };
  const none = { environ_sizes_get: (count, size) => (memory.put(count, 0), memory.put(size, 0)),
                 environ_get: () => 0 };
  const given = (from, name) => from === "page" ? page[name] : none[name] ?? env[name] ??
    (name.startsWith("invoke_") ? invoke : () => NOT_THERE);
  const all = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    (all[from] ??= {})[name] = given(from, name);
  return all;
};

/** A module of celspan.wasm: compiled, or the bytes of the file. */
const module_of = async (given) => {
  const bytes = bytes_of(given);
  let module = given, names;
  try {
    if (bytes) module = await WebAssembly.compile(bytes);
    names = WebAssembly.Module.exports(module).map(({ name }) => name);
  } catch (error) {
    throw new Error(bytes
      ? `celspan: celspan.wasm is damaged, or may not be compiled here: ${error.message}`
      : "celspan: the module must be the compiled celspan.wasm, or its bytes", { cause: error });
  }
  const lacks = EXPORTS.find((name) => !names.includes(name));
  if (lacks)
    throw new Error(`celspan: the module is no celspan.wasm of this version: it has no ${lacks}`);
  return module;
};

/** An engine. given: celspan.wasm, compiled or as bytes. files: contents by path: texts or bytes.
 * now: the clock in milliseconds, which decides nothing that is drawn. */
export const open = async (given, { files = {}, now = () => performance.now() } = {}) => {
  const module = await module_of(given);
  let x; // the exports
  let room_most = MEMORY_MOST;
  const table = new Files();
  const memory = {
    bytes: () => new Uint8Array(x.memory.buffer),
    text: (at) => decoder.decode(memory.bytes().subarray(at, memory.bytes().indexOf(0, at))),
    put: (at, value) => (new DataView(x.memory.buffer).setInt32(at, value, true), 0),
  };
  const written = {};
  const given_to = imports(module, () => x, memory, table, now, () => room_most, written);
  x = (await WebAssembly.instantiate(module, given_to)).exports;
  x.__wasm_call_ctors();

  const room = (size) => {
    const at = x.malloc(size);
    if (!at) throw new Error(`celspan: there is no memory for ${size} bytes`);
    return at;
  };
  /** Calls use(address, size, ...) with texts that end with a zero, and frees them. */
  const lend = (texts, use) => {
    const at = [];
    try {
      const all = texts.flatMap((text) => {
        const bytes = encoder.encode(text);
        at.push(room(bytes.length + 1));
        memory.bytes().set(bytes, at.at(-1));
        memory.bytes()[at.at(-1) + bytes.length] = 0;
        return [at.at(-1), bytes.length];
      });
      return use(...all);
    } finally { at.forEach((address) => x.free(address)); }
  };
  let page = 0;
  const check = (status) => {
    if (!status) return;
    throw Object.assign(new Error(memory.text(x.error(page))), { status });
  };
  const expectRun = () => {
    if (!page) throw new Error("celspan: there is no film: run a script first");
  };
  const expectWhole = (name, value, most) => {
    if (Number.isInteger(value) && value >= 1 && value <= most) return;
    throw new Error(`celspan: ${name} must be a whole number from 1 to ${most}, got ${value}`);
  };
  let isBuilt = false; // a frame
  const expectFrame = () => {
    expectRun();
    if (!isBuilt) throw new Error("celspan: there is no frame: build one with engine.frame");
  };
  const expectSize = (width, height, most = SIDE_MOST) => {
    expectFrame();
    expectWhole("width", width, most);
    expectWhole("height", height, most);
  };
  /** Calls use(address) with room for some bytes, and frees it. */
  const with_room = (size, use) => {
    const at = room(size);
    try { return use(at); } finally { x.free(at); }
  };
  let rgba = 0, rgba_size = 0;
  const pixels = (width, height, [left, top, w, h] = [0, 0, width, height],
    isVideo = false) => {
    expectSize(width, height, w === width && h === height ? SIDE_MOST : FRAME_MOST);
    expectWhole("the width of the part", w, SIDE_MOST);
    expectWhole("the height of the part", h, SIDE_MOST);
    const size = w * h * 4;
    if (size > rgba_size) {
      x.free(rgba);
      rgba = rgba_size = 0; // the next line may fail
      rgba = room(size);
      rgba_size = size;
    }
    x.coding(page, isVideo);
    check(x.pixels(page, width, height, left, top, w, h, rgba));
    return new Uint8ClampedArray(x.memory.buffer, rgba, size);
  };

  // Numbers and texts of page.c, by their places there.
  const fact = (which) => x.fact(page, which), text = (which) => memory.text(x.text(page, which));
  const list = (count, of) => Array.from({ length: count }, (_, place) => of(place));
  const doubles = (at, count) => list(count, (i) =>
    new DataView(x.memory.buffer).getFloat64(at + 8 * i, true));
  const parameter = (place) => {
    check(x.parameter(page, place));
    return { name: text(0), kind: KINDS[fact(1)], value: text(1), about: text(2), least: fact(2),
      most: fact(3), choices: list(fact(4), (choice) => text(5 + choice)) };
  };
  const passage = (place) => {
    const [begin, end, fadeIn, fadeOut] = doubles(x.passage(page, place), 4);
    return { begin, end, fadeIn, fadeOut };
  };
  const ducker = (place) => {
    const at = x.ducker(page, place), [gain, attack, release] = doubles(at + 8, 3);
    return { sound: new DataView(x.memory.buffer).getUint32(at, true), gain, attack, release };
  };
  const sound = (place) => {
    check(x.sound(page, place));
    return { path: text(3), start: fact(6), speed: fact(7), gain: [fact(8), fact(9)],
      passages: list(fact(10), passage), duckers: list(fact(11), ducker) };
  };

  const engine = {
    /** Adds a file, or replaces it. */
    file: (path, content) => table.put(path, content),
    /** Removes all files. */
    clear: () => table.clear(),
    /** The paths that were looked for in vain, once. */
    missing: () => {
      const all = [...table.missed];
      table.missed.clear();
      return all;
    },
    /** What the script has printed. */
    printed: () => page ? memory.text(x.printed(page)) : "",
    /** Runs a script, and returns its film. name: its path, as messages call it. set: values of
     * parameters, by name. steps, memory: limits of a run and of a frame (docs/c.md). room: the most
     * bytes of the WebAssembly. */
    run(script, { name = "film.lua", set = {}, steps = 0, memory: most = 0,
                  room: bytes = MEMORY_MOST } = {}) {
      engine.close();
      if (!(steps >= 0 && steps <= LIMIT_MOST && most >= 0 && most <= LIMIT_MOST && bytes > 0))
        throw new Error(`celspan: steps and memory must be from 0 to 2^53, and room above 0, got ${
          steps}, ${most} and ${bytes}`);
      room_most = Math.min(bytes, MEMORY_MOST);
      page = x.open(steps, Math.min(most, MEMORY_MOST),
        Math.min(room_most / CACHED_SHARE, CACHED_MOST));
      if (!page) throw new Error("celspan: there is no memory for a film");
      for (const [key, value] of Object.entries(set))
        lend([key, String(value)], (a, _, b) => check(x.set(page, a, b)));
      lend([name, script], (a, _, b, size) => check(x.run(page, a, b, size)));
      return engine.film();
    },
    /** The film: its size, its first frame, how many it has, and how many a second. */
    film: () => (expectRun(), { width: x.number(page, 0), height: x.number(page, 1), first: x.number(page, 2),
                   count: x.number(page, 3), fps: x.number(page, 4) }),
    /** The version of celspan, such as "0.1.0". */
    version: () => (expectRun(), text(4)),
    /** What celspan.parameters of the script declares, by name; value: the default, as `set` of run
     * takes it. */
    parameters: () => (expectRun(), list(fact(0), parameter)),
    /** The sounds of the film, of which celspan_sound says more. */
    sounds: () => (expectRun(), check(x.sounds(page)), list(fact(5), sound)),
    /** The bytes of a file; undefined: there is none. */
    content: (path) => table.bytes[table.find(path)],
    /** Builds a frame, by its number. */
    frame(number) {
      expectRun();
      if (!Number.isSafeInteger(number))
        throw new Error(`celspan: a frame is a whole number, got ${number}`);
      isBuilt = false;
      check(x.frame(page, number));
      isBuilt = true;
    },
    /** Leaves in the frame only what a line made, or what it called made: "film.lua:7". Returns
     * whether there is any. */
    keep(place) {
      expectFrame();
      lend([place], (at) => check(x.keep(page, at)));
      return x.number(page, 7) === 1;
    },
    /** Where the objects at a point of the film were made: "film.lua:7 in walk, from film.lua:12", from
     * the front. */
    at(left, top) {
      expectFrame();
      const text = x.at(page, left, top);
      if (!text) throw new Error(memory.text(x.error(page)));
      return memory.text(text).split("\n").slice(0, -1);
    },
    /** The frame in RGBA, 8 bits, straight alpha; valid until the next call. part: [left, top, width,
     * height] in it; without it the whole. isVideo: over black and dithered, as the program gives
     * frames to encoders. */
    pixels,
    /** The frame as a PNG: the bytes of the file that `celspan render` writes. */
    png(width, height) {
      expectSize(width, height);
      return with_room(8, (at) => {
        check(x.png(page, width, height, at));
        const [address, size] = new Uint32Array(x.memory.buffer, at, 2);
        return memory.bytes().slice(address, address + size);
      });
    },
    /** The file that `celspan render -o film.KIND` writes, where the module is celspan-whole.wasm:
     * "svg", of the frame; "json" (Lottie) or "plane", of the film. Returns its bytes and, in `notes`,
     * sentences on what it could not keep. beat: gets the share that is done. */
    write(kind, width, height, beat = () => {}) {
      expectSize(width, height);
      if (!x.write) throw new Error("celspan: the module is celspan.wasm, which has no writers");
      Object.assign(written, { beat, notes: [] });
      lend([`film.${kind}`], (path) => check(x.write(page, path, width, height)));
      return { bytes: written.bytes, notes: written.notes };
    },
    /** The digest of the frame, as `celspan render --hash` prints it. */
    digest(width, height) {
      expectSize(width, height);
      return with_room(16, (at) => {
        check(x.digest(page, width, height, at));
        const view = new DataView(x.memory.buffer);
        return [4, 0, 12, 8].map((place) =>
          view.getUint32(at + place, true).toString(16).padStart(8, "0")).join("");
      });
    },
    /** The bytes that celspan holds, the most that it held, and the memory of the WebAssembly. */
    memory: () => ({ held: page ? x.number(page, 5) : 0, most: page ? x.number(page, 6) : 0,
                     all: x.memory.buffer.byteLength }),
    /** Releases the film. */
    close() {
      if (page) x.close(page);
      page = 0;
      isBuilt = false;
    },
  };
  for (const [path, content] of Object.entries(files)) engine.file(path, content);
  return engine;
};
