// A whole HTML page: the header, the menu, the page's own contents, its body, and its neighbours.
const { posix } = require("path");

const escape = text => text.replace(/[&<>"]/g,
  sign => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);

/** The way from the address of a page to another address of the site. */
const way = (from, to) => posix.relative(posix.dirname(from), to);

// Rows of spans, as a frame of celspan is: the mark of the site, drawn in the colours of dusk.
const MARK = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 16 16" aria-hidden="true">`
  + `<path fill="#5a3f74" d="M4 1h8v3H4z"/><path fill="#d9825f" d="M1 5h9v3H1z"/>`
  + `<path fill="#ffb347" d="M11 5h4v3h-4zM3 9h11v3H3z"/><path fill="#4a6fb3" d="M5 13h6v3H5z"/></svg>`;

const themes = ["auto", "light", "dark"].map(name => `<label><input type="radio" name="theme"
value="${name}"${name === "auto" ? " checked" : ""}>${name}</label>`).join("\n");

/** The menu: groups of pages, of which that of the page is open. */
function menuOf(page, groups) {
  return groups.map(({ name, pages }) => {
    const items = pages.map(one => `<li><a href="${way(page.address, one.address)}"${
      one === page ? ' aria-current="page"' : ""}>${escape(one.name)}</a></li>`);
    return `<details${pages.includes(page) ? " open" : ""}><summary>${escape(name)}</summary>
<ul>${items.join("\n")}</ul></details>`;
  }).join("\n");
}

/** The headings of a page below its title, or nothing for few. */
function contentsOf({ headings }) {
  const shown = headings.filter(({ level }) => level === 2 || level === 3);
  if (shown.length < 3) return "";
  const items = shown.map(({ level, text, id }) =>
    `<li class="level${level}"><a href="#${id}">${escape(text)}</a></li>`);
  return `<nav class="contents" aria-label="On this page"><details><summary>On this page</summary>
<ul>${items.join("\n")}</ul></details></nav>`;
}

function neighboursOf({ address, before, after }) {
  const link = (page, rel, word) => !page ? ""
    : `<a rel="${rel}" href="${way(address, page.address)}"><small>${word}</small>${
      escape(page.name)}</a>`;
  return before || after ? `<nav class="neighbours" aria-label="Neighbouring pages">${
    link(before, "prev", "Before")}${link(after, "next", "Next")}</nav>` : "";
}

/** The HTML of a page: { address, title, about, headings, body, before, after, kind }. */
function whole(page, groups) {
  const to = name => way(page.address, name);
  const title = page.title === "celspan" ? page.title : `${page.title} - celspan`;
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>${escape(title)}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="description" content="${escape(page.about)}">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:image/svg+xml,${encodeURIComponent(MARK)}">
<link rel="stylesheet" href="${to("site.css")}">
<script src="${to("site.js")}"></script>
</head>
<body class="${page.kind}">
<a class="skip" href="#main">To the text</a>
<header>
<a class="brand" href="${to("index.html")}">${MARK}celspan</a>
<fieldset class="theme"><legend>Colours</legend>
${themes}
</fieldset>
</header>
<nav class="menu" aria-label="All pages"><details><summary>Menu</summary>
${menuOf(page, groups)}
</details></nav>
${contentsOf(page)}
<main id="main">
${page.body}
${neighboursOf(page)}
</main>
</body>
</html>
`;
}

module.exports = { escape, way, whole };
