// Shows a pyramid of tiles on a canvas, with mouse, touch and keyboard, without a library.
//
//   const viewer = show_tiles(canvas, pyramid, { load, is_made, settled, moved })
//   viewer.go(x, y, width)      flies to a centre and a width, both in pixels of the frame
//   viewer.ask()                draws again, soon
//   viewer.hold()               the same, within the limits, which have changed
//
// A page whose picture changes has `paint` instead of tiles: paint(pencil, x, y, scale) draws the
// frame, of which (0, 0) lies at (x, y) of the canvas, at `scale` pixels of the canvas for each of its own.
// A viewer that is a part of a page has `keys`, the element in which keys are heard instead of the
// whole page; `turns(event)`, whether a turn of the wheel is its own; and `signal`, which ends it.
// largest(x, y) is LARGEST where a place is in the middle.
//
// Three kinds of pixels are used:
//
//   pixels of the frame   the top level of the pyramid; `view` contains the pixel in the centre of
//                         the window, and the number of them in one pixel of the page
//   pixels of a level     2^(top - level) pixels of the frame each
//   pixels of the screen  `ratio` for each pixel of the page
//
// INVARIANT  `view` is drawn, `goal` is its target. Movements set the goal; a drag sets both,
// because the point under a finger stays there. Nothing is drawn unless something moves or a tile
// arrives. Every tile of the current level is drawn once: from its own image if that is loaded,
// else from a part of the nearest coarser tile that is loaded. Where there is none, because the
// window has become smaller, the finer tiles that are always kept are drawn instead of the level.
const LARGEST = 8; // pixels of the page for each pixel of the frame
function show_tiles(canvas, pyramid, hooks) {
  "use strict";
  const KEPT = 600, AT_ONCE = 8; // tiles in memory, tiles being loaded
  const HALF_LIFE = 70; // milliseconds for half of the way to the goal
  const top = Math.ceil(Math.log2(Math.max(pyramid.width, pyramid.height, 1)));
  const pencil = canvas.getContext("2d");
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const lowest = pyramid.tiles.reduce((least, [level]) => Math.min(least, level), top);

  let width = 1, height = 1, ratio = 1; // the window, in pixels of the page and of the screen
  let view = { x: pyramid.width / 2, y: pyramid.height / 2, scale: 1 }, goal = { ...view };
  let flight = null; // a path of its own to the goal
  let drawn_at = 0, is_asked = false;

  // ------------------------------------------------------------ tiles

  const tiles = new Map(); // by "level/column/row": { image, is_ready, is_lost, used, level, ... }
  const queue = new Map(); // wanted, but not being loaded yet
  let coming = 0, clock = 0;

  const factor = level => 2 ** (top - level);
  const columns = level => Math.ceil(Math.ceil(pyramid.width / factor(level)) / pyramid.tile);
  const rows = level => Math.ceil(Math.ceil(pyramid.height / factor(level)) / pyramid.tile);

  function tile_at(level, column, row) {
    const key = `${level}/${column}/${row}`;
    let tile = tiles.get(key);
    if (!tile) {
      tile = { key, level, column, row, image: null, used: 0,
               is_coming: false, is_ready: false, is_lost: false };
      tiles.set(key, tile);
    }
    tile.used = clock;
    return tile;
  }

  // The tile itself, or the nearest coarser tile, that `accepts` returns true for; else null.
  function nearest(level, column, row, accepts) {
    for (let up = 0; level - up >= lowest; up++) {
      const tile = [level - up, Math.floor(column / 2 ** up), Math.floor(row / 2 ** up)];
      if (accepts(...tile)) return tile_at(...tile);
    }
    return null;
  }

  // hooks.load calls its last argument once: with an image or a canvas, or null if there is none.
  function load(tile) {
    tile.is_coming = true;
    coming++;
    hooks.load(tile.level, tile.column, tile.row, image => {
      coming--;
      tile.image = image;
      tile.is_coming = false;
      tile.is_ready = image !== null;
      tile.is_lost = image === null;
      fetch_more();
      ask();
    });
  }

  // Coarser tiles first, because they cover more; then tiles near the centre.
  function fetch_more() {
    while (coming < AT_ONCE && queue.size) {
      let best = null;
      for (const tile of queue.values()) if (!best || tile.rank < best.rank) best = tile;
      queue.delete(best.key);
      load(best);
    }
  }

  function want(tile, rank) {
    if (tile.is_coming || tile.is_ready || tile.is_lost) return;
    tile.rank = rank;
    queue.set(tile.key, tile);
  }

  function forget_old() {
    if (tiles.size <= KEPT) return;
    const is_old = tile => tile.used < clock && !tile.is_coming;
    const old = [...tiles.values()].filter(is_old);
    old.sort((a, b) => a.used - b.used);
    for (const tile of old.slice(0, tiles.size - KEPT)) tiles.delete(tile.key);
  }

  // ------------------------------------------------------------ drawing

  // The finest level that the screen can show.
  function wanted_level() {
    const level = Math.ceil(top - Math.log2(view.scale / ratio) - 0.2);
    return Math.max(lowest, Math.min(top, level));
  }

  // The position of a pixel of the frame on the screen, rounded so that there is no seam.
  const on_x = x => Math.round(((x - view.x) / view.scale + width / 2) * ratio);
  const on_y = y => Math.round(((y - view.y) / view.scale + height / 2) * ratio);

  // Draws the area of tile (level, column, row) from `tile`, which is that tile or a coarser one:
  //
  //   tile      +-----+-----+
  //             |     |#####|   # is the area; with an overlap, a tile begins with pixels of its
  //             |     |#####|   left and upper neighbours
  //             +-----+-----+
  //             |     |     |
  //             +-----+-----+
  function draw(tile, level, column, row) {
    const side = pyramid.tile * factor(level), own = factor(tile.level);
    const x0 = column * side, x1 = Math.min(x0 + side, pyramid.width);
    const y0 = row * side, y1 = Math.min(y0 + side, pyramid.height);
    const left = tile.column * pyramid.tile - (tile.column ? pyramid.overlap : 0);
    const upper = tile.row * pyramid.tile - (tile.row ? pyramid.overlap : 0);
    const from_x = x0 / own - left, to_x = Math.min(x1 / own - left, tile.image.width);
    const from_y = y0 / own - upper, to_y = Math.min(y1 / own - upper, tile.image.height);
    const at_x = on_x(x0), at_y = on_y(y0);
    if (to_x <= from_x || to_y <= from_y) return;
    pencil.drawImage(tile.image, from_x, from_y, to_x - from_x, to_y - from_y, at_x, at_y,
      on_x(x1) - at_x, on_y(y1) - at_y);
  }

  // Draws a tile's area from the nearest one that is ready, from level `begin` on; returns whether
  // there is one.
  function draw_ready(level, column, row, begin) {
    const up = 2 ** (level - begin);
    const loaded = nearest(begin, Math.floor(column / up), Math.floor(row / up),
      (...at) => tile_at(...at).is_ready);
    if (loaded) draw(loaded, level, column, row);
    return loaded !== null;
  }

  // Returns whether there was something to draw, or never will be.
  function draw_place(level, column, row, distance) {
    const is_usable = (...at) => hooks.is_made(...at) && !tile_at(...at).is_lost;
    const best = nearest(level, column, row, is_usable);
    if (!best) return true;
    want(best, best.level * 1e6 + distance);
    return draw_ready(level, column, row, best.level);
  }

  function draw_all() {
    if (hooks.paint) hooks.paint(pencil, on_x(0), on_y(0), ratio / view.scale);
    else draw_tiles();
  }

  function draw_tiles() {
    const level = wanted_level(), side = pyramid.tile * factor(level);
    const half_x = width / 2 * view.scale, half_y = height / 2 * view.scale;
    const first = v => Math.max(0, Math.floor(v / side));
    const column1 = Math.min(columns(level) - 1, Math.floor((view.x + half_x) / side));
    const row1 = Math.min(rows(level) - 1, Math.floor((view.y + half_y) / side));
    let is_full = true;
    clock++;
    queue.clear();
    pencil.clearRect(0, 0, canvas.width, canvas.height);
    pencil.imageSmoothingEnabled = view.scale / ratio > 0.4; // else pixels are squares
    pencil.imageSmoothingQuality = "high";
    for (let row = first(view.y - half_y); row <= row1; row++)
      for (let column = first(view.x - half_x); column <= column1; column++)
        is_full = draw_place(level, column, row,
          Math.hypot((column + 0.5) * side - view.x, (row + 0.5) * side - view.y) / side) && is_full;
    const kept = kept_tiles();
    for (const tile of kept) want(tile, -1);
    const is_settled = kept.every(tile => tile.is_ready || tile.is_lost);
    if (!is_full && kept[0]?.level > level && is_settled) draw_only(kept);
    fetch_more();
    forget_old();
  }

  function draw_only(some) {
    pencil.clearRect(0, 0, canvas.width, canvas.height);
    for (const tile of some) draw_ready(tile.level, tile.column, tile.row, tile.level);
  }

  // The finest level with few tiles is always kept, so that every view shows something.
  function kept_tiles() {
    const kept = [];
    let level = top;
    while (level > lowest && columns(level) * rows(level) > 4) level--;
    for (let row = 0; row < rows(level); row++)
      for (let column = 0; column < columns(level); column++)
        if (hooks.is_made(level, column, row)) kept.push(tile_at(level, column, row));
    return kept;
  }

  // ------------------------------------------------------------ moving

  const whole = () => Math.max(pyramid.width / width, pyramid.height / height);
  const hold = (value, least, most) => Math.max(least, Math.min(most, value));
  function held({ x, y, scale }) {
    const at = { x: hold(x, 0, pyramid.width), y: hold(y, 0, pyramid.height) };
    const least = 1 / (hooks.largest?.(at.x, at.y) ?? LARGEST);
    return { ...at, scale: hold(scale, least, 1.25 * Math.max(whole(), least)) };
  }

  // The smooth and efficient path between two views (van Wijk and Nuij): over long distances it
  // zooms out in between. u: 0..1.
  function fly(from, to) {
    const RHO = 1.4, w0 = from.scale * width, w1 = to.scale * width;
    const dx = to.x - from.x, dy = to.y - from.y, distance = Math.hypot(dx, dy);
    if (distance < 1e-3 * Math.min(w0, w1)) {
      const length = Math.abs(Math.log(w1 / w0)) / RHO;
      const scale = u => from.scale * (w1 / w0) ** u;
      return { length, at: u => ({ x: from.x + dx * u, y: from.y + dy * u, scale: scale(u) }) };
    }
    const r = (sign, w) => {
      const b = w1 * w1 - w0 * w0 + sign * RHO ** 4 * distance ** 2;
      return -Math.asinh(b / (2 * w * RHO ** 2 * distance));
    };
    const r0 = r(1, w0), r1 = r(-1, w1), length = (r1 - r0) / RHO;
    return { length, at: u => {
      const s = r0 + RHO * length * u;
      const way = w0 / RHO ** 2 * (Math.cosh(r0) * Math.tanh(s) - Math.sinh(r0)) / distance;
      const scale = w0 * Math.cosh(r0) / Math.cosh(s) / width;
      return { x: from.x + dx * way, y: from.y + dy * way, scale };
    } };
  }

  // A step of `elapsed` milliseconds towards the goal. A point that both views show at the same
  // place of the window stays there, so that zooming keeps the point under the pointer.
  function step(now, elapsed) {
    if (flight) {
      const u = hold((now - flight.start) / flight.time, 0, 1);
      view = u < 1 ? flight.at(u * u * (3 - 2 * u)) : goal;
      if (u === 1) flight = null;
      return;
    }
    const left = calm.matches ? 0 : 0.5 ** (elapsed / HALF_LIFE);
    const scale = goal.scale * (view.scale / goal.scale) ** left;
    const is_pan = Math.abs(Math.log(view.scale / goal.scale)) < 1e-6;
    const share = is_pan ? left : (scale - goal.scale) / (view.scale - goal.scale);
    view = { x: goal.x + (view.x - goal.x) * share, y: goal.y + (view.y - goal.y) * share, scale };
    const rest = Math.hypot(view.x - goal.x, view.y - goal.y) / goal.scale;
    if (rest < 0.2 && Math.abs(Math.log(view.scale / goal.scale)) < 1e-3) view = { ...goal };
  }

  const is_settled = () => view.x === goal.x && view.y === goal.y && view.scale === goal.scale;

  function frame(now) {
    is_asked = false;
    if (hooks.signal?.aborted) return;
    measure();
    const was_settled = is_settled();
    if (!was_settled) step(now, Math.min(50, now - drawn_at));
    drawn_at = now;
    draw_all();
    hooks.moved(tell());
    if (!is_settled()) ask();
    else if (!was_settled) hooks.settled(tell());
  }

  function ask() {
    if (is_asked) return;
    if (is_settled()) drawn_at = performance.now();
    is_asked = true;
    requestAnimationFrame(frame);
  }

  function aim(to) {
    flight = null;
    goal = held(to);
    ask();
  }

  // The start of a step: the goal, so that steps add up; a flight is stopped.
  const base = () => (flight ? view : goal);

  // Pans by a part of the window.
  function pan(part_x, part_y) {
    const { x, y, scale } = base();
    aim({ x: x + part_x * width * scale, y: y + part_y * height * scale, scale });
  }

  // Zooms; the point at (x, y) of the window stays there.
  function zoom(by, x = width / 2, y = height / 2, from = base()) {
    const scale = held({ ...from, scale: from.scale / by }).scale, change = from.scale - scale;
    aim({ x: from.x + (x - width / 2) * change, y: from.y + (y - height / 2) * change, scale });
  }

  function go(x, y, across, at_once) {
    goal = held({ x, y, scale: across / width });
    flight = null;
    if (at_once || calm.matches) view = { ...goal };
    else if (!is_settled()) {
      flight = fly(view, goal);
      flight.start = performance.now();
      flight.time = hold(450 * flight.length, 250, 5000);
    }
    ask();
  }

  const everything = at_once => go(pyramid.width / 2, pyramid.height / 2, whole() * width, at_once);
  // whole: the width of a view of everything.
  const tell = () => ({ x: view.x, y: view.y, width: view.scale * width, scale: view.scale,
                        whole: whole() * width });

  const is_everything = () => Math.abs(goal.scale / whole() - 1) < 1e-6
    && goal.x === pyramid.width / 2 && goal.y === pyramid.height / 2;

  // Measures the window; the point in its centre stays there, or everything is shown as before.
  function measure() {
    const box = canvas.getBoundingClientRect(), was_everything = is_everything();
    ratio = devicePixelRatio || 1;
    width = Math.max(1, box.width);
    height = Math.max(1, box.height);
    const across = Math.round(width * ratio), down = Math.round(height * ratio);
    if (canvas.width !== across) canvas.width = across;
    if (canvas.height !== down) canvas.height = down;
    if (!was_everything || is_everything()) return;
    goal = held({ ...goal, scale: whole() });
    view = { ...goal };
    flight = null;
  }

  // ------------------------------------------------------------ mouse and touch

  const fingers = new Map(); // by pointer: { x, y }
  let trail = []; // recent positions of a single finger; a throw continues its movement

  function place(event) {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top, time: event.timeStamp };
  }

  // The centre of the fingers, and their mean distance from it.
  function grip() {
    const all = [...fingers.values()];
    const x = all.reduce((sum, at) => sum + at.x, 0) / all.length;
    const y = all.reduce((sum, at) => sum + at.y, 0) / all.length;
    const spread = all.reduce((sum, at) => sum + Math.hypot(at.x - x, at.y - y), 0) / all.length;
    return { x, y, spread };
  }

  canvas.addEventListener("pointerdown", event => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    trail = [];
    aim({ ...view });
    view = { ...goal };
  });

  canvas.addEventListener("pointermove", event => {
    if (!fingers.has(event.pointerId)) return;
    const before = grip(), now = place(event);
    fingers.set(event.pointerId, now);
    const after = grip(), has_spread = before.spread > 0 && after.spread > 0;
    zoom(has_spread ? after.spread / before.spread : 1, before.x, before.y, view);
    aim({ x: goal.x - (after.x - before.x) * goal.scale,
          y: goal.y - (after.y - before.y) * goal.scale, scale: goal.scale });
    view = { ...goal };
    trail = fingers.size > 1 ? [] : trail.filter(at => now.time - at.time < 90).concat(now);
  });

  function let_go(event) {
    if (!fingers.delete(event.pointerId)) return;
    const first = trail[0], last = trail[trail.length - 1];
    const is_last = !fingers.size && event.type === "pointerup" && trail.length > 1;
    if (!is_last || event.timeStamp - last.time > 60) {
      hooks.settled(tell());
      return;
    }
    const throws = 180 / Math.max(16, last.time - first.time); // the movement of 180 milliseconds
    aim({ x: view.x - (last.x - first.x) * throws * view.scale,
          y: view.y - (last.y - first.y) * throws * view.scale, scale: view.scale });
    if (is_settled()) hooks.settled(tell());
  }
  canvas.addEventListener("pointerup", let_go);
  canvas.addEventListener("pointercancel", let_go);

  canvas.addEventListener("wheel", event => {
    if (hooks.turns && !hooks.turns(event)) return;
    event.preventDefault();
    const at = place(event), unit = [1, 16, height][event.deltaMode];
    const strength = event.ctrlKey ? 5 : 1; // ctrl: two fingers on a touch pad
    const turned = hold(event.deltaY * unit, -400, 400) * strength;
    zoom(2 ** (-turned / 300), at.x, at.y);
  }, { passive: false });

  canvas.addEventListener("dblclick", event => {
    const at = place(event);
    zoom(event.shiftKey ? 0.5 : 2, at.x, at.y);
  });

  // ------------------------------------------------------------ keys

  const KEYS = {
    ArrowLeft: () => pan(-0.2, 0), ArrowRight: () => pan(0.2, 0),
    ArrowUp: () => pan(0, -0.2), ArrowDown: () => pan(0, 0.2),
    a: () => pan(-0.2, 0), d: () => pan(0.2, 0), w: () => pan(0, -0.2), s: () => pan(0, 0.2),
    "+": () => zoom(1.5), "=": () => zoom(1.5), PageDown: () => zoom(2),
    "-": () => zoom(1 / 1.5), _: () => zoom(1 / 1.5), PageUp: () => zoom(0.5),
    0: () => everything(), Home: () => everything(),
    1: () => go(base().x, base().y, width / ratio),
  };

  // Whatever has the focus, except a slider: buttons use none of these keys.
  (hooks.keys ?? window).addEventListener("keydown", event => {
    if (event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key]) return;
    if (event.target?.tagName === "INPUT") return;
    event.preventDefault();
    KEYS[event.key]();
  }, { signal: hooks.signal });

  // ------------------------------------------------------------ start

  measure();
  everything(true);
  const hold_view = () => { goal = held(goal); ask(); };
  const resizes = new ResizeObserver(hold_view);
  resizes.observe(canvas);
  hooks.signal?.addEventListener("abort", () => resizes.disconnect());
  // The ratio changes with the browser's zoom.
  addEventListener("resize", ask, { signal: hooks.signal });
  return { go, zoom, everything, tell, ask, hold: hold_view };
}
