// The form in which pixels are sent to the page (program/stage.c): runs of one pixel, and of the
// pixels above.
const LITERAL = 0, FILL = 1;
const SHORT = 24; // below this many pixels a loop is faster than a call

/** The pixels of a picture, RGBA, from its runs. */
export function unpack(buffer, width, height) {
  const words = new Uint32Array(buffer), out = new Uint32Array(width * height);
  let at = 0;
  for (let i = 0; i < words.length;) {
    const kind = words[i] >>> 30, count = words[i++] & 0x3fffffff, end = at + count;
    if (kind === LITERAL) {
      if (count > SHORT) out.set(words.subarray(i, i + count), at);
      else for (let k = 0; k < count; k++) out[at + k] = words[i + k];
      i += count;
    } else if (kind === FILL) {
      out.fill(words[i++], at, end);
    } else if (count > SHORT) {
      for (let p = at; p < end; p += width) out.copyWithin(p, p - width, Math.min(p, end - width));
    } else {
      for (let p = at; p < end; p++) out[p] = out[p - width];
    }
    at = end;
  }
  return new Uint8ClampedArray(out.buffer);
}
