// Compares what tests/bench/watch.sh has measured of two programs in turns:
//
//   node tests/bench/watch_ratios.js FOLDER
//
// FOLDER has NAME.ROUND.PART.json, NAME new or old. It prints the medians, and how many times better
// the new one is: the median over the rounds, because the two of a round share what else ran.
const { readFileSync, readdirSync } = require("fs");
const [folder] = process.argv.slice(2);

/** The median; of an even number the mean of the two in the middle. */
function middle(list) {
  const sorted = [...list].sort((a, b) => a - b), half = sorted.length / 2;
  const value = (sorted[Math.ceil(half) - 1] + sorted[Math.floor(half)]) / 2;
  return Math.round(value * 100) / 100;
}

const NOT_COMPARED = new Set(["shot.load", "film.load"]); // what else the machine did

const isRate = item => /[.](frames_a_second|width)$/.test(item); // more is better

/** The numbers of an object by their paths, such as "play.server_cpu_ms". */
const flat = (value, path = []) => Object.entries(value ?? {}).flatMap(([name, one]) =>
  typeof one === "object" ? flat(one, [...path, name]) : [[[...path, name].join("."), one]]);

const measured = new Map(); // item: { new: { round: number }, old: ... }
for (const file of readdirSync(folder).sort()) {
  const [, name, round, part] = /^(new|old)\.(\d+)\.(\w+)\.json$/.exec(file) ?? [];
  const text = name ? readFileSync(`${folder}/${file}`, "utf8") : "";
  for (const [item, value] of text ? flat(JSON.parse(text)) : []) {
    const key = `${part}.${item}`;
    if (!measured.has(key)) measured.set(key, { new: {}, old: {} });
    measured.get(key)[name][round] = value;
  }
}

console.log("item                                     new        old      times better");
for (const [item, { new: fresh, old }] of measured) {
  const better = Object.keys(fresh).filter(round => round in old && !NOT_COMPARED.has(item))
    .map(round => isRate(item) ? fresh[round] / old[round] : old[round] / fresh[round])
    .filter(Number.isFinite);
  const cells = [fresh, old].map(one => middle(Object.values(one)))
    .map(value => (Number.isFinite(value) ? String(value) : "-").padStart(10));
  const times = better.length ? middle(better).toFixed(2) : "-";
  console.log(`${item.padEnd(34)}${cells.join(" ")}${times.padStart(12)}`
    + `  (${better.map(one => one.toFixed(2)).join(", ")})`);
}
