// The inspector: the colour, the place and the objects at a point.
import { post, read } from "/fetch.js";
import { isOpen } from "/panels.js";
import { nameOf } from "/pictures.js";
import { setSpot } from "/points.js";
import {
  buildOf, clamp, element, here, isReady, main, play, state, stateOf, view,
} from "/state.js";
import { gridOf } from "/view.js";

let chosen = null; // the point that was clicked, in film units: { one, x, y }
let chosenFor = ""; // the point and the frame whose objects are wanted

const hex = code => code.toString(16).padStart(2, "0");

/** Shows the colour that is painted at a point of the film; none where nothing is painted. */
function showColour({ painted, pen, canvas }, [w, h], x, y) {
  const column = Math.floor(x / w * painted.size[0]) - painted.crop[0];
  const row = Math.floor(y / h * painted.size[1]) - painted.crop[1];
  const isSeen = clamp(column, 0, canvas.width - 1) === column
    && clamp(row, 0, canvas.height - 1) === row;
  here("colour").hidden = !isSeen;
  if (!isSeen) return;
  const [r, g, b, a] = pen.getImageData(column, row, 1, 1).data;
  here("swatch").style.backgroundColor = `rgb(${r} ${g} ${b} / ${a / 255})`;
  here("hex").value = `#${[r, g, b].map(hex).join("")}`;
  const alpha = Number((a / 255).toFixed(3));
  here("codes").textContent = `red ${r}, green ${g}, blue ${b}, alpha ${alpha}`;
}

/** The place in a file of an object or an error: a button if there is an editor that opens it. */
export function placeButton(one) {
  const textContent = one.file ? `${one.file}:${one.line}` : "";
  if (!state.editor || !textContent) return element("small", { textContent });
  return element("button", { textContent, onclick: () => post("/open", one) });
}

/** A text with the places in it as buttons, if there is an editor that opens them. */
export function placesOf(text, places) {
  const parts = [];
  for (const one of state.editor ? places : []) {
    const button = placeButton(one), at = text.indexOf(button.textContent);
    parts.push(element("small", { textContent: text.slice(0, at) }), button);
    text = text.slice(at + button.textContent.length);
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
  return { x: (painted.crop[0] + column + 0.5) / painted.size[0] * w,
           y: (painted.crop[1] + row + 0.5) / painted.size[1] * h };
}

/** The objects at a point, from front to back. */
export async function hitsAt(one, { x, y }, isWanted) {
  const name = nameOf(one, view.number);
  const place = `/at/${x.toFixed(6)},${y.toFixed(6)}.json`;
  return await read(`${place}?frame=${name}&build=${buildOf(one)}&side=${one.side}`,
                    isWanted) ?? [];
}

const shaded = document.createElement("canvas").getContext("2d", { willReadFrequently: true });

/** The codes of a light, such as [1, .8, .7], as "fff5e0". */
function codesOf(light) {
  shaded.fillStyle = `color(srgb-linear ${light.join(" ")})`;
  shaded.fillRect(0, 0, 1, 1);
  return [...shaded.getImageData(0, 0, 1, 1).data].slice(0, 3).map(hex).join("");
}

/** Words, after a chip of their colour if there is one. */
function saidOf(words, light) {
  const chip = element("i", { className: "chip" });
  if (light) chip.style.backgroundColor = `#${codesOf(light)}`;
  return words ? [" ", element("small", {}, ...light ? [chip] : [], words)] : [];
}

/** The opacity of an object that is not opaque, its paint, and light on a cel that is not white. */
function looksOf({ opacity = 1, light, paint }) {
  const isFlat = Array.isArray(light), isWhite = isFlat && light.every(one => one === 1);
  const shine = isFlat ? light.map(one => Number(one.toFixed(3))).join(", ") : light;
  return [...saidOf(opacity < 1 && `opacity ${Number(opacity.toFixed(3))}`),
          ...saidOf(paint && `paint #${codesOf(paint)}`, paint),
          ...saidOf(shine && !isWhite && `light ${shine}`, isFlat ? light : null)];
}

/** The items that are listed, each with its `words`: an outline without a name has its owner's.
 * Left out are groups and inner cels without a name, and what says the same as the item before. */
function wordsOf(hits) {
  const names = [];
  const list = [...hits].reverse().map(hit => {
    names.length = hit.depth;
    const owner = names.at(-1), { name, kind, depth, form = depth ? "" : kind } = hit;
    names.push(name || owner);
    return { ...hit, words: name ? `${name} (${kind})`
      : form && (owner ? `${owner}, ${form}` : `${form} without a name`) };
  }).reverse().filter(one => one.words);
  const textOf = one => one && JSON.stringify([one.words, one.file, one.line, one.paint]);
  return list.filter((one, i) => textOf(one) !== textOf(list[i - 1]));
}

function hitItem(hit) {
  return element("li", {}, hit.words, ...looksOf(hit),
                 element("p", {}, placeButton(hit),
                         ...hit.via ? [" ", ...placesOf(hit.via, hit.callers)] : []));
}

const headOf = textContent => element("li", { className: "heading", textContent });

/** The items of a list; in a cut, each shot's items below its name. */
export function belowShots(list, itemOf, makeHead = headOf) {
  let last;
  return list.flatMap(one => {
    const isNew = one.shot !== last;
    last = one.shot;
    return [isNew ? makeHead(last ?? "over the shots", last) : [], itemOf(one)].flat();
  });
}

/** Shows the colour and the objects at a point of the window, in CSS pixels. */
export function inspect(one, clientX, clientY) {
  const point = pointOf(one, clientX, clientY);
  if (!point) return;
  chosen = { one, ...point };
  showPoint(one);
}

/** Shows the colour and the objects at the point that was clicked, in the frame of a lane now. */
export async function showPoint(one) {
  if (chosen?.one !== one || !isOpen("inspector") || play.direction !== 0 || !isReady(one)) return;
  const { x, y } = chosen, { film } = stateOf(one), frame = nameOf(one, view.number);
  const wanted = [one.side, buildOf(one), frame, x, y].join(" ");
  showColour(one, film.size, x, y);
  setSpot(one === main ? chosen : null);
  if (wanted === chosenFor) return;
  chosenFor = wanted;
  const [left, top] = [x, y].map(side => side.toFixed(Math.log10(gridOf())));
  here("place").textContent = `x ${left}, y ${top}, frame ${frame}`;
  here("inspector").setAttribute("aria-busy", "true");
  const hits = await hitsAt(one, chosen, () => wanted === chosenFor);
  if (wanted !== chosenFor) return;
  here("inspector").setAttribute("aria-busy", "false");
  here("hint").textContent = hits.length ? "" : "Nothing is there.";
  here("hits").replaceChildren(...belowShots(wordsOf(hits), hitItem));
}
