// The outliner: a tree of the frame's cels, and of what has a name in them.
//
//   /objects.json?frame=N --> tree --> a row for each
//   the pointer over a row outlines what its line made, over the picture the object there
import { fetch } from "/fetch.js";
import { hitsAt, pointOf } from "/inspector.js";
import { outline, outlined } from "/over.js";
import { isOpen } from "/panels.js";
import { nameOf, place } from "/pictures.js";
import { hasLetter, swapLetter } from "/rows.js";
import { element, here, icon, label, main, pause, play, post, state, view } from "/state.js";
import { shotsOf } from "/timeline.js";

const tree = { list: [], address: "" };
const folded = new Set(); // paths of rows whose children are hidden
let pointed = 0;          // the number of the newest question about the place of the pointer

export const celNames = () => tree.list.map(one => one.cel).filter(Boolean);

/** Asks for the tree of the frame that is shown, if it is seen. */
export async function loadObjects() {
  if (here("objects").hidden || !state.shown || play.direction !== 0) return;
  const address = `/objects.json?frame=${nameOf(main, view.number)}&build=${state.build}`;
  if (address === tree.address) return;
  tree.address = address;
  here("objects").setAttribute("aria-busy", "true");
  const answer = await fetch(address).catch(() => null);
  const list = answer?.ok ? await answer.json() : [];
  if (address !== tree.address) return;
  here("objects").setAttribute("aria-busy", "false");
  tree.list = pathsOf(list);
  showObjects();
}

/** The rows with their paths, "shot/cel/name", and whether they have children. */
function pathsOf(list) {
  const at = view.number - 1, names = [], seen = new Map();
  const shots = shotsOf().filter(shot => shot.at <= at && at < shot.at + shot.count);
  const shot = shots.length === 1 ? [shots[0].name] : []; // in a transition there are two
  return list.map((one, i) => {
    const cel = one.label, name = one.name || cel?.replace(/^.*\//, "") || one.kind;
    names.length = one.depth;
    names.push(name);
    const plain = [...shot, ...names].join("/"), count = seen.get(plain) || 0;
    seen.set(plain, count + 1);
    return { ...one, cel, label: name, path: count ? `${plain} ${count + 1}` : plain,
             isParent: (list[i + 1]?.depth ?? 0) > one.depth };
  });
}

/** The rows that no folded row hides. */
function shownRows() {
  let until = Infinity;
  return tree.list.filter(one => {
    if (one.depth > until) return false;
    until = folded.has(one.path) ? one.depth : Infinity;
    return true;
  });
}

const BUTTONS = { s: ["Solo", "solo"], h: ["Hide", "eye"], l: ["Light off", "light"],
                  f: ["Focus off", "focus"] };

function objectRow(one) {
  const row = element("li", { className: one.kind }), isFolded = folded.has(one.path);
  row.dataset.object = one.path;
  row.style.setProperty("--depth", one.depth);
  const fold = element("button", { className: "fold", ariaLabel: `${one.label}: parts`,
    ariaExpanded: String(!isFolded), onclick: () => {
      if (!folded.delete(one.path)) folded.add(one.path);
      showObjects();
    } }, icon("fold"));
  const place = one.file ? `${one.file}:${one.line}` : "";
  const name = element("button", { className: "name", title: place, textContent: one.label,
    onclick: () => { if (state.editor && place) post("/open", one); } });
  row.append(one.isParent ? fold : element("i", { className: "leaf" }), name);
  if (one.cel) row.append(...objectSwitches(one.cel));
  row.addEventListener("pointerenter", () => outline(one.file ? one : null));
  row.addEventListener("pointerleave", () => outline(null));
  row.addEventListener("focusin", () => outline(one.file ? one : null));
  row.addEventListener("focusout", () => outline(null));
  return row;
}

function objectSwitches(name) {
  return Object.entries(BUTTONS).map(([letter, [what, picture]]) => element("button",
    { className: "switch", title: what, ariaLabel: `${what}: ${name}`,
      ariaPressed: String(hasLetter(name, letter)), onclick: () => swapLetter(name, letter) },
    icon(picture)));
}

export function showObjects() {
  if (here("objects").hidden) return;
  const focus = document.activeElement?.closest("[data-object]")?.dataset.object;
  here("object-list").replaceChildren(...shownRows().map(objectRow));
  here("objects-hint").hidden = tree.list.length > 0;
  if (focus) [...here("object-list").children].find(one => one.dataset.object === focus)
    ?.querySelector("button").focus();
}

// ---------------------------------------------------------------- under the pointer

/** Names and outlines the object at the pointer, while the objects or the inspector are seen. */
export async function pointAt(one, event) {
  const isWanted = isOpen("objects") || isOpen("inspector");
  if (one !== main || !isWanted || event.buttons || play.direction !== 0) return;
  const wanted = ++pointed, point = pointOf(one, event.clientX, event.clientY);
  await pause(0.06); // until the pointer rests
  if (wanted !== pointed) return;
  const hit = point ? (await hitsAt(one, point)).find(known => known.name) : null;
  if (wanted !== pointed) return;
  nameUnder(hit);
}

function nameUnder(hit) {
  here("under").hidden = !hit;
  here("under").textContent = hit ? hit.name : "";
  if (hit?.file) outline(hit);
  else if (outlined.place && !outlined.place.count) outline(null);
}

export function leavePoint() {
  pointed++;
  nameUnder(null);
}

