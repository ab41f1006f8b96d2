// How much of the sky does a place in the crown see? A coarse grid over the tree, of how much leaf is in each cell and how much light is left there.
//
//     light left = mean over directions of exp(−k Σ leaf area per area along the way)        k: `SPREAD`, leaves hang at all angles
//
// The grid becomes a small 3D texture; leaves and wood ask it where they are. No vertex needs a column of its own for it. Its second channel is what is left of
// the sun's light, for machines on which a shadow of every leaf takes too long.

import type { MergedLeaves } from "./merge";

export interface Shade {
  low: [number, number, number]; // corner of the grid, metres
  size: [number, number, number]; // metres
  cells: [number, number, number];
  light: Uint8Array<ArrayBuffer>; // of 255, x fastest: sky, sun, sky, sun …
}

const SIDE = 24; // cells along the longest side
const SPREAD = 0.5;
const FILLED = 0.45; // share of a card's square that is leaf
const WAYS: [number, number, number][] = [[0, 1, 0], [1, 1, 0], [-1, 1, 0], [0, 1, 1], [0, 1, -1], [1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1], [0, -1, 0]];
const WEIGHTS = [3, 2, 2, 2, 2, 1, 1, 1, 1, 0.6]; // the sky is brightest overhead, the ground gives a little back

/** Null without leaves: nothing shades. `sun`: the unit way towards it. */
export function shadeOf(leaves: MergedLeaves[], sun: readonly [number, number, number]): Shade | null {
  const box = boxOf(leaves);
  if (!box) return null;
  const [low, high] = box;
  const cell = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2], 0.1) / (SIDE - 2);
  const cells = [0, 1, 2].map((k) => Math.ceil((high[k]! - low[k]!) / cell) + 2) as [number, number, number];
  const corner = low.map((v) => v - cell) as [number, number, number];
  const density = filled(leaves, corner, cell, cells);
  const sum = new Float32Array(density.length);
  const whole = WEIGHTS.reduce((a, b) => a + b);
  WAYS.forEach((way, k) => sweep(density, cells, way, WEIGHTS[k]! / whole, sum));
  const light = new Uint8Array(2 * sum.length);
  for (let k = 0; k < sum.length; k++) light[2 * k] = Math.round(255 * Math.min(1, sum[k]!));
  towards(density, cells, sun, light);
  return { low: corner, size: cells.map((count) => count * cell) as [number, number, number], cells, light };
}

function boxOf(leaves: MergedLeaves[]): [[number, number, number], [number, number, number]] | null {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const { place } of leaves)
    for (let k = 0; k < place.length; k += 3)
      for (let axis = 0; axis < 3; axis++) {
        const value = place[k + axis]!;
        if (value < low[axis]!) low[axis] = value;
        if (value > high[axis]!) high[axis] = value;
      }
  return low[0] < Infinity ? [low, high] : null;
}

/** Leaf area per area of a cell's side, times k. */
function filled(leaves: MergedLeaves[], low: [number, number, number], cell: number, [nx, ny, nz]: [number, number, number]): Float32Array {
  const density = new Float32Array(nx * ny * nz);
  for (const { place, scale, count } of leaves)
    for (let leaf = 0; leaf < count; leaf++) {
      const k = 3 * leaf;
      const x = Math.floor((place[k]! - low[0]) / cell);
      const y = Math.floor((place[k + 1]! - low[1]) / cell);
      const z = Math.floor((place[k + 2]! - low[2]) / cell);
      density[x + nx * (y + ny * z)]! += (SPREAD * FILLED * scale[k]! * scale[k + 1]!) / (cell * cell);
    }
  return density;
}

/** Adds, for each cell, what is left of the light that comes from direction `way`: cell after cell, starting where the light enters. */
function sweep(density: Float32Array, [nx, ny, nz]: [number, number, number], [dx, dy, dz]: [number, number, number], weight: number, sum: Float32Array): void {
  const long = Math.hypot(dx, dy, dz);
  const depth = new Float32Array(density.length);
  const step = dx + nx * (dy + ny * dz); // from a cell to the one the light came through
  for (let kz = 0; kz < nz; kz++) {
    const z = dz > 0 ? nz - 1 - kz : kz;
    for (let ky = 0; ky < ny; ky++) {
      const y = dy > 0 ? ny - 1 - ky : ky;
      const edge = z + dz < 0 || z + dz >= nz || y + dy < 0 || y + dy >= ny;
      for (let kx = 0; kx < nx; kx++) {
        const x = dx > 0 ? nx - 1 - kx : kx;
        const at = x + nx * (y + ny * z);
        const before = edge || x + dx < 0 || x + dx >= nx ? 0 : depth[at + step]! + density[at + step]! * long;
        depth[at] = before;
        sum[at]! += weight * Math.exp(-before - 0.5 * density[at]! * long);
      }
    }
  }
}

/** What is left of the light from `way` in each cell, of 255, into every second place. Steps of one cell from the cell to the light. */
function towards(density: Float32Array, [nx, ny, nz]: [number, number, number], way: readonly [number, number, number], light: Uint8Array): void {
  for (let at = 0; at < density.length; at++) {
    let x = (at % nx) + 0.5;
    let y = (Math.floor(at / nx) % ny) + 0.5;
    let z = Math.floor(at / (nx * ny)) + 0.5;
    let depth = 0.4 * density[at]!;
    for (;;) {
      x += way[0];
      y += way[1];
      z += way[2];
      if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) break;
      depth += density[Math.floor(x) + nx * (Math.floor(y) + ny * Math.floor(z))]!;
    }
    light[2 * at + 1] = Math.round(255 * Math.exp(-depth));
  }
}
