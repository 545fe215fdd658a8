// The onion skin: frames before and after, tinted. Of chosen cels, they lie behind them.
import { isSamePlace } from "/compare.js";
import { cameras, fetchPicture, kept, look, nameOf, paint, wish } from "/pictures.js";
import { cels } from "/rows.js";
import { label, looks, main, play, setPressed, state } from "/state.js";

const ONION_MOST = 3;
// of 255: smaller differences are noise at edges that lie between other pixels
const DIFFERENCE_LEAST = 4;
const BEFORE = [230, 40, 40];
const AFTER = [30, 170, 60];

/** A frame, or the chosen cels of it, as the camera of a picture sees it: its movement shows
 * nothing. */
function wishSeen(number, picture) {
  const wanted = wish(number, 1, main, cels.onion || cels.query), camera = cameras.get(number);
  if (!wanted || camera === undefined || camera === picture.camera) return wanted;
  const address = `${wanted.address}&camera=${nameOf(main, picture.number)}`;
  return { ...wanted, address, isSeen: true };
}

/** The pictures around one, the farthest first; those that are not here yet are left out. */
function neighbours(picture) {
  const list = [];
  for (let k = looks.onion; k > 0; k--) {
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

/** Lays the pictures around one over it, tinted, where they differ from it; those of chosen cels
 * only where these do not cover. */
export function withOnion(picture, bytes) {
  const own = cels.onion ? kept.get(wishSeen(picture.number, picture)?.address) : picture;
  if (looks.onion === 0 || play.direction !== 0 || !own) return bytes;
  const out = new Uint8ClampedArray(bytes), { bytes: base } = own;
  for (const [one, tint, weight] of neighbours(picture)) {
    for (let i = 0; i < out.length; i += 4) {
      if (!isOther(one.bytes, base, i)) continue;
      const covered = cels.onion ? one.bytes[i + 3] * (1 - base[i + 3] / 255)
        : Math.max(one.bytes[i + 3], 96);
      const share = weight * covered / 255;
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
export async function addOthers(picture) {
  const numbers = looks.onion && cels.onion ? [picture.number] : [];
  for (let k = 1; k <= looks.onion; k++) numbers.push(picture.number - k, picture.number + k);
  if (numbers.length === 0 && !(looks.held && looks.mixing) || play.direction !== 0) return;
  if (looks.held && looks.mixing) await fetchOther(() => wish(looks.held));
  for (const number of numbers.filter(one => one >= 1 && one <= state.film.frames)) {
    await fetchOther(() => wishSeen(number, picture));
    await fetchOther(() => wishSeen(number, picture)); // its camera is known now
  }
  if (main.painted === picture && !main.isWanted) paint(picture);
}

export function nextOnion() {
  looks.onion = (looks.onion + 1) % (ONION_MOST + 1);
  label("onion", looks.onion ? `Onion ${looks.onion}` : "Onion");
  setPressed("onion", looks.onion > 0);
  look();
}

