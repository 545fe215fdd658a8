// Measures a page that celspan plane wrote, in V8: how long its decoder draws the picture in it.
//
//   node plane.js PAGE WIDTH HEIGHT
//
// Prints one line of KEY VALUE pairs, as the other programs do; bytes are those of the decoder.
"use strict";
const fs = require("fs");
const { performance } = require("perf_hooks");
const { gunzipSync } = require("zlib");

const [file, width, height] = process.argv.slice(2);
const page = fs.readFileSync(file, "utf8");
const part = pattern => Buffer.from(page.match(pattern)[1], "base64");

function median(seconds) {
  return seconds.sort((a, b) => a - b)[Math.floor(seconds.length / 2)];
}

async function main() {
  const module = gunzipSync(part(/const DECODER = "([^"]*)"/));
  const plane = part(/<script id="plane" type="text\/plain">([^<]*)</);
  const { instance: { exports: decoder } } = await WebAssembly.instantiate(module);
  const address = decoder.reserve(plane.length);
  new Uint8Array(decoder.memory.buffer, address, plane.length).set(plane);
  if (decoder.open(0)) throw new Error("the plane cannot be read");
  const seconds = [], limit = Number(process.env.BENCH_SECONDS) || 1;
  for (let sum = 0; sum < limit || seconds.length < 8; sum += seconds.at(-1)) {
    const start = performance.now();
    if (!decoder.draw(width, height, 0, 0, width, height)) throw new Error("it cannot be drawn");
    seconds.push((performance.now() - start) / 1000);
  }
  const middle = median(seconds.slice(4)), least = Math.min(...seconds); // the first ones compile
  console.log(`wall ${middle} best_wall ${least} processor ${middle} best_processor ${least} `
    + `runs ${seconds.length} peak_kib 0 bytes ${module.length}`);
}
main();
