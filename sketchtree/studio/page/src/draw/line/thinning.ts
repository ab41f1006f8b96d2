// Which points of a line are needed? Those without which it would leave its path by more than half a pixel; and, for its width's sake, never too few.
//
// Ramer 1972, Douglas & Peucker 1973: between two kept points the farthest one is kept, if it is farther than the tolerance.

import { length, type Sample } from "./samples";

const TOLERANCE = 0.5; // CSS pixels
const MOST = 200; // points; a line that needs more is kept more loosely
const STRETCHES = 20; // the longest gap is at most this part of the line
const LEAST_GAP = 3; // CSS pixels; but no gap is made shorter than this
const LOOSER = 1.5;

/** `pixel`: CSS pixels a page unit. The first and the last point always stay. */
export function thin(line: readonly Sample[], pixel: number): Sample[] {
  if (line.length <= 2) return line.slice();
  const gap = Math.max(length(line) / STRETCHES, LEAST_GAP / pixel);
  let tolerance = TOLERANCE / pixel;
  let kept = keep(line, tolerance);
  while (kept.filter(Boolean).length > MOST - STRETCHES) {
    tolerance *= LOOSER;
    kept = keep(line, tolerance);
  }
  fill(line, kept, gap);
  return line.filter((_, at) => kept[at]);
}

function keep(line: readonly Sample[], tolerance: number): boolean[] {
  const kept = line.map((_, at) => at === 0 || at === line.length - 1);
  const open: [number, number][] = [[0, line.length - 1]];
  while (open.length) {
    const [from, to] = open.pop()!;
    let farthest = -1;
    let most = tolerance;
    for (let at = from + 1; at < to; at += 1) {
      const away = distanceToSpan(line[at]!, line[from]!, line[to]!);
      if (away > most) [farthest, most] = [at, away];
    }
    if (farthest < 0) continue;
    kept[farthest] = true;
    open.push([from, farthest], [farthest, to]);
  }
  return kept;
}

/** No stretch without a point is longer than `gap`. */
function fill(line: readonly Sample[], kept: boolean[], gap: number): void {
  let since = 0;
  for (let at = 1; at < line.length; at += 1) {
    since += Math.hypot(line[at]!.x - line[at - 1]!.x, line[at]!.y - line[at - 1]!.y);
    if (since > gap) kept[at] = true;
    if (kept[at]) since = 0;
  }
}

interface Point {
  x: number;
  y: number;
}

/** From a point to the nearest place between two others. */
export function distanceToSpan(point: Point, from: Point, to: Point): number {
  const dx = to.x - from.x;
  const dy = to.y - from.y;
  const square = dx * dx + dy * dy;
  const share = square > 0 ? Math.max(0, Math.min(1, ((point.x - from.x) * dx + (point.y - from.y) * dy) / square)) : 0;
  return Math.hypot(point.x - from.x - share * dx, point.y - from.y - share * dy);
}
