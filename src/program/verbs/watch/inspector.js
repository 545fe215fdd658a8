// The inspector: the colour, the place and the objects at a point.
import { fetch } from "/fetch.js";
import { nameOf, place } from "/pictures.js";
import { element, here, post, state, stateOf, view } from "/state.js";

let asked_at = ""; // the point whose objects are wanted

const hex = code => code.toString(16).padStart(2, "0");

function showColour(one, x, y) {
  const [r, g, b, a] = one.pen.getImageData(x, y, 1, 1).data;
  here("swatch").style.backgroundColor = `rgb(${r} ${g} ${b} / ${a / 255})`;
  here("hex").value = `#${[r, g, b].map(hex).join("")}`;
  here("codes").textContent = `${r}, ${g}, ${b}   alpha ${(a / 255).toFixed(3)}`;
  here("colour").hidden = false;
}

/** A text with the places in it as buttons, if there is an editor that opens them. */
export function placesOf(text, places) {
  if (!state.editor) return [element("small", { textContent: text })];
  const parts = [];
  for (const place of places) {
    const name = `${place.file}:${place.line}`, at = text.indexOf(name);
    const button = element("button", { textContent: name, onclick: () => post("/open", place) });
    parts.push(element("small", { textContent: text.slice(0, at) }), button);
    text = text.slice(at + name.length);
  }
  return [...parts, element("small", { textContent: text })];
}

/** The point of the film at a place of the window, with its pixel; null: none is there. */
export function pointOf(one, clientX, clientY) {
  const { canvas, painted } = one, box = canvas.getBoundingClientRect();
  const column = Math.floor((clientX - box.left) / box.width * canvas.width);
  const row = Math.floor((clientY - box.top) / box.height * canvas.height);
  const isIn = column >= 0 && row >= 0 && column < canvas.width && row < canvas.height;
  if (!painted || !isIn) return null;
  const [w, h] = stateOf(one).film.size;
  return { column, row, x: (painted.crop[0] + column + 0.5) / painted.size[0] * w,
           y: (painted.crop[1] + row + 0.5) / painted.size[1] * h };
}

/** The objects at a point, from front to back. */
export async function hitsAt(one, { x, y }) {
  const name = nameOf(one, view.number);
  const answer = await fetch(`/at/${x.toFixed(6)},${y.toFixed(6)}.json?frame=${name}`
    + `&side=${one.side}`).catch(() => null);
  return answer?.ok ? answer.json() : [];
}

function hitItem(hit) {
  const item = element("li", {}), place = hit.file ? `${hit.file}:${hit.line}` : "";
  const where = element(state.editor && place ? "button" : "small", { textContent: place });
  if (where.matches("button")) where.onclick = () => post("/open", hit);
  item.append(hit.name ? `${hit.name} (${hit.kind})` : `${hit.kind} without a name`, " ", where);
  if (hit.via) item.append(" ", ...placesOf(hit.via, hit.callers));
  return item;
}

/** Shows the colour and the objects at a point of the window, in CSS pixels. */
export async function inspect(one, clientX, clientY) {
  const point = pointOf(one, clientX, clientY);
  if (!point) return;
  const wanted = asked_at = `${one.side} ${view.number} ${point.x} ${point.y}`;
  here("place").textContent = `x ${point.x.toFixed(2)}, y ${point.y.toFixed(2)}`;
  showColour(one, point.column, point.row);
  here("inspector").setAttribute("aria-busy", "true");
  const hits = await hitsAt(one, point);
  if (wanted !== asked_at) return;
  here("inspector").setAttribute("aria-busy", "false");
  here("hint").textContent = hits.length ? "" : "Nothing is there.";
  here("hits").replaceChildren(...hits.map(hitItem));
}

