// Which limb is under the pointer? A ray against the triangles of those limbs whose box it meets; where it misses all, the limb it passes closest, within a
// few pixels: twigs are thin and hands are not steady.

import type { Point } from "../eye/eye";
import { along, dot } from "../eye/eye";
import type { MergedWood } from "../plant/merge";

export interface Ray {
  from: Point;
  way: Point; // unit
  spread: number; // metres of tolerance a metre of way
  start: number; // metres of tolerance at its beginning
}

export interface Run {
  limb: number;
  mesh: number; // of the list of wood
  first: number; // of its corners, in `index`
  last: number; // one past
  low: [number, number, number];
  high: [number, number, number];
}

export interface Hit {
  limb: number;
  at: Point;
  far: number;
}

/** Which triangles belong to which limb: stretches of the index with one limb, and their boxes. */
export function runsOf(wood: readonly MergedWood[]): Run[] {
  const runs: Run[] = [];
  wood.forEach(({ index, limb, position }, mesh) => {
    let run: Run | null = null;
    for (let corner = 0; corner < index.length; corner += 3) {
      const of = limb[index[corner]!]!;
      if (!run || run.limb !== of) runs.push((run = { limb: of, mesh, first: corner, last: corner, low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] }));
      run.last = corner + 3;
      for (let k = 0; k < 3; k++) widen(run, position, 3 * index[corner + k]!);
    }
  });
  return runs;
}

function widen({ low, high }: Run, position: Float32Array, at: number): void {
  for (let axis = 0; axis < 3; axis++) {
    const value = position[at + axis]!;
    if (value < low[axis]!) low[axis] = value;
    if (value > high[axis]!) high[axis] = value;
  }
}

export function pick(wood: readonly MergedWood[], runs: readonly Run[], ray: Ray): Hit | null {
  const met = runs.filter((run) => meets(run, ray));
  let best: Hit | null = null;
  for (const run of met) {
    const far = triangles(wood[run.mesh]!, run, ray);
    if (far !== null && far < (best?.far ?? Infinity)) best = { limb: run.limb, far, at: along(ray.from, ray.way, far) };
  }
  return best ?? closest(wood, met, ray);
}

/** Does the ray, with its tolerance, pass the box? */
function meets({ low, high }: Run, ray: Ray): boolean {
  const middle: Point = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  const ahead = Math.max(0, dot([middle[0] - ray.from[0], middle[1] - ray.from[1], middle[2] - ray.from[2]], ray.way));
  const slack = ray.start + ray.spread * (ahead + Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
  let [near, far] = [0, Infinity];
  for (let axis = 0; axis < 3; axis++) {
    const step = ray.way[axis]!;
    const [a, b] = [low[axis]! - slack - ray.from[axis]!, high[axis]! + slack - ray.from[axis]!];
    if (Math.abs(step) < 1e-12) {
      if (a > 0 || b < 0) return false;
      continue;
    }
    near = Math.max(near, Math.min(a / step, b / step));
    far = Math.min(far, Math.max(a / step, b / step));
  }
  return near <= far;
}

/** How far along the ray is the first triangle it goes through? (Möller and Trumbore 1997.) */
function triangles({ index, position }: MergedWood, run: Run, { from, way }: Ray): number | null {
  let best: number | null = null;
  for (let corner = run.first; corner < run.last; corner += 3) {
    const [a, b, c] = [3 * index[corner]!, 3 * index[corner + 1]!, 3 * index[corner + 2]!];
    const [ax, ay, az] = [position[a]!, position[a + 1]!, position[a + 2]!];
    const [e1x, e1y, e1z] = [position[b]! - ax, position[b + 1]! - ay, position[b + 2]! - az];
    const [e2x, e2y, e2z] = [position[c]! - ax, position[c + 1]! - ay, position[c + 2]! - az];
    const [px, py, pz] = [way[1] * e2z - way[2] * e2y, way[2] * e2x - way[0] * e2z, way[0] * e2y - way[1] * e2x];
    const volume = e1x * px + e1y * py + e1z * pz;
    if (Math.abs(volume) < 1e-18) continue;
    const [tx, ty, tz] = [from[0] - ax, from[1] - ay, from[2] - az];
    const u = (tx * px + ty * py + tz * pz) / volume;
    if (u < 0 || u > 1) continue;
    const [qx, qy, qz] = [ty * e1z - tz * e1y, tz * e1x - tx * e1z, tx * e1y - ty * e1x];
    const v = (way[0] * qx + way[1] * qy + way[2] * qz) / volume;
    if (v < 0 || u + v > 1) continue;
    const far = (e2x * qx + e2y * qy + e2z * qz) / volume;
    if (far > 0 && far < (best ?? Infinity)) best = far;
  }
  return best;
}

/** The limb with the vertex that lies nearest to the ray, as the eye sees it, within the tolerance. */
function closest(wood: readonly MergedWood[], runs: readonly Run[], ray: Ray): Hit | null {
  let best: Hit | null = null;
  let least = 1;
  for (const { mesh, first, last, limb } of runs) {
    const { index, position } = wood[mesh]!;
    for (let corner = first; corner < last; corner++) {
      const at = 3 * index[corner]!;
      const point: Point = [position[at]!, position[at + 1]!, position[at + 2]!];
      const offset: Point = [point[0] - ray.from[0], point[1] - ray.from[1], point[2] - ray.from[2]];
      const far = dot(offset, ray.way);
      if (far <= 0) continue;
      const beside = Math.sqrt(Math.max(0, dot(offset, offset) - far * far)) / (ray.start + ray.spread * far);
      if (beside < least) [least, best] = [beside, { limb, at: point, far }];
    }
  }
  return best;
}
