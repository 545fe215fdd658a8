// The film by Skia's canvas in Node: node skia.js MODULES DRAWING FOLDER
"use strict";
const fs = require("fs");
const path = require("path");
const [modules, drawing, folder] = process.argv.slice(2);
const { createCanvas, loadImage } = require(path.resolve(modules, "@napi-rs/canvas"));
const { draw } = require("./scene.js");

async function main() {
  const owl = await loadImage(drawing);
  const canvas = createCanvas(1280, 720);
  const pen = canvas.getContext("2d");
  for (let frame = 0; frame < 150; frame++) {
    draw(pen, frame, owl);
    const name = String(frame + 1).padStart(4, "0") + ".png";
    fs.writeFileSync(path.join(folder, name), await canvas.encode("png"));
  }
}

main();
