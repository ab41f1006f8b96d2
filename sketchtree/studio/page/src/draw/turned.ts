// Where on a turned page are the tree's limbs? The page is a plane through the root, turned about the vertical; limbs are seen on it from straight ahead.
//
//     X = X₀ + (x cos φ − z sin φ) / s    Y = Y₀ − y / s    φ azimuth of the page; s metres a page unit; (X₀, Y₀) the root on the page, Y down

import type { Limb, Tree } from "../messages";

/** A limb's path on the page, x, y, x, y …, page units. */
export function projected(limb: Limb, tree: Pick<Tree, "scale" | "root">, turn: number): number[] {
  const angle = (turn * Math.PI) / 180;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [left, top] = [tree.root[0] ?? 0, tree.root[1] ?? 0];
  const xy: number[] = [];
  for (let at = 0; at + 2 < limb.path.length; at += 3) {
    xy.push(left + (limb.path[at]! * cos - limb.path[at + 2]! * sin) / tree.scale, top - limb.path[at + 1]! / tree.scale);
  }
  return xy;
}
