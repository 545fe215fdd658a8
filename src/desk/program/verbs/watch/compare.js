// Two pictures at one place: a wipe between them, or their difference.
import { fetchPicture, kept, look, paint, wish } from "/pictures.js";
import {
  beside, isComparing, label, looks, main, play, setPressed, view,
} from "/state.js";

const DIFFERENCE_GAIN = 4;  // so that small differences can be seen

/** Whether two pictures show the same part of the same frame. */
const isSamePlace = (a, b) => a && b && a.number === b.number
  && a.size.join() === b.size.join() && a.crop.join() === b.crop.join();

/** Keeps the picture that is painted when one of another save takes its place. */
export function keepOlder(picture) {
  if (main.painted && main.painted.build !== picture.build) looks.older = main.painted;
}

/** The picture that another is compared with: of the held frame, else of the second film, else of
 * the save before; null: it is not here. */
function counterpart(picture) {
  const { held, older } = looks;
  const one = held ? kept.get(wish(held)?.address) : isComparing() ? beside.painted : older;
  return one && isSamePlace(held ? { ...one, number: picture.number } : one, picture) ? one : null;
}

/** The bytes to paint of a picture: it, mixed with its counterpart. */
export function mixed(picture) {
  const other = looks.mixing && counterpart(picture);
  if (!other) return picture.bytes;
  const out = new Uint8ClampedArray(picture.bytes), width = picture.crop[2];
  for (let i = 0; i < out.length; i += 4) {
    const isLeft = looks.mixing === "wipe" && i / 4 % width < width / 2;
    for (let c = i; c < i + 4; c++) {
      if (isLeft) out[c] = other.bytes[c];
      if (looks.mixing === "differ") out[c] = DIFFERENCE_GAIN * Math.abs(out[c] - other.bytes[c]);
    }
    if (looks.mixing === "differ") out[i + 3] = 255;
  }
  return out;
}

/** Fetches the held frame for a picture that is painted, and paints it again. */
export async function addHeld(picture) {
  const isShown = looks.held && looks.mixing && play.direction === 0 && !main.isWanted;
  const wanted = isShown ? wish(looks.held) : null;
  if (!wanted || kept.has(wanted.address)) return;
  await fetchPicture(wanted).catch(() => {});
  if (main.painted === picture && !main.isWanted) paint(picture);
}

export function setMixing(kind) {
  looks.mixing = looks.mixing === kind ? "" : kind;
  for (const id of ["wipe", "differ"]) setPressed(id, looks.mixing === id);
  look();
}

/** Holds the frame that is shown, so that others are compared with it; again: lets it go. */
export function holdFrame() {
  looks.held = looks.held === view.number ? 0 : view.number;
  label("hold", looks.held ? `Held: frame ${looks.held}` : "Hold this frame");
  setPressed("hold", looks.held > 0);
  look();
}

