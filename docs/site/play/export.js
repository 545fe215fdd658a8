// Frames for files, where there is no file system and no ffmpeg: planes of Y'CbCr for video
// encoders, PNG and APNG, and the sound of a film. Nothing in it knows a page or the engine.

const { fround } = Math;

// ---- planes: src/core/output/sinks/ycbcr_wide.c with its single precision, so with its bytes

const RED = 0.2126, GREEN = 0.7152, BLUE = 0.0722;
const LUMA = 219 / 255, CB = 224 / 255 / (2 - 2 * BLUE), CR = 224 / 255 / (2 - 2 * RED);

/** What a sum of `unit` codes of each channel adds: three tables. */
const tables = (unit, ...weights) => weights.map(weight =>
  Float32Array.from({ length: 255 * unit + 1 }, (_, sum) => fround(weight) * (sum / unit)));

const luma = tables(1, LUMA * RED, LUMA * GREEN, LUMA * BLUE);
const cb = tables(4, -CB * RED, -CB * GREEN, CB * (1 - BLUE));
const cr = tables(4, CR * (1 - RED), -CR * GREEN, -CR * BLUE);
const mixed = (of, base, r, g, b) => fround(base + fround(fround(of[0][r] + of[1][g]) + of[2][b]));

/** Pixels of RGBA, over black and of even sides, as I420: the matrix of BT.709, limited range. */
export function planes(rgba, width, height) {
  const area = width * height, out = new Uint8Array(area * 3 / 2);
  for (let i = 0; i < area; i++) {
    out[i] = mixed(luma, 16.5, rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
  }
  for (let y = 0, at = area; y < height; y += 2) {
    for (let i = 4 * width * y; i < 4 * width * (y + 1); i += 8, at++) {
      const j = i + 4 * width; // the row below
      const sum = c => rgba[i + c] + rgba[i + 4 + c] + rgba[j + c] + rgba[j + 4 + c];
      const r = sum(0), g = sum(1), b = sum(2);
      out[at] = mixed(cb, 128.5, r, g, b);
      out[at + area / 4] = mixed(cr, 128.5, r, g, b);
    }
  }
  return out;
}

// ---- PNG, and APNG of several frames

const remainders = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let bit = 0; bit < 8; bit++) n = n & 1 ? n >>> 1 ^ 0xedb88320 : n >>> 1;
  return n;
});

function chunk(kind, ...numbers) {
  const bytes = new Uint8Array(12 + size(numbers));
  new DataView(bytes.buffer).setUint32(0, bytes.length - 12);
  let at = 4, crc = -1;
  for (const one of [text(kind), ...numbers]) {
    bytes.set(one, at);
    at += one.length;
  }
  for (let i = 4; i < at; i++) crc = remainders[(crc ^ bytes[i]) & 255] ^ crc >>> 8;
  new DataView(bytes.buffer).setInt32(at, ~crc);
  return bytes;
}

/** Numbers, or lists of them, of some bytes each, the highest byte first: be(2, 1, [258]) is 0, 1, 1,
 * 2. A long list is one argument, because engines limit the number of these. */
export const be = (size, ...numbers) => Uint8Array.from(numbers.flat().flatMap(number =>
  Array.from({ length: size }, (_, i) => Math.floor(number / 256 ** (size - 1 - i)))));

export const text = words => new TextEncoder().encode(words);

/** The bytes of parts. */
export const size = parts => parts.reduce((sum, part) => sum + part.length, 0);

async function packed(rgba, width, height) {
  const rows = new Uint8Array((4 * width + 1) * height); // each begins with its filter: none
  for (let y = 0; y < height; y++) {
    rows.set(rgba.subarray(4 * width * y, 4 * width * (y + 1)), (4 * width + 1) * y + 1);
  }
  const stream = new Blob([rows]).stream().pipeThrough(new CompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The time of `frames` after the first `from` of a film, as a fraction of a second; two bytes each. */
const delay = (from, frames, fps) => {
  const at = index => Math.round(index * 1000 / fps);
  return Number.isInteger(fps) && fps < 1000 ? [frames, fps] : [at(from + frames) - at(from), 1000];
};
const MOST_BYTES = 2 ** 30;

/** Refuses a file of too many bytes. */
export function expectRoom(bytes) {
  if (bytes > MOST_BYTES) throw new Error("The file would be larger than 1 GiB.");
}
const LONGEST = 60; // seconds of a picture: its delay has two bytes

/** An APNG, or a PNG of one frame. frame(index): its RGBA with straight alpha; equal neighbours are
 * one picture. */
export async function png({ width, height, fps, count, frame }) {
  const pictures = [];
  let last, size = 0;
  for (let index = 0; index < count; index++) {
    const rgba = (await frame(index)).slice();
    if (last && rgba.every((code, i) => code === last[i])
      && pictures.at(-1).frames < LONGEST * fps) pictures.at(-1).frames++;
    else {
      const bytes = await packed(rgba, width, height);
      expectRoom(size += bytes.length);
      pictures.push({ bytes, frames: 1, from: index });
    }
    last = rgba;
  }
  let number = 0;
  const moving = count > 1, parts = pictures.flatMap(({ bytes, frames, from }, i) => [
    ...moving ? [chunk("fcTL", be(4, number++, width, height, 0, 0), be(2, ...delay(from, frames, fps)),
      [0, 0])] : [],
    i ? chunk("fdAT", be(4, number++), bytes) : chunk("IDAT", bytes)]);
  return [be(1, 0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10),
    chunk("IHDR", be(4, width, height), [8, 6, 0, 0, 0]), chunk("sRGB", [0]),
    ...moving ? [chunk("acTL", be(4, pictures.length, 0))] : [], ...parts, chunk("IEND")];
}

// ---- sound: the mix of src/kit/plugins/sound/mix.c

export const RATE = 48000;
const moment = seconds => Math.round(seconds * RATE);
const share = (distance, length) => Math.max(0, Math.min(1, length > 0 ? distance / length
  : distance > 0 ? 1 : 0));

/** When a sound is heard: its passages end where its samples do. */
function heard({ start, passages, samples }) {
  const ends = passages.map(({ end }, i) => i ? end
    : Math.min(end, start + samples[0].length / RATE));
  return { ends, from: Math.max(...passages.map(({ begin }) => moment(begin))),
    to: Math.min(...ends.map(moment)) };
}

/** The gain of a sound at a moment. places: when each sound is heard. */
function gain({ passages, duckers }, { ends }, places, at) {
  const low = duckers.map(({ sound, gain: least, attack, release }) => {
    const { from, to } = places[sound];
    const slope = Math.max(share(from - at, attack * RATE), share(at - to + 1, release * RATE));
    return from < to ? least + (1 - least) * slope : 1;
  });
  return passages.reduce((all, { begin, fadeIn, fadeOut }, i) => all
    * (fadeIn > 0 ? share(at / RATE - begin, fadeIn) : 1)
    * (fadeOut > 0 ? share(ends[i] - at / RATE, fadeOut) : 1), Math.min(1, ...low));
}

/** Two channels of `seconds` of a film: of sounds of the engine with their samples of 48 kHz, in
 * one channel or two. */
export function mix(sounds, seconds) {
  const channels = [0, 1].map(() => new Float32Array(moment(seconds))), places = sounds.map(heard);
  sounds.forEach((sound, i) => {
    const { samples, start, gain: sides } = sound, origin = moment(start);
    const end = Math.min(places[i].to, channels[0].length, origin + samples[0].length);
    for (let at = Math.max(places[i].from, origin, 0); at < end; at++) {
      const now = gain(sound, places[i], places, at);
      channels.forEach((all, side) => {
        all[at] += (samples[side] ?? samples[0])[at - origin] * now * sides[side];
      });
    }
  });
  return channels;
}
