// Run by Node: play animated glTF files with three.js in a headless Chromium and print, a line each, where vertices are at some moments.
//
//   node three_moves_side.cjs FOLDER CHROMIUM SECONDS,SECONDS… FILE[=PICTURES]...
//
// FOLDER holds node_modules with `three` and `puppeteer-core`; PICTURES is a folder for one picture a moment. Of a mesh every n-th vertex is told, 2,000
// at most. `update` is what a frame costs the processor before anything is drawn, milliseconds: mixer, matrices, bones.

const path = require("path");
const { eachFile } = require("./three_page.cjs");
const [folder, chromium, moments, ...wanted] = process.argv.slice(2);

const MODULE = `
let scene, camera, renderer, mixer, meshes, length;

function sampled(mesh) {
  const count = mesh.geometry.attributes.position.count, step = Math.max(1, Math.floor(count / 2000)), point = new THREE.Vector3(), places = [];
  for (let i = 0; i < count; i += step) {
    mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld);
    places.push(point.x, point.y, point.z);
  }
  return { name: mesh.name, step, places };
}

function advance(second) {
  mixer.setTime(Math.min(second, length - 1e-6));  // at its end a loop begins again
  scene.updateMatrixWorld(true);
  for (const skeleton of new Set(meshes.filter((mesh) => mesh.isSkinnedMesh).map((mesh) => mesh.skeleton))) skeleton.update();
}

window.open3d = async (file) => {
  const gltf = await new GLTFLoader().loadAsync(file);
  scene = new THREE.Scene();
  scene.background = new THREE.Color(0xcfd8dc);
  const sun = new THREE.DirectionalLight(0xffffff, 2.5);
  sun.position.set(1, 2, 2);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8d8d80, 1.5), sun, gltf.scene);
  meshes = [];
  let bones = 0;
  gltf.scene.traverse((thing) => { if (thing.isMesh) meshes.push(thing); if (thing.isBone) bones += 1; });
  mixer = new THREE.AnimationMixer(gltf.scene);
  for (const clip of gltf.animations) mixer.clipAction(clip).play();
  length = Math.max(...gltf.animations.map((clip) => clip.duration));
  const box = new THREE.Box3();
  scene.updateMatrixWorld(true);
  for (const mesh of meshes) box.union(new THREE.Box3().setFromBufferAttribute(mesh.geometry.attributes.position));
  for (const mesh of meshes) mesh.frustumCulled = false;
  const size = box.getSize(new THREE.Vector3()).length(), middle = box.getCenter(new THREE.Vector3());
  camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
  camera.position.copy(middle).add(new THREE.Vector3(0, 0.1, 1).normalize().multiplyScalar(size * 1.2));
  camera.lookAt(middle);
  renderer = renderer ?? new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(480, 480);
  document.body.replaceChildren(renderer.domElement);
  return { bones, meshes: meshes.length, length, program: "three.js r" + THREE.REVISION };
};
window.at = (second, drawn) => {
  advance(second);
  if (drawn) renderer.render(scene, camera);
  return meshes.map(sampled);
};
window.cost = () => {
  const times = [];
  for (let k = 0; k < 40; k += 1) {
    const begun = performance.now();
    advance(length * k / 40);
    times.push(performance.now() - begun);
  }
  return times.slice(5).sort((a, b) => a - b)[17];
};
`;

async function look(page, seen, file, pictures) {
  seen.update = await page.evaluate(() => window.cost());
  seen.moments = [];
  for (const [k, second] of moments.split(",").map(Number).entries()) {
    seen.moments.push(await page.evaluate((time, drawn) => window.at(time, drawn), second, Boolean(pictures)));
    if (pictures) await page.screenshot({ path: path.join(pictures, `${path.basename(file, path.extname(file))}_${k}.png`) });
  }
}

eachFile({ folder, chromium, wanted, module: MODULE, side: 480, look });
