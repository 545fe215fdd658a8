// Rendering from the page: a form, what the server says of the render, and the command line.
//
//   #render-form --/render--> idle, asking (a file is there), running, done, failed, cancelled
import { post } from "/fetch.js";
import { onPanel } from "/panels.js";
import { here, label, loop, main, state, view } from "/state.js";
import { renderOf, stemOf } from "/values.js";

let isNamed = false;    // whether the name of the file was typed
let isProposed = false; // whether the format and the frames were
let own = null;         // what the page says by itself: a question, or a refusal; null: nothing

const form = here("render-form"), field = name => form.elements.namedItem(name);

/** The ending of the format's files: "####.png" if there are several. */
function ending() {
  const { value } = field("format"), isStill = field("range").value === "frame"
    || field("range").value === "all" && state.film.frames === 1;
  return ["png", "exr"].includes(value) && !isStill ? `####.${value}` : value;
}

/** Proposes the name of the file, or gives the name that was typed the ending of the format. */
function nameFile() {
  const stem = isNamed ? field("file").value.replace(/(\.#+)?\.[^./]*$/, "") : stemOf();
  field("file").value = `${stem}.${ending()}`;
}

/** The frames of the range, as the command line has them; "": all. */
function rangeText() {
  const { first } = state.film, range = field("range").value;
  if (range === "frame") return String(view.number + first - 1);
  return range === "loop" ? `${loop.from + first - 1}-${loop.to + first - 1}` : "";
}

/** What is sent to the server. */
function renderWish() {
  return { format: field("format").value, file: field("file").value, frames: rangeText(),
           size: field("size").value.trim(), replace: own?.state === "asking",
           draft: field("draft").checked };
}

function showRenderCommand() {
  if (!state.film) return;
  if (!isNamed) nameFile();
  const { file, frames, size, draft } = renderWish(), { folder } = state;
  const more = [...frames ? ["--frames", frames] : [], ...size ? ["--size", size] : [],
                ...draft ? ["--draft"] : []];
  here("render-command").value = renderOf(main, folder + file, more);
}

/** Proposes what the film is, once: a video if it moves, with the sound if it has one. */
function propose() {
  if (!isProposed) {
    field("format").value = state.film.frames === 1 ? "png" : "mp4";
    field("range").value = loop.from > 1 || loop.to < state.film.frames ? "loop" : "all";
  }
  isProposed = true;
  field("size").placeholder = state.film.size.join("x");
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

/** Shows what the page, or else the server, says of the render: { state, done, count, left, file,
 * message }. */
export function showRender() {
  const server = state.render ?? { state: "idle" }, isRunning = server.state === "running";
  if (isRunning) own = null;
  const said = own ?? server, isAsking = said.state === "asking";
  const left = said.left > 1 ? `, ${Math.ceil(said.left)} s left` : "";
  const { done = 0, count = 1 } = said;
  here("render-state").dataset.state = said.state;
  here("render-words").textContent = sayings[said.state]({ ...said, left });
  Object.assign(here("render-progress"), { hidden: !isRunning, max: count, value: done });
  here("render-cancel").hidden = !isRunning && !isAsking;
  here("render-start").disabled = isRunning;
  label("render-start", isAsking ? "Replace it" : "Start");
  label("render", isRunning ? `${Math.floor(100 * done / count)} %` : "Render");
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
  const wish = renderWish(), answer = await post("/render", wish).catch(() => null);
  if (!answer || answer.ok) return say(null);
  const { exists, message } = refusalOf((await answer.text()).trim());
  say(exists ? { state: "asking", file: wish.file } : { state: "failed", message });
}

function cancelRender() {
  if (own) say(null);
  else post("/render", { cancel: true }).catch(() => {});
}

/** Hears the form. */
export function beginRender() {
  field("file").addEventListener("input", () => { isNamed = field("file").value !== ""; });
  field("format").addEventListener("change", nameFile);
  form.addEventListener("input", () => { say(null); showRenderCommand(); });
  form.addEventListener("change", showRenderCommand);
  form.addEventListener("submit", startRender);
  here("render-cancel").addEventListener("click", cancelRender);
  onPanel("render-form", isOn => {
    if (!isOn || !state.film) return;
    propose();
    field("format").focus();
  });
}
