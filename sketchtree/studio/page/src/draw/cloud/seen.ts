// Where on the page, as it is turned now, are the points of a scan? As limbs are (draw/turned.ts): the page turns about the vertical through the tree's root; before there is a tree, through the
// foot of the points.

import type { Cloud } from "../../messages";
import type { Store } from "../../store";
import { around } from "../line/nearness";
import type { Scan } from "./scan";

export interface Seen {
  xy: Float32Array; // of each point, page units, y down
  near: Float32Array; // how near to the viewer, 0 the farthest, 1 the nearest
  order: Uint32Array; // the farthest first
}

/** Page units of the world's origin, y down, and metres a page unit. */
export interface Stand {
  scale: number;
  root: readonly number[];
}

/** Where the world stands on the page: at the tree's root; without a tree, at the foot of the points. */
export function stand({ known }: Pick<Store, "known">): Stand {
  const { tree, cloud } = known;
  if (tree && tree.segments > 0) return tree;
  return cloud ? { scale: 1 / cloud.unit, root: [cloud.x, cloud.y] } : (tree ?? { scale: 1, root: [0, 0] });
}

export function seenFrom(scan: Scan, cloud: Pick<Cloud, "x" | "y" | "unit">, axis: number, turn: number): Seen {
  const count = scan.xyz.length / 3;
  const angle = (turn * Math.PI) / 180;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [xy, near] = [new Float32Array(2 * count), new Float32Array(count)];
  let [low, high] = [Infinity, -Infinity];
  for (let k = 0; k < count; k++) {
    const across = cloud.x + scan.xyz[3 * k]! * cloud.unit - axis;
    const out = scan.xyz[3 * k + 2]! * cloud.unit;
    xy[2 * k] = axis + across * cos - out * sin;
    xy[2 * k + 1] = cloud.y - scan.xyz[3 * k + 1]! * cloud.unit;
    const depth = across * sin + out * cos;
    near[k] = depth;
    low = Math.min(low, depth);
    high = Math.max(high, depth);
  }
  for (let k = 0; k < count; k++) near[k] = (near[k]! - low) / Math.max(high - low, 1e-9);
  return { xy, near, order: new Uint32Array(count).map((_, k) => k).sort((a, b) => near[a]! - near[b]!) };
}

/** The box of all of it, from every side. */
export function reach({ known }: Pick<Store, "known">): ReturnType<typeof around> {
  const { cloud, scan } = known;
  if (!cloud || !scan) return null;
  let [aside, high] = [0, 0];
  for (let k = 0; k < scan.xyz.length; k += 3) {
    aside = Math.max(aside, Math.abs(scan.xyz[k]!), Math.abs(scan.xyz[k + 2]!));
    high = Math.max(high, scan.xyz[k + 1]!);
  }
  return around([{ xy: [cloud.x - aside * cloud.unit, cloud.y - high * cloud.unit, cloud.x + aside * cloud.unit, cloud.y] }]);
}
