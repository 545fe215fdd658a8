// A server of the files in a folder, for the steps of browser.js:
//
//   const site = await require("./site.js")(folder);
//   site.pages["x.html"] = TEXT      a file that is not in the folder
//   site.policy = TEXT               the policy of all answers, or null
//   site.delay = 500                 milliseconds until planes are sent
//   page.load(site.at("x.html"), /^http:/); ... site.close();
const fs = require("fs");
const http = require("http");
const { gzipSync } = require("zlib");

const KINDS = { html: "text/html", css: "text/css", js: "text/javascript", mjs: "text/javascript",
                png: "image/png" };

module.exports = async folder => {
  const site = { pages: {}, policy: null, delay: 0 };
  const server = http.createServer((request, answer) => {
    const name = request.url.slice(1).replace(/[?].*/, ""), ending = name.split(".").at(-1);
    const body = site.pages[name]
      ?? (fs.existsSync(`${folder}/${name}`) && fs.readFileSync(`${folder}/${name}`));
    if (body === false) return answer.writeHead(404).end();
    answer.setHeader("content-type", KINDS[ending] ?? "application/octet-stream");
    answer.setHeader("content-encoding", "gzip");
    if (site.policy) answer.setHeader("content-security-policy", site.policy);
    setTimeout(() => answer.end(gzipSync(body, { level: 9 })), ending === "plane" ? site.delay : 0);
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  site.at = name => `http://127.0.0.1:${server.address().port}/${name}`;
  site.close = () => { server.close(); server.closeAllConnections(); };
  return site;
};
