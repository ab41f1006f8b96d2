// What does the page know of one limb, drawn or not? Drawn and adopted ones the program describes; of others there is the wood only.

import type { Limb } from "../../messages";
import type { Store } from "../../store";
import type { Point } from "../eye/eye";
import { pageAxes } from "../page/plane";
import type { Merged } from "../plant/merge";
import { ends } from "./drag";
import type { Run } from "./pick";

export interface Reached {
  id: string;
  limb: Limb | null; // null: nobody drew it
  path: number[]; // x, y, z … metres
  share: number[];
  view: number; // degrees, of the page its depth is seen from
  out: Point;
}

/** The limb of this id, if it is there. */
export function reached(id: string | null, store: Store, now: Merged, runs: () => readonly Run[]): Reached | null {
  if (id === null) return null;
  const limb = store.known.limbs.find((one) => one.id === id) ?? null;
  if (limb) return { id, limb, path: limb.path, share: limb.share, view: limb.view_deg, out: pageAxes(limb.view_deg)[1] };
  const number = now.number.get(id);
  const points = number === undefined ? [] : pointsOf(number, now, runs());
  if (points.length < 2) return null;
  const [foot, tip] = ends(points);
  return { id, limb: null, path: [...foot, ...tip], share: [0, 1], view: 0, out: pageAxes(0)[1] };
}

function pointsOf(limb: number, now: Merged, runs: readonly Run[]): Point[] {
  const seen = new Set<string>();
  const points: Point[] = [];
  for (const run of runs) {
    if (run.limb !== limb) continue;
    const { index, position } = now.wood[run.mesh]!;
    for (let corner = run.first; corner < run.last; corner++) {
      const name = `${run.mesh} ${index[corner]}`;
      if (seen.has(name)) continue;
      seen.add(name);
      points.push([0, 1, 2].map((axis) => position[3 * index[corner]! + axis]!) as unknown as Point);
    }
  }
  return points;
}

/** What sort of limb it is. */
export function shortName({ limb }: Reached): string {
  if (!limb) return "Grown limb";
  return limb.order === 0 ? "Trunk" : limb.strokes.length ? "Drawn limb" : "Kept limb";
}

/** For ears. */
export function described(one: Reached, limbs: readonly Limb[]): string {
  if (!one.limb) return "Grown limb. Lock keeps it, Delete clears it, its handle pulls it nearer or away.";
  const place = limbs.findIndex((limb) => limb.id === one.id) + 1;
  const hold = one.limb.locked ? ", locked" : one.limb.held.length ? `, held at ${one.limb.held.length} ${one.limb.held.length === 1 ? "place" : "places"}` : "";
  return `${shortName(one)}, ${place} of ${limbs.length}${hold}.`;
}
