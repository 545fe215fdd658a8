// Values of the film's parameters: the form, the address of the page and the command line.
import { nameLanes } from "/beside.js";
import { post } from "/fetch.js";
import { fieldOf, markField } from "/fields.js";
import { markStale, want } from "/pictures.js";
import { placePoints } from "/points.js";
import {
  beside, buildOf, element, here, isComparing, isReady, lanes, main, part, state, stateOf, write,
} from "/state.js";

// The address contains the values by name. A mark precedes those of the second film, and shows by
// itself that the second film is visible.
const MARK = "2:";
const ADDRESS_PAUSE = 300; // milliseconds

export function readAddress() {
  for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
    const one = name.startsWith(MARK) ? beside : main;
    if (name !== MARK) one.given.set(one === beside ? name.slice(MARK.length) : name, value);
    else post("/compare", { on: true }).catch(() => {});
  }
}

let addressTimer = 0;

/** Writes the address when no value has changed for a while: browsers ask for the icon again for
 * each address, and refuse to take more than a few in a second. */
function writeAddressLater() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(writeAddress, ADDRESS_PAUSE);
}

export function writeAddress() {
  const all = new URLSearchParams(main.given);
  if (isComparing() && !state.has_two) all.set(MARK, "");
  if (isComparing()) for (const [name, value] of beside.given) all.set(MARK + name, value);
  history.replaceState(null, "", all.size ? `/#${all}` : "/");
}

const namesOf = one => stateOf(one)?.parameters.map(known => known.name) ?? [];

/** Sends the values, and asks for the picture with them, which the server answers when it has them;
 * while they are on their way, only the newest are kept. */
async function sendValues(one) {
  one.isChanged = true;
  markStale(one);
  if (one.isSending) return;
  one.isSending = true;
  while (one.isChanged) {
    one.isChanged = false;
    const path = one === main ? "/parameters" : "/parameters?side=2";
    const sent = Object.fromEntries(one.given), arrival = post(path, sent).catch(() => null);
    one.wantedBuild = buildOf(one) + 1;
    want(one);
    const answer = await arrival;
    if (answer?.ok) takeAnswer(one, sent, await answer.json());
    else {
      one.wantedBuild = 0;
      want(one);
    }
  }
  writeAddressLater();
  one.isSending = false;
  markStale(one);
  showForm(one);
}

/** Takes the answer to values: those that are given now, in another form perhaps, and sentences
 * about those that cannot be. */
function takeAnswer(one, sent, { build, values, refused }) {
  one.wantedBuild = build;
  Object.assign(one.wrong, refused);
  if (one.isChanged || !stateOf(one)) return;
  one.given = new URLSearchParams(namesOf(one).filter(name => Object.hasOwn(values, name))
    .map(name => [name, values[name]]));
  for (const [name, value] of one.given) {
    const field = part(one, "form").elements.namedItem(name);
    if (field?.value === sent[name] && !one.wrong[name]) field.value = value;
  }
}

/** Sends the values of the address as soon as a film can take them; without any, the address gets
 * those that the server has. */
export function sendGiven() {
  for (const one of lanes()) {
    if (one.isGiven || !isReady(one)) continue;
    one.isGiven = true;
    if (one.given.size) { sendValues(one); continue; }
    const { parameters } = stateOf(one);
    one.given = new URLSearchParams(parameters.filter(known => known.value !== known.start)
      .map(known => [known.name, known.value]));
    writeAddress();
  }
}

const before = []; // what was given before changes: { name, hand, given: [lane, text] of each }
let hand = 0;      // how often a key or a pointer was pressed or let go

for (const event of ["pointerdown", "pointerup", "keyup"]) {
  document.addEventListener(event, () => { hand++; }, true);
}

/** Keeps what is given before a change of a parameter, "": of several; a drag is one change. */
function keepBefore(name) {
  const last = before.at(-1);
  if (name && last?.name === name && last.hand === hand) return;
  before.push({ name, hand, given: lanes().map(one => [one, String(one.given)]) });
}

/** Gives the values before the last change again; changes that changed nothing are passed. */
export function undoValues() {
  let isDone = false;
  while (!isDone && before.length) {
    for (const [one, text] of before.pop().given) {
      if (!lanes().includes(one) || String(one.given) === text) continue;
      setValues(one, new URLSearchParams(text));
      isDone = true;
    }
  }
}

export function giveValue(one, parameter, value) {
  keepBefore(`${one.side} ${parameter.name}`);
  one.given.set(parameter.name, value);
  parameter.value = value;
  delete one.wrong[parameter.name];
  showCommand();
  markFields(one);
  nameLanes();
  placePoints();
  sendValues(one);
}

/** Gives a parameter the value of the script again. */
export function giveBack(one, { name, start, default: own }) {
  keepBefore("");
  if (start === textOf(own)) one.given.delete(name);
  else one.given.set(name, textOf(own));
  setValues(one, one.given);
}

/** A value as the command line has it: a point is "120,80". */
const textOf = value => Array.isArray(value) ? value.join() : String(value);

const quoted = text => /^[\w.,:/-][\w.,:=/#-]*$/.test(text) ? text
  : `'${text.replaceAll("'", "'\\''")}'`;

/** Whether a parameter has not the value of the script. */
const isChanged = known => known.value !== textOf(known.default);

/** The command that renders a film to a file with these values, the options and the arguments of
 * this run, and more words. */
export function renderOf(one, file, more = []) {
  const { parameters, script, options, arguments: last } = stateOf(one);
  const sets = parameters.filter(isChanged)
    .flatMap(known => ["--set", `${known.name}=${known.value}`]);
  const words = [script, ...options, ...sets, ...more, "-o", file, ...last.length ? ["--"] : [],
                 ...last];
  return `celspan render ${words.map(quoted).join(" ")}`;
}

/** What a render of the film that is watched is called, without an ending. */
export const stemOf = () => state.script.match(/[^/]*$/)[0].replace(/\.\w+$/, "") || "film";

function showCommand() {
  const ending = state.film?.frames > 1 ? ".mp4" : ".png";
  const others = isComparing() ? [renderOf(beside, `other${ending}`)] : [];
  write(here("command"), "value", [renderOf(main, stemOf() + ending), ...others].join("\n"));
}

/** Shows the lines of the script that would have the values of the page. */
function showSource() {
  const lines = state.parameters.filter(isChanged).map(known => known.source).filter(Boolean);
  write(here("source"), "value", lines.map(line => `${line},`).join("\n"));
  write(here("sources"), "hidden", lines.length === 0);
}

/** Marks the fields whose values differ from the script's, or are wrong. */
function markFields(one) {
  for (const known of stateOf(one).parameters) {
    const field = part(one, "form").elements.namedItem(known.name);
    const own = isChanged(known) && textOf(known.default);
    if (field) markField(field, own, one.wrong[known.name]);
  }
}

/** Makes the form of a film again if it has other parameters than before, or after all its values
 * have been given again, when the server has them. */
export function showForm(one) {
  if (!stateOf(one)) return; // it is no longer shown
  const { parameters, build } = stateOf(one);
  if (one.isSending || build < one.wantedBuild) { // the news has values of before
    for (const known of parameters) known.value = one.given.get(known.name) ?? known.start;
  }
  const isRefilled = one.isRefilled && !one.isSending && build >= one.wantedBuild;
  const kinds = JSON.stringify(parameters.map(known => ({ ...known, value: 0, source: 0 })));
  here("tune").hidden = lanes().every(any => stateOf(any).parameters.length === 0);
  showCommand();
  showSource();
  if (kinds !== one.formOf || isRefilled) fillForm(one, parameters);
  if (isRefilled) one.isRefilled = false;
  one.formOf = kinds;
  markFields(one);
}

/** Makes the fields; the focus stays in the one of the same name. */
function fillForm(one, parameters) {
  const form = part(one, "form"), fieldIn = box => box?.querySelector("[name]");
  const { name } = fieldIn(document.activeElement?.closest(".field")) ?? {};
  const isIn = form.contains(document.activeElement);
  form.replaceChildren(...groupsOf(one, parameters));
  if (isIn) form.elements.namedItem(name)?.focus();
}

/** The fields in their order; a group's together, where its first one is. */
function groupsOf(one, parameters) {
  const list = [], groups = new Map();
  for (const known of parameters) {
    const made = fieldOf(one, known);
    if (!known.group) { list.push(made); continue; }
    if (!groups.has(known.group)) {
      const box = element("fieldset", {}, element("legend", { textContent: known.group }));
      groups.set(known.group, box);
      list.push(box);
    }
    groups.get(known.group).append(made);
  }
  return list;
}

// ---------------------------------------------------------------- all values

export function resetValues() {
  keepBefore("");
  for (const one of lanes()) setValues(one, []);
}

/** Gives these values, as pairs of a name and a text, and no others. */
function setValues(one, values) {
  const names = namesOf(one); // the script may have lost some
  one.given = new URLSearchParams([...values].filter(([name]) => names.includes(name)));
  one.wrong = { __proto__: null };
  one.isRefilled = true;
  sendValues(one);
}

/** A value in the form of JSON that --set-from reads. */
function jsonOf({ type, value }) {
  if (type === "array") return value.split(",").map(Number);
  if (type === "boolean") return value === "true";
  return type === "number" ? Number(value) : value;
}

/** Saves the values as a file for --set-from. */
export function saveValues() {
  const all = Object.fromEntries(state.parameters.map(one => [one.name, jsonOf(one)]));
  const file = new Blob([JSON.stringify(all, null, 2), "\n"], { type: "application/json" });
  const link = element("a", { href: URL.createObjectURL(file),
                              download: `${document.title.split(" – ")[0]}.json` });
  link.click();
  URL.revokeObjectURL(link.href);
}

/** Whether something of such a file can be a value: a text, a number, true or false, or numbers. */
const isValue = value => ["string", "number", "boolean"].includes(typeof value)
  || Array.isArray(value) && value.length > 0 && value.every(one => typeof one === "number");

/** Takes the values of such a file. What the film cannot take is left out, and said. */
export async function loadValues() {
  const [file] = here("load-values").files;
  here("load-values").value = "";
  const all = await file?.text().then(text => JSON.parse(text)).catch(() => null);
  if (!all || typeof all !== "object" || Array.isArray(all)) {
    return sayValues(`${file?.name}: it must be a JSON object, { "name": value }`);
  }
  const names = namesOf(main);
  const kinds = { odd: [], bad: [], good: [] };
  for (const [name, value] of Object.entries(all)) {
    const kind = !names.includes(name) ? "odd" : isValue(value) ? "good" : "bad";
    kinds[kind].push([name, textOf(value)]);
  }
  const say = (list, before, after) => list.length
    ? `${file.name}: ${before}${list.map(([name]) => name).join(", ")}${after}. ` : "";
  sayValues(say(kinds.odd, "the film has no ", "") + say(kinds.bad, "", " cannot be that"));
  keepBefore("");
  setValues(main, kinds.good);
}

function sayValues(text) {
  here("values-said").textContent = text;
  here("values-said").hidden = !text;
}

