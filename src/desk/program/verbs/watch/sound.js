// The sound of the film that the page of celspan watch shows.
//
//   /sound.wav?frames=A-B --> pieces of PIECE seconds --scheduled ahead--> the loudspeaker
//                                                                              |
//   heardSeconds(): a clock, by which frames are painted or dropped  <---------'
//
// INVARIANT: while the sound is heard its clock is the one that counts, so pictures wait for it and
// never the other way round.
import { fetch } from "/fetch.js";

const RATE = 48000;     // moments in a second, as the server mixes
const PIECE = 20;       // seconds
const PIECES_MOST = 6;  // the most pieces that are kept
const SCHEDULED = 0.4;  // seconds that are scheduled ahead
const HEAD = 44;        // bytes of a WAV file before its samples

let film = null, soundBuild = 0;
let speakers = null;          // the AudioContext; it is created at the first key or click
let isMuted = false;
// by the number of the piece: an AudioBuffer, or null while it is loaded
const pieces = new Map();
let run = null;               // the sound that is heard: see beginSound
const sources = new Set();    // sources that were scheduled

/** Takes the film of a save; its sound is asked for again. */
export function setSoundOf(newFilm, newBuild) {
  film = newFilm;
  soundBuild = newBuild;
  pieces.clear();
  endSound();
}

export const hasSound = () => Boolean(film && film.sound);

// ---------------------------------------------------------------- pieces

const framesOfPiece = () => Math.max(1, Math.round(PIECE * film.fps));

/** The samples of a WAV file of 16 bits and two channels. */
function samplesOf(bytes) {
  const samples = new Int16Array(bytes, HEAD), count = samples.length / 2;
  const buffer = new AudioBuffer({ length: Math.max(1, count), numberOfChannels: 2,
                                   sampleRate: RATE });
  for (let channel = 0; channel < 2; channel++) {
    const out = buffer.getChannelData(channel);
    for (let i = 0; i < count; i++) out[i] = samples[2 * i + channel] / 32768;
  }
  return buffer;
}

/** Asks for a piece that is not there yet. */
async function load(number) {
  if (pieces.has(number)) return;
  const count = framesOfPiece(), from = number * count, ofBuild = soundBuild;
  if (from < 0 || from >= film.frames) return;
  pieces.set(number, null);
  const last = Math.min(from + count, film.frames) - 1 + film.first;
  const answer = await fetch(`/sound.wav?frames=${from + film.first}-${last}&build=${soundBuild}`)
    .catch(() => null);
  if (ofBuild !== soundBuild) return;
  pieces.delete(number);
  if (!answer || !answer.ok) return;
  pieces.set(number, samplesOf(await answer.arrayBuffer()));
  for (const old of pieces.keys()) {
    if (pieces.size > PIECES_MOST && old !== number) pieces.delete(old);
  }
}

// ---------------------------------------------------------------- the loudspeaker

/** Begins the AudioContext: only a key or a click may. */
function wake() {
  speakers ??= new AudioContext({ sampleRate: RATE });
  if (speakers.state === "suspended") speakers.resume().catch(() => {});
}

/** Plays `count` frames from place `at` on, both in frames from 0, at a time of `speakers`. */
function schedule(at, count, when, speed) {
  const number = Math.floor(at / framesOfPiece()), buffer = pieces.get(number);
  const source = new AudioBufferSourceNode(speakers, { buffer, playbackRate: speed });
  source.connect(speakers.destination);
  source.start(when, (at - number * framesOfPiece()) / film.fps, count / film.fps);
  sources.add(source);
  source.onended = () => sources.delete(source);
}

/** Begins to play: from frame `at`, from 0, in the loop from..to (the last one included). */
export function beginSound(at, speed, from, to) {
  endSound();
  if (!hasSound() || isMuted) return;
  wake();
  run = { at, speed, from, to: to + 1, next: 0 };
  load(Math.floor(at / framesOfPiece()));
}

/** Ends what is heard. */
export function endSound() {
  run = null;
  for (const source of sources) source.stop();
  sources.clear();
}

/** The clock of the loudspeaker in seconds; null: nothing can be heard. */
export function heardSeconds() {
  if (!run || !speakers || speakers.state !== "running") return null;
  return speakers.currentTime - (speakers.outputLatency || 0);
}

/** Schedules what is heard next. place: in frames from 0, where the picture is now. */
export function feedSound(place) {
  if (heardSeconds() === null) return;
  const now = speakers.currentTime;
  if (run.next < now) { // it begins now, or its samples arrived late
    run.at = place;
    run.next = now + 0.02;
    run.at += 0.02 * film.fps * run.speed;
  }
  while (run.next < now + SCHEDULED) {
    if (run.at >= run.to - 1e-6) run.at = run.from;
    const count = framesOfPiece(), number = Math.floor(run.at / count);
    load(number);
    load(number + 1);
    if (!pieces.get(number)) return;
    const length = Math.min((number + 1) * count, run.to) - run.at;
    schedule(run.at, length, run.next, run.speed);
    run.at += length;
    run.next += length / film.fps / run.speed;
  }
}

/** One frame of the sound, as a step or the slider comes to it. */
export async function tapSound(at) {
  if (!hasSound() || isMuted || run) return;
  wake();
  const number = Math.floor(at / framesOfPiece());
  await load(number);
  if (!pieces.get(number) || speakers.state !== "running") return;
  for (const source of sources) source.stop();
  schedule(at, 1, speakers.currentTime, 1);
}

/** Whether nothing is heard from now on. */
export function muteSound(isOn) {
  isMuted = isOn;
  if (isOn) endSound();
}
