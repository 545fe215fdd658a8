// The page of celspan watch. One file, because its parts share the view and the wishes.
//
//   /state.json ---news--> film, errors          keys, wheel, buttons --> view, frame
//                            \                      /
//                             what is wanted: frame, size, crop --> /frame/N.runs --> #stage
//
// Pictures are wanted one after the other: while one is on its way, only the newest wish is kept.
// While the film plays, several are asked for ahead.
import * as cost from "/cost.js";
import { fetch } from "/fetch.js";
import * as sound from "/sound.js";
import { unpack } from "/runs.js";

const here = id => document.getElementById(id);
const stage = here("stage"), desk = here("desk");
const overlay = here("overlay");
const SIDE_MOST = 1048576;   // pixels of a frame
const KEPT_MOST = 192 << 20; // bytes of pictures that are kept
// pictures that are requested ahead while playing, and at the same time
const AHEAD = 8, AT_ONCE = 3;
const BEHIND = 24;           // frames that a picture may be late
// seconds after which a picture is slow: then a coarse picture is shown first
const SLOW = 0.15;
const VERY_SLOW = 1;         // seconds after which the coarse picture is made coarser still
const STRIDE = 80;           // device pixels that a key moves the picture
const GUIDES = ["safe", "fields"]; // shown over the picture, one at a time
const FIELDS = 12;           // of a field guide: rectangles around its middle
const FAULT_FRAMES = 6;      // frames of one fault that are listed
const THUMB = 160;           // CSS pixels, the longer side of the picture over the scrubber

const state = { news: 0, build: 0, film: null, errors: [], shown: false, parameters: [],
                second: null };
// number: of the frame, from 1. scale: device pixels of a unit of the film; x, y: the place of the
// frame's corner in the window, in device pixels. isFitted: scale and place follow the window.
const view = { number: 1, scale: 1, x: 0, y: 0, isFitted: true };
const loop = { from: 1, to: 1 };
// start: by the clock of the sound while the sound is heard, otherwise by the machine's clock, in
// seconds.
const play = { direction: 0, speed: 1, start: 0, isHeard: false, passed: 0, number: 1, shown: -1,
               painted: [] };
let isMatte = false, mark = null;

/** What is known of one of the films and its canvas. refused: the frame that could not be made,
 * { number, build, message }. lastFault: the error that is shown. painted: the picture. slowness:
 * the seconds that it took. fetching: the picture that is on its way, { wanted, since }. given: values of parameters, as the address holds them. */
const lane = (side, canvas, box) => ({
  side, canvas, box, pen: canvas.getContext("2d"), painted: null, refused: null, lastFault: null,
  isAsking: false, isWanted: false, slowness: 0, fetching: null, given: new URLSearchParams(), isGiven: false,
  isSending: false, isChanged: false, formOf: "",
});
const main = lane(1, stage, desk), beside = lane(2, here("stage2"), here("desk2"));

/** What the server has said of a lane's film; null: it is not shown. */
const stateOf = one => one === main ? state : state.second;
const isComparing = () => Boolean(state.second);
const lanes = () => isComparing() ? [main, beside] : [main];

/** An element of a lane: those of the second have a 2 after their names. */
const part = (one, id) => here(one === main ? id : `${id}2`);

// ---------------------------------------------------------------- the view

const ratio = () => window.devicePixelRatio || 1;
const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

// in CSS pixels; asking the page for it while a film plays would cost layouts
let deskSize = [1, 1];

const windowSize = () => deskSize.map(side => Math.max(1, Math.round(side * ratio())));

/** The size of the whole frame in device pixels. The second film is as wide as the first. */
function frameSize(one = main) {
  const size = stateOf(one).film.size, scale = view.scale * state.film.size[0] / size[0];
  return size.map(side => clamp(Math.round(side * scale), 1, SIDE_MOST));
}

function fit() {
  if (!state.film) return;
  const [w, h] = windowSize(), size = state.film.size;
  const margin = document.body.classList.contains("alone") ? 0 : 16 * ratio();
  view.isFitted = true;
  view.scale = Math.min(Math.max(1, w - 2 * margin) / size[0], Math.max(1, h - 2 * margin) / size[1],
                        SIDE_MOST / Math.max(...size));
  const whole = frameSize();
  view.x = Math.floor((w - whole[0]) / 2);
  view.y = Math.floor((h - whole[1]) / 2);
}

/** Zooms about a point of the window, in device pixels. */
function zoom(factor, x, y) {
  if (!state.film) return;
  const most = SIDE_MOST / Math.max(...state.film.size), least = 8 / Math.max(...state.film.size);
  const scale = clamp(view.scale * factor, least, most), change = scale / view.scale;
  view.isFitted = false;
  view.scale = scale;
  view.x = Math.round(x - (x - view.x) * change);
  view.y = Math.round(y - (y - view.y) * change);
  look();
}

function move(dx, dy) {
  view.isFitted = false;
  view.x += Math.round(dx);
  view.y += Math.round(dy);
  look();
}

/** The part of the frame that is in the window; null: none is. */
function visible(one = main) {
  const [w, h] = windowSize(), [fw, fh] = frameSize(one);
  const x = clamp(-view.x, 0, fw), y = clamp(-view.y, 0, fh);
  const right = clamp(w - view.x, 0, fw), bottom = clamp(h - view.y, 0, fh);
  return right > x && bottom > y ? [x, y, right - x, bottom - y] : null;
}

// ---------------------------------------------------------------- pictures

const kept = new Map(); // by their addresses, the oldest first
// by the number of the frame: a text that is the same for the same camera
const cameras = new Map();
let keptBytes = 0;

function keep(address, picture) {
  kept.set(address, picture);
  keptBytes += picture.bytes.byteLength;
  for (const [old, one] of kept) {
    if (keptBytes <= KEPT_MOST) break;
    kept.delete(old);
    keptBytes -= one.bytes.byteLength;
  }
}

/** Forgets the pictures of a film. */
function forget(one) {
  if (one === main) cameras.clear();
  for (const [address, picture] of kept) {
    if (picture.lane !== one) continue;
    kept.delete(address);
    keptBytes -= picture.bytes.byteLength;
  }
}

/** The number in its film of the frame that a lane shows with a frame of the first: of the same
 * time, or the last. */
function nameOf(one, number) {
  const film = stateOf(one).film;
  const index = one === main ? number - 1 : Math.floor((number - 1) / state.film.fps * film.fps + 1e-6);
  return film.first + Math.min(index, film.frames - 1);
}

/** The part of a frame that is visible. coarse: that many pixels are one, in each direction. */
function wish(number, coarse = 1, one = main) {
  const crop = visible(one), build = stateOf(one).build;
  if (!crop) return null;
  let size = frameSize(one), part = crop;
  if (coarse > 1) {
    size = size.map(side => Math.max(1, Math.round(side / coarse)));
    const x = Math.floor(crop[0] / coarse), y = Math.floor(crop[1] / coarse);
    part = [Math.min(x, size[0] - 1), Math.min(y, size[1] - 1)];
    part.push(clamp(Math.ceil(crop[2] / coarse), 1, size[0] - part[0]),
              clamp(Math.ceil(crop[3] / coarse), 1, size[1] - part[1]));
  }
  const address = `/frame/${nameOf(one, number)}.runs?size=${size.join("x")}&crop=${part.join()}`
    + `&build=${build}${one === main ? cels.query : "&side=2"}`;
  return { number, size, crop: part, address, build, lane: one };
}

const pageName = Math.random().toString(36).slice(2);
let wishes = 0;

async function fetchPicture(wanted) {
  const known = kept.get(wanted.address);
  if (known) return known;
  wanted.name = `${pageName}-${++wishes}`;
  const answer = await fetch(`${wanted.address}&wish=${wanted.name}`);
  wanted.isHere = true;
  if (!answer.ok) throw Object.assign(new Error(await answer.text()), { status: answer.status });
  const buffer = await answer.arrayBuffer(), [, , w, h] = wanted.crop;
  const picture = { ...wanted, bytes: wanted.isOver ? new Uint8ClampedArray(buffer) : unpack(buffer, w, h),
                    seconds: Number(answer.headers.get("Celspan-Seconds")),
                    camera: answer.headers.get("Celspan-Camera") };
  if (!wanted.isOver && wanted.lane === main && wanted.build === state.build) {
    cost.noteTime(picture.number, picture.seconds, picture.build);
    if (!wanted.isSeen) cameras.set(picture.number, picture.camera);
  }
  if (wanted.build === stateOf(wanted.lane)?.build) keep(wanted.address, picture);
  return picture;
}

/** The coverage alone, as grey. */
function matteOf(bytes) {
  const out = new Uint8ClampedArray(bytes.length);
  for (let i = 0; i < bytes.length; i += 4) {
    out[i] = out[i + 1] = out[i + 2] = bytes[i + 3];
    out[i + 3] = 255;
  }
  return out;
}

/** Puts a picture on the canvas of its lane; bytes: its own, or others in their place. */
function put(picture, bytes) {
  const one = picture.lane, [, , w, h] = picture.crop, canvas = one.canvas;
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  one.pen.putImageData(new ImageData(isMatte ? matteOf(bytes) : bytes, w, h), 0, 0);
  one.painted = picture;
  canvas.dataset.frame = nameOf(one, picture.number);
  canvas.dataset.size = picture.size.join("x");
  canvas.dataset.crop = picture.crop.join();
  canvas.dataset.build = picture.build;
  canvas.setAttribute("aria-label", `Frame ${picture.number}`);
}

function paint(picture) {
  if (picture.lane === beside) {
    if (!isReady(beside)) return null;
    put(picture, picture.bytes);
    if (mixing && !held && main.painted) paint(main.painted);
    return place();
  }
  keepOlder(picture);
  put(picture, withOnion(picture, mixed(picture)));
  overlay.hidden = overlay.dataset.over !== picture.address + overlays() || play.direction !== 0;
  place();
}

/** Puts what is painted where the view has it now, stretched if it was made for another one. */
function place() {
  if (!state.film) return;
  for (const one of lanes()) placeLane(one, one === main ? [here("paper"), stage, overlay]
    : [here("paper2"), one.canvas]);
}

function placeLane(one, layers) {
  const painted = one.painted, r = ratio();
  if (!painted) return;
  const whole = frameSize(one);
  const sx = whole[0] / painted.size[0] / r, sy = whole[1] / painted.size[1] / r;
  const [x, y, w, h] = painted.crop;
  for (const guide of GUIDES) {
    Object.assign(part(one, guide).style, { left: `${view.x / r}px`, top: `${view.y / r}px`,
                                            width: `${whole[0] / r}px`, height: `${whole[1] / r}px` });
  }
  for (const layer of layers) {
    Object.assign(layer.style, { left: `${view.x / r + x * sx}px`, top: `${view.y / r + y * sy}px`,
                                  width: `${w * sx}px`, height: `${h * sy}px` });
  }
}

// ---------------------------------------------------------------- one picture after the other

/** Wants the picture of the view as it is now. */
function look() {
  if (view.isFitted) fit();
  place();
  showNumbers();
  for (const one of lanes()) {
    one.isWanted = true;
    if (!one.isAsking && isReady(one)) ask(one);
    else abandonOld(one);
  }
}

const isReady = one => Boolean(stateOf(one)?.film && stateOf(one).shown);
const pause = seconds => new Promise(done => setTimeout(done, seconds * 1000));

async function ask(one) {
  one.isAsking = true;
  while (one.isWanted && isReady(one)) {
    one.isWanted = false;
    const fine = wish(view.number, 1, one);
    if (!fine) break;
    try {
      const picture = await fetchBest(fine);
      if (picture) await takeBest(picture);
    } catch (fault) {
      await failed(fault, fine);
    }
    one.fetching = null;
  }
  one.isAsking = false;
}

/** Fetches a picture, and before it a coarse one if it is slow, or was at last; null: another one is
 * wanted by then. */
async function fetchBest(fine) {
  const one = fine.lane, isSlow = one.slowness > SLOW && play.direction === 0;
  if (isSlow && !kept.has(fine.address)) {
    paint(await fetchPicture(wish(fine.number, one.slowness > VERY_SLOW ? 8 : 4, one)));
    await new Promise(requestAnimationFrame);
    if (one.isWanted) return null;
  }
  one.fetching = { wanted: fine, since: performance.now() / 1000 };
  const arrival = fetchPicture(fine);
  if (!isSlow) paintMeanwhile(fine, arrival);
  return arrival;
}

/** Paints a coarse picture if a fine one does not arrive soon. */
async function paintMeanwhile(fine, arrival) {
  const one = fine.lane, coarse = wish(fine.number, 4, one), isOver = () => one.fetching?.wanted !== fine;
  const has = arrival.then(() => true, () => true);
  if (await Promise.race([has, pause(SLOW)]) || isOver() || play.direction !== 0 || !coarse) return;
  has.then(() => abandon(coarse));
  const picture = await fetchPicture(coarse).catch(() => null);
  if (picture && !isOver() && fine.build === stateOf(one)?.build) paint(picture);
}

async function takeBest(picture) {
  const one = picture.lane;
  one.slowness = picture.seconds;
  one.fetching = null;
  paint(picture);
  one.refused = null;
  showFault(one);
  if (one === main) await addTo(picture);
}

/** Has the server give up a picture that it has not answered. */
function abandon(wanted) {
  if (!wanted.name || wanted.isHere) return;
  post(`/abandon?side=${wanted.lane.side}`, { wish: wanted.name }).catch(() => {});
}

/** Gives up the picture that is on its way if it is slow, and not the one that is wanted now. */
async function abandonOld(one) {
  const old = one.fetching;
  if (!old || old.isLeft) return;
  old.isLeft = true;
  await pause(old.since + SLOW - performance.now() / 1000);
  old.isLeft = false;
  if (one.fetching !== old || wish(view.number, 1, one)?.address === old.wanted.address) return;
  old.isLeft = true;
  abandon(old.wanted);
}

/** What is shown with a picture of the first film. */
async function addTo(picture) {
  await addOthers(picture);
  await layOver(picture);
  await loadCosts(picture);
}

/** A picture that was not made: what the film says of it is among the errors; what was busy is
 * asked again. */
async function failed(fault, wanted) {
  const one = wanted.lane;
  if (fault.status === 422) {
    one.refused = { number: wanted.number, build: wanted.build, message: fault.message.trim() };
    return showFault(one);
  }
  if (!one.isWanted) await pause(0.3);
  if (fault.status === 503) one.isWanted = true;
}

// ---------------------------------------------------------------- playing

function go(number) {
  if (!state.film) return;
  view.number = clamp(Math.round(number) || 1, 1, state.film.frames);
  lanes().forEach(showFault);
  if (play.direction === 0) sound.tap(view.number - 1);
  look();
}

function step(by) {
  stop();
  go(view.number + by);
}

function start(direction) {
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
  here("play").textContent = "❚❚";
  here("play").setAttribute("aria-label", "Pause");
  requestAnimationFrame(tick);
}

function stop() {
  play.direction = 0;
  for (const wanted of [...asked.values()].flat()) abandon(wanted);
  sound.end();
  here("play").textContent = "▶";
  here("play").setAttribute("aria-label", "Play");
  here("rate").textContent = "";
}

function toggle() {
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

/** Asks for a frame of all films that play, if it is not here and not on its way. */
function askBoth(number) {
  const all = playing().map(one => wish(number, 1, one)).filter(Boolean);
  const missing = all.filter(wanted => !kept.has(wanted.address));
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
    const wanted = playing().map(one => wish(number, 1, one)).filter(Boolean);
    const pictures = wanted.map(one => kept.get(one.address));
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
  }
  askAhead(passed);
  if (play.direction > 0) sound.feed(onward(play.number, passed) - 1 + elapsed - passed);
  showRate(now);
  requestAnimationFrame(tick);
}

/** Plays on from here at another speed. */
function setSpeed(speed) {
  play.speed = clamp(speed, 0.25, 4);
  here("speed").value = String(play.speed);
  if (play.direction !== 0) start(play.direction);
}

function setLoop(from, to) {
  loop.from = clamp(from, 1, state.film.frames);
  loop.to = clamp(to, loop.from, state.film.frames);
  if (play.direction !== 0) start(play.direction);
  showNumbers();
}

// ---------------------------------------------------------------- what is shown beside the picture

function showNumbers() {
  if (!state.film) return;
  here("frame").textContent = view.number;
  here("frames").textContent = state.film.frames;
  here("scrub").max = state.film.frames;
  here("scrub").value = view.number;
  placeHead();
  const percent = view.scale * 100;
  here("zoom").textContent = `${percent < 10 ? percent.toFixed(1) : Math.round(percent)} %`;
  const whole = loop.from === 1 && loop.to === state.film.frames;
  const [w, h] = state.film.size;
  here("facts").textContent = `${w} × ${h}, ${state.film.fps} fps`
    + (whole ? "" : `, loop ${loop.from} to ${loop.to}`);
}

/** The error of a film, or of the frame that is shown; null: neither. */
function currentFault(one = main) {
  const { shown, errors, build } = stateOf(one), refused = one.refused;
  if (!shown) return errors[0] || null;
  if (refused && refused.number === view.number && refused.build === build) {
    return errors.find(known => known.message === refused.message) || refused;
  }
  // false until there is a picture
  return one.painted && one.painted.build === build ? null : one.lastFault;
}

/** Shows the error over the last good picture. */
function showFault(one = main) {
  if (!stateOf(one)) return; // it is no longer shown
  const fault = one.lastFault = currentFault(one);
  part(one, "fault").hidden = part(one, "error").hidden = !fault;
  part(one, "error").textContent = fault ? fault.message : "";
  const called = fault && fault.callers || [];
  const all = fault && fault.file ? [{ file: fault.file, line: fault.line }, ...called] : called;
  const names = all.map(({ file, line }) => `${file}:${line}`).join(" ← ");
  part(one, "lines").replaceChildren(...state.editor ? placesOf(names, all) : []);
  part(one, "excerpt").replaceChildren(...(fault && fault.lines || []).map(([number, text]) => {
    const line = document.createElement(number === fault.line ? "b" : "span");
    line.textContent = `${String(number).padStart(4)}  ${text}\n`;
    return line;
  }));
  one.canvas.classList.toggle("old", Boolean(fault));
  showNews();
}

/** Shows or hides one of the panels beside the picture; button: the name of that which does it. */
function showPanel(id, button, isOn) {
  const panel = here(id), wasOn = !panel.hidden;
  panel.hidden = !isOn;
  here(button).setAttribute("aria-pressed", isOn);
  if (isOn && !wasOn) panel.scrollIntoView({ block: "nearest" });
}

function showState() {
  const film = state.film;
  document.title = `${film && film.title || state.script} – celspan`;
  here("title").textContent = film && film.title || state.script;
  showNews();
  for (const one of lanes()) {
    if (!stateOf(one).building) showFault(one);
  }
}

/** What the film is doing, and how many faults a check has found. */
function showNews() {
  const bad = groupFaults().length;
  here("news").textContent = state.building && state.seconds > 0.5 ? "building …"
    : bad && state.shown && !currentFault() ? `${bad} fault${bad === 1 ? "" : "s"}: ${state.errors[0].message}` : "";
}

// ---------------------------------------------------------------- faults of all frames

/** The errors of the film, those of one text together: { text, frames, all }. */
function groupFaults() {
  const groups = new Map();
  for (const fault of state.errors) {
    const text = fault.message.replace(`frame ${fault.frame}: `, "");
    if (!groups.has(text)) groups.set(text, { text, frames: [], fault });
    if (fault.frame !== undefined) groups.get(text).frames.push(fault.frame);
  }
  return [...groups.values()];
}

/** One of those as an item of the list, with ways to its frames and its line. */
function faultItem({ text, frames, fault }) {
  const item = element("li", { textContent: text }), ways = element("p", {});
  if (fault.file && state.editor) {
    const textContent = `${fault.file}:${fault.line}`;
    ways.append(element("button", { textContent, onclick: () => post("/open", fault) }));
  }
  const sorted = frames.sort((a, b) => a - b);
  ways.append(...sorted.slice(0, FAULT_FRAMES).map(name => {
    const onclick = () => { stop(); go(name - state.film.first + 1); };
    return element("button", { textContent: `frame ${name}`, onclick });
  }));
  const more = frames.length - FAULT_FRAMES;
  if (more > 0) ways.append(element("small", { textContent: `and ${more} more up to ${sorted.at(-1)}` }));
  if (ways.hasChildNodes()) item.append(ways);
  return item;
}

/** How far the check is. */
function checkedText(count) {
  const { film, checked, checking, shown } = state;
  if (!shown) return "";
  const frames = `${checked} frame${checked === 1 ? "" : "s"} checked`;
  return checking ? `${checked} of ${film.frames} frames checked` : `${frames}${count ? "" : ": no faults"}`;
}

let listed = ""; // the faults in the list: the focus stays in a list that has not changed

function showFaults() {
  const groups = groupFaults(), kinds = JSON.stringify([state.errors, state.editor]);
  here("check").textContent = groups.length ? `Faults ${groups.length}` : "Faults";
  here("check").classList.toggle("bad", groups.length > 0);
  here("checked").textContent = checkedText(groups.length);
  if (kinds === listed) return;
  listed = kinds;
  here("fault-list").replaceChildren(...groups.map(faultItem));
}

function setChecking(isOn) {
  showPanel("faults", "check", isOn);
}

// ---------------------------------------------------------------- news

/** Whether a film was saved, or failed, since the old news of it. */
const isNewFilm = (old, news) => news && (!old || old.build !== news.build || old.shown !== news.shown);

function takeState(news) {
  const old = { ...state }, { film } = old;
  Object.assign(state, { film: null }, news, { film: news.film || film, second: news.second || null });
  document.body.classList.toggle("alone", news.alone);
  showComparing();
  lanes().forEach(showForm);
  sendGiven();
  if (state.film && (!film || film.frames !== state.film.frames)) takeFrames(!film);
  if (state.here && state.here.count !== outlined.count) outline(state.here);
  showState();
  showFaults();
  loadSheet();
  if (isNewFilm(old.second, state.second)) forget(beside);
  if (isNewFilm(old, state)) takeFilm();
  else if (isNewFilm(old.second, state.second)) look();
}

/** The film has another number of frames than before. */
function takeFrames(isFirst) {
  loop.from = 1;
  loop.to = state.film.frames;
  view.number = clamp(view.number, 1, state.film.frames);
  if (isFirst && state.alone) start(1);
}

/** The film was saved, or has failed. */
function takeFilm() {
  takeSound();
  forget(main);
  if (outlined.place) outline(outlined.place);
  if (state.shown) look();
}

async function listen() {
  for (;;) {
    try {
      const answer = await fetch(`/state.json?since=${state.news}`);
      if (answer.status === 403) { // the opened address has no token
        here("news").textContent = await answer.text();
        return;
      }
      if (!answer.ok) throw new Error(await answer.text());
      takeState(await answer.json());
    } catch {
      here("news").textContent = "celspan watch has ended; start it again, and open its new address";
      await new Promise(done => setTimeout(done, 1000));
    }
  }
}

// ---------------------------------------------------------------- values of parameters

const post = (path, value) => fetch(path, { method: "POST", body: JSON.stringify(value) });
// The address contains the values by name. A mark precedes those of the second film, and shows by
// itself that the second film is visible.
const MARK = "2:";

function readAddress() {
  for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
    const one = name.startsWith(MARK) ? beside : main;
    if (name !== MARK) one.given.set(one === beside ? name.slice(MARK.length) : name, value);
    else post("/compare", { on: true }).catch(() => {});
  }
}

function writeAddress() {
  const all = new URLSearchParams(main.given);
  if (isComparing() && !state.has_two) all.set(MARK, "");
  if (isComparing()) for (const [name, value] of beside.given) all.set(MARK + name, value);
  history.replaceState(null, "", all.size ? `/#${all}` : "/");
}

/** Sends the values; while they are on their way, only the newest are kept. */
async function sendValues(one) {
  one.isChanged = true;
  if (one.isSending) return;
  one.isSending = true;
  while (one.isChanged) {
    one.isChanged = false;
    writeAddress();
    const path = one === main ? "/parameters" : "/parameters?side=2";
    await post(path, Object.fromEntries(one.given)).catch(() => {});
  }
  one.isSending = false;
}

/** Sends the values of the address as soon as a film can take them. */
function sendGiven() {
  for (const one of lanes()) {
    if (one.isGiven || !isReady(one)) continue;
    one.isGiven = true;
    if (one.given.size) sendValues(one);
  }
}

function giveValue(one, parameter, value) {
  one.given.set(parameter.name, value);
  parameter.value = value;
  showCommand();
  nameLanes();
  sendValues(one);
}

const quoted = text => /^[\w.,:=/#-]+$/.test(text) ? text
  : `'${text.replaceAll("'", "'\\''")}'`;

const commandOf = (one, output) => {
  const { parameters, script } = stateOf(one);
  const changed = parameters.filter(known => known.value !== String(known.default));
  const sets = changed.map(known => ` --set ${quoted(`${known.name}=${known.value}`)}`).join("");
  return `celspan render ${quoted(script)}${sets} -o ${output}.####.png`;
};

function showCommand() {
  here("command").value = commandOf(main, "shot")
    + (isComparing() ? `\n${commandOf(beside, "other")}` : "");
}

function element(name, properties) { return Object.assign(document.createElement(name), properties); }

/** Puts the files that a parameter may name into its list. The film's folder may have new ones. */
async function listFiles(choice, one, parameter) {
  const query = new URLSearchParams({ parameter: parameter.name, side: one.side });
  const answer = await fetch(`/files.json?${query}`).catch(() => null);
  if (!answer || !answer.ok) return;
  const names = [...new Set([choice.value, ...await answer.json()])].sort();
  const old = [...choice.options].map(option => option.value);
  if (old.join("\n") === names.join("\n")) return;
  const { value } = choice;
  choice.replaceChildren(...names.map(textContent => element("option", { textContent })));
  choice.value = value;
}

/** What a parameter is changed with. */
function control(one) {
  if (one.enum) {
    const choice = element("select", {});
    choice.append(...one.enum.map(text => element("option", { textContent: text })));
    choice.value = one.value;
    return choice;
  }
  if (one.format === "path") {
    const choice = element("select", {});
    choice.append(element("option", { textContent: one.value }));
    return choice;
  }
  if (one.type === "boolean") {
    return element("input", { type: "checkbox", checked: one.value === "true" });
  }
  if (one.type === "number" && one.minimum !== undefined && one.maximum !== undefined) {
    const { minimum: min, maximum: max } = one;
    return element("input", { type: "range", min, max, step: "any", value: one.value });
  }
  const isColour = one.format === "color" && /^#[0-9a-f]{6}$/i.test(one.value);
  return element("input", { type: isColour ? "color" : "text", value: one.value });
}

function field(one, parameter) {
  const label = element("label", { title: parameter.description || "" });
  const input = control({ ...parameter, value: one.given.get(parameter.name) ?? parameter.value });
  const shown = element("output", { textContent: input.type === "range" ? parameter.value : "" });
  const isText = input.type === "text" || input.type === "range";
  label.className = input.type === "range" ? "range" : isText ? "" : "row";
  label.append(element("span", { textContent: parameter.name }), input);
  if (input.type === "range") label.append(shown);
  if (parameter.format === "path") {
    const list = () => listFiles(input, one, parameter);
    list();
    for (const event of ["focus", "pointerenter"]) input.addEventListener(event, list);
  }
  input.addEventListener(input.type === "text" ? "change" : "input", () => {
    const value = input.type === "checkbox" ? String(input.checked)
      : input.type === "range" ? String(Number(Number(input.value).toPrecision(4))) : input.value;
    if (input.type === "range") shown.textContent = value;
    // Later news may have replaced the list.
    giveValue(one, stateOf(one).parameters.find(known => known.name === parameter.name) || parameter,
              value);
  });
  return label;
}

/** Makes the form of a film again if it has other parameters than before. */
function showForm(one) {
  const { parameters } = stateOf(one);
  const kinds = JSON.stringify(parameters.map(known => ({ ...known, value: null })));
  here("tune").hidden = lanes().every(any => stateOf(any).parameters.length === 0);
  showCommand();
  if (kinds === one.formOf) return;
  one.formOf = kinds;
  part(one, "form").replaceChildren(...parameters.map(known => field(one, known)));
}

function setTuning(isOn) {
  showPanel("values", "tune", isOn);
}

function takeDefaults() {
  for (const one of lanes()) {
    for (const name of [...one.given.keys()]) one.given.delete(name);
    one.formOf = "";
    sendValues(one);
  }
}

// ---------------------------------------------------------------- two films

// isOn: the last wish; null after it was fulfilled. sent: resolved when the server has received all
// wishes.
const comparing = { isOn: null, sent: Promise.resolve() };

/** The second film beside the first: that of the second script, or the same with other values, which
 * are those of the first to begin with. */
function swapComparing() {
  const isOn = comparing.isOn = !(comparing.isOn ?? isComparing());
  if (isOn && beside.given.size === 0 && !state.has_two) {
    for (const [name, value] of main.given) beside.given.set(name, value);
  }
  if (isOn && !state.has_two) setTuning(true);
  comparing.sent = comparing.sent.then(() => post("/compare", { on: isOn })).catch(() => {});
}

/** What the pictures are called: their scripts, or the values in which they differ. */
function nameLanes() {
  const names = one => {
    const other = stateOf(one === main ? beside : main).parameters;
    const own = stateOf(one).parameters.filter((known, i) => known.value !== other[i]?.value);
    return own.map(known => `${known.name} ${known.value}`).join(", ") || "the same values";
  };
  for (const one of isComparing() ? lanes() : []) {
    part(one, "caption").textContent = state.has_two ? stateOf(one).script : names(one);
  }
}

function showComparing() {
  const isOn = isComparing(), wasOn = !beside.box.hidden;
  if (comparing.isOn === isOn) comparing.isOn = null;
  const canCompare = state.has_two || state.parameters.length > 0;
  for (const id of ["desk2", "caption", "caption2", "beside"]) here(id).hidden = !isOn;
  here("compare").hidden = !canCompare;
  here("compare").setAttribute("aria-pressed", isOn);
  here("beside-title").textContent = state.has_two ? `Values of ${state.second?.script}`
    : "Compare with these values";
  nameLanes();
  if (isOn === wasOn) return;
  Object.assign(beside, { painted: null, isGiven: false, formOf: "" });
  forget(beside);
  writeAddress();
}

// ---------------------------------------------------------------- the sound

/** Takes the sound of a save; a film that plays continues with the new one. */
function takeSound() {
  sound.takeFilm(state.film, state.build);
  here("mute").hidden = !sound.hasSound();
  if (play.direction > 0) start(1);
}

function swapMute() {
  const isMuted = here("mute").getAttribute("aria-pressed") !== "true";
  here("mute").setAttribute("aria-pressed", isMuted);
  sound.mute(isMuted);
  if (!isMuted && play.direction > 0) start(1);
}

// ---------------------------------------------------------------- the sheet

const ROW = 20, WAVE = 44, STRIP = 32; // CSS pixels
const WAVE_COLUMNS = 2000;
const sheet = { rows: [], lips: [], columns: [], frames: 1, build: 0 };

/** Asks for the sheet if it is open and older than the film. */
async function loadSheet() {
  if (here("sheet").hidden || !state.shown || sheet.build === state.build) return;
  const build = sheet.build = state.build;
  const answers = await Promise.all([fetch(`/sheet.json?build=${build}`),
                                     fetch(`/wave.json?columns=${WAVE_COLUMNS}&build=${build}`)]);
  for (const answer of answers) {
    const part = answer.ok ? await answer.json() : {};
    if (build !== state.build) return;
    Object.assign(sheet, part);
  }
  nameRows();
  drawSheet();
}

/** Whether a row for the sound and the marks is below the others. */
const hasWave = () => sheet.columns.length > 0 || state.film.marks.length > 0;

function nameRows() {
  const item = (name, className) => {
    const one = element("li", { title: name, className });
    one.append(element("span", { textContent: name }));
    return one;
  };
  const last = sheet.columns.length > 0 ? "sound" : "marks";
  here("names").replaceChildren(...sheet.rows.map(row => {
    const one = item(row.name, "");
    if (row.cel) one.append(...Object.entries(SWITCHES).map(([letter, what]) =>
      celSwitch(row.name, letter, what)));
    return one;
  }), ...sheet.lips.map(row => item(row.name, "lips")), ...hasWave() ? [item(last, "wave")] : [],
  ...here("costs").hidden ? [] : [item("milliseconds", "strip")]);
}

// ---------------------------------------------------------------- cels in another way

// The letters of /frame/N, and s: all other cels are hidden.
const SWITCHES = { s: "solo", h: "hidden", l: "light off", f: "focus off" };
const cels = { letters: {}, query: "" }; // letters: by the names of the cels

/** A button that changes how one cel is shown. */
function celSwitch(name, letter, what) {
  const isOn = (cels.letters[name] || "").includes(letter);
  const button = element("button", { textContent: letter.toUpperCase(), title: `${name}: ${what}`,
                                     ariaLabel: `${name}: ${what}`, ariaPressed: isOn });
  button.onclick = () => {
    const old = cels.letters[name] || "", has = old.includes(letter);
    cels.letters[name] = has ? old.replace(letter, "") : old + letter;
    button.ariaPressed = !has;
    queryCels();
    look();
  };
  return button;
}

/** The part of the address that says how cels are shown. */
function queryCels() {
  const hasSolo = Object.values(cels.letters).some(letters => letters.includes("s"));
  const shown = {};
  for (const row of sheet.rows.filter(one => one.cel)) {
    const letters = cels.letters[row.name] || "";
    const all = letters.replace("s", "") + (hasSolo && !letters.includes("s") ? "h" : "");
    if (all) shown[row.name] = all;
  }
  const isPlain = Object.keys(shown).length === 0;
  cels.query = isPlain ? "" : `&cels=${encodeURIComponent(JSON.stringify(shown))}`;
}

/** The sound from y on, as far as it goes from silence, and the marks over it. */
function drawWave(brush, y, width, colours) {
  const step = width / Math.max(1, sheet.columns.length), unit = width / sheet.frames;
  brush.fillStyle = colours.quiet;
  sheet.columns.forEach((height, i) => {
    const half = Math.max(0.5, height / 255 * (WAVE / 2 - 2));
    brush.fillRect(i * step, y + WAVE / 2 - half, Math.max(step, 0.5), 2 * half);
  });
  for (const mark of state.film.marks) {
    const x = (mark.frame - state.film.first) * unit;
    brush.fillStyle = colours.dot;
    brush.fillRect(x, y, 1, WAVE);
    brush.fillStyle = colours.text;
    brush.fillText(mark.name, x + 4, y + 11);
  }
}

/** A row of the sheet: a box for each drawing as long as it is held, a dot where it only moves. */
function drawRow(brush, row, y, unit, colours) {
  row.cells.forEach(([from, name], i) => {
    const until = i + 1 < row.cells.length ? row.cells[i + 1][0] : sheet.frames + 1;
    const x = (from - 1) * unit, width = (until - from) * unit;
    if (!name) return;
    brush.fillStyle = i % 2 ? colours.odd : colours.even;
    brush.fillRect(x, y + 2, Math.max(1, width - (width > 3 ? 1 : 0)), ROW - 4);
    brush.fillStyle = colours.text;
    if (width > 8 + 7 * name.length) brush.fillText(name, x + 4, y + 14);
  });
  brush.fillStyle = colours.dot;
  for (const frame of row.moved || []) {
    brush.fillRect((frame - 0.5) * unit - 1, y + ROW - 5, Math.min(2, Math.max(1, unit)), 2);
  }
}

function drawSheet() {
  const canvas = here("rows"), width = here("cells").clientWidth, r = ratio();
  const rows = [...sheet.rows, ...sheet.lips], brush = canvas.getContext("2d");
  const wave = state.film && hasWave() ? WAVE : 0, strip = here("costs").hidden ? 0 : STRIP;
  const height = Math.max(1, rows.length) * ROW + wave + strip, unit = width / sheet.frames;
  const style = getComputedStyle(document.documentElement);
  const colour = name => style.getPropertyValue(name);
  canvas.width = Math.round(width * r);
  canvas.height = Math.round(height * r);
  canvas.style.height = `${height}px`;
  brush.scale(r, r);
  brush.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  const colours = { odd: colour("--line"), even: colour("--press"), text: colour("--text"),
                    dot: colour("--accent"), quiet: colour("--light"), slow: colour("--slow") };
  rows.forEach((row, i) => drawRow(brush, row, i * ROW, unit, colours));
  if (wave) drawWave(brush, rows.length * ROW, width, colours);
  if (strip) cost.drawStrip(brush, height - STRIP, STRIP, unit, 1 / state.film.fps, colours);
  brush.fillStyle = colours.dot;
  for (const [from, to] of outlined.runs) {
    const x = (from - state.film.first) * unit;
    brush.fillRect(x, 0, Math.max(2, (to - from + 1) * unit), 3);
  }
  placeHead();
}

function placeHead() {
  if (here("sheet").hidden) return;
  const unit = here("cells").clientWidth / sheet.frames;
  here("head").style.left = `${Math.min(view.number, sheet.frames) * unit - unit / 2 - 1}px`;
}

function setSheet(isOn) {
  here("sheet").hidden = !isOn;
  here("list").setAttribute("aria-pressed", isOn);
  if (!isOn) return;
  drawSheet();
  loadSheet();
}

function goBySheet(event) {
  const box = here("rows").getBoundingClientRect();
  stop();
  go(Math.floor((event.clientX - box.left) / box.width * sheet.frames) + 1);
}

// ---------------------------------------------------------------- two pictures

let older = null;           // the picture at this place before the last save
// the frame that others are compared with; 0: the frame before the last save
let held = 0;
let mixing = "";            // "", "wipe" or "differ"
const DIFFERENCE_GAIN = 4;  // so that small differences can be seen

/** Whether two pictures show the same part of the same frame. */
const isSamePlace = (a, b) => a && b && a.number === b.number
  && a.size.join() === b.size.join() && a.crop.join() === b.crop.join();

/** Keeps the picture that is painted when one of another save takes its place. */
function keepOlder(picture) {
  if (main.painted && main.painted.build !== picture.build) older = main.painted;
}

/** The picture that another is compared with: of the held frame, else of the second film, else of
 * the save before; null: it is not here. */
function counterpart(picture) {
  const one = held ? kept.get(wish(held)?.address) : isComparing() ? beside.painted : older;
  return one && isSamePlace(held ? { ...one, number: picture.number } : one, picture) ? one : null;
}

/** The bytes to paint of a picture: it, mixed with its counterpart. */
function mixed(picture) {
  const other = mixing && counterpart(picture);
  if (!other) return picture.bytes;
  const out = new Uint8ClampedArray(picture.bytes), width = picture.crop[2];
  for (let i = 0; i < out.length; i += 4) {
    const isOther = mixing === "wipe" && i / 4 % width < width / 2;
    for (let c = i; c < i + 4; c++) {
      if (isOther) out[c] = other.bytes[c];
      if (mixing === "differ") out[c] = DIFFERENCE_GAIN * Math.abs(out[c] - other.bytes[c]);
    }
    if (mixing === "differ") out[i + 3] = 255;
  }
  return out;
}

// ---------------------------------------------------------------- onion skin

const ONION_MOST = 3;
// of 255: smaller differences are noise at edges that lie between other pixels
const DIFFERENCE_LEAST = 4;
const BEFORE = [230, 40, 40], AFTER = [30, 170, 60];
let onion = 0; // the number of frames before and after

/** A frame as the camera of a picture sees it, so that its movement shows nothing. */
function wishSeen(number, picture) {
  const wanted = wish(number), camera = cameras.get(number);
  if (!wanted || camera === undefined || camera === picture.camera) return wanted;
  const address = `${wanted.address}&camera=${nameOf(main, picture.number)}`;
  return { ...wanted, address, isSeen: true };
}

/** The pictures around one, the farthest first; those that are not here yet are left out. */
function neighbours(picture) {
  const list = [];
  for (let k = onion; k > 0; k--) {
    for (const [number, tint] of [[picture.number - k, BEFORE], [picture.number + k, AFTER]]) {
      const isThere = number >= 1 && number <= state.film.frames;
      const one = isThere && kept.get(wishSeen(number, picture)?.address);
      const isWith = one && isSamePlace({ ...one, number: picture.number }, picture);
      if (isWith) list.push([one, tint, 0.5 ** k]);
    }
  }
  return list;
}

/** Whether the pixel of two pictures at this byte differs by enough to show. */
function isOther(one, other, i) {
  for (let c = i; c < i + 4; c++) {
    if (Math.abs(one[c] - other[c]) >= DIFFERENCE_LEAST) return true;
  }
  return false;
}

/** Lays the pictures around one over it, tinted, where they differ from it. */
function withOnion(picture, bytes) {
  if (onion === 0 || play.direction !== 0) return bytes;
  const out = new Uint8ClampedArray(bytes);
  for (const [one, tint, weight] of neighbours(picture)) {
    for (let i = 0; i < out.length; i += 4) {
      if (!isOther(one.bytes, picture.bytes, i)) continue;
      const share = weight * Math.max(one.bytes[i + 3], 96) / 255;
      for (let c = 0; c < 3; c++) {
        out[i + c] += share * (0.3 * one.bytes[i + c] + 0.7 * tint[c] - out[i + c]);
      }
      out[i + 3] = Math.max(out[i + 3], 255 * share);
    }
  }
  return out;
}

async function fetchOther(wishOther) {
  const wanted = main.isWanted ? null : wishOther();
  if (wanted) await fetchPicture(wanted).catch(() => {});
}

/** Fetches the other pictures that are shown with one that is painted, and paints it again. */
async function addOthers(picture) {
  const numbers = [];
  for (let k = 1; k <= onion; k++) numbers.push(picture.number - k, picture.number + k);
  if (numbers.length === 0 && !(held && mixing) || play.direction !== 0) return;
  if (held && mixing) await fetchOther(() => wish(held));
  for (const number of numbers.filter(one => one >= 1 && one <= state.film.frames)) {
    await fetchOther(() => wishSeen(number, picture));
    await fetchOther(() => wishSeen(number, picture)); // its camera is known now
  }
  if (main.painted === picture && !main.isWanted) paint(picture);
}

function nextOnion() {
  onion = (onion + 1) % (ONION_MOST + 1);
  here("onion").textContent = onion ? `Onion ${onion}` : "Onion";
  here("onion").setAttribute("aria-pressed", onion > 0);
  look();
}

function setMixing(kind) {
  mixing = mixing === kind ? "" : kind;
  here("wipe").setAttribute("aria-pressed", mixing === "wipe");
  here("differ").setAttribute("aria-pressed", mixing === "differ");
  look();
}

/** Holds the frame that is shown, so that others are compared with it; the same again: lets it go. */
function holdFrame() {
  held = held === view.number ? 0 : view.number;
  here("hold").textContent = held ? `Held ${held}` : "Hold";
  here("hold").setAttribute("aria-pressed", held > 0);
  look();
}

// ---------------------------------------------------------------- over the picture

let isShowingSpans = false;
// The line whose results are outlined, { file, line }, and the runs of frames that contain some.
// count: how many lines editors have named.
const outlined = { place: null, runs: [], count: 0 };
const OUTLINE = [255, 150, 30, 255];

/** Marks in `out` the pixels at the border of what a picture covers. */
function drawBorder(picture, out) {
  const [, , w, h] = picture.crop, bytes = picture.bytes;
  const isIn = (x, y) => x >= 0 && y >= 0 && x < w && y < h && bytes[4 * (y * w + x) + 3] > 127;
  for (let y = 0; y < h; y++) {
    for (let x = 0; x < w; x++) {
      const own = isIn(x, y);
      const isBorder = own !== isIn(x + 1, y) || own !== isIn(x, y + 1) || own !== isIn(x - 1, y)
        || own !== isIn(x, y - 1);
      if (isBorder) out.set(OUTLINE, 4 * (y * w + x));
    }
  }
}

/** What is to lie over a picture, as parts of an address. */
function overlays() {
  const place = outlined.place;
  const line = place && `&show=made&file=${encodeURIComponent(place.file)}&line=${place.line}`;
  return [...isShowingSpans ? ["&show=spans"] : [], ...line ? [line] : []];
}

/** Lays the spans, and the outline of what a line made, over a picture that is painted. */
async function layOver(picture) {
  const wanted = overlays();
  if (wanted.length === 0 || play.direction !== 0) {
    overlay.hidden = true;
    return;
  }
  const [, , w, h] = picture.crop, out = new Uint8ClampedArray(4 * w * h);
  for (const part of wanted) {
    const address = picture.address.replace(".runs", ".rgba") + part;
    const layer = await fetchPicture({ ...picture, address, isOver: true }).catch(() => null);
    if (!layer || main.isWanted || main.painted !== picture) return;
    if (part === "&show=spans") out.set(layer.bytes);
    else drawBorder(layer, out);
  }
  overlay.width = w;
  overlay.height = h;
  overlay.getContext("2d").putImageData(new ImageData(out, w, h), 0, 0);
  overlay.dataset.over = picture.address + wanted;
  overlay.hidden = false;
}

function setSpans(isOn) {
  isShowingSpans = isOn;
  here("spans").setAttribute("aria-pressed", isOn);
  look();
}

/** Outlines what a line of the script made; null: nothing. */
async function outline(place) {
  Object.assign(outlined, { place, runs: [], count: place ? place.count : outlined.count });
  look();
  drawSheet();
  const answer = place && state.shown ? await fetch(`/made.json?build=${state.build}`).catch(() => null) : null;
  if (!answer || !answer.ok || outlined.place !== place) return;
  outlined.runs = await answer.json();
  drawSheet();
}

// ---------------------------------------------------------------- costs

/** Fills the table with what a painted picture costs, if it is open. */
async function loadCosts(picture) {
  if (here("costs").hidden || play.direction !== 0) return;
  const address = picture.address.replace(/^\/frame\/(-?\d+)\.runs\?/, "/costs.json?frame=$1&");
  const answer = await fetch(address).catch(() => null);
  if (!answer || !answer.ok || main.painted !== picture) return;
  const list = await answer.json();
  here("cost-rows").replaceChildren(...list.map((one, i) => {
    const row = element("tr", { title: one.file ? `${one.file}:${one.line}` : "" });
    row.append(...cost.cellsOf(one, i === 0).map((textContent, column) =>
      column === 0 ? element("th", { textContent, scope: "row" }) : element("td", { textContent })));
    return row;
  }));
  showSlowest();
}

function showSlowest() {
  here("slowest").replaceChildren(...cost.slowest().map(({ number, seconds }) => {
    const item = element("li", {}), textContent = `frame ${number}`;
    item.append(element("button", { textContent, onclick: () => { stop(); go(number); } }),
                ` ${(seconds * 1000).toFixed(1)} ms`);
    return item;
  }));
  drawSheet();
}

function setCosting(isOn) {
  showPanel("costs", "cost", isOn);
  nameRows();
  drawSheet();
  look();
}

// ---------------------------------------------------------------- the inspector

function setInspecting(isOn) {
  showPanel("side", "inspect", isOn);
  for (const one of [main, beside]) one.box.classList.toggle("inspecting", isOn);
  look();
}

function showColour(one, x, y) {
  const [r, g, b, a] = one.pen.getImageData(x, y, 1, 1).data;
  here("swatch").style.backgroundColor = `rgb(${r} ${g} ${b} / ${a / 255})`;
  here("codes").textContent = `${r}, ${g}, ${b}   alpha ${(a / 255).toFixed(3)}`;
}

/** A text with the places in it as buttons, if there is an editor that opens them. */
function placesOf(text, places) {
  if (!state.editor) return [element("small", { textContent: text })];
  const parts = [];
  for (const place of places) {
    const name = `${place.file}:${place.line}`, at = text.indexOf(name);
    const button = element("button", { textContent: name, onclick: () => post("/open", place) });
    parts.push(element("small", { textContent: text.slice(0, at) }), button);
    text = text.slice(at + name.length);
  }
  return [...parts, element("small", { textContent: text })];
}

/** Shows the colour and the objects at a point of the window, in CSS pixels. */
async function inspect(one, clientX, clientY) {
  const { canvas, painted } = one, box = canvas.getBoundingClientRect();
  const column = Math.floor((clientX - box.left) / box.width * canvas.width);
  const row = Math.floor((clientY - box.top) / box.height * canvas.height);
  if (!painted || column < 0 || row < 0 || column >= canvas.width || row >= canvas.height) return;
  const [w, h] = stateOf(one).film.size, name = nameOf(one, view.number);
  const x = (painted.crop[0] + column + 0.5) / painted.size[0] * w;
  const y = (painted.crop[1] + row + 0.5) / painted.size[1] * h;
  mark = `${one.side} ${name} ${x} ${y}`;
  here("place").textContent = `x ${x.toFixed(2)}, y ${y.toFixed(2)}`;
  showColour(one, column, row);
  const wanted = mark;
  const answer = await fetch(`/at/${x.toFixed(6)},${y.toFixed(6)}.json?frame=${name}&side=${one.side}`);
  if (!answer.ok || wanted !== mark) return;
  const hits = await answer.json();
  here("hint").textContent = hits.length ? "" : "Nothing is there.";
  here("hits").replaceChildren(...hits.map(hit => {
    const item = element("li", {}), place = hit.file ? `${hit.file}:${hit.line}` : "";
    const where = element(state.editor && place ? "button" : "small", { textContent: place });
    if (where.matches("button")) where.onclick = () => post("/open", hit);
    item.append(hit.name ? `${hit.name} (${hit.kind})` : `${hit.kind} without a name`, " ", where);
    if (hit.via) item.append(" ", ...placesOf(hit.via, hit.callers));
    return item;
  }));
}

// ---------------------------------------------------------------- over the scrubber

let thumbed = 0, isThumbing = false; // the frame that is wanted in the small picture; 0: none

/** Shows the frame under the pointer small; while one is on its way, only the newest is wanted. */
async function showThumb(event) {
  const scrub = here("scrub"), box = scrub.getBoundingClientRect();
  const share = clamp((event.clientX - box.left) / box.width, 0, 1), thumb = here("thumb");
  if (!state.film || !state.shown || event.pointerType === "touch") return;
  thumbed = 1 + Math.round(share * (state.film.frames - 1));
  thumb.style.left = `${clamp(event.clientX - THUMB / 2, 4, innerWidth - THUMB - 4)}px`;
  if (isThumbing) return;
  isThumbing = true;
  for (let shown = 0; thumbed && shown !== thumbed;) {
    shown = thumbed;
    await drawThumb(shown).catch(() => {});
  }
  isThumbing = false;
}

async function drawThumb(number) {
  const most = THUMB * ratio() / Math.max(...state.film.size);
  const [w, h] = state.film.size.map(side => Math.max(1, Math.round(side * most)));
  const name = number - 1 + state.film.first, thumb = here("thumb");
  const answer = await fetch(`/frame/${name}.runs?size=${w}x${h}&build=${state.build}`);
  if (!answer.ok || !thumbed) return;
  Object.assign(thumb, { width: w, height: h, hidden: false });
  thumb.dataset.frame = name;
  thumb.getContext("2d").putImageData(new ImageData(unpack(await answer.arrayBuffer(), w, h), w, h), 0, 0);
}

function hideThumb() {
  thumbed = 0;
  here("thumb").hidden = true;
}

// ---------------------------------------------------------------- hands

function setGround(ground) {
  here("ground").value = ground;
  for (const id of ["paper", "paper2"]) here(id).dataset.ground = ground;
}

function nextGround() {
  const { options, selectedIndex } = here("ground");
  setGround(options[(selectedIndex + 1) % options.length].value);
}

function setMatte(isOn) {
  isMatte = isOn;
  here("matte").setAttribute("aria-pressed", isOn);
  for (const one of lanes()) if (one.painted) paint(one.painted);
}

/** The next guide, and none after the last. */
function nextGuide() {
  const next = GUIDES.findIndex(guide => !here(guide).hidden) + 1;
  for (const one of [main, beside]) {
    GUIDES.forEach((guide, i) => { part(one, guide).hidden = i !== next; });
  }
  here("guides").setAttribute("aria-pressed", next < GUIDES.length);
}

/** The rectangles of the field guide, each with its number. */
function makeFields() {
  for (let k = 1; k <= FIELDS; k++) {
    for (const id of ["fields", "fields2"]) {
      const field = element("div", { textContent: k });
      field.style.inset = `${50 - 50 * k / FIELDS}%`;
      here(id).append(field);
    }
  }
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  drawSheet();
}

function swapTheme() {
  setTheme(document.documentElement.dataset.theme === "light" ? "dark" : "light");
}

function fullScreen() {
  if (document.fullscreenElement) document.exitFullscreen();
  else document.documentElement.requestFullscreen();
}

function zoomMiddle(factor) {
  const [w, h] = windowSize();
  zoom(factor, w / 2, h / 2);
}

/** One unit of the film as one pixel of the screen. */
function natural() { zoomMiddle(1 / view.scale); }

function askNumber() {
  here("number").value = view.number;
  here("go").showModal();
  here("number").select();
}

const keys = {
  " ": toggle, k: toggle,
  ArrowLeft: event => event.shiftKey ? move(STRIDE, 0) : step(-1),
  ArrowRight: event => event.shiftKey ? move(-STRIDE, 0) : step(1),
  ArrowUp: event => event.shiftKey ? move(0, STRIDE) : step(1),
  ArrowDown: event => event.shiftKey ? move(0, -STRIDE) : step(-1),
  PageUp: () => step(-10), PageDown: () => step(10),
  Home: () => { stop(); go(loop.from); }, End: () => { stop(); go(loop.to); },
  j: () => start(-1),
  l: () => play.direction > 0 ? setSpeed(play.speed * 2) : start(1),
  i: () => setLoop(view.number, loop.to),
  o: () => setLoop(Math.min(loop.from, view.number), view.number),
  x: () => setLoop(1, state.film.frames),
  p: () => setInspecting(here("side").hidden),
  s: () => setSheet(here("sheet").hidden),
  w: () => setMixing("wipe"), d: () => setMixing("differ"),
  h: holdFrame, n: nextOnion,
  u: swapMute,
  e: () => setSpans(!isShowingSpans),
  c: () => setCosting(here("costs").hidden),
  Escape: () => outline(null),
  v: () => setTuning(here("values").hidden),
  r: () => setChecking(here("faults").hidden),
  y: () => { if (!here("compare").hidden) swapComparing(); },
  g: askNumber,
  "+": () => zoomMiddle(1.5), "=": () => zoomMiddle(1.5), "-": () => zoomMiddle(1 / 1.5),
  0: () => { fit(); look(); }, 1: natural,
  a: nextGuide, b: nextGround, m: () => setMatte(!isMatte), t: swapTheme, f: fullScreen,
  "?": () => here("keys").showModal(),
};

/** Whether a key belongs to what has the focus. */
function isTaken(event) {
  const target = event.target, isButton = target.matches("button");
  return event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")
    || target.matches("select, textarea, input:not([type=range], [type=checkbox])")
    || isButton && (event.key === "Enter" || event.key === " ");
}

document.addEventListener("keydown", event => {
  const act = keys[event.key];
  if (!act || !state.film && event.key !== "?" || isTaken(event)) return;
  event.preventDefault();
  act(event);
});

// A button that was clicked loses the focus, so that the space key plays.
document.addEventListener("pointerup", event => event.target.closest("button, #scrub")?.blur());

const pointers = new Map();
let travelled = 0;

function press(one, event) {
  if (event.target.closest(".fault")) return;
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
  if (!before) return;
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
  if (isClick && !here("side").hidden) inspect(one, event.clientX, event.clientY);
}
function turn(one, event) {
  const box = one.box.getBoundingClientRect(), r = ratio();
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1;
  zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0015)),
       (event.clientX - box.left) * r, (event.clientY - box.top) * r);
}

for (const one of [main, beside]) {
  const hear = (name, act) => one.box.addEventListener(name, event => act(one, event), { passive: false });
  hear("pointerdown", press);
  hear("pointermove", drag);
  hear("pointerup", release);
  hear("pointercancel", release);
  hear("wheel", turn);
}


const clicks = {
  first: () => { stop(); go(loop.from); }, back: () => step(-1), play: toggle,
  forward: () => step(1), last: () => { stop(); go(loop.to); }, fit: keys[0],
  matte: keys.m, inspect: keys.p, tune: keys.v, list: keys.s, onion: nextOnion, mute: swapMute,
  spans: keys.e, cost: keys.c, guides: nextGuide, hold: holdFrame,
  wipe: keys.w, differ: keys.d, compare: keys.y, check: keys.r, defaults: takeDefaults, theme: swapTheme,
  help: keys["?"],
};
for (const [id, act] of Object.entries(clicks)) here(id).addEventListener("click", act);

here("scrub").addEventListener("input", event => { stop(); go(Number(event.target.value)); });
here("scrub").addEventListener("pointermove", showThumb);
here("scrub").addEventListener("pointerleave", hideThumb);
here("speed").addEventListener("change", event => setSpeed(Number(event.target.value)));
here("ground").addEventListener("change", event => setGround(event.target.value));
here("cells").addEventListener("click", goBySheet);
here("go").addEventListener("close", () => { stop(); go(Number(here("number").value)); });
new ResizeObserver(() => {
  deskSize = [desk.clientWidth, desk.clientHeight];
  look();
}).observe(desk);
new ResizeObserver(drawSheet).observe(here("cells"));

// The token is removed from the address: fetch.js keeps it.
history.replaceState(null, "", location.hash.length > 1 ? `/${location.hash}` : "/");
readAddress();
setGround("checker");
makeFields();
setTheme(matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
listen();
