// What cels and frames cost, in the panel.
import * as cost from "/cost.js";
import { fetch } from "/fetch.js";
import { look } from "/pictures.js";
import { go, stop } from "/playing.js";
import { drawSheet, nameRows } from "/rows.js";
import { element, here, main, play } from "/state.js";

/** Fills the table with what a painted picture costs, if it is open. */
export async function loadCosts(picture) {
  if (here("costs").hidden || play.direction !== 0) return;
  const address = picture.address.replace(/^\/frame\/(-?\d+)\.runs\?/, "/costs.json?frame=$1&");
  const answer = await fetch(address).catch(() => null);
  if (!answer || !answer.ok || main.painted !== picture) return;
  const list = await answer.json();
  here("cost-rows").replaceChildren(...list.map((one, i) => {
    const row = element("tr", { title: one.file ? `${one.file}:${one.line}` : "" });
    row.append(...cost.cellsOf(one, i === 0).map((textContent, column) => column
      ? element("td", { textContent }) : element("th", { textContent, scope: "row" })));
    return row;
  }));
  showSlowest();
}

function showSlowest() {
  here("slowest").replaceChildren(...cost.slowest().map(({ number, seconds }) => {
    const item = element("li", {}), textContent = `frame ${number}`;
    item.append(element("button", { textContent, onclick: () => { stop(); go(number); } }),
                ` ${(seconds * 1000).toFixed(1)} ms`);
    return item;
  }));
  drawSheet();
}

/** What changes when the panel is opened or closed. */
export function swapCosting() {
  nameRows();
  drawSheet();
  look();
}

