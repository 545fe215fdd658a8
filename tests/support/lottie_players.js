// Frames of a Lottie animation as other players draw them over white, as rows of RGBA:
//
//   node lottie_players.js MODULES skottie|thorvg FILE OUT WIDTH HEIGHT FRAME ...    ->   OUT.FRAME
"use strict";
const fs = require("fs");
const path = require("path");

const [modules, peer, file, out, ...numbers] = process.argv.slice(2);
const [width, height, ...frames] = numbers.map(Number);

async function skottie() {
  const folder = path.resolve(modules, "canvaskit-wasm/bin/full");
  const kit = await require(path.join(folder, "canvaskit.js"))({
    locateFile: (name) => path.join(folder, name) });
  const animation = kit.MakeManagedAnimation(fs.readFileSync(file, "utf8"), {});
  const surface = kit.MakeSurface(width, height);
  return (frame) => {
    animation.seekFrame(frame);
    surface.getCanvas().clear(kit.WHITE);
    animation.render(surface.getCanvas(), kit.LTRBRect(0, 0, width, height));
    surface.flush();
    return surface.makeImageSnapshot().readPixels(0, 0, { width, height,
      colorType: kit.ColorType.RGBA_8888, alphaType: kit.AlphaType.Unpremul,
      colorSpace: kit.ColorSpace.SRGB });
  };
}

// Over white, of straight alpha.
function flatten(pixels) {
  for (let i = 0; i < pixels.length; i += 4)
    for (let c = i; c < i + 3; c++)
      pixels[c] = Math.round(255 - pixels[i + 3] + pixels[c] * pixels[i + 3] / 255);
  return pixels;
}

async function thorvg() {
  const folder = path.resolve(modules, "@thorvg/webcanvas/dist");
  let shown; // ThorVG asks a browser for its canvas; these stand for it
  const canvas = { style: {}, getContext: () => ({ putImageData(image) { shown = image.data; },
                                                   clearRect() {} }) };
  globalThis.window = { devicePixelRatio: 1, addEventListener() {} };
  globalThis.document = { querySelector: () => canvas };
  globalThis.ImageData = class { constructor(data) { this.data = data; } };
  const { default: engine } = await import(path.join(folder, "webcanvas.esm.js"));
  const kit = await engine.init({ renderer: "sw", locateFile: (name) => path.join(folder, name) });
  const picture = new kit.Canvas("#canvas", { width, height, enableDevicePixelRatio: false });
  const animation = new kit.Animation();
  animation.load(new Uint8Array(fs.readFileSync(file)));
  animation.picture.size(width, height);
  picture.add(animation.picture);
  return (frame) => {
    try {
      animation.frame(frame);
    } catch (error) { // it refuses a frame that it already shows
    }
    picture.update();
    picture.render();
    return flatten(Buffer.from(shown));
  };
}

const peers = { skottie, thorvg };
peers[peer]().then((draw) => {
  for (const frame of frames) fs.writeFileSync(`${out}.${frame}`, draw(frame));
  process.exit(0);
});
