// Where in the world is a place of a page? Pages are upright planes through the tree's first root, turned about the vertical by their `view_deg`.
//
//     across = (x − root x) · scale      up = (root y − y) · scale      depth: metres towards who looks at the page
//     world  = across · (cos φ, 0, −sin φ) + up · (0, 1, 0) + depth · (sin φ, 0, cos φ)

import type { Point } from "../eye/eye";

export interface PagePlane {
  scale: number; // metres a page unit
  root: readonly number[]; // the world's origin on the page, y down
}

/** A place of the page, y down, in the world. */
export function onPage(plane: PagePlane, viewDeg: number, x: number, y: number, depth: number): Point {
  const [right, out] = pageAxes(viewDeg);
  const across = (x - plane.root[0]!) * plane.scale;
  return [across * right[0] + depth * out[0], (plane.root[1]! - y) * plane.scale, across * right[2] + depth * out[2]];
}

/** The page's way to the right, and its way out to who looks at it. */
export function pageAxes(viewDeg: number): [right: Point, out: Point] {
  const [sin, cos] = [Math.sin((viewDeg * Math.PI) / 180), Math.cos((viewDeg * Math.PI) / 180)];
  return [[cos, 0, -sin], [sin, 0, cos]];
}

/** Metres in front of a page. */
export function depthOf(viewDeg: number, [x, , z]: Point): number {
  const out = pageAxes(viewDeg)[1];
  return x * out[0] + z * out[2];
}
