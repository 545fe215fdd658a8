// Makes the site of the documentation: each page of menu.json as HTML, and each file of the tree
// to which they link as a page with its text. Nothing in it comes from another server, and no
// page needs a script. From the top of the tree:
//
//   node docs/site/make.js FOLDER [WEB]
//
// WEB: what ./run web made; with it, complete scripts run in their places (live/).
//
// A complete script is a figure, <figure class="script" data-script="NAME">, with its name, its
// code and, in <div class="stage">, its picture: the one of that name in the same section.
const assert = require("assert");
const { execFileSync } = require("child_process");
const fs = require("fs");
const path = require("path");
const { posix } = path;
module.paths.push("/usr/share/nodejs"); // where Debian's packages are
const markdown = require("markdown-it");
const { escape, way, whole } = require("./layout.js");

const LANGUAGES = { lua: "lua", sh: "bash", c: "c", h: "c", json: "json", python: "python",
  py: "python", html: "html", js: "javascript", meson: "meson" };
const AS_IS = ["llms.txt", "docs/pictures/little-one.mp4"]; // what links lead to is no page

// In place of a moving picture, for those who want no motion: more than its first frame says.
const STILLS = { "docs/pictures/moving.webp": "docs/pictures/little-one.webp" };
const PLAYER = "celspan-film.js"; // in out/docs

const [folder, web] = process.argv.slice(2);
const hasEngine = web && fs.existsSync(`${web}/celspan.wasm`);
const pages = new Map(); // the page of each file of the tree that is one
const files = new Set(); // of the site, that are copied as they are
const stills = new Map(); // the moving picture of each still one
const films = new Set(); // of out/docs, that are copied too
const examples = []; // scripts of the cookbook for the playground
const md = markdown();

function write(name, text) {
  const file = path.join(folder, name);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
}

// ---- code

const codes = []; // [language, code] of all pages, because one program colours them all

/** Code, in which `\0NUMBER\0` stands for what colour() puts there. */
function block(code, ending) {
  const language = LANGUAGES[ending];
  const text = language ? `\0${codes.push([language, code]) - 1}\0` : escape(code);
  return `<pre tabindex="0"><code>${text}</code></pre>\n`;
}

/** A function that puts coloured code into the text of a page. */
function colour() {
  const shown = JSON.parse(execFileSync("python3", [path.join(__dirname, "highlight.py")],
    { input: JSON.stringify(codes), maxBuffer: 1 << 28 }));
  return text => text.replace(/\0(\d+)\0/g, (all, number) => shown[number]);
}

// ---- links and pictures

/** The page that shows a file or the names in a folder: it is made when a link leads to it. */
function sourcePage(file) {
  if (!pages.has(file)) {
    pages.set(file, { file, address: `source/${file}.html`, title: file, name: file,
      about: `${file} of celspan`, headings: [], kind: "source" });
  }
  return pages.get(file);
}

/** The address, seen from a page, of what a link in its Markdown means. */
function resolved(page, target) {
  if (/^(https?:|#)/.test(target)) return target;
  const [name, anchor] = target.split("#");
  const file = posix.join(posix.dirname(page.file), name).replace(/[/]$/, "");
  if (!fs.existsSync(file)) throw new Error(`${page.file}: there is no ${file}`);
  if (AS_IS.includes(file)) {
    files.add(file);
    return way(page.address, file);
  }
  const { address } = pages.get(file) ?? sourcePage(file);
  return way(page.address, address) + (anchor ? `#${anchor}` : "");
}

/** { width, height } of a picture, from the first chunk of its file. */
function sizeOf(file) {
  const bytes = fs.readFileSync(file), kind = bytes.toString("latin1", 12, 16);
  if (kind === "IHDR") return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20) };
  if (kind === "VP8X") {
    return { width: bytes.readUIntLE(24, 3) + 1, height: bytes.readUIntLE(27, 3) + 1 };
  }
  if (kind === "VP8 ") {
    return { width: bytes.readUInt16LE(26) & 0x3fff, height: bytes.readUInt16LE(28) & 0x3fff };
  }
  throw new Error(`${file}: neither PNG nor WebP`);
}

/** Where a file of docs/ is in the site. */
const placeOf = file => posix.relative("docs", file);

/** The film of a picture's name: beside it, or in out/docs, where `./run docs` makes them; or
 * nothing. */
function filmOf(file, name) {
  const beside = file.replace(/[.]\w+$/, ".mp4");
  if (fs.existsSync(beside)) {
    files.add(beside);
    return beside;
  }
  if (!fs.existsSync(`out/docs/${name}.mp4`)) return undefined;
  films.add(`${name}.mp4`);
  return `${name}.mp4`;
}

/** A picture with its size, which is copied to pictures/. It is what its film shows until it plays;
 * or, in the page of its own name, the plane of that name in out/docs: in others it may be a link. */
function showPicture(page, token, about) {
  const file = posix.join(posix.dirname(page.file), token.attrGet("src"));
  const { width, height } = sizeOf(file);
  files.add(file);
  const address = way(page.address, placeOf(file));
  const name = posix.relative("docs/pictures", file).replace(/[.]\w+$/, "");
  const film = filmOf(file, name);
  if (film) {
    return `<video src="${way(page.address, film)}" poster="${address}" preload="none" `
      + `controls loop playsinline aria-label="${escape(token.content)}" width="${width}" `
      + `height="${height}"></video>`;
  }
  const shown = `<img src="${address}" alt="${escape(about ?? token.content)}" width="${width
  }" height="${height}" loading="lazy" decoding="async">`;
  if (page.file === `docs/${name}.md` && fs.existsSync(`out/docs/${name}.plane`)) {
    films.add(`${name}.plane`).add(PLAYER);
    return `<celspan-film src="${way(page.address, `${name}.plane`)}" autoplay loop controls `
      + `aria-label="${escape(token.content)}">${shown}</celspan-film><script type="module" `
      + `src="${way(page.address, PLAYER)}"></script>`;
  }
  if (!file.endsWith(".webp") || !fs.readFileSync(file).includes("ANMF")) return shown;
  const better = STILLS[file];
  const still = better ? placeOf(better) : `still/${placeOf(file)}`;
  if (better) files.add(better);
  else stills.set(still, file);
  return `<picture><source media="(prefers-reduced-motion: reduce)" srcset="${
    way(page.address, still)}">${shown}</picture>`;
}

/** The first frame of a moving WebP as a file: for those who want no motion. */
function stillOf(file) {
  const bytes = fs.readFileSync(file), at = bytes.indexOf("ANMF");
  const head = Buffer.from(bytes.subarray(0, 30)); // RIFF and VP8X
  const frame = bytes.subarray(at + 24, at + 8 + bytes.readUInt32LE(at + 4));
  // Both sizes, less 1: the frame is as large as the canvas.
  assert(bytes.subarray(at + 14, at + 20).equals(head.subarray(24)), file);
  head[20] &= 0x10; // its only feature is alpha
  head.writeUInt32LE(head.length + frame.length - 8, 4);
  return Buffer.concat([head, frame]);
}

/** Whether a table without a head is of pictures above their captions. */
const isWall = (tokens, i) => tokens[i + 1].type === "tbody_open"
  && tokens[i + 4].content.includes("![");

/** Heads without a word are left out, and cells without one in a head are no headings. */
function dropEmptyHeads(tokens) {
  for (let i = 0; i < tokens.length; i++) {
    const { type } = tokens[i];
    if (type === "th_open" && !tokens[i + 1].content) tokens[i].tag = tokens[i + 2].tag = "td";
    if (type !== "thead_open") continue;
    const end = tokens.findIndex((one, j) => j > i && one.type === "tbody_open");
    if (!tokens.slice(i, end).some(({ content }) => content)) tokens.splice(i, end - i);
  }
}

md.renderer.rules.image = (tokens, i, options, { page }) => showPicture(page, tokens[i]);
md.renderer.rules.link_open = (tokens, i, options, { page }) =>
  `<a${tokens[i].attrGet("class") ? ' class="anchor"' : ""} href="${
    escape(resolved(page, tokens[i].attrGet("href")))}">`;
md.renderer.rules.table_open = (tokens, i) => '<div class="table" tabindex="0"><table'
  + `${isWall(tokens, i) ? ' class="wall"' : ""}>\n`;
md.renderer.rules.table_close = () => "</table></div>\n";
md.renderer.rules.code_block = (tokens, i) => block(tokens[i].content, "text");

// ---- headings

const plain = token => token.children.map(({ type, content, children }) =>
  type === "softbreak" ? " " : children ? "" : content).join("");

/** The anchor of a heading, as forges make it. */
const slug = text => text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").replace(/ /g, "-");

/** Gives headings their anchors, and makes them links to themselves; collects them in the page. One
 * is at most a level below that before it, for those who go from heading to heading. */
function nameHeadings(page, tokens) {
  const seen = {};
  let level = 0;
  page.headings = [];
  tokens.forEach((token, i) => {
    if (token.type !== "heading_open") return;
    const inline = tokens[i + 1], text = plain(inline), base = slug(text);
    const id = seen[base] ? `${base}-${seen[base]}` : base;
    seen[base] = (seen[base] ?? 0) + 1;
    token.attrSet("id", id);
    level = Math.min(Number(token.tag.slice(1)), level + 1);
    token.tag = tokens[i + 2].tag = `h${level}`;
    page.headings.push({ level, text, id });
    if (token.tag === "h1" || inline.children.some(({ type }) => type === "link_open")) return;
    const [open, close] = md.parseInline("[x](y)", {})[0].children.filter(one => one.nesting);
    open.attrs = [["class", "anchor"], ["href", `#${id}`]];
    inline.children = [open, ...inline.children, close];
  });
}

// ---- complete scripts

const isPicture = token => token?.type === "inline" && token.children.length === 1
  && token.children[0].type === "image";

/** The name and the subject in the first line of a script, or nothing if it is not complete. */
function scriptOf({ type, info, content }) {
  if (type !== "fence" || info !== "lua" || !/^return /m.test(content)) return null;
  if (/^-- error:|^-- \w+\.lua: a module/.test(content)) return null;
  const [, name, about] = content.match(/^-- (\w+)\.lua(?:: (.*))?\n/) ?? [];
  return name ? { name, about } : null;
}

/** The place of the picture with the name of a script between the headings around it, or -1. */
function pictureBeside(tokens, at, name) {
  const isSection = ({ type }) => type === "heading_open";
  const after = tokens.findIndex((token, i) => i > at && isSection(token));
  const from = tokens.slice(0, at).findLastIndex(isSection);
  return tokens.findIndex((token, i) => i > from && (after < 0 || i < after) && isPicture(token)
    && posix.parse(token.children[0].attrGet("src")).name === name);
}

// What the engine of web pages, or a page, does not have.
const LACKING = /\/usr\/share\/fonts|stage\.noto|plate\.|celspan\.sound/;
const READ = ["drawings", "paintings", "pencil", "pictures", "stage", "type", "demo/line.tsv",
  "town/window.lua"]; // in scripts/
const read = new Map(); // by scripts: the content of each file

/** Keeps a block that others read, by its own name or that in backquotes above it. */
function keepFile({ type, info, content }, above) {
  if (type !== "fence" || !/^(lua|text)$/.test(info)) return;
  const name = content.match(/^-- (\w+\.lua)[:\n]/)?.[1] ?? above?.match(/`([\w.-]+)`:$/)?.[1];
  if (name) read.set(name, content);
}

/** Writes the folder live/: the engine, what drives it, and the files of scripts. */
function writeLive() {
  const copy = (from, to) => fs.cpSync(from, path.join(folder, to), { recursive: true });
  copy(path.join(__dirname, "live"), "live");
  for (const name of ["celspan.wasm", "celspan-whole.wasm", "more.json", "LICENSES",
    "LICENSES-whole"]) {
    copy(`${web}/${name}`, `live/${name}`);
  }
  copy(`${web}/engine.mjs`, "live/engine.js"); // which servers know as a script
  for (const name of READ) {
    copy(`scripts/${name}`, `live/files/${name.replace("demo/", "")}`);
  }
  for (const [name, content] of read) write(`live/files/${name}`, content);
  const names = fs.readdirSync(path.join(folder, "live/files"), { recursive: true });
  write("live/files.json", JSON.stringify(names.filter(name => path.extname(name)))); // no folders
}

/** Moves pictures to their scripts. */
function joinScripts(tokens) {
  for (const token of [...tokens]) {
    const script = scriptOf(token);
    if (!script) continue;
    const at = tokens.indexOf(token), place = pictureBeside(tokens, at, script.name);
    token.meta = { ...script, isBelow: place > at, picture: tokens[place]?.children[0] };
    if (place >= 0) tokens.splice(place - 1, 3); // with the paragraph around it
  }
}

md.renderer.rules.fence = (tokens, i, options, { page }) => {
  const { content, info, meta } = tokens[i], code = block(content, info);
  if (!meta) return code;
  const { name, about, isBelow, picture } = meta;
  const label = `<figcaption><b>${name}.lua</b>${about ? ` ${escape(about)}` : ""}</figcaption>\n`;
  // Alone, "result" says nothing to those who do not see it.
  const alt = picture?.content === "result" ? about ?? `the picture of ${name}.lua` : undefined;
  const stage = picture ? `<div class="stage">${showPicture(page, picture, alt)}</div>\n` : "";
  const live = hasEngine && !LACKING.test(content) ? " data-live" : "";
  if (live && page.file === "docs/cookbook.md") examples.push({ name, about, source: content });
  return `<figure class="script" data-script="${name}"${live}>${label}${isBelow ? code + stage
    : stage + code}</figure>\n`;
};

/** Pictures without a text get that of their caption, the slanted words of the next paragraph. */
function nameCaptioned(tokens) {
  tokens.forEach((token, i) => {
    if (!isPicture(token) || token.children[0].content) return;
    const words = tokens.slice(i + 1).find(({ type }) => type === "inline").children;
    const end = words.findIndex(({ type }) => type === "em_close");
    token.children[0].content = plain({ children: words.slice(0, end) });
  });
}

// ---- pages

/** Makes the body of a page out of its Markdown. */
function showMarkdown(page) {
  const tokens = md.parse(fs.readFileSync(page.file, "utf8"), {});
  tokens.forEach((token, i) => keepFile(token, tokens[i - 2]?.content));
  nameHeadings(page, tokens);
  joinScripts(tokens);
  nameCaptioned(tokens);
  dropEmptyHeads(tokens);
  page.title = page.headings[0].text;
  page.about = plain(tokens.find(({ type }, i) => type === "inline"
    && tokens[i - 1].type === "paragraph_open")).slice(0, 200);
  page.body = md.renderer.render(tokens, md.options, { page });
}

/** Takes the body of a page that is written in HTML; its script needs the engine. */
function showHtml(page) {
  const [, version] = fs.readFileSync("meson.build", "utf8").match(/^ {2}version: '(.*)',/m);
  page.body = fs.readFileSync(page.file, "utf8").replace("@VERSION@", version);
  if (!hasEngine) page.body = page.body.replace(/<script.*/, "<p>This site was made without the "
    + "engine, <code>./run web</code>: nothing runs on this page.</p>");
  page.headings = [];
  [page.title, page.about] = ["h1", "p"].map(tag =>
    page.body.match(RegExp(`<${tag}>([^]*?)</${tag}>`))[1]);
}

/** Makes the body of the page of a file, or of the names in a folder. */
function showSource(page) {
  const head = `<h1>${escape(page.file)}</h1>\n`;
  if (!fs.statSync(page.file).isDirectory()) {
    page.body = head + block(fs.readFileSync(page.file, "utf8"), posix.extname(page.file).slice(1));
    return;
  }
  const names = fs.readdirSync(page.file).map(name => {
    const target = sourcePage(posix.join(page.file, name));
    return `<li><a href="${way(page.address, target.address)}">${escape(name)}</a></li>`;
  });
  page.body = `${head}<ul>${names.join("\n")}</ul>\n`;
}

/** The groups of the menu; each of their pages knows its neighbours. */
function readMenu() {
  const groups = Object.entries(JSON.parse(fs.readFileSync(path.join(__dirname, "menu.json"))))
    .map(([name, listed]) => ({ name, pages: Object.entries(listed).map(([file, short]) => ({ file,
      address: file === "README.md" ? "index.html" : `${posix.parse(file).name.toLowerCase()}.html`,
      name: short, kind: { "README.md": "home", "docs/site/playground.html": "playground" }[file]
        ?? "page" })) }));
  const all = groups.flatMap(group => group.pages);
  all.forEach((page, i) => {
    pages.set(page.file, Object.assign(page, { before: all[i - 1], after: all[i + 1] }));
  });
  for (const name of fs.readdirSync("docs")) {
    if (name.endsWith(".md") && !pages.has(`docs/${name}`)) {
      throw new Error(`docs/site/menu.json: docs/${name} is missing`);
    }
  }
  return groups;
}

function make() {
  const groups = readMenu();
  for (const page of pages.values()) { // which grows
    if (page.kind === "source") showSource(page);
    else if (page.kind === "playground") showHtml(page);
    else showMarkdown(page);
  }
  const coloured = colour();
  for (const page of pages.values()) write(page.address, coloured(whole(page, groups)));
  for (const file of files) {
    write(AS_IS.includes(file) ? file : placeOf(file), fs.readFileSync(file));
  }
  for (const [still, file] of stills) write(still, stillOf(file));
  for (const film of films) write(film, fs.readFileSync(`out/docs/${film}`));
  for (const name of ["site.css", "site.js"]) {
    write(name, fs.readFileSync(path.join(__dirname, name)));
  }
  if (hasEngine) writeLive();
  for (const name of fs.readdirSync("docs/site/play")) {
    write(`play/${name}`, fs.readFileSync(`docs/site/play/${name}`));
  }
  write("play/examples.json", JSON.stringify(examples));
  console.log(`${pages.size} pages`);
}

make();
