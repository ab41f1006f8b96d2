// What is done by hand to the contour's vertices? A vertex goes, one comes, all between two places go. The program removes first, then merges, then adds; here each press becomes the edit, or takes
// back one that is there.

import type { Trunk } from "../../messages";
import { ahead, type Contour, type Corner, cornersBetween, nearestPlace, type Place, pointAt, wayBetween } from "./contour";

export type Point = [number, number];
export type Edits = Pick<Trunk, "remove" | "add" | "merge">;

export const NO_EDITS: Edits = { remove: [], add: [], merge: [] };
export const FEWEST = 3; // vertices of a polygon
export const MOST_EDITS = 2000;
const SAME = 1.5; // pixels: an edit so near means the same vertex
const SHORTER = 0.45; // of a ring: farther round it is not clear which way is meant

/** The vertices as they are to be: those that were found, after edits the program may not have heard of yet. */
export function shown(contour: Contour, edits: Edits): Corner[] {
  let corners = contour.corners.filter((corner) => !edits.remove.some(([x, y]) => near(corner, x, y)));
  for (const [one, other] of edits.merge) {
    const gone = new Set(spanOf(contour, corners, one, other));
    corners = corners.filter((corner) => !gone.has(corner));
  }
  for (const [x, y] of edits.add) {
    const at = corners.findIndex((corner) => near(corner, x, y));
    const place = nearestPlace(contour, x, y);
    if (at >= 0) corners = corners.map((corner, number) => (number === at ? { ...corner, added: true } : corner));
    else if (place) corners = [...corners, { ...place, x, y, parts: true, added: true }];
  }
  return corners;
}

function spanOf(contour: Contour, corners: readonly Corner[], one: Point, other: Point): Corner[] {
  const [from, to] = [nearestPlace(contour, ...one), nearestPlace(contour, ...other)];
  return from && to ? cornersBetween(contour, corners, from, to) : [];
}

function near(at: { x: number; y: number }, x: number, y: number): boolean {
  return Math.hypot(at.x - x, at.y - y) <= SAME;
}

/** Why a vertex can't go; null: it can. */
export function keeps(corners: readonly Corner[], gone: readonly Corner[]): string | null {
  const ring = gone[0]?.ring;
  const left = corners.filter((corner) => corner.ring === ring).length - gone.length;
  return left < FEWEST ? `A contour keeps ${FEWEST} points` : null;
}

/** A vertex goes. One that was added is not added any more. */
export function without(edits: Edits, corner: Corner): Edits {
  const add = edits.add.filter(([x, y]) => !near(corner, x, y));
  return add.length < edits.add.length ? { ...edits, add } : { ...edits, remove: [...edits.remove, rounded(corner.x, corner.y)] };
}

/** A vertex comes. One that was removed there is not removed any more. */
export function withPlace(edits: Edits, place: Place): Edits {
  const remove = edits.remove.filter(([x, y]) => !near(place, x, y));
  return remove.length < edits.remove.length ? { ...edits, remove } : { ...edits, add: [...edits.add, rounded(place.x, place.y)] };
}

/** One that was removed comes back. */
export function restored(edits: Edits, point: Point): Edits {
  return { ...edits, remove: edits.remove.filter((one) => one !== point) };
}

/** All these vertices, neighbours on one ring, go: said as two places of the contour beyond the first and the last of them, before those that stay. */
export function merged(contour: Contour, corners: readonly Corner[], gone: readonly Corner[], edits: Edits): Edits {
  const [first, last] = [gone[0]!, gone[gone.length - 1]!];
  const ring = contour.rings[first.ring]!;
  const stays = corners.filter((corner) => corner.ring === first.ring && !gone.some((one) => one.s === corner.s));
  const before = Math.min(...stays.map((corner) => ahead(ring, corner.s, first.s)), ring.length / 8);
  const after = Math.min(...stays.map((corner) => ahead(ring, last.s, corner.s)), ring.length / 8);
  const ends: [Point, Point] = [rounded(...pointAt(ring, first.s - before / 2)), rounded(...pointAt(ring, last.s + after / 2))];
  const add = edits.add.filter(([x, y]) => !gone.some((corner) => near(corner, x, y)));
  const found = gone.some((corner) => !corner.added); // those that were added are gone with that
  return { ...edits, add, merge: found ? [...edits.merge, ends] : edits.merge };
}

/** Is the way between two places short enough that it is clear which is meant? */
export function isClear(contour: Contour, one: Place, other: Place): boolean {
  if (one.ring !== other.ring) return false;
  return wayBetween(contour, one, other).long <= SHORTER * contour.rings[one.ring]!.length;
}

export function count(edits: Edits): number {
  return edits.remove.length + edits.add.length + edits.merge.length;
}

function rounded(x: number, y: number): Point {
  return [Math.round(1000 * x) / 1000, Math.round(1000 * y) / 1000];
}

