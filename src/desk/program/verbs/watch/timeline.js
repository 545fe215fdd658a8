// The timeline: a ruler, the shots of a cut, marks, captions and the wave of the sound, as wide as
// `span`.
//
//   frames from 0 --xOf--> CSS pixels: frame k is from xOf(k) to xOf(k + 1)
//
// Hands change `span`, the loop or the frame; everything here is drawn from them.
import { isSlow } from "/cost.js";
import { pause, read } from "/fetch.js";
import { outlined } from "/over.js";
import { keptFrames } from "/pictures.js";
import { jump } from "/playing.js";
import { SHEET_MOST, drawSheet, showSheet } from "/rows.js";
import {
  buildOf, clamp, element, here, loop, main, ratio, refill, span, state, timecode, view, write,
  writeAttribute,
} from "/state.js";

const RULER = 26, WAVE = 26;   // CSS pixels
const WAVE_COLUMNS = 2000;
const REST = 0.3;              // seconds without another build
const LABEL_LEAST = 68;        // pixels between two numbers of the ruler, where they are short
const LABEL_GAP = 20, DIGIT = 7;
const SNAP = 6;                // pixels within which a drag goes to a mark
const FONT = "11px system-ui, 'DejaVu Sans', sans-serif";
const CLOSEST = 4;             // frames, the least that the timeline shows
const BLOCKS_MOST = 1000;      // shots, or marks, that are shown at once
const MARK_LEAST = 12, EDGE = 9; // pixels: of a mark; how far a block goes beyond the window

let width = 1;                        // width of the rows, in CSS pixels
export const heard = { columns: [], lips: [], text: "", build: 0 }; // what /wave.json has said

export const unit = () => width / (span.to - span.from);
export const xOf = frame => (frame - span.from) * unit();
/** The place in the film, in frames from 0, at a place of the window. */
const placeAt = clientX =>
  span.from + (clientX - here("lanes").getBoundingClientRect().left) / unit();
/** The number of the frame at a place of the window, from 1. */
export const frameAt = clientX => clamp(Math.floor(placeAt(clientX)) + 1, 1, state.film.frames);

/** A brush for an empty canvas that is as wide as the rows. A canvas that keeps its size keeps its
 * font, too: to set one makes the browser calculate styles. */
export function brushOf(canvas, height) {
  const r = ratio(), brush = canvas.getContext("2d");
  const size = [Math.max(1, Math.round(width * r)), Math.round(height * r)];
  if (canvas.width !== size[0] || canvas.height !== size[1]) {
    [canvas.width, canvas.height] = size;
    canvas.style.height = `${height}px`;
    brush.font = FONT;
  }
  brush.setTransform(r, 0, 0, r, 0, 0);
  brush.clearRect(0, 0, width, height);
  return brush;
}

const COLOURS = ["line", "text", "quiet", "accent", "slow", "ready", "even", "odd", "wave", "tint"];
const colours = { theme: "" }; // colours of the theme, by their names

/** The colours of the style sheet that are drawn with, read once for a theme. */
export function coloursOf() {
  const root = document.documentElement, { theme } = root.dataset;
  if (colours.theme === theme) return colours;
  const style = getComputedStyle(root);
  for (const name of COLOURS) colours[name] = style.getPropertyValue(`--${name}`);
  return Object.assign(colours, { theme });
}

// ---------------------------------------------------------------- the ruler

/** Pixels between two numbers of the ruler: the last is the longest. */
const labelLeast = () =>
  Math.max(LABEL_LEAST, timecode(Math.ceil(span.to)).length * DIGIT + LABEL_GAP);

/** Frames between two numbers of the ruler: a divisor of a second, or whole seconds. */
function rulerStep() {
  const rate = Math.max(1, Math.round(state.film.fps)), least = labelLeast() / unit();
  const seconds = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600].map(one => one * rate);
  const steps = [1, 2, 3, 4, 5, 6, 8, 10, 12].filter(one => rate % one === 0 && one < rate);
  return [...steps, ...seconds].find(one => one >= least)
    ?? Math.ceil(least / (3600 * rate)) * 3600 * rate;
}

function drawTicks(brush, colours) {
  const stride = rulerStep(), first = Math.floor(span.from / stride) * stride;
  const isHalved = stride % 2 === 0 && stride * unit() > 5 * labelLeast() / 4;
  for (let k = first; k < span.to; k += isHalved ? stride / 2 : stride) {
    const x = xOf(k), hasNumber = (k - first) % stride === 0;
    brush.fillStyle = colours.quiet;
    brush.fillRect(x, hasNumber ? 8 : 17, 1, RULER);
    if (hasNumber) brush.fillText(timecode(k + 1), x + 4, 17);
  }
}

/** Which frames are kept as they are seen now, and which took longer than they are shown. */
function drawReady(brush, colours) {
  brush.fillStyle = colours.line;
  brush.fillRect(0, RULER - 3, width, 3);
  for (const number of keptFrames()) {
    brush.fillStyle = isSlow(number, 1 / state.film.fps) ? colours.slow : colours.ready;
    brush.fillRect(xOf(number - 1), RULER - 3, Math.max(1, unit()), 3);
  }
}

export function drawRuler() {
  if (!state.film) return;
  const brush = brushOf(here("ticks"), RULER), colours = coloursOf();
  const isWhole = loop.from === 1 && loop.to === state.film.frames;
  const drawLoop = (colour, height) => {
    brush.fillStyle = colour;
    if (!isWhole) brush.fillRect(xOf(loop.from - 1), 0, (loop.to - loop.from + 1) * unit(), height);
  };
  drawLoop(colours.tint, RULER);
  drawTicks(brush, colours);
  drawReady(brush, colours);
  drawLoop(colours.accent, 2);
  for (const [from, to] of outlined.runs) {
    const x = xOf(from - state.film.first);
    brush.fillRect(x, 2, Math.max(2, (to - from + 1) * unit()), 3);
  }
}

// ---------------------------------------------------------------- shots, marks and captions

const made = { film: null, shots: [], marks: [], captions: [] }; // with `at` and `count`

/** The shots, marks and captions of the film, with their places: `at`, from 0, `count` frames. */
function blocksOf() {
  const { film } = state, { first = 0, shots = [], marks = [], captions = [] } = film ?? {};
  if (made.film === film) return made;
  const block = (one, i) => ({ ...one, at: one.from - first, count: one.to - one.from + 1, i });
  const known = new Set(shots.map(shot => `${shot.name} ${shot.from}`));
  const free = marks.filter(mark => !known.has(`${mark.name} ${mark.frame}`));
  return Object.assign(made, { film, shots: shots.map(block), captions: captions.map(block),
    marks: free.map((mark, i) => ({ ...mark, at: mark.frame - first,
      count: (free[i + 1]?.frame ?? Infinity) - mark.frame })) });
}

/** The shots of the film, each with the frames that it has alone or in transitions, from 0. */
export const shotsOf = () => blocksOf().shots;
/** The marks, each with the frames until the next one; without the marks of shots. */
export const marksOf = () => blocksOf().marks;
/** The shots that a frame shows, counted from 0: in a transition there are two. */
export const shotsAt = at => shotsOf().filter(shot => shot.at <= at && at < shot.at + shot.count);

/** An element of the timeline as wide as its frames, and not much wider than the window. */
function block(name, { at, count }, properties, ...children) {
  const left = clamp(xOf(at), -EDGE, width + EDGE), one = element(name, properties, ...children);
  const right = clamp(xOf(at + count), left, width + EDGE);
  Object.assign(one.style, { left: `${left}px`, width: `${Math.max(1, right - left - 1)}px` });
  return one;
}

const named = (one, className, title, dataset) => block("button", one, { className, title, dataset,
  onclick: () => jump(one.at + 1) }, element("span", { textContent: one.name ?? one.text }));

/** A shot, and the transition into it from the one before it, or from nothing. */
function shotBlocks(shot) {
  const { name, from, to, before, after, into, at, i } = shot;
  const shade = i % 2 ? " odd" : "";
  const one = named(shot, `shot${shade}`, `${name}: frames ${from} to ${to}`,
                    { shot: name, from, to });
  one.style.paddingLeft = `${clamp(xOf(at + before) - Math.max(xOf(at), -EDGE), 0, width) + 6}px`;
  one.style.paddingRight = `${clamp(after * unit(), 0, width) + 2}px`;
  if (!before) return [one];
  const textContent = before * unit() > 6 * into.length + 6 ? into : "";
  return [one, block("i", { at, count: before }, { className: `join${shade}`, textContent,
                                                  dataset: { transition: into } })];
}

function markBlock(mark) {
  const { name, frame } = mark;
  const one = named(mark, "mark", `${name}: frame ${frame}`, { mark: name, frame });
  one.style.minWidth = `${MARK_LEAST}px`;
  return one;
}

const captionBlock = one => named(one, "shot caption-block", one.text,
                                  { text: one.text, from: one.from, to: one.to });

/** Shows the rows for what the film has, and hides the others. */
export function showRows() {
  const { shots, marks, captions } = blocksOf(), wave = state.film.sound ? [true] : [];
  for (const [id, list] of Object.entries({ shots, marks, captions, wave })) {
    for (const name of [id, `${id}-head`]) write(here(name), "hidden", list.length === 0);
  }
}

const filled = {}; // what the rows are filled with, as text, by their names

/** Fills a row of the timeline with those that are seen, if they are others than before. */
function fillRow(id, list, make) {
  const seen = list.filter(one => one.at + one.count > span.from && one.at < span.to)
    .slice(0, BLOCKS_MOST), key = JSON.stringify([seen, span, width]);
  if (filled[id] !== key) refill(here(id), seen.flatMap(make));
  filled[id] = key;
}

/** Where shots and marks begin, as numbers of frames from 1. */
const placesToSnap = () => [...blocksOf().shots, ...made.marks].map(one => one.at + 1)
  .sort((a, b) => a - b);

/** Goes to the next mark in a direction. */
export function goToMark(direction) {
  const all = placesToSnap();
  const next = direction > 0 ? all.find(one => one > view.number)
    : all.findLast(one => one < view.number);
  if (next !== undefined) jump(next);
}

// ---------------------------------------------------------------- the sound

/** Asks for the wave of the sound and the mouths, once for a save; for values as soon as they rest.
 * What is the same as before is not drawn again. */
export async function loadWave() {
  const build = buildOf(main), isFirst = heard.build === 0;
  const isWanted = () => build === buildOf(main);
  if (!state.shown || heard.build === build) return;
  heard.build = build;
  if (!isFirst) await pause(REST);
  if (!isWanted()) return;
  setBusy("wave", true);
  const said = await read(`/wave.json?columns=${WAVE_COLUMNS}&build=${build}`, isWanted);
  if (!isWanted()) return;
  const text = JSON.stringify(said), isSame = !isFirst && text === heard.text;
  Object.assign(heard, { columns: [], lips: [] }, said, { text });
  setBusy("wave", false);
  if (isSame && heard.columns.length > 0) return;
  showSheet();
  drawTimeline();
}

function drawWave() {
  const brush = brushOf(here("wave"), WAVE), count = Math.min(state.film.frames, SHEET_MOST);
  brush.fillStyle = coloursOf().wave;
  const words = busy.has("wave") ? "being read …" : "It cannot be read: see the faults.";
  if (!heard.columns.length) brush.fillText(words, 6, WAVE / 2 + 4);
  const each = count / Math.max(1, heard.columns.length);
  heard.columns.forEach((height, i) => {
    const half = Math.max(0.5, height / 255 * (WAVE / 2 - 2));
    brush.fillRect(xOf(i * each), WAVE / 2 - half, Math.max(each * unit(), 0.5), 2 * half);
  });
}

// ---------------------------------------------------------------- all of it

export const busy = new Set(); // what is being read

/** Says that something of the timeline is being read, or is there. */
export function setBusy(what, isOn) {
  if (isOn) busy.add(what);
  else busy.delete(what);
  writeAttribute(here("timeline"), "aria-busy", String(busy.size > 0));
}

let headPlace = ""; // where the playhead is, as it was written last

export function placeHead() {
  if (!state.film) return;
  const x = xOf(view.number - 1), place = `--at: ${x}; --unit: ${unit()}`;
  if (place === headPlace) return;
  headPlace = place;
  here("timeline").style.cssText = place;
  here("timeline").classList.toggle("away", x < 0 || x > width);
}

export function drawTimeline() {
  if (!state.film) return;
  const { shots, marks, captions } = blocksOf();
  const scrub = { min: 1, max: state.film.frames, value: view.number };
  for (const [name, value] of Object.entries(scrub)) write(here("scrub"), name, String(value));
  showRows();
  drawRuler();
  fillRow("shots", shots, shotBlocks);
  fillRow("marks", marks, markBlock);
  fillRow("captions", captions, captionBlock);
  drawWave();
  drawSheet();
  placeHead();
}

export function measureTimeline() {
  width = Math.max(1, here("lanes").clientWidth);
  drawTimeline();
}

/** Shows some frames of the film, from 0. */
export function setSpan(from, to) {
  const all = state.film.frames, count = clamp(to - from, Math.min(CLOSEST, all), all);
  span.from = clamp(from, 0, all - count);
  span.to = span.from + count;
  drawTimeline();
}

/** Zooms in time about the pointer; sideways, or with the shift key, moves. */
export function turnTimeline(event) {
  if (!state.film || event.ctrlKey) return;
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1, at = placeAt(event.clientX);
  const aside = (event.deltaX + (event.shiftKey ? event.deltaY : 0)) * lines / unit();
  if (aside) return setSpan(span.from + aside, span.to + aside);
  const factor = Math.exp(event.deltaY * lines * 0.002);
  setSpan(at - (at - span.from) * factor, at + (span.to - at) * factor);
}

/** The frame that a drag goes to: the nearest mark that is near, unless the alt key is down. */
function snapped(event) {
  const number = frameAt(event.clientX), farOf = one => Math.abs(one - number) * unit();
  const [near] = event.altKey ? [] : placesToSnap().sort((a, b) => farOf(a) - farOf(b));
  return farOf(near) <= SNAP ? near : number;
}

export function scrubTo(event) {
  if (state.film && event.buttons && event.button <= 0) jump(snapped(event));
}

/** Brings the frame that is shown into the timeline while it is zoomed. */
export function followHead() {
  const at = view.number - 1, count = span.to - span.from;
  if (at < span.from || at >= span.to) setSpan(at - count / 10, at + count * 0.9);
}
