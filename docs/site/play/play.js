// The playground: a live script of its own (live/live.js), with examples, values, files that are
// dropped, its address, and what can be saved of it.
import { element } from "../live/field.js";
import { WHOLE, film, give, prepare, stop } from "../live/film.js";
import { Live } from "../live/live.js";
import { RATE, mix } from "./export.js";
import { fragment, shared } from "./share.js";

const PATIENCE = 400; // milliseconds until a still frame gets its digest
const MOST_TEXT = 1e6, MOST_FILE = 2 ** 28; // bytes
const KINDS = { png: "Picture (PNG)", mp4: "Film with sound (MP4)", webm: "Film with sound (WebM)",
                apng: "Film (APNG)", svg: "Drawing (SVG)", json: "Film (Lottie)", plane: "Film (plane)" };
const VIDEOS = ["mp4", "webm"];
const WRITTEN = ["svg", "json", "plane"]; // by an engine of its own
const LOADING = "The part of the engine that writes SVG, Lottie and planes is loaded.";
const STILLS = ["png", "svg"], SIZELESS = ["json", "plane"];
const SCALES = [1, 2, 0.5, 0.25];

const at = id => document.getElementById(id);
const say = sentence => { at("said").textContent = sentence; };
const live = new Live(document.querySelector("figure.script"));
const OWN = live.original; // the script that the page has
const files = new Set();
let facts = {}, known = ""; // what the worker said about the film, and of which film it was
let shown = "", waits; // the command and its script; until the digest is printed
let isSaving = false, wasStopped = false;

const now = () => film(live.field.text, { name: live.name, set: live.set });
const size = () => at("size").value.split("x").map(Number);

// ---- values

const long = colour => colour.length < 6 ? colour.replace(/[^#]/g, "$&$&").slice(0, 7)
  : colour.slice(0, 7);

function control({ name, kind, value, about, least, most, choices }) {
  const given = Object.hasOwn(live.set, name) ? live.set[name] : value;
  const isRange = kind === "number" && Number.isFinite(most - least);
  const shown = element("output", { value: isRange ? given : "" });
  const own = kind === "choice" ? element("select", {}, ...choices.map(one => new Option(one)))
    : element("input", { type: isRange ? "range" : { number: "number", boolean: "checkbox",
      colour: "color" }[kind] ?? "text" });
  if (isRange) Object.assign(own, { min: least, max: most });
  const isWhole = [least, most, Number(value)].every(Number.isInteger) && most - least >= 10;
  if (kind === "number") own.step = isWhole ? 1 : isRange ? (most - least) / 200 : "any";
  if (kind === "boolean") own.checked = given === "true";
  else own.value = kind === "colour" ? long(given) : given;
  own.oninput = () => {
    live.set = { ...live.set, [name]: kind === "boolean" ? String(own.checked) : own.value };
    if (isRange) shown.value = own.value;
    live.look();
  };
  return element("label", { title: about }, `${name} `, own, shown);
}

// ---- the command, and what it prints

const quoted = word => /^[\w./=#,:-]+$/.test(word) && word[0] !== "#" ? word
  : `'${word.replaceAll("'", "'\\''")}'`;

/** Prints the digest of a frame that stays. */
function printDigest() {
  clearTimeout(waits);
  waits = setTimeout(async () => {
    if (live.isPlaying || isSaving) return printDigest();
    const { frame } = live, [width, height] = size(), of = shown;
    const digest = await now().digest({ frame, width, height }).catch(() => "");
    if (digest && frame === live.frame && of === shown) at("digest").textContent = `${frame} ${digest}`;
  }, PATIENCE);
}

function command() {
  const kind = at("kind").value, part = ` --frames ${live.frame}`;
  const values = Object.entries(live.set).map(pair => ` --set ${quoted(pair.join("="))}`);
  const common = `celspan render ${live.name}${values.join("")}`;
  const sized = ` --size ${at("size").value}`;
  const output = `${STILLS.includes(kind) ? part : ""} -o film.${kind}`;
  const text = `${common}${SIZELESS.includes(kind) ? "" : sized}${output}
${common}${sized}${part} --hash`;
  at("save").disabled = false;
  if (shown === text + live.field.text) return;
  shown = text + live.field.text;
  at("command").textContent = text;
  at("digest").textContent = "";
  printDigest();
}

function showSizes({ width, height }) {
  const text = scale => `${Math.round(width * scale)}x${Math.round(height * scale)}`;
  if (at("size").options[0]?.value === text(1)) return;
  at("size").replaceChildren(...SCALES.map(scale =>
    new Option(text(scale).replace("x", " × "), text(scale))));
}

/** After each picture. */
async function update() {
  const film = JSON.stringify([live.field.text, live.set]);
  showSizes(live.made);
  command();
  if (film === known) return;
  known = film;
  const before = JSON.stringify(facts.parameters);
  const about = await now().about({ frame: live.frame }).catch(() => null);
  if (!about) return;
  facts = about;
  at("printed").textContent = facts.printed;
  live.set = Object.fromEntries(Object.entries(live.set).filter(([given]) =>
    facts.parameters.some(({ name }) => name === given)));
  if (JSON.stringify(facts.parameters) === before) return;
  at("values").replaceChildren(...facts.parameters.map(control));
}

// ---- files

async function soundOf({ count, fps }) {
  const sounds = await now().sounds({ frame: live.frame });
  if (!sounds.length) return null;
  const context = new OfflineAudioContext(2, 1, RATE);
  for (const sound of sounds) {
    const name = sound.path.slice(0, 40);
    if (sound.speed !== 1) {
      throw new Error(`${name}: this page cannot change the speed of a sound; the program can.`);
    }
    const bytes = sound.bytes?.slice().buffer ?? await (await fetch(sound.path)).arrayBuffer();
    const buffer = await context.decodeAudioData(bytes)
      .catch(() => { throw new Error(`${name}: this browser cannot read this sound.`); });
    sound.samples = Array.from({ length: Math.min(2, buffer.numberOfChannels) },
      (_, channel) => buffer.getChannelData(channel));
    delete sound.bytes;
  }
  return mix(sounds, count / fps);
}

const megabytes = bytes => `${(bytes / 1e6).toFixed(2)} MB`;

/** A file of another engine, and what is said of it. */
async function write(kind, width, height) {
  say(LOADING);
  await prepare(WHOLE);
  say("");
  if (wasStopped) throw new Error(STOPPED);
  return now().write({ kind, frame: live.frame, width, height },
    share => { at("progress").value = share; });
}

const STOPPED = "Nothing was saved: it was stopped.";

export async function save(kind = at("kind").value) {
  const [width, height] = size(), { made, frame } = live;
  if (WRITTEN.includes(kind)) return write(kind, width, height);
  const { first, count } = kind === "png" ? { first: frame, count: 1 } : made;
  const sound = VIDEOS.includes(kind) ? await soundOf(made) : null;
  if (wasStopped) throw new Error(STOPPED);
  const blob = await now().save({ kind, width, height, sound, first, count },
    share => { at("progress").value = share; });
  return { blob, notes: [] };
}

async function saveOrStop() {
  wasStopped = isSaving;
  if (isSaving) return ["save", "write"].forEach(call => stop(call, STOPPED));
  const kind = at("kind").value;
  isSaving = at("kind").disabled = true;
  live.pause();
  at("save").textContent = "Stop";
  say("");
  at("progress").hidden = false;
  at("progress").value = 0;
  try {
    const { blob, notes } = await save(kind), name = `film.${kind.replace("apng", "png")}`;
    const link = element("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 6e4);
    say([`${name} was saved: ${megabytes(blob.size)}.`, ...notes].join("\n"));
  } catch (error) { say(error.message); }
  isSaving = at("kind").disabled = false;
  at("save").textContent = "Save";
  at("progress").hidden = true;
}

async function take(list) {
  for (const file of list) {
    const isScript = file.name.endsWith(".lua") && list.length === 1;
    if (file.size > (isScript ? MOST_TEXT : MOST_FILE)) {
      say(`${file.name} has ${megabytes(file.size)}: too much for this page.`);
      return;
    }
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (isScript) replace(new TextDecoder().decode(bytes));
    else {
      await give(`/${file.name}`, bytes);
      files.add(file.name);
      say(`Scripts can read ${[...files].join(", ")}.`);
    }
  }
  live.look();
}

// ---- scripts

const version = () => facts.version ?? live.figure.dataset.version;

function replace(source) {
  live.set = {};
  live.frame = undefined;
  live.original = live.other = source;
  live.field.text = source;
}

async function share() {
  try {
    history.replaceState(null, "", await fragment(version(), live.field.text));
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    say(`The address of this page now has the script${files.size ? ", but not its files" : ""}.`);
  } catch (error) { say(error.message); }
}

async function load() {
  const given = await shared(location.hash).catch(error => { say(error.message); });
  if (given) replace(given.source);
  await live.look();
  if (live.made) await update();
  if (given && version() !== given.version) {
    say(`This script comes from celspan ${given.version}, and this page has ${
      version()}: the picture may differ.`);
  }
}

async function showExamples() {
  const examples = await (await fetch(new URL("examples.json", import.meta.url))).json();
  at("examples").append(...examples.map(({ name, about }) => new Option(about ?? name, name)));
  at("examples").onchange = () => {
    replace(examples.find(({ name }) => name === at("examples").value)?.source ?? OWN);
  };
}

at("kind").append(...Object.entries(KINDS).map(([kind, name]) =>
  new Option(name, kind)));
at("kind").onchange = at("size").onchange = command;
at("save").onclick = saveOrStop;
at("share").onclick = share;
at("files").onchange = () => take(at("files").files);
live.figure.addEventListener("drawn", update);
live.figure.addEventListener("reverted", () => { facts.parameters = undefined; }); // new controls
const hasFiles = event => event.dataTransfer.types.includes("Files");
addEventListener("dragover", event => { if (hasFiles(event)) event.preventDefault(); });
addEventListener("drop", event => {
  if (!hasFiles(event)) return;
  event.preventDefault();
  take(event.dataTransfer.files);
});
addEventListener("hashchange", load);
document.addEventListener("visibilitychange", () => { if (document.hidden) live.pause(); });
showExamples();
load();
