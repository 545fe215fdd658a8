// Runs the page of a pyramid of tiles without a browser, and prints the drawing as a celspan
// script: every tile drawn is a rectangle with a picture.
//
//   node page.js INDEX.html WIDTH HEIGHT RATIO [ACTION ...]
//
//   hash:x,y,width   the address, from the beginning     key:+     wheel:x,y,delta     click:ID     place:NAME
//   drag:x0,y0,x1,y1                                     pinch:x,y,by     lose:PART     size:w,h
//   hold:PART
//
// `lose` makes every tile fail to load whose name contains that part, and `hold` never arrive. Comments at the end give the
// state of the page: its text, its address, how often it drew, and how many missing files it
// requested.
"use strict";
const fs = require("fs"), path = require("path"), vm = require("vm");

const [index, width, height, ratio, ...actions] = process.argv.slice(2);
const folder = path.dirname(path.resolve(index)), lost = [], held = [];
let size = { width: +width, height: +height }, now = 0, missing = 0, drawings = 0;
let frames = [], arrivals = [], draws = [], address = "";

function element(id) {
  const listeners = {};
  return {
    id, style: {}, textContent: "", width: 0, height: 0, listeners,
    addEventListener: (name, call) => (listeners[name] = listeners[name] || []).push(call),
    children: [], setAttribute() {}, focus() {}, setPointerCapture() {},
    appendChild(child) { this.children.push(child); return child; },
    getBoundingClientRect: () => ({ left: 0, top: 0, ...size }),
    getContext: () => pencil,
  };
}

const pencil = {
  clearRect() { draws = []; drawings++; },
  drawImage(image, ...box) { draws.push({ image, box, is_smooth: pencil.imageSmoothingEnabled }); },
};

class Image {
  set src(name) {
    const file = path.join(folder, decodeURIComponent(name));
    if (held.some(part => name.includes(part))) return;
    arrivals.push(() => {
      if (lost.some(part => name.includes(part))) return this.onerror();
      if (!fs.existsSync(file)) { missing++; return this.onerror(); }
      const bytes = fs.readFileSync(file);
      Object.assign(this, { file, width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20) });
      this.onload();
    });
  }
}

const elements = {}, of_window = {};
const body = element("body"), head = element("head");
const world = {
  Image, console, Math, devicePixelRatio: +ratio, window: null,
  document: {
    body, head, title: "", createElement: element,
    getElementById: id => (elements[id] = elements[id] || element(id)),
  },
  location: { hash: "" }, history: { replaceState: (state, title, url) => { address = url; } },
  matchMedia: () => ({ matches: false }), performance: { now: () => now },
  requestAnimationFrame: call => frames.push(call),
  ResizeObserver: class { observe() {} },
  addEventListener: (name, call) => (of_window[name] = of_window[name] || []).push(call),
};
world.window = world;

// Waits until every requested file has arrived and been drawn, and nothing moves any more.
function settle() {
  for (let i = 0; frames.length || arrivals.length; i++) {
    if (i > 3000) throw new Error("the page never comes to rest");
    const batch = frames, arrived = arrivals;
    frames = [];
    arrivals = [];
    now += 16;
    for (const arrival of arrived) arrival();
    for (const frame of batch) frame(now);
  }
}

function send(name, event) {
  const all = { timeStamp: now, button: 0, preventDefault() {}, ...event };
  for (const call of elements.view.listeners[name] || of_window[name] || []) call({ type: name, ...all });
}
const point = (id, x, y) => ({ pointerId: id, clientX: x, clientY: y });

const ACTIONS = {
  key: key => send("keydown", { key }),
  wheel: (x, y, delta) => send("wheel", { clientX: +x, clientY: +y, deltaY: +delta, deltaMode: 0 }),
  click: id => elements[id].onclick(),
  place: name => elements.places.children.find(button => button.textContent === name).onclick(),
  lose: part => lost.push(part),
  size: (w, h) => { size = { width: +w, height: +h }; for (const call of of_window.resize) call(); },
  drag(x0, y0, x1, y1) {
    send("pointerdown", point(1, +x0, +y0));
    send("pointermove", point(1, +x1, +y1));
    now += 200; // it does not move before it is released
    send("pointerup", point(1, +x1, +y1));
  },
  pinch(x, y, by) {
    send("pointerdown", point(1, +x - 50, +y));
    send("pointerdown", point(2, +x + 50, +y));
    send("pointermove", point(1, +x - 50 * by, +y));
    send("pointermove", point(2, +x + 50 * by, +y));
    now += 20; // it still moves when it is released
    send("pointerup", point(1, +x - 50 * by, +y));
    send("pointerup", point(2, +x + 50 * by, +y));
  },
};

for (const action of actions.filter(text => text.startsWith("hash:"))) world.location.hash = "#" + action.slice(5);
for (const action of actions.filter(text => text.startsWith("lose:"))) lost.push(action.slice(5));
for (const action of actions.filter(text => text.startsWith("hold:"))) held.push(action.slice(5));
vm.createContext(world);
for (const [, script] of fs.readFileSync(index, "utf8").matchAll(/<script>([^]*?)<\/script>/g))
  vm.runInContext(script, world);
settle();
for (const action of actions) {
  const [, name, rest] = /^(\w+):(.*)$/.exec(action);
  if (name === "hash" || name === "lose" || name === "hold") continue;
  ACTIONS[name](...(name === "key" ? [rest] : rest.split(",")));
  settle();
}

const canvas = elements.view;
console.log(`local celspan = require "celspan"\nlocal drawn = {`);
for (const { image, box: [sx, sy, sw, sh, dx, dy, dw, dh], is_smooth } of draws) {
  const across = dw / sw, down = dh / sh;
  const box = [dx - sx * across, dy - sy * down, image.width * across, image.height * down];
  console.log(`  celspan.rect { ${dx}, ${dy}, ${dw}, ${dh}, texture = celspan.picture { file = ` +
    `"${image.file}", box = { ${box} }, wrap = "clamp", sampling = "${is_smooth ? "auto" : "nearest"}" } },`);
}
console.log(`}\nreturn celspan.film { size = { ${canvas.width}, ${canvas.height} }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel(drawn), back = "${body.style.background}" } end }
-- text: ${elements.where.textContent}\n-- address: ${address}\n-- drawings: ${drawings}\n-- missing: ${missing}`);
