// Handles on the picture for parameters that are points.
import { clamp, desk, element, here, main, play, ratio, state, view } from "/state.js";
import { giveValue } from "/values.js";

const handles = new Map(); // by the names of the parameters

const pointsOf = () => state.film ? state.parameters.filter(one => one.format === "point") : [];
const placeOf = one => one.value.split(",").map(Number);

/** The grid of points: whole units of the film, or tenths and hundredths where a unit is large. */
const gridOf = () => [1, 10].find(share => view.scale / ratio() < 10 * share) ?? 100;

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

/** Puts the handles where the view has their points now. */
export function placePoints() {
  const points = pointsOf(), names = new Set(points.map(one => one.name));
  for (const [name, handle] of handles) {
    if (names.has(name)) continue;
    handle.remove();
    handles.delete(name);
  }
  for (const one of points) {
    if (!handles.has(one.name)) handles.set(one.name, makeHandle(one.name));
    const [x, y] = placeOf(one), handle = handles.get(one.name), r = ratio();
    Object.assign(handle.style, { left: `${(view.x + x * view.scale) / r}px`,
                                  top: `${(view.y + y * view.scale) / r}px` });
    handle.hidden = play.direction !== 0;
  }
}

