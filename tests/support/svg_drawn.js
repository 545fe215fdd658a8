// Draws an SVG drawing in a browser and in resvg, and compares both, and what librsvg and Poppler
// have drawn, with the frame: the steps of browser.js for tests/spec/svg_drawn_spec.lua, after CASE:
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

/** For each channel of each pixel, the least or the greatest code within a number of pixels. */
function within(codes, better, radius) {
  const along = (list, count, stride) => list.map((code, i) => {
    const at = Math.floor(i / stride) % count;
    const last = Math.min(radius, count - 1 - at);
    for (let k = Math.max(-radius, -at); k <= last; k++) code = better(code, list[i + k * stride]);
    return code;
  });
  return along(along(codes, W, 4), H, 4 * W);
}

/** The least or the greatest codes of a pixel in both frames. */
function everyOne(frame, fine, better) {
  const out = frame.slice();
  for (let i = 0; i < fine.length; i++) {
    const x = Math.floor((i >> 2) % (FINE * W) / FINE), y = Math.floor(i / (4 * FINE * FINE * W));
    const at = 4 * (W * y + x) + i % 4;
    out[at] = better(out[at], fine[i]);
  }
  return out;
}

const less = (a, b) => a < b ? a : b, more = (a, b) => a > b ? a : b;
const frame = read("frame"), fine = read("fine");
const near = [within(frame, less, 1), within(frame, more, 1)];
const far = [within(everyOne(frame, fine, less), less, 2), within(everyOne(frame, fine, more), more, 2)];

function compare(drawn) {
  let flat = 0, same = 0, worst = 0, place = [0, 0], seams = 0;
  for (let i = 0; i < drawn.length; i += 4) {
    let isFlat = true, off = 0, beyond = 0;
    for (let c = i; c < i + 3; c++) {
      isFlat &&= near[1][c] - near[0][c] <= 3;
      off = more(off, Math.abs(drawn[c] - frame[c]));
      beyond = more(beyond, more(far[0][c] - drawn[c], drawn[c] - far[1][c]));
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
    const band = `canvas.getImageData(0, ${y}, ${W}, ${less(BAND, H - y)}).data.buffer`;
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
