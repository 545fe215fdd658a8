// Rendering from the page: a form, what the server says of the render, and the command line.
//
//   #render-form --/render--> idle, asking (a file is there), running, done, failed, cancelled
import { swapMenu } from "/panels.js";
import { element, here, label, loop, main, post, state, view } from "/state.js";
import { quoted, renderOf } from "/values.js";

// What a film can become; the first that fits is proposed.
const FORMATS = {
  mp4: { name: "MP4 video (H.264)", ending: "mp4" },
  webm: { name: "WebM video, with alpha", ending: "webm" },
  mov: { name: "ProRes video, with alpha", ending: "mov" },
  gif: { name: "GIF", ending: "gif" },
  webp: { name: "animated WebP", ending: "webp" },
  png: { name: "PNG pictures", ending: "####.png" },
  exr: { name: "EXR pictures", ending: "####.exr" },
};

let isNamed = false; // whether the name of the file was typed

const renderField = name => here("render-form").elements[name];
const stem = () => (state.script.match(/[^/]*$/)[0].replace(/\.lua$/, "") || "film");

/** The name that is proposed for the file. */
function proposedFile() {
  const kind = FORMATS[renderField("format").value];
  const isStill = kind.ending.startsWith("####") && rangeCount() === 1;
  return `${stem()}.${isStill ? kind.ending.slice(5) : kind.ending}`;
}

/** The frames of the range, as the command line has them; "": all. */
function rangeText() {
  const { first } = state.film, range = renderField("range").value;
  if (range === "frame") return String(view.number + first - 1);
  return range === "loop" ? `${loop.from + first - 1}-${loop.to + first - 1}` : "";
}

function rangeCount() {
  const range = renderField("range").value;
  return range === "frame" ? 1 : range === "loop" ? loop.to - loop.from + 1 : state.film.frames;
}

/** What is sent to the server. */
function renderWish() {
  const format = renderField("format").value, size = renderField("size").value.trim();
  const replace = here("render-state").dataset.state === "asking";
  return { format, file: renderField("file").value, frames: rangeText(), size, replace,
           draft: renderField("draft").checked };
}

function showRenderCommand() {
  if (!state.film) return;
  if (!isNamed) renderField("file").value = proposedFile();
  const { frames, size, draft } = renderWish(), { folder } = state;
  const words = [frames && `--frames ${frames}`, size && `--size ${size}`, draft && "--draft"];
  here("render-command").value = [`${renderOf(main)}`, ...words.filter(Boolean),
                                  `-o ${quoted(folder + renderField("file").value)}`].join(" ");
}

/** Proposes what the film is: a video if it moves, with the sound if it has one. */
function proposeFormat() {
  const isStill = state.film.frames === 1;
  renderField("format").value = isStill ? "png" : "mp4";
  renderField("range").value = loop.from > 1 || loop.to < state.film.frames ? "loop" : "all";
  renderField("size").placeholder = state.film.size.join("x");
}

export function openRender() {
  if (!state.film) return;
  swapMenu(here("render"));
  if (here("render-form").hidden) return;
  if (!isNamed) proposeFormat();
  showRenderCommand();
  renderField("format").focus();
}

const sayings = {
  idle: () => "",
  asking: one => `${one.file} is there already. Replace it?`,
  running: one => one.count ? `frame ${one.done} of ${one.count}${one.left}` : "begins …",
  done: one => `written: ${one.file}${one.more || ""}`,
  failed: one => one.message,
  cancelled: () => "cancelled; nothing was kept",
};

/** Shows what the server says of the render: { state, done, count, seconds, file, message }. */
export function showRender(said = { state: "idle" }) {
  const box = here("render-state"), isRunning = said.state === "running";
  const left = said.left > 1 ? `, ${Math.ceil(said.left)} s left` : "";
  box.dataset.state = said.state;
  here("render-words").textContent = sayings[said.state]({ ...said, left });
  here("render-progress").hidden = !isRunning;
  here("render-progress").max = said.count || 1;
  here("render-progress").value = said.done || 0;
  here("render-cancel").hidden = !isRunning && said.state !== "asking";
  label("render-start", said.state === "asking" ? "Replace it" : "Render");
  here("render-start").disabled = isRunning;
  here("render").classList.toggle("busy", isRunning);
  const share = Math.floor(100 * (said.done || 0) / (said.count || 1));
  label("render", isRunning ? `${share} %` : "Render");
}

async function startRender(event) {
  event.preventDefault();
  const answer = await post("/render", renderWish()).catch(() => null);
  if (!answer) return;
  const file = renderField("file").value;
  if (answer.status === 409) showRender({ state: "asking", file });
  else if (!answer.ok) showRender({ state: "failed", message: (await answer.text()).trim() });
}

function cancelRender() {
  if (here("render-state").dataset.state === "asking") showRender();
  else post("/render", { cancel: true }).catch(() => {});
}

export async function copyFrom(id) {
  const text = here(id).value;
  await navigator.clipboard?.writeText(text).catch(() => here(id).select());
}

/** Fills the list of formats, and hears the form. */
export function beginRender() {
  renderField("format").append(...Object.entries(FORMATS).map(([value, { name }]) =>
    element("option", { value, textContent: name })));
  renderField("file").addEventListener("input", () => { isNamed = true; });
  renderField("format").addEventListener("change", () => { isNamed = false; });
  here("render-form").addEventListener("input", () => {
    if (here("render-state").dataset.state === "asking") showRender();
    showRenderCommand();
  });
  here("render-form").addEventListener("submit", startRender);
  here("render-cancel").addEventListener("click", cancelRender);
  here("render-copy").addEventListener("click", () => copyFrom("render-command"));
}

