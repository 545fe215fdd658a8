// The 60 groups of scripts/compositing.lua in Skia, as the raster canvas of @napi-rs/canvas.
//
//   node skia_groups.js MODULES WIDTH FRAME [FILE.png]
//
// Prints the times of one frame as measure.h does, or writes the picture.
"use strict";
const fs = require("fs");
const path = require("path");

const [modules, width, frame, file] = process.argv.slice(2);
const { createCanvas, Path2D } = require(path.resolve(modules, "@napi-rs/canvas"));
const W = 1920, H = 1080, scale = Number(width) / W;

const modes = ["source-over", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge",
               "color-burn", "hard-light", "soft-light", "difference", "exclusion", "hue",
               "saturation", "color", "luminosity"];

function numbers(seed) {
  let state = seed;
  return () => (state = state * 16807 % 2147483647) / 2147483647;
}

function members(next) {
  const list = [];
  for (let i = 1; i <= 12; i++) {
    const x = 220 * next() - 110, y = 220 * next() - 110, s = 15 + 35 * next();
    const colour = [next(), next(), next()].map((v) => Math.floor(256 * v)).join(",");
    const shape = new Path2D();
    if (i % 2 === 0) shape.arc(x, y, s, 0, 2 * Math.PI);
    else shape.rect(x - s, y - s, 2 * s, 2 * s);
    list.push({ shape, style: `rgba(${colour},${0.4 + 0.6 * next()})` });
  }
  return list;
}

function groups() {
  const next = numbers(28), list = [];
  for (let i = 1; i <= 60; i++) {
    const group = { x: W * next(), y: H * next(), turn: 2 * Math.PI * next(),
                    opacity: 0.5 + 0.5 * next(), mode: modes[i % modes.length] };
    group.members = members(next);
    group.blur = i % 3 === 0 ? 4 + 20 * next() : 0;
    list.push(group);
  }
  return list;
}

// A group is drawn on a canvas of its own size, which holds the shapes in every position; the
// canvas is reused.
const reach = Math.ceil(230 * scale);
const sheet = createCanvas(2 * reach, 2 * reach), own = sheet.getContext("2d");
const canvas = createCanvas(W * scale, H * scale), context = canvas.getContext("2d");

// Without a clip, Skia makes a layer of the size of the frame for most modes and blurs, and takes
// six times as long. The margin is more than three times the widest blur's sigma.
const margin = Math.ceil(40 * scale);
function drawWithin(left, top, draw) {
  context.save();
  context.beginPath();
  context.rect(left, top, 2 * (reach + margin), 2 * (reach + margin));
  context.clip();
  draw();
  context.restore();
}

function drawGroup(group, number) {
  own.setTransform(1, 0, 0, 1, 0, 0);
  own.clearRect(0, 0, 2 * reach, 2 * reach);
  const turn = group.turn + number * 1.5 * Math.PI / 180;
  const c = scale * Math.cos(turn), s = scale * Math.sin(turn);
  const x = (group.x + 0.7 * number) * scale, y = group.y * scale;
  const left = Math.floor(x) - reach, top = Math.floor(y) - reach;
  own.setTransform(c, s, -s, c, x - left, y - top);
  for (const { shape, style } of group.members) {
    own.fillStyle = style;
    own.fill(shape);
  }
  context.globalAlpha = group.opacity;
  context.globalCompositeOperation = group.mode;
  context.filter = group.blur > 0 ? `blur(${group.blur * scale / 2}px)` : "none";
  drawWithin(left - margin, top - margin, () => context.drawImage(sheet, left, top));
}

// Reading one pixel makes Skia draw what was recorded.
function drawFrame(list, number) {
  context.globalAlpha = 1;
  context.globalCompositeOperation = "source-over";
  context.filter = "none";
  context.fillStyle = "#345";
  context.fillRect(0, 0, canvas.width, canvas.height);
  for (const group of list) drawGroup(group, number);
  context.getImageData(0, 0, 1, 1);
}

const list = groups();
drawFrame(list, Number(frame));
if (file) {
  fs.writeFileSync(file, canvas.toBuffer("image/png"));
} else {
  const runs = [];
  for (let run = 0; run < 5; run++) {
    const begun = process.hrtime.bigint();
    drawFrame(list, Number(frame));
    runs.push(Number(process.hrtime.bigint() - begun) * 1e-9);
  }
  console.log(`seconds ${Math.min(...runs)}`);
}
