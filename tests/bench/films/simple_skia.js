// The raw frames of the film by Skia's canvas in Node: node simple_skia.js MODULES FRAMES
"use strict";
const fs = require("fs");
const path = require("path");
const [modules, frames] = process.argv.slice(2);
const { createCanvas } = require(path.resolve(modules, "@napi-rs/canvas"));
const { draw } = require("./simple.js");

// A pipe takes a part of what it is given.
function put(bytes) {
  for (let done = 0; done < bytes.length;)
    done += fs.writeSync(1, bytes, done);
}

const canvas = createCanvas(1280, 720);
const pen = canvas.getContext("2d");
for (let frame = 0; frame < frames; frame++) {
  draw(pen, frame);
  put(canvas.data());
}
