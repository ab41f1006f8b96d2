// A thin line of the same width on the screen wherever it runs: two triangles a segment, spread in the vertex shader. (WebGL's own lines are one pixel wide.)
// Around it a casing of another colour, as on maps: without it a dark line is lost among dark leaves.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, type Vector2 } from "three";

const QUAD = [0, 1, 2, 1, 3, 2]; // corners of two triangles
const CASING = 1.1; // CSS pixels, each side

/** `points`: x, y, z of both ends of each segment. `wide`: CSS pixels; `size`: of the view, CSS pixels, kept by the caller. */
export function thinLines(points: Float32Array, wide: number, size: { value: Vector2 }): Mesh<BufferGeometry, ShaderMaterial> {
  const count = points.length / 6;
  const [here, there, corner] = [new Float32Array(12 * count), new Float32Array(12 * count), new Float32Array(8 * count)];
  const index = new Uint32Array(6 * count);
  for (let k = 0; k < count; k++) {
    const [from, to] = [points.subarray(6 * k, 6 * k + 3), points.subarray(6 * k + 3, 6 * k + 6)];
    for (let c = 0; c < 4; c++) {
      here.set(c < 2 ? from : to, 12 * k + 3 * c);
      there.set(c < 2 ? to : from, 12 * k + 3 * c);
      corner[8 * k + 2 * c] = c % 2 ? 1 : -1; // which side
      corner[8 * k + 2 * c + 1] = c < 2 ? 1 : -1; // which way it looks along the segment
    }
    for (let c = 0; c < 6; c++) index[6 * k + c] = 4 * k + QUAD[c]!;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(here, 3));
  geometry.setAttribute("there", new BufferAttribute(there, 3));
  geometry.setAttribute("corner", new BufferAttribute(corner, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  return new Mesh(geometry, material(wide, size));
}

function material(wide: number, size: { value: Vector2 }): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true, depthTest: false, depthWrite: false, toneMapped: false, side: DoubleSide,
    uniforms: { uColour: { value: new Color() }, uCasing: { value: new Color() }, uOpacity: { value: 1 }, uWide: { value: wide + 2 * CASING }, uCore: { value: wide / (wide + 2 * CASING) }, uSize: size },
    vertexShader: `attribute vec3 there; attribute vec2 corner; uniform float uWide; uniform vec2 uSize; varying float vSide;
      void main() {
        vSide = corner.x;
        vec4 a = projectionMatrix * modelViewMatrix * vec4(position, 1.0), b = projectionMatrix * modelViewMatrix * vec4(there, 1.0);
        vec2 way = (b.xy / max(b.w, 1e-4) - a.xy / max(a.w, 1e-4)) * uSize * corner.y;
        way = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
        a.xy += corner.x * uWide * vec2(-way.y, way.x) / uSize * a.w;
        gl_Position = a;
      }`,
    fragmentShader: `uniform vec3 uColour, uCasing; uniform float uOpacity, uWide, uCore; varying float vSide;
      void main() {
        float soft = 0.5 / uWide, side = abs(vSide);
        float core = 1.0 - smoothstep(uCore - soft, uCore + soft, side);
        gl_FragColor = vec4(mix(uCasing, uColour, core), uOpacity * mix(0.55 * (1.0 - smoothstep(1.0 - 2.0 * soft, 1.0, side)), 1.0, core));
      #include <colorspace_fragment>
    }`,
  });
}
