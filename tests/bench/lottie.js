// The frames of a Lottie animation into memory, by Skottie or ThorVG as WebAssembly, with times as
// in lottie_frames.lua.
//
//   node lottie.js MODULES skottie|thorvg FILE WIDTH HEIGHT FRAMES
"use strict";
const fs = require("fs");
const path = require("path");

const [modules, peer, file, ...sizes] = process.argv.slice(2);
const [width, height, frames] = sizes.map(Number);

// Calls draw(share of the animation) for all frames, twice, and prints the second time.
function measure(draw) {
  const pass = () => {
    for (let i = 0; i < frames; i++) draw(i / frames);
  };
  pass();
  const wall = process.hrtime.bigint();
  const processor = process.cpuUsage();
  pass();
  const used = process.cpuUsage(processor);
  const each = [Number(process.hrtime.bigint() - wall) / 1e9, (used.user + used.system) / 1e6]
    .map((seconds) => (seconds / frames).toFixed(9));
  console.log(`wall ${each[0]} best_wall ${each[0]} processor ${each[1]} best_processor ` +
              `${each[1]} runs 1`);
}

async function skottie() {
  const folder = path.resolve(modules, "canvaskit-wasm/bin/full");
  const kit = await require(path.join(folder, "canvaskit.js"))({
    locateFile: (name) => path.join(folder, name) });
  const animation = kit.MakeManagedAnimation(fs.readFileSync(file, "utf8"), {});
  const surface = kit.MakeSurface(width, height);
  const place = kit.LTRBRect(0, 0, width, height);
  measure((share) => {
    animation.seek(share);
    surface.getCanvas().clear(kit.TRANSPARENT);
    animation.render(surface.getCanvas(), place);
    surface.flush();
  });
}

// ThorVG asks a browser for its canvas; these stand for it.
function standIn() {
  const canvas = { style: {}, getContext: () => ({ putImageData() {}, clearRect() {} }) };
  globalThis.window = { devicePixelRatio: 1, addEventListener() {} };
  globalThis.document = { querySelector: () => canvas };
  globalThis.ImageData = class {};
}

async function thorvg() {
  const folder = path.resolve(modules, "@thorvg/webcanvas/dist");
  standIn();
  const { default: engine } = await import(path.join(folder, "webcanvas.esm.js"));
  const kit = await engine.init({ renderer: "sw",
    locateFile: (name) => path.join(folder, name) });
  const canvas = new kit.Canvas("#canvas", { width, height, enableDevicePixelRatio: false });
  const animation = new kit.Animation();
  animation.load(new Uint8Array(fs.readFileSync(file)));
  animation.picture.size(width, height);
  canvas.add(animation.picture);
  const count = animation.info().totalFrames;
  measure((share) => {
    try {
      animation.frame(share * count);
    } catch (error) { // it refuses a frame that it already shows
    }
    canvas.update();
    canvas.render();
  });
}

const peers = { skottie, thorvg };
peers[peer]();
