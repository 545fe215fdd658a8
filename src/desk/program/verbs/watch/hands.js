// Keys, buttons and pointers.
import { swapComparing } from "/beside.js";
import { holdFrame, setMixing } from "/compare.js";
import { fullScreen, nextGround, nextGuide, setGround, swapTheme } from "/guides.js";
import { inspect } from "/inspector.js";
import { leavePoint, pointAt } from "/objects.js";
import { outline, setSpans } from "/over.js";
import { closeMenus, hearMenus, isOpen, swapPanel } from "/panels.js";
import { look, setMatte } from "/pictures.js";
import { jump, setLoop, setSpeed, start, step, swapMute, toggle } from "/playing.js";
import { swapHandles } from "/points.js";
import { drawSheet, nextOnion, resetCels, setSheet } from "/rows.js";
import { beside, frameOf, here, looks, loop, main, play, ratio, state, view } from "/state.js";
import { hideThumb, showThumb } from "/thumb.js";
import { frameAt, goToMark, scrubTo, setSpan, turnTimeline } from "/timeline.js";
import { loadValues, resetValues, saveValues, undoValues } from "/values.js";
import { fit, move, natural, zoom, zoomMiddle } from "/view.js";

const STRIDE = 80;           // device pixels that a key moves the picture

function askNumber() {
  here("number").value = view.number;
  here("go").returnValue = "";
  here("go").showModal();
  here("number").select();
}

/** Goes to the frame that was typed, as a number or as a timecode. */
function goToTyped() {
  const number = state.film ? frameOf(here("number").value) : NaN;
  if (here("go").returnValue === "go" && !Number.isNaN(number)) jump(number);
}

const FIELDS = "select, textarea, input:not([type=range], [type=checkbox])"; // that take keys
let isPointed = false; // whether the focus came by a pointer, and not by keys

/** Leaves a field, otherwise closes a menu, also from a field in it, otherwise ends the outline of
 * what a line made. */
function leave({ target }) {
  const field = target.closest(FIELDS);
  if (field?.closest("main")) field.blur();
  else if (!closeMenus()) outline(null);
}

const keys = {
  " ": toggle, k: toggle,
  ArrowLeft: event => event.shiftKey ? move(STRIDE, 0) : step(-1),
  ArrowRight: event => event.shiftKey ? move(-STRIDE, 0) : step(1),
  ArrowUp: event => event.shiftKey ? move(0, STRIDE) : step(1),
  ArrowDown: event => event.shiftKey ? move(0, -STRIDE) : step(-1),
  PageUp: () => step(-10), PageDown: () => step(10),
  Home: () => jump(loop.from), End: () => jump(loop.to),
  "[": () => goToMark(-1), "]": () => goToMark(1),
  j: () => start(-1),
  l: () => play.direction > 0 ? setSpeed(play.speed * 2) : start(1),
  i: () => setLoop(view.number, loop.to),
  o: () => setLoop(Math.min(loop.from, view.number), view.number),
  x: () => setLoop(1, Infinity),
  p: () => swapPanel("inspector"), v: () => swapPanel("values"), r: () => swapPanel("faults"),
  c: () => swapPanel("costs"), q: () => swapPanel("objects"),
  s: () => setSheet(here("sheet").hidden),
  w: () => setMixing("wipe"), d: () => setMixing("differ"),
  h: holdFrame, n: nextOnion,
  u: swapMute,
  e: () => setSpans(!looks.hasSpans),
  Escape: leave,
  y: () => { if (!here("compare").hidden) swapComparing(); },
  g: askNumber,
  "+": () => zoomMiddle(1.5), "=": () => zoomMiddle(1.5), "-": () => zoomMiddle(1 / 1.5),
  0: () => { fit(); look(); }, 1: natural,
  a: nextGuide, b: nextGround, m: () => setMatte(!looks.isMatte), t: swapTheme, f: fullScreen,
  "?": () => here("keys").showModal(),
};

/** Whether a key belongs to what has the focus. After a click on a button, the space key plays. */
function isTaken({ target, key, ctrlKey, metaKey, altKey }) {
  if (ctrlKey || metaKey || altKey || document.querySelector("dialog[open]")) return true;
  return key !== "Escape" && target.matches(FIELDS)
    || target.matches("[type=range]") && /^(Arrow|Page|Home|End)/.test(key)
    || !isPointed && target.matches("button, input") && key === " ";
}

function hearKey(event) {
  const act = keys[event.key];
  if (event.key === "Tab") isPointed = false;
  const isUndo = event.key === "z" && (event.ctrlKey || event.metaKey);
  if (isUndo && !event.target.matches("textarea, input[type=text]")) undoValues();
  if (!act || isTaken(event)) return;
  event.preventDefault();
  act(event);
}

// ---------------------------------------------------------------- pointers over the picture

const pointers = new Map();
let travelled = 0;

function press(one, event) {
  if (event.target.closest(".fault, .handle")) return;
  one.box.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, event);
  travelled = 0;
}

/** The middle of two pointers, and their distance. */
function pinch(one, [a, b]) {
  const box = one.box.getBoundingClientRect(), r = ratio();
  return [((a.clientX + b.clientX) / 2 - box.left) * r, ((a.clientY + b.clientY) / 2 - box.top) * r,
          Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY)];
}

function drag(one, event) {
  const before = pointers.get(event.pointerId);
  if (!before) return pointAt(one, event);
  const two = pointers.size === 2 ? pinch(one, [...pointers.values()]) : null;
  pointers.set(event.pointerId, event);
  const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
  travelled += Math.abs(dx) + Math.abs(dy);
  if (two) {
    const [x, y, distance] = pinch(one, [...pointers.values()]);
    zoom(distance / Math.max(1, two[2]), x, y);
  } else if (travelled > 3) {
    one.box.classList.add("moving");
    move(dx * ratio(), dy * ratio());
  }
}

function release(one, event) {
  if (!pointers.delete(event.pointerId)) return;
  one.box.classList.remove("moving");
  const isClick = event.type === "pointerup" && travelled <= 3;
  if (isClick && isOpen("inspector")) inspect(one, event.clientX, event.clientY);
}

function turn(one, event) {
  const box = one.box.getBoundingClientRect(), r = ratio();
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1;
  zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0015)),
       (event.clientX - box.left) * r, (event.clientY - box.top) * r);
}

// ---------------------------------------------------------------- what is heard

/** Copies the text of a field, or selects it where that is not allowed. */
async function copyFrom(id) {
  await navigator.clipboard?.writeText(here(id).value).catch(() => here(id).select());
}

/** Hears the buttons that do what a key does, and those that copy. */
function hearButtons() {
  for (const one of document.querySelectorAll("[data-key]")) {
    one.addEventListener("click", () => keys[one.dataset.key]({}));
  }
  for (const one of document.querySelectorAll("[data-copy]")) {
    one.addEventListener("click", () => copyFrom(one.dataset.copy));
  }
  here("save-values").addEventListener("click", saveValues);
  here("reset-values").addEventListener("click", resetValues);
  here("handles").addEventListener("click", swapHandles);
  here("altered-reset").addEventListener("click", resetCels);
}

function hearTimeline() {
  const lanes = here("lanes"), ruler = here("ruler");
  ruler.addEventListener("pointerdown", event => {
    ruler.setPointerCapture(event.pointerId);
    scrubTo(event);
  });
  ruler.addEventListener("pointermove", event => {
    if (event.buttons) scrubTo(event);
    showThumb(event);
  });
  ruler.addEventListener("pointerleave", hideThumb);
  ruler.addEventListener("dblclick", () => { if (state.film) setSpan(0, state.film.frames); });
  for (const one of [lanes, here("cells")]) {
    one.addEventListener("wheel", turnTimeline, { passive: false });
  }
  here("timeline").addEventListener("scroll", drawSheet);
  here("cells").addEventListener("click", event => jump(frameAt(event.clientX)));
  here("scrub").addEventListener("input", event => jump(Number(event.target.value)));
}

function hearPictures() {
  for (const one of [main, beside]) {
    const hear = (name, act) => one.box.addEventListener(name, event => act(one, event),
                                                         { passive: false });
    hear("pointerdown", press);
    hear("pointermove", drag);
    hear("pointerup", release);
    hear("pointercancel", release);
    hear("pointerleave", leavePoint);
    hear("wheel", turn);
  }
}

/** Hears everything that hands do. */
export function hearHands() {
  document.addEventListener("keydown", hearKey);
  document.addEventListener("pointerdown", () => { isPointed = true; }, true);
  const choose = (id, act) => here(id).addEventListener("change", ({ target }) => {
    act(target.value);
    if (isPointed) target.blur();
  });
  choose("speed", value => setSpeed(Number(value)));
  choose("ground", setGround);
  here("load-values").addEventListener("change", loadValues);
  here("go").addEventListener("close", goToTyped);
  hearButtons();
  hearMenus();
  hearTimeline();
  hearPictures();
}
