// One picture of a film, for servers, workers and pages:
//
//   const png = await render("return rostrum { back = 'teal' }", { module });
//
// Nothing is read, fetched or kept but an engine of each module that does nothing, because a new one
// costs some milliseconds. What a call draws does not depend on calls before it.
import { open } from "./engine.mjs";

export { open };

const STEPS = 3e8; // two seconds of an endless loop
const MEMORY = 256 << 20; // bytes
const MEMORY_LEAST = 32 << 20;
const KEPT_MOST = 64 << 20; // bytes of an engine that is kept

const idle = new WeakMap(); // from modules to engines

const keep = (module, engine) => {
  engine.close();
  if (engine.memory().all <= KEPT_MOST) idle.set(module, engine);
};

const draw = (engine, source, { frame, size, format, ...options }) => {
  const film = engine.run(source, options);
  const width = size ? size[0] : film.width, height = size ? size[1] : film.height;
  engine.frame(frame ?? film.first);
  return format === "png" ? engine.png(width, height)
    : { width, height, data: engine.pixels(width, height).slice() };
};

/** A frame of a film, as the bytes of a PNG or, with the format "pixels", in RGBA. index.d.ts has the
 * options. An Error has a sentence, and in `missing` the files that were looked for in vain. */
export const render = async (source, options = {}) => {
  const { module, files = {}, format = "png", memory = MEMORY, steps = STEPS, ...rest } = options;
  if (format !== "png" && format !== "pixels")
    throw new Error(`celspan: the format must be "png" or "pixels", got ${format}`);
  if (!(memory >= MEMORY_LEAST))
    throw new Error(`celspan: memory must be ${MEMORY_LEAST} bytes or more, got ${memory}`);
  const engine = idle.get(module) ?? await open(module);
  idle.delete(module);
  try {
    engine.clear();
    for (const [path, content] of Object.entries(files)) engine.file(path, content);
    // The script gets half of it, so that its own limit is reached first.
    const drawn = draw(engine, String(source),
      { ...rest, format, steps, memory: memory / 2, room: memory });
    keep(module, engine);
    return drawn;
  } catch (error) {
    // What ends WebAssembly leaves its memory in no good state: the engine is not used again.
    if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError)
      throw new Error(`celspan: the film has ended the engine: ${error.message}`, { cause: error });
    error.missing = engine.missing();
    keep(module, engine);
    throw error;
  }
};
