// Two films side by side.
import { post } from "/fetch.js";
import { showPanel } from "/panels.js";
import { forget } from "/pictures.js";
import {
  beside, here, isComparing, lanes, main, part, setWords, setPressed, state, stateOf, write,
} from "/state.js";
import { writeAddress } from "/values.js";

// isOn: the last wish; null after it was fulfilled. sent: resolved when the server has received all
// wishes.
const comparing = { isOn: null, sent: Promise.resolve() };

/** The second film beside the first: that of the second script, or the same with other values,
 * which begin with the values of the first. */
export function swapComparing() {
  const isOn = comparing.isOn = !(comparing.isOn ?? isComparing());
  if (isOn && beside.given.size === 0 && !state.has_two) {
    for (const [name, value] of main.given) beside.given.set(name, value);
  }
  if (isOn && !state.has_two) showPanel("values");
  comparing.sent = comparing.sent.then(() => post("/compare", { on: isOn })).catch(() => {});
}

/** What the pictures are called: their scripts, or the values in which they differ. */
export function nameLanes() {
  const names = one => {
    const other = stateOf(one === main ? beside : main).parameters;
    const own = stateOf(one).parameters.filter((known, i) => known.value !== other[i]?.value);
    return own.map(known => `${known.name} ${known.value}`).join(", ") || "the same values";
  };
  for (const one of isComparing() ? lanes() : []) {
    part(one, "caption").textContent = state.has_two ? stateOf(one).script : names(one);
  }
}

export function showComparing() {
  const isOn = isComparing(), wasOn = !beside.box.hidden;
  if (comparing.isOn === isOn) comparing.isOn = null;
  const canCompare = state.has_two || state.parameters.length > 0;
  for (const id of ["desk2", "caption", "caption2", "beside"]) write(here(id), "hidden", !isOn);
  write(here("compare"), "hidden", !canCompare);
  setPressed("compare", isOn);
  setWords("beside-title", state.has_two ? `Values of ${state.second?.script}`
    : "Compare with these values");
  nameLanes();
  if (isOn === wasOn) return;
  Object.assign(beside, { painted: null, isGiven: false, formOf: "" });
  forget(beside);
  writeAddress();
}

