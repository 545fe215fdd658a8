// Draws scenes in a browser and compares them with celspan's pictures of them: the steps of
// browser.js for tests/core/property/browser_spec.lua.
//
// The folder $CELSPAN_DRAWN has a list of the scenes' numbers, and for each number N.svg; N.film
// and perhaps N.read, pictures by celspan; and N.edges, whose alpha is above 0 in pixels that an
// edge touches. These are not compared. For each picture and each kind of canvas, the result has
// how many pixels are off by 0, 1, 2, ... codes in the channel that is off by most, and where the
// worst is.
//
// A canvas of half floats is drawn by the same code as the page, but without rounding every group
// to 8 bits. It needs Chromium 140 or later.
const fs = require("fs");
const folder = process.env.CELSPAN_DRAWN;
const W = 640, H = 360, KINDS = ["float16", "unorm8"];

/** In the page: what is found in a scene. `given`: pictures by name, as base64, clear at edges. */
async function compare(svg, given, W, H, KINDS) {
  const image = new Image();
  image.src = "data:image/svg+xml;base64," + svg;
  await image.decode();
  const found = {};
  for (const colorType of KINDS) {
    const context = new OffscreenCanvas(W, H)
      .getContext("2d", { colorType, willReadFrequently: true });
    if (context.getContextAttributes().colorType !== colorType) throw new Error(`no ${colorType}`);
    context.drawImage(image, 0, 0);
    const theirs = context.getImageData(0, 0, W, H).data;
    for (const [name, picture] of Object.entries(given)) {
      found[`${name} ${colorType}`] = histogram(Uint8Array.fromBase64(picture), theirs, W);
    }
  }
  return found;

  function histogram(ours, theirs, W) {
    const counts = new Array(256).fill(0);
    let worst = -1, place;
    for (let i = 0; i < ours.length; i += 4) {
      if (ours[i + 3] === 0) continue;
      const off = Math.max(Math.abs(ours[i] - theirs[i]), Math.abs(ours[i + 1] - theirs[i + 1]),
        Math.abs(ours[i + 2] - theirs[i + 2]));
      counts[off]++;
      if (off > worst) { worst = off; place = [i / 4 % W, Math.floor(i / 4 / W)]; }
    }
    return { counts, place };
  }
}

/** A picture as base64: clear where an edge is. */
function marked(path, edges) {
  const picture = fs.readFileSync(path);
  for (let i = 3; i < picture.length; i += 4) picture[i] = edges[i] > 0 ? 0 : 255;
  return picture.toString("base64");
}

const result = [];
for (const number of fs.readFileSync(`${folder}/list`, "utf8").split(" ")) {
  const edges = fs.readFileSync(`${folder}/${number}.edges`), given = {};
  for (const name of ["film", "read"]) {
    const path = `${folder}/${number}.${name}`;
    if (fs.existsSync(path)) given[name] = marked(path, edges);
  }
  const svg = fs.readFileSync(`${folder}/${number}.svg`).toString("base64");
  const values = JSON.stringify([svg, given, W, H, KINDS]);
  result.push({ number, found: await page.get(`(${compare})(...${values})`) });
}
return result;
