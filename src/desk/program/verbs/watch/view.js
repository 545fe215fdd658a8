// Which part of the frame is in the window, and how large it is.
import { look } from "/pictures.js";
import { clamp, desk, main, ratio, state, stateOf, view } from "/state.js";

const SIDE_MOST = 1048576;   // pixels of a frame

// in CSS pixels; asking the page for it while a film plays would cost layouts
let deskSize = [1, 1];

/** Measures the window of the pictures again. */
export function measureDesk() { deskSize = [desk.clientWidth, desk.clientHeight]; }

const windowSize = () => deskSize.map(side => Math.max(1, Math.round(side * ratio())));

/** The size of the whole frame in device pixels. The second film is as wide as the first. */
export function frameSize(one = main) {
  const size = stateOf(one).film.size, scale = view.scale * state.film.size[0] / size[0];
  return size.map(side => clamp(Math.round(side * scale), 1, SIDE_MOST));
}

export function fit() {
  if (!state.film) return;
  const [w, h] = windowSize(), size = state.film.size;
  const margin = document.body.classList.contains("alone") ? 0 : 12 * ratio();
  view.isFitted = true;
  view.scale = Math.min(Math.max(1, w - 2 * margin) / size[0],
                        Math.max(1, h - 2 * margin) / size[1], SIDE_MOST / Math.max(...size));
  const whole = frameSize();
  view.x = Math.floor((w - whole[0]) / 2);
  view.y = Math.floor((h - whole[1]) / 2);
}

/** Zooms about a point of the window, in device pixels. */
export function zoom(factor, x, y) {
  if (!state.film) return;
  const most = SIDE_MOST / Math.max(...state.film.size), least = 8 / Math.max(...state.film.size);
  const scale = clamp(view.scale * factor, least, most), change = scale / view.scale;
  view.isFitted = false;
  view.scale = scale;
  view.x = Math.round(x - (x - view.x) * change);
  view.y = Math.round(y - (y - view.y) * change);
  look();
}

export function move(dx, dy) {
  view.isFitted = false;
  view.x += Math.round(dx);
  view.y += Math.round(dy);
  look();
}

/** The part of the frame that is in the window; null: none is. */
export function visible(one = main) {
  const [w, h] = windowSize(), [fw, fh] = frameSize(one);
  const x = clamp(-view.x, 0, fw), y = clamp(-view.y, 0, fh);
  const right = clamp(w - view.x, 0, fw), bottom = clamp(h - view.y, 0, fh);
  return right > x && bottom > y ? [x, y, right - x, bottom - y] : null;
}

export function zoomMiddle(factor) {
  const [w, h] = windowSize();
  zoom(factor, w / 2, h / 2);
}

/** The parts of a unit of the film that are told apart: tenths and hundredths where it is large. */
export const gridOf = () => [1, 10].find(share => view.scale / ratio() < 10 * share) ?? 100;

/** One unit of the film as one pixel of the screen. */
export function natural() { zoomMiddle(1 / view.scale); }

