// How is only a part of the leaves drawn, evenly through the tree? Leaves are put in an order that strides through them, so that any first part is a thinner crown.

import { strideOf } from "../plant/bake";

/** Reorders the triangles leaf by leaf; gives how many corners a leaf has, 0 where leaves are not all alike, and then nothing is moved. */
export function leafwise(index: Uint8Array | Uint16Array | Uint32Array): number {
  const corners = firstLeaf(index);
  const count = index.length / corners;
  if (!corners || !Number.isInteger(count) || count < 2) return 0;
  const was = index.slice();
  const stride = strideOf(count);
  for (let k = 0, leaf = 0; k < count; k++, leaf = (leaf + stride) % count) index.set(was.subarray(leaf * corners, (leaf + 1) * corners), k * corners);
  return corners;
}

/** Corners until the triangles share no vertex with those before. */
function firstLeaf(index: Uint8Array | Uint16Array | Uint32Array): number {
  let highest = 0;
  for (let k = 0; k < index.length; k += 3) {
    if (k && Math.min(index[k]!, index[k + 1]!, index[k + 2]!) > highest) return k;
    highest = Math.max(highest, index[k]!, index[k + 1]!, index[k + 2]!);
  }
  return index.length;
}
