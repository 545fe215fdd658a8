// The form in which pixels are sent to the page (stage/stage.c): runs of one pixel, and of pixels
// above. A frame has tens of thousands, most of them short.
const FILL = 2 ** 30, ABOVE = 2 ** 31; // heads of these kinds are at least as large
const SHORT = 64; // below this many pixels a loop is faster than a call

/** The pixels of a picture, RGBA, from its runs. */
export function unpack(buffer, width, height) {
  const words = new Uint32Array(buffer), out = new Uint32Array(width * height);
  let at = 0;
  for (let i = 0; i < words.length;) {
    const head = words[i++], count = head & 0x3fffffff, end = at + count;
    if (head < FILL) {
      if (count > SHORT) out.set(words.subarray(i, i + count), at);
      else for (let from = i, p = at; p < end;) out[p++] = words[from++];
      i += count;
    } else if (head < ABOVE) {
      const word = words[i++];
      if (count > SHORT) out.fill(word, at, end);
      else for (let p = at; p < end; p++) out[p] = word;
    } else if (count > SHORT) {
      for (let p = at; p < end; p += width) out.copyWithin(p, p - width, Math.min(p, end - width));
    } else {
      for (let p = at; p < end; p++) out[p] = out[p - width];
    }
    at = end;
  }
  return new Uint8ClampedArray(out.buffer);
}
