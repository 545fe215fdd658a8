// Panels at the right, one at a time, and menus at the top: what a button's aria-controls names.
import { here } from "/state.js";

const opened = new Map(); // what is done when a panel opens or closes, by its name

/** Names what is done with a panel when it opens or closes: act(isOn). */
export function onPanel(id, act) { opened.set(id, act); }

export const isOpen = id => !here(id).hidden;

/** Shows or hides what a button opens. The focus in it goes back to the button. */
function setOpen(button, isOn) {
  const id = button.getAttribute("aria-controls");
  if (isOpen(id) === isOn) return;
  if (here(id).contains(document.activeElement)) button.focus();
  here(id).hidden = !isOn;
  button.setAttribute("aria-expanded", isOn);
  opened.get(id)?.(isOn);
}

/** Shows a panel in the place of the one that is there; "": none. */
export function showPanel(id) {
  const others = [...document.querySelectorAll("#panels > aside")].map(one => one.id);
  for (const one of [...others.filter(other => other !== id), id]) {
    if (one) setOpen(document.querySelector(`[aria-controls="${one}"]`), one === id);
  }
}

export const swapPanel = id => showPanel(isOpen(id) ? "" : id);

// ---------------------------------------------------------------- menus

const menuButtons = () => [...document.querySelectorAll("[data-menu]")];
const isExpanded = button => button.getAttribute("aria-expanded") === "true";

/** Closes the menus. Returns whether one was open. */
export function closeMenus() {
  const open = menuButtons().filter(isExpanded);
  open.forEach(button => setOpen(button, false));
  return open.length > 0;
}

function swapMenu({ currentTarget: button }) {
  const wasOn = isExpanded(button);
  closeMenus();
  setOpen(button, !wasOn);
}

/** Hears the buttons of the menus. A press beside a menu closes it. */
export function hearMenus() {
  for (const button of menuButtons()) button.addEventListener("click", swapMenu);
  document.addEventListener("pointerdown", event => {
    if (!event.target.closest("[data-menu], .menu")) closeMenus();
  });
}
