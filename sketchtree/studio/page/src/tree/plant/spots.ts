// How far does the tree reach, more truly than its box says? A few thousand of its places, of wood and leaves alike: who frames it, or stands beside it, asks these.

import type { Merged } from "./merge";

const MOST = 4000;

/** x, y, z of places all over the plant; none where nothing stands. */
export function spotsOf({ wood, leaves }: Pick<Merged, "wood" | "leaves">): Float32Array {
  const lists = [...wood.map((one) => one.position), ...leaves.map((one) => one.place)];
  const count = lists.reduce((sum, list) => sum + list.length / 3, 0);
  const stride = Math.max(1, Math.ceil(count / MOST));
  const spots: number[] = [];
  for (const list of lists) {
    for (let k = 0; k < list.length; k += 3 * stride) spots.push(list[k]!, list[k + 1]!, list[k + 2]!);
    for (const k of extremes(list)) spots.push(list[k]!, list[k + 1]!, list[k + 2]!);
  }
  return Float32Array.from(spots);
}

/** Where in the list those places begin that lie farthest along each axis, both ways: none of these is ever passed over. */
function extremes(list: Float32Array): number[] {
  const found = [0, 0, 0, 0, 0, 0];
  for (let k = 3; k < list.length; k += 3)
    for (let axis = 0; axis < 3; axis++) {
      if (list[k + axis]! < list[found[axis]! + axis]!) found[axis] = k;
      if (list[k + axis]! > list[found[3 + axis]! + axis]!) found[3 + axis] = k;
    }
  return list.length ? found : [];
}

/** The highest of them. */
export function topOf(spots: Float32Array): [number, number, number] {
  let top = 0;
  for (let k = 3; k < spots.length; k += 3) if (spots[k + 1]! > spots[top + 1]!) top = k;
  return spots.length ? [spots[top]!, spots[top + 1]!, spots[top + 2]!] : [0, 0, 0];
}
