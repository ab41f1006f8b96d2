// What does a stroke look like after it was moved, or pulled at one place? Pulled: the place goes with the pen, what is near goes along, far ends stay.

import type { Stroke } from "../../messages";

export function moved(stroke: Stroke, dx: number, dy: number): Stroke {
  return { ...stroke, xy: stroke.xy.map((value, at) => value + (at % 2 ? dy : dx)) };
}

/** `grip`: the point that is held; `reach`: page units along the line within which others follow, less and less. */
export function pulled(stroke: Stroke, grip: number, dx: number, dy: number, reach: number): Stroke {
  const along = distancesAlong(stroke, grip);
  const xy = stroke.xy.slice();
  for (let at = 0; at < along.length; at += 1) {
    const share = Math.max(0, 1 - along[at]! / reach);
    const weight = share * share * (3 - 2 * share);
    xy[2 * at]! += weight * dx;
    xy[2 * at + 1]! += weight * dy;
  }
  return { ...stroke, xy };
}

/** From the grip to each point, along the line; around a closed one the shorter way. */
function distancesAlong(stroke: Stroke, grip: number): number[] {
  const count = stroke.xy.length / 2;
  const span = (from: number, to: number): number => Math.hypot(stroke.xy[2 * to]! - stroke.xy[2 * from]!, stroke.xy[2 * to + 1]! - stroke.xy[2 * from + 1]!);
  const from = [0];
  for (let at = 1; at < count; at += 1) from.push(from[at - 1]! + span(at - 1, at));
  const round = from[count - 1]! + (stroke.closed ? span(count - 1, 0) : 0);
  return from.map((along) => {
    const away = Math.abs(along - from[grip]!);
    return stroke.closed ? Math.min(away, round - away) : away;
  });
}
