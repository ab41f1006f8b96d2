// Run by Node: open glTF files with three.js in a headless Chromium and print, a line each, what its scene holds.
//
//   node three_side.cjs FOLDER CHROMIUM FILE[=PICTURE.png]...
//
// FOLDER holds node_modules with `three` and `puppeteer-core` (`three_page.cjs`).

const { eachFile } = require("./three_page.cjs");
const [folder, chromium, ...wanted] = process.argv.slice(2);

const MODULE = `
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
`;

async function look(page, seen, file, picture) {
  if (picture) await page.screenshot({ path: picture });
}

eachFile({ folder, chromium, wanted, module: MODULE, side: 640, look });
