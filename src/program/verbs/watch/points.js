// Handles on the picture for parameters that are points.
import { desk, element, here, main, play, ratio, state, view } from "/state.js";
import { giveValue } from "/values.js";

const handles = new Map(); // by the names of the parameters

const pointsOf = () => state.film ? state.parameters.filter(one => one.format === "point") : [];
const placeOf = one => one.value.split(",").map(Number);

/** Gives a point, in film units, rounded to a hundredth. */
function givePoint(name, x, y) {
  const one = state.parameters.find(known => known.name === name);
  if (!one) return;
  const text = [x, y].map(side => Number(side.toFixed(2))).join();
  giveValue(main, one, text);
  const field = here("form").elements.namedItem(name);
  if (field) field.value = text;
}

/** A handle: it is dragged, and the arrow keys move it by a unit, with shift by ten. */
function makeHandle(name) {
  const one = element("button", { className: "handle", title: name, ariaLabel: `Point ${name}`,
                                  dataset: { point: name } });
  one.addEventListener("pointerdown", event => {
    event.stopPropagation();
    one.setPointerCapture(event.pointerId);
  });
  one.addEventListener("pointermove", event => {
    if (!one.hasPointerCapture(event.pointerId)) return;
    event.stopPropagation();
    const box = desk.getBoundingClientRect(), r = ratio();
    givePoint(name, ((event.clientX - box.left) * r - view.x) / view.scale,
              ((event.clientY - box.top) * r - view.y) / view.scale);
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
  givePoint(name, x + way[0] * step, y + way[1] * step);
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

