// Pictures of frames: asked for, kept, and painted.
//
//   look: the view has changed --> wish: size, crop --> /frame/N.runs --> kept --> #canvas
//
// Pictures are wanted one after the other: while one is on its way, only the newest wish is kept.
import { addHeld, keepOlder, mixed } from "/compare.js";
import { noteTime } from "/cost.js";
import { loadCosts } from "/costing.js";
import { showFault } from "/faults.js";
import { fetch, noteSeen, pause, post } from "/fetch.js";
import { GUIDES } from "/guides.js";
import { showPoint } from "/inspector.js";
import { showNumbers } from "/news.js";
import { loadObjects } from "/objects.js";
import { layOver, overlays } from "/over.js";
import { placePoints } from "/points.js";
import { cels } from "/rows.js";
import { unpack } from "/runs.js";
import {
  beside, buildOf, here, isReady, lanes, looks, main, overlay, part, play, ratio, setPressed,
  state, stateOf, view, write, writeAttribute,
} from "/state.js";
import { drawRuler, loadWave } from "/timeline.js";
import { fit, frameSize, visible } from "/view.js";

export const KEPT_MOST = 192 << 20; // bytes of pictures that are kept

// seconds after which a picture is slow: then a coarse picture is shown first
const SLOW = 0.15;
const VERY_SLOW = 1;         // seconds after which the coarse picture is made coarser still
const LATE = 250;            // milliseconds after which a picture is seen to be an older one

export const kept = new Map(); // by their addresses, the oldest first
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

/** Forgets the pictures of a film that are older than it, and which of its frames could not be
 * made. */
export function forget(one) {
  const build = buildOf(one);
  for (const [number, refusal] of one.refused) {
    if (refusal.build !== build) one.refused.delete(number);
  }
  for (const [address, picture] of kept) {
    if (picture.lane !== one || picture.build === build) continue;
    kept.delete(address);
    keptBytes -= picture.bytes.byteLength;
  }
}

/** The number in its film of the frame that a lane shows with a frame of the first: of the same
 * time, or the last. */
export function nameOf(one, number) {
  const film = stateOf(one).film;
  const index = one === main ? number - 1
    : Math.floor((number - 1) / state.film.fps * film.fps + 1e-6);
  return film.first + Math.min(index, film.frames - 1);
}

/** The onion skin of a lane, as a part of an address: there is none while the film plays. */
const onionOf = one => one === main && looks.onion && play.direction === 0
  ? `&onion=${looks.onion},${looks.onion}${cels.skins}` : "";

/** How coarse pictures are now: sharp, but while the film plays and they would be late. */
export const coarseNow = () => play.direction === 0 || looks.mixing ? 1 : play.pace.coarse;

/** The part of a frame that is visible. coarse: that many pixels are one, in each direction. plain:
 * the address without an onion skin; query: how cels are shown. */
export function wish(number, one = main, coarse = coarseNow()) {
  const crop = visible(one), build = buildOf(one);
  if (!crop) return null;
  const whole = frameSize(one), size = whole.map(side => Math.ceil(side / coarse));
  const area = [0, 1].map(i => Math.floor(crop[i] * size[i] / whole[i]));
  for (const i of [0, 1]) {
    area.push(Math.ceil((crop[i] + crop[i + 2]) * size[i] / whole[i]) - area[i]);
  }
  const query = one === main ? cels.query : "&side=2";
  const plain = `/frame/${nameOf(one, number)}.runs?size=${size.join("x")}&crop=${area.join()}`
    + `&build=${build}${query}`;
  const address = plain + onionOf(one);
  return { number, size, crop: area, coarse, address, plain, build, query, lane: one };
}

const pageName = Math.random().toString(36).slice(2);
let wishCount = 0;

export async function fetchPicture(wanted) {
  const known = kept.get(wanted.address);
  if (known) return known;
  wanted.name = `${pageName}-${++wishCount}`;
  const answer = await fetch(`${wanted.address}&wish=${wanted.name}`);
  wanted.isHere = true;
  if (!answer.ok) throw Object.assign(new Error(await answer.text()), { status: answer.status });
  const buffer = await answer.arrayBuffer(), [, , w, h] = wanted.crop;
  const bytes = wanted.isOver ? new Uint8ClampedArray(buffer) : unpack(buffer, w, h);
  const picture = { ...wanted, bytes, points: answer.headers.get("Celspan-Points"),
                    seconds: Number(answer.headers.get("Celspan-Seconds")) };
  if (isSeenNow(picture)) noteTime(picture.number, picture.seconds, picture.build);
  if (wanted.build === buildOf(wanted.lane)) keep(wanted.address, picture);
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

/** Whether the picture of a lane as it is now is painted. */
export const isSeen = one => isReady(one)
  && one.painted?.address === wish(view.number, one)?.address;

/** Marks the canvas of a lane while it does not show what was wanted last: values, frame, place. It
 * is only seen after a while: a filter costs the browser two thirds of the time of a frame. */
export function markStale(one) {
  const isSent = !one.isSending && !one.isChanged && one.painted?.build >= one.wantedBuild;
  const isStale = !(isSent && isSeen(one)) && play.direction === 0;
  if (!one.canvas.toggleAttribute("data-stale", isStale)) {
    clearTimeout(one.late);
    one.late = 0;
    one.canvas.classList.remove("late");
  } else {
    one.late ||= setTimeout(() => one.canvas.classList.add("late"), LATE);
  }
}

/** Whether a picture is of the first film as it is seen now, sharp and without an onion skin. */
const isSeenNow = one => one.lane === main && !one.isOver && one.address === one.plain
  && one.coarse === 1 && one.build === buildOf(main) && one.query === cels.query;

/** The numbers of the frames whose pictures are kept as they are seen now. */
export function keptFrames() {
  const size = frameSize().join();
  return [...kept.values()].filter(one => isSeenNow(one) && one.size.join() === size)
    .map(one => one.number);
}

/** Puts a picture on the canvas of its lane; bytes: its own, or others in their place. */
function put(picture, bytes) {
  const one = picture.lane, [, , w, h] = picture.crop, canvas = one.canvas;
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  one.pen.putImageData(new ImageData(looks.isMatte ? matteOf(bytes) : bytes, w, h), 0, 0);
  one.painted = picture;
  const said = { frame: nameOf(one, picture.number), size: picture.size.join("x"),
                 crop: picture.crop.join(), build: picture.build };
  for (const [name, value] of Object.entries(said)) write(canvas.dataset, name, String(value));
  writeAttribute(canvas, "aria-label", `Frame ${picture.number}`);
  noteSeen();
  markStale(one);
}

export function paint(picture) {
  if (picture.lane === beside) {
    if (!isReady(beside)) return null;
    put(picture, picture.bytes);
    if (looks.mixing && !looks.held && main.painted) paint(main.painted);
    return place();
  }
  keepOlder(picture);
  put(picture, mixed(picture));
  const isOver = overlay.dataset.over === picture.address + overlays() && play.direction === 0;
  write(overlay, "hidden", !isOver);
  place();
}

/** Puts what is painted, and the handles of points, where the view has them now; a picture that was
 * made for another view is stretched. */
function place() {
  if (!state.film) return;
  for (const one of lanes()) placeLane(one, one === main ? [here("paper"), main.canvas, overlay]
    : [here("paper2"), one.canvas]);
  placePoints();
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

/** Wants the picture of the view as it is now. */
export function look() {
  if (view.isFitted) fit();
  place();
  showNumbers();
  lanes().forEach(want);
}

/** Wants the picture of a lane as it is now, unless it is on its way. */
export function want(one) {
  const onWay = one.fetching?.wanted.address;
  one.isWanted = !isReady(one) || wish(view.number, one)?.address !== onWay;
  if (!one.isAsking && isReady(one)) ask(one);
  else abandonOld(one);
  markStale(one);
}

async function ask(one) {
  one.isAsking = true;
  while (one.isWanted && isReady(one)) {
    one.isWanted = false;
    const fine = wish(view.number, one);
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

/** Whether the picture of a wish is painted already, if not as sharp: it was played. */
function isRough({ lane, number }) {
  const painted = lane.painted;
  return painted && painted.address === wish(number, lane, painted.coarse)?.address;
}

/** Fetches a picture, and before it a coarse one if it is slow, or was at last; null: another one
 * is wanted by then. */
async function fetchBest(fine) {
  const one = fine.lane, isSlow = one.slowness > SLOW && play.direction === 0;
  if (isSlow && !kept.has(fine.address) && !isRough(fine)) {
    paint(await fetchPicture(wish(fine.number, one, one.slowness > VERY_SLOW ? 8 : 4)));
    await new Promise(requestAnimationFrame);
    if (one.isWanted) return null;
  }
  one.fetching = { wanted: fine, since: performance.now() / 1000 };
  const arrival = fetchPicture(fine);
  if (!isSlow && !isRough(fine)) paintMeanwhile(fine, arrival);
  return arrival;
}

/** Paints a coarse picture if a fine one does not arrive soon. */
async function paintMeanwhile(fine, arrival) {
  const one = fine.lane, coarse = wish(fine.number, one, 4);
  const isOver = () => one.fetching?.wanted !== fine;
  const has = arrival.then(() => true, () => true);
  if (await Promise.race([has, pause(SLOW)]) || isOver() || play.direction !== 0 || !coarse) return;
  has.then(() => abandon(coarse));
  const picture = await fetchPicture(coarse).catch(() => null);
  if (picture && !isOver() && fine.build === buildOf(one)) paint(picture);
}

async function takeBest(picture) {
  const one = picture.lane;
  one.slowness = picture.seconds;
  one.fetching = null;
  paint(picture);
  one.refused.delete(picture.number);
  showFault(one);
  showPoint(one);
  if (one === main) await addTo(picture);
}

/** Has the server give up a picture that it has not answered. */
export function abandon(wanted) {
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
  if (one.fetching !== old || wish(view.number, one)?.address === old.wanted.address) return;
  old.isLeft = true;
  abandon(old.wanted);
}

/** What is shown with a picture of the first film, which is seen first. */
async function addTo(picture) {
  requestAnimationFrame(() => setTimeout(drawRuler));
  await addHeld(picture);
  await layOver(picture);
  await loadCosts(picture);
  loadWave();
  loadObjects();
}

/** A picture that was not made: what the film says of it is among the errors; what was busy is
 * asked again. */
export async function failed(fault, wanted) {
  if (!fault.status) console.error(fault); // the page's own fault, or there is no server
  const one = wanted.lane;
  if (fault.status !== 503) noteSeen();
  if (fault.status === 422) {
    one.refused.set(wanted.number, { build: wanted.build, message: fault.message.trim() });
    if (one === main) drawRuler();
    return showFault(one);
  }
  if (!one.isWanted) await pause(0.3);
  if (fault.status === 503) one.isWanted = true;
}

export function setMatte(isOn) {
  looks.isMatte = isOn;
  setPressed("matte", isOn);
  for (const one of lanes()) if (one.painted) paint(one.painted);
}
