// Panels at the right, one at a time, and menus at the top.
import { here } from "/state.js";

// The panels and the elements that open them.
const OPENERS = { values: "tune", objects: "outliner", inspector: "inspect", faults: "check",
                  costs: "cost" };
const opened = new Map(); // what is done when a panel opens or closes, by its name

/** Names what is done with a panel when it opens or closes: act(isOn). */
export function onPanel(id, act) { opened.set(id, act); }

export const isOpen = id => !here(id).hidden;

function setPanel(id, isOn) {
  if (isOpen(id) === isOn) return;
  here(id).hidden = !isOn;
  here(OPENERS[id]).setAttribute("aria-expanded", isOn);
  opened.get(id)?.(isOn);
}

/** Shows a panel in the place of the one that is there; "": none. */
export function showPanel(id) {
  for (const other of Object.keys(OPENERS)) if (other !== id) setPanel(other, false);
  if (id) setPanel(id, true);
}

export const swapPanel = id => showPanel(isOpen(id) ? "" : id);

// ---------------------------------------------------------------- menus

export const menuButtons = () => [...document.querySelectorAll("[data-menu]")];

function setMenu(button, isOn) {
  button.setAttribute("aria-expanded", isOn);
  here(button.getAttribute("aria-controls")).hidden = !isOn;
}

/** Closes the menus. Returns whether one was open. */
export function closeMenus() {
  const open = menuButtons().filter(button => button.getAttribute("aria-expanded") === "true");
  open.forEach(button => setMenu(button, false));
  return open.length > 0;
}

export function swapMenu(button) {
  const wasOn = button.getAttribute("aria-expanded") === "true";
  closeMenus();
  setMenu(button, !wasOn);
}

/** A press beside a menu closes it. */
export function leaveMenus(event) {
  if (!event.target.closest("[data-menu], .menu")) closeMenus();
}

