// The small picture of the frame under the pointer, over the timeline.
import { fetch } from "/fetch.js";
import { unpack } from "/runs.js";
import { clamp, here, ratio, state } from "/state.js";
import { frameAt } from "/timeline.js";

const THUMB = 160;           // CSS pixels, the longer side of the picture over the scrubber

let thumbed = 0, isThumbing = false; // the frame that is wanted in the small picture; 0: none

/** Shows the frame under the pointer small; while one is on its way, only the newest is wanted. */
export async function showThumb(event) {
  const thumb = here("thumb");
  if (!state.film || !state.shown || event.pointerType === "touch") return;
  thumbed = frameAt(event.clientX);
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
  const { top } = here("timeline").getBoundingClientRect();
  Object.assign(thumb, { width: w, height: h, hidden: false });
  thumb.style.bottom = `${innerHeight - top + 6}px`;
  thumb.dataset.frame = name;
  const picture = new ImageData(unpack(await answer.arrayBuffer(), w, h), w, h);
  if (thumbed) thumb.getContext("2d").putImageData(picture, 0, 0);
}

export function hideThumb() {
  thumbed = 0;
  here("thumb").hidden = true;
}

