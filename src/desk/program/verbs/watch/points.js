// Handles on the picture for parameters that are points.
import {
  clamp, desk, element, here, looks, main, play, ratio, setPressed, state, view, write,
} from "/state.js";
import { giveValue } from "/values.js";
import { gridOf } from "/view.js";

const handles = new Map(); // by the names of the parameters

const pointsOf = () => state.film ? state.parameters.filter(one => one.format === "point") : [];
let spot = null; // the point that was inspected, in film units; null: none
const placeOf = one => one.value.split(",").map(Number);

/** Gives a point, in film units, of which a unit has `share` parts. */
function givePoint(name, place, share = gridOf()) {
  const one = state.parameters.find(known => known.name === name);
  if (!one) return;
  const text = place.map(side => Math.round(side * share) / share).join();
  giveValue(main, one, text);
  const field = here("form").elements.namedItem(name);
  if (field) field.value = text;
}

/** A handle: it is dragged within the film, with shift beside the grid, and the arrow keys move it
 * by a unit, with shift by ten. */
function makeHandle(name) {
  const one = element("button", { className: "handle", ariaLabel: `Point ${name}`,
                                  dataset: { point: name } });
  one.addEventListener("pointerdown", event => {
    event.stopPropagation();
    one.setPointerCapture(event.pointerId);
  });
  one.addEventListener("pointermove", event => {
    if (!one.hasPointerCapture(event.pointerId)) return;
    event.stopPropagation();
    const box = desk.getBoundingClientRect(), r = ratio();
    const place = [(event.clientX - box.left) * r - view.x, (event.clientY - box.top) * r - view.y];
    const inside = place.map((side, i) => clamp(side / view.scale, 0, state.film.size[i]));
    givePoint(name, inside, event.shiftKey ? 100 : gridOf());
  });
  one.addEventListener("keydown", event => moveHandle(event, name));
  desk.append(one);
  return one;
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

function moveHandle(event, name) {
  const way = ARROWS[event.key], one = state.parameters.find(known => known.name === name);
  if (!way || !one || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  const [x, y] = placeOf(one), step = event.shiftKey ? 10 : 1;
  givePoint(name, [x + way[0] * step, y + way[1] * step]);
}

/** Shows the handles, or hides them. */
export function swapHandles() {
  looks.hasHandles = !looks.hasHandles;
  setPressed("handles", looks.hasHandles);
  placePoints();
}

/** Marks the point that is inspected; null: none is. */
export function setSpot(point) {
  spot = point;
  placePoints();
}

/** Puts an element of the window at a point of the film. */
function putAt(one, x, y) {
  const r = ratio();
  Object.assign(one.style, { left: `${(view.x + x * view.scale) / r}px`,
                             top: `${(view.y + y * view.scale) / r}px` });
}

/** Puts the handles where the view has their points now, and the mark of the inspector. Points that
 * the frame has not read are pale. */
export function placePoints() {
  const points = pointsOf(), names = new Set(points.map(one => one.name));
  for (const [name, handle] of handles) {
    if (names.has(name)) continue;
    handle.remove();
    handles.delete(name);
  }
  for (const one of points) {
    if (!handles.has(one.name)) handles.set(one.name, makeHandle(one.name));
    const handle = handles.get(one.name);
    putAt(handle, ...placeOf(one));
    write(handle, "hidden", play.direction !== 0 || !looks.hasHandles);
    handle.classList.toggle("idle", main.painted?.points?.includes(`,${one.name},`) === false);
  }
  write(here("spot"), "hidden", !spot);
  if (spot) putAt(here("spot"), spot.x, spot.y);
}

