// MP4: boxes of a size, a name and contents (ISO/IEC 14496-12).
//
//   ftyp   moov [ mvhd   trak [ ..., where each chunk is ] ... ]   mdat [ chunks in order of time ]
import { RATE, be, size, text } from "./export.js";

const SECOND = 1e6; // of the times of chunks
const box = (name, ...content) => {
  const parts = content.flat(9);
  return [be(4, 8 + size(parts)), text(name), ...parts];
};
const full = (name, flags, ...content) => box(name, be(4, flags), ...content);
const none = count => new Uint8Array(count);
const MATRIX = be(4, 0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x40000000);
const CLOCK = 1000; // of the file; each track has its own

/** Descriptors of AAC (ISO/IEC 14496-1): a tag, a size below 128, contents. */
const tagged = (tag, ...content) => [be(1, tag, size(content.flat(9))), ...content.flat(9)];

/** The description of the samples of a track. */
function entry({ kind, config, description }, { width, height }) {
  const own = new Uint8Array(description), head = [none(6), be(2, 1)];
  if (kind === 1) {
    return box("avc1", head, none(16), be(2, width, height), be(4, 0x480000, 0x480000, 0), be(2, 1),
      none(32), be(2, 24, 0xffff), box("avcC", own), box("colr", text("nclx"), be(2, 1, 13, 1), be(1, 0)));
  }
  const sound = [head, none(8), be(2, 2, 16), none(4), be(4, RATE * 65536)];
  if (config.codec !== "opus") {
    return box("mp4a", sound, full("esds", 0, tagged(3, be(2, 2), be(1, 0),
      tagged(4, be(1, 0x40, 0x15), none(11), tagged(5, own)), tagged(6, be(1, 2)))));
  }
  const opus = new DataView(own.buffer);
  return box("Opus", sound, box("dOps", be(1, 0, 2), be(2, opus.getUint16(10, true)),
    be(4, opus.getUint32(12, true)), none(3)));
}

/** places: of its chunks in the file. */
function trak(one, film, places) {
  const { kind, chunks, config, description } = one, isVideo = kind === 1;
  const clock = isVideo ? Math.round(film.fps * 1000) : RATE;
  const starts = [...chunks.map(({ time }) => Math.round(time * clock / SECOND)),
    Math.round(film.seconds * clock)];
  const skip = config.codec === "opus"
    ? new DataView(new Uint8Array(description).buffer).getUint16(10, true) : 0;
  const long = Math.round(film.seconds * CLOCK), keys = chunks.flatMap(({ isKey }, i) =>
    isKey ? [i + 1] : []);
  return box("trak",
    full("tkhd", 3, be(4, 0, 0, kind, 0, long, 0, 0), be(2, 0, 0, isVideo ? 0 : 256, 0), MATRIX,
      be(2, isVideo ? film.width : 0, 0, isVideo ? film.height : 0, 0)),
    box("edts", full("elst", 0, be(4, 1, long, skip, 0x10000))),
    box("mdia", full("mdhd", 0, be(4, 0, 0, clock, starts.at(-1)), be(2, 0x55c4, 0)),
      full("hdlr", 0, none(4), text(isVideo ? "vide" : "soun"), none(13)),
      box("minf", isVideo ? full("vmhd", 1, none(8)) : full("smhd", 0, none(4)),
        box("dinf", full("dref", 0, be(4, 1), full("url ", 1))),
        box("stbl", full("stsd", 0, be(4, 1), entry(one, film)),
          full("stts", 0, be(4, chunks.length, chunks.flatMap((_, i) =>
            [1, Math.max(1, starts[i + 1] - starts[i])]))),
          isVideo ? full("stss", 0, be(4, keys.length, keys)) : [],
          full("stsc", 0, be(4, 1, 1, 1, 1)),
          full("stsz", 0, be(4, 0, chunks.length, chunks.map(({ data }) => data.length))),
          full("stco", 0, be(4, places.length, places))))));
}

/** The parts of a file. video, audio: { chunks, config, description }; audio may be null. */
export function mp4(film, video, audio) {
  const tracks = audio ? [video, audio] : [video];
  const chunks = tracks.flatMap(one => one.chunks).sort((a, b) => a.time - b.time);
  const moov = start => {
    const places = { 1: [], 2: [] };
    let at = start;
    for (const { kind, data } of chunks) {
      places[kind].push(at);
      at += data.length;
    }
    return box("moov", full("mvhd", 0, be(4, 0, 0, CLOCK, Math.round(film.seconds * CLOCK), 0x10000),
      be(2, 256), none(10), MATRIX, none(24), be(4, 3)),
    tracks.map(one => trak(one, film, places[one.kind])));
  };
  const head = box("ftyp", text("isom"), be(4, 512), text("isomiso2avc1mp41"));
  const data = box("mdat", chunks.map(one => one.data));
  return [...head, ...moov(size(head) + size(moov(0)) + 8), ...data];
}
