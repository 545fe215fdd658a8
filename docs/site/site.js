// What a page does better with a script: it keeps the choice between dark and light for the next
// page, copies code, marks in the contents where the reader is, and runs scripts.
const root = document.documentElement;

/** The chosen theme, or null; a browser may forbid to store one. */
function stored(value) {
  try {
    if (value) localStorage.setItem("theme", value);
    return localStorage.getItem("theme");
  } catch {
    return value ?? null;
  }
}

root.dataset.theme = stored() ?? "auto"; // before the page is drawn

function keepTheme() {
  const choices = [...document.querySelectorAll("[name=theme]")];
  for (const one of choices) {
    one.checked = one.value === root.dataset.theme;
    one.addEventListener("change", () => { root.dataset.theme = one.value; stored(one.value); });
  }
}

function addCopyButtons() {
  if (!navigator.clipboard) return;
  for (const pre of document.querySelectorAll("pre")) {
    const button = document.createElement("button");
    button.className = "copy";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(pre.querySelector("code").textContent);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    });
    pre.append(button);
  }
}

function markPlace() {
  const links = new Map([...document.querySelectorAll(".contents a")]
    .map(link => [document.getElementById(link.hash.slice(1)), link]));
  let here;
  const mark = () => {
    const passed = [...links.keys()].filter(one => one.getBoundingClientRect().top < 120);
    const link = links.get(passed.at(-1));
    if (link === here) return;
    here?.classList.remove("here");
    link?.classList.add("here");
    here = link;
  };
  document.addEventListener("scroll", () => requestAnimationFrame(mark), { passive: true });
  mark();
}

/** A touch or a key runs a script in its place. Nothing for that is loaded before. */
function awaitTouch(figure) {
  const run = document.createElement("button");
  run.className = "run";
  run.textContent = "Run";
  figure.querySelector("figcaption").append(run);
  const begin = async event => {
    const isSelection = event.target.closest("pre") && !getSelection().isCollapsed;
    if (figure.classList.contains("live") || isSelection || event.target.closest("a, .copy")) return;
    figure.classList.add("live");
    try {
      (await import("./live/live.js")).enliven(figure, event);
    } catch {
      figure.classList.remove("live");
      run.textContent = "The engine could not be loaded";
    }
  };
  figure.addEventListener("click", begin);
  figure.addEventListener("keydown", event => { if (event.key === "Enter") begin(event); });
}

document.addEventListener("DOMContentLoaded", () => {
  keepTheme();
  addCopyButtons();
  markPlace();
  document.querySelectorAll("figure[data-live]").forEach(awaitTouch);
});
