// Where is the trunk's contour, and what of it is under the pen? Rings in pixels of the photo with the way along them, vertices on them, and what lies between two places.
//
//     place = ring, x, y, s     s: pixels along the ring from its first point; a ring is closed, so that s and s + length are the same

import type { Trunks, Underlay } from "../../messages";

export interface Ring {
  xy: number[]; // x, y, x, y …
  along: number[]; // s of each point
  length: number;
}

export interface Place {
  ring: number;
  x: number;
  y: number;
  s: number;
}

export interface Corner extends Place {
  parts: boolean; // a branch may end there
  added: boolean; // by hand
}

export interface Contour {
  rings: Ring[];
  corners: Corner[]; // in the order of their ring
}

const contours = new WeakMap<Trunks, Contour>();

export function contourOf(trunks: Trunks): Contour {
  let made = contours.get(trunks);
  if (!made) {
    const lines = trunks.contour.length === trunks.vertices.length ? trunks.contour : trunks.vertices;
    const rings = lines.map(ringOf);
    const corners = trunks.vertices.flatMap((xy, ring) => {
      const own: Corner[] = [];
      for (let at = 0; at + 1 < xy.length; at += 2) {
        const place = placeOn(rings[ring]!, ring, xy[at]!, xy[at + 1]!).place;
        own.push({ ...place, x: xy[at]!, y: xy[at + 1]!, parts: trunks.parts[ring]?.[at / 2] ?? true, added: false });
      }
      return own;
    });
    contours.set(trunks, (made = { rings, corners }));
  }
  return made;
}

function ringOf(xy: number[]): Ring {
  const along: number[] = [];
  let length = 0;
  for (let at = 0; at < xy.length; at += 2) {
    along.push(length);
    length += Math.hypot(xy[(at + 2) % xy.length]! - xy[at]!, xy[(at + 3) % xy.length]! - xy[at + 1]!);
  }
  return { xy, along, length };
}

/** The place of a ring that is nearest to a point, and how far away it is. */
function placeOn(ring: Ring, number: number, x: number, y: number): { place: Place; away: number } {
  const { xy } = ring;
  let best: Place = { ring: number, x: xy[0] ?? 0, y: xy[1] ?? 0, s: 0 };
  let away = Infinity;
  for (let at = 0; at < xy.length; at += 2) {
    const [ax, ay] = [xy[at]!, xy[at + 1]!];
    const [dx, dy] = [xy[(at + 2) % xy.length]! - ax, xy[(at + 3) % xy.length]! - ay];
    const square = dx * dx + dy * dy;
    const t = square > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    const [px, py] = [ax + t * dx, ay + t * dy];
    const far = Math.hypot(px - x, py - y);
    if (far < away) [best, away] = [{ ring: number, x: px, y: py, s: ring.along[at / 2]! + t * Math.sqrt(square) }, far];
  }
  return { place: best, away };
}

/** The place of the contour nearest to a point, within reach. */
export function nearestPlace({ rings }: Contour, x: number, y: number, reach = Infinity): Place | null {
  let found: Place | null = null;
  let least = reach;
  rings.forEach((ring, number) => {
    const { place, away } = placeOn(ring, number, x, y);
    if (away <= least) [found, least] = [place, away];
  });
  return found;
}

/** The vertex nearest to a point, within reach. */
export function nearestCorner<T extends { x: number; y: number }>(corners: readonly T[], x: number, y: number, reach: number): T | null {
  let found: T | null = null;
  let least = reach;
  for (const one of corners) {
    const away = Math.hypot(one.x - x, one.y - y);
    if (away <= least) [found, least] = [one, away];
  }
  return found;
}

/** How far it is from one place of a ring to another in the ring's direction. */
export function ahead({ length }: Pick<Ring, "length">, from: number, to: number): number {
  return (((to - from) % length) + length) % length;
}

/** The shorter way from one place of a ring to another: where it begins, in the ring's direction, and how long it is. */
export function wayBetween({ rings }: Contour, one: Place, other: Place): { from: number; long: number } {
  const ring = rings[one.ring]!;
  const long = ahead(ring, one.s, other.s);
  return long <= ring.length / 2 ? { from: one.s, long } : { from: other.s, long: ring.length - long };
}

const SAME = 1e-6;

/** The vertices on the shorter way between two places of one ring, both ends counted, in the ring's direction. */
export function cornersBetween(contour: Contour, corners: readonly Corner[], one: Place, other: Place): Corner[] {
  if (one.ring !== other.ring) return [];
  const { from, long } = wayBetween(contour, one, other);
  const after = (corner: Corner): number => ahead(contour.rings[one.ring]!, from - SAME, corner.s);
  return corners.filter((corner) => corner.ring === one.ring && after(corner) <= long + 2 * SAME).sort((a, b) => after(a) - after(b));
}

/** The point of a ring that lies so far along it. */
export function pointAt(ring: Ring, s: number): [number, number] {
  const at = ahead(ring, 0, s);
  let [low, high] = [0, ring.along.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (ring.along[middle]! <= at) low = middle;
    else high = middle - 1;
  }
  const { xy, along } = ring;
  const end = low + 1 < along.length ? along[low + 1]! : ring.length;
  const t = end > along[low]! ? (at - along[low]!) / (end - along[low]!) : 0;
  const [ax, ay] = [xy[2 * low]!, xy[2 * low + 1]!];
  return [ax + t * (xy[(2 * low + 2) % xy.length]! - ax), ay + t * (xy[(2 * low + 3) % xy.length]! - ay)];
}

/** The line along a ring from one place on, so long, x, y, x, y … */
export function lineAlong(ring: Ring, from: number, long: number): number[] {
  const between = ring.along
    .map((s, at) => ({ after: ahead(ring, from, s), x: ring.xy[2 * at]!, y: ring.xy[2 * at + 1]! }))
    .filter(({ after }) => after > 0 && after < long)
    .sort((a, b) => a.after - b.after);
  return [...pointAt(ring, from), ...between.flatMap(({ x, y }) => [x, y]), ...pointAt(ring, from + long)];
}

// Pixels of the photo and units of the page

export interface Grid {
  left: number; // page units
  top: number;
  unit: number; // page units a pixel
}

export function gridOf(trunks: Pick<Trunks, "size">, underlay: Underlay): Grid {
  return { left: underlay.x, top: underlay.y, unit: underlay.width / (trunks.size[0] || underlay.width) };
}

export function toPixels(grid: Grid, x: number, y: number): [number, number] {
  return [(x - grid.left) / grid.unit, (y - grid.top) / grid.unit];
}
