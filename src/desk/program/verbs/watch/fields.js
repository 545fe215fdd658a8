// The fields of the form of values: one for each kind of parameter.
import { read } from "/fetch.js";
import { element, stateOf, write } from "/state.js";
import { coloursOf } from "/timeline.js";
import { giveBack, giveValue } from "/values.js";

const WAYS = ["in", "out", "inOut", "outIn"];
const EASES = ["linear", "hold", "spring", ...["Quad", "Cubic", "Quart", "Quint", "Sine", "Expo",
  "Circ", "Back", "Elastic", "Bounce"].flatMap(name => WAYS.map(way => way + name))];

/** Puts the files that a parameter may name into its list. The film's folder may have new ones. */
async function listFiles(choice, one, parameter) {
  const query = new URLSearchParams({ parameter: parameter.name, side: one.side });
  const names = [...new Set([choice.value, ...await read(`/files.json?${query}`) ?? []])].sort();
  const old = [...choice.options].map(option => option.value);
  if (old.join("\n") === names.join("\n")) return;
  fill(choice, names, choice.value);
}

function fill(choice, texts, value) {
  choice.replaceChildren(...texts.map(textContent => element("option", { textContent })));
  choice.value = value;
  return choice;
}

const choiceOf = (texts, value) => fill(element("select"), texts, value);

/** What a parameter is changed with. */
function control(one) {
  if (one.enum) return choiceOf(one.enum, one.value);
  if (one.format === "ease") return choiceOf([...new Set([one.value, ...EASES])], one.value);
  if (one.format === "path") return choiceOf([one.value], one.value);
  if (one.type === "boolean") {
    return element("input", { type: "checkbox", checked: one.value === "true" });
  }
  if (one.type === "number" && one.minimum !== undefined && one.maximum !== undefined) {
    const { minimum: min, maximum: max } = one;
    return element("input", { type: "range", min, max, step: "any", value: one.value });
  }
  const isColour = one.format === "color" && /^#[0-9a-f]{6}$/i.test(one.value);
  return element("input", { type: isColour ? "color" : "text", value: one.value });
}

const valueOf = input => input.type === "checkbox" ? String(input.checked)
  : input.type === "range" ? String(Number(Number(input.value).toPrecision(4))) : input.value;

/** The number of a slider, to be typed. */
function typedNumber(input, give) {
  const typed = element("input", { type: "text", value: input.value, inputMode: "decimal",
                                   ariaLabel: `${input.name}, typed` });
  typed.addEventListener("change", () => {
    input.value = typed.value;
    typed.value = valueOf(input);
    give();
  });
  input.addEventListener("input", () => { typed.value = valueOf(input); });
  return typed;
}

/** The curve of an ease, from the lower left to the upper right. */
function curveOf(select) {
  const canvas = element("canvas", { className: "curve", width: 302, height: 96, role: "img" });
  const draw = async () => {
    const name = select.value;
    const values = await read(`/curve.json?name=${encodeURIComponent(name)}`);
    if (!values || name !== select.value) return;
    drawCurve(canvas, values);
    canvas.ariaLabel = `The curve ${name}`;
  };
  select.addEventListener("input", draw);
  canvas.redraw = draw;
  draw();
  return canvas;
}

function drawCurve(canvas, values) {
  const brush = canvas.getContext("2d"), { width: w, height: h } = canvas, colours = coloursOf();
  const least = Math.min(0, ...values), most = Math.max(1, ...values);
  const yOf = value => h - 6 - (value - least) / (most - least) * (h - 12);
  brush.clearRect(0, 0, w, h);
  brush.strokeStyle = colours.line;
  for (const level of [0, 1]) brush.strokeRect(0, yOf(level), w, 0);
  brush.strokeStyle = colours.accent;
  brush.lineWidth = 3;
  brush.beginPath();
  values.forEach((value, i) => brush.lineTo(3 + i / (values.length - 1) * (w - 6), yOf(value)));
  brush.stroke();
}

/** Marks a field: the value that the script has instead, or false; why its text is no value. */
export function markField(input, own, fault) {
  const box = input.closest(".field"), back = box.querySelector(".back");
  const wrong = box.querySelector(".wrong");
  box.classList.toggle("changed", own !== false);
  write(back, "hidden", own === false);
  write(back, "textContent", `back to ${own}`);
  write(wrong, "hidden", !fault);
  write(wrong, "textContent", fault ?? "");
  write(input, "ariaInvalid", String(Boolean(fault)));
}

/** A field of the form: its name, what it is changed with, and what the script says about it. */
export function fieldOf(one, parameter) {
  const { name, format, description } = parameter, box = element("div", { className: "field" });
  const input = control({ ...parameter, value: one.given.get(name) ?? parameter.value });
  // later news may have replaced the list
  const now = () => stateOf(one).parameters.find(known => known.name === name) || parameter;
  const give = () => giveValue(one, now(), valueOf(input));
  const title = element("span", { textContent: name });
  if (format === "point") title.append(element("small", { textContent: "  x, y" }));
  const line = element("label", {}, title, input);
  input.name = name;
  box.classList.add(input.type === "range" ? "range" : input.type === "text" ? "text" : "row");
  box.append(line);
  if (input.type === "range") box.append(typedNumber(input, give));
  if (format === "ease") box.append(curveOf(input));
  if (description) {
    const about = element("small", { id: `about-${one.side}-${name}`, textContent: description });
    input.setAttribute("aria-describedby", about.id);
    box.append(about);
  }
  if (format === "path") {
    const list = () => listFiles(input, one, parameter);
    list();
    for (const event of ["focus", "pointerenter"]) input.addEventListener(event, list);
  }
  input.addEventListener(input.type === "text" ? "change" : "input", give);
  box.append(element("small", { className: "wrong", role: "alert", hidden: true }),
             element("button", { className: "back", type: "button", hidden: true,
                                 title: "The value in the script",
                                 onclick: () => giveBack(one, now()) }));
  return box;
}

