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

/** One leaf's corners, from this vertex on: T + R (S p). */
function bend({ place, turn, scale, tint }: MergedLeaves, leaf: number, card: CardShape, made: BakedLeaves, first: number): void {
  const long = Math.hypot(turn[4 * leaf]!, turn[4 * leaf + 1]!, turn[4 * leaf + 2]!, turn[4 * leaf + 3]!) || 1;
  const [qx, qy, qz, qw] = [turn[4 * leaf]! / long, turn[4 * leaf + 1]! / long, turn[4 * leaf + 2]! / long, turn[4 * leaf + 3]! / long];
  const [sx, sy, sz] = [scale[3 * leaf]!, scale[3 * leaf + 1]!, scale[3 * leaf + 2]!];
  for (let v = 0, at = first; v < card.position.length; v += 3, at++) {
    for (const isNormal of [false, true]) {
      const from = isNormal ? card.normal : card.position;
      const [x, y, z] = isNormal ? [from[v]! / sx, from[v + 1]! / sy, from[v + 2]! / sz] : [from[v]! * sx, from[v + 1]! * sy, from[v + 2]! * sz];
      const [cx, cy, cz] = [qy * z - qz * y + qw * x, qz * x - qx * z + qw * y, qx * y - qy * x + qw * z];
      const [tx, ty, tz] = [x + 2 * (qy * cz - qz * cy), y + 2 * (qz * cx - qx * cz), z + 2 * (qx * cy - qy * cx)];
      if (isNormal) {
        const unit = 127 / (Math.hypot(tx, ty, tz) || 1);
        made.normal[4 * at] = tx * unit;
        made.normal[4 * at + 1] = ty * unit;
        made.normal[4 * at + 2] = tz * unit;
      } else {
        made.position[3 * at] = place[3 * leaf]! + tx;
        made.position[3 * at + 1] = place[3 * leaf + 1]! + ty;
        made.position[3 * at + 2] = place[3 * leaf + 2]! + tz;
      }
    }
    for (let c = 0; c < 3; c++) made.tint[4 * at + c] = tint[3 * leaf + c]!;
  }
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
