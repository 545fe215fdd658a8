// Which frame is asked for next while a film plays: the first that can be here in time; and in
// which size, so that each is.
//
//   requests --arrivals--> pace: seconds of a frame --nextPlace--> the next request
//                                                   \--chooseSize--> its size
//
// INVARIANT: places are frames since the start, and each is at least one after that before it.
const WEIGHT = 0.1; // how much the newest value counts in a mean
// frames are asked for a little closer than they arrive, or a film could be held at a rate that is
// below what can be drawn
const SLACK = 0.95;

/** How many pixels of a sharp frame are one, in each direction; and its name. */
export const SIZES = new Map([[1, ""], [1.5, "2/3 size"], [2, "1/2 size"], [3, "1/3 size"]]);
const SMALLEST = 3;
// A size is judged after JUDGED frames, or after JUDGED_SLOW if they have taken SECONDS.
const JUDGED = 12, JUDGED_SLOW = 3, SECONDS = 0.5;
// Shares of the time that a frame may take: above OVERDUE smaller ones are made, and a size is
// chosen that is expected to stay below EASY. Between the two nothing changes.
const OVERDUE = 1.1, EASY = 0.8;
const HELPS = 0.8;     // a size that takes more of the time of a larger one is no help
// judgements until sizes that were no help are tried again, twice as many each time: the computer
// may have been busy
const RETRIED = 6;
const DRAWN_MOST = 60; // frames that a screen shows in a second

/** Begins to judge a size. coarse: the size; smallest: of those that help. busy: the seconds for
 * which `count` of its frames were awaited. before: the size before it, with seconds of a frame if
 * this one should need less. */
export const judge = (pace, coarse = pace.coarse, smallest = SMALLEST) => Object.assign(pace,
  { coarse, smallest, busy: 0, count: 0, before: { coarse, seconds: Infinity } });

/** Means in seconds: latency, between the request of a frame and its arrival; interval, between
 * two arrivals while pictures are awaited. last: the newest arrival. left: judgements until sizes
 * that were no help are tried again; rest: how many there will be the next time. */
export const newPace = () =>
  judge({ latency: 0.05, interval: 0.02, last: 0, left: 0, rest: RETRIED }, 1);

const mean = (old, value) => old + WEIGHT * (value - old);

/** Notes the arrival of a frame of a size, with all its pictures; times in seconds. A time without
 * requests is no part of an interval; a frame that was the only one may show that it is shorter. */
export function noteArrival(pace, began, now, coarse) {
  const busy = now - Math.max(began, pace.last);
  pace.latency = mean(pace.latency, now - began);
  if (pace.last > began || busy < pace.interval) pace.interval = mean(pace.interval, busy);
  pace.last = now;
  if (coarse !== pace.coarse) return;
  pace.busy += busy;
  pace.count++;
}

/** Chooses the size of the next frames: the largest that can be here in time. */
export function chooseSize(pace, rate) {
  if (pace.count < (pace.busy > SECONDS ? JUDGED_SLOW : JUDGED)) return;
  const { coarse: old, before } = pace, seconds = pace.busy / pace.count;
  const share = seconds * Math.min(rate, DRAWN_MOST), isLate = share > OVERDUE;
  const isVain = isLate && seconds > HELPS * before.seconds;
  if (isVain) pace.left = (pace.rest *= 2) / 2;
  const smallest = isVain ? before.coarse : isLate && --pace.left > 0 ? pace.smallest : SMALLEST;
  const fitting = [...SIZES.keys()]
    .find(one => one >= smallest || share * (old / one) ** 2 < EASY);
  judge(pace, isLate ? fitting : Math.min(fitting, old), smallest);
  if (pace.coarse === old) return;
  if (pace.coarse > old) pace.before = { coarse: old, seconds };
  pace.interval = seconds * (old / pace.coarse) ** 2;
}

/** The next place after `place`. elapsed: frames since the start, now; rate: frames a second.
 * isAsked: `place` had to be asked for, so that the next one can arrive an interval later. */
export function nextPlace(pace, place, elapsed, rate, isAsked) {
  const step = isAsked ? Math.max(1, pace.interval * rate * SLACK) : 1;
  return Math.max(place + step, elapsed + pace.latency * rate);
}
