// A page with three.js in a headless Chromium, for scripts that Node runs: `three_side.cjs`, `three_moves_side.cjs`.
//
// `module` is the page's script; it may import three and its addons, and sets `window.ready` at its end. FOLDER holds node_modules with `three` and
// `puppeteer-core`. A small server of its own serves the page, three.js and the files.

const fs = require("fs"), http = require("http"), path = require("path");

const KINDS = { ".js": "text/javascript", ".html": "text/html", ".json": "application/json", ".gltf": "model/gltf+json", ".jpg": "image/jpeg", ".png": "image/png" };
const HEAD = `<!doctype html><html><body style="margin:0;background:#cfd8dc"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
`;

function serving(folder, module) {
  return http.createServer((request, response) => {
    const name = decodeURIComponent(request.url.split("?")[0]);
    if (name === "/") return response.writeHead(200, { "Content-Type": "text/html" }).end(`${HEAD}${module}\nwindow.ready = true;\n</script></body></html>`);
    const place = name.startsWith("/three/") ? path.join(folder, "node_modules", name) : name.startsWith("/file/") ? name.slice(5) : "";
    if (!place || !fs.existsSync(place)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": KINDS[path.extname(place)] || "application/octet-stream" }).end(fs.readFileSync(place));
  });
}

/** Open each FILE[=PICTURE] by `window.open3d` in a page of so many pixels, and print what `look(page, seen, file, picture)` adds to what that gave, a line each. */
async function eachFile({ folder, chromium, wanted, module, side, look }) {
  const puppeteer = require(require.resolve("puppeteer-core", { paths: [folder] }));
  const server = serving(folder, module);
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const browser = await puppeteer.launch({ executablePath: chromium, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"], protocolTimeout: 600000 });
  const page = await browser.newPage();
  await page.setViewport({ width: side, height: side });
  const said = [];
  page.on("console", (message) => { if (["error", "warn"].includes(message.type())) said.push(message.text()); });
  page.on("pageerror", (error) => said.push(String(error)));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForFunction("window.ready", { timeout: 60000 });
  for (const entry of wanted) {
    const [file, picture] = entry.split("=");
    said.length = 0;
    let seen;
    try {
      seen = await page.evaluate((url) => window.open3d(url), "/file" + path.resolve(file).split("/").map(encodeURIComponent).join("/"));
      await look(page, seen, file, picture);
    } catch (error) { seen = { error: String(error) }; }
    console.log("SEEN " + JSON.stringify({ file, ...seen, said: said.filter((line) => !/GPU stall|favicon|status of 404|swiftshader/i.test(line)) }));
  }
  await browser.close();
  server.close();
}

module.exports = { eachFile };
