// The exposure sheet: a row for each cel, as wide as the timeline above it. In a cut the rows of a
// shot are below its name, and unfold; so are the second film's rows.
//
//   /sheet.json --> sheet.rows --what is unfolded--> sheet.shown --> the names, and the canvas
//
// The canvas covers what is seen of them: browsers have no canvas as high as two thousand rows.
import { drawStrip } from "/cost.js";
import { read } from "/fetch.js";
import { celNames, showObjects } from "/objects.js";
import { look } from "/pictures.js";
import {
  clamp, element, here, icon, isReady, label, lanes, looks, main, refill, setPressed, state,
  stateOf, view,
} from "/state.js";
import { brushOf, busy, coloursOf, heard, setBusy, shotsOf, unit, xOf } from "/timeline.js";

const ROW = 22, STRIP = 32;  // CSS pixels
export const SHEET_MOST = 10000;    // frames of a sheet, as the server has them
const ROWS_MOST = 2000;      // rows that are shown
const NARROW = 12;           // CSS pixels below which boxes are not told apart
const ONION_MOST = 3;        // drawings before and after
const sheet = { rows: [], parents: new Set(), shown: [], builds: "" };
const unfolded = new Map();  // whether the rows of a shot are shown, by its name
export const folded = new Set(); // cels, and other rows of the outliner, without their parts

/** The builds of the films whose sheets are wanted. */
const buildsOf = () => lanes().filter(isReady).map(one => stateOf(one).build).join();

/** Asks for the sheets if they are seen and older than the films. */
export async function loadSheet() {
  const builds = buildsOf(), isWanted = () => builds === buildsOf();
  if (here("sheet").hidden || !state.shown || sheet.builds === builds) return;
  sheet.builds = builds;
  setBusy("sheet", true);
  const said = await Promise.all(lanes().filter(isReady).map(async one => [one,
    await read(`/sheet.json?side=${one.side}&build=${stateOf(one).build}`, isWanted)]));
  if (!isWanted()) return;
  sheet.rows = said.flatMap(([one, all]) => all ? rowsOf(one, all) : []);
  sheet.parents = new Set(sheet.rows.map(row => row.of));
  setBusy("sheet", false);
  showSheet();
}

/** Rows in the order of the outliner: a cel's parts come after it. */
function partsLast(rows) {
  const known = new Set(rows.map(row => row.cel).filter(Boolean)), parts = new Map();
  for (const row of rows.filter(one => known.has(one.of))) {
    parts.set(row.of, [...parts.get(row.of) ?? [], row]);
  }
  return rows.filter(row => !known.has(row.of)).flatMap(row => [row, ...parts.get(row.cel) ?? []]);
}

/** The rows of a film; the second's are below its name, with its frames at their times. */
function rowsOf(one, { rows, frames }) {
  if (one === main) return partsLast(rows).map(row => ({ ...row, end: frames + 1 }));
  const rate = state.film.fps / state.second.film.fps, at = frame => (frame - 1) * rate + 1;
  return rows.map(({ name, cells, moved }) => ({ name, end: at(frames + 1),
    shot: state.has_two ? state.second.script : "Other values",
    cells: cells.map(([from, drawing]) => [at(from), drawing]), moved: (moved || []).map(at) }));
}

function swapFold(name) {
  if (!folded.delete(name)) folded.add(name);
  showSheet();
  showObjects();
}

/** A button that hides the parts of a row, here and in the outliner, or shows them. */
export const foldButton = (name, words = "", isOn = !folded.has(name), act = swapFold) =>
  element("button", { className: "fold", ariaExpanded: String(isOn), onclick: () => act(name) },
          icon("fold"), words);

function swapShot(name) {
  unfolded.set(name, !unfolded.get(name));
  showSheet();
}

const shotOf = name => shotsOf().find(one => one.name === name);

/** Whether the rows of a shot are shown: at first only in the shot that is seen. */
function isUnfolded(name) {
  if (!unfolded.has(name)) {
    const shot = shotOf(name);
    unfolded.set(name, !shot || view.number > shot.at && view.number <= shot.at + shot.count);
  }
  return unfolded.get(name);
}

/** The rows that are shown; those with `heading` are shots. */
function unfoldedRows() {
  const list = [];
  let last, isOn = true;
  for (const row of sheet.rows) {
    if (row.shot !== last) {
      isOn = !row.shot || isUnfolded(row.shot);
      if (row.shot) list.push({ name: row.shot, heading: true, shot: shotOf(row.shot) });
    }
    last = row.shot;
    if (isOn && !folded.has(row.of)) list.push(row);
  }
  return [...list, ...heard.lips].slice(0, ROWS_MOST);
}

/** The name of a row: a shot, or a cel with parts, unfolds. The name of a shot is not repeated. */
function rowName({ name, shot, heading, cel, of }) {
  const isBelow = !heading && name.startsWith(`${shot} / `);
  const words = element("span", { textContent: isBelow ? name.slice(shot.length + 3) : name });
  const fold = heading ? foldButton(name, words, unfolded.get(name), swapShot)
    : cel && sheet.parents.has(cel) && foldButton(cel, words);
  const row = element("li", { title: name, className: cel ? "cel" : "",
                              dataset: { row: name } }, fold || words,
                      ...cel ? switchesOf(cel) : []);
  row.style.setProperty("--depth", heading ? 0 : Boolean(shot) + Boolean(of));
  return row;
}

const stripHeight = () => here("costs").hidden ? 0 : STRIP;

/** Makes the rows again, their names and what is drawn of them. */
export function showSheet() {
  if (here("sheet").hidden) return;
  sheet.shown = unfoldedRows();
  const strip = element("li", { title: "milliseconds", className: "strip" },
                        element("span", { textContent: "milliseconds" }));
  refill(here("names"), [...sheet.shown.map(rowName), ...stripHeight() ? [strip] : []]);
  drawSheet();
}

// ---------------------------------------------------------------- cels in another way

//   a row's buttons --> letters of the cel --> cels.query: pictures; cels.skins: their onion skin
//
// The letters of /frame/N; s: all others are hidden; o: the onion skin is made of this one.
const SWITCHES = {
  s: ["Solo", "solo", "Shows this cel alone"],
  h: ["Hide", "hide", "Hides this cel"],
  l: ["Unlit", "light", "Takes its lights away: white light is on it"],
  f: ["Sharp", "blur", "Takes its defocus away"],
  o: ["Onion", "onion", "Shows its drawings before and after behind it"],
};
const letters = new Map(); // by the names of the cels

// Parts of the address that say how cels are shown; skins: of what the onion skin is made, "": of
// all but grounds. words: in what way, "": as they are.
export const cels = { query: "", skins: "", words: "" };

const has = (name, letter) => (letters.get(name) || "").includes(letter);
const isAny = letter => [...letters.keys()].some(name => has(name, letter));

/** The buttons that change how one cel is shown. */
export function switchesOf(name) {
  return Object.entries(SWITCHES).map(([letter, [what, picture, title]]) => element("button",
    { className: "hlf".includes(letter) ? "switch without" : "switch", title,
      ariaLabel: `${what}: ${name}`, ariaPressed: String(has(name, letter)),
      onclick: () => swapLetter(name, letter) }, icon(picture)));
}

function swapLetter(name, letter) {
  const old = letters.get(name) || "";
  letters.set(name, old.includes(letter) ? old.replace(letter, "") : old + letter);
  queryCels();
  showSheet();
  showObjects();
  if (letter === "o" && looks.onion === 0) nextOnion();
  look();
}

/** Says again how cels are shown, also in a frame whose cels are known now. */
export function queryCels() {
  const rows = sheet.rows.map(row => row.cel).filter(Boolean), isSolo = isAny("s");
  const names = [...new Set([...letters.keys(), ...rows, ...celNames()])];
  const all = names.map(name => [name, (letters.get(name) || "").replace(/[so]/g, "")
    + (isSolo && !has(name, "s") ? "h" : "")]).filter(([, own]) => own);
  const skins = names.filter(name => has(name, "o"));
  const part = (name, value) => `&${name}=${encodeURIComponent(JSON.stringify(value))}`;
  cels.query = all.length ? part("cels", Object.fromEntries(all)) : "";
  cels.skins = skins.length ? part("skins", skins) : "";
  sayCels(all.filter(([, own]) => own.includes("h")).length, all.length);
}

/** Says how many cels are hidden, and how many are changed in all: a render has all as they are. */
function sayCels(hidden, changed) {
  const say = (count, what) => count === 1 ? `1 cel is ${what}` : `${count} cels are ${what}`;
  const parts = [...hidden ? [say(hidden, "hidden")] : [],
                 ...changed > hidden ? [say(changed - hidden, "without lights or focus")] : []];
  cels.words = parts.join(", ");
  here("altered").hidden = here("render-note").hidden = !cels.words;
  here("altered-words").textContent = `${cels.words}.`;
  here("render-note").textContent = `${cels.words} here; the render has all as they are.`;
  here("outliner").classList.toggle("altered", Boolean(cels.words));
  here("view").classList.toggle("altered", Boolean(cels.words));
}

/** Shows all cels as they are. */
export function resetCels() {
  for (const [name, own] of letters) letters.set(name, own.replace(/[^o]/g, ""));
  queryCels();
  showSheet();
  showObjects();
  look();
}

/** The onion skin of one more drawing before and after, or none. */
export function nextOnion() {
  looks.onion = (looks.onion + 1) % (ONION_MOST + 1);
  label("onion", looks.onion ? `Onion skin ${looks.onion}` : "Onion skin");
  setPressed("onion", looks.onion > 0);
  look();
}

// ---------------------------------------------------------------- drawing

/** A row of the sheet: a box for each drawing as long as it is held, a dot where it only moves.
 * Boxes that are too narrow to be told apart are a band. */
function drawRow(brush, row, y, colours) {
  const one = unit(), end = row.end ?? state.film.frames + 1;
  let band = null;
  row.cells.forEach(([from, name], i) => {
    const until = i + 1 < row.cells.length ? row.cells[i + 1][0] : end;
    const x = xOf(from - 1), wide = (until - from) * one, isNarrow = wide < NARROW;
    if (!name || !isNarrow) band = drawWords(brush, band, y, colours);
    if (!name || x > brush.canvas.width || x + wide < 0) return;
    brush.fillStyle = isNarrow || i % 2 ? colours.odd : colours.even;
    const isJoined = isNarrow && row.cells[i + 1]?.[1];
    brush.fillRect(x, y + 3, isJoined ? wide + 0.5 : Math.max(wide - 1, 0.5), ROW - 6);
    if (isNarrow) band = { x: band?.x ?? x, end: x + wide, count: (band?.count ?? 0) + 1 };
    else drawWords(brush, { x, end: x + wide, name }, y, colours);
  });
  drawWords(brush, band, y, colours);
  brush.fillStyle = colours.accent;
  for (const frame of row.moved || []) {
    brush.fillRect(xOf(frame - 0.5) - 1, y + ROW - 5, Math.min(2, Math.max(1, one)), 2);
  }
}

/** Writes into a box, or a band of several, what it is, if there is room. Returns null. */
function drawWords(brush, box, y, colours) {
  const words = box?.name ?? `${box?.count} drawings`, x = Math.max(box?.x, 0);
  brush.fillStyle = colours.text;
  if (box?.end - x > 7 + brush.measureText(words).width) brush.fillText(words, x + 5, y + 15);
  return null;
}

function drawHeading(brush, { shot }, y, colours) {
  if (!shot) return;
  const x = xOf(shot.at), wide = Math.max(1, shot.count * unit() - 1);
  brush.fillStyle = colours.line;
  brush.fillRect(x, y + 3, wide, ROW - 6);
  drawWords(brush, { x, end: x + wide, name: shot.name }, y, colours);
}

/** Draws the rows that are seen. */
export function drawSheet() {
  if (here("sheet").hidden || !state.film) return;
  const rows = sheet.shown, strip = stripHeight(), all = Math.max(1, rows.length) * ROW + strip;
  const top = clamp(here("timeline").scrollTop - here("sheet").offsetTop, 0, all - ROW);
  const height = Math.min(all - top, innerHeight), colours = coloursOf();
  here("cells").style.height = `${all}px`;
  here("rows").style.top = `${top}px`;
  const brush = brushOf(here("rows"), height);
  brush.translate(0, -top);
  if (rows.length === 0) {
    brush.fillStyle = colours.quiet;
    brush.fillText(busy.has("sheet") ? "being read …" : "no cels", 6, 15);
  }
  for (let i = Math.floor(top / ROW); i < rows.length && i * ROW < top + height; i++) {
    (rows[i].heading ? drawHeading : drawRow)(brush, rows[i], i * ROW, colours);
  }
  if (strip) drawStrip(brush, all - STRIP, STRIP, xOf, unit(), 1 / state.film.fps, colours);
}

export function setSheet(isOn) {
  here("sheet").hidden = !isOn;
  here("list").setAttribute("aria-expanded", isOn);
  loadSheet();
  showSheet();
}
