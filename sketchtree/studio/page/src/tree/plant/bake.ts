// How are leaves drawn where instancing costs more than it saves? Software renderers draw every instance as a call of its own (60,000 of them: 6 s a frame), so
// there each leaf's corners are written out into one mesh.
//
// Leaves stand in an order that strides through the tree, so that any first part of the mesh is a thinner crown, not half of one.

import type { MergedLeaves } from "./merge";
import type { CardShape } from "./plant";

export interface BakedLeaves {
  position: Float32Array;
  normal: Int8Array; // 4 a vertex, of 127
  uv: Float32Array;
  tint: Uint8Array; // 4 a vertex, of 255
  index: Uint32Array;
  corners: number; // of the index, a leaf
}

export function baked(leaves: MergedLeaves, card: CardShape): BakedLeaves {
  const [vertices, corners] = [card.position.length / 3, card.index.length];
  const total = leaves.count * vertices;
  const made: BakedLeaves = {
    position: new Float32Array(3 * total), normal: new Int8Array(4 * total), uv: new Float32Array(2 * total), tint: new Uint8Array(4 * total),
    index: new Uint32Array(leaves.count * corners), corners,
  };
  const stride = strideOf(leaves.count);
  for (let k = 0, leaf = 0; k < leaves.count; k++, leaf = (leaf + stride) % leaves.count) {
    bend(leaves, leaf, card, made, k * vertices);
    made.uv.set(card.uv, 2 * k * vertices);
    for (let corner = 0; corner < corners; corner++) made.index[k * corners + corner] = card.index[corner]! + k * vertices;
  }
  return made;
}

/** One leaf's corners, from this vertex on: T + R (S p). Written with plain numbers: it runs half a million times for a tree. */
function bend({ place, turn, scale, tint }: MergedLeaves, leaf: number, card: CardShape, made: BakedLeaves, first: number): void {
  const q = rotation(turn, 4 * leaf);
  const at = 3 * leaf;
  const sx = scale[at]!;
  const sy = scale[at + 1]!;
  const sz = scale[at + 2]!;
  for (let v = 0, k = first; v < card.position.length; v += 3, k++) {
    const x = card.position[v]! * sx;
    const y = card.position[v + 1]! * sy;
    const z = card.position[v + 2]! * sz;
    made.position[3 * k] = place[at]! + q[0]! * x + q[1]! * y + q[2]! * z;
    made.position[3 * k + 1] = place[at + 1]! + q[3]! * x + q[4]! * y + q[5]! * z;
    made.position[3 * k + 2] = place[at + 2]! + q[6]! * x + q[7]! * y + q[8]! * z;
    const nx = card.normal[v]! / sx;
    const ny = card.normal[v + 1]! / sy;
    const nz = card.normal[v + 2]! / sz;
    const unit = 127 / (Math.sqrt(nx * nx + ny * ny + nz * nz) || 1);
    made.normal[4 * k] = Math.round((q[0]! * nx + q[1]! * ny + q[2]! * nz) * unit);
    made.normal[4 * k + 1] = Math.round((q[3]! * nx + q[4]! * ny + q[5]! * nz) * unit);
    made.normal[4 * k + 2] = Math.round((q[6]! * nx + q[7]! * ny + q[8]! * nz) * unit);
    made.tint[4 * k] = tint[at]!;
    made.tint[4 * k + 1] = tint[at + 1]!;
    made.tint[4 * k + 2] = tint[at + 2]!;
  }
}

const ROWS = new Float64Array(9);

/** The matrix of a quaternion, row by row; always the same nine numbers' place. */
function rotation(turn: Int16Array, at: number): Float64Array {
  const long = Math.hypot(turn[at]!, turn[at + 1]!, turn[at + 2]!, turn[at + 3]!) || 1;
  const x = turn[at]! / long;
  const y = turn[at + 1]! / long;
  const z = turn[at + 2]! / long;
  const w = turn[at + 3]! / long;
  ROWS[0] = 1 - 2 * (y * y + z * z);
  ROWS[1] = 2 * (x * y - z * w);
  ROWS[2] = 2 * (x * z + y * w);
  ROWS[3] = 2 * (x * y + z * w);
  ROWS[4] = 1 - 2 * (x * x + z * z);
  ROWS[5] = 2 * (y * z - x * w);
  ROWS[6] = 2 * (x * z - y * w);
  ROWS[7] = 2 * (y * z + x * w);
  ROWS[8] = 1 - 2 * (x * x + y * y);
  return ROWS;
}

/** About 0.618 of the count, with no common divisor: every leaf has its turn once. */
export function strideOf(count: number): number {
  let stride = Math.max(1, Math.round(0.618034 * count));
  while (divisor(stride, count) !== 1) stride++;
  return stride;
}

function divisor(a: number, b: number): number {
  return b === 0 ? a : divisor(b, a % b);
}
