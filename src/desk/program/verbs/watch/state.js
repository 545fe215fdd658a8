// What the page knows, and what it shows: the one place of its state.
//
//   /state.json --> state (what the server has said)    keys, hands --> view, loop, play, shown
//                        \                                /
//                         everything that is drawn is drawn from these
import { newPace } from "/pace.js";

export const here = id => document.getElementById(id);
export const desk = here("desk");
export const overlay = here("overlay");

export const state = { news: 0, build: 0, film: null, errors: [], shown: false, parameters: [],
                second: null };
// number: of the frame, from 1. scale: device pixels of a unit of the film; x, y: the place of the
// frame's corner in the window, in device pixels. isFitted: scale and place follow the window.
export const view = { number: 1, scale: 1, x: 0, y: 0, isFitted: true };
export const loop = { from: 1, to: 1 };
// place: of the frame that was asked for last, isAsked: it had to be; pace: how fast frames come.
// start: by the clock of the sound while the sound is heard, otherwise by the machine's clock, in
// seconds.
export const play = { direction: 0, speed: 1, start: 0, isHeard: false, passed: 0, number: 1,
                      shown: -1, painted: [], place: -1, isAsked: false, pace: newPace() };
// How pictures are looked at. mixing: "", "wipe" or "differ"; held: the frame that others are
// compared with, 0: the frame before the last save; older: the picture at this place before it;
// onion: the number of drawings before and after. hasHandles: whether points have some.
export const looks = { isMatte: false, hasSpans: false, mixing: "", held: 0, older: null,
                       onion: 0, hasHandles: true };
// The part of the film that the timeline shows, in frames from 0.
export const span = { from: 0, to: 1 };

/** What is known of one of the films and its canvas. refused: the frames that could not be made,
 * { build, message } by their numbers. lastFault: the error that is shown. painted: the picture.
 * slowness: the seconds that it took. late: the timer after which an older picture is seen as one.
 * fetching: the picture that is on its way, { wanted, since }. given: values of parameters, as the
 * address holds them; wrong: sentences about others, by their names. isRefilled: all of them were
 * given again. */
const lane = (side, canvas, box) => ({
  side, canvas, box, pen: canvas.getContext("2d"), painted: null, refused: new Map(),
  lastFault: null, isAsking: false, isWanted: false, slowness: 0, late: 0, fetching: null,
  given: new URLSearchParams(), wrong: { __proto__: null }, isGiven: false, isSending: false,
  isChanged: false, isRefilled: false, wantedBuild: 0, formOf: "",
});
export const main = lane(1, here("canvas"), desk);
export const beside = lane(2, here("canvas2"), here("desk2"));

/** What the server has said of a lane's film; null: it is not shown. */
export const stateOf = one => one === main ? state : state.second;
export const isComparing = () => Boolean(state.second);
export const lanes = () => isComparing() ? [main, beside] : [main];

/** The build whose pictures a lane wants: values that are on their way will make the next one. */
export const buildOf = one => Math.max(stateOf(one)?.build ?? 0, one.wantedBuild);

/** An element of a lane: in the second lane, names end in 2. */
export const part = (one, id) => here(one === main ? id : `${id}2`);

export const ratio = () => window.devicePixelRatio || 1;
export const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

export function element(name, properties = {}, ...children) {
  const { dataset = {}, style = {}, ...rest } = properties;
  const one = Object.assign(document.createElement(name), rest);
  Object.assign(one.dataset, dataset);
  Object.assign(one.style, style);
  one.append(...children);
  return one;
}

/** Replaces the rows of a list. The focus of a key, not that of a click, stays at the same button
 * of the row of the same name. */
export function refill(list, rows) {
  const nameOf = one => Object.values(one.dataset)[0];
  const buttonsOf = one => [one, ...one.querySelectorAll("button")];
  const old = list.querySelector(":focus-visible");
  const row = old && [...list.children].find(one => one.contains(old));
  const next = row && rows.find(one => nameOf(one) === nameOf(row));
  const at = row ? buttonsOf(row).indexOf(old) : -1;
  list.replaceChildren(...rows);
  if (next) buttonsOf(next)[at]?.focus();
}

/** A picture of the sheet of icons in page.html. */
export function icon(name) {
  const space = "http://www.w3.org/2000/svg", picture = document.createElementNS(space, "svg");
  const use = document.createElementNS(space, "use");
  picture.setAttribute("aria-hidden", "true");
  use.setAttribute("href", `#i-${name}`);
  picture.append(use);
  return picture;
}

/** Gives an element a property, if it has another value: the browser calculates styles again for
 * each that is given, also for the same value. */
export function write(one, name, value) { if (one[name] !== value) one[name] = value; }

/** The same for an attribute: browsers of 2023 lack the properties of ARIA. */
export function writeAttribute(one, name, value) {
  if (one.getAttribute(name) !== value) one.setAttribute(name, value);
}

/** Writes the words of an element. */
export const setWords = (id, text) => write(here(id), "textContent", String(text));

/** Writes the words of a button, which may have an icon and a key beside them. */
export const label = (id, text) => write(here(id).querySelector("span"), "textContent", text);

/** Says of a button whether what it does is on. */
export const setPressed = (id, isOn) => writeAttribute(here(id), "aria-pressed", String(isOn));

/** Seconds and frames of a frame of the film, counted from 1: "2:12" is frame 61 at 24. */
export function timecode(number) {
  const rate = Math.max(1, Math.round(state.film.fps)), index = number - 1;
  const frames = String(index % rate).padStart(String(rate - 1).length, "0");
  return `${Math.floor(index / rate)}:${frames}`;
}

/** The frame of a text: "61", "2:12", or "1:02:12" with minutes; NaN: it is neither. */
export function frameOf(text) {
  if (!/^\s*\d+(:\d+){0,2}\s*$/.test(text)) return NaN;
  const parts = text.split(":").map(Number), rate = Math.max(1, Math.round(state.film.fps));
  if (parts.length === 1) return parts[0];
  const frames = parts.pop(), seconds = parts.reduce((sum, one) => 60 * sum + one, 0);
  return seconds * rate + frames + 1;
}

export const isReady = one => Boolean(stateOf(one)?.film && stateOf(one).shown);

