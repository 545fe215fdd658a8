// A graphic of OGraf 1 (EBU), made by celspan @VERSION@. It loads the files beside it alone.
//
//   actions --act--> state --frame_at(time)--> the number of a frame --artist--> canvas
//
// A step is a mark of the film. `play` runs from where the film is to the frame of the next mark,
// and stays there; after the last mark, and at `stop`, the film runs from there to its end, after
// which nothing is seen. A state does not change by itself: goToTime and the clock see the same.
@ARTIST@
const FILM = @FILM@;
const LAST = FILM.first + FILM.count - 1, END = LAST + 1;

// ---- states: the film has run from a frame since a time, to another frame, where it stays

const START = { step: undefined, from: null, to: null, begun: 0, data: {} }; // nothing is seen

const place_at = ({ from, begun }, time) =>
  from + Math.max(0, Math.floor((time - begun) / 1000 * FILM.fps + 1e-6));
const has_come = (state, time) => state.from === null || place_at(state, time) >= state.to;

const is_one_run = (one, other) =>
  one.from === other.from && one.to === other.to && one.begun === other.begun;

// null: nothing is seen.
function frame_at(state, time) {
  const frame = state.from === null ? END : Math.min(state.to, place_at(state, time));
  return frame > LAST ? null : frame;
}

// A place that is passed already is reached at once.
const run = (state, step, from, to, skips, begun) =>
  ({ ...state, step, from: skips ? to : Math.min(from, to), to, begun });

const leave = (state, from, skips, time) =>
  run(state, undefined, Math.max(from, FILM.steps.at(-1) ?? from), END, skips, time);

const acts = {
  playAction(state, { delta = 1, goto, skipAnimation }, time) {
    const wanted = goto ?? (state.step ?? -1) + delta, seen = frame_at(state, time);
    if (!Number.isInteger(wanted)) throw new Error(`a step is a whole number, got ${goto ?? delta}`);
    const step = Math.max(0, wanted);
    if (step >= FILM.steps.length) return leave(state, seen ?? FILM.first, skipAnimation, time);
    const from = state.step === undefined ? FILM.first : seen;
    return run(state, step, from, FILM.steps[step], skipAnimation, time);
  },
  stopAction(state, { skipAnimation }, time) {
    const seen = frame_at(state, time);
    return seen === null ? { ...START, data: state.data } : leave(state, seen, skipAnimation, time);
  },
  updateAction: (state, { data }) => ({ ...state, data: { ...state.data, ...data } }),
};

// ---- the element

const look = globalThis.CSSStyleSheet && new CSSStyleSheet();
look?.replaceSync(":host { position: absolute; inset: 0; overflow: hidden; }"
  + "canvas { display: block; width: 100%; height: 100%; object-fit: contain; }");

async function part(name) {
  const url = new URL(name.split("/").map(encodeURIComponent).join("/"), import.meta.url);
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${name}: this part of the graphic cannot be loaded`);
  return new Uint8Array(await answer.arrayBuffer());
}

// What returns undefined has succeeded.
const refusal = fault => ({ statusCode: 400, statusMessage: fault.message ?? fault });

export default class extends HTMLElement {
  #artist = null;     // null: it is not loaded
  #pencil = null;
  #state = START;
  #schedule = [];     // for goToTime
  #time = null;       // of goToTime, which the film stands still at; null: the clock's
  #prepared = "";     // the data with which the artist draws
  #shown = null;      // the frame on the canvas; null: nothing

  async load({ data, renderType, renderCharacteristics } = {}) {
    try {
      this.#artist ??= await Artist.open(part);
      this.#lay(renderCharacteristics?.resolution ?? {});
      this.#time = renderType === "non-realtime" ? 0 : null;
      this.#change({ ...START, data: data ?? {} });
    } catch (fault) { return refusal(fault); }
  }

  async dispose() {
    [this.#artist, this.#state] = [null, START];
    this.shadowRoot?.replaceChildren();
  }

  playAction(params) { return this.#act("playAction", params); }
  stopAction(params) { return this.#act("stopAction", params); }
  updateAction(params) { return this.#act("updateAction", params); }
  async customAction() { return refusal("this graphic has no actions of its own"); }

  // Without a schedule, and before it has been played, the film begins at 0.
  async goToTime({ timestamp } = {}) {
    if (!this.#artist) return refusal("the graphic must be loaded first");
    if (!(timestamp >= 0)) return refusal(`a timestamp is a number from 0 on, got ${timestamp}`);
    this.#time = timestamp;
    const due = this.#schedule.filter(one => one.timestamp <= timestamp);
    const is_film = !this.#schedule.length && this.#state.from === null;
    const begin = is_film ? run(this.#state, undefined, FILM.first, END, false, 0) : this.#state;
    try {
      this.#show(due.reduce((state, { timestamp: time, action }) =>
        acts[action.type](state, action.params ?? {}, time), begin));
    } catch (fault) { return refusal(fault); }
  }

  async setActionsSchedule({ schedule = [] } = {}) {
    const wrong = schedule.find(({ action }) => !Object.hasOwn(acts, action?.type));
    if (wrong) return refusal(`${wrong.action?.type}: this graphic has no such action`);
    this.#schedule = [...schedule].sort((a, b) => a.timestamp - b.timestamp);
  }

  #lay({ width = FILM.width, height = FILM.height }) {
    const by = Math.min(width / FILM.width, height / FILM.height);
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.round(FILM.width * by));
    canvas.height = Math.max(1, Math.round(FILM.height * by));
    const root = this.shadowRoot ?? this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [look];
    root.replaceChildren(canvas);
    this.#pencil = canvas.getContext("2d");
    this.#shown = null;
  }

  get #now() { return this.#time ?? performance.now(); }

  // Until the film is where it stays, or another action has taken it elsewhere.
  async #act(type, params) {
    if (!this.#artist) return refusal("the graphic must be loaded first");
    try {
      const state = acts[type](this.#state, params ?? {}, this.#now);
      this.#change(state);
      const goes_on = () => type !== "updateAction" && this.#time === null
        && is_one_run(this.#state, state);
      for (let is_there = false; !is_there && goes_on();) {
        is_there = has_come(state, this.#now);
        this.#show(this.#state);
        if (!is_there) await new Promise(requestAnimationFrame);
      }
    } catch (fault) { return refusal(fault); }
    return { statusCode: 200, ...type === "playAction" && { currentStep: this.#state.step } };
  }

  // A value that the script refuses changes nothing.
  #change(state) { this.#show(state); this.#state = state; }

  #show(state) {
    const frame = frame_at(state, this.#now), data = JSON.stringify(state.data);
    const { width, height } = this.#pencil.canvas;
    if (data === this.#prepared && frame === this.#shown) return;
    if (data !== this.#prepared) {
      this.#prepared = "";
      this.#artist.prepare(state.data);
      this.#prepared = data;
    }
    if (frame === null) this.#pencil.clearRect(0, 0, width, height);
    else this.#pencil.putImageData(this.#artist.draw(frame, width, height), 0, 0);
    this.#shown = frame;
  }
}
