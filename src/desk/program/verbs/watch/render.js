// Rendering from the page: a form, what the server says of the render, and the command line.
//
//   #render-form --/render--> idle, asking (a file is there), running, done, failed, cancelled
import { post } from "/fetch.js";
import { isOpen, onPanel } from "/panels.js";
import { element, here, label, loop, main, setWords, state, view, write } from "/state.js";
import { marksOf, shotsOf } from "/timeline.js";
import { renderOf, stemOf } from "/values.js";

let isNamed = false;    // whether the name of the file was typed
let isProposed = false; // whether the format and the frames were
let moving = "";        // the video format in whose place a picture was proposed for one frame
let own = null;         // what the page says by itself: a question, or a refusal; null: nothing
let begun = 0;          // the number of the last render that the page has begun
let told = null;        // the last render whose end was seen in the form

const form = here("render-form"), field = name => form.elements.namedItem(name);
/** Whether each frame is a file of its own. */
const isPicture = () => field("format").selectedOptions[0]?.hasAttribute("data-still");
const isLooped = () => loop.from > 1 || loop.to < state.film.frames;

/** What follows the name of the film: the number of a picture, "####" for several, the frames of a
 * video that is a part of the film; and the format. */
function ending() {
  const { value } = field("format"), isOne = field("range").value === "frame", frames = rangeText();
  const isStill = isOne || state.film.frames === 1;
  const part = !isPicture() ? frames : isOne ? frames.padStart(4, "0")
    : isStill ? "" : "####";
  return part ? `.${part}.${value}` : `.${value}`;
}

let last = ""; // the ending that was proposed last

/** Proposes the name of the file, or gives the name that was typed the ending of the format. */
function nameFile() {
  const { value } = field("file");
  const typed = value.endsWith(last) ? value.slice(0, value.length - last.length)
    : value.replace(/(\.#+)?\.[^./]*$/, "");
  last = ending();
  field("file").value = (isNamed ? typed : stemOf()) + last;
}

/** Lists the frames that can be rendered: the loop if there is one, shots, and those from one mark
 * to the next. */
function listRanges() {
  const range = field("range"), { value } = range, { first, frames } = state.film;
  const option = (name, at, count) => element("option", { textContent: name,
    value: `${at + first}-${Math.min(at + count, frames) + first - 1}` });
  const marks = marksOf(), nameOf = i => marks[i]?.name ?? (i < 0 ? "the beginning" : "the end");
  const parts = marks.map(({ at, count }, i) => [i, at, count]);
  if (marks[0]?.at > 0) parts.unshift([-1, 0, marks[0].at]);
  here("render-shots").replaceChildren(...shotsOf()
    .map(({ name, at, count }) => option(name, at, count)));
  here("render-marks").replaceChildren(...parts.filter(([, , count]) => count > 0)
    .map(([i, at, count]) => option(`${nameOf(i)} to ${nameOf(i + 1)}`, at, count)));
  for (const id of ["render-shots", "render-marks"]) here(id).hidden = !here(id).firstChild;
  const looped = range.querySelector("[value=loop]");
  looped.hidden = looped.disabled = !isLooped();
  range.value = value === "loop" && !isLooped() ? "all" : value;
  if (!range.value) range.value = "all"; // these frames are gone
}

/** Proposes a picture for one frame, and the format of before for several. */
function proposeFormat() {
  const format = field("format"), isOne = field("range").value === "frame";
  if (isOne && !isPicture()) [moving, format.value] = [format.value, "png"];
  else if (!isOne && moving) [moving, format.value] = ["", moving];
  nameFile();
}

/** The frames of the range, as the command line has them; "": all. */
function rangeText() {
  const { first } = state.film, range = field("range").value;
  if (range === "frame") return String(view.number + first - 1);
  if (range === "loop") return `${loop.from + first - 1}-${loop.to + first - 1}`;
  return range === "all" ? "" : range;
}

let proposed = ""; // the size that was proposed last

/** Proposes the size of the film, unless another was typed. */
function nameSize() {
  const size = field("size"), own = state.film.size.join("x");
  if (size.value === proposed) size.value = own;
  size.placeholder = proposed = own;
}

/** What is sent to the server. */
function renderWish() {
  const size = field("size").value.trim();
  return { format: field("format").value, file: field("file").value, frames: rangeText(),
           size: size === proposed ? "" : size, replace: own?.state === "asking",
           draft: field("draft").checked };
}

/** Shows the command, and the name of the file, which has the number of this frame. */
export function showRenderCommand() {
  if (!state.film || !isOpen("render-form")) return;
  if (!isNamed || field("file").value.endsWith(last)) nameFile();
  nameSize();
  const { file, frames, size, draft } = renderWish(), { folder } = state;
  if (folder) label("render-place", `In ${folder}`);
  const more = [...frames ? ["--frames", frames] : [], ...size ? ["--size", size] : [],
                ...draft ? ["--draft"] : []];
  here("render-command").value = renderOf(main, folder + file, more);
}

/** Proposes what the film is, once: a video if it moves, with the sound if it has one. */
function propose() {
  if (!isProposed) {
    field("format").value = state.film.frames === 1 ? "png" : "mp4";
    field("range").value = isLooped() ? "loop" : "all";
  }
  isProposed = true;
  listRanges();
  showRenderCommand();
}

const sayings = {
  idle: () => "",
  asking: one => `${one.file} is there already. Replace it?`,
  running: one => one.count ? `frame ${one.done} of ${one.count}${one.left}` : "begins …",
  done: one => `written: ${one.file}`,
  failed: one => one.message,
  cancelled: () => "cancelled; nothing was kept",
};

/** What the server says of the render: { state, number, done, count, left, file, message }. */
function renderOfPage() {
  const { number = 0, ...said } = state.render ?? { state: "idle" };
  return number < begun ? { number, state: "running" } : { number, ...said };
}

/** Shows what the page, or else the server, says of the render. */
export function showRender() {
  const server = renderOfPage(), isRunning = server.state === "running";
  if (isRunning) own = null;
  const said = own ?? server, isAsking = said.state === "asking";
  const left = said.left > 1 ? `, ${Math.ceil(said.left)} s left` : "";
  const { done = 0, count = 1 } = said;
  write(here("render-state").dataset, "state", said.state);
  setWords("render-words", sayings[said.state]({ ...said, left }));
  const progress = { hidden: !isRunning, max: count, value: done };
  for (const [name, value] of Object.entries(progress)) {
    write(here("render-progress"), name, value);
  }
  write(here("render-cancel"), "hidden", !isRunning && !isAsking);
  write(here("render-start"), "disabled", isRunning);
  label("render-start", isAsking ? "Replace it" : "Start");
  showButton(server);
}

/** Says on the button how far a render is, or, until the form is opened, how it has ended. */
function showButton({ state: now, number, done = 0, count = 1 }) {
  if (now !== "running" && (isOpen("render-form") || told === null)) told = number;
  const isNews = told !== null && told !== number, isBad = isNews && now === "failed";
  const ends = { done: "Written", failed: "Failed" };
  label("render", now === "running" ? `${Math.floor(100 * done / count)} %`
    : isNews && ends[now] || "Render");
  here("render").classList.toggle("bad", isBad);
}

/** Says something by the page itself, until the form changes; null: nothing. */
function say(what) {
  own = what;
  showRender();
}

/** What the server says against a render: that the file exists, or a sentence. */
function refusalOf(text) {
  try {
    const { exists, message } = JSON.parse(text);
    return { exists, message: message ?? text };
  } catch {
    return { message: text };
  }
}

async function startRender(event) {
  event.preventDefault();
  const wish = renderWish();
  say({ state: "idle" });
  const answer = await post("/render", wish).catch(() => null);
  if (answer?.ok) begun = (await answer.json()).number ?? 0;
  if (!answer || answer.ok) return say(null);
  const { exists, message } = refusalOf((await answer.text()).trim());
  say(exists ? { state: "asking", file: wish.file } : { state: "failed", message });
}

function cancelRender() {
  if (own) say({ state: "idle" });
  else post("/render", { cancel: true }).catch(() => {});
}

/** Hears the form. */
export function beginRender() {
  field("file").addEventListener("input", () => { isNamed = field("file").value !== ""; });
  field("format").addEventListener("change", () => { moving = ""; nameFile(); });
  field("range").addEventListener("input", proposeFormat);
  form.addEventListener("input", () => { say({ state: "idle" }); showRenderCommand(); });
  form.addEventListener("change", showRenderCommand);
  form.addEventListener("submit", startRender);
  here("render-cancel").addEventListener("click", cancelRender);
  onPanel("render-form", isOn => {
    if (!isOn || !state.film) return;
    propose();
    showRender();
    field("format").focus();
  });
}
