// Which frame is asked for next while a film plays: the first that can be here in time.
//
//   requests --arrivals--> pace: seconds of a frame --nextPlace--> the next request
//
// INVARIANT: places are frames since the start, and each is at least one after that before it.
const WEIGHT = 0.1; // how much the newest value counts in a mean
// frames are asked for a little closer than they arrive, or a film could be held at a rate that is
// below what can be drawn
const SLACK = 0.95;

/** Means in seconds: latency, between the request of a frame and its arrival; interval, between
 * two arrivals while pictures are awaited. last: the newest arrival. */
export const newPace = () => ({ latency: 0.05, interval: 0.02, last: 0 });

const mean = (old, value) => old + WEIGHT * (value - old);

/** Notes the arrival of a frame, with all its pictures; times in seconds. A time without requests
 * is no interval. */
export function noteArrival(pace, began, now) {
  pace.latency = mean(pace.latency, now - began);
  if (pace.last > began) pace.interval = mean(pace.interval, now - pace.last);
  pace.last = now;
}

/** The next place after `place`. elapsed: frames since the start, now; rate: frames a second.
 * isAsked: `place` had to be asked for, so that the next one can arrive an interval later. */
export function nextPlace(pace, place, elapsed, rate, isAsked) {
  const step = isAsked ? Math.max(1, pace.interval * rate * SLACK) : 1;
  return Math.max(place + step, elapsed + pace.latency * rate);
}
