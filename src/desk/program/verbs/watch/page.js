// The page of celspan watch: begins it. Each module has one subject, and state.js has the state.
//
//   /state.json --news.js--> state, film, errors      keys, wheel, buttons --hands.js--> view
//                                    \                  /
//                  pictures.js: what is wanted: frame, size, crop --> /frame/N.runs --> #canvas
//                  timeline.js, rows.js, objects.js, values.js: the rest of the page
import { swapCosting } from "/costing.js";
import { makeFields, setGround, setTheme } from "/guides.js";
import { hearHands } from "/hands.js";
import { showPoint } from "/inspector.js";
import { listen } from "/news.js";
import { leavePoint, loadObjects, showObjects } from "/objects.js";
import { onPanel } from "/panels.js";
import { look } from "/pictures.js";
import { setSpot } from "/points.js";
import { beginRender } from "/render.js";
import { beside, desk, here, main } from "/state.js";
import { measureTimeline } from "/timeline.js";
import { readAddress } from "/values.js";
import { measureDesk } from "/view.js";

// The token is removed from the address: fetch.js keeps it.
history.replaceState(null, "", location.hash.length > 1 ? `/${location.hash}` : "/");
readAddress();
setGround("checker");
makeFields();
onPanel("costs", swapCosting);
onPanel("objects", isOn => { if (isOn) { showObjects(); loadObjects(); } else leavePoint(); });
onPanel("inspector", isOn => {
  for (const one of [main, beside]) one.box.classList.toggle("inspecting", isOn);
  if (isOn) return [main, beside].forEach(showPoint);
  leavePoint();
  setSpot(null);
});
beginRender();
hearHands();
new ResizeObserver(() => { measureDesk(); look(); }).observe(desk);
new ResizeObserver(measureTimeline).observe(here("lanes"));
setTheme(matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
listen();

