// Playing: frames in time, by the clock of the sound while it is heard.
//
//   clock, arrivals --> proceed: asks for pictures ahead --if one is due--> tick: shows it
//
// A moment to draw costs the browser much, so it is asked for only when something is due.
import { showFault } from "/faults.js";
import { showNumbers } from "/news.js";
import { SIZES, chooseSize, judge, nextPlace, noteArrival } from "/pace.js";
import {
  KEPT_MOST, abandon, coarseNow, failed, fetchPicture, kept, look, paint, wish,
} from "/pictures.js";
import {
  beginSound, endSound, feedSound, hasSound, heardSeconds, muteSound, setSoundOf, tapSound,
} from "/sound.js";
import {
  clamp, element, here, icon, isReady, lanes, looks, loop, play, setPressed, setWords, state, view,
  write,
} from "/state.js";
import { drawRuler, followHead } from "/timeline.js";

let isTicking = false; // a tick waits: never two, however often playing begins again
let timer = 0;         // for the next call of proceed
// pictures that are requested ahead while playing, and at the same time
const AHEAD = 8, AT_ONCE = 3;
const BEHIND = 24;           // frames that a picture may be late
const REST_MOST = 200;       // milliseconds between two looks at the clock
const SHARP_SHARE = 1.5;     // the memory of sharp pictures with small ones beside them

function go(number) {
  if (!state.film) return;
  view.number = clamp(Math.round(number) || 1, 1, state.film.frames);
  lanes().forEach(showFault);
  if (play.direction === 0) tapSound(view.number - 1);
  followHead();
  look();
}

/** Goes to a frame, and stays there. */
export function jump(number) {
  stop();
  go(number);
}

export const step = by => jump(view.number + by);

export function start(direction) {
  if (!state.film) return;
  play.direction = direction;
  if (view.number < loop.from || view.number > loop.to) view.number = loop.from;
  play.number = view.number;
  play.start = performance.now() / 1000;
  Object.assign(play, { isHeard: false, passed: 0, painted: [], place: -1, isAsked: false });
  refused.clear();
  judge(pace);
  if (direction > 0) beginSound(view.number - 1, play.speed, loop.from - 1, loop.to - 1);
  else endSound();
  play.shown = -1;
  showPlaying(true);
  clearTimeout(timer);
  timer = setTimeout(proceed); // a film that plays at once has no place in the window yet
}

function stop() {
  play.direction = 0;
  for (const wanted of [...asked.values()].flat()) abandon(wanted);
  endSound();
  showPlaying(false);
  setWords("rate", "");
}

function showPlaying(isOn) {
  const name = isOn ? "Pause" : "Play";
  here("play").replaceChildren(icon(name.toLowerCase()), element("span", { textContent: name }));
  here("play").setAttribute("aria-label", name);
}

export function toggle() {
  if (play.direction === 0) return start(1);
  stop();
  look();
}

/** The number `by` frames further on, in the loop. */
function onward(number, by) {
  const count = loop.to - loop.from + 1;
  return loop.from + ((number - loop.from + by) % count + count) % count;
}

const asked = new Map(); // requests that were made ahead, by the number of the frame
const refused = new Set(); // names of pictures that failed since the start, in whatever size
const nameOfWish = ({ lane, number, build, query }) => [lane.side, number, build, query].join();
const { pace } = play;

/** Asks for the next pictures, for those that can be here in time. elapsed: frames since the
 * start. */
function askAhead(elapsed) {
  const rate = state.film.fps * play.speed;
  while (asked.size < AT_ONCE) {
    const place = nextPlace(pace, play.place, elapsed, rate, play.isAsked);
    if (place > elapsed + pace.latency * rate + AHEAD) return;
    play.place = place;
    play.isAsked = askBoth(onward(play.number, Math.ceil(place) * play.direction));
  }
}

/** Asks for a sharp picture when all small ones of the loop are here, and plays sharp ones when all
 * of them are. */
function askSharp() {
  if (asked.size > 0 || coarseNow() === 1) return;
  const length = loop.to - loop.from + 1;
  const bytes = wishes(loop.from, 1).reduce((all, { crop: [, , w, h] }) => all + 4 * w * h, 0);
  if (SHARP_SHARE * bytes * length > KEPT_MOST) return;
  const numbers = Array.from({ length }, (_, i) => loop.from + i);
  if (numbers.some(number => missingOf(number).length > 0)) return;
  if (!numbers.some(number => askBoth(number, 1))) judge(pace, 1);
}

/** The lanes that play: with one whose film cannot be shown the other plays alone. */
const playing = () => lanes().filter(isReady);

const wishes = (number, coarse) => playing().map(one => wish(number, one, coarse)).filter(Boolean);

const missingOf = (number, coarse) => wishes(number, coarse)
  .filter(one => !kept.has(one.address) && !refused.has(nameOfWish(one)));

/** Asks for a frame of all films that play, if it is not here, not on its way, and has not failed.
 * Returns whether it is asked for. */
function askBoth(number, coarse = coarseNow()) {
  const missing = missingOf(number, coarse);
  if (missing.length === 0 || asked.has(number)) return false;
  asked.set(number, missing);
  const began = performance.now();
  Promise.all(missing.map(fetchOne)).then(all => {
    if (!all.every(Boolean)) return;
    noteArrival(pace, began / 1000, performance.now() / 1000, coarse);
    if (isPlaying() && !looks.mixing) chooseSize(pace, state.film.fps * play.speed);
  }).finally(() => {
    asked.delete(number);
    proceed();
  });
  return true;
}

/** Whether the picture is here now. */
async function fetchOne(wanted) {
  try {
    await fetchPicture(wanted);
    return true;
  } catch (fault) {
    if (fault.status !== 503) refused.add(nameOfWish(wanted));
    await failed(fault, wanted);
    return false;
  }
}

/** Whether the picture of a wish is here, or is known to fail. */
const isKnown = ({ address, lane, number, build }) =>
  kept.has(address) || lane.refused.get(number)?.build === build;

/** The frame that is due after that many frames, or the newest before it that has not been shown:
 * what is known of it, in the size of now or in another, its number and its place; null: there is
 * none. */
function dueFrame(passed) {
  const sizes = looks.mixing ? [1] : [coarseNow(), ...SIZES.keys()];
  for (let at = passed; at > play.shown && at > passed - BEHIND; at--) {
    const number = onward(play.number, at * play.direction);
    const all = sizes.map(coarse => wishes(number, coarse)).find(one => one.every(isKnown));
    if (all?.length > 0) return { all, number, at };
  }
  return null;
}

/** Shows what is due of a film: its picture, or the error over the last one. */
function showDue({ address, lane, number }) {
  const picture = kept.get(address);
  if (picture) {
    lane.refused.delete(number);
    paint(picture);
  }
  if (!picture || lane.lastFault) showFault(lane);
}

/** Seconds since the start, by the sound's clock as soon as it is heard. */
function passedSeconds() {
  const heard = heardSeconds(), now = heard ?? performance.now() / 1000;
  if (play.isHeard !== (heard !== null)) {
    play.isHeard = heard !== null;
    play.start = now - play.passed;
  }
  play.passed = Math.max(0, now - play.start);
  return play.passed;
}

function showRate(now) {
  play.painted = play.painted.filter(time => now - time < 1000);
  const age = Math.min(play.passed, 1);
  const rate = `${(play.painted.length / age).toFixed(1)} fps`;
  setWords("rate", age > 0.5 ? `${rate} ${SIZES.get(coarseNow())}`.trim() : "");
}

const isPlaying = () => play.direction !== 0 && Boolean(state.film);

/** Frames since the start. */
const elapsedFrames = () => passedSeconds() * state.film.fps * play.speed;

/** Asks for the next pictures, and for a moment to draw if one is due. It is called again at the
 * next frame of the film, or before it, so that the sound is fed, and when a picture arrives. A
 * page that is not seen asks for nothing. */
function proceed() {
  clearTimeout(timer);
  if (!isPlaying()) return;
  const elapsed = elapsedFrames(), passed = Math.floor(elapsed);
  const rest = (passed + 1 - elapsed) / state.film.fps / play.speed; // seconds
  timer = setTimeout(proceed, Math.min(Math.ceil(rest * 1000), REST_MOST));
  if (document.hidden) return;
  askAhead(elapsed);
  askSharp();
  if (play.direction > 0) feedSound(onward(play.number, passed) - 1 + elapsed - passed);
  const now = performance.now();
  if (!(now - play.painted.at(-1) < 1000)) showRate(now); // also where there is none
  if (isTicking || !dueFrame(passed)) return;
  isTicking = true;
  requestAnimationFrame(tick);
}

/** Shows the frame that is due. */
function tick(now) {
  isTicking = false;
  const due = isPlaying() && dueFrame(Math.floor(elapsedFrames()));
  if (!due) return;
  play.shown = due.at;
  view.number = due.number;
  due.all.forEach(showDue);
  play.painted.push(now);
  showNumbers();
  followHead();
  showRate(now);
}

/** Plays on from here at another speed. */
export function setSpeed(speed) {
  play.speed = clamp(speed, 0.25, 4);
  here("speed").value = String(play.speed);
  if (play.direction !== 0) start(play.direction);
}

export function setLoop(from, to) {
  if (!state.film) return;
  loop.from = clamp(from, 1, state.film.frames);
  loop.to = clamp(to, loop.from, state.film.frames);
  if (play.direction !== 0) start(play.direction);
  showNumbers();
  drawRuler();
}

export function takeSound() {
  setSoundOf(state.film, state.build);
  write(here("mute"), "hidden", !hasSound());
  if (play.direction > 0) start(1);
}

export function swapMute() {
  const isMuted = here("mute").getAttribute("aria-pressed") !== "true";
  setPressed("mute", isMuted);
  here("mute").firstChild.replaceWith(icon(isMuted ? "muted" : "sound"));
  muteSound(isMuted);
  if (!isMuted && play.direction > 0) start(1);
}

