// celspan-film @VERSION@: an element that shows plane files, still or moving, sharp at every size.
//
//   <celspan-film src="moon.plane" controls></celspan-film>
//
// It is an ES module without exports, and a classic script. Pages contain it, so no tag of a script
// may be in it. The decoder, as WebAssembly, is compiled once for all films of a page, and each film
// has an instance with a memory of its own, so that a damaged file harms no other. The viewer
// (show_tiles) draws a still in tiles, from a pyramid whose deepest level has 2^24 pixels across or
// down, and a frame of a film as a whole. Nothing here needs more than the policy
//
//   script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src 'self'
//
// INVARIANT  `#life` belongs to the file that is shown or loaded; when it is aborted, nothing that
// was begun for that file has an effect any more.
(() => {
"use strict";
@VIEWER@
@DECODER@
@NEST@
// Tasks that are done one after the other, between two frames of the page: sooner than timers.
const due = [], messages = globalThis.document && new MessageChannel();
function soon(task) {
  messages.port1.onmessage = () => due.shift()();
  due.push(task);
  messages.port2.postMessage(null);
}

// A file, or an element of the page that contains it in base64: #its-id.
function source_of(film, src, signal) {
  if (!src.startsWith("#")) return new Source(src, signal);
  const part = film.getRootNode().getElementById(src.slice(1));
  if (!part) throw new Error(`${src}: the page has no such element.`);
  return new Source(src, signal, bytes_of(part.textContent));
}

// ------------------------------------------------------------ the look

const STYLE = `
  :host { display: inline-block; position: relative; max-width: 100%; vertical-align: bottom;
          font: 14px/1.5 system-ui, sans-serif; color: #f4ead8; }
  :host([hidden]) { display: none; }
  [hidden] { display: none !important; }
  #box, #view { position: absolute; inset: 0; }
  #box { container-type: inline-size; }
  #view { width: 100%; height: 100%; cursor: grab; }
  #view:active { cursor: grabbing; }
  #view:focus { outline: none; }
  #view:focus-visible { outline: 3px solid rgba(232, 140, 90, .9); outline-offset: -3px; }
  img, ::slotted(img) { display: block; max-width: 100%; height: auto; }
  :host([width]) img, :host([width]) ::slotted(img) { width: 100%; }
  #bar { position: absolute; left: 8px; right: 8px; bottom: 8px; display: flex; align-items: center;
         font-variant-numeric: tabular-nums; pointer-events: none; }
  #bar > * { display: flex; align-items: center; gap: 4px; padding: 2px 4px; border-radius: 4px;
             background: rgba(20, 16, 30, .72); pointer-events: auto; }
  #film { flex: 1; min-width: 0; margin-right: 8px; }
  #zoom { margin-left: auto; }
  @container (max-width: 280px) { #film:not([hidden]) + #zoom { display: none; } }
  #number { padding: 0 6px; white-space: nowrap; }
  input { flex: 1; min-width: 0; margin: 0; accent-color: #e88c5a; }
  button { font: inherit; font-size: 18px; line-height: 32px; width: 32px; height: 32px; padding: 0;
           color: inherit; background: none; border: 0; border-radius: 4px; cursor: pointer; }
  button:hover, button:focus-visible { background: rgba(190, 90, 60, .9); outline: none; }
  #fault { margin: 0; padding: 8px 12px; border-radius: 4px; background: #14101e; }
  #fault:empty { display: none; }
  #keys { display: none; }`;

const look = globalThis.document && new CSSStyleSheet();
look?.replaceSync(STYLE);

// An element with attributes and children, without text that is parsed: a policy may refuse that.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}
const button = (id, name, key, sign) =>
  make("button", { id, type: "button", "aria-label": name, title: `${name} (${key})` }, sign);

// The shadow of an element: a box for the picture, and what is seen until there is one.
function make_parts() {
  const box = make("div", { id: "box" },
    make("canvas", { id: "view", part: "view", tabindex: 0, role: "application",
                     "aria-describedby": "keys" }),
    make("div", { id: "bar", part: "controls" },
      make("div", { id: "film" }, button("play", "Play", "space", "\u25b6"),
        make("input", { id: "frame", type: "range", min: 1, value: 1, "aria-label": "Frame" }),
        make("span", { id: "number" })),
      make("div", { id: "zoom" }, button("in", "Zoom in", "+", "+"),
        button("out", "Zoom out", "-", "\u2212"), button("all", "Show everything", "0", "\u2922"))),
    make("p", { id: "keys" }, "Arrow keys move, plus and minus zoom, 0 shows everything. Of a "
      + "film, the space bar plays, comma and full stop show the frame before and the next one."));
  box.hidden = true;
  return [box, make("img", { id: "poster", part: "poster", alt: "" }), make("slot", { id: "slot" }),
          make("p", { id: "fault", part: "error", role: "alert" })];
}

// ------------------------------------------------------------ the element

const calm = globalThis.matchMedia?.("(prefers-reduced-motion: reduce)");

class CelspanFilm extends (globalThis.HTMLElement ?? class {}) {
  static observedAttributes = ["src", "width", "controls", "poster", "aria-label"];

  #root; #size;
  #life = null;       // of the file that is shown or loaded
  #planes = null;     // null: they are not there yet, or cannot be shown
  #plane = null;      // the outer one
  #viewer = null;
  #pyramid = null;
  #is_drawn = false;  // whether there is a picture
  #coming = 0;        // tiles
  #shown = 0;         // the frame, from 0
  #told = null;       // the frame of the latest event
  #told_view = "";
  #is_paused = true;
  #time = 0;          // in seconds: of windows, which play on where the film begins again
  #started = null;    // when that was 0, once it plays
  #tick = 0;          // the call in which it plays on
  #wish = {};         // what was asked for before the file was there: { time, view }
  #is_seen = true;    // not scrolled away

  constructor() {
    super();
    this.#root = this.attachShadow({ mode: "open", delegatesFocus: true });
    this.#size = new CSSStyleSheet();
    this.#root.adoptedStyleSheets = [look, this.#size];
    new IntersectionObserver(entries => {
      this.#is_seen = entries.at(-1).isIntersecting;
      this.#viewer?.ask();
    }).observe(this);
  }

  connectedCallback() {
    Object.keys(CelspanFilm.prototype).forEach(name => this.#take_early(name));
    if (!this.hasAttribute("role")) this.setAttribute("role", "group");
    if (!this.#life) this.#load();
    this.#take_early("currentTime"); // for the file that is loaded
  }

  // An element that only moves to another place of the page continues.
  disconnectedCallback() {
    queueMicrotask(() => { if (!this.isConnected) this.#close(); });
  }

  attributeChangedCallback(name, before, value) {
    if (!this.#life || before === value) return;
    if (name !== "src") return this.#apply_attributes();
    this.#close();
    this.#load();
  }

  // A property that was set before this script defined it.
  #take_early(name) {
    if (!Object.hasOwn(this, name)) return;
    const value = this[name];
    delete this[name];
    this[name] = value;
  }

  // ---- the file

  #part(id) { return this.#root.getElementById(id); }

  #close() {
    this.pause();
    this.#life?.abort();
    this.#life = this.#planes = this.#plane = this.#viewer = this.#told = null;
    [this.#is_drawn, this.#coming, this.#shown, this.#time, this.#wish] = [false, 0, 0, 0, {}];
  }

  async #load() {
    const life = this.#life = new AbortController(), src = this.getAttribute("src");
    this.#root.replaceChildren(...make_parts());
    this.#apply_attributes();
    if (!src) return;
    try {
      const planes = await Planes.open(source_of(this, src, life.signal));
      if (!life.signal.aborted) this.#show(planes, life.signal);
    } catch (fault) {
      if (!life.signal.aborted) this.#fail(fault);
    }
  }

  // Says what is wrong, in the place of the picture.
  #fail(fault) {
    this.pause();
    this.#life.abort();
    this.#planes = this.#plane = this.#viewer = null;
    this.#is_drawn = false;
    this.#part("box").hidden = true;
    this.#part("fault").textContent = fault.message;
    this.#apply_attributes();
    this.dispatchEvent(new ErrorEvent("error", { message: fault.message, error: fault }));
  }

  #apply_attributes() {
    const plane = this.#plane, poster = this.getAttribute("poster"), label = this.#label();
    const width = this.width || plane?.width;
    const shape = plane ? `aspect-ratio: ${plane.width} / ${plane.height};` : "";
    this.#size.replaceSync(width ? `:host { width: ${width}px; ${shape} }` : "");
    this.#part("view").setAttribute("aria-label", label);
    this.#part("bar").hidden = !this.controls;
    this.#part("poster").hidden = this.#is_drawn || !poster;
    this.#part("slot").hidden = this.#is_drawn || Boolean(poster);
    if (!poster || this.#part("poster").getAttribute("src") === poster) return;
    this.#part("poster").src = poster;
    this.#part("poster").alt = label;
  }

  #label() {
    const name = this.src.replace(/[?#].*|.*\//g, "");
    return this.getAttribute("aria-label") || this.title || name || "Film";
  }

  // ---- what is shown

  get #is_film() { return this.#plane?.frames > 1 || this.#planes?.outer.windows.length > 0; }

  #show(planes, signal) {
    const { plane } = planes.outer;
    const long = Math.max(plane.width, plane.height);
    const side = length => Math.max(1, Math.round(length / long * 2 ** TOP));
    this.#planes = Object.assign(planes, { changed: () => this.#viewer?.hold(),
      fail: fault => { if (!signal.aborted) this.#fail(fault); } });
    this.#plane = plane;
    this.#pyramid = { width: side(plane.width), height: side(plane.height), tile: TILE, overlap: 0,
                      tiles: [[LOWEST]] };
    this.#part("box").hidden = false;
    this.#part("film").hidden = !this.#is_film;
    this.#part("frame").max = plane.frames;
    this.#part("frame").hidden = this.#part("number").hidden = plane.frames === 1;
    this.#apply_attributes();
    this.#viewer = show_tiles(this.#part("view"), this.#pyramid, {
      load: (...tile) => this.#load_tile(signal, ...tile), is_made: () => true,
      paint: this.#is_film ? (...place) => this.#paint(...place) : null,
      largest: (x, y) => planes.largest(x / this.#pyramid.width, y / this.#pyramid.height),
      moved: () => this.#tell(), settled: () => {}, signal, keys: this.#part("box"),
      turns: event => !this.#is_film || event.ctrlKey || this.#root.activeElement !== null });
    this.#listen();
    this.#follow_wishes();
  }

  #load_tile(signal, level, column, row, done) {
    this.#coming++;
    soon(() => this.#draw(signal, () => {
      done(this.#plane.tile(this.#pyramid, level, column, row)); // which may want more
      return --this.#coming === 0;
    }));
  }

  #paint(pencil, x, y, scale) {
    this.#draw(this.#life.signal, () => {
      const { width, height } = this.#pyramid;
      const place = { left: x, upper: y, right: x + width * scale, lower: y + height * scale };
      this.#planes.paint(pencil, place, this.#shown, this.#time);
      return true;
    });
  }

  // step: returns whether the window is filled.
  #draw(signal, step) {
    if (signal.aborted) return;
    try {
      if (step()) this.#is_drawn = true;
    } catch (fault) { this.#fail(fault); }
  }

  // After everything has been drawn that is there: the events.
  #tell() {
    if (!this.#is_drawn) return;
    const is_first = this.#told === null, view = this.view, text = JSON.stringify(view);
    if (is_first) this.#apply_attributes();
    // A finger on the whole picture of a film moves the page.
    const is_page = this.#is_film && view.factor < 1.001;
    this.#part("view").style.touchAction = is_page ? "pan-x pan-y" : "none";
    if (is_first) this.#send("loadeddata");
    else if (this.#told !== this.#shown) this.#send("timeupdate");
    this.#told = this.#shown;
    if (!is_first && text !== this.#told_view) this.#send("viewchange");
    this.#told_view = text;
  }

  #send(name) { this.dispatchEvent(new Event(name)); }

  #follow_wishes() {
    const { time, view } = this.#wish;
    if (view) this.zoom(...view, "instant");
    this.currentTime = time ?? 0;
    if (!this.#is_film) this.pause();
    else if (this.autoplay && !calm.matches) this.play();
    this.#start();
  }

  // ---- time

  play() {
    if (!this.#is_paused || this.#life?.signal.aborted || this.#plane && !this.#is_film) return;
    this.#is_paused = false;
    this.#start();
    this.#send("play");
  }

  pause() {
    if (this.#is_paused) return;
    this.#is_paused = true;
    this.#start();
    this.#send("pause");
  }

  // Plays on from the frame that is shown, unless it is paused.
  #start() {
    cancelAnimationFrame(this.#tick);
    if (!this.#plane) return;
    this.#part("play").textContent = this.#is_paused ? "\u25b6" : "\u23f8";
    this.#part("play").setAttribute("aria-label", this.#is_paused ? "Play" : "Pause");
    if (this.#is_paused) return;
    const { frames } = this.#plane;
    if (frames > 1 && this.#shown === frames - 1) this.#choose(0);
    this.#started = null;
    this.#tick = requestAnimationFrame(now => this.#play_on(now));
  }

  #play_on(now) {
    const { frames, rate } = this.#plane;
    this.#started ??= now - this.#time * 1000;
    const time = (now - this.#started) / 1000, frame = Math.floor(time * rate + 1e-6);
    if (frame >= frames && !this.loop) {
      this.#choose(frames - 1, this.#is_seen);
      this.pause();
      this.#send("ended");
      return;
    }
    this.#choose(frame % frames, this.#is_seen, time);
    this.#tick = requestAnimationFrame(later => this.#play_on(later));
  }

  // Shows a frame; where it is not seen it is not drawn. Windows show 24 frames a second, at least.
  #choose(frame, is_seen = true, time = frame / (this.#plane.rate || 1)) {
    const is_over = this.#planes.outer.windows.length > 0
      && Math.floor(time * 24) !== Math.floor(this.#time * 24);
    this.#time = time;
    this.#part("frame").value = frame + 1;
    this.#part("frame").setAttribute("aria-valuetext", `${frame + 1} of ${this.#plane.frames}`);
    this.#part("number").textContent = `${frame + 1} / ${this.#plane.frames}`;
    if (frame === this.#shown && !is_over) return;
    this.#shown = frame;
    if (is_seen) this.#viewer.ask();
  }

  // Shows a frame, and stops there.
  #stop_at(frame) {
    const { frames } = this.#plane;
    this.pause();
    this.#choose((frame % frames + frames) % frames);
  }

  #listen() {
    const toggle = () => (this.#is_paused ? this.play() : this.pause());
    const keys = { " ": toggle, ",": () => this.#stop_at(this.#shown - 1),
                   ".": () => this.#stop_at(this.#shown + 1) };
    this.#part("play").onclick = toggle;
    this.#part("frame").oninput = () => this.#stop_at(this.#part("frame").value - 1);
    this.#part("in").onclick = () => this.#viewer.zoom(2);
    this.#part("out").onclick = () => this.#viewer.zoom(0.5);
    this.#part("all").onclick = () => this.#viewer.everything();
    this.#part("box").addEventListener("keydown", event => {
      const is_press = event.key === " " && event.target.tagName === "BUTTON";
      if (event.ctrlKey || event.altKey || event.metaKey || !keys[event.key] || is_press) return;
      if (!this.#is_film) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  // ---- properties

  get #unit() { return this.#plane.width / this.#pyramid.width; } // units of the film in a pixel

  get paused() { return this.#is_paused; }
  get duration() {
    if (!this.#plane) return NaN;
    return this.#is_film ? this.#plane.frames / this.#plane.rate : 0;
  }

  get currentTime() {
    if (!this.#plane) return this.#wish.time ?? 0;
    return this.#plane.frames > 1 ? this.#shown / this.#plane.rate : 0;
  }
  set currentTime(seconds) {
    const time = Number(seconds);
    if (!Number.isFinite(time)) throw new TypeError(`currentTime: ${seconds} is not a time`);
    if (!this.#plane) this.#wish.time = time;
    if (!this.#is_film) return;
    const frame = Math.floor(time * this.#plane.rate + 1e-6);
    this.#choose(Math.max(0, Math.min(this.#plane.frames - 1, frame)));
    if (!this.#is_paused) this.#start();
  }

  // Where the middle of the window is and how much of the film it shows, in units of the film, and
  // how much larger that is than when everything is shown. null: nothing is shown yet.
  get view() {
    if (!this.#viewer) return null;
    const { x, y, width, whole } = this.#viewer.tell(), unit = this.#unit;
    return { x: x * unit, y: y * unit, width: width * unit, factor: whole / width };
  }

  zoom(x, y, factor, behavior = "smooth") {
    if (![x, y, factor].every(Number.isFinite) || factor <= 0)
      throw new TypeError(`zoom: ${x}, ${y}, ${factor} is not a place and a factor above 0`);
    if (!this.#viewer) return void (this.#wish.view = [x, y, factor]);
    const { whole } = this.#viewer.tell(), unit = this.#unit;
    this.#viewer.go(x / unit, y / unit, whole / factor, behavior === "instant");
  }
}

// Properties that are attributes, too. There is no sound, so `muted` changes nothing.
function reflect(name, get, set) {
  Object.defineProperty(CelspanFilm.prototype, name, { enumerable: true, configurable: true,
    get() { return get(this); }, set(value) { set(this, value); } });
}
for (const name of ["autoplay", "controls", "loop", "muted"])
  reflect(name, film => film.hasAttribute(name),
    (film, is_on) => film.toggleAttribute(name, Boolean(is_on)));
for (const name of ["src", "poster"])
  reflect(name, film => film.getAttribute(name) ?? "",
    (film, text) => film.setAttribute(name, text));
reflect("width", film => Math.max(0, parseInt(film.getAttribute("width")) || 0),
  (film, width) => film.setAttribute("width", width));

// Not on a server, which makes pages ahead and has no elements; once, if two scripts contain it.
if (globalThis.customElements && !customElements.get("celspan-film"))
  customElements.define("celspan-film", CelspanFilm);
})();
