// What is wrong: the error over the picture, and the faults of all frames.
import { placeButton, placesOf } from "/inspector.js";
import { jump } from "/playing.js";
import {
  element, here, label, main, part, setWords, state, stateOf, view, write,
} from "/state.js";

const FAULT_FRAMES = 6;      // frames of one fault that are listed

/** The error of a film, or of the frame that is shown; null: neither. */
function currentFault(one = main) {
  const { shown, errors, build } = stateOf(one), refused = one.refused.get(view.number);
  if (!shown) return errors[0] || null;
  if (refused?.build === build) {
    return errors.find(known => known.message === refused.message) || refused;
  }
  // false until there is a picture
  return one.painted && one.painted.build === build ? null : one.lastFault;
}

/** Shows the error over the last good picture. */
export function showFault(one = main) {
  if (!stateOf(one)) return; // it is no longer shown
  const fault = one.lastFault = currentFault(one);
  for (const id of ["fault", "error"]) write(part(one, id), "hidden", !fault);
  write(part(one, "error"), "textContent", fault ? fault.message : "");
  const all = fault ? [...fault.file ? [fault] : [], ...fault.callers ?? []] : [];
  const names = all.map(({ file, line }) => `${file}:${line}`).join(" ← ");
  part(one, "lines").replaceChildren(...state.editor ? placesOf(names, all) : []);
  part(one, "excerpt").replaceChildren(...(fault?.lines ?? []).map(([number, text]) =>
    element(number === fault.line ? "b" : "span",
            { textContent: `${String(number).padStart(4)}  ${text}\n` })));
  one.canvas.classList.toggle("old", Boolean(fault));
  showNews();
}

/** What the film is doing, and how many faults a check has found. */
export function showNews() {
  const bad = groupFaults().length;
  const found = `${bad} fault${bad === 1 ? "" : "s"}: ${state.errors[0]?.message}`;
  setWords("news", state.building && state.seconds > 0.5 ? "building …"
    : bad && state.shown && !currentFault() ? found : "");
}

/** The errors of the film, errors of one text together: { text, frames, all }. */
function groupFaults() {
  const groups = new Map();
  for (const fault of state.errors) {
    const text = fault.message.replace(`frame ${fault.frame}: `, "")
      .replace(/frame -?\d+ of (?=\x27)/, ""); // a fault of a shot names its frame, too
    if (!groups.has(text)) groups.set(text, { text, frames: [], fault });
    if (fault.frame !== undefined) groups.get(text).frames.push(fault.frame);
  }
  return [...groups.values()];
}

/** One of those as an item of the list, with ways to its frames and its line. */
function faultItem({ text, frames, fault }) {
  const item = element("li", { textContent: text }), ways = element("p", {});
  const isSaid = text.includes(`${fault.file}:${fault.line}`);
  if (fault.file && (state.editor || !isSaid)) ways.append(placeButton(fault));
  const sorted = frames.sort((a, b) => a - b);
  ways.append(...sorted.slice(0, FAULT_FRAMES).map(name => {
    const onclick = () => jump(name - state.film.first + 1);
    return element("button", { textContent: `frame ${name}`, onclick });
  }));
  const more = frames.length - FAULT_FRAMES;
  const rest = `and ${more} more up to ${sorted.at(-1)}`;
  if (more > 0) ways.append(element("small", { textContent: rest }));
  if (ways.hasChildNodes()) item.append(ways);
  return item;
}

/** How far the check is. */
function checkedText(count) {
  const { film, checked, checking, shown } = state;
  if (!shown) return "";
  if (checking) return `${checked} of ${film.frames} frames checked`;
  return `${checked} frame${checked === 1 ? "" : "s"} checked${count ? "" : ": no faults"}`;
}

let listed = ""; // the faults in the list: the focus stays in a list that has not changed

export function showFaults() {
  const groups = groupFaults(), kinds = JSON.stringify([state.errors, state.editor]);
  label("check", `Faults ${groups.length}`);
  here("check").classList.toggle("bad", groups.length > 0);
  here("check").querySelector("use").setAttribute("href", groups.length ? "#i-faults" : "#i-fine");
  setWords("checked", checkedText(groups.length));
  if (kinds === listed) return;
  listed = kinds;
  here("fault-list").replaceChildren(...groups.map(faultItem));
}

