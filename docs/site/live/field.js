// A script that is edited in its place: a plain textarea above a coloured copy of its text.
//
//   const one = field(pre, { source, label, changed: (text) => ..., chosen: (line) => ... });
//   one.text; one.line; one.replace(from, to, text); one.mark(3, "a message"); one.light(4);
//
// Numbers are dragged, or changed by alt and an arrow key, in steps of their last digit; a click on
// a colour opens the browser's field for it. chosen: a line was clicked.
const TOKEN = new RegExp([/(?<c>--\[(=*)\[[^]*?\]\2\]|--[^\n]*)/,
  /(?<s>\[(=*)\[[^]*?\]\4\]|(["'])(?:\\[^]|(?!\5)[^\\\n])*\5?)/,
  /(?<n>0x[\da-f]+|\d+\.?\d*(?:e[+-]?\d+)?|\.\d+)/,
  RegExp(`(?<k>(?:${"and|break|do|else|elseif|end|false|for|function|goto|if|in|local|nil|not|or|"
    + "repeat|return|then|true|until|while"})(?!\\w))`),
  /(?<f>require(?!\w)|[a-z_]\w*(?=\s*\())/, /[a-z_]\w*/,
].map(({ source }) => source).join("|"), "gi");
const PIXELS = 4; // of a step while a number is dragged
const MOST_COLOURED = 1e5; // characters

/** An element with properties and children. */
export const element = (name, properties = {}, ...children) => {
  const one = Object.assign(document.createElement(name), properties);
  one.append(...children);
  return one;
};

const pen = document.createElement("canvas").getContext("2d");

/** The colour that a string with its quotes is, as "#rrggbb", or null. */
const colourOf = (token) => {
  pen.fillStyle = "#010203";
  pen.fillStyle = token.slice(1, -1).replace(/^(#.{6})..$/, "$1");
  return /^.(#|[a-z]{3,}.$)/.test(token) && pen.fillStyle !== "#010203" ? pen.fillStyle : null;
};

/** The tokens of a text that have a class: { from, text, kind }. */
const tokensOf = (text) => [...text.matchAll(TOKEN)].flatMap(({ 0: token, index, groups }) => {
  const kind = [..."csnkf"].find((one) => groups[one]);
  return kind ? { from: index, text: token, kind } : [];
});

/** A text as the pages have it, with its tokens in spans. */
const coloured = (text) => {
  let end = 0;
  const parts = tokensOf(text).flatMap(({ from, text: token, kind }) => {
    const span = element("span", { className: kind, textContent: token });
    const colour = kind === "s" && colourOf(token), before = text.slice(end, from);
    if (colour) span.classList.add("colour");
    if (colour) span.style.textDecorationColor = colour;
    end = from + token.length;
    return [before, span];
  });
  return [...parts, `${text.slice(end)}\n`];
};

/** The number that is at a place of a text, or ends there, with its sign: { from, text }. */
const numberAt = (text, place) => {
  const one = tokensOf(text).find(({ from, text: token, text: { length }, kind }) =>
    kind === "n" && !/[xe]/i.test(token) && from <= place && place <= from + length);
  const isNegative = one && /(^|[^\w)\]}\s"'])\s*-$/.test(text.slice(0, one.from));
  return isNegative ? { from: one.from - 1, text: `-${one.text}` } : one;
};

/** A number some steps of its last digit away. */
const stepped = (token, steps) => {
  const digits = token.match(/\.(\d*)/)?.[1].length ?? 0;
  return (Number(token) + steps / 10 ** digits).toFixed(digits).replace(/^-(?=[0.]*$)/, "");
};

export const field = (pre, { source, label, changed = () => {}, chosen = () => {} }) => {
  const code = pre.querySelector("code"), marks = element("div", { className: "marks" });
  const area = element("textarea", { value: source, ariaLabel: label, spellcheck: false, rows: 1 });
  const picker = element("input", { type: "color", tabIndex: -1, ariaLabel: "Colour" });
  const hear = (name, act) => area.addEventListener(name, act, { passive: false });
  let drag = null; // { number, length, span, x, y, isOn }

  const show = () => {
    const { value } = area;
    code.replaceChildren(...value.length > MOST_COLOURED ? [`${value}\n`] : coloured(value));
    for (const mark of [...marks.children]) if (mark !== picker) mark.remove(); // it may be open
  };
  const replace = (from, to, text) => {
    area.setRangeText(text, from, to, "end");
    show();
    changed(area.value);
  };
  /** The token of a class at a place of the window: { span, from }. */
  const tokenAt = ({ clientX, clientY }, kind) => {
    const span = document.elementsFromPoint(clientX, clientY)
      .find((one) => one.parentNode === code && one.classList.contains(kind));
    const before = document.createRange();
    before.setStart(code, 0);
    if (span) before.setEndBefore(span);
    return span && { span, from: before.toString().length };
  };
  /** Writes a number some steps away; length: of what it is now. */
  const step = ({ from, text: number }, length, steps) => {
    const isComment = area.value[from - 1] === "-"; // if another minus follows
    const text = stepped(number, steps).replace(/^-/, isComment ? " -" : "-");
    if (text !== area.value.slice(from, from + length)) replace(from, from + length, text);
    return text.length;
  };
  const pickColour = ({ span, from }) => {
    const [, quote, alpha = ""] = span.textContent.match(/^(.)(?:#.{6}(..).$)?/);
    let { length } = span.textContent;
    Object.assign(picker.style, { left: `${span.offsetLeft}px`, top: `${span.offsetTop + 20}px` });
    picker.value = colourOf(span.textContent);
    picker.oninput = () => {
      const text = quote + picker.value + alpha + quote;
      replace(from, from + length, text);
      ({ length } = text);
    };
    picker.showPicker();
  };

  hear("pointerdown", (event) => {
    const token = event.button === 0 && tokenAt(event, "n");
    const number = token && numberAt(area.value, token.from);
    drag = number && { ...token, number, length: number.text.length, x: event.clientX, y: event.clientY };
  });
  hear("mousedown", (event) => { if (drag) event.preventDefault(); }); // selects nothing
  hear("pointermove", (event) => {
    pre.classList.toggle("over-number", Boolean(drag?.isOn || tokenAt(event, "n")));
    const steps = drag && Math.trunc((event.clientX - drag.x) / PIXELS);
    if (!steps && !drag?.isOn) return;
    drag.isOn = true;
    area.setPointerCapture(event.pointerId);
    drag.length = step(drag.number, drag.length, steps * (event.shiftKey ? 10 : 1));
  });
  hear("touchmove", (event) => { // a finger that goes aside does not move the page
    const [{ clientX, clientY }] = event.touches;
    if (drag && Math.abs(clientX - drag.x) > Math.abs(clientY - drag.y)) event.preventDefault();
  });
  hear("pointercancel", () => { drag = null; });
  hear("click", (event) => {
    const was = drag, colour = tokenAt(event, "colour");
    drag = null;
    if (was?.isOn) return;
    if (was) { // the caret, which was not set before
      const { left, width } = was.span.getBoundingClientRect(), { length } = was.span.textContent;
      one.focus(was.from + Math.round((event.clientX - left) / width * length));
    }
    if (colour) pickColour(colour);
    if (area.selectionStart === area.selectionEnd) chosen(one.line);
  });
  hear("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const number = event.altKey && way && numberAt(area.value, area.selectionStart);
    if (!number) return;
    event.preventDefault();
    step(number, number.text.length, way * (event.shiftKey ? 10 : 1));
  });
  hear("input", () => { show(); changed(area.value); });

  /** Replaces the mark of a class: at a line, or at none. */
  const put = (className, line, properties) => {
    marks.querySelector(`.${className}`)?.remove();
    if (!line) return;
    const mark = element("div", { className, ...properties });
    mark.style.setProperty("--line", line);
    marks.append(mark);
  };
  const one = {
    replace,
    get text() { return area.value; },
    set text(text) { replace(0, area.value.length, text); },
    /** The line of the caret, from 1. */
    get line() { return area.value.slice(0, area.selectionStart).split("\n").length; },
    /** Shows a message under a line; 0: none. */
    mark: (line, message) => put("fault", line, { textContent: message, role: "alert" }),
    /** Lights a line; 0: none. */
    light: (line) => put("lit", line),
    focus: (place) => {
      area.focus({ preventScroll: true });
      area.setSelectionRange(place, place);
    },
  };
  pre.classList.add("field");
  pre.removeAttribute("tabindex");
  code.ariaHidden = true;
  marks.append(picker);
  pre.append(marks, area);
  show();
  return one;
};
