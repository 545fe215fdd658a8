// The planes of a file, read when they come near: a part of celspan-film.js.
const HEAD = 1 << 16; // bytes that have all of the head of a nest
const NEAR = 40; // pixels of the screen: smaller windows are not shown, and at twice as much wholly
const KEPT = 64; // inner planes in memory, unless more are shown
const AT_ONCE = 4; // planes being read
const AGAIN = 3000; // milliseconds until bytes that did not come are asked for again
const DEEPEST = 16; // planes in each other
const SHOWN = 256; // windows in a picture, so that a small file costs little
const LARGEST_SIDE = 2 ** 31 - 1; // pixels of a plane that is drawn

// The bytes of a file, which are read in parts where its server gives parts.
class Source {
  constructor(src, signal, whole) { Object.assign(this, { src, signal, whole }); }

  // Up to `end`, or the end of the file, whose size is known from then on.
  async read(start, end) {
    if (!this.whole) {
      const part = await this.#fetch({ range: `bytes=${start}-${end - 1}` })
        .catch(fault => { if (this.size) throw fault; }); // else not all servers know ranges
      if (this.size) return part;
      this.whole = part ?? await this.#fetch({});
    }
    this.size = this.whole.length;
    return this.whole.subarray(start, end);
  }

  // null: they are a part of a file whose size is unknown.
  async #fetch(headers) {
    try {
      const answer = await fetch(this.src, { signal: this.signal, headers });
      if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
      const all = /[0-9]+$/.exec(answer.headers.get("content-range") ?? "");
      this.size = answer.status === 206 && all ? Number(all[0]) : 0;
      return answer.status === 206 && !all ? null : new Uint8Array(await answer.arrayBuffer());
    } catch (fault) {
      throw Object.assign(new Error(`${this.src}: this file cannot be loaded: ${fault.message}.`),
        { is_lost: true });
    }
  }
}

// A plane and its windows: { left, upper, right, lower, file }, in parts of its frame. A file is
// { start, end, depth, nest, is_coming, used }, and shown by any number of windows.
class Nest {
  windows = [];

  // Reads the outer plane of those in [start, end) of a source.
  static async open(source, { start, end, depth }) {
    const nest = new Nest();
    let bytes = await source.read(start, Math.min(start + HEAD, end));
    const size = Math.min(end, source.size) - start, table = view_of(bytes);
    const is_nest = bytes.length > 32 && String.fromCharCode(...bytes.slice(0, 8)) === "celnests";
    const [planes, count] = is_nest ? [12, 16].map(at => table.getUint32(at, true)) : [0, 0];
    const head = 24 + 8 * planes + 36 * count;
    const needed = is_nest ? Math.min(size, head + Number(table.getBigUint64(20, true))) : size;
    if (bytes.length < needed) {
      const more = await source.read(start + bytes.length, start + needed);
      bytes = new Uint8Array(await new Blob([bytes, more]).arrayBuffer());
    }
    nest.plane = await Plane.open(bytes.subarray(0, needed), size); // which checks every number
    if (depth > DEEPEST) throw new Error("This picture is damaged: its planes are too deep.");
    if (is_nest) nest.#read_windows(view_of(bytes), { planes, count, at: start + head, depth });
    return nest;
  }

  #read_windows(table, { planes, count, at, depth }) {
    const files = [], first = 20 + 8 * planes;
    for (let i = 0; i < planes; i++) {
      const end = at + Number(table.getBigUint64(20 + 8 * i, true));
      files.push({ start: at, end, depth: depth + 1, nest: null, is_coming: false, used: 0 });
      at = end;
    }
    for (let i = first; i < first + 36 * count; i += 36) {
      const [left, upper, right, lower] = [0, 8, 16, 24].map(by => table.getFloat64(i + by, true));
      this.windows.push({ left, upper, right, lower, file: files[table.getUint32(i + 32, true)] });
    }
  }

  // Adds to `found`, { canvas, clock, near, shown, wanted }, what the canvas shows where it has a
  // place on that, from the rear to the front, and which planes are missing. near: how many windows.
  gather(place, found, window) {
    const { left, upper, right, lower } = place, across = right - left, down = lower - upper;
    if (Math.max(across, down) < LARGEST_SIDE) found.shown.push({ nest: this, place, window });
    for (const one of this.windows) {
      const inner = { left: left + one.left * across, right: left + one.right * across,
                      upper: upper + one.upper * down, lower: upper + one.lower * down };
      const size = Math.min(inner.right - inner.left, inner.lower - inner.upper);
      if (size < NEAR || inner.right < 0 || inner.left > found.canvas.width || inner.lower < 0
        || inner.upper > found.canvas.height) continue;
      if (++found.near > SHOWN) return;
      one.file.used = found.clock;
      if (one.file.nest) one.file.nest.gather({ ...inner, size }, found, one);
      else if (!one.file.is_coming) found.wanted.push({ file: one.file, size });
    }
  }
}

// All planes of a file. changed(): one has come. fail(fault): one is damaged.
class Planes {
  clock = 0; // the number of the latest picture
  coming = 0;
  loaded = new Set(); // files that have come
  layers = new Map(); // by window, of the latest picture, from the rear to the front

  static async open(source) {
    const planes = new Planes();
    planes.source = source;
    planes.outer = await Nest.open(source, { start: 0, end: Infinity, depth: 1 });
    return planes;
  }

  // Draws a frame of the outer plane at a place of the canvas, and what its windows show at a time.
  paint(pencil, place, frame, time) {
    const { canvas } = pencil, shown = [];
    const found = { canvas, clock: ++this.clock, near: 0, shown, wanted: [] };
    this.outer.gather(place, found);
    let first = shown.length;
    while (first > 0 && !this.#covers(shown[first], canvas)) {
      const { nest: { plane }, window } = shown[--first];
      plane.choose(window ? Math.floor(time * plane.rate + 1e-6) % plane.frames : frame);
    }
    this.#show(pencil, shown.slice(first).map(one => layer_of(one, canvas)));
    found.wanted.sort((a, b) => b.size - a.size);
    found.wanted.slice(0, AT_ONCE - this.coming).forEach(({ file }) => this.#load(file));
    this.#forget();
  }

  // Whether nothing behind it is seen.
  #covers(one, canvas) {
    if (!one?.nest.plane.is_opaque) return false;
    const { left, upper, right, lower } = rounded(one.place);
    return left <= 0 && upper <= 0 && right >= canvas.width && lower >= canvas.height;
  }

  // Draws the layers, from the rear to the front, unless the canvas shows them.
  #show(pencil, layers) {
    const before = [...this.layers.values()], { width, height } = pencil.canvas;
    const is_shown = (one, i) => one.window === before[i].window && one.key === before[i].key;
    if (layers.length === before.length && layers.every(is_shown)) return;
    pencil.clearRect(0, 0, width, height);
    layers.forEach((layer, i) => {
      const old = this.layers.get(layer.window), is_same = old?.key === layer.key;
      if (i === 0 && !is_same) layer.plane.paint(pencil, layer.box);
      else this.#draw(pencil, layer, is_same ? old.cut : undefined);
    });
    this.layers = new Map(layers.map(layer => [layer.window, layer]));
  }

  // From a picture of its own, which remains as long as it shows the same.
  #draw(pencil, layer, cut = layer.plane.cut(layer.box, pencil.canvas)) {
    layer.cut = cut;
    if (!cut) return;
    pencil.globalAlpha = layer.alpha;
    pencil.drawImage(cut.picture, cut.x, cut.y);
    pencil.globalAlpha = 1;
  }

  async #load(file) {
    if (file.is_coming) return; // for another window
    file.is_coming = true;
    this.coming++;
    try {
      file.nest = await Nest.open(this.source, file);
      this.loaded.add(file);
    } catch (fault) {
      if (!fault.is_lost) this.fail(fault);
      setTimeout(() => { file.is_coming = false; this.changed(); }, AGAIN);
    }
    this.coming--;
    this.changed();
  }

  // The planes that have not been shown for the longest time.
  #forget() {
    if (this.loaded.size <= KEPT) return;
    const old = [...this.loaded].filter(file => file.used < this.clock);
    old.sort((a, b) => a.used - b.used);
    for (const file of old.slice(0, this.loaded.size - KEPT)) {
      Object.assign(file, { nest: null, is_coming: false });
      this.loaded.delete(file);
    }
  }

  // The most pixels of the page for one of the pyramid, where (x, y), in parts of the frame, is in
  // the middle: a plane is enlarged as far as one alone, unless that around it could not be drawn.
  // Numbers have 53 bits, and a pyramid has 2^24 pixels.
  largest(x, y) {
    let { outer: nest } = this, own = 1, around = 1;
    while (nest) {
      const [at] = nest.windows.filter(one =>
        x >= one.left && x <= one.right && y >= one.upper && y <= one.lower).slice(-1);
      if (!at) return Math.min(LARGEST / own, 64 / around, 2 ** 26);
      const [wide, high] = [at.right - at.left, at.lower - at.upper];
      [x, y, around, nest] = [(x - at.left) / wide, (y - at.upper) / high, own, at.file.nest];
      own *= Math.max(wide, high);
    }
    return 2 ** 26; // nobody knows yet how deep it is
  }
}

const view_of = bytes => new DataView(bytes.buffer, bytes.byteOffset, bytes.length);

// What is drawn of one that is shown: two with equal keys are equal. cut: its picture, once it has
// one; null: all of it is clear.
function layer_of({ nest: { plane }, place, window }, { width, height }) {
  const box = rounded(place), alpha = window ? Math.min(1, place.size / NEAR - 1) : 1;
  const key = [plane.frame, ...Object.values(box), alpha, width, height].join();
  return { window, plane, box, alpha, key, cut: undefined };
}

const rounded = ({ left, upper, right, lower }) => ({
  left: Math.round(left), right: Math.max(Math.round(left) + 1, Math.round(right)),
  upper: Math.round(upper), lower: Math.max(Math.round(upper) + 1, Math.round(lower)) });
