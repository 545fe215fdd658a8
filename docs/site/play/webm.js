// WebM: elements of an identifier, a size and contents (RFC 8794, RFC 9559).
//
//   EBML   Segment [ Info   Tracks   Cues: where clusters begin   Cluster [ time, blocks ] ... ]
import { RATE, be, size, text } from "./export.js";

const float = number => {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, number);
  return bytes;
};

const element = (id, ...content) => {
  const parts = content.flat(9), name = id.toString(16);
  return [be(name.length / 2, id), be(1, 1), be(7, size(parts)), ...parts];
};
const whole = (id, number) => element(id, be(8, number));
const words = (id, content) => element(id, text(content));

const MILLISECOND = 1e6; // of WebM's clock: nanoseconds
const ROLL = 80 * MILLISECOND; // that a decoder of Opus needs before a place

const track = (number, codec, ...more) => element(0xae, whole(0xd7, number), whole(0x73c5, number),
  whole(0x83, number), whole(0x9c, 0), words(0x86, codec), ...more);

function clusters(chunks) {
  const groups = [];
  for (const chunk of chunks) {
    if (!groups.length || chunk.kind === 1 && chunk.isKey) groups.push([]);
    groups.at(-1).push(chunk);
  }
  return groups.map(group => {
    const from = Math.round(group[0].time / 1000);
    return { from, parts: element(0x1f43b675, whole(0xe7, from), group.map(one => element(0xa3,
      be(1, 0x80 + one.kind), be(2, Math.round(one.time / 1000) - from),
      be(1, one.isKey ? 0x80 : 0), one.data))) };
  });
}

/** The parts of a file. video, audio: { chunks, config, description }; audio may be null. */
export function webm({ width, height, fps, seconds }, video, audio) {
  const chunks = [...video.chunks, ...audio?.chunks ?? []].sort((a, b) => a.time - b.time);
  const info = element(0x1549a966, whole(0x2ad7b1, MILLISECOND), words(0x4d80, "celspan"),
    words(0x5741, "celspan"), element(0x4489, float(seconds * 1000)));
  const colour = element(0x55b0, whole(0x55b1, 1), whole(0x55b9, 1), whole(0x55ba, 13),
    whole(0x55bb, 1));
  const skip = audio && new DataView(new Uint8Array(audio.description).buffer).getUint16(10, true);
  const tracks = element(0x1654ae6b,
    track(1, video.config.codec === "vp8" ? "V_VP8" : "V_VP9",
      whole(0x23e383, Math.round(1e9 / fps)),
      element(0xe0, whole(0xb0, width), whole(0xba, height), colour)),
    audio ? track(2, "A_OPUS", element(0x63a2, new Uint8Array(audio.description)),
      whole(0x56aa, Math.round(skip * 1e9 / RATE)), whole(0x56bb, ROLL),
      element(0xe1, element(0xb5, float(RATE)), whole(0x9f, 2))) : []);
  const all = clusters(chunks);
  const cues = start => {
    let at = start;
    return element(0x1c53bb6b, all.map(({ from, parts }) => {
      const cue = element(0xbb, whole(0xb3, from), element(0xb7, whole(0xf7, 1), whole(0xf1, at)));
      at += size(parts);
      return cue;
    }));
  };
  const head = [...info, ...tracks], start = size(head) + size(cues(0));
  return [...element(0x1a45dfa3, whole(0x4286, 1), whole(0x42f7, 1), whole(0x42f2, 4),
    whole(0x42f3, 8), words(0x4282, "webm"), whole(0x4287, 4), whole(0x4285, 2)),
    ...element(0x18538067, head, cues(start), all.map(({ parts }) => parts))];
}
