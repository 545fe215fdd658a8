// The timeline: a ruler, the shots of a cut, marks and the wave of the sound, as wide as `span`.
//
//   frames from 0 --xOf--> CSS pixels: frame k is from xOf(k) to xOf(k + 1)
//
// Hands change `span`, the loop or the frame; everything here is drawn from them.
import * as cost from "/cost.js";
import { fetch } from "/fetch.js";
import { outlined } from "/over.js";
import { keptFrames } from "/pictures.js";
import { go, stop } from "/playing.js";
import { SHEET_MOST, drawSheet, nameRows } from "/rows.js";
import { clamp, element, here, loop, ratio, span, state, timecode, view } from "/state.js";

const RULER = 26, WAVE = 34;   // CSS pixels
const WAVE_COLUMNS = 2000;
const LABEL_LEAST = 68;        // pixels between two numbers of the ruler
const SNAP = 6;                // pixels within which a drag goes to a mark
const CLOSEST = 4;             // frames, the least that the timeline shows
const BLOCKS_MOST = 1000;      // shots, and marks, that are shown as elements

export let width = 1;                 // of the rows, in CSS pixels
export const heard = { columns: [], lips: [], build: 0 }; // of /wave.json

export const unit = () => width / (span.to - span.from);
export const xOf = frame => (frame - span.from) * unit();
/** The number of the frame at a place of the window, from 1. */
export const frameAt = clientX => {
  const box = here("lanes").getBoundingClientRect();
  return clamp(Math.floor(span.from + (clientX - box.left) / unit()) + 1, 1, state.film.frames);
};

/** A brush for a canvas that is as wide as the rows. */
export function brushOf(canvas, height) {
  const r = ratio(), brush = canvas.getContext("2d");
  canvas.width = Math.max(1, Math.round(width * r));
  canvas.height = Math.round(height * r);
  canvas.style.height = `${height}px`;
  brush.scale(r, r);
  brush.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  return brush;
}

/** The colours of the style sheet that are drawn with. */
export function coloursOf() {
  const style = getComputedStyle(document.documentElement);
  const names = ["line", "text", "quiet", "accent", "slow", "ready", "even", "odd", "wave", "tint"];
  return Object.fromEntries(names.map(name => [name, style.getPropertyValue(`--${name}`)]));
}

// ---------------------------------------------------------------- the ruler

/** Frames between two numbers of the ruler: a divisor of a second, or whole seconds. */
function rulerStep() {
  const rate = Math.max(1, Math.round(state.film.fps)), least = LABEL_LEAST / unit();
  const seconds = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600].map(one => one * rate);
  const steps = [1, 2, 3, 4, 5, 6, 8, 10, 12].filter(one => rate % one === 0 && one < rate);
  return [...steps, ...seconds].find(one => one >= least)
    ?? Math.ceil(least / (3600 * rate)) * 3600 * rate;
}

function drawTicks(brush, colours) {
  const stride = rulerStep(), first = Math.floor(span.from / stride) * stride;
  const small = stride * unit() > 5 * LABEL_LEAST / 4 && stride > 1 ? stride / 2 : stride;
  for (let k = first; k < span.to; k += small) {
    const x = xOf(k), hasNumber = (k - first) % stride === 0;
    brush.fillStyle = colours.line;
    brush.fillRect(x, hasNumber ? 8 : 15, 1, RULER);
    if (!hasNumber || k < 0) continue;
    brush.fillStyle = colours.quiet;
    brush.fillText(timecode(k + 1), x + 4, 17);
  }
}

/** Which frames are kept as they are seen now, and which took longer than they are shown. */
function drawReady(brush, colours) {
  for (const number of keptFrames()) {
    brush.fillStyle = cost.isSlow(number, 1 / state.film.fps) ? colours.slow : colours.ready;
    brush.fillRect(xOf(number - 1), RULER - 3, Math.max(1, unit()), 3);
  }
}

export function drawRuler() {
  if (!state.film) return;
  const brush = brushOf(here("ticks"), RULER), colours = coloursOf();
  const isWhole = loop.from === 1 && loop.to === state.film.frames;
  if (!isWhole) {
    brush.fillStyle = colours.tint;
    brush.fillRect(xOf(loop.from - 1), 0, (loop.to - loop.from + 1) * unit(), RULER);
  }
  drawTicks(brush, colours);
  drawReady(brush, colours);
  brush.fillStyle = colours.accent;
  if (!isWhole) brush.fillRect(xOf(loop.from - 1), 0, (loop.to - loop.from + 1) * unit(), 2);
  for (const [from, to] of outlined.runs) {
    const x = xOf(from - state.film.first);
    brush.fillRect(x, 2, Math.max(2, (to - from + 1) * unit()), 3);
  }
}

// ---------------------------------------------------------------- shots and marks

/** A block of the timeline as wide as some frames, from 0. */
function block(one, from, count) {
  one.style.left = `${xOf(from)}px`;
  one.style.width = `${Math.max(1, count * unit() - 1)}px`;
  return one;
}

/** The shots of the film, each with the frames that it has alone or in transitions, from 0. */
export function shotsOf() {
  return (state.film.shots || []).slice(0, BLOCKS_MOST)
    .map(shot => ({ ...shot, at: shot.from - state.film.first, count: shot.to - shot.from + 1 }));
}

function shotBlock(shot) {
  const one = element("button", { className: "shot", title: `${shot.name}: frames ${shot.from} to `
    + `${shot.to}`, onclick: () => { stop(); go(shot.at + 1); } }, element("span",
    { textContent: shot.name }));
  Object.assign(one.dataset, { shot: shot.name, from: shot.from, to: shot.to });
  one.style.paddingLeft = `${shot.before * unit() + 6}px`;
  return block(one, shot.at, shot.count);
}

/** The transition into a shot from the one before it, or from nothing. */
function joinBlock(shot) {
  const one = element("i", { className: "join", title: `${shot.into}, ${shot.before} frames` });
  one.dataset.transition = shot.into;
  return block(one, shot.at, shot.before);
}

function showShots() {
  const shots = shotsOf();
  for (const id of ["shots", "shots-head"]) here(id).hidden = shots.length === 0;
  here("shots").replaceChildren(...shots.map(shotBlock),
    ...shots.filter(shot => shot.before > 0).map(joinBlock));
}

/** The marks that are not shots, in the order of their frames. */
function marksOf() {
  const shots = new Set((state.film.shots || []).map(shot => `${shot.name} ${shot.from}`));
  return state.film.marks.filter(mark => !shots.has(`${mark.name} ${mark.frame}`))
    .slice(0, BLOCKS_MOST);
}

function showMarks() {
  const marks = marksOf();
  for (const id of ["marks", "marks-head"]) here(id).hidden = marks.length === 0;
  here("marks").replaceChildren(...marks.map((mark, i) => {
    const at = mark.frame - state.film.first, next = marks[i + 1]?.frame ?? Infinity;
    const one = element("button", { className: "mark", title: `${mark.name}: frame ${mark.frame}`,
      onclick: () => { stop(); go(at + 1); } }, element("span", { textContent: mark.name }));
    Object.assign(one.dataset, { mark: mark.name, frame: mark.frame });
    one.style.left = `${xOf(at)}px`;
    one.style.maxWidth = `${Math.max(12, (next - mark.frame) * unit() - 2)}px`;
    return one;
  }));
}

/** Where shots and marks begin, as numbers of frames from 1. */
const placesToSnap = () => [...new Set([...state.film.marks, ...state.film.shots || []]
  .map(one => (one.frame ?? one.from) - state.film.first + 1))].sort((a, b) => a - b);

/** Goes to the next mark in a direction. */
export function goToMark(direction) {
  const all = placesToSnap();
  const next = direction > 0 ? all.find(one => one > view.number)
    : all.findLast(one => one < view.number);
  if (next === undefined) return;
  stop();
  go(next);
}

// ---------------------------------------------------------------- the sound

/** Asks for the wave of the sound and the mouths, once for a save. */
export async function loadWave() {
  if (!state.shown || heard.build === state.build) return;
  const build = heard.build = state.build;
  setBusy("wave", true);
  const answer = await fetch(`/wave.json?columns=${WAVE_COLUMNS}&build=${build}`).catch(() => null);
  const said = answer?.ok ? await answer.json() : {};
  if (build !== state.build) return;
  Object.assign(heard, { columns: [], lips: [] }, said);
  setBusy("wave", false);
  nameRows();
  drawTimeline();
}

function drawWave() {
  const hasSound = Boolean(state.film.sound), brush = brushOf(here("wave"), WAVE);
  for (const id of ["wave", "wave-head"]) here(id).hidden = !hasSound;
  const colours = coloursOf(), count = Math.min(state.film.frames, SHEET_MOST);
  brush.fillStyle = colours.wave;
  if (heard.columns.length === 0) brush.fillText("being read …", 6, WAVE / 2 + 4);
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
  here("timeline").setAttribute("aria-busy", busy.size > 0);
}

export function placeHead() {
  if (!state.film) return;
  const x = xOf(view.number - 0.5);
  here("head").style.left = `${x - 1}px`;
  here("head").hidden = x < 0 || x > width;
}

export function drawTimeline() {
  if (!state.film) return;
  Object.assign(here("scrub"), { min: 1, max: state.film.frames, value: view.number });
  drawRuler();
  showShots();
  showMarks();
  drawWave();
  drawSheet();
  placeHead();
}

export function measureTimeline() {
  width = Math.max(1, here("lanes").clientWidth);
  drawTimeline();
}

/** Shows some frames, from 0, within those of the film. */
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
  const lines = event.deltaMode === 1 ? 16 : 1, count = span.to - span.from;
  const aside = event.deltaX + (event.shiftKey ? event.deltaY : 0);
  if (aside) return setSpan(span.from + aside * lines / unit(), span.to + aside * lines / unit());
  const at = span.from + (event.clientX - here("lanes").getBoundingClientRect().left) / unit();
  const factor = Math.exp(event.deltaY * lines * 0.002);
  setSpan(at - (at - span.from) * factor, at + (span.to - at) * factor, count);
}

/** The frame that a drag goes to: a mark that is near, unless the alt key is down. */
function snapped(event) {
  const number = frameAt(event.clientX);
  if (event.altKey) return number;
  const near = placesToSnap().find(one => Math.abs(one - number) * unit() <= SNAP);
  return near ?? number;
}

export function scrubTo(event) {
  if (!state.film || !event.buttons || event.button > 0) return;
  stop();
  go(snapped(event));
}

/** Brings the frame that is shown into the timeline while it is zoomed. */
export function followHead() {
  const at = view.number - 1, count = span.to - span.from;
  if (at < span.from || at >= span.to) setSpan(at - count / 10, at + count * 0.9);
}

