// The ground of the picture, the guides over it, and the theme of the page.
import { beside, element, here, main, part, setPressed } from "/state.js";
import { drawTimeline } from "/timeline.js";

export const GUIDES = ["safe", "fields"]; // shown over the picture, one at a time
const RECTANGLES = 12;           // rectangles of a field guide, around its middle

export function setGround(ground) {
  here("ground").value = ground;
  for (const id of ["paper", "paper2"]) here(id).dataset.ground = ground;
}

export function nextGround() {
  const { options, selectedIndex } = here("ground");
  setGround(options[(selectedIndex + 1) % options.length].value);
}

export function nextGuide() {
  const next = GUIDES.findIndex(guide => !here(guide).hidden) + 1;
  for (const one of [main, beside]) {
    GUIDES.forEach((guide, i) => { part(one, guide).hidden = i !== next; });
  }
  setPressed("guides", next < GUIDES.length);
}

/** The rectangles of the field guide, each with its number. */
export function makeFields() {
  for (let k = 1; k <= RECTANGLES; k++) {
    for (const id of ["fields", "fields2"]) {
      const style = { inset: `${50 - 50 * k / RECTANGLES}%` };
      here(id).append(element("div", { textContent: k, style }));
    }
  }
}

export function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  drawTimeline();
  for (const curve of document.querySelectorAll(".curve")) curve.redraw();
}

export function swapTheme() {
  setTheme(document.documentElement.dataset.theme === "light" ? "dark" : "light");
}

export function fullScreen() {
  if (document.fullscreenElement) document.exitFullscreen();
  else document.documentElement.requestFullscreen();
}

