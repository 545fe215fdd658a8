// What the frames of a film cost, for the page of celspan watch.
//
//   each picture that arrives --seconds--> times --> the strip under the sheet, the slowest frames
//   /costs.json?frame=N --> the table: the frame, and each of its cels alone
const SLOWEST = 5; // frames that are listed
// a bar has the colour of slow frames if it exceeds this share of the time of a frame
const SLOW_SHARE = 1;

const times = new Map(); // seconds, by the number of the frame
let timesBuild = 0;

/** Notes how long a frame of a save took. */
export function noteTime(number, seconds, ofBuild) {
  if (ofBuild !== timesBuild) times.clear();
  timesBuild = ofBuild;
  if (seconds > 0) times.set(number, seconds);
}

/** The frames that took longest, { number, seconds }. */
export function slowest() {
  return [...times].map(([number, seconds]) => ({ number, seconds }))
    .sort((a, b) => b.seconds - a.seconds).slice(0, SLOWEST);
}

/** Whether a frame took longer than it is shown. */
export const isSlow = (number, due) => times.get(number) > SLOW_SHARE * due;

/** A bar for each frame whose time is known, from y on; `due`: the seconds that a frame may take.
 * xOf, unit: of the timeline. */
export function drawStrip(brush, y, height, xOf, unit, due, colours) {
  let most = due; // a call cannot take all of them: there may be more than 100,000
  for (const seconds of times.values()) most = Math.max(most, seconds);
  for (const [number, seconds] of times) {
    const bar = Math.max(1, seconds / most * (height - 4));
    brush.fillStyle = seconds > SLOW_SHARE * due ? colours.slow : colours.quiet;
    brush.fillRect(xOf(number - 1), y + height - 2 - bar, Math.max(1, unit - 1), bar);
  }
}

const number = (value, digits) => value.toLocaleString("en", { maximumFractionDigits: digits,
                                                               minimumFractionDigits: digits });

/** The cells of a row of the table: name, milliseconds, MiB, spans by kind. */
export function cellsOf(one, isWhole) {
  return [isWhole ? "the frame" : one.name, number(one.seconds * 1000, 1),
          number(one.bytes / 1048576, 1), number(one.single, 0), number(one.gradient, 0),
          number(one.array, 0)];
}
