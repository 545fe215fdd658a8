// News of the server: films that were saved, built, checked or rendered.
import { showComparing } from "/beside.js";
import { showFault, showFaults, showNews } from "/faults.js";
import { fetch, firstState, pause } from "/fetch.js";
import { outline, outlined } from "/over.js";
import { forget, isSeen, look } from "/pictures.js";
import { start, takeSound } from "/playing.js";
import { showRender, showRenderCommand } from "/render.js";
import { loadSheet } from "/rows.js";
import {
  beside, clamp, here, lanes, loop, main, play, setWords, span, state, stateOf, timecode, view,
  write, writeAttribute,
} from "/state.js";
import { drawRuler, drawTimeline, placeHead, shotsAt, showRows } from "/timeline.js";
import { sendGiven, showForm } from "/values.js";
import { fit, measureDesk } from "/view.js";

export function showNumbers() {
  if (!state.film) return;
  const whole = loop.from === 1 && loop.to === state.film.frames, percent = view.scale * 100;
  setWords("frame", view.number);
  setWords("frames", state.film.frames);
  setWords("timecode", timecode(view.number));
  write(here("scrub"), "value", String(view.number));
  writeAttribute(here("scrub"), "aria-valuetext",
                 `${timecode(view.number)}, frame ${view.number}`);
  setWords("shot", shotsAt(view.number - 1).map(shot => shot.name).join(" / "));
  setWords("zoom", `${percent < 10 ? percent.toFixed(1) : Math.round(percent)} %`);
  setWords("facts", `${state.film.size.join(" × ")}, ${state.film.fps} fps`
    + (whole ? "" : `, loop ${loop.from} to ${loop.to}`));
  placeHead();
  showRenderCommand();
}

function showState() {
  const title = state.film?.title || state.script;
  setWords("title", title);
  write(document, "title", `${title} – celspan`);
  showNumbers();
  showNews();
  for (const one of lanes()) if (!stateOf(one).building) showFault(one);
}

/** Whether a film was saved, has failed or is ready since the old news of it. */
const isNewFilm = (old, news) => news
  && (!old || ["build", "shown", "building"].some(name => old[name] !== news[name]));

function takeState(news) {
  const old = { ...state }, { film } = old;
  const isSame = film && JSON.stringify(film) === JSON.stringify(news.film);
  Object.assign(state, news, { film: isSame ? film : news.film || film,
                               second: news.second || null });
  document.body.classList.toggle("alone", news.alone);
  showComparing();
  if (state.film && (!film || film.frames !== state.film.frames)) takeFrames(!film);
  if (!film && state.shown) lookFirst();
  lanes().forEach(showForm);
  sendGiven();
  if (state.here && state.here.count !== outlined.count) outline(state.here);
  showState();
  showFaults();
  showRender();
  loadSheet();
  if (state.second && old.second?.build !== state.second.build) forget(beside);
  if (old.build !== state.build) forget(main);
  if (isNewFilm(old, state)) takeFilm(film);
  else if (isNewFilm(old.second, state.second)) look();
}

/** Asks for the first picture, which comes with the values of the address if it has some. Before it
 * nothing is laid out but the rows of the timeline, which take room from the picture. */
function lookFirst() {
  showRows();
  measureDesk();
  if (lanes().some(one => one.given.size)) fit();
  else look();
}

/** The film has another number of frames than before; the first one opens at its poster. */
function takeFrames(isFirst) {
  loop.from = 1;
  loop.to = state.film.frames;
  Object.assign(span, { from: 0, to: state.film.frames });
  const { first, poster, frames } = state.film;
  view.number = clamp(isFirst && !state.alone ? poster - first + 1 : view.number, 1, frames);
  if (isFirst && state.alone) start(1);
}

/** The film was saved, has failed, or is ready. The picture is asked for first; while the film is
 * built, all that is known is of the one before, `old`. If the timeline gets other rows, the window
 * of the picture has another size, which page.js hears of. */
function takeFilm(old) {
  if (state.shown && !lanes().every(isSeen)) look();
  if (state.building) return;
  takeSound();
  if (state.film !== old || !state.shown) drawTimeline();
  else if (play.direction !== 0) drawRuler();
  if (outlined.place) outline(outlined.place);
}

export async function listen() {
  for (let first = firstState; ; first = null) {
    try {
      const answer = await first ?? await fetch(`/state.json?since=${state.news}`);
      if (answer.status === 403) { // the opened address has no token
        here("news").textContent = await answer.text();
        return;
      }
      if (!answer.ok) throw new Error(await answer.text());
      takeState(await answer.json());
    } catch {
      here("news").textContent = "celspan watch has ended; start it again and open its new address";
      await pause(1);
    }
  }
}
