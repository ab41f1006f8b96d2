// To which depth does a hand pull a limb? A handle slides along the way out of the page that the limb was drawn on: nothing else of the drawing moves.

import type { Point } from "../eye/eye";
import { along, dot } from "../eye/eye";

/** Turns a place in the world into pixels of the view, y down. */
export type Project = (at: Point) => readonly [x: number, y: number];

const STEEPEST = 2.5; // depth a limb may gain, of its way on the page
export const SEEN = 0.3; // of its length: an axis that is shorter to the eye than this is seen from its end

/** Metres along `out` that a drag of (right, down) pixels means for a handle at `at`. Seen from its side the handle follows the pointer; seen from its end,
 * down pulls it nearer. `metre`: pixels of a metre seen from its side, there. */
export function pulled(at: Point, out: Point, right: number, down: number, project: Project, metre: number): number {
  const step = 1 / Math.max(metre, 1e-6); // metres a pixel: near enough to be straight on the screen
  const [from, to] = [project(at), project(along(at, out, step))];
  const seen = [to[0] - from[0], to[1] - from[1]] as const; // pixels of such a step: 1 from its side, 0 from its end
  const long = Math.hypot(...seen);
  if (long < SEEN) return down * step;
  return (step * (right * seen[0] + down * seen[1])) / (long * long);
}

/** How far a place of a limb may go along `out`, from where it is: no farther from the depth of the limb's foot than a few times as far as the two are apart on
 *  the page, for beyond that a limb would only run at the eye. */
export function limits(path: readonly number[], shares: readonly number[], share: number, out: Point, least: number): readonly [farther: number, nearer: number] {
  const [foot, at] = [placeAt(path, shares, 0), placeAt(path, shares, share)];
  const away: Point = [at[0] - foot[0], at[1] - foot[1], at[2] - foot[2]];
  const deep = dot(away, out);
  const most = Math.max(least, STEEPEST * Math.sqrt(Math.max(0, dot(away, away) - deep * deep)), Math.abs(deep));
  return [-most - deep, most - deep];
}

/** The pointer's shape over something that slides this way on the screen, y down. */
export function cursorAlong(right: number, down: number): string {
  const eighth = Math.round((4 * Math.atan2(down, right)) / Math.PI) & 3; // a way and its opposite are the same
  return ["ew-resize", "nwse-resize", "ns-resize", "nesw-resize"][eighth]!;
}

/** The limb's path when the place at `share` moves by `metres` along `out`: its foot stays, all beyond moves along. */
export function bent(path: readonly number[], shares: readonly number[], share: number, out: Point, metres: number): Float32Array {
  const bentPath = Float32Array.from(path);
  shares.forEach((here, k) => {
    const part = here >= share ? 1 : here / Math.max(share, 1e-6);
    for (let axis = 0; axis < 3; axis++) bentPath[3 * k + axis]! += metres * part * part * (3 - 2 * part) * out[axis]!;
  });
  return bentPath;
}

/** The place of a limb at a share of its length. */
export function placeAt(path: readonly number[], shares: readonly number[], share: number): Point {
  const last = shares.length - 1;
  let k = 0;
  while (k < last - 1 && shares[k + 1]! < share) k++;
  const part = Math.min(1, Math.max(0, (share - shares[k]!) / Math.max(shares[k + 1]! - shares[k]!, 1e-9)));
  return [0, 1, 2].map((axis) => path[3 * k + axis]! + (path[3 * (k + 1) + axis]! - path[3 * k + axis]!) * part) as unknown as Point;
}

/** Where a limb can be taken hold of: its tip, where it is held, and between, not too close. */
export function grips(held: readonly number[], count = 4): number[] {
  const found = [...held.filter((share) => share > 0.02)];
  for (let k = count; k >= 1; k--) if (found.every((share) => Math.abs(share - k / count) > 0.4 / count)) found.push(k / count);
  return found.sort((a, b) => a - b);
}

/** The two ends of a tube of wood, its foot (the thicker) first; its points are in no order. */
export function ends(points: readonly Point[]): [foot: Point, tip: Point] {
  const farthest = (from: Point): Point => points.reduce((best, at) => (apart(at, from) > apart(best, from) ? at : best), points[0]!);
  const one = farthest(points[0]!);
  const other = farthest(one);
  const [here, there] = [thickness(points, one, other), thickness(points, other, one)];
  return here >= there ? [one, other] : [other, one];
}

function thickness(points: readonly Point[], end: Point, other: Point): number {
  const long = Math.sqrt(apart(end, other));
  const way: Point = [(other[0] - end[0]) / long, (other[1] - end[1]) / long, (other[2] - end[2]) / long];
  let widest = 0;
  for (const at of points) {
    const offset: Point = [at[0] - end[0], at[1] - end[1], at[2] - end[2]];
    const ahead = dot(offset, way);
    if (ahead < 0.15 * long) widest = Math.max(widest, Math.sqrt(Math.max(0, dot(offset, offset) - ahead * ahead)));
  }
  return widest;
}

function apart(a: Point, b: Point): number {
  return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2;
}
