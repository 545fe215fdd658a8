// Scripts of a page that run in their places. `enliven` puts the engine behind a figure:
//
//   text, frame, view, line  -->  look  -->  worker  -->  picture, or an error under its line
//
// While a picture is drawn, what changes meanwhile waits, and only the newest is drawn next.
import { element, field } from "./field.js";
import { film } from "./film.js";

const LEAST_WIDTH = 640; // CSS pixels of a picture, where there is room
const MOST_SIDE = 2 ** 20; // pixels of a whole frame that is zoomed
const PATIENCE = 500; // milliseconds until an error is shown: it may be half a word
const CLICK = 4; // CSS pixels that a pointer may move in a click
const WHOLE = { scale: 1, x: 0, y: 0 }; // a view: its top left in shares of the film
const POINT = /(?<!size = )\{\s*(-?\d+\.?\d*\s*,\s*-?\d+\.?\d*)(?=\s*[,}])/g;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

let playing = null; // the one figure that plays

const clamp = (value, least, most) => Math.min(Math.max(value, least), most);
const button = (textContent, title, onclick) => element("button", { type: "button", textContent,
  title, ariaLabel: title, onclick });

export class Live {
  constructor(figure) {
    const pre = figure.querySelector("pre"), code = pre.querySelector("code");
    this.figure = figure;
    this.name = `${figure.dataset.script}.lua`;
    this.original = this.other = code.textContent.replace(/\n$/, "");
    this.view = WHOLE;
    this.set = {}; // values of parameters
    this.line = this.pointed = 0; // the line that is shown alone; that whose points have handles
    this.field = field(pre, { label: `${this.name}, to be changed`, source: this.original,
      changed: () => this.change(), chosen: (line) => this.choose(line) });
    this.stage = figure.querySelector(".stage") ?? element("div", { className: "stage" });
    this.still = this.stage.querySelector("img");
    if (!this.still) pre.before(this.stage);
    this.makeBar();
    this.makeScreen();
    figure.addEventListener("keydown", ({ key, isComposing }) => {
      if (key === "Escape" && !isComposing) this.revert();
    });
    addEventListener("resize", () => this.look());
    new IntersectionObserver(([{ isIntersecting }]) => isIntersecting || this.pause())
      .observe(figure);
  }

  makeBar() {
    this.play = button("", "Play", () => this.isPlaying ? this.pause() : this.start());
    this.scrub = element("input", { type: "range", ariaLabel: "Frame", oninput: () => {
      this.pause();
      this.frame = Number(this.scrub.value);
      this.look();
    } });
    this.moving = element("span", { className: "moving", hidden: true }, this.play, this.scrub);
    this.place = element("output");
    this.note = element("p", { className: "note", role: "status", hidden: true });
    this.stage.after(element("div", { className: "bar" }, this.moving, this.place,
      button("−", "Zoom out", () => this.zoom(0.5)), button("+", "Zoom in", () => this.zoom(2)),
      button("Revert", "Revert (escape)", () => this.revert())), this.note);
  }

  makeScreen() {
    this.canvas = element("canvas", { role: "img",
      ariaLabel: this.still?.alt ?? `the picture of ${this.name}` });
    this.pen = this.canvas.getContext("2d");
    this.screen = element("div", { className: "screen", hidden: true }, this.canvas);
    this.stage.append(this.screen);
    this.hearPointers();
  }

  // ---- drawing

  get script() { return film(this.field.text, { name: this.name, set: this.set }); }

  /** Draws what is wanted now. */
  look() {
    this.isStale = true;
    this.drawing ??= this.drawNewest().finally(() => { this.drawing = null; });
    return this.drawing;
  }

  async drawNewest() {
    while (this.isStale) {
      this.isStale = false;
      const { frame, view, line, stage, still, script } = this, ratio = devicePixelRatio;
      const width = Math.min(stage.clientWidth, Math.max(LEAST_WIDTH, still?.width ?? 0));
      const box = [width * ratio, innerHeight * 0.7 * ratio];
      try { this.show(await script.draw({ frame, view, line, box })); } catch (error) { this.fail(error); }
    }
  }

  show({ pixels, size: [width, height], film: made }) {
    clearTimeout(this.patience);
    this.made = made;
    this.frame = made.frame;
    Object.assign(this.canvas, { width, height });
    this.canvas.style.width = `${width / devicePixelRatio}px`;
    this.pen.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
    if (this.still) this.still.hidden = true;
    this.screen.hidden = false;
    this.say({});
    this.showPlace();
    this.placeHandles();
  }

  /** Shows an error under its line, or under the picture if none is known; or that there is none. */
  say({ line = 0, sentence = "", message = "" }) {
    this.field.mark(line, line ? sentence : "");
    Object.assign(this.note, { hidden: Boolean(line) || !message, textContent: message });
    this.figure.dataset.state = message ? "failed" : "drawn";
    this.figure.dispatchEvent(new Event(this.figure.dataset.state));
  }

  fail(error) {
    clearTimeout(this.patience);
    this.patience = setTimeout(() => this.say(error), this.made ? PATIENCE : 0);
  }

  showPlace() {
    const { first, count } = this.made, { scale } = this.view, last = first + count - 1;
    this.moving.hidden = count < 2;
    Object.assign(this.scrub, { min: first, max: last, value: this.frame });
    const zoomed = scale > 1 && `×${scale.toFixed(scale < 10 ? 1 : 0)}`;
    this.place.textContent = [count > 1 && `${this.frame}/${last}`, zoomed].filter(Boolean).join("  ");
    this.canvas.classList.toggle("zoomed", scale > 1);
  }

  // ---- time

  get isPlaying() { return playing === this; }

  async start() {
    playing?.pause();
    playing = this;
    this.figure.classList.add("playing");
    this.play.title = this.play.ariaLabel = "Pause";
    const turn = this.turn = {}; // of this start
    await this.look();
    let last = performance.now(), ahead = 0; // frames
    const tick = (now) => {
      if (!this.isPlaying || this.turn !== turn) return;
      const { first, count, fps } = this.made ?? { count: 1 };
      if (count < 2) return this.pause();
      requestAnimationFrame(tick);
      ahead += Math.max(0, now - last) / 1000 * fps;
      last = now;
      if (ahead < 1 || this.drawing) return;
      this.frame = first + (this.frame - first + Math.floor(ahead)) % count;
      ahead %= 1;
      this.look();
    };
    requestAnimationFrame(tick);
  }

  pause() {
    if (!this.isPlaying) return;
    playing = null;
    this.figure.classList.remove("playing");
    this.play.title = this.play.ariaLabel = "Play";
  }

  // ---- the text

  change() {
    this.line = 0;
    if (!this.isHeld) this.showHandles(this.pointed);
    this.look();
  }

  /** Shows only what a line made. */
  choose(line) {
    this.line = line;
    this.showHandles(line);
    this.look();
  }

  /** Brings back the text of the page and the whole picture; once more: the changed text. */
  revert() {
    const { text } = this.field, isOriginal = text === this.original;
    if (!isOriginal) this.other = text;
    this.view = WHOLE;
    this.set = {};
    this.pointed = 0;
    this.figure.dispatchEvent(new Event("reverted"));
    this.field.text = isOriginal ? this.other : this.original;
  }

  // ---- the picture under the pointer

  /** The shares of the canvas at a place of the window. */
  shares({ clientX, clientY }) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return [(clientX - left) / width, (clientY - top) / height];
  }

  /** The point of the film there. */
  pointAt(place) {
    const [h, v] = this.shares(place), { scale, x, y } = this.view, { width, height } = this.made;
    return [(x + h / scale) * width, (y + v / scale) * height];
  }

  setView(scale, x, y) {
    const room = 1 - 1 / scale;
    this.view = { scale, x: clamp(x, 0, room), y: clamp(y, 0, room) };
    this.look();
  }

  /** Zooms about a place that stays where it is. */
  zoom(by, [h, v] = [0.5, 0.5]) {
    const { scale, x, y } = this.view, { width, height } = this.canvas;
    const next = clamp(scale * by, 1, MOST_SIDE / Math.max(width, height) - 1);
    this.setView(next, x + h / scale - h / next, y + v / scale - v / next);
  }

  hearPointers() {
    const pointers = new Map(), { canvas } = this;
    const hear = (name, act) => canvas.addEventListener(name, act, { passive: false });
    let moved = 0;
    const spread = ([a, b]) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    hear("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
      moved = 0;
    });
    hear("pointermove", (event) => {
      const before = pointers.get(event.pointerId), { scale, x, y } = this.view;
      if (!before) return;
      const [h, v] = this.shares(before), [toH, toV] = this.shares(event);
      const wide = pointers.size === 2 && spread([...pointers.values()]);
      pointers.set(event.pointerId, event);
      moved += spread([before, event]);
      if (wide) this.zoom(spread([...pointers.values()]) / wide, [toH, toV]);
      else if (moved > CLICK) this.setView(scale, x + (h - toH) / scale, y + (v - toV) / scale);
    });
    hear("pointercancel", ({ pointerId }) => pointers.delete(pointerId));
    hear("pointerup", (event) => {
      if (pointers.delete(event.pointerId) && moved <= CLICK) this.lightAt(event);
    });
    hear("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return; // the page is moved
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.005), this.shares(event));
    });
  }

  /** Lights the line that made the front at a place of the picture, and names it below. */
  async lightAt(event) {
    this.pause();
    const [x, y] = this.pointAt(event);
    const { places } = await this.script.at({ frame: this.frame, x, y })
      .catch(() => ({ places: [] })); // the next picture says why
    const own = places.join(" ").split(" ").find((word) => word.startsWith(`${this.name}:`));
    const line = own ? parseInt(own.slice(this.name.length + 1), 10) : 0;
    const text = this.field.text.split("\n")[line - 1] ?? "";
    this.field.light(line);
    this.note.textContent = line ? `${line}: ${text.trim()}` : "No line of this script made this.";
    this.note.hidden = false;
  }

  // ---- the points of a line, as handles on the picture

  /** A handle for each pair of numbers in a line that may be a point. */
  showHandles(line) {
    this.pointed = line;
    const lines = this.field.text.split("\n"), start = lines.slice(0, line - 1).join("\n").length + 1;
    const handles = [...(line ? lines[line - 1] : "").matchAll(POINT)]
      .map(({ 0: all, 1: pair, index }) => this.makeHandle(pair, index + all.length - pair.length
        + (line > 1 ? start : 0)));
    this.screen.replaceChildren(this.canvas, ...handles);
    if (this.made) this.placeHandles();
  }

  makeHandle(pair, from) {
    const handle = button("", `The point ${pair}`);
    const move = ([x, y], digits) => {
      const text = `${Number(x.toFixed(digits))}, ${Number(y.toFixed(digits))}`;
      this.isHeld = true;
      this.field.replace(from, from + handle.value.length, text);
      this.isHeld = false;
      handle.value = text;
      this.placeHandles();
    };
    Object.assign(handle, { className: "handle", value: pair });
    handle.addEventListener("pointerdown", ({ pointerId }) => handle.setPointerCapture(pointerId));
    handle.addEventListener("pointermove", (event) => {
      const unit = this.made.width / this.view.scale / this.canvas.clientWidth;
      if (handle.hasPointerCapture(event.pointerId)) {
        move(this.pointAt(event), clamp(Math.ceil(-Math.log10(unit) - 0.5), 0, 6));
      }
    });
    handle.addEventListener("lostpointercapture", () => this.showHandles(this.pointed));
    handle.addEventListener("keydown", (event) => {
      const way = ARROWS[event.key];
      if (!way) return;
      event.preventDefault();
      move(handle.value.split(",").map((side, i) => Number(side) + way[i]), 6);
    });
    return handle;
  }

  placeHandles() {
    const { scale, x, y } = this.view, { width, height } = this.made;
    for (const handle of this.screen.querySelectorAll(".handle")) {
      const [left, top] = handle.value.split(",").map(Number);
      const h = (left / width - x) * scale, v = (top / height - y) * scale;
      handle.hidden = h < 0 || h > 1 || v < 0 || v > 1;
      Object.assign(handle.style, { left: `${h * 100}%`, top: `${v * 100}%` });
    }
  }
}

/** The place in the text of a figure that a click of the page means. */
const placeOf = ({ type, clientX, clientY }, code) => {
  const at = type === "click" && document.caretRangeFromPoint?.(clientX, clientY);
  if (!at || !code.contains(at.startContainer)) return 0;
  const before = document.createRange();
  before.setStart(code, 0);
  before.setEnd(at.startContainer, at.startOffset);
  return before.toString().length;
};

/** Runs a figure. event: what the reader did. */
export const enliven = (figure, event) => {
  const pre = event.target.closest("pre"), place = pre && placeOf(event, pre.querySelector("code"));
  const live = new Live(figure);
  if (pre) live.field.focus(place);
  if (pre || matchMedia("(prefers-reduced-motion: reduce)").matches) live.look();
  else live.start();
};
