// What cels and frames cost, in the panel.
import { cellsOf, slowest } from "/cost.js";
import { read } from "/fetch.js";
import { look } from "/pictures.js";
import { jump } from "/playing.js";
import { drawSheet, showSheet } from "/rows.js";
import { element, here, main, play } from "/state.js";

/** Fills the table with what a painted picture costs, if it is open. */
export async function loadCosts(picture) {
  if (here("costs").hidden || play.direction !== 0) return;
  const address = picture.plain.replace(/^\/frame\/(-?\d+)\.runs\?/, "/costs.json?frame=$1&");
  const list = await read(address, () => main.painted === picture);
  if (!list || main.painted !== picture) return;
  here("cost-rows").replaceChildren(...list.map((one, i) => {
    const cells = cellsOf(one, i === 0).map((textContent, column) => column
      ? element("td", { textContent }) : element("th", { textContent, scope: "row" }));
    return element("tr", { title: one.file ? `${one.file}:${one.line}` : "" }, ...cells);
  }));
  showSlowest();
}

function showSlowest() {
  here("slowest").replaceChildren(...slowest().map(({ number, seconds }) => {
    const way = { textContent: `frame ${number}`, onclick: () => jump(number) };
    return element("li", {}, element("button", way), ` ${(seconds * 1000).toFixed(1)} ms`);
  }));
  drawSheet();
}

/** What changes when the panel is opened or closed. */
export function swapCosting() {
  showSheet();
  look();
}

