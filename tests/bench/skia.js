// Skia, as the raster canvas of @napi-rs/canvas: the jobs of peer.c, with times by the same rules.
//
//   node skia.js MODULES shapes DRAWING SIDE area BAND STRIDE
//   node skia.js MODULES look DRAWING SIDE
//   node skia.js MODULES picture affine|shift FOLDER
//   node skia.js MODULES film SHEET MIDDLE FRONT SIDE STEP
"use strict";
const fs = require("fs");
const path = require("path");

const [modules, verb, ...words] = process.argv.slice(2);
const { createCanvas, Path2D, ImageData } = require(path.resolve(modules, "@napi-rs/canvas"));

// ---------------------------------------------------------------- drawings

// The Bezier pieces of a closed uniform cubic B-spline on four points.
function splineData(n) {
  const at = (i) => [n[2 * (i % 4)], n[2 * (i % 4) + 1]];
  const mix = (...pairs) => [0, 1].map((c) => pairs.reduce((sum, [p, w]) => sum + p[c] * w, 0));
  let data = "M" + mix([at(0), 1 / 6], [at(1), 4 / 6], [at(2), 1 / 6]).join(" ");
  for (let i = 0; i < 4; i++) {
    const [b, c, d] = [at(i + 1), at(i + 2), at(i + 3)];
    const points = [mix([b, 2 / 3], [c, 1 / 3]), mix([b, 1 / 3], [c, 2 / 3]),
                    mix([b, 1 / 6], [c, 4 / 6], [d, 1 / 6])];
    data += "C" + points.map((p) => p.join(" ")).join(" ");
  }
  return data + "Z";
}

const readColour = ([r, g, b, a]) => `rgba(${r},${g},${b},${a / 255})`;

// A colour, or a gradient as drawing.h describes it; and the remaining words.
function readPaint(words) {
  if (words[0] !== "across") return [{ colour: readColour(words) }, words.slice(4)];
  return [{ columns: [Number(words[1]), Number(words[2])], colour: readColour(words.slice(3)),
            farColour: readColour(words.slice(7)) }, words.slice(11)];
}

function readShape(line) {
  const [kind, rule, ...words] = line.split(/\s+/);
  const [paint, rest] = readPaint(words);
  const data = kind === "spline" ? splineData(rest.map(Number)) : rest.join(" ");
  const heights = data.match(/-?[\d.]+(?:e[-+]?\d+)?/g).filter((_, i) => i % 2 === 1).map(Number);
  return { rule, data, paint, top: Math.min(...heights), bottom: Math.max(...heights) };
}

function readDrawing(file) {
  return fs.readFileSync(file, "utf8").trim().split("\n").slice(1).map(readShape);
}

// Path data scaled to the side, so that the path is built at full size as the others' are.
function scaled(data, side) {
  return data.replace(/-?[\d.]+(?:e[-+]?\d+)?/g, (number) => number * side);
}

// ---------------------------------------------------------------- measuring

const seconds = () => Number(process.hrtime.bigint()) * 1e-9;

function processor() {
  const used = process.cpuUsage();
  return (used.user + used.system) * 1e-6;
}

function peak() {
  return Number(/VmHWM:\s*(\d+)/.exec(fs.readFileSync("/proc/self/status", "utf8"))[1]);
}

// A part of the work as a sample of the whole, like bench_part of measure.h.
function measure(job, scale, fixed) {
  const limit = Number(process.env.BENCH_SECONDS || 0.2);
  const runs = [];
  let spent = 0;
  const whole = (time) => time * scale + fixed * (1 - scale);
  for (let run = 0; run <= 300 && (run === 0 || runs.length === 0 || spent < limit); run++) {
    const begun = seconds(), begunProcessor = processor();
    job();
    const wall = seconds() - begun;
    if (run === 0 && wall < limit) continue;
    runs.push([whole(wall), whole(processor() - begunProcessor)]);
    spent += wall;
  }
  const column = (i) => runs.map((r) => r[i]).sort((a, b) => a - b);
  const middle = runs.length >> 1;
  const wall = column(0), used = column(1);
  return `wall ${wall[middle]} best_wall ${wall[0]} processor ${used[middle]} ` +
    `best_processor ${used[0]} runs ${runs.length} peak_kib ${peak()}`;
}

function cells(canvas) {
  const { width, height } = canvas;
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  let text = "";
  for (let row = 0; row < 64; row++) {
    for (let column = 0; column < 64; column++) {
      const y0 = Math.floor(row * height / 64), y1 = Math.floor((row + 1) * height / 64);
      const x0 = Math.floor(column * width / 64), x1 = Math.floor((column + 1) * width / 64);
      const sum = [0, 0, 0], count = (y1 - y0) * (x1 - x0);
      for (let y = y0; y < y1; y++)
        for (let x = x0; x < x1; x++)
          for (let c = 0; c < 3; c++) sum[c] += data[4 * (y * width + x) + c];
      for (let c = 0; c < 3; c++)
        text += Math.floor((sum[c] + count / 2) / count).toString(16).padStart(2, "0");
    }
  }
  return text;
}

// ---------------------------------------------------------------- jobs

// Skia blends the colours of a gradient straight, in floats.
function styleOf(context, paint, side) {
  if (!paint.columns) return paint.colour;
  const [x0, x1] = paint.columns;
  const gradient = context.createLinearGradient(side * x0, 0, side * x1, 0);
  gradient.addColorStop(0, paint.colour);
  gradient.addColorStop(1, paint.farColour);
  return gradient;
}

// Reading one pixel makes Skia draw what was recorded.
function drawBand(context, shapes, paths, side, rows, top) {
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = "#fff";
  context.fillRect(0, 0, side, rows);
  context.translate(0, -top);
  shapes.forEach((shape, i) => {
    if (shape.bottom * side < top - 1 || shape.top * side > top + rows + 1) return;
    context.fillStyle = styleOf(context, shape.paint, side);
    context.fill(paths[i], shape.rule);
  });
  context.getImageData(0, 0, 1, 1);
}

function frame(context, shapes, data, side, rows, stride) {
  const paths = data.map((text) => new Path2D(text));
  for (let y = 0; y < side; y += rows * stride)
    drawBand(context, shapes, paths, side, Math.min(rows, side - y), y);
}

function drawnShare(side, rows, stride) {
  let drawn = 0;
  for (let y = 0; y < side; y += rows * stride) drawn += Math.min(rows, side - y);
  return side / drawn;
}

// Targa as bench_pictures writes it: 32 bits, from the upper left, BGRA, alpha straight.
function readTarga(file) {
  const bytes = fs.readFileSync(file);
  const width = bytes.readUInt16LE(12), height = bytes.readUInt16LE(14);
  const pixels = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < pixels.length; i += 4) {
    pixels[i] = bytes[18 + i + 2];
    pixels[i + 1] = bytes[18 + i + 1];
    pixels[i + 2] = bytes[18 + i];
    pixels[i + 3] = bytes[18 + i + 3];
  }
  const canvas = createCanvas(width, height);
  canvas.getContext("2d").putImageData(new ImageData(pixels, width, height), 0, 0);
  return canvas;
}

function picture(name, folder) {
  const ground = readTarga(path.join(folder, "ground.tga"));
  const overlay = readTarga(path.join(folder, "overlay.tga"));
  const canvas = createCanvas(ground.width, ground.height);
  const context = canvas.getContext("2d");
  const turn = name === "affine" ? 7 * Math.PI / 180 : 0, zoom = name === "affine" ? 0.8 : 1;
  const c = zoom * Math.cos(turn), s = zoom * Math.sin(turn);
  const w = overlay.width, h = overlay.height;
  const x = name === "affine" ? canvas.width / 2 - c * w / 2 + s * h / 2 : 512;
  const y = name === "affine" ? canvas.height / 2 - s * w / 2 - c * h / 2 : 256;
  console.log(measure(() => {
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(ground, 0, 0);
    context.setTransform(c, s, -s, c, x, y);
    context.drawImage(overlay, 0, 0);
    context.getImageData(0, 0, 1, 1);
  }, 1, 0) + " picture " + cells(canvas));
}

// ---------------------------------------------------------------- films

const frames = 48;

// The places of film.h.
function placeOf(number, cel) {
  const t = number / frames;
  return [[1 + 0.25 * t, -0.2 * t, -0.1 * t], [0.4, 0.55 - 0.3 * t, 0.1 + 0.013 * t],
          [0.45, 0.1 + 0.4 * t, 0.45 - 0.017 * t]][cel];
}

function drawCel(context, cel, side, [scale, x, y]) {
  context.setTransform(scale, 0, 0, scale, x * side, y * side);
  cel.shapes.forEach((shape, i) => {
    if (shape.bottom * scale + y < -1 / side || shape.top * scale + y > 1 + 1 / side) return;
    context.fillStyle = styleOf(context, shape.paint, side);
    context.fill(cel.paths[i], shape.rule);
  });
}

function drawFilmFrame(context, cels, side, number) {
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = "#fff";
  context.fillRect(0, 0, side, side);
  cels.forEach((cel, i) => drawCel(context, cel, side, placeOf(number, i)));
  context.getImageData(0, 0, 1, 1);
}

// The paths are built once.
function film(files, side, step) {
  const cels = files.map((file) => {
    const shapes = readDrawing(file);
    return { shapes, paths: shapes.map((shape) => new Path2D(scaled(shape.data, side))) };
  });
  const canvas = createCanvas(side, side), context = canvas.getContext("2d");
  drawFilmFrame(context, cels, side, 0); // what is done once in a process
  const times = measure(() => {
    for (let number = 0; number < frames; number += step)
      drawFilmFrame(context, cels, side, number);
  }, 1 / Math.ceil(frames / step), 0);
  drawFilmFrame(context, cels, side, frames / 2);
  console.log(`${times} picture ${cells(canvas)}`);
}

if (verb === "picture") {
  picture(words[0], words[1]);
} else if (verb === "film") {
  film(words.slice(0, 3), Number(words[3]), Number(words[4]));
} else {
  const shapes = readDrawing(words[0]), side = Number(words[1]);
  const data = shapes.map((shape) => scaled(shape.data, side));
  const rows = Number(words[3] || 0) || side, stride = Number(words[4] || 1);
  const canvas = createCanvas(side, rows);
  const context = canvas.getContext("2d");
  if (verb === "look") {
    frame(context, shapes, data, side, rows, 1);
    console.log("picture " + cells(canvas));
  } else {
    const begun = seconds();
    data.forEach((text) => new Path2D(text));
    const building = seconds() - begun;
    console.log(measure(() => frame(context, shapes, data, side, rows, stride),
                        drawnShare(side, rows, stride), building));
  }
}
