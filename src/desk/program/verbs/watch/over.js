// What lies over the picture: kinds of spans, and the outline of what a line made.
import { read } from "/fetch.js";
import { fetchPicture, look } from "/pictures.js";
import { looks, main, overlay, play, setPressed, state, write } from "/state.js";
import { drawRuler } from "/timeline.js";

// The line whose results are outlined, { file, line }, or only those of that name, and in that cel;
// and the runs of frames that contain some. count: how many lines editors have named.
export const outlined = { place: null, runs: [], count: 0 };
const OUTLINE = [255, 150, 30, 255];

/** Marks in `out` the pixels at the border of what a picture covers, however clear it is. */
function drawBorder(picture, out) {
  const [, , w, h] = picture.crop, bytes = picture.bytes;
  const isIn = (x, y) => x >= 0 && y >= 0 && x < w && y < h && bytes[4 * (y * w + x) + 3] > 0;
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
export function overlays() {
  const place = outlined.place;
  const part = name => place[name] === undefined ? ""
    : `&${name}=${encodeURIComponent(place[name])}`;
  const line = place && `&show=made${["file", "line", "name", "cel"].map(part).join("")}`;
  return [...looks.hasSpans ? ["&show=spans"] : [], ...line ? [line] : []];
}

/** Lays the spans, and the outline of what a line made, over a picture that is painted. */
export async function layOver(picture) {
  const wanted = overlays();
  if (wanted.length === 0 || play.direction !== 0) {
    write(overlay, "hidden", true);
    return;
  }
  const [, , w, h] = picture.crop, out = new Uint8ClampedArray(4 * w * h);
  for (const show of wanted) {
    const address = picture.plain.replace(".runs", ".rgba") + show;
    const layer = await fetchPicture({ ...picture, address, isOver: true }).catch(() => null);
    if (!layer || main.isWanted || main.painted !== picture) return;
    if (show === "&show=spans") out.set(layer.bytes);
    else drawBorder(layer, out);
  }
  overlay.width = w;
  overlay.height = h;
  overlay.getContext("2d").putImageData(new ImageData(out, w, h), 0, 0);
  overlay.dataset.over = picture.address + wanted;
  overlay.hidden = false;
}

export function setSpans(isOn) {
  looks.hasSpans = isOn;
  setPressed("spans", isOn);
  look();
}

/** Outlines what a line of the script made; null: nothing. */
export async function outline(place) {
  Object.assign(outlined, { place, runs: [], count: place?.count ?? outlined.count });
  look();
  drawRuler();
  if (!place?.count || !state.shown) return; // only for a line that an editor has named
  const isWanted = () => outlined.place === place;
  const runs = await read(`/made.json?build=${state.build}`, isWanted);
  if (!runs || !isWanted()) return;
  outlined.runs = runs;
  drawRuler();
}

