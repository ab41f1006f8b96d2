// Run by Node: open glTF files with three.js in a headless Chromium and print, a line each, what its scene holds.
//
//   node three_side.cjs FOLDER CHROMIUM FILE[=PICTURE.png]...
//
// FOLDER holds node_modules with `three` and `puppeteer-core`. A small server of its own serves the page, three.js and the files.

const fs = require("fs"), http = require("http"), path = require("path");
const [folder, chromium, ...wanted] = process.argv.slice(2);
const puppeteer = require(require.resolve("puppeteer-core", { paths: [folder] }));
const KINDS = { ".js": "text/javascript", ".html": "text/html", ".json": "application/json", ".gltf": "model/gltf+json", ".jpg": "image/jpeg", ".png": "image/png" };

const PAGE = `<!doctype html><html><body style="margin:0;background:#cfd8dc"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

function eachPlace(thing, visit) {  // three.js itself takes the box of each instance's box
  const corners = thing.geometry.attributes.position, place = new THREE.Matrix4(), point = new THREE.Vector3();
  for (let i = 0; i < thing.count; i++) {
    thing.getMatrixAt(i, place);
    place.premultiply(thing.matrixWorld);
    for (let k = 0; k < corners.count; k++) visit(point.fromBufferAttribute(corners, k).applyMatrix4(place));
  }
}

function measured(root) {
  let triangles = 0, bones = 0, draws = 0;
  const materials = new Set(), box = new THREE.Box3();
  root.updateMatrixWorld(true);
  root.traverse((thing) => {
    if (thing.isBone) bones += 1;
    if (!thing.isMesh) return;
    const shape = thing.geometry, corners = shape.index ? shape.index.count : shape.attributes.position.count;
    triangles += corners / 3 * (thing.isInstancedMesh ? thing.count : 1);
    draws += 1;
    materials.add(thing.material.name);
    if (thing.isInstancedMesh) eachPlace(thing, (point) => box.expandByPoint(point));
    else box.expandByObject(thing, true);
  });
  return { triangles, bones, draws, materials: [...materials].sort(), bounds: [box.min.toArray(), box.max.toArray()] };
}

window.open3d = async (file) => {
  const gltf = await new GLTFLoader().loadAsync(file);
  const seen = measured(gltf.scene);
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(640, 640);
  document.body.replaceChildren(renderer.domElement);
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
  scene.background = new THREE.Color(0xcfd8dc);
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(1, 2, 2);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8d80, 1.5), sun, gltf.scene);
  const low = new THREE.Vector3(...seen.bounds[0]), high = new THREE.Vector3(...seen.bounds[1]);
  const middle = low.clone().add(high).multiplyScalar(0.5), size = Math.max(high.distanceTo(low), 1e-3);
  camera.position.copy(middle).add(new THREE.Vector3(0.35, 0.15, 1).normalize().multiplyScalar(size * 1.25));
  camera.lookAt(middle);
  renderer.render(scene, camera);
  return { ...seen, drawn: renderer.info.render.triangles, program: "three.js r" + THREE.REVISION };
};
window.ready = true;
</script></body></html>`;

function served(request, response) {
  const name = decodeURIComponent(request.url.split("?")[0]);
  if (name === "/") return response.writeHead(200, { "Content-Type": "text/html" }).end(PAGE);
  const place = name.startsWith("/three/") ? path.join(folder, "node_modules", name) : name.startsWith("/file/") ? name.slice(5) : "";
  if (!place || !fs.existsSync(place)) return response.writeHead(404).end();
  response.writeHead(200, { "Content-Type": KINDS[path.extname(place)] || "application/octet-stream" }).end(fs.readFileSync(place));
}

(async () => {
  const server = http.createServer(served);
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const browser = await puppeteer.launch({ executablePath: chromium, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"], protocolTimeout: 300000 });
  const page = await browser.newPage();
  await page.setViewport({ width: 640, height: 640 });
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
      if (picture) await page.screenshot({ path: picture });
    } catch (error) { seen = { error: String(error) }; }
    console.log("SEEN " + JSON.stringify({ file, ...seen, said: said.filter((line) => !/GPU stall|favicon|status of 404|swiftshader/i.test(line)) }));
  }
  await browser.close();
  server.close();
})();
