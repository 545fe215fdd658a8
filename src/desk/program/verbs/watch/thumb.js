// The small picture of the frame under the pointer, over the timeline.
import { fetch, newest } from "/fetch.js";
import { unpack } from "/runs.js";
import { clamp, here, ratio, state } from "/state.js";
import { frameAt } from "/timeline.js";

const THUMB = 160;           // CSS pixels, the longer side of the picture over the scrubber

let wanted = 0;              // the frame that is wanted in the small picture; 0: none

/** Shows the frame under the pointer small. */
export function showThumb(event) {
  if (!state.film || !state.shown || event.pointerType === "touch") return;
  const number = frameAt(event.clientX);
  here("thumb").style.left = `${clamp(event.clientX - THUMB / 2, 4, innerWidth - THUMB - 4)}px`;
  if (number !== wanted) draw(wanted = number);
}

const draw = newest(async number => {
  const most = THUMB * ratio() / Math.max(...state.film.size);
  const [w, h] = state.film.size.map(side => Math.max(1, Math.round(side * most)));
  const name = number - 1 + state.film.first, thumb = here("thumb");
  const answer = await fetch(`/frame/${name}.runs?size=${w}x${h}&build=${state.build}`)
    .catch(() => null);
  if (!answer?.ok || !wanted) return;
  const picture = new ImageData(unpack(await answer.arrayBuffer(), w, h), w, h);
  if (!wanted) return;
  const bottom = `${innerHeight - here("timeline").getBoundingClientRect().top + 6}px`;
  Object.assign(thumb, { width: w, height: h, hidden: false });
  Object.assign(thumb.style, { bottom });
  thumb.dataset.frame = name;
  thumb.getContext("2d").putImageData(picture, 0, 0);
});

export function hideThumb() {
  wanted = 0;
  here("thumb").hidden = true;
}
