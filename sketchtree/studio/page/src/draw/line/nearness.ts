// What is under the pen? Distances from a point to strokes, what lies inside a lasso or a closed outline, and boxes.

import type { Stroke } from "../../messages";
import { distanceToSpan } from "./thinning";

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Page units from a point to a stroke's line. */
export function distance(stroke: Stroke, x: number, y: number): number {
  const { xy } = stroke;
  let least = Infinity;
  for (let at = 0; at + 3 < xy.length; at += 2) {
    least = Math.min(least, distanceToSpan({ x, y }, { x: xy[at]!, y: xy[at + 1]! }, { x: xy[at + 2]!, y: xy[at + 3]! }));
  }
  if (stroke.closed) least = Math.min(least, distanceToSpan({ x, y }, { x: xy[xy.length - 2]!, y: xy[xy.length - 1]! }, { x: xy[0]!, y: xy[1]! }));
  return least;
}

/** The nearest stroke within reach; the last drawn of those equally near. */
export function nearest(strokes: Iterable<Stroke>, x: number, y: number, reach: number): Stroke | null {
  let found: Stroke | null = null;
  let least = reach;
  for (const stroke of strokes) {
    if (!isInBox(stroke, x, y, reach)) continue;
    const away = distance(stroke, x, y);
    if (away <= least) [found, least] = [stroke, away];
  }
  return found;
}

/** The point of a stroke that is nearest to a place. */
export function nearestPoint(stroke: Stroke, x: number, y: number): number {
  let found = 0;
  let least = Infinity;
  for (let at = 0; at < stroke.xy.length / 2; at += 1) {
    const away = Math.hypot(stroke.xy[2 * at]! - x, stroke.xy[2 * at + 1]! - y);
    if (away < least) [found, least] = [at, away];
  }
  return found;
}

/** Is the point inside the outline? (A ray to the right crosses it an odd number of times.) */
export function isInside(outline: readonly number[], x: number, y: number): boolean {
  let inside = false;
  for (let at = 0, last = outline.length - 2; at < outline.length; last = at, at += 2) {
    const [ax, ay, bx, by] = [outline[at]!, outline[at + 1]!, outline[last]!, outline[last + 1]!];
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

/** Most of the stroke lies in the lasso. */
export function isCaught(stroke: Stroke, lasso: readonly number[]): boolean {
  let inside = 0;
  for (let at = 0; at < stroke.xy.length; at += 2) if (isInside(lasso, stroke.xy[at]!, stroke.xy[at + 1]!)) inside += 1;
  return inside > stroke.xy.length / 4;
}

const boxes = new WeakMap<Pick<Stroke, "xy">, Box>();

export function boxOf(stroke: Pick<Stroke, "xy">): Box {
  let box = boxes.get(stroke);
  if (!box) {
    let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let at = 0; at < stroke.xy.length; at += 2) {
      left = Math.min(left, stroke.xy[at]!);
      right = Math.max(right, stroke.xy[at]!);
      top = Math.min(top, stroke.xy[at + 1]!);
      bottom = Math.max(bottom, stroke.xy[at + 1]!);
    }
    box = { left, top, width: right - left, height: bottom - top };
    boxes.set(stroke, box);
  }
  return box;
}

export function around(strokes: Iterable<Pick<Stroke, "xy">>): Box | null {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const stroke of strokes) {
    const box = boxOf(stroke);
    left = Math.min(left, box.left);
    top = Math.min(top, box.top);
    right = Math.max(right, box.left + box.width);
    bottom = Math.max(bottom, box.top + box.height);
  }
  return left <= right ? { left, top, width: right - left, height: bottom - top } : null;
}

function isInBox(stroke: Stroke, x: number, y: number, reach: number): boolean {
  const box = boxOf(stroke);
  return x >= box.left - reach && x <= box.left + box.width + reach && y >= box.top - reach && y <= box.top + box.height + reach;
}
