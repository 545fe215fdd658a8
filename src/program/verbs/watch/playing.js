// Playing: frames in time, by the clock of the sound while it is heard.
//
// While the film plays, several pictures are asked for ahead.
import { showFault } from "/faults.js";
import { showNumbers } from "/news.js";
import { abandon, failed, fetchPicture, kept, look, paint, wish } from "/pictures.js";
import * as sound from "/sound.js";
import {
  clamp, element, here, icon, isReady, lanes, loop, play, setPressed, state, view,
} from "/state.js";
import { drawRuler, followHead } from "/timeline.js";

// pictures that are requested ahead while playing, and at the same time
const AHEAD = 8, AT_ONCE = 3;
const BEHIND = 24;           // frames that a picture may be late

function go(number) {
  if (!state.film) return;
  view.number = clamp(Math.round(number) || 1, 1, state.film.frames);
  lanes().forEach(showFault);
  if (play.direction === 0) sound.tap(view.number - 1);
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
  play.isHeard = false;
  play.painted = [];
  if (direction > 0) sound.begin(view.number - 1, play.speed, loop.from - 1, loop.to - 1);
  else sound.end();
  play.shown = -1;
  showPlaying(true);
  requestAnimationFrame(tick);
}

function stop() {
  play.direction = 0;
  for (const wanted of [...asked.values()].flat()) abandon(wanted);
  sound.end();
  showPlaying(false);
  here("rate").textContent = "";
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
// Means of recent values, in seconds: between the request of a picture and its arrival, and between
// two arrivals.
const pace = { latency: 0.05, interval: 0.02, last: 0 };
const mean = (old, value) => old + 0.2 * (value - old);

function notePace(began) {
  const now = performance.now();
  pace.latency = mean(pace.latency, (now - began) / 1000);
  if (pace.last > began) pace.interval = mean(pace.interval, (now - pace.last) / 1000);
  pace.last = now;
}

/** Asks for the next pictures: for those that can be here in time, and if the film is slower than
 * its rate, only for one in `stride`, so that others are dropped evenly. passed: frames since the
 * start. */
function askAhead(passed) {
  const rate = state.film.fps * play.speed;
  const stride = clamp(Math.ceil(pace.interval * rate - 0.2), 1, AHEAD);
  const lead = Math.ceil(Math.max(0, pace.latency - pace.interval) * rate);
  const first = Math.ceil((passed + lead) / stride) * stride;
  for (let i = 0; i < AHEAD && asked.size < AT_ONCE; i++) {
    askBoth(onward(play.number, (first + i * stride) * play.direction));
  }
}

/** The lanes that play: with one whose film cannot be shown the other plays alone. */
const playing = () => lanes().filter(isReady);

const wishes = number => playing().map(one => wish(number, 1, one)).filter(Boolean);

/** Asks for a frame of all films that play, if it is not here and not on its way. */
function askBoth(number) {
  const missing = wishes(number).filter(wanted => !kept.has(wanted.address));
  if (missing.length === 0 || asked.has(number)) return;
  const began = performance.now();
  asked.set(number, missing);
  Promise.all(missing.map(wanted => fetchPicture(wanted).catch(fault => failed(fault, wanted))))
    .then(() => notePace(began)).finally(() => asked.delete(number));
}

/** The pictures that are due after that many frames, or the newest before them that have not been
 * shown: they, the frame and its place; null: there are none. */
function duePictures(passed) {
  for (let at = passed; at > play.shown && at > passed - BEHIND; at--) {
    const number = onward(play.number, at * play.direction);
    const pictures = wishes(number).map(one => kept.get(one.address));
    if (pictures.length > 0 && pictures.every(Boolean)) return { pictures, number, at };
  }
  return null;
}

/** Seconds since the start, by the sound's clock as soon as it is heard. */
function passedSeconds() {
  const heard = sound.seconds(), now = heard ?? performance.now() / 1000;
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
  here("rate").textContent = age > 0.5 ? `${(play.painted.length / age).toFixed(1)} fps` : "";
}

function tick(now) {
  if (play.direction === 0 || !state.film) return;
  const elapsed = passedSeconds() * state.film.fps * play.speed, passed = Math.floor(elapsed);
  const due = duePictures(passed);
  if (due) {
    play.shown = due.at;
    view.number = due.number;
    due.pictures.forEach(paint);
    play.painted.push(now);
    showNumbers();
    followHead();
  }
  askAhead(passed);
  if (play.direction > 0) sound.feed(onward(play.number, passed) - 1 + elapsed - passed);
  showRate(now);
  requestAnimationFrame(tick);
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
  sound.takeFilm(state.film, state.build);
  here("mute").hidden = !sound.hasSound();
  if (play.direction > 0) start(1);
}

export function swapMute() {
  const isMuted = here("mute").getAttribute("aria-pressed") !== "true";
  setPressed("mute", isMuted);
  here("mute").firstChild.replaceWith(icon(isMuted ? "muted" : "sound"));
  sound.mute(isMuted);
  if (!isMuted && play.direction > 0) start(1);
}

