// A film as a video, encoded by WebCodecs.
//
//   planes --VideoEncoder--> chunks --+--> MP4 or WebM
//   sound  --AudioEncoder--> chunks --+
import { RATE, expectRoom } from "./export.js";
import { mp4 } from "./mp4.js";
import { webm } from "./webm.js";

const SECOND = 1e6; // microseconds

// Of the codecs, the first that the browser can encode is taken. H.264 in its High and Baseline
// profiles has the first level of 4, 5.1 and 6.2 with enough blocks of 16 x 16 pixels (table A-1).
const BLOCKS = { 28: 8192, 33: 36864, "3e": 139264 };
const levels = blocks => Object.keys(BLOCKS).filter(level => blocks <= BLOCKS[level]);
export const KINDS = {
  mp4: { name: "MP4", write: mp4, sounds: ["mp4a.40.2", "opus"],
    codecs: blocks => levels(blocks).flatMap(level => [`avc1.6400${level}`, `avc1.4200${level}`]) },
  webm: { name: "WebM", write: webm, sounds: ["opus"],
    codecs: () => ["vp09.00.51.08", "vp09.00.61.08", "vp8"] } };

/** The first configuration that an encoder supports. */
async function supported(encoder, codecs, more) {
  for (const codec of codecs) {
    const config = { codec, ...more };
    const answer = await encoder.isConfigSupported(config).catch(() => null);
    if (answer?.supported) return config;
  }
  return null;
}

/** Encodes what feed() gives to an encoder; returns its chunks and the decoder's configuration. beat:
 * is called for each chunk, as a sign of progress. */
async function encoded(Encoder, config, kind, beat, feed) {
  const all = { chunks: [], config, kind, bytes: 0 };
  let fault;
  const encoder = new Encoder({
    error: error => { fault = error; },
    output: (chunk, { decoderConfig } = {}) => {
      beat();
      const data = new Uint8Array(chunk.byteLength);
      chunk.copyTo(data);
      all.bytes += data.length;
      all.description ??= decoderConfig?.description;
      all.chunks.push({ data, kind, time: chunk.timestamp, isKey: chunk.type === "key" });
    },
  });
  const check = () => {
    if (fault) throw new Error(`The encoder of this browser failed: ${fault.message}`);
    expectRoom(all.bytes);
  };
  try {
    encoder.configure(config);
    await feed(encoder, async () => {
      check();
      while (encoder.encodeQueueSize > 4 && !fault) await new Promise(done => setTimeout(done));
      check();
    });
    await encoder.flush().catch(error => { fault ??= error; });
    check();
  } finally { if (encoder.state !== "closed") encoder.close(); }
  if (all.chunks.some(({ time }, i) => i && time <= all.chunks[i - 1].time)) {
    throw new Error("The encoder of this browser changes the order of frames: take APNG.");
  }
  return all;
}

async function pictures({ width, height, fps, count, frame, beat }, config) {
  const shape = { format: "I420", codedWidth: width, codedHeight: height, colorSpace: {
    primaries: "bt709", transfer: "iec61966-2-1", matrix: "bt709", fullRange: false } };
  return encoded(VideoEncoder, config, 1, beat, async (encoder, room) => {
    for (let index = 0; index < count; index++) {
      const picture = new VideoFrame(await frame(index), { ...shape,
        timestamp: Math.round(index * SECOND / fps), duration: Math.round(SECOND / fps) });
      encoder.encode(picture, { keyFrame: index % Math.ceil(4 * fps) === 0 });
      picture.close();
      await room();
    }
  });
}

async function samples([left, right], config, beat) {
  return encoded(AudioEncoder, config, 2, beat, async (encoder, room) => {
    for (let at = 0; at < left.length; at += RATE) {
      const size = Math.min(RATE, left.length - at), data = new Float32Array(2 * size);
      data.set(left.subarray(at, at + size));
      data.set(right.subarray(at, at + size), size);
      const part = new AudioData({ format: "f32-planar", sampleRate: RATE, numberOfFrames: size,
        numberOfChannels: 2, timestamp: Math.round(at * SECOND / RATE), data });
      encoder.encode(part);
      part.close();
      await room();
    }
  });
}

// ---- a film

const BITS = 0.3; // of a pixel: much for a drawing

/** The parts of a file of one of KINDS. film: { width, height, fps, count, frame, beat }, where
 * frame(index) is planes. sound: two channels, or null. */
export async function movie(film, sound, { name, write, codecs, sounds }) {
  const { width, height, fps, count } = film, blocks = Math.ceil(width / 16) * Math.ceil(height / 16);
  if (!globalThis.VideoEncoder || !globalThis.AudioEncoder) {
    throw new Error("This browser has no WebCodecs, for videos. Take APNG, or the program.");
  }
  if (width % 2 || height % 2) {
    throw new Error(`A video has an even width and height, not ${width} x ${height}.`);
  }
  const config = await supported(VideoEncoder, codecs(blocks), { width, height, framerate: fps,
    bitrate: Math.max(1e6, Math.round(width * height * fps * BITS)), latencyMode: "quality" });
  const heard = sound && await supported(AudioEncoder, sounds,
    { sampleRate: RATE, numberOfChannels: 2, bitrate: 160000 });
  if (!config || sound && !heard) {
    throw new Error(`This browser cannot encode ${width} x ${height} pixels${
      sound ? " with sound" : ""} for ${name}.`);
  }
  const video = await pictures(film, config);
  const audio = sound && await samples(sound, heard, film.beat);
  if (audio && !audio.description) {
    throw new Error("The encoder of this browser does not describe its sound. Take APNG.");
  }
  return write({ ...film, seconds: count / fps }, video, audio);
}
