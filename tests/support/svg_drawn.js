// Draws an SVG drawing in a browser and in resvg, and compares both, and what librsvg and Poppler
// have drawn, with the frame: the steps of browser.js for tests/desk/spec/svg_drawn_spec.lua, after CASE:
//
//   { folder, width, height, fine, resvg }   resvg: the file of its package
//
// The folder has x.svg, and pictures as RGBA of 8 bits: `frame`, `librsvg`, `poppler`, and `fine`,
// the frame with `fine` times as many pixels on both sides. For each program the result has the share of the pixels
// away from edges that are within 3 codes of the frame; how many there are; and how far a pixel is
// outside of the codes of the 5 x 5 pixels around it in both frames, where, and how many are by more
// than 4. All are over white.
const fs = require("fs");
const { folder, width: W, height: H, fine: FINE, resvg } = CASE;

function overWhite(bytes) {
  for (let i = 0; i < bytes.length; i += 4) {
    for (let c = i; c < i + 3; c++) bytes[c] += (255 - bytes[c]) * (255 - bytes[i + 3]) / 255;
    bytes[i + 3] = 255;
  }
  return bytes;
}

const read = name => overWhite(new Uint8ClampedArray(fs.readFileSync(`${folder}/${name}`)));

// Ranges have the least and the greatest code of each channel of each pixel. They grow in loops, because
// functions of arrays take four times as long.
const rangesOf = codes => ({ least: codes.slice(), most: codes.slice() });

function grow(ranges, at, least, most) {
  if (least < ranges.least[at]) ranges.least[at] = least;
  if (most > ranges.most[at]) ranges.most[at] = most;
}

/** The ranges of the pixels within a number of columns, where the stride is 4, or of rows. */
function along(ranges, radius, stride, line) {
  const { least, most } = ranges;
  const out = { least: least.slice(), most: most.slice() };
  for (let start = 0; start < least.length; start += line)
    for (let k = stride; k <= radius * stride; k += stride)
      for (let i = start, j = start + k; j < start + line; i++, j++) {
        grow(out, i, least[j], most[j]);
        grow(out, j, least[i], most[i]);
      }
  return out;
}

const within = (ranges, radius) => along(along(ranges, radius, 4, 4 * W), radius, 4 * W, 4 * W * H);

/** Lets ranges have the codes of a frame with more pixels, too. */
function include(ranges, fine) {
  for (let y = 0, i = 0; y < FINE * H; y++)
    for (let x = 0; x < FINE * W; x++)
      for (let c = 0; c < 4; c++, i++)
        grow(ranges, 4 * (W * Math.floor(y / FINE) + Math.floor(x / FINE)) + c, fine[i], fine[i]);
  return ranges;
}

const frame = read("frame"), fine = read("fine");
const near = within(rangesOf(frame), 1), far = within(include(rangesOf(frame), fine), 2);

function compare(drawn) {
  let flat = 0, same = 0, worst = 0, place = [0, 0], seams = 0;
  for (let i = 0; i < drawn.length; i += 4) {
    let isFlat = true, off = 0, beyond = 0;
    for (let c = i; c < i + 3; c++) {
      isFlat &&= near.most[c] - near.least[c] <= 3;
      off = Math.max(off, Math.abs(drawn[c] - frame[c]));
      beyond = Math.max(beyond, far.least[c] - drawn[c], drawn[c] - far.most[c]);
    }
    flat += isFlat;
    same += isFlat && off <= 3;
    seams += beyond > 4;
    if (beyond > worst) { worst = beyond; place = [i / 4 % W, Math.floor(i / 4 / W)]; }
  }
  return { share: same / flat, flat, worst, place, seams };
}

/** The codes of a canvas of the page, in bands, because the pipe takes long for large messages. */
async function drawInBrowser() {
  const svg = fs.readFileSync(`${folder}/x.svg`).toString("base64");
  await page.get(`(async () => {
    const image = new Image();
    image.src = "data:image/svg+xml;base64,${svg}";
    await image.decode();
    globalThis.canvas = new OffscreenCanvas(${W}, ${H}).getContext("2d", { willReadFrequently: true });
    canvas.drawImage(image, 0, 0, ${W}, ${H});
  })()`);
  const out = new Uint8ClampedArray(4 * W * H), BAND = 128;
  for (let y = 0; y < H; y += BAND) {
    const band = `canvas.getImageData(0, ${y}, ${W}, ${Math.min(BAND, H - y)}).data.buffer`;
    out.set(Buffer.from(await page.get(`new Uint8Array(${band}).toBase64()`), "base64"), 4 * W * y);
  }
  return overWhite(out);
}

const found = { librsvg: compare(read("librsvg")), chromium: compare(await drawInBrowser()) };
if (fs.existsSync(`${folder}/poppler`)) found.poppler = compare(read("poppler"));
if (resvg) {
  const drawing = new (require(`${process.cwd()}/${resvg}`).Resvg)(fs.readFileSync(`${folder}/x.svg`), { background: "white" });
  found.resvg = compare(overWhite(new Uint8ClampedArray(drawing.render().pixels)));
}
return found;
