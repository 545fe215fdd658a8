// A server of the files in a folder, for the steps of browser.js:
//
//   const site = await require("./site.js")(folder);
//   site.pages["x.html"] = TEXT      a file that is not in the folder
//   site.policy = TEXT               the policy of all answers, or null
//   site.delay = 500                 milliseconds until planes are sent
//   site.parts = true                planes are sent in parts, if these are asked for
//   site.first = 100                bytes that are sent of a part that begins the file, at most
//   site.lost = true                 parts are not sent
//   site.asked                       a line for each request: the name of the file, and the part
//   page.load(site.at("x.html"), /^http:/); ... site.close();
const fs = require("fs");
const http = require("http");
const { gzipSync } = require("zlib");

const KINDS = { html: "text/html", css: "text/css", js: "text/javascript", mjs: "text/javascript",
                png: "image/png" };

module.exports = async folder => {
  const site = { pages: {}, policy: null, delay: 0, parts: false, first: Infinity, lost: false, asked: [] };
  const server = http.createServer((request, answer) => {
    const name = request.url.slice(1).replace(/[?].*/, ""), ending = name.split(".").at(-1);
    const body = site.pages[name]
      ?? (fs.existsSync(`${folder}/${name}`) && fs.readFileSync(`${folder}/${name}`));
    if (name !== "favicon.ico") site.asked.push(`${name} ${request.headers.range ?? ""}`.trim());
    if (body === false) return answer.writeHead(404).end();
    answer.setHeader("content-type", KINDS[ending] ?? "application/octet-stream");
    if (site.policy) answer.setHeader("content-security-policy", site.policy);
    const part = site.parts && /^bytes=([0-9]+)-([0-9]+)$/.exec(request.headers.range ?? "");
    if (part && site.lost) return answer.writeHead(503).end();
    if (part) {
      if (Number(part[1]) >= body.length) return answer.writeHead(416).end();
      const start = Number(part[1]), most = start ? Infinity : site.first;
      const end = Math.min(Number(part[2]) + 1, body.length, most);
      answer.setHeader("content-range", `bytes ${start}-${end - 1}/${body.length}`);
      return setTimeout(() => answer.writeHead(206).end(body.subarray(start, end)), site.delay);
    }
    const packs = !/identity/.test(request.headers["accept-encoding"]); // as parts are asked for
    if (packs) answer.setHeader("content-encoding", "gzip");
    setTimeout(() => answer.end(packs ? gzipSync(body, { level: 9 }) : body), ending === "plane" ? site.delay : 0);
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  site.at = name => `http://127.0.0.1:${server.address().port}/${name}`;
  site.close = () => { server.close(); server.closeAllConnections(); };
  return site;
};
