// The outliner: a tree of the frame's cels, and of what has a name in them.
//
//   /objects.json?frame=N --> tree --> a row for each
//   the pointer over a row outlines what it names; over the picture, it names the object there
import { newest, pause, post, read } from "/fetch.js";
import { belowShots, hitsAt, pointOf } from "/inspector.js";
import { outline, outlined } from "/over.js";
import { isOpen } from "/panels.js";
import { look, nameOf } from "/pictures.js";
import { cels, foldButton, folded, queryCels, switchesOf } from "/rows.js";
import { buildOf, desk, element, here, main, play, refill, state, view } from "/state.js";

const TREE_MOST = 2000; // bytes of the server's answer
const tree = { list: [], address: "" };

export const celNames = () => tree.list.map(one => one.cel).filter(Boolean);

/** Asks for the tree of the frame that is shown, if it is seen. */
export async function loadObjects() {
  if (here("objects").hidden || !state.shown || play.direction !== 0) return;
  const address = `/objects.json?frame=${nameOf(main, view.number)}&build=${buildOf(main)}`;
  if (address === tree.address) return;
  tree.address = address;
  setReading(true);
  const list = await read(address, () => address === tree.address);
  if (address !== tree.address) return;
  setReading(false);
  tree.list = pathsOf(list ?? []);
  showObjects();
  const { query } = cels;
  queryCels();
  if (cels.query !== query) look();
}

function setReading(isOn) {
  here("objects").setAttribute("aria-busy", isOn);
  const { length } = tree.list, hint = here("objects-hint");
  hint.hidden = isOn || (length > 0 && length < TREE_MOST);
  hint.textContent = length ? `These are the first ${length}.`
    : "Nothing has a name in this frame.";
}

/** The rows with what they are called, their paths, "shot/cel/name", and whether they have parts.
 * An inner cel without a name has the name of the row above. cel: the label by which a cel is shown
 * in another way; place: what is outlined. */
function pathsOf(list) {
  const names = [], seen = new Map();
  return list.map((one, i) => {
    names.length = one.depth;
    const cel = one.label, own = cel?.slice(one.shot ? one.shot.length + 1 : 0);
    const label = one.name || own || names.at(-1);
    names.push(label);
    const plain = [...one.shot ? [one.shot] : [], ...names].join("/"), count = seen.get(plain) || 0;
    seen.set(plain, count + 1);
    return { ...one, cel, label, path: count ? `${plain} ${count + 1}` : plain,
             isParent: (list[i + 1]?.depth ?? 0) > one.depth,
             place: one.file && { file: one.file, line: one.line, name: one.name, cel: names[0] } };
  });
}

const foldOf = one => one.cel ?? one.path;

/** The rows that no folded row hides. */
function shownRows() {
  let until = Infinity;
  return tree.list.filter(one => {
    if (one.depth > until) return false;
    until = folded.has(foldOf(one)) ? one.depth : Infinity;
    return true;
  });
}

/** The name of a shot, which unfolds. */
const headRow = (name, shot) => element("li", { className: "heading", dataset: { head: name } },
                                        foldButton(`${shot}/`, name));

function objectRow(one) {
  if (folded.has(`${one.shot}/`)) return [];
  const name = element("button", { className: "name", textContent: one.label,
    title: one.file ? `${one.file}:${one.line}` : "",
    onclick: () => { if (state.editor && one.file) post("/open", one); } });
  const row = element("li", { className: one.kind, dataset: { object: one.path } },
    one.isParent ? Object.assign(foldButton(foldOf(one)), { ariaLabel: `${one.label}: parts` })
      : element("i", { className: "leaf" }), name,
    ...one.cel ? switchesOf(one.cel) : []);
  row.style.setProperty("--depth", one.depth + Boolean(one.shot));
  for (const event of ["pointerenter", "pointerleave", "focusin", "focusout"]) {
    const isIn = /enter|in$/.test(event);
    row.addEventListener(event, () => outline(isIn && one.place || null));
  }
  return row;
}

export function showObjects() {
  if (here("objects").hidden) return;
  refill(here("object-list"), belowShots(shownRows(), objectRow, headRow));
  setReading(here("objects").ariaBusy === "true");
}

// ---------------------------------------------------------------- under the pointer

let isPointing = false; // whether the pointer is over the picture

const nameAt = newest(async ({ one, event }, isNewest) => {
  const point = pointOf(one, event.clientX, event.clientY);
  await pause(0.06); // until the pointer rests
  if (!isNewest()) return;
  const hits = point ? await hitsAt(one, point, isNewest) : [];
  const isMixed = new Set(hits.map(hit => hit.shot)).size > 1;
  if (isPointing) nameUnder(hits.find(known => known.name), isMixed, event);
});

/** Names and outlines the object at the pointer, while the objects or the inspector are seen. */
export function pointAt(one, event) {
  const isWanted = isOpen("objects") || isOpen("inspector");
  if (one !== main || !isWanted || event.buttons || play.direction !== 0) return;
  isPointing = true;
  nameAt({ one, event });
}

/** Names an object beside the pointer, and outlines it; isMixed: in a transition, where its shot is
 * named, too. */
function nameUnder(hit, isMixed, event) {
  const under = here("under");
  under.hidden = !hit;
  under.textContent = hit ? (isMixed && hit.shot ? `${hit.shot} / ` : "") + hit.name : "";
  if (hit) {
    under.style.left = 0; // it is no wider than what is right of it
    const box = desk.getBoundingClientRect(), { offsetWidth: w, offsetHeight: h } = under;
    const left = Math.max(0, Math.min(event.clientX - box.left + 14, box.width - w));
    const top = Math.max(0, Math.min(event.clientY - box.top + 18, box.height - h));
    Object.assign(under.style, { left: `${left}px`, top: `${top}px` });
  }
  if (hit?.file) outline(hit);
  else if (outlined.place && !outlined.place.count) outline(null);
}

export function leavePoint() {
  isPointing = false;
  nameUnder(null, false);
}
