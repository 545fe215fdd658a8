// The exposure sheet: a row for each cel, as wide as the timeline above it. In a cut the rows of a
// shot are below its name, and unfold.
import * as cost from "/cost.js";
import { fetch } from "/fetch.js";
import { celNames, showObjects } from "/objects.js";
import { look } from "/pictures.js";
import { element, here, icon, state, view } from "/state.js";
import { brushOf, busy, coloursOf, heard, setBusy, shotsOf, unit, xOf } from "/timeline.js";

const ROW = 22, STRIP = 32;  // CSS pixels
export const SHEET_MOST = 10000;    // frames of a sheet, as the server has them
const ROWS_MOST = 2000;      // rows that are shown
const sheet = { rows: [], frames: 1, build: 0 };
const unfolded = new Map();  // whether the rows of a shot are shown, by its name

/** Asks for the sheet if it is open and older than the film. */
export async function loadSheet() {
  if (here("sheet").hidden || !state.shown || sheet.build === state.build) return;
  const build = sheet.build = state.build;
  setBusy("sheet", true);
  const answer = await fetch(`/sheet.json?build=${build}`).catch(() => null);
  const said = answer?.ok ? await answer.json() : { rows: [], frames: 1 };
  if (build !== state.build) return;
  Object.assign(sheet, said);
  setBusy("sheet", false);
  nameRows();
  drawSheet();
}

/** Whether the rows of a shot are shown: at first those of the shot that is seen. */
function isUnfolded(name) {
  if (unfolded.has(name)) return unfolded.get(name);
  const shot = shotsOf().find(one => one.name === name);
  return !shot || view.number > shot.at && view.number <= shot.at + shot.count;
}

/** The rows that are shown; those with `heading` are shots. */
function rowsOf() {
  const list = [];
  let last = null;
  for (const row of sheet.rows) {
    if (row.shot && row.shot !== last) list.push({ name: row.shot, heading: true, cells: [] });
    last = row.shot;
    if (!row.shot || isUnfolded(row.shot)) list.push(row);
  }
  return [...list, ...heard.lips].slice(0, ROWS_MOST);
}

/** The name of a row: that of a shot unfolds. */
function rowName(row) {
  const one = element("li", { title: row.name, className: row.heading ? "heading" : "" });
  one.dataset.row = row.name;
  if (!row.heading) {
    one.append(element("span", { textContent: row.name }));
    if (row.cel) one.append(...Object.keys(SWITCHES).map(letter => celSwitch(row.cel, letter)));
    return one;
  }
  const isOn = isUnfolded(row.name);
  one.append(element("button", { className: "fold", ariaExpanded: String(isOn), onclick: () => {
    unfolded.set(row.name, !isOn);
    nameRows();
    drawSheet();
  } }, icon("fold"), element("span", { textContent: row.name })));
  return one;
}

export function nameRows() {
  const strip = element("li", { title: "milliseconds", className: "strip" },
                        element("span", { textContent: "milliseconds" }));
  here("names").replaceChildren(...rowsOf().map(rowName), ...here("costs").hidden ? [] : [strip]);
}

// ---------------------------------------------------------------- cels in another way

// The letters of /frame/N, and s: all other cels are hidden.
const SWITCHES = { s: "solo", h: "hidden", l: "light off", f: "focus off" };
export const cels = { letters: {}, query: "" }; // letters: by the names of the cels

export const hasLetter = (name, letter) => (cels.letters[name] || "").includes(letter);

/** Changes how a cel is shown. */
export function swapLetter(name, letter) {
  const old = cels.letters[name] || "";
  cels.letters[name] = old.includes(letter) ? old.replace(letter, "") : old + letter;
  queryCels();
  nameRows();
  showObjects();
  look();
}

/** A button that changes how one cel is shown. */
function celSwitch(name, letter) {
  const what = SWITCHES[letter];
  return element("button", { className: "switch", textContent: letter.toUpperCase(),
    title: `${name}: ${what}`, ariaLabel: `${name}: ${what}`,
    ariaPressed: String(hasLetter(name, letter)), onclick: () => swapLetter(name, letter) });
}

/** The part of the address that says how cels are shown. */
function queryCels() {
  const hasSolo = Object.keys(cels.letters).some(name => hasLetter(name, "s")), all = {};
  const names = new Set([...sheet.rows.map(row => row.cel).filter(Boolean), ...celNames()]);
  for (const name of names) {
    const letters = cels.letters[name] || "";
    const own = letters.replace("s", "") + (hasSolo && !letters.includes("s") ? "h" : "");
    if (own) all[name] = own;
  }
  const isPlain = Object.keys(all).length === 0;
  cels.query = isPlain ? "" : `&cels=${encodeURIComponent(JSON.stringify(all))}`;
}

// ---------------------------------------------------------------- drawing

/** A row of the sheet: a box for each drawing as long as it is held, a dot where it only moves. */
function drawRow(brush, row, y, colours) {
  const one = unit();
  row.cells.forEach(([from, name], i) => {
    const until = i + 1 < row.cells.length ? row.cells[i + 1][0] : sheet.frames + 1;
    const x = xOf(from - 1), wide = (until - from) * one;
    if (!name || x > brush.canvas.width || x + wide < 0) return;
    brush.fillStyle = i % 2 ? colours.odd : colours.even;
    brush.fillRect(x, y + 3, Math.max(1, wide - (wide > 3 ? 1 : 0)), ROW - 6);
    brush.fillStyle = colours.text;
    if (wide > 8 + 7 * name.length) brush.fillText(name, Math.max(x, 0) + 4, y + 15);
  });
  brush.fillStyle = colours.accent;
  for (const frame of row.moved || []) {
    brush.fillRect(xOf(frame - 0.5) - 1, y + ROW - 5, Math.min(2, Math.max(1, one)), 2);
  }
}

function drawHeading(brush, row, y, colours) {
  const shot = shotsOf().find(one => one.name === row.name);
  brush.fillStyle = colours.line;
  if (shot) brush.fillRect(xOf(shot.at), y + 4, Math.max(1, shot.count * unit() - 1), ROW - 8);
}

export function drawSheet() {
  if (here("sheet").hidden || !state.film) return;
  const rows = rowsOf(), strip = here("costs").hidden ? 0 : STRIP;
  const height = Math.max(1, rows.length) * ROW + strip, colours = coloursOf();
  const brush = brushOf(here("rows"), height);
  if (sheet.rows.length === 0) {
    brush.fillStyle = colours.quiet;
    brush.fillText(busy.has("sheet") ? "being read …" : "no cels", 6, 15);
  }
  rows.forEach((row, i) => (row.heading ? drawHeading : drawRow)(brush, row, i * ROW, colours));
  if (strip) {
    cost.drawStrip(brush, height - STRIP, STRIP, xOf, unit(), 1 / state.film.fps, colours);
  }
}

export function setSheet(isOn) {
  here("sheet").hidden = !isOn;
  here("list").setAttribute("aria-expanded", isOn);
  if (!isOn) return;
  loadSheet();
  nameRows();
  drawSheet();
}

